//! All impacts of one moment: one after the other, with those that they bring about.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::domain::Boundary;
use crate::engine::SimError;
use crate::engine::hard::collide::{Change, Cloud};
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

/// Deals with impacts.
#[derive(Clone, Debug, Default)]
pub(super) struct Cascade {
    waiting: BinaryHeap<Candidate>,
    /// How often the sphere of a place has changed, so that older findings about it are void [places].
    stamps: Vec<u32>,
    /// Pairs that bounced in this step, sorted.
    bounced: Vec<[u32; 2]>,
    impacts: u64,
}

impl Cascade {
    /// Makes ready for one moment.
    pub fn open(&mut self, cloud: &Cloud) {
        self.waiting.clear();
        self.bounced.clear();
        self.impacts = 0;
        self.stamps.resize(cloud.state.spheres.places(), 0);
    }

    /// Puts a pair on the list if it touches and approaches.
    #[inline]
    pub fn offer(&mut self, cloud: &Cloud, contact: Contact) {
        let spheres = &cloud.state.spheres;
        if let Some(touching) = Approach::of(spheres, &contact).touching_for() {
            let mut centers = contact.spheres.map(|at| spheres.motion[at as usize].position);
            centers.sort_unstable_by(Vec3::total_cmp);
            let stamps = contact.spheres.map(|at| self.stamps[at as usize]);
            self.waiting.push(Candidate { touching, centers, contact, stamps });
        }
    }

    /// Deals with what was offered, and, if `spreads`, with all that comes of it. Gives the number of impacts.
    ///
    /// # Errors
    /// [`SimError`] where a motion is not finite after an impact, or a sphere too large for the volume.
    pub fn run(
        &mut self,
        cloud: &mut Cloud,
        near: &mut Near,
        time: f64,
        spreads: bool,
    ) -> Result<u64, SimError> {
        while let Some(Candidate { contact, stamps, .. }) = self.waiting.pop() {
            let is_void = contact.spheres.map(|at| self.stamps[at as usize]) != stamps;
            if is_void || Approach::of(&cloud.state.spheres, &contact).touching_for().is_none() {
                continue;
            }
            let mut pair = contact.spheres;
            pair.sort_unstable();
            let Err(slot) = self.bounced.binary_search(&pair) else {
                cloud.state.warnings.add(WAITS);
                continue;
            };
            self.impacts += 1;
            match cloud.meet(contact, time, near) {
                Change::Bounced => {
                    self.bounced.insert(slot, pair);
                    if spreads {
                        self.note(cloud, near, &pair, time)?;
                    } else {
                        check(cloud, &pair, time)?;
                    }
                }
                Change::Merged { kept, gone } => self.renew(cloud, near, &[kept, gone], spreads, time)?,
                Change::Broke => {
                    let pieces = std::mem::take(&mut cloud.pieces);
                    self.renew(cloud, near, &contact.spheres, false, time)?;
                    self.renew(cloud, near, &pieces, spreads, time)?;
                    cloud.pieces = pieces;
                }
            }
        }
        Ok(self.impacts)
    }

    /// Takes note that the spheres of some places are others now, or gone.
    fn renew(
        &mut self,
        cloud: &Cloud,
        near: &mut Near,
        places: &[u32],
        spreads: bool,
        time: f64,
    ) -> Result<(), SimError> {
        self.stamps.resize(cloud.state.spheres.places(), 0);
        for &at in places {
            near.changed(at, &cloud.state.spheres, &cloud.volume);
            self.stamps[at as usize] = self.stamps[at as usize].wrapping_add(1);
        }
        self.bounced.retain(|pair| !pair.iter().any(|at| places.contains(at)));
        if spreads { self.note(cloud, near, places, time) } else { check(cloud, places, time) }
    }

    /// Looks for whom spheres with new velocities touch and approach now.
    fn note(&mut self, cloud: &Cloud, near: &Near, places: &[u32], time: f64) -> Result<(), SimError> {
        check(cloud, places, time)?;
        for &at in places {
            self.stamps[at as usize] = self.stamps[at as usize].wrapping_add(1);
        }
        let spheres = &cloud.state.spheres;
        for &at in places.iter().filter(|at| spheres.bulk[**at as usize].lives()) {
            let sphere = &spheres.motion[at as usize];
            near.visit(spheres, sphere.position, sphere.radius, &mut |other, shift| {
                if other != at {
                    self.offer(cloud, Contact { spheres: [at, other], shift });
                }
            });
        }
        Ok(())
    }
}

/// Whether spheres still have a motion, and room in a periodic volume.
fn check(cloud: &Cloud, places: &[u32], time: f64) -> Result<(), SimError> {
    for &at in places {
        let (motion, bulk) =
            (&cloud.state.spheres.motion[at as usize], &cloud.state.spheres.bulk[at as usize]);
        if !bulk.lives() {
            continue;
        }
        let is_finite = motion.velocity.norm_squared().is_finite() && motion.position.is_finite();
        if !is_finite || !bulk.temperature.is_finite() {
            return Err(cloud.not_finite(at, time));
        }
        let diameter = 2.0 * motion.radius;
        let edge = cloud.volume.edges().to_array().into_iter().fold(f64::INFINITY, f64::min);
        if cloud.volume.boundary == Boundary::Periodic && diameter >= edge {
            return Err(SimError::Outgrown { time, grain: bulk.id, diameter, edge });
        }
    }
    Ok(())
}
