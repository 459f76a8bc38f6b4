//! Whether the clock of events goes on.
//!
//! Spheres without room bounce for ever: at one moment if they touch exactly, and in steps of rounding if their gaps are
//! rounding. So it is looked at now and then how far the fastest has flown, and not only whether two times are the same.

use serde::{Deserialize, Serialize};

use crate::engine::SimError;
use crate::engine::hard::collide::HardSystem;
use crate::engine::hard::spheres::NONE;
use crate::math::Vec3;

/// Events for each sphere after which it is looked at whether the clock goes on.
const EVENTS: u64 = 1_000;
/// It stands if the fastest sphere flew less than this part of the smallest radius meanwhile. With a thousand events for each
/// sphere gaps are then 1e-12 radii, some hundred times what coordinates are rounded to.
const CREEPING: f64 = 1e-9;

/// What to do where the guard against inelastic collapse acts.
const NO_ROOM: &str = "grains that touch one another, their images or walls have no room to move: place them apart, or \
                       enlarge [volume]";
/// And where it does not.
const NO_GUARD: &str = "engine.event_driven.contact_duration = 0 switches the guard against inelastic collapse off: leave \
                        it out; or, if grains have no room to move, place them apart, or enlarge [volume]";

/// Looks at the clock.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Watch {
    /// When it was last seen that the clock goes on [s].
    since: f64,
    /// Events since.
    events: u64,
    /// Ids of those who bounced last; [`NONE`] for a wall.
    last: [u32; 2],
}

impl Default for Watch {
    fn default() -> Self {
        Self { since: 0.0, events: 0, last: [NONE; 2] }
    }
}

impl Watch {
    /// Takes note of who bounces, by their indices; [`NONE`] for a wall.
    #[inline]
    pub fn bounced(&mut self, system: &HardSystem, indices: [u32; 2]) {
        self.last = indices.map(|at| system.state.spheres.bulk.get(at as usize).map_or(NONE, |bulk| bulk.id));
    }

    /// Counts an event at `time` [s], and looks at the clock now and then; `drift` is the velocity of the cells [m/s].
    ///
    /// # Errors
    /// [`SimError::Standstill`] where the clock does not go on.
    #[inline]
    pub fn look(&mut self, system: &HardSystem, drift: Vec3, time: f64) -> Result<(), SimError> {
        self.events += 1;
        if self.events <= EVENTS * (system.state.spheres.len() as u64 + 100) {
            return Ok(());
        }
        self.look_closely(system, drift, time)
    }

    #[cold]
    fn look_closely(&mut self, system: &HardSystem, drift: Vec3, time: f64) -> Result<(), SimError> {
        let spheres = &system.state.spheres;
        let living = || spheres.living().map(|at| &spheres.motion[at as usize]);
        let smallest = living().map(|sphere| sphere.radius).fold(f64::MAX, f64::min);
        let fastest = living().map(|sphere| (sphere.velocity - drift).norm()).fold(0.0, f64::max);
        let (lasted, events) = (time - self.since, self.events);
        if lasted * fastest > CREEPING * smallest {
            (self.since, self.events) = (time, 0);
            return Ok(());
        }
        let who = in_words(self.last);
        let help = if system.contact_duration > 0.0 { NO_ROOM } else { NO_GUARD };
        Err(SimError::Standstill { time, lasted, events, who, help })
    }
}

/// Who collided last, by the ids of the grains.
fn in_words([a, b]: [u32; 2]) -> String {
    match b {
        NONE => format!("grain {a} and a wall"),
        _ => format!("grains {} and {}", a.min(b), a.max(b)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_met_is_told_in_the_order_of_names() {
        let told = [[3, 7], [7, 3], [7, NONE]].map(in_words);
        assert_eq!(told, ["grains 3 and 7", "grains 3 and 7", "grain 7 and a wall"]);
    }
}
