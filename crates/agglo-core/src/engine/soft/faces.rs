//! Faces of the control volume at which grains end: those that turn them back, and those that take them out.

use serde::{Deserialize, Serialize};

use crate::domain::{Boundary, Volume};
use crate::math::Vec3;

/// The faces of a volume of which some are reflecting or absorbing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EndFaces {
    corners: [Vec3; 2],
    across: [Boundary; 3],
}

/// What has left through absorbing faces since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Absorbed {
    /// Grains.
    pub grains: u64,
    /// Their mass [kg].
    pub mass: f64,
}

impl EndFaces {
    /// Those of a volume, if it has any.
    pub fn of(volume: Option<&Volume>) -> Option<Self> {
        let volume = volume?;
        let across = volume.boundaries();
        let ends = across.iter().any(|face| matches!(face, Boundary::Reflecting | Boundary::Absorbing));
        ends.then(|| Self { corners: [volume.lower(), volume.upper()], across })
    }

    /// The velocity [m/s] of a grain after the faces that it reaches into, if it is another one: what leads out is turned round.
    pub fn turned(&self, place: Vec3, radius: f64, velocity: Vec3) -> Option<Vec3> {
        let [lower, upper] = self.corners;
        let along = |axis: usize| {
            let leads_out = (place[axis] - radius < lower[axis] && velocity[axis] < 0.0)
                || (place[axis] + radius > upper[axis] && velocity[axis] > 0.0);
            let turns = leads_out && self.across[axis] == Boundary::Reflecting;
            if turns { -velocity[axis] } else { velocity[axis] }
        };
        let turned = Vec3::new(along(0), along(1), along(2));
        (turned != velocity).then_some(turned)
    }

    /// Whether a center [m] is beyond a face that absorbs it.
    pub fn takes(&self, place: Vec3) -> bool {
        let [lower, upper] = self.corners;
        let is_out = |axis: usize| !(lower[axis]..upper[axis]).contains(&place[axis]);
        (0..3).any(|axis| self.across[axis] == Boundary::Absorbing && is_out(axis))
    }

    /// Whether there are any that absorb.
    pub fn absorb(&self) -> bool {
        self.across.contains(&Boundary::Absorbing)
    }
}
