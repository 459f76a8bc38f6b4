//! Random sequential addition: grains are put at random places, one after the other, where there is room.
//!
//! A place is drawn uniformly from all places where the grain would lie wholly inside the region; if it is too near
//! to a grain that is there already, another place is drawn. Grains never move. Where sizes differ, the larger
//! grains go first (small ones would leave them no room), so ids run from large to small within a group.
//!
//! Where space repeats itself beyond the control volume, centers are drawn from the whole volume, and images are kept
//! clear of like the grains themselves.
//!
//! # Source
//! B. Widom, J. Chem. Phys. 44, 3888 (1966). The search among the remaining gaps, which makes solid fractions up to
//! saturation possible, follows G. Zhang and S. Torquato, Phys. Rev. E 88, 053312 (2013): it draws from a set of
//! cubes that cover all the room there is, hence from the same distribution, and it knows when there is none left.
//!
//! # Valid when
//! Equal spheres come to an end at a solid fraction of 0.384 (0.382 in earlier work) far from walls, and lower
//! near them. Unequal spheres are given up after a bounded number of draws, somewhat before their end.

use std::ops::ControlFlow;

use super::error::{PackingError, SATURATION};
use super::occupied::Occupied;
use super::room::Room;
use super::{Fill, PlaceWatch, RandomAddition, Size};
use crate::domain::{Boundary, Volume};
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::particles::Particles;

/// Failed draws in a row after which equal grains search the remaining gaps.
const PATIENCE: u64 = 2000;
/// Failed draws in a row after which unequal grains are given up.
const LONGEST_SEARCH: u64 = 1_000_000;
/// Draws per grain after which unequal grains are given up.
const DRAWS_PER_GRAIN: u64 = 2000;
/// Rounds of draws, one per cube, from the cubes that cover the gaps.
const ROUNDS: u32 = 100;
/// Cubes are halved once no more than this part of the draws finds room.
const WORN_OUT: f64 = 0.02;
/// Above this number cubes are not halved.
const MOST_CUBES: usize = 4_000_000;
/// More grains than this are refused: they would not fit into memory.
const MOST_GRAINS: f64 = 1e8;
/// Regions narrower than this many grain radii can be filled better than open space.
const NARROW: f64 = 3.0;
/// Nothing is filled more densely than this by grains of like sizes; one grain that fills its region is.
const DENSEST: f64 = 1.0 + 1e-9;

impl RandomAddition {
    /// How many grains are asked for: `count`, or what gives `solid_fraction` on average.
    ///
    /// # Errors
    /// A sentence that says what is wrong where neither, or both, or an impossible value is given.
    pub fn wanted(&self, size: &Size) -> Result<u32, String> {
        wanted(self.count, self.solid_fraction, self.region.volume(), size)
    }
}

impl Fill {
    /// How many grains are asked for: `count`, or what gives `solid_fraction` on average.
    ///
    /// # Errors
    /// A sentence that says what is wrong where neither, or both, or an impossible value is given.
    pub fn wanted(&self, size: &Size, volume: &Volume) -> Result<u32, String> {
        wanted(self.count, self.solid_fraction, volume.volume(), size)
    }
}

/// The count for a volume [m³].
fn wanted(count: Option<u32>, solid_fraction: Option<f64>, volume: f64, size: &Size) -> Result<u32, String> {
    match (count, solid_fraction) {
        _ if !volume.is_finite() || volume <= 0.0 => {
            Err("the region must have a volume above zero".to_owned())
        }
        (Some(0), None) => Err("`count` must be at least 1".to_owned()),
        (Some(count), None) if f64::from(count) > MOST_GRAINS => {
            Err(format!("`count` is {count}, too many for a computer"))
        }
        (Some(count), None) => Ok(count),
        (None, Some(fraction)) if fraction > 0.0 && fraction < 1.0 => {
            let count = (fraction * volume / size.mean_volume()).round();
            if count < 1.0 {
                Err(format!("a solid fraction of {fraction} is less than one grain"))
            } else if count > MOST_GRAINS {
                Err(format!(
                    "a solid fraction of {fraction} needs {count:.1e} grains, too many for a computer"
                ))
            } else {
                Ok(count as u32)
            }
        }
        (None, Some(fraction)) => Err(format!("`solid_fraction` must lie between 0 and 1, not {fraction}")),
        _ => Err("give either `count` or `solid_fraction`".to_owned()),
    }
}

/// What a group asks for.
pub(super) struct Request<'a> {
    /// Seed of the scenario.
    pub seed: u64,
    /// Which group.
    pub group: usize,
    /// Where grains may be.
    pub room: Room,
    /// Least distance [m] between surfaces.
    pub gap: f64,
    /// How many, or what is wrong with the request.
    pub wanted: Result<u32, String>,
    /// How large.
    pub size: &'a Size,
    /// The key below the group, for messages.
    pub key: &'static str,
}

/// Places one group beside the grains that are there already, and their images where a `volume` repeats itself; returns
/// centers [m] and radii [m].
///
/// # Errors
/// [`PackingError::Saturated`] where there is no room, [`PackingError::TooLarge`], [`PackingError::Value`].
pub(super) fn add(
    request: &Request,
    earlier: &Particles,
    volume: Option<&Volume>,
    watch: &mut PlaceWatch<'_>,
) -> Result<Vec<(Vec3, f64)>, PackingError> {
    let &Request { seed, group, ref room, gap, size, key, .. } = request;
    let wanted = request.wanted.clone().map_err(|reason| PackingError::Value { group, key, reason })?;
    if !gap.is_finite() || gap < 0.0 {
        let reason = "`gap` must not be below zero".to_owned();
        return Err(PackingError::Value { group, key, reason });
    }
    let (largest, equal) = (size.largest(), size.largest() == size.smallest());
    let widest = room.largest_radius(gap);
    let solid_fraction = f64::from(wanted) * size.mean_volume() / room.volume();
    let saturated = |placed, reached| {
        Err(PackingError::Saturated { group, placed, wanted: wanted as usize, solid_fraction, reached })
    };
    let too_large = |radius| Err(PackingError::TooLarge { group, radius, room: widest });
    if widest < size.smallest() {
        return too_large(size.smallest());
    }
    // Wide regions: in narrow ones walls can line grains up more densely than in the open.
    if solid_fraction > if equal && widest > NARROW * largest { SATURATION + 0.01 } else { DENSEST } {
        return saturated(0, 0.0);
    }
    let radii = radii_from_large_to_small(size, wanted, seed, group);
    if widest < radii[0] {
        return too_large(radii[0]);
    }
    let search = Search { room, gap, radii: &radii, earlier, volume };
    let placed = search.run(seed, group, equal, watch)?;
    if placed.len() == radii.len() {
        Ok(placed)
    } else {
        saturated(placed.len(), search.solid_fraction(placed.len()))
    }
}

/// Places spheres of given radii [n] [m] at random in the control volume, clear of one another and of their images:
/// centers [n, 3] [m], in the order of the radii.
///
/// # Errors
/// [`PackingError::Saturated`] where there is no room, [`PackingError::TooLarge`].
pub fn fill_with(radii: &[f64], volume: &Volume, seed: u64) -> Result<Vec<Vec3>, PackingError> {
    let mut order: Vec<u32> = (0..radii.len() as u32).collect();
    order.sort_by(|&a, &b| radii[b as usize].total_cmp(&radii[a as usize]));
    let sorted: Vec<f64> = order.iter().map(|&at| radii[at as usize]).collect();
    let (Some(&largest), Some(&smallest)) = (sorted.first(), sorted.last()) else { return Ok(Vec::new()) };
    let room = Room::of_volume(volume);
    let (group, widest) = (0, room.largest_radius(0.0));
    if widest < largest {
        return Err(PackingError::TooLarge { group, radius: largest, room: widest });
    }
    let (earlier, volume) = (&Particles::default(), Some(volume));
    let search = Search { room: &room, gap: 0.0, radii: &sorted, earlier, volume };
    let placed = search.run(seed, group, largest == smallest, &mut || ControlFlow::Continue(()))?;
    if placed.len() < radii.len() {
        let [solid_fraction, reached] = [radii.len(), placed.len()].map(|count| search.solid_fraction(count));
        let (placed, wanted) = (placed.len(), radii.len());
        return Err(PackingError::Saturated { group, placed, wanted, solid_fraction, reached });
    }
    let mut centers = vec![Vec3::ZERO; radii.len()];
    for (at, (center, _)) in order.into_iter().zip(placed) {
        centers[at as usize] = center;
    }
    Ok(centers)
}

fn radii_from_large_to_small(size: &Size, count: u32, seed: u64, group: usize) -> Vec<f64> {
    let mut stream = Stream::new(seed, Purpose::Size, group as u32);
    let mut radii: Vec<f64> = (0..count).map(|_| size.sample(&mut stream)).collect();
    radii.sort_unstable_by(|a, b| b.total_cmp(a));
    radii
}

/// Whether the search is to stop, asked now and then.
struct Asked<'a, 'w> {
    watch: &'a mut PlaceWatch<'w>,
    times: u32,
    is_stopped: bool,
}

impl Asked<'_, '_> {
    /// Draws between two questions.
    const EVERY: u32 = 1 << 12;

    fn is_over(&mut self) -> bool {
        self.times += 1;
        if self.times == Self::EVERY {
            self.times = 0;
            self.is_stopped |= (self.watch)().is_break();
        }
        self.is_stopped
    }

    fn go_on(&self) -> Result<(), PackingError> {
        if self.is_stopped { Err(PackingError::Stopped) } else { Ok(()) }
    }
}

/// The gaps take the numbers of a grain that there is never, so that places do not depend on how many grains are wanted.
const BEYOND_ALL: usize = u32::MAX as usize;

/// Where the random numbers of an attempt to place a grain begin: each attempt has its own, whatever came of those before it and
/// whoever makes it.
fn first_number(grain: usize, attempt: u64) -> u64 {
    (grain as u64) << 32 | attempt << 8
}

/// The request in one place.
struct Search<'a> {
    room: &'a Room,
    gap: f64,
    radii: &'a [f64],
    earlier: &'a Particles,
    volume: Option<&'a Volume>,
}

impl Search<'_> {
    fn solid_fraction(&self, count: usize) -> f64 {
        let cubes: f64 = self.radii[..count].iter().map(|radius| radius.powi(3)).sum();
        4.0 / 3.0 * std::f64::consts::PI * cubes / self.room.volume()
    }

    /// Puts grains until all are placed or no more room is found.
    fn run(
        &self,
        seed: u64,
        group: usize,
        equal: bool,
        watch: &mut PlaceWatch<'_>,
    ) -> Result<Vec<(Vec3, f64)>, PackingError> {
        let mut asked = Asked { watch, times: 0, is_stopped: false };
        let mut occupied = self.occupied_by_earlier();
        let mut stream = Stream::new(seed, Purpose::Placement, group as u32);
        let mut placed = Vec::with_capacity(self.radii.len());
        let (mut draws, most_draws) = (0, LONGEST_SEARCH + DRAWS_PER_GRAIN * self.radii.len() as u64);
        for &radius in self.radii {
            let patience = if equal { PATIENCE } else { LONGEST_SEARCH.min(most_draws - draws) };
            let found = (0..patience).find_map(|attempt| {
                draws += 1;
                stream.jump_to(first_number(placed.len(), attempt));
                let place = self.room.sample(radius, &mut stream);
                place.filter(|&place| asked.is_over() || occupied.is_free(place, radius))
            });
            asked.go_on()?;
            let Some(place) = found else { break };
            occupied.insert(place, radius);
            placed.push((place, radius));
        }
        if equal && placed.len() < self.radii.len() {
            stream.jump_to(first_number(BEYOND_ALL, 0));
            self.fill_gaps(&mut occupied, &mut stream, &mut placed, &mut asked)?;
        }
        Ok(placed)
    }

    fn occupied_by_earlier(&self) -> Occupied {
        let (lower, upper) = self.room.bounds();
        let home = |center: Vec3| self.volume.map_or(center, |volume| volume.wrap(center));
        // A room that repeats itself finds images of its own accord.
        let shifts = match self.volume {
            Some(volume) if self.room.repeats() == [false; 3] => shifts(volume),
            _ => vec![Vec3::ZERO],
        };
        let grains = self.earlier.position.iter().zip(&self.earlier.radius);
        let images = grains.flat_map(|(&center, &radius)| {
            let home = home(center);
            shifts.iter().map(move |&shift| (home + shift, radius))
        });
        let near = images.filter(|&(center, radius)| {
            let reach = self.radii[0] + radius + self.gap;
            (0..3).all(|axis| center[axis] > lower[axis] - reach && center[axis] < upper[axis] + reach)
        });
        let radii = near.clone().map(|(_, radius)| radius).chain(self.radii.iter().copied());
        let mut occupied = Occupied::new((lower, upper), self.room.repeats(), self.gap, radii);
        near.for_each(|(center, radius)| occupied.insert(center, radius));
        occupied
    }

    /// Goes on with draws from cubes that cover all the room left, for equal grains.
    fn fill_gaps(
        &self,
        occupied: &mut Occupied,
        stream: &mut Stream,
        placed: &mut Vec<(Vec3, f64)>,
        asked: &mut Asked<'_, '_>,
    ) -> Result<(), PackingError> {
        let radius = self.radii[0];
        let mut cubes = Cubes::about(&self.room.bounds(), radius);
        let half_edge = cubes.half_edge;
        let mut may_have_room = |middle, half_edge, occupied: &Occupied| {
            !asked.is_over() && self.may_have_room(middle, half_edge, occupied)
        };
        cubes.middles.retain(|&middle| may_have_room(middle, half_edge, occupied));
        for _ in 0..ROUNDS {
            let (draws, before) = (cubes.middles.len(), placed.len());
            for _ in 0..draws {
                if placed.len() == self.radii.len() {
                    return Ok(());
                }
                let place = cubes.sample(stream);
                if self.room.admits(place, radius) && occupied.is_free(place, radius) {
                    occupied.insert(place, radius);
                    placed.push((place, radius));
                }
            }
            // While draws succeed there is no need for smaller cubes.
            let worn_out = (placed.len() - before) as f64 <= WORN_OUT * draws as f64;
            if worn_out && draws < MOST_CUBES {
                cubes.halve(|middle, half_edge| may_have_room(middle, half_edge, occupied));
            } else {
                let half_edge = cubes.half_edge;
                cubes.middles.retain(|&middle| may_have_room(middle, half_edge, occupied));
            }
            if cubes.middles.is_empty() {
                break;
            }
        }
        asked.go_on()
    }

    /// Whether a cube is neither outside the region nor covered by one grain.
    fn may_have_room(&self, middle: Vec3, half_edge: f64, occupied: &Occupied) -> bool {
        let (radius, half_diagonal) = (self.radii[0], half_edge * 3.0_f64.sqrt());
        self.room.may_admit_near(middle, radius, half_diagonal * (1.0 + 1e-9))
            && !occupied.covers(middle, half_edge, radius)
    }
}

/// The vectors [m] to a volume and to those about it that it repeats itself in.
fn shifts(volume: &Volume) -> Vec<Vec3> {
    let (edges, wraps) = (volume.edges(), volume.boundaries().map(Boundary::wraps));
    let along = |axis: usize| -> Vec<f64> {
        let steps: &[f64] = if wraps[axis] { &[-1.0, 0.0, 1.0] } else { &[0.0] };
        steps.iter().map(|step| step * edges[axis]).collect()
    };
    let [xs, ys, zs] = [along(0), along(1), along(2)];
    let plane = zs.iter().flat_map(|&z| ys.iter().map(move |&y| (y, z)));
    plane.flat_map(|(y, z)| xs.iter().map(move |&x| Vec3::new(x, y, z))).collect()
}

/// Equal cubes that cover the room that is left.
struct Cubes {
    half_edge: f64,
    middles: Vec<Vec3>,
}

impl Cubes {
    /// Cubes over the box `bounds` with edges of about a grain's radius.
    fn about((lower, upper): &(Vec3, Vec3), radius: f64) -> Self {
        let counts_at = |edge: f64| (*upper - *lower).to_array().map(|along| (along / edge).ceil().max(1.0));
        let mut edge = radius;
        while counts_at(edge).iter().product::<f64>() > 8.0 * MOST_CUBES as f64 {
            edge *= 1.1;
        }
        let [nx, ny, nz] = counts_at(edge).map(|count| count as u32);
        let mut middles = Vec::with_capacity(nx as usize * ny as usize * nz as usize);
        let at = |k: u32| (f64::from(k) + 0.5) * edge;
        for k in 0..nz {
            for j in 0..ny {
                middles.extend((0..nx).map(|i| *lower + Vec3::new(at(i), at(j), at(k))));
            }
        }
        // A shade larger than the spacing, so that rounding leaves no seam uncovered.
        Self { half_edge: 0.5 * edge * (1.0 + 1e-12), middles }
    }

    fn sample(&self, stream: &mut Stream) -> Vec3 {
        let count = self.middles.len();
        let cube = ((stream.uniform() * count as f64) as usize).min(count - 1);
        let mut signed = || (2.0 * stream.uniform() - 1.0) * self.half_edge;
        let offset = Vec3::new(signed(), signed(), signed());
        self.middles[cube] + offset
    }

    /// Puts the eight halves of each cube in its place, those that `may_have_room` (middle, half edge).
    fn halve(&mut self, mut may_have_room: impl FnMut(Vec3, f64) -> bool) {
        self.half_edge *= 0.5;
        let half = self.half_edge;
        let side = |corner: u32, axis: u32| if corner >> axis & 1 == 0 { -half } else { half };
        let eighths = [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| [0, 1, 2].map(|axis| side(corner, axis)).into());
        let smaller = self.middles.iter().flat_map(|&middle| eighths.map(|by: Vec3| middle + by));
        self.middles = smaller.filter(|&middle| may_have_room(middle, half)).collect();
    }
}
