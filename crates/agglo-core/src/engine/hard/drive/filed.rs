//! What the event-driven driver has to remember besides the spheres.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::domain::Volume;
use crate::engine::hard::search::{Frame, Grid, NextEvent};
use crate::engine::hard::spheres::Spheres;
use crate::math::Vec3;

use super::standstill::Watch;

/// What the driver has to remember.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct EventsState<'a> {
    pub(super) next_events: Cow<'a, [NextEvent]>,
    pub(super) filed: Filed,
    pub(super) frame: Frame,
    /// Bounds of the velocities that each level has seen [m/s]: how far it is looked ahead hangs on them.
    pub(super) velocities: Vec<[Vec3; 2]>,
}

/// What the grid was made for, and what has happened since.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Filed {
    /// Smallest diameter when the grid was made [m].
    pub(super) smallest: f64,
    /// Spheres when the grid was made.
    pub(super) spheres: u64,
    /// Events since spheres were sorted.
    pub(super) events: u64,
    /// The moment of the last one [s].
    pub(super) moment: f64,
    pub(super) watch: Watch,
}

impl Filed {
    /// The same with a grid for the spheres as they are.
    pub(super) fn renewed(self, spheres: &Spheres) -> Self {
        let diameter = |at: u32| 2.0 * spheres.motion[at as usize].radius;
        let smallest = spheres.living().map(diameter).fold(f64::MAX, f64::min);
        Self { smallest, spheres: spheres.len() as u64, ..self }
    }

    pub(super) fn grid(&self, volume: &Volume) -> Grid {
        Grid::new(volume, self.smallest, self.spheres as usize)
    }
}
