//! Drag of the medium and what goes beyond Stokes.
//!
//! # Equation
//! ```text
//! F = 6 π η R φ (v_medium - v)                                                            [A] 30
//! φ = 1 (Stokes)   or   φ = 1 + 0.15 Re^0.687 (Schiller and Naumann),   Re = 2 R ρ |v_medium - v|/η
//! m_added = C_a ρ (4/3) π R³                                                              A10
//! ```
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eq. 30; L. Schiller and A. Naumann, Z. VDI 77, 318 (1935).
//!
//! # Symbols
//! | symbol   | name in code        | unit  | meaning                                             |
//! |----------|---------------------|-------|-----------------------------------------------------|
//! | η        | `medium.viscosity`  | Pa s  | dynamic viscosity; c_e of the paper                 |
//! | ρ        | `medium.density`    | kg/m³ | density of the medium                               |
//! | v_medium | `medium_velocity`   | m/s   | velocity of the medium where the grain is           |
//! | Re       | `reynolds`          | -     | Reynolds number of the grain's diameter             |
//! | C_a      | `added_mass`        | -     | 1/2 for a sphere in an ideal fluid                  |
//!
//! # Valid when
//! Stokes: Re ≪ 1 (2 % off at Re = 0.1, 15 % at 1). Schiller and Naumann: Re up to 1000, within 5 %. Grains do
//! not feel one another's wakes: dilute suspensions. History force and lift are left out.
//!
//! # Compared with others
//! Drag coefficient 24 φ/Re, as in the usual CFD-DEM codes.
//!
//! # Example
//! ```
//! use agglo::{acoustics::Medium, fields::{Drag, DragLaw}, math::Vec3};
//! let drag = Drag { law: DragLaw::Stokes, medium_velocity: None, added_mass: 0.5 };
//! let force = drag.force(&Medium::default(), 1e-5, Vec3::new(0.01, 0.0, 0.0), Vec3::ZERO, 0.0);
//! assert!((force.x / (-6.0 * std::f64::consts::PI * 1e-3 * 1e-5 * 0.01) - 1.0).abs() < 1e-14);
//! ```

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::FieldVector;
use super::expression::evaluate;
use crate::acoustics::Medium;
use crate::math::Vec3;

/// Drag on every grain; viscosity and density are the medium's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Drag {
    /// The law.
    pub law: DragLaw,
    /// Velocity of the medium; at rest if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub medium_velocity: Option<FieldVector<0, 1, -1, 0, 0>>,
    /// Part of the displaced mass that moves with a grain (1/2 for a sphere in an ideal fluid).
    #[serde(default)]
    pub added_mass: f64,
}

/// The closed set of drag laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DragLaw {
    /// 6 π η R v: Reynolds number well below 1.
    Stokes,
    /// Schiller and Naumann's factor 1 + 0.15 Re^0.687 on Stokes' law, up to Re = 1000.
    SchillerNaumann,
}

impl Drag {
    /// Velocity [m/s] of the medium relative to a grain with this velocity, position [m] and time [s].
    #[inline]
    pub fn slip(&self, velocity_of_grain: Vec3, position: Vec3, time: f64) -> Vec3 {
        let medium =
            self.medium_velocity.as_ref().map_or(Vec3::ZERO, |field| evaluate(field, position, time));
        medium - velocity_of_grain
    }

    /// Force [N] on a grain of this radius [m] and velocity [m/s] at a point [m] and time [s].
    ///
    /// It takes `-force . velocity` [W] from the grain (less than nothing where the medium drives it).
    #[inline]
    pub fn force(
        &self,
        medium: &Medium,
        radius: f64,
        velocity_of_grain: Vec3,
        position: Vec3,
        time: f64,
    ) -> Vec3 {
        let slip = self.slip(velocity_of_grain, position, time);
        slip * self.coefficient(medium, radius, slip)
    }

    /// Force over slip [N s/m] at a slip velocity [m/s].
    #[inline]
    pub fn coefficient(&self, medium: &Medium, radius: f64, slip: Vec3) -> f64 {
        let stokes = 6.0 * PI * medium.viscosity.si() * radius;
        match self.law {
            DragLaw::Stokes => stokes,
            DragLaw::SchillerNaumann => {
                stokes * (1.0 + 0.15 * reynolds(medium, radius, slip.norm()).powf(0.687))
            }
        }
    }

    /// Reynolds number [-] of a grain: above 1 Stokes' law, above 1000 either law is out of its range.
    #[inline]
    pub fn reynolds(
        &self,
        medium: &Medium,
        radius: f64,
        velocity_of_grain: Vec3,
        position: Vec3,
        time: f64,
    ) -> f64 {
        reynolds(medium, radius, self.slip(velocity_of_grain, position, time).norm())
    }

    /// Mass [kg] of medium that moves with a grain of this radius [m].
    #[inline]
    pub fn added_mass(&self, medium: &Medium, radius: f64) -> f64 {
        self.added_mass * medium.density.si() * 4.0 / 3.0 * PI * radius * radius * radius
    }
}

/// Reynolds number; 0 in a medium without viscosity, which exerts no drag.
#[inline]
fn reynolds(medium: &Medium, radius: f64, speed: f64) -> f64 {
    medium.reynolds_number(radius, speed).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::Expression;

    fn drag(law: DragLaw) -> Drag {
        Drag { law, medium_velocity: None, added_mass: 0.5 }
    }

    /// Weight less buoyancy is carried at (2/9) Δρ g R²/η.
    #[test]
    fn val_stokes_1851_terminal_velocity() {
        let (medium, radius, excess) = (Medium::default(), 5e-6, 1500.0);
        let speed = 2.0 / 9.0 * excess * 9.81 * radius * radius / 1e-3;
        let weight = excess * 9.81 * 4.0 / 3.0 * PI * radius * radius * radius;
        let force =
            drag(DragLaw::Stokes).force(&medium, radius, Vec3::new(0.0, 0.0, -speed), Vec3::ZERO, 0.0);
        assert!((force.z / weight - 1.0).abs() < 1e-14);
        assert_eq!((force.x, force.y), (0.0, 0.0));
    }

    /// Drag coefficient 24 (1 + 0.15 Re^0.687)/Re: 27.6 at Re = 1, 4.1511 at 10, 1.0917 at 100, 0.43829 at 1000.
    #[test]
    fn schiller_naumann_drag_coefficients() {
        let (medium, radius) = (Medium::default(), 1e-3);
        for (wanted, number) in [(27.6, 1.0), (4.151_066, 10.0), (1.091_731, 100.0), (0.438_288, 1000.0)] {
            let speed = number * 1e-3 / (2.0 * radius * 1000.0);
            let velocity = Vec3::new(0.0, speed, 0.0);
            let law = drag(DragLaw::SchillerNaumann);
            let force = law.force(&medium, radius, velocity, Vec3::ZERO, 0.0);
            let coefficient = -force.y / (0.5 * 1000.0 * speed * speed * PI * radius * radius);
            assert!((law.reynolds(&medium, radius, velocity, Vec3::ZERO, 0.0) / number - 1.0).abs() < 1e-14);
            assert!((coefficient / wanted - 1.0).abs() < 1e-5, "{number}: {coefficient}");
        }
        assert_eq!(
            drag(DragLaw::SchillerNaumann).force(&medium, radius, Vec3::ZERO, Vec3::ZERO, 0.0),
            Vec3::ZERO
        );
    }

    #[test]
    fn a_moving_medium_drives_the_grain() {
        let field = ["2*y", "0 m/s", "t"].map(|text| Expression::new(text).unwrap());
        let law = Drag { medium_velocity: Some(field), ..drag(DragLaw::Stokes) };
        let velocity = Vec3::new(1.0, 0.0, 3.0);
        let at_rest = law.force(&Medium::default(), 1e-3, velocity, Vec3::new(0.0, 0.5, 0.0), 3.0);
        assert_eq!(at_rest, Vec3::ZERO);
        assert!((law.added_mass(&Medium::default(), 1e-3) / (2.0 / 3.0 * PI * 1e-6) - 1.0).abs() < 1e-14);
    }
}
