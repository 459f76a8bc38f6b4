//! Ray transport: rays advance among grains held still, bounce where they hit, and leave ([A] box 9).
//!
//! Every hit is found exactly, however long the step. A ray ends when it can hit no grain any more
//! ([`Followed`](super::Followed)), or when it leaves the region if one is given; or it is dropped, when its power has
//! fallen to the truncation or it has bounced too often. The books of each pulse ([`PulseCount`](super::PulseCount)) close
//! to rounding. This module applies no force: it hands out the hits, in batches of bounded size.

use super::flight::{Flight, Ray};
use super::follow::Followed;
use super::fresnel::Interface;
use super::hit::{Ends, Hit, Targets};
use super::scene::{Chunk, Scene, TASKS, Way};
use super::tally::{BLOCK, Tally};
use crate::domain::{Region, Space};
use crate::math::Vec3;
use crate::neighbors::ray_grid::{NO_SPHERE, RayGrid, RaySpan};
use crate::walls::{Mirrors, Walls};

/// Periods that a ray is followed for where no way is given, of the longest of them.
const PERIODS: f64 = 1000.0;
/// Periods that a ray is followed for at most, of the shortest of them.
pub const MOST_PERIODS: f64 = 1e6;
/// Moves the rays of a [`Flight`]; holds what is the same for all, and buffers that are used again.
#[derive(Clone, Debug)]
pub struct Tracer {
    ends: Ends,
    interfaces: Vec<Interface>,
    space: Space,
    mirrors: Option<Mirrors>,
    grid: RayGrid,
    chunks: Vec<Chunk>,
}

impl Tracer {
    /// A tracer for rays that end so, in open space; `interfaces` [materials] by the material's number.
    pub fn new(ends: Ends, interfaces: Vec<Interface>) -> Self {
        let everywhere = Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY);
        let (lower, upper) = ends.region.as_ref().map_or((-everywhere, everywhere), Region::bounds);
        let grid = RayGrid::new(lower, upper);
        Self { ends, interfaces, space: Space::OPEN, mirrors: None, grid, chunks: Vec::new() }
    }

    /// The same in space that may repeat itself: then rays fly on across its faces, and end after a way.
    #[must_use]
    pub fn in_space(mut self, space: Space) -> Self {
        if space.repeats() {
            let longest = space.periods().to_array().into_iter().fold(0.0, f64::max);
            let way = if self.ends.way.is_finite() { self.ends.way } else { PERIODS * longest };
            self.ends.way = way.min(MOST_PERIODS * space.shortest_period());
            self.grid = RayGrid::across(space);
            self.space = space;
        }
        self
    }

    /// The same among walls.
    #[must_use]
    pub fn among(mut self, walls: Walls) -> Self {
        self.mirrors = (!walls.is_empty()).then(|| Mirrors::new(walls));
        self
    }

    /// Puts walls where they are at a time [s]; the first of the two times is when rays flew last.
    pub fn stand_walls(&mut self, times: [f64; 2]) {
        if let Some(mirrors) = &mut self.mirrors {
            mirrors.stand(times);
        }
    }

    /// Whether space repeats itself.
    pub fn repeats(&self) -> bool {
        self.space.repeats()
    }

    /// How many walls there are.
    pub fn walls(&self) -> usize {
        self.mirrors.as_ref().map_or(0, Mirrors::len)
    }

    /// How rays end.
    pub fn ends(&self) -> &Ends {
        &self.ends
    }

    /// Lets every ray fly `distance` [m] (c dt) among grains held still. An infinite distance traces all rays to their
    /// end. Hands out the hits, batch by batch: those of one ray in the order of time, rays by pulse and number.
    pub fn advance(
        &mut self,
        flight: &mut Flight,
        targets: &Targets<'_>,
        distance: f64,
        mut take: impl FnMut(&[Hit]),
    ) {
        if flight.rays.is_empty() {
            return;
        }
        self.grid.update(targets.positions, targets.radii);
        let Targets { positions, radii, mach, .. } = *targets;
        let Self { ends, interfaces, space, mirrors, grid, chunks } = self;
        let way = match &ends.region {
            Some(region) => Way::Out(region),
            None => Way::Past(Followed::across(space, positions, radii, mach)),
        };
        let mirrors = mirrors.as_ref();
        let scene = Scene { way, ends, interfaces, space, mirrors, grid, targets: *targets, distance };
        let (mut start, mut kept) = (0, 0);
        while start < flight.rays.len() {
            let (rays, tasks) = cut(&flight.rays[start..], chunks);
            let chunks = &mut chunks[..tasks];
            scene.fly_group(&mut flight.rays[start..start + rays], chunks, &mut take);
            kept = gather(flight, chunks, start, kept);
            start += rays;
        }
        flight.rays.truncate(kept);
    }

    /// Traces all rays to their end among grains that stay where they are; all hits, as [`Tracer::advance`] hands them out.
    pub fn trace(&mut self, flight: &mut Flight, targets: &Targets<'_>) -> Vec<Hit> {
        let mut hits = Vec::new();
        self.advance(flight, targets, f64::INFINITY, |batch| hits.extend_from_slice(batch));
        hits
    }

    /// Drops the rays of the latest pulse that start inside a grain; their power is booked as truncated. Returns how many,
    /// and the first of those grains.
    pub fn drop_blocked(&mut self, flight: &mut Flight, targets: &Targets<'_>) -> Option<(u32, u32)> {
        self.grid.update(targets.positions, targets.radii);
        let grid = &self.grid;
        drop_inside(flight, |ray| grid.sphere_around(ray.origin))
    }

    /// The same of those that start inside a wall; how many, and the first of those walls.
    pub fn drop_walled(&self, flight: &mut Flight) -> Option<(u32, u32)> {
        let mirrors = self.mirrors.as_ref()?;
        drop_inside(flight, |ray| mirrors.holding(ray.origin))
    }

    /// Way [m] from the start of the latest pulse's rays to the first grain that one of them meets, walls left out; none if all pass by. In
    /// space that repeats itself, where rays end after a way.
    pub fn first_image(&self, flight: &Flight) -> Option<f64> {
        let latest = flight.pulses.len().checked_sub(1)?;
        let to = |ray: &Ray| {
            let (origin, direction) = (ray.origin, ray.direction);
            let span = RaySpan { origin, direction, from: 0.0, to: self.ends.way, skip: NO_SPHERE };
            self.grid.nearest_image(&span).map(|met| met.hit.at)
        };
        let rays = flight.rays.iter().filter(|ray| ray.pulse as usize == latest);
        rays.filter_map(to).min_by(f64::total_cmp)
    }
}

/// Drops the rays of the latest pulse that start inside something; how many, and in which the first.
fn drop_inside(flight: &mut Flight, inside: impl Fn(&Ray) -> Option<u32>) -> Option<(u32, u32)> {
    let latest = flight.pulses.len().checked_sub(1)?;
    let mut tally = Tally::of(latest as u32);
    let mut first = None;
    flight.rays.retain(|ray| {
        let inside = (ray.pulse as usize == latest).then(|| inside(ray)).flatten();
        if inside.is_some() {
            tally.blocked += 1;
            tally.drop(ray);
            first = first.or(inside);
        }
        inside.is_none()
    });
    tally.book(&mut flight.pulses[latest]);
    first.map(|what| (tally.blocked, what))
}

/// Cuts the first rays into blocks by their pulses and numbers; how many rays, and how many blocks.
fn cut(rays: &[Ray], chunks: &mut Vec<Chunk>) -> (usize, usize) {
    let block = |ray: &Ray| (ray.pulse, ray.number / BLOCK);
    let (mut start, mut tasks) = (0, 0);
    while start < rays.len() && tasks < TASKS {
        let of = block(&rays[start]);
        let most = &rays[start..rays.len().min(start + BLOCK as usize)];
        let count = most.partition_point(|ray| block(ray) == of);
        if chunks.len() == tasks {
            chunks.push(Chunk::default());
        }
        chunks[tasks].begin(of.0, count);
        start += count;
        tasks += 1;
    }
    (start, tasks)
}

/// Puts the blocks' results together, in order: the rays of the group that begins at `start` go behind the `kept` ones.
fn gather(flight: &mut Flight, chunks: &[Chunk], start: usize, mut kept: usize) -> usize {
    let mut first = start;
    for chunk in chunks {
        chunk.tally.book(&mut flight.pulses[chunk.tally.pulse as usize]);
        flight.rays.copy_within(first..first + chunk.live, kept);
        kept += chunk.live;
        first += chunk.rays;
    }
    kept
}
