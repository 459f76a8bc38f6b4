//! What happened to hard spheres since the start, counted.

use serde::{Deserialize, Serialize};

use crate::engine::validate::{Fault, MOST_COUNTED, ensure};

/// What happened since the start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Collisions.
    pub collisions: u64,
    /// Of these, bounces.
    pub bounces: u64,
    /// Merges.
    pub merges: u64,
    /// Agglomerates that broke.
    pub fragmentations: u64,
    /// Bounces that were made elastic, since their pair had bounced again and again just before.
    pub tc_bounces: u64,
    /// Merges, and collisions in which one or both partners broke: lines of the table of events.
    pub events: u64,
    /// Agglomerates that did not break since there was no room for the fragments.
    pub no_room: u64,
    /// Collisions of spheres that overlapped: after a merge, or a step, or at a face.
    pub overlapping: u64,
    /// Bounces off walls.
    pub walls: u64,
    /// Iterations of all coupled solves.
    pub iterations: u64,
    /// Most iterations of one solve.
    pub most_iterations: u32,
    /// Solves that did not end within their tolerance.
    pub not_converged: u64,
}

impl Counts {
    /// Whether none is about to overflow.
    ///
    /// # Errors
    /// That one is.
    pub(in crate::engine::hard) fn validate(&self) -> Result<(), Fault> {
        let Self { collisions, bounces, merges, fragmentations, tc_bounces, events, no_room, .. } = *self;
        let Self { overlapping, walls, iterations, not_converged, .. } = *self;
        let counts = [collisions, bounces, merges, fragmentations, tc_bounces, events, no_room];
        let others = [overlapping, walls, iterations, not_converged];
        let holds = counts.iter().chain(&others).all(|count| *count < MOST_COUNTED);
        ensure(holds, || "a count is too large".to_owned())
    }
}
