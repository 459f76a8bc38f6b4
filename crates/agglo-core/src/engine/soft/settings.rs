//! What a simulation of soft spheres is told besides its grains: laws, medium, beams, bounds and scheme.

use std::collections::BTreeMap;

use crate::acoustics::{Acoustics, Medium};
use crate::contact::bond::Beam;
use crate::contact::{Bonds, ContactLaws};
use crate::domain::{Deformation, Space, SpaceInTime, Volume};
use crate::fields::Fields;
use crate::particles::{ById, Material, Mixture, Particles};
use crate::units::{Time, Velocity};
use crate::walls::Wall;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::step::tempo::Tempo;
use super::types::{Limits, Scheme};

/// All that a simulation of soft spheres follows from, but for its grains.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Simulated time at the end [s].
    pub end: f64,
    /// How time is stepped.
    pub scheme: Scheme,
    /// Bounds on motion and overlap.
    pub limits: Limits,
    /// The control volume, across whose faces space may repeat itself; open space if left out.
    pub volume: Option<Volume>,
    /// The fluid around the grains.
    pub medium: Medium,
    /// Materials by name; a grain's number of its material is the index in this map.
    pub materials: BTreeMap<String, Material>,
    /// What pairs of materials have in common, where it differs from the laws.
    pub mixtures: Vec<Mixture>,
    /// Radius of the smallest grain that there can be [m], which the flow of the medium is resolved for; that of the grains
    /// which are there if left out.
    pub smallest_radius: Option<f64>,
    /// Lets the grains come to rest first; not if left out.
    pub relax: Option<Relaxation>,
    /// Walls.
    pub walls: Vec<Wall>,
    /// Laws of contact; grains pass through one another, and through walls, without them.
    pub contact: Option<ContactLaws>,
    /// What holds grains together.
    pub bonds: Option<Bonds>,
    /// Fields.
    pub fields: Fields,
    /// Acoustic beams.
    pub acoustics: Option<Acoustics>,
}

impl Settings {
    /// Space as the faces of the control volume make it at the start.
    pub fn space(&self) -> Space {
        self.volume.as_ref().map_or(Space::OPEN, Volume::space)
    }

    /// Space at any time, among these grains.
    pub(super) fn space_in_time(&self, grains: &Particles) -> SpaceInTime {
        // In the order of names, which is the same after any sorting.
        let by_id = ById::of(&grains.id);
        let radii = by_id.places().map(|at| grains.radius[at as usize]);
        SpaceInTime::new(self.volume.as_ref(), radii)
    }

    /// The law of bonds between grains, where that is the one that bonds them.
    pub(super) fn beam(&self) -> Option<&Beam> {
        self.bonds.as_ref().and_then(Bonds::lasting)
    }

    /// Longest automatic step [s]: a hundredth of the run, or as the volume is deformed.
    pub(super) fn longest_step(&self) -> f64 {
        let deformation = self.volume.as_ref().and_then(|volume| volume.deformation.as_ref());
        deformation.map_or(f64::INFINITY, Deformation::longest_step).min(self.end / 100.0)
    }

    /// The automatic step, where none is given.
    pub(super) fn tempo(&self) -> Option<Tempo> {
        match &self.scheme {
            Scheme::Verlet(scheme) if scheme.step.is_none() => {
                Some(Tempo::new(scheme.safety, self.longest_step()))
            }
            _ => None,
        }
    }
}

/// Rest before the clock starts: without rays and drag, with velocities damped away.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Relaxation {
    /// At rest when no grain is faster, or would be within `damping_time`.
    pub speed: Velocity,
    /// An error if it takes longer (simulated time).
    pub longest: Time,
    /// Time in which free motion dies away.
    pub damping_time: Time,
}
