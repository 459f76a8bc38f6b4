//! What a medium does to a grain: drag, the push of a medium that accelerates, and resistance to rotation.
//!
//! # Equation
//! ```text
//! F = 6 π η R φ (u - v) + (1 + C_a) m_f Du/Dt                                              [A] 30, A10
//! φ = 1 (Stokes)   or   φ = 1 + 0.15 Re^0.687 (Schiller and Naumann),   Re = 2 R ρ |u - v|/η  A10
//! M = 8 π η R³ (∇ × u/2 - w)                                                               A10
//! m_f = ρ (4/3) π R³,   m_added = C_a m_f,   Du/Dt = ∂u/∂t + (u · ∇) u
//! ```
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eq. 30; L. Schiller and A. Naumann, Z. VDI 77, 318 (1935);
//! M. R. Maxey and J. J. Riley, Phys. Fluids 26, 883 (1983); G. Kirchhoff (1876) for the torque.
//!
//! # Symbols
//! | symbol   | name in code        | unit  | meaning                                             |
//! |----------|---------------------|-------|-----------------------------------------------------|
//! | η        | `medium.viscosity`  | Pa s  | dynamic viscosity; c_e of the paper                 |
//! | ρ        | `medium.density`    | kg/m³ | density of the medium                               |
//! | u        | `medium_velocity`   | m/s   | velocity of the medium where the grain is           |
//! | m_f      | `displaced_mass`    | kg    | mass of the medium that the grain displaces         |
//! | Re       | `reynolds`          | -     | Reynolds number of the grain's diameter             |
//! | C_a      | `added_mass`        | -     | 1/2 for a sphere in an ideal fluid                  |
//! | w        | `angular_velocity`              | rad/s | angular velocity of the grain                       |
//!
//! # Critical step
//! Γ = a sixth of 6 π η R φ/m (1.687 times that for `schiller_naumann`) plus the gradient of the flow, or a sixth
//! of 15 η/(ρ R²) of rotation; looked at every 100 steps.
//!
//! # Valid when
//! Stokes: Re ≪ 1 (2 % off at Re = 0.1, 15 % at 1). Schiller and Naumann: Re up to 1000, within 5 %; the torque is
//! that of slow rotation with both. The flow hardly changes over a grain. Grains do not feel one another's wakes, nor
//! do they shield one another: a dense agglomerate's inside bears less than this says. History force and lift are left
//! out. m_f Du/Dt is the pressure of the flow alone: a medium at rest under gravity carries grains by
//! `fields.gravity.buoyancy`, and the two do not overlap. A uniform, steady `medium_velocity` has no Du/Dt.
//!
//! # Compared with others
//! Drag coefficient 24 φ/Re, as in the usual CFD-DEM codes. Without m_f Du/Dt, which many leave out, a grain of the
//! liquid's own density does not follow the liquid. Drag is solved for (trapezoidal rule): no step is too long for it
//! to stay stable, and the automatic step holds its decay to (S2) of `Pace`.
//!
//! # In a scenario
//! ```toml
//! [medium]
//! density = "1000 kg/m3"
//! viscosity = "1 mPa s"
//!
//! [fields.drag]
//! law = "schiller_naumann"
//! medium_velocity = ["0.1*z", "0 m/s", "0 m/s"]
//! added_mass = 0.5
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::{acoustics::Medium, fields::{Drag, DragLaw, FlowAt}, math::Vec3};
//! let drag = Drag { law: DragLaw::Stokes, medium_velocity: None, added_mass: 0.5 };
//! let force = drag.force(&Medium::default(), 1e-5, Vec3::new(0.01, 0.0, 0.0), &FlowAt::default());
//! assert!((force.x / (-6.0 * std::f64::consts::PI * 1e-3 * 1e-5 * 0.01) - 1.0).abs() < 1e-14);
//! ```

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FlowAt, FlowField};
use crate::acoustics::Medium;
use crate::law::{Context, Faults, Law};
use crate::math::{Pace, Vec3};

/// Drag on every grain; viscosity and density are the medium's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Drag {
    /// The law.
    pub law: DragLaw,
    /// Velocity of the medium, as quantities or formulas; at rest if left out. Where it changes in time or along
    /// the way, grains feel the liquid's acceleration, and its vorticity turns them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub medium_velocity: Option<FlowField>,
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

/// How far a law of drag holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Validity {
    /// Largest Reynolds number.
    pub reynolds: f64,
    /// Up to where it holds, in words.
    pub holds: &'static str,
    /// The warning of a run that goes beyond.
    pub warning: &'static str,
}

impl DragLaw {
    /// How far it holds: Stokes' law is 15 % off at a Reynolds number of 1, Schiller and Naumann's is fitted up to 1000.
    pub fn validity(self) -> Validity {
        match self {
            Self::Stokes => Validity {
                reynolds: 1.0,
                holds: "stokes holds below 1, schiller_naumann up to 1000",
                warning: "fields.drag: a grain's Reynolds number is above 1, where stokes is too weak; schiller_naumann \
                          holds up to 1000",
            },
            Self::SchillerNaumann => Validity {
                reynolds: 1000.0,
                holds: "schiller_naumann holds up to 1000",
                warning: "fields.drag: a grain's Reynolds number is above 1000, where schiller_naumann does not hold",
            },
        }
    }
}

lone_law!(Drag at "fields", drag);

impl Law for Drag {
    const WORDS: &'static [&'static str] = &["stokes", "schiller_naumann"];

    fn faults(&self, faults: &mut Faults, context: &Context<'_>) {
        faults.zero_or_more("added_mass", self.added_mass);
        if context.medium.viscosity.si() == 0.0 {
            let message = "the medium has no viscosity: there would be no drag".to_owned();
            let help = "give medium.viscosity, such as \"1 mPa s\" for water, or remove [fields.drag]";
            faults.fail_with("law", message, help);
        }
    }
}

impl Drag {
    /// Force [N] on a grain of this radius [m] and velocity [m/s] in a flow.
    ///
    /// It takes `-force . velocity` [W] from the grain (less than nothing where the medium drives it).
    #[inline]
    pub fn force(&self, medium: &Medium, radius: f64, velocity: Vec3, flow: &FlowAt) -> Vec3 {
        let slip = flow.velocity - velocity;
        let pushed = (1.0 + self.added_mass) * displaced_mass(medium, radius);
        slip * self.coefficient(medium, radius, slip) + flow.acceleration * pushed
    }

    /// Moment [N m] on a grain of this radius [m] and angular velocity [rad/s] in a flow.
    #[inline]
    pub fn torque(medium: &Medium, radius: f64, angular_velocity: Vec3, flow: &FlowAt) -> Vec3 {
        (flow.vorticity * 0.5 - angular_velocity) * rotational_drag(medium, radius)
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

    /// How fast a grain of this radius [m], inertial mass [kg] and moment of inertia [kg m²] comes to rest in the
    /// medium, at a slip velocity [m/s]: by its rotation, or by its motion and the change of the flow along its way.
    pub fn pace(&self, medium: &Medium, radius: f64, inertia: [f64; 2], slip: Vec3, flow: &FlowAt) -> Pace {
        // Schiller and Naumann's force grows like slip^1.687 at most; what the slope of its end leaves out is within that.
        let steeper = if self.law == DragLaw::Stokes { 1.0 } else { 1.687 };
        let motion = Pace::of_solved_drag(steeper * self.coefficient(medium, radius, slip), inertia[0]);
        let carried = Pace { square: 0.0, rate: flow.gradient };
        (motion + carried).max(Pace::of_solved_drag(rotational_drag(medium, radius), inertia[1]))
    }

    /// Reynolds number [-] of a grain: above 1 Stokes' law, above 1000 either law is out of its range.
    #[inline]
    pub fn reynolds(medium: &Medium, radius: f64, velocity: Vec3, flow: &FlowAt) -> f64 {
        reynolds(medium, radius, (flow.velocity - velocity).norm())
    }

    /// Mass [kg] of medium that moves with a grain of this radius [m].
    #[inline]
    pub fn added_mass(&self, medium: &Medium, radius: f64) -> f64 {
        self.added_mass * displaced_mass(medium, radius)
    }
}

/// Torque over angular velocity [N m s] of a sphere that spins in the medium.
#[inline]
pub fn rotational_drag(medium: &Medium, radius: f64) -> f64 {
    8.0 * PI * medium.viscosity.si() * radius * radius * radius
}

/// Mass [kg] of the medium that a grain of this radius [m] displaces.
#[inline]
fn displaced_mass(medium: &Medium, radius: f64) -> f64 {
    medium.density.si() * 4.0 / 3.0 * PI * radius * radius * radius
}

/// Reynolds number; 0 in a medium without viscosity, which exerts no drag.
#[inline]
fn reynolds(medium: &Medium, radius: f64, speed: f64) -> f64 {
    medium.reynolds_number(radius, speed).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const REST: FlowAt =
        FlowAt { velocity: Vec3::ZERO, acceleration: Vec3::ZERO, vorticity: Vec3::ZERO, gradient: 0.0 };

    fn drag(law: DragLaw) -> Drag {
        Drag { law, medium_velocity: None, added_mass: 0.5 }
    }

    /// Weight less buoyancy is carried at (2/9) Δρ g R²/η.
    #[test]
    fn val_stokes_1851_terminal_velocity() {
        let (medium, radius, excess) = (Medium::default(), 5e-6, 1500.0);
        let speed = 2.0 / 9.0 * excess * 9.81 * radius * radius / 1e-3;
        let weight = excess * 9.81 * 4.0 / 3.0 * PI * radius * radius * radius;
        let force = drag(DragLaw::Stokes).force(&medium, radius, Vec3::new(0.0, 0.0, -speed), &REST);
        assert_close!(force.z, weight, 1e-14, "in N");
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
            let force = law.force(&medium, radius, velocity, &REST);
            let coefficient = -force.y / (0.5 * 1000.0 * speed * speed * PI * radius * radius);
            assert_close!(Drag::reynolds(&medium, radius, velocity, &REST), number, 1e-14);
            assert!((coefficient / wanted - 1.0).abs() < 1e-5, "{number}: {coefficient}");
        }
        assert_eq!(drag(DragLaw::SchillerNaumann).force(&medium, radius, Vec3::ZERO, &REST), Vec3::ZERO);
    }

    /// A grain that moves with the medium feels (1 + C_a) m_f Du/Dt, and spins up to half the vorticity.
    #[test]
    fn a_medium_that_accelerates_and_turns() {
        let (medium, radius) = (Medium::default(), 1e-3);
        let law = drag(DragLaw::Stokes);
        let flow =
            FlowAt { acceleration: Vec3::new(0.0, 3.0, 0.0), vorticity: Vec3::new(0.0, 0.0, 8.0), ..REST };
        let moving = FlowAt { velocity: Vec3::new(1.0, 0.0, 3.0), ..flow };
        let force = law.force(&medium, radius, moving.velocity, &moving);
        let displaced = 4.0 / 3.0 * PI * 1e-6;
        assert_near_vector!(force, Vec3::new(0.0, 1.5 * 3.0 * displaced, 0.0), 1e-14 * force.norm(), "in N");
        assert_close!(law.added_mass(&medium, radius), 0.5 * displaced, 1e-14, "in kg");
        // It slips by nothing, and by 5 m/s at rest.
        let medium_at = |velocity| Drag::reynolds(&medium, radius, velocity, &moving);
        assert_eq!(medium_at(moving.velocity), 0.0);
        assert_close!(medium_at(Vec3::new(1.0, -4.0, 0.0)), 2.0 * radius * 1000.0 * 5.0 / 1e-3, 1e-14);
        assert_eq!(Drag::torque(&medium, radius, Vec3::new(0.0, 0.0, 4.0), &flow), Vec3::ZERO);
        let torque = Drag::torque(&medium, radius, Vec3::ZERO, &flow);
        assert_close!(torque.z, 8.0 * PI * 1e-3 * 1e-9 * 4.0, 1e-14, "in N m");
    }

    /// 15 η/(ρ R²) of rotation is faster than (9/2) η/(ρ R²) of motion; the flow's gradient adds to that.
    #[test]
    fn the_pace_is_that_of_spin_in_a_still_liquid() {
        let (medium, radius, mass) = (Medium::default(), 1e-5, 2500.0 * 4.0 / 3.0 * PI * 1e-15);
        let inertia = [mass, 0.4 * mass * radius * radius];
        let pace = drag(DragLaw::Stokes).pace(&medium, radius, inertia, Vec3::ZERO, &REST);
        assert_close!(pace.rate, 15.0 / 6.0 * 1e-3 / (2500.0 * 1e-10), 1e-14);
        let sheared = FlowAt { gradient: 1e6, ..REST };
        let pace = drag(DragLaw::Stokes).pace(&medium, radius, inertia, Vec3::ZERO, &sheared);
        assert_close!(pace.rate, 4.5e-3 / 6.0 / 2500e-10 + 1e6, 1e-14);
    }
}
