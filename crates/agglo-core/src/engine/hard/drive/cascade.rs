//! All collisions of one moment: one after the other, with those that they bring about.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::domain::Boundary;
use crate::engine::SimError;
use crate::engine::hard::collide::{Change, HardSystem};
use crate::engine::hard::search::{Approach, Contact, Near};
use crate::math::Vec3;

/// Told when a pair has to wait.
const WAITS: &str =
    "spheres that had bounced in a step touched and approached again; they wait for the next step";

/// A pair that touches and approaches.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    /// For how long it has been touching [s].
    touching: f64,
    /// Centers [m], the one that comes first in space first.
    centers: [Vec3; 2],
    contact: Contact,
    /// How often its spheres had changed.
    stamps: [u32; 2],
}

impl Ord for Candidate {
    /// The greatest is dealt with first.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_time = self.touching.total_cmp(&other.touching);
        let by_place = |k: usize| other.centers[k].total_cmp(&self.centers[k]);
        by_time.then_with(|| by_place(0)).then_with(|| by_place(1))
    }
}
impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Candidate {}

/// Deals with collisions.
#[derive(Clone, Debug, Default)]
pub(super) struct Cascade {
    waiting: BinaryHeap<Candidate>,
    /// How often the sphere of a slot has changed, so that older findings about it are void [slots].
    stamps: Vec<u32>,
    /// Pairs that bounced in this step, sorted.
    bounced: Vec<[u32; 2]>,
    collisions: u64,
}

impl Cascade {
    /// Makes ready for one moment.
    pub fn open(&mut self, system: &HardSystem) {
        self.waiting.clear();
        self.bounced.clear();
        self.collisions = 0;
        self.stamps.resize(system.state.spheres.slots(), 0);
    }

    /// Puts a pair on the list if it touches and approaches.
    #[inline]
    pub fn offer(&mut self, system: &HardSystem, contact: Contact) {
        let spheres = &system.state.spheres;
        if let Some(touching) = Approach::of(spheres, &contact).touching_for() {
            let mut centers = contact.spheres.map(|at| spheres.motion[at as usize].position);
            centers.sort_unstable_by(Vec3::total_cmp);
            let stamps = contact.spheres.map(|at| self.stamps[at as usize]);
            self.waiting.push(Candidate { touching, centers, contact, stamps });
        }
    }

    /// Deals with what was offered, and, if `spreads`, with all that comes of it. Gives the number of collisions.
    ///
    /// # Errors
    /// [`SimError`] where a motion is not finite after a collision, or a sphere too large for the volume.
    pub fn run(
        &mut self,
        system: &mut HardSystem,
        near: &mut Near,
        time: f64,
        spreads: bool,
    ) -> Result<u64, SimError> {
        while let Some(Candidate { contact, stamps, .. }) = self.waiting.pop() {
            let is_void = contact.spheres.map(|at| self.stamps[at as usize]) != stamps;
            if is_void || Approach::of(&system.state.spheres, &contact).touching_for().is_none() {
                continue;
            }
            let mut pair = contact.spheres;
            pair.sort_unstable();
            let Err(slot) = self.bounced.binary_search(&pair) else {
                system.state.warnings.add(WAITS);
                continue;
            };
            self.collisions += 1;
            match system.collide(contact, time, near) {
                Change::Bounced => {
                    self.bounced.insert(slot, pair);
                    if spreads {
                        self.note(system, near, &pair, time)?;
                    } else {
                        check(system, &pair, time)?;
                    }
                }
                Change::Merged { kept, gone } => self.renew(system, near, &[kept, gone], spreads, time)?,
                Change::Broke => {
                    let fragments = std::mem::take(&mut system.fragments);
                    self.renew(system, near, &contact.spheres, false, time)?;
                    self.renew(system, near, &fragments, spreads, time)?;
                    system.fragments = fragments;
                }
            }
        }
        Ok(self.collisions)
    }

    /// Takes note that the spheres of some slots are others now, or gone.
    fn renew(
        &mut self,
        system: &HardSystem,
        near: &mut Near,
        indices: &[u32],
        spreads: bool,
        time: f64,
    ) -> Result<(), SimError> {
        self.stamps.resize(system.state.spheres.slots(), 0);
        for &at in indices {
            near.changed(at, &system.state.spheres, &system.volume);
            self.stamps[at as usize] = self.stamps[at as usize].wrapping_add(1);
        }
        self.bounced.retain(|pair| !pair.iter().any(|at| indices.contains(at)));
        if spreads { self.note(system, near, indices, time) } else { check(system, indices, time) }
    }

    /// Looks for whom spheres with new velocities touch and approach now.
    fn note(&mut self, system: &HardSystem, near: &Near, indices: &[u32], time: f64) -> Result<(), SimError> {
        check(system, indices, time)?;
        for &at in indices {
            self.stamps[at as usize] = self.stamps[at as usize].wrapping_add(1);
        }
        let spheres = &system.state.spheres;
        for &at in indices.iter().filter(|at| spheres.bulk[**at as usize].lives()) {
            let sphere = &spheres.motion[at as usize];
            near.visit(spheres, sphere.position, sphere.radius, &mut |other, shift| {
                if other != at {
                    self.offer(system, Contact { spheres: [at, other], shift });
                }
            });
        }
        Ok(())
    }
}

/// Whether spheres still have a motion, and room in a periodic volume.
fn check(system: &HardSystem, indices: &[u32], time: f64) -> Result<(), SimError> {
    for &at in indices {
        let (motion, bulk) =
            (&system.state.spheres.motion[at as usize], &system.state.spheres.bulk[at as usize]);
        if !bulk.lives() {
            continue;
        }
        let is_finite = motion.velocity.norm_squared().is_finite() && motion.position.is_finite();
        if !is_finite || !bulk.temperature.is_finite() {
            return Err(system.not_finite(at, time));
        }
        let diameter = 2.0 * motion.radius;
        let edge = system.volume.edges().to_array().into_iter().fold(f64::INFINITY, f64::min);
        if system.volume.boundary == Boundary::Periodic && diameter >= edge {
            return Err(SimError::Outgrown { time, grain: bulk.id, diameter, edge });
        }
    }
    Ok(())
}
