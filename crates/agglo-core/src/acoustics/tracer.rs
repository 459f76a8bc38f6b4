//! Ray transport: rays advance among grains held still, bounce where they hit, and leave ([A] box 9).
//!
//! Every hit is found exactly, however long the step. A ray ends when it can hit no grain any more
//! ([`Followed`](super::Followed)), or when it leaves the region if one is given; or it is dropped, when its power has
//! fallen to the truncation or it has bounced too often. The books of each pulse ([`PulseCount`](super::PulseCount)) close
//! to rounding. This module applies no force: it hands out the hits, in batches of bounded size.

use rayon::prelude::*;

use super::flight::{Flight, PulseCount, Ray};
use super::follow::Followed;
use super::fresnel::Interface;
use crate::domain::Region;
use crate::math::Vec3;
use crate::neighbors::ray_grid::{RayGrid, RaySpan, SphereHit};

/// Rays of one task; fixed, so that sums do not depend on the number of threads.
const CHUNK: usize = 256;
/// Tasks that hold hits at one time.
const TASKS: usize = 64;
/// Hits that a task gathers before they are handed out: a few more than 256 rays have in a whole agglomerate.
const BATCH: usize = 2048;
/// Bounces in place, between grains that closed in on a ray, after which it is dropped as crushed.
const MOST_IN_PLACE: u32 = 32;

/// A ray hits a grain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Hit {
    /// Index of the grain.
    pub grain: u32,
    /// Place of the ray's pulse in [`Flight::pulses`].
    pub pulse: u32,
    /// Where [m].
    pub point: Vec3,
    /// Outward normal of the grain, a unit vector.
    pub normal: Vec3,
    /// Direction of the ray that comes, a unit vector.
    pub direction_in: Vec3,
    /// Direction of the ray that goes, a unit vector.
    pub direction_out: Vec3,
    /// Direction of the sound that enters the grain, a unit vector; zero beyond its critical angle.
    pub refracted: Vec3,
    /// Direction of the shear wave that enters the grain, a unit vector; zero where there is none.
    pub refracted_shear: Vec3,
    /// Power of the ray that comes [W].
    pub power_in: f64,
    /// Part of it that is reflected [1].
    pub reflectance: f64,
    /// Part of it that enters as a shear wave [1].
    pub sheared: f64,
    /// Area of the ray in its beam [m²].
    pub ray_area: f64,
}

/// How rays end.
#[derive(Clone, Debug, PartialEq)]
pub struct Ends {
    /// Rays that leave it are lost; if there is none, rays end where they can hit no grain any more.
    pub region: Option<Region>,
    /// Part of its first power at which a ray is dropped (0: only when nothing is left).
    pub truncation: f64,
    /// Bounces after which a ray is dropped.
    pub bounces: u32,
}

impl Default for Ends {
    fn default() -> Self {
        Self { region: None, truncation: 0.0, bounces: 10_000_000 }
    }
}

/// The grains that rays fly among, as they are now.
#[derive(Clone, Copy, Debug)]
pub struct Targets<'a> {
    /// Centers [n, 3] [m].
    pub positions: &'a [Vec3],
    /// Radii [n] [m].
    pub radii: &'a [f64],
    /// Numbers of the materials [n].
    pub material: &'a [u32],
    /// Speed of the fastest grain over that of sound in the medium.
    pub mach: f64,
}

/// Moves the rays of a [`Flight`]; holds what is the same for all, and buffers that are used again.
#[derive(Clone, Debug)]
pub struct Tracer {
    ends: Ends,
    interfaces: Vec<Interface>,
    grid: RayGrid,
    chunks: Vec<Chunk>,
}

/// What one task gives back.
#[derive(Clone, Debug, Default)]
struct Chunk {
    hits: Vec<Hit>,
    tallies: Vec<Tally>,
    /// Rays that were dealt with, and how many of them are in flight.
    done: usize,
    live: usize,
    /// The next ray, if it was left in the middle of its way.
    leg: Option<Leg>,
}

/// How far a ray is still to fly, seen from the beginning of its straight segment, and how often it bounced in place.
#[derive(Clone, Copy, Debug)]
struct Leg {
    end: f64,
    in_place: u32,
}

/// What became of a ray.
#[derive(Clone, Copy, Debug)]
enum Fate {
    Flies,
    Ended,
    /// The batch of hits is full; the way goes on.
    Waits(Leg),
}

/// What one task adds to the books of a pulse.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    pulse: u32,
    reflections: u64,
    escapes: u32,
    capped: u32,
    crushed: u32,
    blocked: u32,
    drops: u32,
    longest_chain: u32,
    absorbed: f64,
    escaped: f64,
    truncated: f64,
    flow_ended: Vec3,
    squares_ended: f64,
}

/// Where rays leave.
#[derive(Clone, Copy, Debug)]
enum Way<'a> {
    Out(&'a Region),
    Past(Followed),
}

/// What rays fly through during one advance.
struct Scene<'a> {
    way: Way<'a>,
    ends: &'a Ends,
    interfaces: &'a [Interface],
    grid: &'a RayGrid,
    targets: Targets<'a>,
    distance: f64,
}

impl Tracer {
    /// A tracer for rays that end so; `interfaces` [materials] by the material's number.
    pub fn new(ends: Ends, interfaces: Vec<Interface>) -> Self {
        let everywhere = Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY);
        let (lower, upper) = ends.region.as_ref().map_or((-everywhere, everywhere), Region::bounds);
        Self { ends, interfaces, grid: RayGrid::new(lower, upper), chunks: Vec::new() }
    }

    /// The region in which rays live, if one is given.
    pub fn region(&self) -> Option<&Region> {
        self.ends.region.as_ref()
    }

    /// Lets every ray fly `distance` [m] (c dt) among grains held still. An infinite distance traces all rays to their
    /// end. Hands out the hits: batch by batch, in an order that does not depend on the number of threads, those of one ray in
    /// the order of time.
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
        let way = match &self.ends.region {
            Some(region) => Way::Out(region),
            None => Way::Past(Followed::of(targets.positions, targets.radii, targets.mach)),
        };
        let (ends, interfaces, grid) = (&self.ends, &self.interfaces, &self.grid);
        let scene = Scene { way, ends, interfaces, grid, targets: *targets, distance };
        let (mut start, mut kept) = (0, 0);
        while start < flight.rays.len() {
            let end = flight.rays.len().min(start + TASKS * CHUNK);
            let tasks = (end - start).div_ceil(CHUNK);
            if self.chunks.len() < tasks {
                self.chunks.resize_with(tasks, Chunk::default);
            }
            let chunks = &mut self.chunks[..tasks];
            scene.fly_group(&mut flight.rays[start..end], chunks, &mut take);
            kept = gather(flight, chunks, start, kept);
            start = end;
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
        let latest = flight.pulses.len().checked_sub(1)?;
        let mut tally = Tally { pulse: latest as u32, ..Tally::default() };
        let mut first = None;
        let grid = &self.grid;
        flight.rays.retain(|ray| {
            let inside = (ray.pulse as usize == latest).then(|| grid.sphere_around(ray.origin)).flatten();
            if inside.is_some() {
                tally.blocked += 1;
                tally.drop(ray);
                first = first.or(inside);
            }
            inside.is_none()
        });
        tally.book(&mut flight.pulses[latest]);
        first.map(|grain| (tally.blocked, grain))
    }
}

/// Puts the tasks' results together, in order: the rays of the group that begins at `start` go behind the `kept` ones.
fn gather(flight: &mut Flight, chunks: &[Chunk], start: usize, mut kept: usize) -> usize {
    for (task, chunk) in chunks.iter().enumerate() {
        for tally in &chunk.tallies {
            tally.book(&mut flight.pulses[tally.pulse as usize]);
        }
        let first = start + task * CHUNK;
        flight.rays.copy_within(first..first + chunk.live, kept);
        kept += chunk.live;
    }
    kept
}

impl Tally {
    fn book(&self, count: &mut PulseCount) {
        count.reflections += self.reflections;
        count.segments += self.reflections + u64::from(self.escapes);
        count.in_flight -= self.escapes + self.drops;
        count.longest_chain = count.longest_chain.max(self.longest_chain);
        count.power_absorbed += self.absorbed;
        count.power_escaped += self.escaped;
        count.power_truncated += self.truncated;
        count.flow_ended += self.flow_ended;
        count.squares_ended += self.squares_ended;
        count.capped += self.capped;
        count.crushed += self.crushed;
        count.blocked += self.blocked;
    }

    #[inline]
    fn count(&mut self, ray: &Ray, hit: &Hit) {
        self.reflections += 1;
        self.longest_chain = self.longest_chain.max(ray.bounces);
        self.absorbed += hit.power_in * (1.0 - hit.reflectance);
    }

    fn escape(&mut self, ray: &Ray) {
        self.escapes += 1;
        self.escaped += ray.power;
        self.end(ray);
    }

    fn drop(&mut self, ray: &Ray) {
        self.drops += 1;
        self.truncated += ray.power;
        self.end(ray);
    }

    fn end(&mut self, ray: &Ray) {
        self.flow_ended += ray.direction * ray.power;
        self.squares_ended += ray.power * ray.power;
    }
}

/// The tally of a pulse; rays of one pulse follow one another, so it is the last or a new one.
fn tally_of(pulse: u32, tallies: &mut Vec<Tally>) -> &mut Tally {
    if tallies.last().is_none_or(|tally| tally.pulse != pulse) {
        tallies.push(Tally { pulse, ..Tally::default() });
    }
    let last = tallies.len() - 1;
    &mut tallies[last]
}

impl Scene<'_> {
    /// Flies a group of rays, each as far as it comes; batches of hits are handed out in the order of the tasks.
    fn fly_group(&self, rays: &mut [Ray], chunks: &mut [Chunk], take: &mut impl FnMut(&[Hit])) {
        for chunk in &mut *chunks {
            chunk.tallies.clear();
            (chunk.done, chunk.live, chunk.leg) = (0, 0, None);
        }
        loop {
            if let [chunk] = chunks {
                self.fly_some(rays, chunk);
            } else {
                let tasks = rays.par_chunks_mut(CHUNK).zip(chunks.par_iter_mut());
                tasks.for_each(|(rays, chunk)| self.fly_some(rays, chunk));
            }
            for chunk in &mut *chunks {
                if !chunk.hits.is_empty() {
                    take(&chunk.hits);
                    chunk.hits.clear();
                }
            }
            if chunks.iter().zip(rays.chunks(CHUNK)).all(|(chunk, rays)| chunk.done == rays.len()) {
                break;
            }
        }
    }

    /// Flies rays of one task until all are done or a batch of hits is full; those still in flight come to the front, in
    /// order.
    fn fly_some(&self, rays: &mut [Ray], chunk: &mut Chunk) {
        while chunk.done < rays.len() && chunk.hits.len() < BATCH {
            let mut ray = rays[chunk.done];
            let fresh = Leg { end: ray.traveled + self.distance, in_place: 0 };
            let leg = chunk.leg.take();
            let tally = tally_of(ray.pulse, &mut chunk.tallies);
            let fate = if leg.is_none() && self.is_clear(&ray, fresh.end) {
                ray.traveled = fresh.end;
                Fate::Flies
            } else {
                self.fly(&mut ray, leg.unwrap_or(fresh), tally, &mut chunk.hits)
            };
            match fate {
                Fate::Flies => {
                    rays[chunk.live] = ray;
                    chunk.live += 1;
                }
                Fate::Ended => {}
                Fate::Waits(leg) => {
                    rays[chunk.done] = ray;
                    chunk.leg = Some(leg);
                    return;
                }
            }
            chunk.done += 1;
        }
    }

    /// Whether a ray is known to meet nothing and not to leave up to `end` [m].
    #[inline]
    fn is_clear(&self, ray: &Ray, end: f64) -> bool {
        self.grid.is_clear(&ray.clear, end)
            && match self.way {
                // What was clear was so inside the region only.
                Way::Out(_) => true,
                Way::Past(_) => end < self.exit(ray),
            }
    }

    /// Where a ray leaves for good [m].
    #[inline]
    fn exit(&self, ray: &Ray) -> f64 {
        match &self.way {
            Way::Out(region) => region.exit_distance(ray.origin, ray.direction),
            Way::Past(ball) => ball.exit_distance(ray.origin, ray.direction),
        }
    }

    /// Flies one ray.
    fn fly(&self, ray: &mut Ray, mut leg: Leg, tally: &mut Tally, hits: &mut Vec<Hit>) -> Fate {
        loop {
            if hits.len() >= BATCH {
                return Fate::Waits(leg);
            }
            let (end, exit) = (leg.end, self.exit(ray));
            let span = RaySpan {
                origin: ray.origin,
                direction: ray.direction,
                from: ray.traveled,
                to: end.min(exit),
                skip: ray.last_hit,
            };
            let Some(met) = self.grid.nearest(&span) else {
                if exit > end {
                    ray.traveled = end;
                    let to = if matches!(self.way, Way::Out(_)) { exit } else { f64::INFINITY };
                    ray.clear = self.grid.clear_until(&RaySpan { from: end, to, ..span });
                    return Fate::Flies;
                }
                tally.escape(ray);
                return Fate::Ended;
            };
            leg.end -= met.at;
            leg.in_place = if met.at > ray.traveled { 0 } else { leg.in_place + 1 };
            let hit = self.bounce(ray, met);
            tally.count(ray, &hit);
            hits.push(hit);
            if self.is_dropped(ray, leg, tally) {
                tally.drop(ray);
                return Fate::Ended;
            }
        }
    }

    /// Whether a ray that has just bounced ends here; the reason is counted unless its power is the reason.
    #[inline]
    fn is_dropped(&self, ray: &Ray, leg: Leg, tally: &mut Tally) -> bool {
        if ray.power <= self.ends.truncation * ray.first_power {
            return true;
        }
        if leg.in_place > MOST_IN_PLACE {
            tally.crushed += 1;
            return true;
        }
        let is_capped = ray.bounces >= self.ends.bounces;
        tally.capped += u32::from(is_capped);
        is_capped
    }

    /// The ray bounces off the grain that it met.
    #[inline]
    fn bounce(&self, ray: &mut Ray, met: SphereHit) -> Hit {
        let grain = met.sphere as usize;
        let point = ray.origin + ray.direction * met.at;
        let normal = (point - self.targets.positions[grain]).normalized();
        let interface = &self.interfaces[self.targets.material[grain] as usize];
        let scattering = interface.scatter(ray.direction, normal);
        let hit = Hit {
            grain: met.sphere,
            pulse: ray.pulse,
            point,
            normal,
            direction_in: ray.direction,
            direction_out: scattering.reflected,
            refracted: scattering.refracted,
            refracted_shear: scattering.refracted_shear,
            power_in: ray.power,
            reflectance: scattering.reflectance,
            sheared: scattering.sheared,
            ray_area: ray.area,
        };
        ray.origin = point;
        ray.direction = scattering.reflected;
        ray.traveled = 0.0;
        ray.power *= scattering.reflectance;
        ray.last_hit = met.sphere;
        ray.bounces += 1;
        hit
    }
}
