//! What a simulation of hard spheres is told besides its grains: the driver, the control volume, the laws of impact.

use std::collections::BTreeMap;

use crate::domain::{Boundary, Volume};
use crate::engine::SimError;
use crate::impact::Impact;
use crate::measure::SizeClasses;
use crate::particles::{Material, Mixture};

use super::types::{EventDriven, TimeStepped};

/// All that a simulation of hard spheres follows from, but for its grains.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Simulated time at the end [s].
    pub end: f64,
    /// What drives time.
    pub driver: Driver,
    /// The control volume.
    pub volume: Volume,
    /// Materials by name; a grain's number of its material is the index in this map.
    pub materials: BTreeMap<String, Material>,
    /// What pairs of materials have in common, where it differs from the laws.
    pub mixtures: Vec<Mixture>,
    /// Laws of impact.
    pub impact: Impact,
    /// Classes by which collisions and breakages are counted.
    pub classes: SizeClasses,
}

impl Settings {
    /// Refuses what only soft spheres know of a volume.
    ///
    /// # Errors
    /// [`SimError::ForeignVolume`].
    pub(super) fn hold_volume(&self) -> Result<(), SimError> {
        let Volume { boundary, faces, deformation, .. } = &self.volume;
        let foreign = [
            (*boundary == Boundary::Absorbing, "absorbing faces"),
            (faces.is_some(), "faces that differ"),
            (deformation.is_some(), "a deformation"),
        ];
        match foreign.into_iter().find(|(is_given, _)| *is_given) {
            Some((_, what)) => Err(SimError::ForeignVolume { what, spheres: "hard" }),
            None => Ok(()),
        }
    }
}

/// What drives time.
#[derive(Clone, Debug, PartialEq)]
pub enum Driver {
    /// From collision to collision, each at its exact time.
    EventDriven(EventDriven),
    /// Steps that are as long as gaps allow, [B] 6.14.
    TimeStepped(TimeStepped),
}
