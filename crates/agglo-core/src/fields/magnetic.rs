//! Magnetic force on magnetizable grains.
//!
//! # Equation
//! ```text
//! F = ∇(γ B·B),   ∂(B·B)/∂x ≈ (B₊ + B₋)·(B₊ - B₋)/(2 h),   B± = B(r ± h e_x)               [A] 29
//! ```
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eq. 29.
//!
//! # Symbols
//! | symbol | name in code            | unit | meaning                                              |
//! |--------|-------------------------|------|------------------------------------------------------|
//! | γ      | `magnetizability`       | J/T² | χ V/(2 μ0) for a weakly magnetic grain of volume V   |
//! | B      | `magnetic_flux_density` | T    | applied flux density                                 |
//! | h      | `difference`            | m    | half the width of the central difference             |
//!
//! # Critical step
//! ω² = gradient of the force over m; looked at every 100 steps.
//!
//! # Valid when
//! Grains do not magnetize one another. The difference is exact, up to round-off, where B is linear in space
//! (a uniform gradient): B·B is then quadratic. Otherwise its error is h²/6 times the third derivative.
//!
//! # Compared with others
//! γ is the same for all grains, as in the paper: it does not grow with their volume.
//!
//! # In a scenario
//! ```toml
//! [fields.magnetic]
//! magnetizability = "1e-8 J/T^2"
//! magnetic_flux_density = ["0 T", "0 T", "0.1 + 2*z"]
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::{fields::{Expression, FieldLaw, Grain, Magnetic}, units::Quantity};
//! let field = ["0 T", "0 T", "0.5 + 10*z"].map(|text| Expression::new(text).unwrap());
//! let law = Magnetic { magnetizability: Quantity(2.0), magnetic_flux_density: field, difference: None };
//! let force = law.force(&Grain { radius: 1e-3, ..Default::default() });
//! assert!((force.z - 2.0 * 2.0 * 0.5 * 10.0).abs() < 1e-9);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::expression::evaluate;
use super::{Channel, FieldLaw, FieldVector, Grain};
use crate::law::{Context, Faults, Law};
use crate::math::{Pace, Vec3};
use crate::units::{Length, Magnetizability};

/// Force up the gradient of B.B.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Magnetic {
    /// gamma.
    pub magnetizability: Magnetizability,
    /// B, as quantities or formulas.
    pub magnetic_flux_density: FieldVector<1, 0, -2, 0, -1>,
    /// Distance over which the gradient is taken; a ten-thousandth of a grain's radius if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub difference: Option<Length>,
}

impl Law for Magnetic {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        if let Some(difference) = self.difference {
            faults.positive("difference", difference);
        }
    }
}

impl FieldLaw for Magnetic {
    const CHANNEL: Channel = Channel::Field;

    #[inline]
    fn force(&self, grain: &Grain) -> Vec3 {
        let Grain { radius, position, time, .. } = *grain;
        let field = &self.magnetic_flux_density;
        if field.iter().all(|component| component.constant().is_some()) {
            return Vec3::ZERO;
        }
        let step = self.difference.map_or(1e-4 * radius, Length::si);
        let gradient = Vec3::AXES.map(|axis| {
            let ahead = evaluate(field, position + axis * step, time);
            let behind = evaluate(field, position - axis * step, time);
            (ahead + behind).dot(ahead - behind) / (2.0 * step)
        });
        Vec3::from(gradient) * self.magnetizability.si()
    }

    /// By the gradient of the force.
    fn pace(&self, grain: &Grain, mass: f64) -> Pace {
        let Grain { radius, position, .. } = *grain;
        let at = |position: Vec3| self.force(&Grain { position, ..*grain });
        let square = Vec3::AXES.map(|axis| {
            let (ahead, behind) = (position + axis * radius, position - axis * radius);
            (at(ahead) - at(behind)).norm_squared()
        });
        Pace::of_spring(square.iter().sum::<f64>().sqrt() / (2.0 * radius), mass)
    }
}

impl Magnetic {
    /// Potential energy -γ B·B [J] of a grain at a point [m] and time [s].
    #[inline]
    pub fn energy(&self, position: Vec3, time: f64) -> f64 {
        -self.magnetizability.si() * evaluate(&self.magnetic_flux_density, position, time).norm_squared()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::Expression;
    use crate::units::Quantity;

    fn law(text: [&str; 3]) -> Magnetic {
        let magnetic_flux_density = text.map(|text| Expression::new(text).unwrap());
        Magnetic { magnetizability: Quantity(3e-6), magnetic_flux_density, difference: None }
    }

    fn grain(radius: f64, position: Vec3, time: f64) -> Grain {
        Grain { position, radius, time, ..Default::default() }
    }

    /// B = (a + g x, -g y, 0): ∇(B·B) = 2 g (a + g x, g y, 0). Round-off: 1e-16 (B/g)/h = 1e-16 * 0.1/1e-8.
    #[test]
    fn uniform_gradients_are_exact() {
        let force = law(["0.2 + 3*x", "-3*y", "0 T"]).force(&grain(1e-4, Vec3::new(0.05, 0.02, 0.7), 0.0));
        let by_hand = Vec3::new(2.0 * 3.0 * (0.2 + 0.15), 2.0 * 9.0 * 0.02, 0.0) * 3e-6;
        assert!((force - by_hand).norm() < 1e-8 * by_hand.norm(), "{force:?} {by_hand:?}");
    }

    #[test]
    fn constant_fields_do_not_pull() {
        assert_eq!(law(["1 T", "0 T", "2 T"]).force(&grain(1e-3, Vec3::ZERO, 0.0)), Vec3::ZERO);
    }

    /// Against the central difference of the energy, over a longer step: (1e-4)²/6 of the third derivative.
    #[test]
    fn force_is_minus_the_gradient_of_energy() {
        let law = law(["sin(3*x)*cos(t)", "y*z", "exp(-z)"]);
        let (at, time) = (Vec3::new(0.3, -0.2, 0.5), 0.4);
        let force = law.force(&grain(1e-2, at, time));
        for axis in Vec3::AXES {
            let h = axis * 1e-4;
            let slope = (law.energy(at + h, time) - law.energy(at - h, time)) / 2e-4;
            assert_below!((force.dot(axis) + slope).abs(), 1e-7 * force.norm());
        }
    }
}
