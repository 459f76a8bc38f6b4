//! Regularized friction without memory.
//!
//! # Equation
//! ```text
//! trial = K |v_t| A Δt;   F = trial where trial < μ_s |F_n|,   else μ_d |F_n|              [A] 20-24
//! ```
//! along the relative tangential velocity of j's surface, on i.
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eqs 20-24.
//!
//! # Symbols
//! | symbol | name in code       | unit | meaning                                    |
//! |--------|--------------------|------|--------------------------------------------|
//! | K      | `stiffness`        | Pa/m | tangential stiffness per contact area      |
//! | v_t    | `slip_speed`       | m/s  | relative tangential speed of the surfaces  |
//! | A      | `area`             | m²   | disc in which the spheres cut each other   |
//! | Δt     | `dt`               | s    | time step                                  |
//! | μ_s    | `static_friction`  | -    | limit of sticking                          |
//! | μ_d    | `dynamic_friction` | -    | force while slipping, over the normal one  |
//! | F_n    | `normal_force`     | N    | elastic normal force of the contact        |
//!
//! # Critical step
//! ω² = 4 (7/2) K A/m* at the overlap of the moment; looked at every step.
//!
//! # Valid when
//! Never in the limit of small steps: the stick force carries Δt, so halving the step halves it and sticking
//! turns into free slip. It is here to reproduce the paper; use `mindlin` otherwise.
//!
//! # Compared with others
//! It is a viscous friction whose viscosity is K A Δt. It holds no load at rest.
//!
//! # In a scenario
//! ```toml
//! [contact.friction.regularized]
//! stiffness = "1e9 Pa/m"
//! static_friction = 0.5
//! dynamic_friction = 0.3
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::contact::friction::{FrictionLaw, Regularized, Sliding};
//! use agglo::contact::{Elastic, PairConstants, ContactGeometry};
//! use agglo::math::Vec3;
//! let law = Regularized {
//!     stiffness: agglo::units::Quantity(1e7), static_friction: 0.4, dynamic_friction: 0.3,
//! };
//! let mut pair = PairConstants::default();
//! law.settle(&mut pair, None);
//! let geometry = ContactGeometry { overlap: 1e-4, ..ContactGeometry::new([1.0; 2], [1.0; 2], [1e7; 2], 2.0) };
//! let (velocity, dt) = (Vec3::new(0.0, 1e-2, 0.0), 1e-4);
//! let force = |load| {
//!     let elastic = Elastic { force: load, ..Default::default() };
//!     law.force(&pair, &geometry, &Sliding { velocity, elastic, dt, ..Default::default() }, &()).0
//! };
//! assert!((force(1e3).y / (1e7 * 1e-2 * geometry.area() * 1e-4) - 1.0).abs() < 1e-14);
//! assert!((force(1e-3).y / (0.3 * 1e-3) - 1.0).abs() < 1e-14);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::law::check_coefficients;
use super::{FrictionLaw, Sliding};
use crate::contact::{ContactGeometry, Elastic, PairConstants};
use crate::law::{Context, Faults, Law};
use crate::math::{Pace, Real, Vector};
use crate::particles::Mixture;
use crate::units::AreaStiffness;

/// Stick force K v A dt up to static friction, then dynamic friction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Regularized {
    /// Tangential compliance constant K.
    pub stiffness: AreaStiffness,
    /// Static friction coefficient.
    pub static_friction: f64,
    /// Dynamic friction coefficient.
    pub dynamic_friction: f64,
}

impl Regularized {
    /// Size of the friction force [N] along the relative tangential velocity, from the contact's `area`
    /// [m²], the slip speed [m/s], the step [s] and the normal force [N]. All of its work is lost.
    #[inline(always)]
    fn size<F: Real>(&self, pair: &PairConstants<F>, area: F, slip_speed: F, dt: F, normal_force: F) -> F {
        let stick = F::of(self.stiffness.si()) * slip_speed * area * dt;
        let load = normal_force.abs();
        F::select(stick.below(pair.static_friction * load), stick, pair.dynamic_friction * load)
    }
}

impl Law for Regularized {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.not_negative("stiffness", self.stiffness);
        check_coefficients(faults, self.static_friction, Some(self.dynamic_friction));
    }

    fn notes(&self, _: &Context<'_>) -> Vec<String> {
        let note = "contact.friction.regularized: its stick force is proportional to the step and does not converge; mindlin does";
        vec![note.to_owned()]
    }

    fn warnings(&self) -> &'static [&'static str] {
        &[
            "contact.friction.regularized: the stick force carries the time step (halving the step halves it), so \
           the answer does not converge",
        ]
    }
}

impl FrictionLaw for Regularized {
    type Memory<F: Real> = ();

    #[inline(always)]
    fn force<F: Real>(
        &self,
        pair: &PairConstants<F>,
        geometry: &ContactGeometry<F>,
        sliding: &Sliding<F>,
        (): &(),
    ) -> (Vector<F>, ()) {
        let speed = sliding.velocity.norm();
        let size = self.size(pair, geometry.area(), speed, sliding.dt, sliding.elastic.force);
        let slips = F::of(0.0).below(speed);
        (Vector::select(slips, sliding.velocity * (size / speed), Vector::default()), ())
    }

    /// That of the stick force. Its dashpot K A Δt becomes critical at the step Δt = 1/√(K A/m_t): that of a spring of
    /// 4 K A.
    fn pace(&self, _: &PairConstants, geometry: &ContactGeometry, _: &Elastic, _: f64) -> Pace {
        Pace::of_spring(4.0 * self.stiffness.si() * geometry.area(), geometry.sliding_mass())
    }

    fn settle(&self, pair: &mut PairConstants, own: Option<&Mixture>) {
        let at_rest = own.and_then(|own| own.static_friction).unwrap_or(self.static_friction);
        pair.static_friction = at_rest;
        let own_in_motion = own.and_then(|own| own.dynamic_friction);
        pair.dynamic_friction = own_in_motion.unwrap_or_else(|| self.dynamic_friction.min(at_rest));
    }

    fn coefficients(&self) -> (f64, Option<f64>) {
        (self.static_friction, Some(self.dynamic_friction))
    }

    /// It grows with the area, without a bound of its own.
    fn outgrows_contact(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::units::Quantity;

    const LAW: Regularized =
        Regularized { stiffness: Quantity(1e7), static_friction: 0.4, dynamic_friction: 0.3 };

    /// The limit lies at μ_s, and what follows at μ_d; the step stands in the stick force.
    #[test]
    fn stick_and_slip() {
        let mut pair = PairConstants::default();
        LAW.settle(&mut pair, None);
        let stick = |speed: f64, dt: f64| LAW.size(&pair, 2e-3, speed, dt, 10.0);
        assert_near!(stick(1e-3, 1e-2), 0.2, 1e-15);
        assert_eq!(stick(1e-3, 1e-2), 2.0 * stick(1e-3, 5e-3));
        assert_near!(stick(0.999 * 0.02, 1e-2), 0.999 * 4.0, 1e-12);
        assert_eq!(stick(1.001 * 0.02, 1e-2), 0.3 * 10.0);
        assert_eq!(LAW.size(&pair, 2e-3, 0.0, 1e-2, 0.0), 0.0);
    }

    /// Along the slip, whose speed counts and not its parts; nothing where nothing slips.
    #[test]
    fn it_points_along_the_slip() {
        let mut pair = PairConstants::default();
        LAW.settle(&mut pair, None);
        let geometry =
            ContactGeometry { overlap: 0.1, ..ContactGeometry::new([1.0; 2], [1.0; 2], [1e7; 2], 2.0) };
        let elastic = Elastic { force: 1e9, ..Default::default() };
        let sliding =
            Sliding { velocity: Vec3::new(0.0, 3e-3, -4e-3), elastic, dt: 1e-2, ..Default::default() };
        let (force, ()) = LAW.force(&pair, &geometry, &sliding, &());
        assert_near_vector!(
            force,
            sliding.velocity * (1e7 * 1e-2 * geometry.area()),
            1e-14 * force.norm(),
            "in N"
        );
        let (none, ()) = LAW.force(&pair, &geometry, &Sliding { velocity: Vec3::ZERO, ..sliding }, &());
        assert_eq!(none, Vec3::ZERO);
    }

    #[test]
    fn pairs_have_their_own_coefficients() {
        let own = |at_rest, in_motion| Mixture {
            between: ["a".to_owned(), "b".to_owned()],
            restitution: None,
            static_friction: at_rest,
            dynamic_friction: in_motion,
        };
        let cases = [
            (own(None, None), [0.4, 0.3]),
            (own(Some(0.1), None), [0.1, 0.1]),
            (own(Some(0.1), Some(0.05)), [0.1, 0.05]),
            (own(None, Some(0.2)), [0.4, 0.2]),
        ];
        for (own, wanted) in cases {
            let mut pair = PairConstants::default();
            LAW.settle(&mut pair, Some(&own));
            assert_eq!([pair.static_friction, pair.dynamic_friction], wanted, "{own:?}");
        }
    }
}
