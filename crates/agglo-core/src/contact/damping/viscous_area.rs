//! A dashpot proportional to the contact area.
//!
//! # Equation
//! ```text
//! F_i = c A (v_jn - v_in) n                                                               [A] 19
//! ```
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eq. 19.
//!
//! # Symbols
//! | symbol | name in code  | unit   | meaning                                    |
//! |--------|---------------|--------|--------------------------------------------|
//! | c      | `coefficient` | Pa s/m | damping per contact area                   |
//! | A      | `geometry.area()`| m²     | disc in which the spheres cut each other   |
//! | v_n    |               | m/s    | velocity along the normal from i to j      |
//!
//! # Critical step
//! Γ = c A/m* at the overlap of the moment; looked at every step.
//!
//! # Valid when
//! c is fitted. It is a viscous loss c A v_n² [W]; the restitution it gives depends on size and speed.
//!
//! # Compared with others
//! Where c A exceeds the critical damping 2 √(k m*), grains creep apart instead of rebounding.
//!
//! # In a scenario
//! ```toml
//! [contact.damping.viscous_area]
//! coefficient = "1e5 Pa s/m"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::contact::{Elastic, PairConstants, ContactGeometry, damping::{DampingLaw, ViscousArea}};
//! let law = ViscousArea { coefficient: agglo::units::Quantity(1e5) };
//! let geometry = ContactGeometry::new([1.0, 1.0], [1.0, 1.0], [1e7, 1e7], 1.6);
//! let dashpot = law.coefficient(&PairConstants::default(), &geometry, &Elastic::default());
//! assert!((dashpot / (1e5 * std::f64::consts::PI * 0.36) - 1.0).abs() < 1e-14);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::DampingLaw;
use crate::contact::{ContactGeometry, Elastic, PairConstants};
use crate::law::{Context, Faults, Law};
use crate::math::Real;
use crate::units::AreaDamping;

/// F = c A times the speed of approach.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ViscousArea {
    /// c, per contact area.
    pub coefficient: AreaDamping,
}

impl Law for ViscousArea {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.not_negative("coefficient", self.coefficient);
    }
}

impl DampingLaw for ViscousArea {
    const TAKES_STIFFNESS: bool = false;

    #[inline(always)]
    fn coefficient<F: Real>(&self, _: &PairConstants<F>, geometry: &ContactGeometry<F>, _: &Elastic<F>) -> F {
        F::of(self.coefficient.si()) * geometry.area()
    }

    /// It grows with the area, without a bound of its own.
    fn outgrows_contact(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::collision::HeadOn;
    use crate::contact::normal::{Normal, StrainPower};
    use crate::contact::{Damping, PairConstants};
    use crate::units::Quantity;

    /// First order in c: the loss is 2 ∫ c A v dδ over one leg of the undamped impact, with m* v²/2 = E0 - U(δ).
    #[test]
    fn weak_damping_takes_the_work_of_the_undamped_path() {
        let normal = Normal::StrainPower(StrainPower { exponent: 2.0 });
        let (pair, geometry) =
            (PairConstants::default(), ContactGeometry::new([0.05; 2], [3.0; 2], [1.5e7; 2], 0.1));
        let (speed, weak) = (0.05, 1e-2);
        let law = Damping::ViscousArea(ViscousArea { coefficient: Quantity(weak) });
        let head_on = HeadOn { pair, geometry, normal: &normal, damping: Some(&law), speed };
        let rebound = head_on.integrate(1e-5);
        let energy = 0.5 * geometry.effective_mass * speed * speed;
        let (steps, deepest) = (200_000, rebound.largest_overlap);
        let mut work = 0.0;
        for k in 0..steps {
            let overlap = deepest * (f64::from(k) + 0.5) / f64::from(steps);
            let here = ContactGeometry { overlap, ..geometry };
            let left = 1.0 - normal.energy(&pair, &here) / energy;
            work += 2.0 * weak * here.area() * speed * left.max(0.0).sqrt() * deepest / f64::from(steps);
        }
        let lost = energy * (1.0 - rebound.restitution * rebound.restitution);
        // Second order in c is the lost part itself; the rest is quadrature near the turning point.
        let part = work / energy;
        assert!((1e-8..1e-4).contains(&part), "{part}");
        assert!((lost / work - 1.0).abs() < 1e-3, "{lost} {work}");
    }
}
