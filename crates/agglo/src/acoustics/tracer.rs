//! Ray transport: rays advance among grains held still, bounce where they hit, and leave ([A] box 9).
//!
//! Every hit is found exactly, however long the step. A ray ends when it leaves the region or when its power has
//! fallen to the truncation; the books of each pulse ([`PulseCount`](super::PulseCount)) close to rounding.
//! This module applies no force: it hands back the hits.

use rayon::prelude::*;

use super::flight::{Flight, PulseCount, Ray};
use super::fresnel::Interface;
use crate::domain::Region;
use crate::math::Vec3;
use crate::neighbors::ray_grid::{RayGrid, RaySpan, SphereHit};

/// Rays of one task; fixed, so that sums do not depend on the number of threads.
const CHUNK: usize = 256;
/// Bounces in place, between grains that closed in on a ray, after which it is dropped as truncated.
const MOST_IN_PLACE: u32 = 32;
/// Bounces in one advance after which a ray is taken to be caught for ever and is dropped as truncated.
const MOST_IN_ONE_ADVANCE: u32 = 100_000;

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
    /// Direction of what enters the grain, a unit vector; zero at total reflection.
    pub refracted: Vec3,
    /// Power of the ray that comes [W].
    pub power_in: f64,
    /// Part of it that is reflected [1].
    pub reflectance: f64,
    /// Area of the ray in its beam [m²].
    pub ray_area: f64,
}

/// Moves the rays of a [`Flight`]; holds what is the same for all, and buffers that are used again.
#[derive(Clone, Debug)]
pub struct Tracer {
    region: Region,
    interfaces: Vec<Interface>,
    truncation: f64,
    grid: RayGrid,
    chunks: Vec<Chunk>,
    hits: Vec<Hit>,
}

/// What one task gives back.
#[derive(Clone, Debug, Default)]
struct Chunk {
    hits: Vec<Hit>,
    tallies: Vec<Tally>,
    live: usize,
}

/// What one task adds to the books of a pulse.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    pulse: u32,
    reflections: u64,
    escapes: u32,
    drops: u32,
    longest_chain: u32,
    absorbed: f64,
    escaped: f64,
    truncated: f64,
}

/// What rays fly through during one advance.
struct Scene<'a> {
    region: &'a Region,
    interfaces: &'a [Interface],
    truncation: f64,
    grid: &'a RayGrid,
    positions: &'a [Vec3],
    material: &'a [u32],
    distance: f64,
}

impl Tracer {
    /// A tracer for rays in `region`; `interfaces` [materials] by the material's number, and the part of its first
    /// power at which a ray is dropped (0: only when nothing is left).
    pub fn new(region: Region, interfaces: Vec<Interface>, truncation: f64) -> Self {
        let (lower, upper) = region.bounds();
        let grid = RayGrid::new(lower, upper);
        Self { region, interfaces, truncation, grid, chunks: Vec::new(), hits: Vec::new() }
    }

    /// Where rays live.
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// Lets every ray fly `distance` [m] (c dt) among grains held still: `positions` [n, 3] [m], `radii` [n] [m],
    /// `material` [n]. An infinite distance traces all rays to their end.
    ///
    /// Returns the hits in the order of the rays, those of one ray in the order of time.
    pub fn advance(
        &mut self,
        flight: &mut Flight,
        positions: &[Vec3],
        radii: &[f64],
        material: &[u32],
        distance: f64,
    ) -> &[Hit] {
        self.hits.clear();
        if flight.rays.is_empty() {
            return &self.hits;
        }
        self.grid.update(positions, radii);
        let scene = Scene {
            region: &self.region,
            interfaces: &self.interfaces,
            truncation: self.truncation,
            grid: &self.grid,
            positions,
            material,
            distance,
        };
        let tasks = flight.rays.len().div_ceil(CHUNK);
        if self.chunks.len() < tasks {
            self.chunks.resize_with(tasks, Chunk::default);
        }
        let chunks = &mut self.chunks[..tasks];
        if tasks == 1 {
            scene.fly_all(&mut flight.rays, &mut chunks[0]);
        } else {
            let rays = flight.rays.par_chunks_mut(CHUNK);
            rays.zip(chunks.par_iter_mut()).for_each(|(rays, chunk)| scene.fly_all(rays, chunk));
        }
        gather(flight, chunks, &mut self.hits);
        &self.hits
    }

    /// Traces all rays to their end among grains that stay where they are; arguments as in [`Tracer::advance`].
    pub fn trace(
        &mut self,
        flight: &mut Flight,
        positions: &[Vec3],
        radii: &[f64],
        material: &[u32],
    ) -> &[Hit] {
        self.advance(flight, positions, radii, material, f64::INFINITY)
    }
}

/// Puts the tasks' results together, in order.
fn gather(flight: &mut Flight, chunks: &[Chunk], hits: &mut Vec<Hit>) {
    let mut kept = 0;
    for (task, chunk) in chunks.iter().enumerate() {
        hits.extend_from_slice(&chunk.hits);
        for tally in &chunk.tallies {
            tally.book(&mut flight.pulses[tally.pulse as usize]);
        }
        let first = task * CHUNK;
        flight.rays.copy_within(first..first + chunk.live, kept);
        kept += chunk.live;
    }
    flight.rays.truncate(kept);
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
    /// Flies the rays of one task; those still in flight come to the front, in order.
    fn fly_all(&self, rays: &mut [Ray], chunk: &mut Chunk) {
        let Chunk { hits, tallies, live } = chunk;
        hits.clear();
        tallies.clear();
        *live = 0;
        for place in 0..rays.len() {
            let mut ray = rays[place];
            let tally = tally_of(ray.pulse, tallies);
            if self.fly(&mut ray, tally, hits) {
                rays[*live] = ray;
                *live += 1;
            }
        }
    }

    /// Flies one ray; false if it ended.
    fn fly(&self, ray: &mut Ray, tally: &mut Tally, hits: &mut Vec<Hit>) -> bool {
        let mut end = ray.travelled + self.distance;
        if self.grid.is_clear(&ray.clear, end) {
            ray.travelled = end;
            return true;
        }
        let (mut bounces, mut in_place) = (0, 0);
        loop {
            let exit = self.region.exit_distance(ray.origin, ray.direction);
            let span = RaySpan {
                origin: ray.origin,
                direction: ray.direction,
                from: ray.travelled,
                to: end.min(exit),
                skip: ray.last_hit,
            };
            let Some(met) = self.grid.nearest(&span) else {
                if exit > end {
                    ray.travelled = end;
                    ray.clear = self.grid.clear_until(&RaySpan { from: end, to: exit, ..span });
                    return true;
                }
                tally.escapes += 1;
                tally.escaped += ray.power;
                return false;
            };
            end -= met.at;
            bounces += 1;
            in_place = if met.at > ray.travelled { 0 } else { in_place + 1 };
            hits.push(self.bounce(ray, met));
            tally.count(ray, hits);
            let is_caught = in_place > MOST_IN_PLACE || bounces > MOST_IN_ONE_ADVANCE;
            if is_caught || ray.power <= self.truncation * ray.first_power {
                tally.drops += 1;
                tally.truncated += ray.power;
                return false;
            }
        }
    }

    /// The ray bounces off the grain that it met.
    #[inline]
    fn bounce(&self, ray: &mut Ray, met: SphereHit) -> Hit {
        let grain = met.sphere as usize;
        let point = ray.origin + ray.direction * met.at;
        let normal = (point - self.positions[grain]).normalized();
        let scattering = self.interfaces[self.material[grain] as usize].scatter(ray.direction, normal);
        let hit = Hit {
            grain: met.sphere,
            pulse: ray.pulse,
            point,
            normal,
            direction_in: ray.direction,
            direction_out: scattering.reflected,
            refracted: scattering.refracted,
            power_in: ray.power,
            reflectance: scattering.reflectance,
            ray_area: ray.area,
        };
        ray.origin = point;
        ray.direction = scattering.reflected;
        ray.travelled = 0.0;
        ray.power *= scattering.reflectance;
        ray.last_hit = met.sphere;
        ray.bounces += 1;
        hit
    }
}

impl Tally {
    #[inline]
    fn count(&mut self, ray: &Ray, hits: &[Hit]) {
        self.reflections += 1;
        self.longest_chain = self.longest_chain.max(ray.bounces);
        if let Some(hit) = hits.last() {
            self.absorbed += hit.power_in * (1.0 - hit.reflectance);
        }
    }
}
