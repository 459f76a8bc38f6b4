//! A block of rays on its way through one advance of a [`Tracer`](super::Tracer): what each of them meets, and how it goes on.

use rayon::prelude::*;

use super::flight::{FIRST_FACE, Ray};
use super::follow::Followed;
use super::fresnel::Interface;
use super::hit::{Ends, Hit, NONE, Targets};
use super::tally::{BLOCK, Tally};
use crate::domain::{Region, Space};
use crate::math::Vec3;
use crate::neighbors::ray_grid::{RayGrid, RaySpan, SphereHit};
use crate::walls::{AtWall, Line, Mirrors, RayAtWalls};

/// Tasks that hold hits at one time, one for each block of rays ([`BLOCK`]).
pub(super) const TASKS: usize = 64;
/// Hits that a task gathers before they are handed out: a few more than 256 rays have in a whole agglomerate.
const BATCH: usize = 2048;
/// Bounces in place, between grains that closed in on a ray, after which it is dropped as crushed.
const MOST_IN_PLACE: u32 = 32;

/// A block of rays: what is to be done, and what comes of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Chunk {
    hits: Vec<Hit>,
    pub tally: Tally,
    /// How many rays there are, how many of them were dealt with, and how many of those are in flight.
    pub rays: usize,
    done: usize,
    pub live: usize,
    /// The next ray, if it was left in the middle of its way.
    leg: Option<Leg>,
}

/// How far a ray is still to fly, seen from the beginning of its straight segment, and how often it bounced in place.
#[derive(Clone, Copy, Debug)]
struct Leg {
    end: f64,
    in_place: u32,
    /// Whether it is the ray's first one in this advance.
    is_first: bool,
}

/// What became of a ray.
#[derive(Clone, Copy, Debug)]
enum Fate {
    Flies,
    Ended,
    /// The batch of hits is full; the way goes on.
    Waits(Leg),
}

/// Where rays leave.
#[derive(Clone, Copy, Debug)]
pub(super) enum Way<'a> {
    Out(&'a Region),
    Past(Followed),
}

/// What rays fly through during one advance.
pub(super) struct Scene<'a> {
    pub way: Way<'a>,
    pub ends: &'a Ends,
    pub interfaces: &'a [Interface],
    pub space: &'a Space,
    pub mirrors: Option<&'a Mirrors>,
    pub grid: &'a RayGrid,
    pub targets: Targets<'a>,
    pub distance: f64,
}

impl Scene<'_> {
    /// Flies a group of rays, each as far as it comes; hits are handed out block by block.
    pub fn fly_group(&self, rays: &mut [Ray], chunks: &mut [Chunk], take: &mut impl FnMut(&[Hit])) {
        let mut first = 0;
        while first < chunks.len() {
            self.fly_all(rays, chunks);
            // Blocks behind one that is not done wait with their hits.
            while let Some(chunk) = chunks.get_mut(first) {
                if !chunk.hits.is_empty() {
                    take(&chunk.hits);
                    chunk.hits.clear();
                }
                if chunk.done < chunk.rays {
                    break;
                }
                first += 1;
            }
        }
    }

    /// Flies the rays of all blocks until they are done or their batches of hits are full.
    fn fly_all(&self, rays: &mut [Ray], chunks: &mut [Chunk]) {
        let mut rest = &mut *rays;
        if rest.len() <= BLOCK as usize {
            for chunk in chunks {
                let (own, others) = rest.split_at_mut(chunk.rays);
                self.fly_some(own, chunk);
                rest = others;
            }
            return;
        }
        let count = chunks.len();
        let least = (count * BLOCK as usize / rest.len()).max(1);
        let mut tasks = [const { None }; TASKS];
        for (task, chunk) in tasks.iter_mut().zip(chunks) {
            let (own, others) = rest.split_at_mut(chunk.rays);
            *task = Some((own, chunk));
            rest = others;
        }
        let tasks = tasks[..count].par_iter_mut().with_min_len(least);
        tasks.flatten().for_each(|(rays, chunk)| self.fly_some(rays, chunk));
    }

    /// Flies rays of one block until all are done or a batch of hits is full; those still in flight come to the front, in
    /// order.
    fn fly_some(&self, rays: &mut [Ray], chunk: &mut Chunk) {
        while chunk.done < rays.len() && chunk.hits.len() < BATCH {
            let mut ray = rays[chunk.done];
            let fresh = Leg { end: ray.traveled + self.distance, in_place: 0, is_first: true };
            let leg = chunk.leg.take();
            let fate = if leg.is_none() && self.is_clear(&ray, fresh.end) {
                ray.traveled = fresh.end;
                Fate::Flies
            } else {
                self.fly(&mut ray, leg.unwrap_or(fresh), &mut chunk.tally, &mut chunk.hits)
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
            && end < self.ends.way - ray.way
            && self.wall_ahead(ray, true).is_none_or(|wall| end < wall.at)
    }

    /// Where a ray leaves for good [m].
    #[inline]
    fn exit(&self, ray: &Ray) -> f64 {
        match &self.way {
            Way::Out(region) => region.exit_distance(ray.origin, ray.direction),
            Way::Past(ball) => ball.exit_distance(ray.origin, ray.direction),
        }
    }

    /// The wall that a ray comes upon next, if no grain is before it.
    #[inline]
    fn wall_ahead(&self, ray: &Ray, is_first: bool) -> Option<AtWall> {
        let mirrors = self.mirrors?;
        let line = Line { origin: ray.origin, direction: ray.direction, from: ray.traveled };
        let was_here = is_first && ray.traveled > 0.0;
        mirrors.first(&RayAtWalls { line, left: ray.last_face(), was_here })
    }

    /// The grain that a ray meets first, and the way [m] from the grain to its image that is met.
    #[inline]
    fn grain_ahead(&self, span: &RaySpan) -> Option<(SphereHit, Vec3)> {
        if self.space.repeats() {
            self.grid.nearest_image(span).map(|met| (met.hit, met.shift))
        } else {
            self.grid.nearest(span).map(|met| (met, Vec3::ZERO))
        }
    }

    /// Flies one ray.
    fn fly(&self, ray: &mut Ray, mut leg: Leg, tally: &mut Tally, hits: &mut Vec<Hit>) -> Fate {
        loop {
            if hits.len() >= BATCH {
                return Fate::Waits(leg);
            }
            let (wall, end) = (self.wall_ahead(ray, leg.is_first), leg.end);
            let exit = match (&wall, &self.way) {
                // It comes back.
                (Some(_), Way::Past(_)) => f64::INFINITY,
                _ => self.exit(ray),
            };
            let followed = self.ends.way - ray.way;
            let to = end.min(exit).min(followed);
            let span = RaySpan {
                origin: ray.origin,
                direction: ray.direction,
                from: ray.traveled,
                to: wall.map_or(to, |wall| to.min(wall.at)),
                skip: ray.last_hit,
            };
            let (at, hit) = if let Some((met, shift)) = self.grain_ahead(&span) {
                let at = met.at;
                leg.next(ray, at);
                (at, self.bounce(ray, met, shift))
            } else if let Some(wall) = wall.filter(|wall| wall.at <= to) {
                leg.next(ray, wall.at);
                (wall.at, self.bounce_off_wall(ray, &wall))
            } else if followed <= end && followed <= exit {
                tally.cut_off(ray);
                return Fate::Ended;
            } else if exit > end {
                ray.traveled = end;
                let to = if matches!(self.way, Way::Out(_)) { exit } else { f64::INFINITY };
                ray.clear = self.grid.clear_until(&RaySpan { from: end, to, ..span });
                return Fate::Flies;
            } else {
                tally.escape(ray);
                return Fate::Ended;
            };
            ray.way += at;
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

    /// The ray bounces off the grain that it met, and goes on from where that is at home.
    #[inline]
    fn bounce(&self, ray: &mut Ray, met: SphereHit, shift: Vec3) -> Hit {
        let grain = met.sphere as usize;
        let point = ray.origin - shift + ray.direction * met.at;
        let normal = (point - self.targets.positions[grain]).normalized();
        let interface = &self.interfaces[self.targets.material[grain] as usize];
        let hit = scattered(ray, point, normal, interface);
        (ray.origin, ray.last_hit) = (point, met.sphere);
        Hit { grain: met.sphere, ..hit }
    }

    /// The ray bounces off the wall that it met, and goes on from there, or from the image of that place within the faces.
    fn bounce_off_wall(&self, ray: &mut Ray, met: &AtWall) -> Hit {
        let point = self.space.home(ray.origin + ray.direction * met.at).0;
        let hit = scattered(ray, point, met.normal, &self.interfaces[met.material as usize]);
        (ray.origin, ray.last_hit) = (point, FIRST_FACE + met.face);
        Hit { wall: met.wall, ..hit }
    }
}

impl Chunk {
    /// Rays of a pulse, none of them dealt with.
    pub fn begin(&mut self, pulse: u32, rays: usize) {
        (self.rays, self.done, self.live, self.leg) = (rays, 0, 0, None);
        self.tally = Tally::of(pulse);
    }
}

impl Leg {
    /// What is left behind a bounce at a distance [m] along the ray.
    #[inline]
    fn next(&mut self, ray: &Ray, at: f64) {
        self.end -= at;
        self.in_place = if at > ray.traveled { 0 } else { self.in_place + 1 };
        self.is_first = false;
    }
}

/// A bounce of a ray at a point [m]; it goes on from there, which is left to the caller.
#[inline]
fn scattered(ray: &mut Ray, point: Vec3, normal: Vec3, interface: &Interface) -> Hit {
    let scattering = interface.scatter(ray.direction, normal);
    let hit = Hit {
        grain: NONE,
        wall: NONE,
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
    ray.direction = scattering.reflected;
    ray.traveled = 0.0;
    ray.power *= scattering.reflectance;
    ray.bounces += 1;
    hit
}
