//! Parallel-bond beam: an elastic disc of cement between two grains.
//!
//! # Equation
//! ```text
//! k_n = E/l0,   k_s = κ k_n,   A = π r²,   I = π r⁴/4,   J = π r⁴/2                         A7
//! tension       F_n = k_n A (d - l0)                                  in total, so without drift
//! shear         S ← T S + k_s A Δu,     bending   M_b ← T M_b + k_n I Δθ_b
//! twist         M_t ← M_t + k_s J Δθ_n
//! on i          F_i = F_n n + S,   M_i = a_i n × S + M_b + M_t n
//! on j          F_j = -F_i,        M_j = a_j n × S - M_b - M_t n,   a_i + a_j = d
//! energy        U = F_n²/(2 k_n A) + S²/(2 k_s A) + M_b²/(2 k_n I) + M_t²/(2 k_s J)
//! breaks where  F_n/A + |M_b| r/I >= σ   or   |S|/A + |M_t| r/J >= τ
//! ```
//! T turns a vector with the bond: by the least rotation from the old normal to the new one, then by the mean
//! rotation about the normal.
//!
//! # Source
//! D. O. Potyondy and P. A. Cundall, Int. J. Rock Mech. Min. Sci. 41, 1329 (2004), section 2.2.
//!
//! # Symbols
//! | symbol | name in code      | unit | meaning                                                      |
//! |--------|-------------------|------|--------------------------------------------------------------|
//! | E      | `youngs_modulus`  | Pa   | of the cement                                                |
//! | κ      | `shear_ratio`     | -    | shear over normal stiffness per area                         |
//! | l0     | `state.length`    | m    | distance of the centers when the bond was made               |
//! | r      | `state.radius`    | m    | of the disc: `radius_ratio` times the smaller grain's        |
//! | d      | `distance`        | m    | of the centers                                               |
//! | Δu     | `displacement`    | m    | of j's side of the disc relative to i's, tangential          |
//! | Δθ     | `rotation`        | rad  | of j relative to i; Δθ_n along the normal, Δθ_b the rest     |
//! | a      | `lever_arms`      | m    | from each center to the disc                                 |
//! | σ, τ   | `tensile_strength`, `shear_strength` | Pa | of the cement                               |
//! | ζ      | `damping_ratio`   | -    | part of critical damping in each mode                        |
//!
//! # Critical step
//! ω² of all bonds of a grain, in the stiffest of the four modes, and Γ of its dashpots; looked at every 100 steps,
//! and when bonds are made.
//!
//! # Valid when
//! Strains and relative rotations are small (the cement is brittle). The chain of many bonds bends like a beam
//! of the same disc.
//!
//! # Compared with others
//! As the parallel bond of PFC; the tension is kept in total form, not summed up step by step, and the beam
//! coefficient of moments in the strength is one. Dashpots act on top and do not break the bond.
//!
//! # In a scenario
//! ```toml
//! [bonds.beam]
//! youngs_modulus = "1 GPa"
//! tensile_strength = "1 MPa"
//! shear_strength = "1 MPa"
//! gap = 0.01
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::contact::bond::{Beam, BeamPair};
//! use agglo::{math::Vec3, units::Quantity};
//! let beam: Beam = serde_json::from_str(
//!     r#"{"youngs_modulus": "1 GPa", "tensile_strength": "1 MPa", "shear_strength": "1 MPa"}"#,
//! ).unwrap();
//! let state = beam.new_state(1e-3, 1e-3, 2e-3, Vec3::AXES[0]);
//! let pulled = BeamPair { distance: 2.001e-3, normal: Vec3::AXES[0], lever_arms: [1.0005e-3; 2], ..Default::default() };
//! let (load, _) = beam.advance(&state, &pulled);
//! let by_hand = 1e9 / 2e-3 * std::f64::consts::PI * 1e-6 * 1e-6;
//! assert!((load.force.x / by_hand - 1.0).abs() < 1e-9);
//! ```

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::law::{Context, Faults, Law, note_if};
use crate::math::{Pace, Vec3};
use crate::units::Pressure;

/// Cement between grains that carries tension, shear, bending and twisting, and breaks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Beam {
    /// Young's modulus of the cement; normal stiffness per area is this over the bond's length.
    pub youngs_modulus: Pressure,
    /// Shear over normal stiffness per area.
    #[serde(default = "default_shear_ratio")]
    pub shear_ratio: f64,
    /// Radius of the disc over the smaller grain's radius.
    #[serde(default = "one")]
    pub radius_ratio: f64,
    /// Tensile strength.
    pub tensile_strength: Pressure,
    /// Shear strength.
    pub shear_strength: Pressure,
    /// Grains whose surfaces are no farther apart than this part of the smaller radius are bonded at the start.
    #[serde(default = "crate::contact::closeness::touching")]
    pub gap: f64,
    /// Overlap strain at which two grains bond during the run; never if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forming_strain: Option<f64>,
    /// Part of critical damping in each of the bond's four modes.
    #[serde(default)]
    pub damping_ratio: f64,
}

fn default_shear_ratio() -> f64 {
    0.4
}
fn one() -> f64 {
    1.0
}

impl Law for Beam {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.positive("youngs_modulus", self.youngs_modulus);
        faults.positive("tensile_strength", self.tensile_strength);
        faults.positive("shear_strength", self.shear_strength);
        faults.above_zero("shear_ratio", self.shear_ratio);
        faults.above_zero("radius_ratio", self.radius_ratio);
        faults.zero_or_more("gap", self.gap);
        faults.zero_or_more("damping_ratio", self.damping_ratio);
        if let Some(strain) = self.forming_strain {
            faults.above_zero("forming_strain", strain);
        }
    }

    fn notes(&self, _: &Context<'_>) -> Vec<String> {
        let note = "bonds.beam.gap is 0: only grains that overlap at the start are bonded";
        note_if(self.gap == 0.0, note)
    }
}

impl Beam {
    /// The warning of a run in which the law has bonded so many pairs at the start, and would bond none later.
    pub fn warning(&self, made_at_start: usize) -> Option<&'static str> {
        (made_at_start == 0 && self.forming_strain.is_none()).then_some(
            "bonds.beam: no bond was made, since no two grains are closer than bonds.beam.gap, or none was left in the run \
             of start.from; nothing holds the grains together",
        )
    }
}

/// What a bond remembers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeamState {
    /// Distance of the centers [m] when the bond was made: no normal force there.
    pub length: f64,
    /// Radius of the disc [m].
    pub radius: f64,
    /// Shear force on i [N].
    pub shear: Vec3,
    /// Bending moment on i [N m].
    pub bending: Vec3,
    /// Twisting moment on i about the normal [N m].
    pub twist: f64,
    /// Normal of the step before, from i to j.
    pub normal: Vec3,
}

/// The two grains of a bond over one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BeamPair {
    /// Distance of the centers [m] at the end of the step.
    pub distance: f64,
    /// Unit normal from i to j at the end of the step.
    pub normal: Vec3,
    /// Distances [m] of the disc from the centers of i and j along the normal; their sum is the distance.
    pub lever_arms: [f64; 2],
    /// Displacement [m] of j's side of the disc relative to i's over the step, rotation included, tangential:
    /// dt times `slip` of the middle of the step.
    pub displacement: Vec3,
    /// Rotation [rad] of j relative to i over the step: dt (w_j - w_i).
    pub rotation: Vec3,
    /// Angle [rad] by which the pair turned about its normal over the step: dt (w_i + w_j) . n / 2.
    pub turn_about_normal: f64,
    /// Speed [m/s] at which the centers part at the end of the step.
    pub separation_speed: f64,
    /// Velocity [m/s] of j's side of the disc relative to i's at the end of the step, tangential:
    /// v_j - v_i - (a_i w_i + a_j w_j) x n, without its part along n.
    pub slip: Vec3,
    /// w_j - w_i at the end of the step [rad/s].
    pub angular_velocity_difference: Vec3,
    /// m_i m_j / (m_i + m_j) [kg].
    pub effective_mass: f64,
    /// I_i I_j / (I_i + I_j) [kg m²].
    pub effective_inertia: f64,
}

/// Forces and torques [N, N m] of a bond on its two grains.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BeamLoad {
    /// Force on i; on j the opposite.
    pub force: Vec3,
    /// Moment on i about its center.
    pub torque_i: Vec3,
    /// Moment on j about its center.
    pub torque_j: Vec3,
    /// Tension over tensile strength: breaks at 1.
    pub tensile_use: f64,
    /// Shear over shear strength: breaks at 1.
    pub shear_use: f64,
    /// Power lost in the bond's dashpots [W].
    pub damping_power: f64,
}

impl BeamLoad {
    /// How the bond breaks under this load, if it does.
    #[inline]
    pub fn breaks(&self) -> Option<Break> {
        if self.tensile_use >= 1.0 && self.tensile_use >= self.shear_use {
            Some(Break::Tension)
        } else if self.shear_use >= 1.0 {
            Some(Break::Shear)
        } else {
            None
        }
    }
}

/// How a bond broke.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Break {
    /// The tensile strength was reached.
    Tension,
    /// The shear strength was reached.
    Shear,
    /// One of its grains left the run through an absorbing face.
    Left,
}

/// Stiffness of a bond's four modes.
struct Modes {
    /// [N/m].
    normal: f64,
    /// [N/m].
    shear: f64,
    /// [N m].
    bending: f64,
    /// [N m].
    twist: f64,
}

impl Beam {
    /// A bond without load between two grains of these radii [m] whose centers are `distance` [m] apart
    /// along the unit vector `normal` from i to j.
    pub fn new_state(&self, radius_i: f64, radius_j: f64, distance: f64, normal: Vec3) -> BeamState {
        BeamState {
            length: distance,
            radius: self.radius_ratio * radius_i.min(radius_j),
            shear: Vec3::ZERO,
            bending: Vec3::ZERO,
            twist: 0.0,
            normal,
        }
    }

    #[inline]
    fn modes(&self, state: &BeamState) -> Modes {
        let per_area = self.youngs_modulus.si() / state.length;
        let square = state.radius * state.radius;
        let area = PI * square;
        let normal = per_area * area;
        let bending = 0.25 * normal * square;
        Modes { normal, shear: self.shear_ratio * normal, bending, twist: 2.0 * self.shear_ratio * bending }
    }

    /// Load at the end of a step and the state to remember if the step is kept.
    #[inline]
    pub fn advance(&self, before: &BeamState, pair: &BeamPair) -> (BeamLoad, BeamState) {
        let modes = self.modes(before);
        let normal = pair.normal;
        let turn = Turn::new(before.normal, normal, pair.turn_about_normal);
        let twisting = pair.rotation.dot(normal);
        let state = BeamState {
            shear: turn.of(before.shear) + pair.displacement.rejected_from(normal) * modes.shear,
            bending: turn.of(before.bending) + (pair.rotation - normal * twisting) * modes.bending,
            twist: before.twist + twisting * modes.twist,
            normal,
            ..*before
        };
        let tension = modes.normal * (pair.distance - before.length);
        let mut load = self.elastic_load(&state, pair, tension);
        if self.damping_ratio > 0.0 {
            self.damp(&modes, pair, &mut load);
        }
        (load, state)
    }

    #[inline]
    fn elastic_load(&self, state: &BeamState, pair: &BeamPair, tension: f64) -> BeamLoad {
        let area = PI * state.radius * state.radius;
        // r/I = 4/(A r) and r/J = 2/(A r).
        let per_moment = 1.0 / (area * state.radius);
        let tensile = tension / area + 4.0 * per_moment * state.bending.norm();
        let shear = state.shear.norm() / area + 2.0 * per_moment * state.twist.abs();
        let mut load = BeamLoad {
            tensile_use: (tensile / self.tensile_strength.si()).max(0.0),
            shear_use: shear / self.shear_strength.si(),
            ..BeamLoad::default()
        };
        load.add(pair, tension, state.shear, state.bending + pair.normal * state.twist);
        load
    }

    /// Adds the four dashpots: `damping_ratio` of 2 √(k m*), or of 2 √(k I*) for rotations.
    #[inline]
    fn damp(&self, modes: &Modes, pair: &BeamPair, load: &mut BeamLoad) {
        let dashpot = |stiffness: f64, inertia: f64| 2.0 * self.damping_ratio * (stiffness * inertia).sqrt();
        let along = pair.angular_velocity_difference.dot(pair.normal);
        let across = pair.angular_velocity_difference - pair.normal * along;
        let tension = dashpot(modes.normal, pair.effective_mass) * pair.separation_speed;
        let shear = pair.slip * dashpot(modes.shear, pair.effective_mass);
        let moment = across * dashpot(modes.bending, pair.effective_inertia)
            + pair.normal * (along * dashpot(modes.twist, pair.effective_inertia));
        load.damping_power = tension * pair.separation_speed
            + shear.dot(pair.slip)
            + moment.dot(pair.angular_velocity_difference);
        load.add(pair, tension, shear, moment);
    }

    /// Elastic energy [J] of a bond whose grains' centers are `distance` [m] apart.
    pub fn energy(&self, state: &BeamState, distance: f64) -> f64 {
        let modes = self.modes(state);
        let stretch = distance - state.length;
        let stored = |square: f64, stiffness: f64| if stiffness > 0.0 { square / stiffness } else { 0.0 };
        0.5 * (modes.normal * stretch * stretch
            + stored(state.shear.norm_squared(), modes.shear)
            + stored(state.bending.norm_squared(), modes.bending)
            + stored(state.twist * state.twist, modes.twist))
    }

    /// How fast this bond alone is, from the masses [kg], moments of inertia [kg m²] and lever arms [m] of its two
    /// grains; for grains with z bonds times z.
    ///
    /// ω² is the largest of the stretching, the twisting and a bound (sum) on the coupled shearing and bending mode.
    pub fn pace(
        &self,
        state: &BeamState,
        masses: [f64; 2],
        inertias: [f64; 2],
        lever_arms: [f64; 2],
    ) -> Pace {
        let modes = self.modes(state);
        let per_mass = 1.0 / masses[0] + 1.0 / masses[1];
        let per_inertia = 1.0 / inertias[0] + 1.0 / inertias[1];
        let levers =
            lever_arms[0] * lever_arms[0] / inertias[0] + lever_arms[1] * lever_arms[1] / inertias[1];
        let across = modes.shear * (per_mass + levers) + modes.bending * per_inertia;
        let square = (modes.normal * per_mass).max(modes.twist * per_inertia).max(across);
        let ratio = self.damping_ratio * (1.0 + levers / per_mass).sqrt();
        Pace { square, rate: 2.0 * ratio * square.sqrt() }
    }
}

impl BeamLoad {
    /// Adds a tension, a shear force on i and a moment on i, so that total angular momentum stays.
    #[inline]
    fn add(&mut self, pair: &BeamPair, tension: f64, shear: Vec3, moment: Vec3) {
        let lever = pair.normal.cross(shear);
        self.force += pair.normal * tension + shear;
        self.torque_i += lever * pair.lever_arms[0] + moment;
        self.torque_j += lever * pair.lever_arms[1] - moment;
    }
}

/// The least rotation from one normal to another, then one about the new normal.
struct Turn {
    sum: Vec3,
    factor: f64,
    after: Vec3,
    sin_cos: (f64, f64),
}

impl Turn {
    #[inline]
    fn new(before: Vec3, after: Vec3, angle: f64) -> Self {
        let straight = 1.0 + before.dot(after);
        // Opposite normals have no least rotation; the part along the new normal is taken away at least.
        let (sum, factor) = if straight > 1e-12 { (before + after, 1.0 / straight) } else { (after, 1.0) };
        Self { sum, factor, after, sin_cos: angle.sin_cos() }
    }

    /// The vector at right angles to the old normal, turned; at right angles to the new one.
    #[inline]
    fn of(&self, vector: Vec3) -> Vec3 {
        let tilted = vector - self.sum * (self.after.dot(vector) * self.factor);
        tilted * self.sin_cos.1 + self.after.cross(tilted) * self.sin_cos.0
    }
}

#[cfg(test)]
#[path = "beam_tests.rs"]
mod tests;
