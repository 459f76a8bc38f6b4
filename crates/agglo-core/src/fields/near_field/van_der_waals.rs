//! Van der Waals attraction of two spheres.
//!
//! # Equation
//! ```text
//! F = -(32/3) A P³ d/(p m)²,   P = R_i R_j,   p = d² - (R_i + R_j)²,   m = d² - (R_i - R_j)²   A8
//! U = -(A/6) [2 P/p + 2 P/m + ln(p/m)] = -(A/3) [y/(1 - y²) - artanh y],   y = 4 P/(p + m)
//! ```
//! The second form of U and the closed form of F have no cancellation at large distance, where
//! U = -(16/9) A P³/d⁶. At gaps below g0 the force is that at g0, and the energy goes on linearly.
//!
//! # Source
//! H. C. Hamaker, Physica 4, 1058 (1937).
//!
//! # Symbols
//! | symbol | name in code   | unit | meaning                                                  |
//! |--------|----------------|------|----------------------------------------------------------|
//! | A      | `hamaker`      | J    | Hamaker constant of the two grains through the medium    |
//! | g0     | `smallest_gap` | m    | cap: closest approach of the surfaces, some 0.165-0.4 nm |
//! | d      | `distance`     | m    | of the centers                                           |
//!
//! # Valid when
//! Gaps below the wavelengths of retardation, about 10-100 nm; smooth spheres.
//!
//! # Compared with others
//! Many DEM codes use the limit A R*/(6 g²) for g ≪ R; this is the full formula. Repulsion in contact is the
//! contact law's; the pull A R*/(6 g0²) acts on top of it.
//!
//! # In a scenario
//! ```toml
//! [fields.near_field.law.van_der_waals]
//! hamaker = "1e-19 J"
//! smallest_gap = "0.4 nm"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::fields::near_field::{NearLaw, Source, VanDerWaals};
//! use agglo::units::Quantity;
//! let law = VanDerWaals { hamaker: Quantity(1e-19), smallest_gap: Quantity(4e-10) };
//! let grain = Source { radius: 1e-6, ..Default::default() };
//! let near = -1e-19 * 0.5e-6 / (6.0 * 1e-9 * 1e-9);
//! assert!((law.force(&grain, &grain, 2e-6 + 1e-9) / near - 1.0).abs() < 1e-2);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{NearLaw, Source};
use crate::law::{Context, Faults, Law};
use crate::units::{Energy, Length};

/// Hamaker's law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VanDerWaals {
    /// Hamaker constant.
    pub hamaker: Energy,
    /// Smallest gap of the surfaces; closer ones feel the force of this gap.
    pub smallest_gap: Length,
}

/// P, p and m of the formula, from the gap of the surfaces.
#[inline]
fn products(a: &Source, b: &Source, gap: f64) -> (f64, f64, f64) {
    let product = a.radius * b.radius;
    let outer = gap * (gap + 2.0 * (a.radius + b.radius));
    (product, outer, outer + 4.0 * product)
}

impl Law for VanDerWaals {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.not_negative("hamaker", self.hamaker);
        faults.positive("smallest_gap", self.smallest_gap);
    }
}

impl NearLaw for VanDerWaals {
    /// Negative, since it attracts.
    #[inline]
    fn force(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        let radii = a.radius + b.radius;
        let gap = (distance - radii).max(self.smallest_gap.si());
        let (product, outer, inner) = products(a, b, gap);
        let ratio = product / (outer * inner);
        -32.0 / 3.0 * self.hamaker.si() * product * (radii + gap) * ratio * ratio
    }

    /// That at the smallest gap for all that are closer.
    fn gradient(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        let radii = a.radius + b.radius;
        let gap = (distance - radii).max(self.smallest_gap.si());
        let (_, outer, inner) = products(a, b, gap);
        let reach = radii + gap;
        self.force(a, b, reach).abs() * (4.0 * reach * (1.0 / outer + 1.0 / inner) - 1.0 / reach)
    }

    /// Nearer than infinity Hamaker's force is steeper than its limit d^-7.
    fn slowest_decay(&self) -> f64 {
        7.0
    }

    fn is_capped(&self) -> bool {
        true
    }

    /// Zero at infinity; smooth at the cap.
    fn energy(&self, a: &Source, b: &Source, distance: f64) -> f64 {
        let gap = distance - a.radius - b.radius;
        let capped = gap.max(self.smallest_gap.si());
        let (product, outer, inner) = products(a, b, capped);
        let sum = outer + inner;
        let y = 4.0 * product / sum;
        // y/(1 - y²) - artanh y, as its series Σ y^(2k+1) 2k/(2k+1) where the two nearly cancel.
        let bracket = if y < 0.1 {
            (1..9).map(f64::from).map(|k| y.powi(2 * k as i32 + 1) * 2.0 * k / (2.0 * k + 1.0)).sum()
        } else {
            y * sum * sum / (4.0 * outer * inner) - 0.5 * (inner / outer).ln()
        };
        let beyond = self.force(a, b, distance) * (capped - gap);
        -self.hamaker.si() / 3.0 * bracket + beyond
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::check::assert_slope;
    use crate::units::Quantity;

    const LAW: VanDerWaals = VanDerWaals { hamaker: Quantity(1e-19), smallest_gap: Quantity(4e-10) };

    fn grain(radius: f64) -> Source {
        Source { radius, ..Source::default() }
    }

    /// Hamaker's formula as printed, where it does not cancel.
    #[test]
    fn energy_is_hamakers() {
        for (a, b, d) in [(1e-6, 1e-6, 2.1e-6), (1e-6, 3e-6, 4.001e-6), (1e-6, 5e-6, 9e-6)] {
            let (s, t) = (d * d - (a + b) * (a + b), d * d - (a - b) * (a - b));
            let printed = -1e-19 / 6.0 * (2.0 * a * b / s + 2.0 * a * b / t + f64::ln(s / t));
            let energy = LAW.energy(&grain(a), &grain(b), d);
            assert!((energy / printed - 1.0).abs() < 1e-10, "{d}: {energy} {printed}");
        }
    }

    /// Near: A R*/(6 g²) to O(g/R); far: (32/3) A R_i³ R_j³/d⁷ to O(R²/d²), both 1e-5 here.
    #[test]
    fn limits() {
        let (a, b) = (grain(1e-3), grain(2e-3));
        let near = -1e-19 * (2e-3 / 3.0) / (6.0 * 1e-9 * 1e-9);
        assert_close!(LAW.force(&a, &b, 3e-3 + 1e-9), near, 1e-5, "in N");
        let (far, d) = (1e-19 * 8e-18, 3.0_f64);
        assert_close!(LAW.force(&a, &b, d), -32.0 / 3.0 * far / d.powi(7), 1e-5, "in N");
        assert_close!(LAW.energy(&a, &b, d), -16.0 / 9.0 * far / d.powi(6), 1e-5, "in J");
    }

    /// Below the smallest gap the force stays and the energy goes on along its slope, without a jump.
    #[test]
    fn the_cap_is_continuous() {
        let (a, b) = (grain(1e-6), grain(2e-6));
        let cap = 3e-6 + 4e-10;
        let held = LAW.force(&a, &b, cap);
        for distance in [cap - 1e-12, 3e-6, 2.9e-6] {
            assert_close!(LAW.force(&a, &b, distance), held, 1e-8, "in N");
        }
        let step = LAW.energy(&a, &b, cap) - LAW.energy(&a, &b, 2.9e-6);
        assert_close!(step, -held * (cap - 2.9e-6), 1e-8);
        let jump = LAW.energy(&a, &b, cap + 1e-16) / LAW.energy(&a, &b, cap - 1e-16) - 1.0;
        assert!(jump.abs() < 1e-6, "{jump}");
        // Nanometre grains: a difference over a gap of 1 nm would drown in the rounding of micrometers.
        let gap = 1e-9;
        let (small_a, small_b) = (grain(1e-9), grain(2e-9));
        let energy = |g| -LAW.energy(&small_a, &small_b, 3e-9 + g);
        assert_slope(gap, energy, |g| LAW.force(&small_a, &small_b, 3e-9 + g));
    }

    /// The series and the closed form meet at y = 0.1.
    #[test]
    fn both_forms_of_the_energy_agree() {
        let (a, b) = (grain(1.0), grain(1.0));
        for distance in [6.40, 6.48, 6.481, 6.6, 20.0] {
            assert_slope(distance, |d| -LAW.energy(&a, &b, d), |d| LAW.force(&a, &b, d));
        }
    }
}
