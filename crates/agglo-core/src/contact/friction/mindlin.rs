//! Mindlin / Cundall-Strack friction: a tangential spring that is kept per contact.
//!
//! # Equation
//! ```text
//! s ← T s · min(1, k_t/k_t,before) + k̄_t Δu,   k_t = κ dF_n/dδ,   κ = 4 G*/E*             A6
//! k̄_t = (k_t,before + k_t)/2 where k_t rises over the step, else k_t
//! F = s + c_t v_t where that is at most μ F_n, else μ_d F_n along it
//! ```
//! T turns the spring with the contact. A spring that was loaded at a higher stiffness is relaxed with it
//! (unloading), one loaded at a lower stiffness keeps its force: both only lose energy, so a contact that is
//! loaded, sheared and unloaded in any order cannot give back more than it took.
//!
//! # Source
//! R. D. Mindlin, J. Appl. Mech. 16, 259 (1949); P. A. Cundall and O. D. L. Strack, Géotechnique 29, 47
//! (1979); C. Thornton, S. J. Cummins and P. W. Cleary, Powder Technol. 233, 30 (2013).
//!
//! # Symbols
//! | symbol  | name in code               | unit  | meaning                                            |
//! |---------|----------------------------|-------|----------------------------------------------------|
//! | s       | `spring.force`             | N     | force of the tangential spring on i                |
//! | Δu      | `displacement`             | m     | of j's surface relative to i's over the step       |
//! | k_t     | `stiffness`                | N/m   | tangential stiffness                               |
//! | κ       | `stiffness_ratio`          | -     | tangential over normal; 2(1-ν)/(2-ν) if left out   |
//! | c_t     | `dashpot` x normal dashpot | N s/m | tangential dashpot                                 |
//! | v_t     | `velocity`                 | m/s   | of j's surface relative to i's, tangential         |
//! | μ, μ_d  | `static_friction`, `dynamic_friction` | - | limit of sticking; force while slipping     |
//! | F_n     | `normal_force`             | N     | repulsion with its dashpot; 0 where it pulls       |
//!
//! # Critical step
//! ω² = (7/2) κ k/m* and Γ = (7/2) c_t/m*; along and across a contact the larger counts; looked at every 100 steps.
//!
//! # Valid when
//! Partial slip inside the contact is left out (Mindlin and Deresiewicz). After a contact has begun to slip,
//! μ_d is its limit until it sticks again. μ_d above μ is read as μ.
//!
//! # Compared with others
//! `mindlin/rescale` of LAMMPS with force history is the same idea; displacement history without the
//! rescaling gains energy on unloading. The spring never exceeds the sliding limit on account of the dashpot.
//!
//! # In a scenario
//! ```toml
//! [contact.friction.mindlin]
//! static_friction = 0.5
//! stiffness_ratio = 0.8
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::contact::friction::{FrictionLaw, Mindlin, Sliding, TangentialSpring};
//! use agglo::contact::{Elastic, PairConstants, ContactGeometry};
//! use agglo::math::Vec3;
//! let law = Mindlin { static_friction: 0.5, dynamic_friction: None, stiffness_ratio: Some(0.8), dashpot: 0.0 };
//! let mut pair = PairConstants::default();
//! law.settle(&mut pair, None);
//! let sliding = Sliding {
//!     normal: Vec3::AXES[0], displacement: Vec3::new(0.0, 1e-6, 0.0), normal_force: 1.0,
//!     elastic: Elastic { stiffness: 1e5, ..Default::default() }, ..Default::default()
//! };
//! let (force, _) = law.force(&pair, &ContactGeometry::default(), &sliding, &TangentialSpring::default());
//! assert!((force.y - 0.8 * 1e5 * 1e-6).abs() < 1e-15);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::law::check_coefficients;
use super::spring::shortened;
use super::{FrictionLaw, Sliding, TangentialSpring};
use crate::contact::{ContactGeometry, Elastic, PairConstants};
use crate::law::{Context, Faults, Law, Needs};
use crate::math::{Pace, Real, Vector};
use crate::particles::property::{POISSON_RATIO, YOUNGS_MODULUS};
use crate::particles::{Mixture, Property};

/// A tangential spring with Coulomb's limit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mindlin {
    /// μ: static friction coefficient.
    pub static_friction: f64,
    /// μ_d: dynamic friction coefficient; as static if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dynamic_friction: Option<f64>,
    /// Tangential over normal stiffness; Mindlin's 2 (1-ν)/(2-ν) of the materials if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_ratio: Option<f64>,
    /// Tangential dashpot over the normal one.
    #[serde(default)]
    pub dashpot: f64,
}

impl Law for Mindlin {
    const READS: &'static [Property] = &[YOUNGS_MODULUS, POISSON_RATIO];

    fn reads(&self) -> &'static [Property] {
        if self.stiffness_ratio.is_some() { &[] } else { Self::READS }
    }

    fn needs(&self) -> Needs {
        Needs { properties: self.reads(), because: "without stiffness_ratio" }
    }

    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        check_coefficients(faults, self.static_friction, self.dynamic_friction);
        faults.zero_or_more("dashpot", self.dashpot);
        if let Some(ratio) = self.stiffness_ratio {
            faults.above_zero("stiffness_ratio", ratio);
        }
    }
}

impl FrictionLaw for Mindlin {
    type Memory<F: Real> = TangentialSpring<F>;

    #[inline(always)]
    fn force<F: Real>(
        &self,
        pair: &PairConstants<F>,
        _: &ContactGeometry<F>,
        sliding: &Sliding<F>,
        before: &TangentialSpring<F>,
    ) -> (Vector<F>, TangentialSpring<F>) {
        let zero = F::of(0.0);
        let stiffness = pair.tangential_ratio * sliding.elastic.stiffness.max(zero);
        let carried = before.carried(sliding.normal, sliding.turn_about_normal, stiffness);
        // The mean over a step in which the stiffness rises: second order. A falling one is exact with its end.
        let rising = F::both(zero.below(before.stiffness), before.stiffness.below(stiffness));
        let loading = F::select(rising, F::of(0.5) * (before.stiffness + stiffness), stiffness);
        let spring = carried + sliding.displacement * loading;
        let trial = spring + sliding.velocity * (F::of(self.dashpot) * sliding.normal_dashpot);
        let load = sliding.normal_force.max(zero);
        let limit = load * F::select(before.sliding, pair.dynamic_friction, pair.static_friction);
        let size = trial.norm_squared();
        let sticks = size.at_most(limit * limit);
        if F::all(sticks) {
            return (trial, TangentialSpring { force: spring, stiffness, sliding: F::Mask::default() });
        }
        let cap = pair.dynamic_friction * load;
        let force = Vector::select(sticks, trial, trial * (cap / size.sqrt()));
        let spring = Vector::select(sticks, spring, shortened(spring, cap));
        (force, TangentialSpring { force: spring, stiffness, sliding: F::not(sticks) })
    }

    /// That of the tangential spring and its dashpot.
    fn pace(
        &self,
        pair: &PairConstants,
        geometry: &ContactGeometry,
        elastic: &Elastic,
        dashpot: f64,
    ) -> Pace {
        let mass = geometry.sliding_mass();
        Pace::of_spring(pair.tangential_ratio * elastic.stiffness, mass)
            + Pace::of_dashpot(self.dashpot * dashpot, mass)
    }

    /// Dynamic friction is never above static friction.
    fn settle(&self, pair: &mut PairConstants, own: Option<&Mixture>) {
        let own_at_rest = own.and_then(|own| own.static_friction);
        let own_in_motion = own.and_then(|own| own.dynamic_friction);
        let at_rest = own_at_rest.unwrap_or(self.static_friction);
        pair.static_friction = at_rest;
        pair.dynamic_friction = own_in_motion.or(self.dynamic_friction).unwrap_or(at_rest).min(at_rest);
        pair.tangential_ratio = self.stiffness_ratio.unwrap_or(pair.tangential_ratio);
    }

    fn coefficients(&self) -> (f64, Option<f64>) {
        (self.static_friction, self.dynamic_friction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::collision::Oblique;
    use crate::contact::damping::{Damping, Restitution};
    use crate::contact::normal::{Hertz, Hooke, Normal, StrainPower};
    use crate::math::Vec3;
    use crate::units::Quantity;

    const LAW: Mindlin =
        Mindlin { static_friction: 0.5, dynamic_friction: None, stiffness_ratio: Some(0.8), dashpot: 0.0 };

    /// What the law makes of a contact with a memory, in a pair of materials without constants of its own.
    fn advance(law: &Mindlin, before: &TangentialSpring, sliding: &Sliding) -> (Vec3, TangentialSpring) {
        let mut pair = PairConstants::default();
        law.settle(&mut pair, None);
        law.force(&pair, &ContactGeometry::default(), sliding, before)
    }

    fn slide(by: Vec3, normal_stiffness: f64, normal_force: f64) -> Sliding {
        Sliding {
            normal: Vec3::AXES[2],
            displacement: by,
            elastic: Elastic { stiffness: normal_stiffness, ..Default::default() },
            normal_force,
            ..Default::default()
        }
    }

    /// At constant stiffness a closed path in the plane gives force and energy back, to round-off.
    #[test]
    fn a_stuck_spring_is_elastic() {
        let (mut spring, mut work) = (TangentialSpring::default(), 0.0);
        let corners = [(1e-3, 0.0), (0.0, 2e-3), (-3e-3, 0.0), (0.0, -2e-3), (2e-3, 0.0)];
        for (x, y) in corners {
            for _ in 0..100 {
                let by = Vec3::new(x, y, 0.0) * 0.01;
                let before = spring.force;
                let (force, after) = advance(&LAW, &spring, &slide(by, 100.0, 1e3));
                work += 0.5 * (before + force).dot(by);
                spring = after;
                assert_near!(spring.energy(), work, 1e-15, "in J");
            }
        }
        assert_below!(spring.force.norm(), 1e-15, "in N");
        assert_false!(spring.sliding, "the pair slides");
        let (force, _) = advance(&LAW, &spring, &slide(Vec3::new(1e-3, 0.0, 0.0), 100.0, 1e3));
        assert_near_vector!(force, Vec3::new(0.08, 0.0, 0.0), 1e-15, "in N");
    }

    #[test]
    fn slip_is_capped_and_dynamic_until_it_sticks() {
        let law = Mindlin { dynamic_friction: Some(0.3), ..LAW };
        let mut spring = TangentialSpring::default();
        let mut highest: f64 = 0.0;
        for k in 0..200 {
            let step = slide(Vec3::new(1e-3, 0.0, 0.0), 1000.0, 100.0);
            let (force, after) = advance(&law, &spring, &step);
            spring = after;
            highest = highest.max(force.x);
            // 0.8 N a step: the static limit of 50 N is reached in step 62, from then on 30 N.
            let wanted = if k < 62 { 0.8 * f64::from(k + 1) } else { 30.0 };
            assert!((force.x - wanted).abs() < 1e-9, "{k}: {}", force.x);
        }
        assert_near!(highest, 49.6, 1e-9);
        let back = slide(Vec3::new(-1e-3, 0.0, 0.0), 1000.0, 100.0);
        let (force, after) = advance(&law, &spring, &back);
        assert_near!(force.x, 29.2, 1e-9, "in N");
        assert_false!(after.sliding, "the pair slides");
    }

    #[test]
    fn a_pulling_normal_force_carries_no_friction() {
        let loaded = TangentialSpring { force: Vec3::AXES[0], stiffness: 1.0, sliding: false };
        let (force, spring) = advance(&LAW, &loaded, &slide(Vec3::ZERO, 1.0, -1.0));
        assert_eq!((force, spring.energy()), (Vec3::ZERO, 0.0));
    }

    /// Any order of loading, shearing and unloading: the spring stores at most what was done on it.
    #[test]
    fn varying_stiffness_never_creates_energy() {
        let mut stream = crate::math::rng::Stream::new(5, crate::math::rng::Purpose::Sampling, 0);
        let (mut spring, mut work, mut given) = (TangentialSpring::default(), 0.0, 0.0_f64);
        for k in 0..20_000 {
            let stiffness = 1000.0 * (0.01 * f64::from(k)).sin().abs();
            let by = Vec3::new(stream.normal(), stream.normal(), 0.0) * 1e-4;
            let load = 0.2 * stiffness * stream.uniform();
            let before = spring.energy();
            let carried = spring.carried(Vec3::AXES[2], 0.0, 0.8 * stiffness);
            let (force, after) = advance(&LAW, &spring, &slide(by, stiffness, load));
            // Work over the step by the trapezoidal rule between the relaxed force and the new one.
            let step = 0.5 * (shortened(carried, 0.5 * load) + force).dot(by);
            spring = after;
            work += step;
            given = given.max(spring.energy() - work);
            assert_at_most!(
                spring.energy(),
                before + step.abs() + 0.5 * 0.8 * stiffness * by.norm_squared(),
                "in J"
            );
        }
        assert!(work > 0.0 && given <= 1e-12, "{given}");
    }

    /// The spring turns with the normal and about it, and keeps its length.
    #[test]
    fn history_turns_with_the_contact() {
        let mut spring = TangentialSpring { force: Vec3::AXES[0], stiffness: 1.0, sliding: false };
        let steps = 10_000;
        let angle = std::f64::consts::FRAC_PI_2 / f64::from(steps);
        for k in 1..=steps {
            let normal = Vec3::AXES[2].rotated_about(Vec3::AXES[1], angle * f64::from(k));
            let step = Sliding { normal, ..slide(Vec3::ZERO, 1.25, 10.0) };
            spring = advance(&LAW, &spring, &step).1;
        }
        assert!((spring.force + Vec3::AXES[2]).norm() < 1e-9, "{:?}", spring.force);
        spring.force = Vec3::AXES[0];
        for _ in 0..steps {
            let step = Sliding { turn_about_normal: angle, ..slide(Vec3::ZERO, 1.25, 10.0) };
            spring = advance(&LAW, &spring, &step).1;
        }
        // The tangent of each small angle stands for the angle: error angle²/3 per step's angle.
        assert!((spring.force - Vec3::AXES[1]).norm() < 1e-7, "{:?}", spring.force);
    }

    fn glass() -> PairConstants {
        let ratio = 2.0 * (1.0 - 0.2) / (2.0 - 0.2);
        PairConstants { effective_modulus: 25e9, tangential_ratio: ratio, ..Default::default() }
    }

    /// In gross sliding v_t' = v_t - μ (1 + e) v_n and each angular velocity gains (5/4) μ (1 + e) v_n / R (equal
    /// spheres).
    #[test]
    fn val_gross_sliding() {
        let friction = Mindlin { static_friction: 0.092, stiffness_ratio: None, ..LAW };
        let normal = Normal::Hertz(Hertz {});
        let oblique = Oblique {
            pair: glass(),
            radius: 2.5e-3,
            mass: 2.6e-4,
            normal: &normal,
            damping: None,
            friction: &friction,
        }
        .settled();
        let (v_n, v_t) = (0.01, 0.02);
        let start = oblique.approach(Vec3::new(-v_n, v_t, 0.0));
        let end = oblique.integrate(start, 5e-9, |_, _| {});
        let relative = end.velocities[1] - end.velocities[0];
        // The line of centers turns by v_t times the contact time over 2 R, some 2e-4; that and δ/R bound the error.
        let n = (end.positions[1] - end.positions[0]).normalized();
        let tangent = Vec3::AXES[2].cross(n);
        let expected = v_t - 0.092 * 2.0 * v_n;
        assert!((relative.dot(tangent) / expected - 1.0).abs() < 1e-3, "{relative:?}");
        let angular_velocity = 1.25 * 0.092 * 2.0 * v_n / 2.5e-3;
        assert!(
            (end.angular_velocities[0].norm() / angular_velocity - 1.0).abs() < 1e-3,
            "{:?} {angular_velocity}",
            end.angular_velocities[0]
        );
        assert_near_vector!(end.angular_velocities[0], end.angular_velocities[1], 1e-9);
    }

    /// Stored and kinetic energy together never rise, at any angle, for any normal law, with and without dashpots.
    #[test]
    fn val_energy_guard() {
        let laws = [
            (Normal::Hertz(Hertz {}), 4e-9),
            (Normal::Hooke(Hooke { stiffness: Quantity(1e6) }), 1e-8),
            (Normal::StrainPower(StrainPower { exponent: 2.0 }), 1e-7),
        ];
        let damping = Damping::Restitution(Restitution { restitution: 0.9 });
        for (normal, dt) in &laws {
            for (degrees, damping, dashpot) in [
                (76.0, None, 0.0),
                (76.0, Some(&damping), 1.0),
                (30.0, None, 0.0),
                (10.0, Some(&damping), 0.5),
            ] {
                let friction = Mindlin { dashpot, ..LAW };
                let (radius, mass) = (2.5e-3, 2.6e-4);
                let oblique =
                    Oblique { pair: glass(), radius, mass, normal, damping, friction: &friction }.settled();
                let angle = f64::to_radians(degrees);
                let start = oblique.approach(Vec3::new(-angle.cos(), angle.sin(), 0.0));
                let first = oblique.kinetic(&start);
                let (mut rise, mut lowest) = (0.0_f64, first);
                let end = oblique.integrate(start, *dt, |kinetic, stored| {
                    rise = rise.max(kinetic + stored - lowest);
                    lowest = lowest.min(kinetic + stored);
                });
                // Leapfrog's own error at some thousand steps a contact.
                assert!(rise < 1e-5 * first, "{normal:?} {degrees}: {}", rise / first);
                assert_at_most!(oblique.kinetic(&end), first, "in J");
            }
        }
    }
}
