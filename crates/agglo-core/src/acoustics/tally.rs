//! What rays add to the books of their pulses, block by block.
//!
//! A block has 256 numbers of rays of one pulse, whichever of these still fly: so sums go over the numbers of rays, and depend neither on
//! threads nor on how the list of those in flight has shrunk.

use super::flight::{PulseCount, Ray};
use super::hit::{Hit, NONE};
use crate::math::Vec3;

/// Numbers of rays in a block.
pub(super) const BLOCK: u32 = 256;

/// What the rays of a block add to the books of their pulse.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    pub pulse: u32,
    reflections: u64,
    at_walls: u64,
    escapes: u32,
    pub capped: u32,
    pub crushed: u32,
    pub blocked: u32,
    pub overlong: u32,
    drops: u32,
    longest_chain: u32,
    absorbed: f64,
    into_walls: f64,
    escaped: f64,
    truncated: f64,
    cut_off: f64,
    flow_ended: Vec3,
    squares_ended: f64,
}

impl Tally {
    /// Nothing yet, of a pulse.
    pub fn of(pulse: u32) -> Self {
        Self { pulse, ..Self::default() }
    }

    pub fn book(&self, count: &mut PulseCount) {
        count.reflections += self.reflections;
        count.reflections_at_walls += self.at_walls;
        count.segments += self.reflections + u64::from(self.escapes);
        count.in_flight -= self.escapes + self.drops + self.overlong;
        count.longest_chain = count.longest_chain.max(self.longest_chain);
        count.power_absorbed += self.absorbed;
        count.power_into_walls += self.into_walls;
        count.power_escaped += self.escaped;
        count.power_truncated += self.truncated;
        count.power_cut_off += self.cut_off;
        count.flow_ended += self.flow_ended;
        count.squares_ended += self.squares_ended;
        count.capped += self.capped;
        count.crushed += self.crushed;
        count.blocked += self.blocked;
        count.overlong += self.overlong;
    }

    /// A bounce.
    #[inline]
    pub fn count(&mut self, ray: &Ray, hit: &Hit) {
        let taken = hit.power_taken();
        self.reflections += 1;
        self.longest_chain = self.longest_chain.max(ray.bounces);
        if hit.wall == NONE {
            self.absorbed += taken;
        } else {
            self.at_walls += 1;
            self.into_walls += taken;
        }
    }

    /// A ray that left for good.
    pub fn escape(&mut self, ray: &Ray) {
        self.escapes += 1;
        self.escaped += ray.power;
        self.end(ray);
    }

    /// A ray that is dropped.
    pub fn drop(&mut self, ray: &Ray) {
        self.drops += 1;
        self.truncated += ray.power;
        self.end(ray);
    }

    /// A ray that has come as far as rays are followed.
    pub fn cut_off(&mut self, ray: &Ray) {
        self.overlong += 1;
        self.cut_off += ray.power;
        self.end(ray);
    }

    fn end(&mut self, ray: &Ray) {
        self.flow_ended += ray.direction * ray.power;
        self.squares_ended += ray.power * ray.power;
    }
}
