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
//! use agglo::contact::{PairConstants, friction::Regularized};
//! let law = Regularized {
//!     stiffness: agglo::units::Quantity(1e7), static_friction: 0.4, dynamic_friction: 0.3,
//! };
//! let (area, speed, dt) = (1e-3, 1e-2, 1e-4);
//! let force = |load| law.force(&PairConstants::default(), area, speed, dt, load);
//! assert_eq!(force(1.0), 1e7 * 1e-2 * 1e-3 * 1e-4);
//! assert_eq!(force(0.01), 0.3 * 0.01);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::contact::{PairConstants, Touch};
use crate::math::Pace;
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
    #[inline]
    pub fn force(&self, pair: &PairConstants, area: f64, slip_speed: f64, dt: f64, normal_force: f64) -> f64 {
        let stick = self.stiffness.si() * slip_speed * area * dt;
        let load = normal_force.abs();
        let at_rest = pair.static_friction.unwrap_or(self.static_friction);
        if stick < at_rest * load {
            return stick;
        }
        pair.dynamic_friction.unwrap_or_else(|| self.dynamic_friction.min(at_rest)) * load
    }

    /// How fast the stick force is at this overlap. Its dashpot K A Δt becomes critical at the step Δt = 1/√(K A/m_t):
    /// that of a spring of 4 K A.
    #[inline]
    pub fn pace(&self, touch: &Touch) -> Pace {
        Pace::of_spring(4.0 * self.stiffness.si() * touch.area(), touch.sliding_mass())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Quantity;

    const LAW: Regularized =
        Regularized { stiffness: Quantity(1e7), static_friction: 0.4, dynamic_friction: 0.3 };

    /// The limit lies at μ_s, and what follows at μ_d; the step stands in the stick force.
    #[test]
    fn stick_and_slip() {
        let pair = PairConstants::default();
        let stick = |speed: f64, dt: f64| LAW.force(&pair, 2e-3, speed, dt, 10.0);
        assert_near!(stick(1e-3, 1e-2), 0.2, 1e-15);
        assert_eq!(stick(1e-3, 1e-2), 2.0 * stick(1e-3, 5e-3));
        assert_near!(stick(0.999 * 0.02, 1e-2), 0.999 * 4.0, 1e-12);
        assert_eq!(stick(1.001 * 0.02, 1e-2), 0.3 * 10.0);
        assert_eq!(LAW.force(&pair, 2e-3, 0.0, 1e-2, 0.0), 0.0);
    }

    #[test]
    fn pairs_have_their_own_coefficients() {
        let own = PairConstants { static_friction: Some(0.1), ..Default::default() };
        assert_eq!(LAW.force(&own, 1.0, 1.0, 1.0, 2.0), 0.1 * 2.0);
        let own = PairConstants { dynamic_friction: Some(0.2), ..own };
        assert_eq!(LAW.force(&own, 1.0, 1.0, 1.0, 2.0), 0.2 * 2.0);
    }
}
