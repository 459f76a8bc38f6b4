//! Electric and magnetic force on charges.
//!
//! # Equation
//! ```text
//! F = q (E + v × B)                                                                       [A] 27
//! ```
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eq. 27; J. D. Jackson, *Classical Electrodynamics*.
//!
//! # Symbols
//! | symbol | name in code            | unit | meaning                              |
//! |--------|-------------------------|------|--------------------------------------|
//! | q      | `charge`                | C    | charge of the grain                  |
//! | v      | `velocity`              | m/s  | velocity of its center               |
//! | E      | `electric_field`        | V/m  | applied electric field               |
//! | B      | `magnetic_flux_density` | T    | applied magnetic flux density        |
//!
//! # Critical step
//! ω² = q times the gradient of E, over m, and Γ = q B/m; looked at every 100 steps.
//!
//! # Valid when
//! Fields are applied from outside and speeds far below that of light; the fields of moving grains are left
//! out (that of resting ones is `coulomb` of the near field). The magnetic part does no work.
//!
//! # Compared with others
//! `efield` and, for B, user code in LAMMPS. The rotation about B is solved for (trapezoidal rule), as J. P. Boris'
//! pusher does: it keeps the speed whatever the step. The automatic step resolves the period 2 π m/(q B).
//!
//! # In a scenario
//! ```toml
//! [fields.lorentz]
//! electric_field = ["1 kV/m", "0 V/m", "0 V/m"]
//! magnetic_flux_density = ["0 T", "0 T", "0.1*sin(2*pi*50*t)"]
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::{fields::{Expression, FieldLaw, Grain, Lorentz}, math::Vec3};
//! let field = ["0 T", "0 T", "2 T"].map(|text| Expression::new(text).unwrap());
//! let lorentz = Lorentz { electric_field: None, magnetic_flux_density: Some(field) };
//! let grain = Grain { charge: 0.5, velocity: Vec3::new(3.0, 0.0, 0.0), ..Default::default() };
//! assert_eq!(lorentz.force(&grain), Vec3::new(0.0, -3.0, 0.0));
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::expression::evaluate;
use super::{Channel, FieldLaw, FieldVector, Grain};
use crate::law::{Context, Faults, Law};
use crate::math::{Pace, Vec3};

/// q (E + v x B).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lorentz {
    /// E, as quantities or formulas; one of the two must be given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub electric_field: Option<FieldVector<1, 1, -3, 0, -1>>,
    /// B, as quantities or formulas.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub magnetic_flux_density: Option<FieldVector<1, 0, -2, 0, -1>>,
}

impl Law for Lorentz {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        if self.electric_field.is_none() && self.magnetic_flux_density.is_none() {
            let message = "has neither electric_field nor magnetic_flux_density".to_owned();
            faults.fail_with("", message, "give one of them or remove the table");
        }
    }
}

impl FieldLaw for Lorentz {
    const CHANNEL: Channel = Channel::Field;

    #[inline]
    fn force(&self, grain: &Grain) -> Vec3 {
        let Grain { charge, velocity, position, time, .. } = *grain;
        if charge == 0.0 {
            return Vec3::ZERO;
        }
        let mut field = self.electric_field.as_ref().map_or(Vec3::ZERO, |e| evaluate(e, position, time));
        if let Some(flux_density) = &self.magnetic_flux_density {
            field += velocity.cross(evaluate(flux_density, position, time));
        }
        field * charge
    }

    /// q B.
    #[inline]
    fn turning(&self, grain: &Grain) -> Vec3 {
        let Grain { charge, position, time, .. } = *grain;
        match &self.magnetic_flux_density {
            Some(flux_density) if charge != 0.0 => evaluate(flux_density, position, time) * charge,
            _ => Vec3::ZERO,
        }
    }

    fn turns(&self) -> bool {
        self.magnetic_flux_density.is_some()
    }

    fn is_by_charge(&self) -> bool {
        true
    }

    /// By the frequency q B/m of rotation, and by the gradient of E.
    fn pace(&self, grain: &Grain, mass: f64) -> Pace {
        let Grain { charge, radius, position, time, .. } = *grain;
        let turning = Pace::of_dashpot(self.turning(grain).norm(), mass);
        let Some(field) =
            self.electric_field.as_ref().filter(|field| field.iter().any(|e| e.constant().is_none()))
        else {
            return turning;
        };
        let step = 1e-2 * radius;
        let square = Vec3::AXES.map(|axis| {
            let (ahead, behind) = (position + axis * step, position - axis * step);
            (evaluate(field, ahead, time) - evaluate(field, behind, time)).norm_squared()
        });
        let gradient = square.iter().sum::<f64>().sqrt() / (2.0 * step);
        turning + Pace::of_spring(charge * gradient, mass)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::Expression;

    /// On the circle of radius m v/(q B) the force is m v²/r toward its center.
    #[test]
    fn cyclotron_radius() {
        let flux_density = ["0 T", "0 T", "0.1 T"].map(|text| Expression::new(text).unwrap());
        let law = Lorentz { electric_field: None, magnetic_flux_density: Some(flux_density) };
        let (charge, mass, speed) = (2e-9, 3e-12, 5.0);
        let radius = mass * speed / (charge * 0.1);
        for angle in [0.0_f64, 1.0, 4.0] {
            let out = Vec3::new(angle.cos(), angle.sin(), 0.0);
            // A positive charge goes round clockwise, seen against B.
            let velocity = out.cross(Vec3::AXES[2]) * speed;
            let grain = Grain { charge, velocity, position: out * radius, ..Default::default() };
            let force = law.force(&grain);
            let centripetal = out * (-mass * speed * speed / radius);
            assert_close_vector!(force, centripetal, 1e-14, "in N");
            assert_below!(force.dot(velocity).abs(), 1e-14 * force.norm() * speed, "in N");
        }
    }

    #[test]
    fn electric_force_follows_its_formula() {
        let field = ["1 kV/m", "0 V/m", "100*sin(t)*z"].map(|text| Expression::new(text).unwrap());
        let law = Lorentz { electric_field: Some(field), magnetic_flux_density: None };
        let position = Vec3::new(0.0, 0.0, 3.0);
        let grain =
            Grain { charge: -2e-9, velocity: Vec3::AXES[0], position, time: 0.5, ..Default::default() };
        let force = law.force(&grain);
        let by_hand = Vec3::new(1000.0, 0.0, 300.0 * 0.5_f64.sin()) * -2e-9;
        assert_near_vector!(force, by_hand, 1e-20, "in N");
        assert_eq!(law.force(&Grain { charge: 0.0, ..grain }), Vec3::ZERO);
    }

    /// The slope of E is taken over what a grain spans, however heavy it is: E = sin(k x) with k = 2 π/1 cm has the slope k at 0,
    /// and over a hundredth of R = 1 mm to both sides 1 - (k R/100)²/6 of it.
    #[test]
    fn pace_in_a_field_that_depends_on_place() {
        let field = ["sin(2*pi*x/0.01)", "0 V/m", "0 V/m"].map(|text| Expression::new(text).unwrap());
        let law = Lorentz { electric_field: Some(field), magnetic_flux_density: None };
        let slope = std::f64::consts::TAU / 0.01;
        let within = 1.0 - (slope * 1e-5).powi(2) / 6.0;
        for mass in [1e-9, 2.0] {
            let grain = Grain { charge: 3e-6, radius: 1e-3, ..Default::default() };
            let pace = law.pace(&grain, mass);
            assert_close!(pace.square, 3e-6 * slope * within / mass, 1e-9, "in 1/s², a grain of {mass} kg");
        }
    }
}
