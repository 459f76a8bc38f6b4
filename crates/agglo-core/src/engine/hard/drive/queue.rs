//! The queue of events: which sphere has the next one.
//!
//! Each sphere has one event. Times are filed into bins that hold a few events each; the spheres of a bin go into a small
//! heap when its time comes. So filing and taking cost the same for any number of spheres (after G. Paul, J. Comput.
//! Phys. 221, 615 (2007)), and where many events crowd one bin, the logarithm of their number. Bins cover an epoch;
//! what is due after it waits in a list of its own. A sphere that is filed anew is not taken out of its old bin: what
//! its next event says tells which entry counts. The order is by time, then by id, and does not depend on the bins.
//!
//! A bin is one cache line. Spheres are announced before their bin is opened, so that they come from memory side by side.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use crate::engine::hard::search::NextEvent;
use crate::engine::hard::spheres::NONE;
use crate::math::prefetch;

/// Events that a bin should hold when its time comes.
const PER_BIN: f64 = 6.0;
/// Events that fit into a bin; more spill over.
const ROOM: usize = 15;
/// How many bins before its turn a bin is fetched from memory.
const BINS_AHEAD: usize = 8;
/// Code of the heap in [`NextEvent::bin`].
const HEAP: u32 = NONE - 1;
/// Code of the list of what is due after the epoch.
const FAR: u32 = NONE - 2;
/// Least number of bins.
const FEWEST_BINS: usize = 64;
/// Time that an epoch covers, over the mean time to the next event of a sphere.
const EPOCH: f64 = 4.0;

/// An event in the heap; stale when the next event of the sphere has another time.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry {
    time: f64,
    id: u32,
    sphere: u32,
}

impl Eq for Entry {}

impl Ord for Entry {
    /// The earliest is the greatest, since the heap gives the greatest first.
    fn cmp(&self, other: &Self) -> Ordering {
        other.time.total_cmp(&self.time).then(other.id.cmp(&self.id))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Spheres of one bin.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
struct Bin {
    count: u32,
    spheres: [u32; ROOM],
}

/// How soon a sphere will be needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Soon {
    /// After three more bins.
    Someday,
    /// After two more bins.
    Later,
    /// After one more bin.
    Next,
    /// Now.
    Now,
}

/// The queue.
#[derive(Clone, Debug, Default)]
pub struct Queue {
    bins: Vec<Bin>,
    /// Spheres that found no room in their bin.
    spilled: BTreeMap<u32, Vec<u32>>,
    far: Vec<u32>,
    /// Spheres and their bins, which come from memory meanwhile; they are put there before any bin is opened.
    pending: Vec<(u32, u32)>,
    start: f64,
    per_second: f64,
    current: usize,
    heap: BinaryHeap<Entry>,
    taken: u64,
}

impl Queue {
    /// Files all spheres anew.
    pub fn rebuild(&mut self, now: f64, next_events: &mut [NextEvent]) {
        let finite = || next_events.iter().map(NextEvent::due).filter(|time| time.is_finite());
        let count = finite().count().max(1) as f64;
        let mean = finite().map(|time| time - now).sum::<f64>() / count;
        let bins = (EPOCH * count / PER_BIN) as usize;
        self.bins.clear();
        self.bins.resize(bins.max(FEWEST_BINS), Bin::default());
        self.spilled.clear();
        self.heap.clear();
        self.far.clear();
        self.pending.clear();
        self.start = now;
        self.per_second = if mean > 0.0 { count / (PER_BIN * mean) } else { f64::MAX };
        self.current = 0;
        self.taken = 0;
        for sphere in 0..next_events.len() as u32 {
            next_events[sphere as usize].bin = NONE;
            self.file(next_events, sphere);
            self.put_pending();
        }
    }

    /// Files a sphere under the time of its next event, wherever it was filed before.
    #[inline]
    pub fn file(&mut self, next_events: &mut [NextEvent], sphere: u32) {
        let next_event = &mut next_events[sphere as usize];
        let time = next_event.due();
        if time == f64::INFINITY {
            next_event.bin = NONE;
            return;
        }
        let bin = self.bin_of(time);
        if bin <= self.current {
            next_event.bin = HEAP;
            self.heap.push(Entry { time, id: next_event.id, sphere });
        } else if bin < self.bins.len() {
            // Where it is in this bin already, it need not be put there again.
            if next_event.bin != bin as u32 {
                next_event.bin = bin as u32;
                prefetch(&self.bins, bin);
                self.pending.push((bin as u32, sphere));
            }
        } else if next_event.bin != FAR {
            next_event.bin = FAR;
            self.far.push(sphere);
        }
    }

    /// The next event that is due before or at `until` [s]: its time and sphere. `announce` is told of spheres that
    /// will be needed soon, so that they can be fetched from memory meanwhile.
    #[inline]
    pub fn next(
        &mut self,
        next_events: &mut [NextEvent],
        until: f64,
        announce: impl Fn(Soon, &[NextEvent], u32),
    ) -> Option<(f64, u32)> {
        loop {
            while let Some(first) = self.heap.peek() {
                let next_event = &next_events[first.sphere as usize];
                if next_event.bin != HEAP || next_event.due() != first.time {
                    self.heap.pop();
                    continue;
                }
                if first.time > until {
                    return None;
                }
                let first = *first;
                self.heap.pop();
                self.taken += 1;
                return Some((first.time, first.sphere));
            }
            if !self.open_next_bin(next_events, &announce) {
                return None;
            }
        }
    }

    /// Number of the bin of a time; beyond the last for what is due after the epoch.
    #[inline]
    fn bin_of(&self, time: f64) -> usize {
        // A cast from a number below zero gives zero, from a large one the largest.
        (((time - self.start) * self.per_second) as usize).min(self.bins.len())
    }

    #[inline]
    fn put(&mut self, at: usize, sphere: u32) {
        let bin = &mut self.bins[at];
        if (bin.count as usize) < ROOM {
            bin.spheres[bin.count as usize] = sphere;
            bin.count += 1;
        } else {
            self.spilled.entry(at as u32).or_default().push(sphere);
        }
    }

    /// Puts the spheres that are pending into their bins.
    fn put_pending(&mut self) {
        let mut pending = std::mem::take(&mut self.pending);
        pending.drain(..).for_each(|(bin, sphere)| self.put(bin as usize, sphere));
        self.pending = pending;
    }

    /// Moves the spheres of the next bin that has any into the heap; false where none is left.
    fn open_next_bin(
        &mut self,
        next_events: &mut [NextEvent],
        announce: &impl Fn(Soon, &[NextEvent], u32),
    ) -> bool {
        self.put_pending();
        loop {
            self.current += 1;
            prefetch(&self.bins, self.current + BINS_AHEAD);
            if self.current >= self.bins.len() && !self.begin_epoch(next_events) {
                self.current = self.bins.len();
                return false;
            }
            for (soon, ahead) in [(Soon::Someday, 3), (Soon::Later, 2), (Soon::Next, 1), (Soon::Now, 0)] {
                if let Some(bin) = self.bins.get(self.current + ahead) {
                    bin.spheres[..bin.count as usize]
                        .iter()
                        .for_each(|&sphere| announce(soon, next_events, sphere));
                }
            }
            let bin = std::mem::take(&mut self.bins[self.current]);
            for &sphere in &bin.spheres[..bin.count as usize] {
                self.open(next_events, sphere);
            }
            if bin.count as usize == ROOM {
                for sphere in self.spilled.remove(&(self.current as u32)).unwrap_or_default() {
                    self.open(next_events, sphere);
                }
            }
            if !self.heap.is_empty() {
                return true;
            }
        }
    }

    /// Puts a sphere of the bin that is being opened into the heap, if it still belongs to it.
    #[inline]
    fn open(&mut self, next_events: &mut [NextEvent], sphere: u32) {
        let next_event = &mut next_events[sphere as usize];
        if next_event.bin == self.current as u32 {
            next_event.bin = HEAP;
            self.heap.push(Entry { time: next_event.due(), id: next_event.id, sphere });
        }
    }

    /// Files what was due after the epoch into the bins of a new one; false where there is nothing.
    fn begin_epoch(&mut self, next_events: &mut [NextEvent]) -> bool {
        let mut far = std::mem::take(&mut self.far);
        far.retain(|&sphere| next_events[sphere as usize].bin == FAR);
        let first =
            far.iter().map(|&sphere| next_events[sphere as usize].due()).fold(f64::INFINITY, f64::min);
        if first == f64::INFINITY {
            return false;
        }
        let filled = self.taken as f64 / self.bins.len() as f64;
        self.per_second *= (filled / PER_BIN).clamp(0.25, 4.0);
        self.taken = 0;
        self.start = first;
        // What is due first goes into bin 0, which is opened next.
        self.current = 0;
        let mut kept = 0;
        for at in 0..far.len() {
            let sphere = far[at];
            let next_event = &mut next_events[sphere as usize];
            // Twice in the list: it was filed already.
            if next_event.bin != FAR {
                continue;
            }
            let bin = self.bin_of(next_event.due());
            if bin < self.bins.len() {
                next_event.bin = bin as u32;
                self.put(bin, sphere);
            } else {
                far[kept] = sphere;
                kept += 1;
            }
        }
        far.truncate(kept);
        self.far = far;
        true
    }
}

#[cfg(test)]
#[path = "queue_tests.rs"]
mod tests;
