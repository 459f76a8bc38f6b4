//! Random sequential addition: grains are put at random places, one after the other, where there is room.
//!
//! A place is drawn uniformly from all places where the grain would lie wholly inside the region; if it is too near
//! to a grain that is there already, another place is drawn. Grains never move. Where sizes differ, the larger
//! grains go first (small ones would leave them no room), so names run from large to small within a group.
//!
//! # Source
//! B. Widom, J. Chem. Phys. 44, 3888 (1966). The search among the remaining gaps, which makes solid fractions up to
//! saturation possible, follows G. Zhang and S. Torquato, Phys. Rev. E 88, 053312 (2013): it draws from a set of
//! cubes that cover all the room there is, hence from the same distribution, and it knows when there is none left.
//!
//! # Valid when
//! Equal spheres come to an end at a solid fraction of 0.384 (0.382 in earlier work) far from walls, and lower
//! near them. Unequal spheres are given up after a bounded number of draws, somewhat before their end.

use super::error::{PackingError, SATURATION};
use super::occupied::Occupied;
use super::{RandomAddition, Size};
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};

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
        let volume = self.region.volume();
        match (self.count, self.solid_fraction) {
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
            (None, Some(fraction)) => {
                Err(format!("`solid_fraction` must lie between 0 and 1, not {fraction}"))
            }
            _ => Err("give either `count` or `solid_fraction`".to_owned()),
        }
    }
}

/// Places one group beside the grains `earlier` (centre [m], radius [m]); returns centres [m] and radii [m].
///
/// # Errors
/// [`PackingError::Saturated`] where there is no room, [`PackingError::TooLarge`], [`PackingError::Value`].
pub(super) fn add(
    addition: &RandomAddition,
    size: &Size,
    seed: u64,
    group: usize,
    earlier: &[(Vec3, f64)],
) -> Result<Vec<(Vec3, f64)>, PackingError> {
    let wanted = addition.wanted(size).map_err(|reason| PackingError::Value {
        group,
        key: "placement.random",
        reason,
    })?;
    let gap = addition.gap.si();
    if !gap.is_finite() || gap < 0.0 {
        let reason = "the gap must not be below zero".to_owned();
        return Err(PackingError::Value { group, key: "placement.random.gap", reason });
    }
    let (largest, equal) = (size.largest(), size.largest() == size.smallest());
    let room = addition.region.inner_radius();
    let solid_fraction = f64::from(wanted) * size.mean_volume() / addition.region.volume();
    let saturated = |placed, reached| {
        Err(PackingError::Saturated { group, placed, wanted: wanted as usize, solid_fraction, reached })
    };
    let too_large = |radius| Err(PackingError::TooLarge { group, radius, room });
    if room < size.smallest() {
        return too_large(size.smallest());
    }
    // Wide regions: in narrow ones walls can line grains up more densely than in the open.
    if solid_fraction > if equal && room > NARROW * largest { SATURATION + 0.01 } else { DENSEST } {
        return saturated(0, 0.0);
    }
    let radii = radii_from_large_to_small(size, wanted, seed, group);
    if room < radii[0] {
        return too_large(radii[0]);
    }
    let search = Search { addition, gap, radii: &radii, earlier };
    let placed = search.run(seed, group, equal);
    if placed.len() == radii.len() {
        Ok(placed)
    } else {
        saturated(placed.len(), search.solid_fraction(placed.len()))
    }
}

fn radii_from_large_to_small(size: &Size, count: u32, seed: u64, group: usize) -> Vec<f64> {
    let mut stream = Stream::new(seed, Purpose::Size, group as u32);
    let mut radii: Vec<f64> = (0..count).map(|_| size.sample(&mut stream)).collect();
    radii.sort_unstable_by(|a, b| b.total_cmp(a));
    radii
}

/// The request in one place.
struct Search<'a> {
    addition: &'a RandomAddition,
    gap: f64,
    radii: &'a [f64],
    earlier: &'a [(Vec3, f64)],
}

impl Search<'_> {
    fn solid_fraction(&self, count: usize) -> f64 {
        let cubes: f64 = self.radii[..count].iter().map(|radius| radius.powi(3)).sum();
        4.0 / 3.0 * std::f64::consts::PI * cubes / self.addition.region.volume()
    }

    /// Puts grains until all are placed or no more room is found.
    fn run(&self, seed: u64, group: usize, equal: bool) -> Vec<(Vec3, f64)> {
        let mut occupied = self.occupied_by_earlier();
        let mut stream = Stream::new(seed, Purpose::Placement, group as u32);
        let mut placed = Vec::with_capacity(self.radii.len());
        let (mut draws, most_draws) = (0, LONGEST_SEARCH + DRAWS_PER_GRAIN * self.radii.len() as u64);
        for &radius in self.radii {
            let patience = if equal { PATIENCE } else { LONGEST_SEARCH.min(most_draws - draws) };
            let found = (0..patience).find_map(|_| {
                draws += 1;
                let place = self.addition.region.sample(radius, &mut stream)?;
                occupied.is_free(place, radius).then_some(place)
            });
            let Some(place) = found else { break };
            occupied.insert(place, radius);
            placed.push((place, radius));
        }
        if equal && placed.len() < self.radii.len() {
            self.fill_gaps(&mut occupied, &mut stream, &mut placed);
        }
        placed
    }

    fn occupied_by_earlier(&self) -> Occupied {
        let (lower, upper) = self.addition.region.bounds();
        let near = self.earlier.iter().filter(|&&(center, radius)| {
            let reach = self.radii[0] + radius + self.gap;
            (0..3).all(|axis| center[axis] > lower[axis] - reach && center[axis] < upper[axis] + reach)
        });
        let radii = near.clone().map(|&(_, radius)| radius).chain(self.radii.iter().copied());
        let mut occupied = Occupied::new((lower, upper), self.gap, radii);
        near.for_each(|&(center, radius)| occupied.insert(center, radius));
        occupied
    }

    /// Goes on with draws from cubes that cover all the room left, for equal grains.
    fn fill_gaps(&self, occupied: &mut Occupied, stream: &mut Stream, placed: &mut Vec<(Vec3, f64)>) {
        let radius = self.radii[0];
        let mut cubes = Cubes::about(&self.addition.region.bounds(), radius);
        cubes.middles.retain(|&middle| self.may_have_room(middle, cubes.half_edge, occupied));
        for _ in 0..ROUNDS {
            let (draws, before) = (cubes.middles.len(), placed.len());
            for _ in 0..draws {
                if placed.len() == self.radii.len() {
                    return;
                }
                let place = cubes.sample(stream);
                if self.addition.region.contains(place, radius) && occupied.is_free(place, radius) {
                    occupied.insert(place, radius);
                    placed.push((place, radius));
                }
            }
            // While draws succeed there is no need for smaller cubes.
            let worn_out = (placed.len() - before) as f64 <= WORN_OUT * draws as f64;
            if worn_out && draws < MOST_CUBES {
                cubes.halve(|middle, half_edge| self.may_have_room(middle, half_edge, occupied));
            } else {
                cubes.middles.retain(|&middle| self.may_have_room(middle, cubes.half_edge, occupied));
            }
            if cubes.middles.is_empty() {
                return;
            }
        }
    }

    /// Whether a cube is neither outside the region nor covered by one grain.
    fn may_have_room(&self, middle: Vec3, half_edge: f64, occupied: &Occupied) -> bool {
        let (radius, half_diagonal) = (self.radii[0], half_edge * 3.0_f64.sqrt());
        self.addition.region.contains(middle, radius - half_diagonal * (1.0 + 1e-9))
            && !occupied.covers(middle, half_edge, radius)
    }
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
    fn halve(&mut self, may_have_room: impl Fn(Vec3, f64) -> bool) {
        self.half_edge *= 0.5;
        let half = self.half_edge;
        let side = |corner: u32, axis: u32| if corner >> axis & 1 == 0 { -half } else { half };
        let eighths = [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| [0, 1, 2].map(|axis| side(corner, axis)).into());
        let smaller = self.middles.iter().flat_map(|&middle| eighths.map(|by: Vec3| middle + by));
        self.middles = smaller.filter(|&middle| may_have_room(middle, half)).collect();
    }
}
