//! Restitution from the pressure of the impact over the hardness.
//!
//! # Equation
//! ```text
//! e = max(1 - P/(2H), 0),   P = |I|/a_c,   I = m* (1 + e) v/(δτ1 + δτ2)                   [B] 3.1
//! x = m* v²/(4 π β b³ H)   =>   (1 - e) (a0 + (af - a0)(1 - e)) = x                       B3
//! s = 1 - e = 2 x/(a0 + √(a0² + 4 (af - a0) x));   a0 = 0, af = 1: e = 1 - √x
//! force_over = "compression":   I = m* (1 + e) v/δτ1   =>   (1 - e) (a0 + (af - a0)(1 - e)) = x (1 + e)    [B] 4.14
//! s = 4 x/(a0 + x + √((a0 + x)² + 8 (af - a0) x))
//! ```
//! A pair sticks where x ≥ af. For two equal spheres x is the paper's λ = 2 ρ v_p²/(3 H β), v_p = v/2.
//!
//! Heat softens: H is that of the temperatures after the impact, whose heat depends on e. With E(x) from above, e = E(x(H(T(e)))) is
//! solved: first it is asked whether a pair that sticks gets hot enough to stick; if not, e rises from 0 by
//! repeated substitution, and is then closed in on in a bracket. Less restitution is more heat is less hardness, so substitution
//! climbs to the smallest e that solves the equation. There is more than one only where Q > 8 R T or so. The energy of new
//! surfaces is taken from the heat after that; only with the published balance it cools before, as printed.
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), sections 3, 4 and 6 b.
//!
//! # Symbols
//! | symbol   | name in code         | unit | meaning                                                     |
//! |----------|----------------------|------|-------------------------------------------------------------|
//! | e        | `restitution`        | -    |                                                             |
//! | P        |                      | Pa   | mean pressure of the contact                                |
//! | I        |                      | N    | mean force of the impact                                    |
//! | a_c      | `area`               | m²   | contact area, see `contact_area`                            |
//! | δτ1, δτ2 |                      | s    | compression and recovery, see `contact_time`                |
//! | H        | `hardness`           | Pa   | of the softer partner, see `softening`                      |
//! | x        | `ratio`              | -    | pressure over 2H, over the whole cross-section              |
//! | x H      | `load`               | Pa   |                                                             |
//! | m*       | `reduced_mass`       | kg   | m_i m_j/(m_i + m_j)                                         |
//! | v        | `approach`           | m/s  | along the normal                                            |
//! | β        | `deformation`        | -    | length of deformation over the smaller radius               |
//! | b        | `smaller_radius`     | m    |                                                             |
//! | a0, af   | `elastic_area`, `sticking_area` | - | contact area over the smaller cross-section at e = 1 and e = 0 |
//!
//! # Valid when
//! An empirical criterion for bonding (Nesterenko et al. 1994), made a law of restitution by a straight line between its ends. It has e
//! fall with the speed; it does not know adhesion, by which slow grains stick.
//!
//! # Compared with others
//! The paper's 4.14 divides the impulse of the whole impact by the time of compression alone: same threshold, lower e between
//! (x = 1/4: 0.41 for 0.5). Its plain iteration has slope -1 at the root for a0 = 0 and flips between 0 and 1 - x for
//! ever: `solver.fixed_point` does what is printed, up to its limit, and says so. [B] 4.11 lacks a density: v = 3 H k δτ/(ρ b).
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! hardness = "1 MPa"
//!
//! [impact.restitution.hardness]
//! deformation = 1.0
//! elastic_area = 0.0
//! sticking_area = 1.0
//! solver = "bracketed"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::restitution::Hardness;
//! let law = Hardness::default();
//! let load = law.load(1e-6, 20.0, 1e-3); // m* = 1 mg, v = 20 m/s, b = 1 mm
//! assert!((load / (4e-4 / (4.0 * std::f64::consts::PI * 1e-9)) - 1.0).abs() < 1e-14);
//! assert!((law.restitution(0.25) - 0.5).abs() < 1e-15);
//! assert_eq!(law.restitution(1.0), 0.0);
//! ```

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Rebound, RestitutionLaw};
use crate::impact::contact_area::ContactArea;
use crate::law::{Context, Faults, Law, Needs};
use crate::particles::Property;
use crate::particles::property::{ACTIVATION_ENERGY, HARDNESS, HEAT_CAPACITY};

const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// e = max(1 - P/(2H), 0), solved together with velocities, temperatures and hardness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hardness {
    /// β: length of deformation over the smaller radius, above 0.
    #[serde(default = "one")]
    pub deformation: f64,
    /// a0: contact area of an elastic impact over the smaller cross-section, not above `sticking_area`.
    #[serde(default)]
    pub elastic_area: f64,
    /// af: contact area of a sticking impact over the smaller cross-section, above 0.
    #[serde(default = "one")]
    pub sticking_area: f64,
    /// Over which time the mean force is taken.
    #[serde(default)]
    pub force_over: ForceTime,
    /// How e is solved for.
    #[serde(default)]
    pub solver: Solver,
}

fn one() -> f64 {
    1.0
}

impl Default for Hardness {
    fn default() -> Self {
        Self {
            deformation: one(),
            elastic_area: 0.0,
            sticking_area: one(),
            force_over: ForceTime::default(),
            solver: Solver::default(),
        }
    }
}

/// An impact that takes longer than this never ends.
const MOST_ITERATIONS: u32 = 10_000;

impl Law for Hardness {
    const WORDS: &'static [&'static str] = &["bracketed", "fixed_point"];

    const READS: &'static [Property] = &[HARDNESS, ACTIVATION_ENERGY, HEAT_CAPACITY];

    fn needs(&self) -> Needs {
        Needs::always(&[HARDNESS])
    }

    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.above_zero("deformation", self.deformation);
        faults.zero_or_more("elastic_area", self.elastic_area);
        faults.above_zero("sticking_area", self.sticking_area);
        if self.elastic_area > self.sticking_area && self.sticking_area > 0.0 {
            let message = format!("{} is above sticking_area = {}", self.elastic_area, self.sticking_area);
            faults.fail_with("elastic_area", message, "contacts grow as restitution falls");
        }
        if let Solver::FixedPoint(law) = &self.solver {
            faults.under("solver.fixed_point", |faults| law.faults(faults));
        }
    }

    fn notes(&self, _: &Context<'_>) -> Vec<String> {
        let mut notes = Vec::new();
        if self.force_over == ForceTime::Compression {
            notes.push("impact.restitution.hardness.force_over = compression: the published form; restitution is lower than the mean force over the whole impact gives".to_owned());
        }
        if let Solver::FixedPoint(_) = self.solver {
            notes.push("impact.restitution.hardness.solver.fixed_point may not converge: its iteration can flip between two values for ever; bracketed finds the root".to_owned());
        }
        notes
    }

    fn warnings(&self) -> &'static [&'static str] {
        const COMPRESSION: &str = "impact.restitution.hardness.force_over = \"compression\" divides the impulse of the whole impact by \
             the time of compression alone";
        const FIXED_POINT: &str = "impact.restitution.hardness.solver.fixed_point need not converge: with elastic_area = 0 it flips \
             between two values for ever";
        match (self.force_over, &self.solver) {
            (ForceTime::Impact, Solver::Bracketed) => &[],
            (ForceTime::Compression, Solver::Bracketed) => &[COMPRESSION],
            (ForceTime::Impact, Solver::FixedPoint(_)) => &[FIXED_POINT],
            (ForceTime::Compression, Solver::FixedPoint(_)) => &[COMPRESSION, FIXED_POINT],
        }
    }
}

impl RestitutionLaw for Hardness {
    fn rebound(&self) -> Rebound {
        Rebound::Hardness
    }
}

impl FixedPoint {
    fn faults(&self, faults: &mut Faults) {
        faults.at_least_one("most_iterations", self.most_iterations);
        if self.most_iterations > MOST_ITERATIONS {
            let message = format!("found {}; at most {MOST_ITERATIONS} are allowed", self.most_iterations);
            faults.fail("most_iterations", message);
        }
        if self.tolerance <= 0.0 || self.tolerance >= 1.0 {
            let message = format!("found {}; a number above 0 and below 1 is wanted", self.tolerance);
            faults.fail("tolerance", message);
        }
    }
}

impl Hardness {
    /// The law of contact areas.
    pub fn area(&self) -> ContactArea {
        ContactArea { elastic: self.elastic_area, sticking: self.sticking_area }
    }

    /// x H [Pa]: half the mean pressure if the whole smaller cross-section bore it.
    #[inline]
    pub fn load(&self, reduced_mass: f64, approach: f64, smaller_radius: f64) -> f64 {
        let cube = smaller_radius * smaller_radius * smaller_radius;
        reduced_mass * approach * approach / (4.0 * PI * self.deformation * cube)
    }

    /// e for a ratio x of load over hardness; the equations' root in closed form, the same for all areas.
    #[inline]
    pub fn restitution(&self, ratio: f64) -> f64 {
        let (elastic, more) = (self.elastic_area, self.sticking_area - self.elastic_area);
        if ratio >= self.sticking_area {
            return 0.0;
        }
        if ratio <= 0.0 {
            return 1.0;
        }
        let loss = match self.force_over {
            ForceTime::Impact => {
                2.0 * ratio / (elastic + (elastic * elastic + 4.0 * more * ratio).max(0.0).sqrt())
            }
            ForceTime::Compression => {
                let sum = elastic + ratio;
                4.0 * ratio / (sum + (sum * sum + 8.0 * more * ratio).max(0.0).sqrt())
            }
        };
        (1.0 - loss).clamp(0.0, 1.0)
    }

    /// The next e of the paper's plain iteration; what differs from 0 by rounding is 0, so that it is not left to chance
    /// whether a pair sticks where the iteration flips.
    #[inline]
    pub fn substituted(&self, restitution: f64, ratio: f64) -> f64 {
        if ratio <= 0.0 {
            return 1.0;
        }
        let force = match self.force_over {
            ForceTime::Impact => ratio,
            ForceTime::Compression => ratio * (1.0 + restitution),
        };
        let next = 1.0 - force / self.area().fraction(restitution);
        if next > ROUNDING { next } else { 0.0 }
    }
}

/// Over which time the mean force of an impact is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ForceTime {
    /// Compression and recovery, [B] 3.1 with 4.10.
    #[default]
    Impact,
    /// Compression alone: what [B] 4.14 amounts to.
    Compression,
}

/// How the coupled equations of an impact are solved.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Solver {
    /// A bracketed root of e between 0 and 1.
    #[default]
    Bracketed,
    /// The iteration of [B], which need not end.
    FixedPoint(FixedPoint),
}

/// The plain iteration of [B], section 6 b.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FixedPoint {
    /// Most iterations; then the last e is taken and a warning counted.
    #[serde(default = "most_iterations")]
    pub most_iterations: u32,
    /// Largest change of e, over e, at the end; between 0 and 1.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
}

fn most_iterations() -> u32 {
    100
}
fn tolerance() -> f64 {
    5e-4
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::contact_time::durations;
    use crate::math::roots::root_between;

    fn law(elastic_area: f64, sticking_area: f64, force_over: ForceTime) -> Hardness {
        Hardness { elastic_area, sticking_area, force_over, ..Hardness::default() }
    }

    /// e = 1 - √x, and the root of (1-e)² = x(1+e) at x = 1/4: (9 - √33)/8 from the quadratic.
    #[test]
    fn closed_forms_of_the_default_areas() {
        let (whole, half) = (law(0.0, 1.0, ForceTime::Impact), law(0.0, 1.0, ForceTime::Compression));
        for (ratio, wanted) in [(1e-12, 1.0 - 1e-6), (0.01, 0.9), (0.25, 0.5), (0.81, 0.1)] {
            assert!((whole.restitution(ratio) - wanted).abs() < 2e-16, "{ratio}");
        }
        assert_near!(half.restitution(0.25), (9.0 - 33.0_f64.sqrt()) / 8.0, 3e-16);
        for one in [whole, half] {
            assert_eq!((one.restitution(0.0), one.restitution(1.0), one.restitution(7.0)), (1.0, 0.0, 0.0));
            assert_above!(one.restitution(1.0 - 1e-9), 0.0);
        }
    }

    /// [B] 4.14 with its own coefficients: c1 = (λ - (a0 - 2 af))/(a0 - af), c2 = (λ - af)/(a0 - af).
    #[test]
    fn val_zohdi_2004_equation_4_14() {
        for (a0, af) in [(0.0, 1.0), (0.1, 0.9), (0.3, 0.4)] {
            for lambda in [0.01, 0.1, 0.3] {
                let e = law(a0, af, ForceTime::Compression).restitution(lambda);
                let (c1, c2) = ((lambda - (a0 - 2.0 * af)) / (a0 - af), (lambda - af) / (a0 - af));
                // Round-off of coefficients up to 20.
                assert!((e * e + c1 * e + c2).abs() < 1e-14, "{a0} {af} {lambda}: {e}");
            }
        }
    }

    /// The closed form against a bracketed root of e = 1 - P/(2H), with P from impulse, duration and area.
    #[test]
    fn closed_form_solves_3_1_for_any_areas() {
        let (mass, b, hardness) = (2e-6, 1e-3, 3e5);
        for force_over in [ForceTime::Impact, ForceTime::Compression] {
            for (a0, af) in [(0.0, 1.0), (0.0, 0.5), (0.2, 0.8), (0.5, 0.5), (0.9, 0.3)] {
                for v in [0.1, 3.0, 12.0, 15.0] {
                    let law = Hardness { deformation: 0.8, ..law(a0, af, force_over) };
                    let residual = |e: f64| {
                        let time = durations(law.deformation, b, v, e);
                        let duration = match force_over {
                            ForceTime::Impact => time.compression + time.recovery,
                            ForceTime::Compression => time.compression,
                        };
                        // Times the area, which may be zero at e = 1.
                        let pressed = mass * (1.0 + e) * v / duration / (2.0 * hardness);
                        ((1.0 - e) * law.area().of(e, b) - pressed) / (b * b)
                    };
                    let found = law.restitution(law.load(mass, v, b) / hardness);
                    let ends = [residual(0.0), residual(1.0)];
                    let wanted =
                        if ends[0] <= 0.0 { 0.0 } else { root_between(residual, [0.0, 1.0], ends, 1e-16).at };
                    // Round-off of the residual over its least slope, 0.3.
                    assert!((found - wanted).abs() < 1e-14, "{a0} {af} {v}: {found} {wanted}");
                }
            }
        }
    }

    /// [B] 4.15: v_p = √(3 af H β/(2ρ)) for two equal spheres; 1e-12 on either side, far above round-off.
    #[test]
    fn val_zohdi_2004_critical_velocity_4_15() {
        let (density, hardness, b): (f64, f64, f64) = (2300.0, 4e5, 2e-4);
        let one = Hardness { deformation: 0.7, ..law(0.1, 0.8, ForceTime::Impact) };
        let critical = (3.0 * 0.8 * hardness * 0.7 / (2.0 * density)).sqrt();
        let reduced = 0.5 * density * 4.0 / 3.0 * PI * b.powi(3);
        let at = |v_p: f64| one.restitution(one.load(reduced, 2.0 * v_p, b) / hardness);
        assert_eq!(at(critical * (1.0 + 1e-12)), 0.0);
        assert_above!(at(critical * (1.0 - 1e-12)), 0.0);
    }

    /// With a0 = 0 the plain iteration flips between 0 and 1 - x; with a0 = af it is at the root at once.
    #[test]
    fn plain_iteration() {
        let one = law(0.0, 1.0, ForceTime::Impact);
        let first = one.substituted(0.0, 0.25);
        assert_eq!((first, one.substituted(first, 0.25)), (0.75, 0.0));
        assert_eq!(law(0.5, 0.5, ForceTime::Impact).substituted(0.3, 0.25), 0.5);
        let published = law(0.5, 0.5, ForceTime::Compression);
        assert_near!(published.substituted(0.2, 0.25), 0.4, 1e-15);
    }
}
