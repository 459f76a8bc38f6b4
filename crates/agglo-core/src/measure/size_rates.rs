//! Collision and aggregation rates by size, and what breaks into what: the kernels of a population balance.
//!
//! # Equation
//! ```text
//! collisions of classes a and b in V and dt:  K_ab P_ab/V dt,  P_ab = N_a N_b (a != b) or N_a (N_a - 1)/2 (a = b)
//! exposure  X_ab = integral of P_ab/V dt
//! K_ab = collisions_ab/X_ab,   A_ab = merges_ab/X_ab,   B_ab = breaking collisions_ab/X_ab
//! sticking probability = merges_ab/collisions_ab,   S_a = breakages_a/integral of N_a dt
//! mean primaries of class a = integral of (sum of n) dt/integral of N_a dt
//! ```
//!
//! # Source
//! M. von Smoluchowski, Z. Phys. Chem. 92, 129 (1917), for the kernel; D. Ramkrishna, *Population Balances* (2000),
//! chapter 3, for breakage. The estimate, events over exposure, is that of greatest likelihood for a rate that is
//! constant.
//!
//! # Symbols
//! | symbol | name in code                | unit  | meaning                                                   |
//! |--------|-----------------------------|-------|-----------------------------------------------------------|
//! | N_a    | `population`                | 1     | grains of class a: 2^a to 2^(a+1) - 1 primaries, or others |
//! | n      | `primaries`                 | 1     | primaries of a grain                                      |
//! | P_ab   | `pairs`                     | 1     | pairs that could collide                                     |
//! | X_ab   | `exposure`                  | s/m³  |                                                           |
//! | K_ab   | `collision_kernel`          | m³/s  |                                                           |
//! | A_ab   | `aggregation_kernel`        | m³/s  |                                                           |
//! | B_ab   | `breaking_kernel`           | m³/s  | of collisions that break one partner or both                  |
//! | S_a    | `breakage_rate`             | 1/s   | breakages of a grain of class a in unit time               |
//!
//! # Valid when
//! Kernels are means over the run so far and over the sizes in a class. With n events the relative standard error is
//! about 1/sqrt(n). V is the control volume; grains that spread out of an open one make kernels too small. Impacts at
//! the very moment at which a grain grew are counted like all others.
//!
//! # Compared with others
//! For equal spheres in equilibrium K = 4 σ² χ sqrt(π k T/m) with the diameter σ and Enskog's factor χ.
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::measure::{SizeClasses, SizeRates};
//! let mut rates = SizeRates::new(SizeClasses::default(), [1, 1, 1].into_iter(), 2.0);
//! rates.collide([1, 1], true);
//! rates.merge([1, 1], 4.0);
//! let rows = rates.kernel_rows(5.0);
//! // Three pairs for 4 s in 2 m³ came to one merge; then a single and a double are left for 1 s.
//! assert_eq!(rows[0].aggregation_kernel, Some(1.0 / (3.0 * 4.0 / 2.0)));
//! assert_eq!((rows[1].exposure, rows[1].collisions), (1.0 / 2.0, 0));
//! ```

use serde::{Deserialize, Serialize};

use super::size_classes::SizeClasses;
use super::size_totals::{SizeTotals, place};
use crate::engine::validate::{Fault, MOST_COUNTED, ensure, finite, length};

/// Collisions, merges and fragments by classes of primary grains.
///
/// Times must not go back. Nothing is allocated but where a class larger than all before appears.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SizeRates {
    classes: SizeClasses,
    volume: f64,
    populations: Vec<Population>,
    /// Pairs (a, b) with b <= a, row by row.
    pairs: Vec<Pair>,
    /// Daughters of class b <= a from parents of class a, row by row.
    daughters: Vec<Daughters>,
}

/// Grains of one class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Population {
    grains: u64,
    /// Integral of `grains` over time up to `updated_at` [s].
    grain_time: f64,
    updated_at: f64,
    /// Primaries of all its grains.
    primaries: u64,
    /// Integral of `primaries` over time up to `counted_at` [s].
    primaries_time: f64,
    counted_at: f64,
    breakages: u64,
    /// Primaries of all parents that broke.
    broken: u64,
}

/// What happened between two classes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Pair {
    collisions: u64,
    merges: u64,
    breaking: u64,
    /// Integral of the number of pairs over time up to `updated_at` [s].
    exposed: f64,
    updated_at: f64,
}

/// Fragments of one class from parents of another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Daughters {
    fragments: u64,
    primaries: u64,
}

impl SizeRates {
    /// Whether they are ones that grains of these numbers of primaries can have come to.
    ///
    /// # Errors
    /// What is wrong with them.
    pub(crate) fn validate(
        &self,
        classes: &SizeClasses,
        primaries: impl Iterator<Item = u32>,
    ) -> Result<(), Fault> {
        let n = self.populations.len();
        ensure(self.classes == *classes, || "sizes: other classes".to_owned())?;
        ensure(n > 0 && n <= SizeClasses::MOST, || format!("sizes: {n} classes"))?;
        length("sizes: pairs", self.pairs.len(), n * (n + 1) / 2)?;
        length("sizes: daughters", self.daughters.len(), n * (n + 1) / 2)?;
        finite("sizes", self)?;
        let small = |counts: &[u64]| counts.iter().all(|count| *count < MOST_COUNTED);
        let counted = self.pairs.iter().all(|pair| small(&[pair.collisions, pair.merges, pair.breaking]))
            && self.daughters.iter().all(|daughters| small(&[daughters.fragments, daughters.primaries]))
            && self.populations.iter().all(|one| small(&[one.breakages, one.broken, one.primaries]));
        ensure(counted && self.volume > 0.0, || "sizes: a count is too large".to_owned())?;
        let mut counts = vec![(0_u64, 0_u64); n];
        for primaries in primaries {
            let class = self.classes.class_of(primaries);
            ensure(class < n, || "sizes: a class is missing".to_owned())?;
            let (grains, sum) = counts[class];
            counts[class] = (grains + 1, sum + u64::from(primaries));
        }
        let found = self.populations.iter().map(|population| (population.grains, population.primaries));
        ensure(found.eq(counts), || "sizes: a class has other grains".to_owned())
    }

    /// Starts with grains of these numbers of primaries at time zero, in a volume [m³].
    pub fn new(classes: SizeClasses, primaries: impl Iterator<Item = u32>, volume: f64) -> Self {
        let most = classes.count();
        let mut rates = Self { classes, volume, ..Self::default() };
        if let Some(classes) = most {
            rates.make_room(classes.saturating_sub(1));
        }
        for primaries in primaries {
            rates.enter(primaries, 0.0);
        }
        rates
    }

    /// The classes of sizes.
    pub fn classes(&self) -> &SizeClasses {
        &self.classes
    }

    /// Counts a collision of two grains of these numbers of primaries, and whether they stuck.
    #[inline]
    pub fn collide(&mut self, primaries: [u32; 2], sticks: bool) {
        let pair = self.pair(primaries);
        pair.collisions += 1;
        pair.merges += u64::from(sticks);
    }

    /// Counts a collision that broke one partner or both.
    pub fn collide_and_break(&mut self, primaries: [u32; 2]) {
        let pair = self.pair(primaries);
        pair.collisions += 1;
        pair.breaking += 1;
    }

    fn pair(&mut self, primaries: [u32; 2]) -> &mut Pair {
        let [a, b] = primaries.map(|primaries| self.classes.class_of(primaries));
        self.make_room(a.max(b));
        &mut self.pairs[place(a, b)]
    }

    /// Two grains become one at `time` [s].
    pub fn merge(&mut self, primaries: [u32; 2], time: f64) {
        let (small, large) = (primaries[0].min(primaries[1]), primaries[0].max(primaries[1]));
        let both = small.saturating_add(large);
        self.leave(small, time);
        let class = self.classes.class_of(large);
        if self.classes.class_of(both) == class {
            // Mostly a small grain joins a large one, which stays in its class: no pair is lost or made but those of the small one.
            self.count_primaries(class, time);
            self.populations[class].primaries += u64::from(both - large);
        } else {
            self.leave(large, time);
            self.enter(both, time);
        }
    }

    /// A grain becomes fragments at `time` [s].
    pub fn shatter(&mut self, parent: u32, fragments: &[u32], time: f64) {
        let class = self.classes.class_of(parent);
        self.leave(parent, time);
        self.populations[class].breakages += 1;
        self.populations[class].broken += u64::from(parent);
        for &primaries in fragments {
            self.enter(primaries, time);
            let daughters = &mut self.daughters[place(class, self.classes.class_of(primaries))];
            daughters.fragments += 1;
            daughters.primaries += u64::from(primaries);
        }
    }

    fn leave(&mut self, primaries: u32, time: f64) {
        let population = self.brought_up(primaries, time);
        population.grains = population.grains.saturating_sub(1);
        population.primaries = population.primaries.saturating_sub(u64::from(primaries));
    }

    fn enter(&mut self, primaries: u32, time: f64) {
        let population = self.brought_up(primaries, time);
        population.grains += 1;
        population.primaries += u64::from(primaries);
    }

    #[inline]
    fn make_room(&mut self, class: usize) {
        if class >= self.populations.len() {
            self.populations.resize(class + 1, Population::default());
            self.pairs.resize(place(class, class) + 1, Pair::default());
            self.daughters.resize(place(class, class) + 1, Daughters::default());
        }
    }

    /// The class of a grain with all integrals up to a time, before its population changes.
    fn brought_up(&mut self, primaries: u32, time: f64) -> &mut Population {
        let class = self.classes.class_of(primaries);
        self.make_room(class);
        for other in 0..self.populations.len() {
            let pair_time = self.pair_time(class, other, time);
            let pair = &mut self.pairs[place(class, other)];
            pair.exposed = pair_time;
            pair.updated_at = time;
        }
        self.populations[class].grain_time = self.grain_time(class, time);
        self.populations[class].updated_at = time;
        self.count_primaries(class, time);
        &mut self.populations[class]
    }

    /// Brings the integral of a class's primaries up to a time, before they change.
    fn count_primaries(&mut self, class: usize, time: f64) {
        self.populations[class].primaries_time = self.primaries_time(class, time);
        self.populations[class].counted_at = time;
    }

    /// Integral of the number of pairs up to a time [s].
    fn pair_time(&self, a: usize, b: usize, time: f64) -> f64 {
        let pair = &self.pairs[place(a, b)];
        let [grains, others] = [a, b].map(|class| self.populations[class].grains as f64);
        let pairs = if a == b { 0.5 * grains * (grains - 1.0) } else { grains * others };
        pair.exposed + pairs * (time - pair.updated_at)
    }

    /// Integral of the number of grains up to a time [s].
    fn grain_time(&self, class: usize, time: f64) -> f64 {
        let population = &self.populations[class];
        population.grain_time + population.grains as f64 * (time - population.updated_at)
    }

    /// Integral of the primaries of a class up to a time [s].
    fn primaries_time(&self, class: usize, time: f64) -> f64 {
        let population = &self.populations[class];
        population.primaries_time + population.primaries as f64 * (time - population.counted_at)
    }

    /// All counts and integrals up to `time` [s], to be put together with those of other simulations. None where there is no end to
    /// the number of classes.
    pub fn totals(&self, time: f64) -> Option<SizeTotals> {
        let mut totals = SizeTotals::none(self.classes.count()?);
        for class in 0..totals.classes() {
            let Population { breakages, broken, .. } = self.populations[class];
            let times = [self.grain_time(class, time), self.primaries_time(class, time)];
            *totals.class_mut(class) = [times[0], times[1], breakages as f64, broken as f64];
            for other in 0..=class {
                let (pair, daughters) =
                    (&self.pairs[place(class, other)], &self.daughters[place(class, other)]);
                let exposure = self.exposure(class, other, time);
                let counts = [pair.collisions, pair.merges, pair.breaking].map(|count| count as f64);
                *totals.pair_mut(class, other) = [exposure, counts[0], counts[1], counts[2]];
                *totals.daughters_mut(class, other) =
                    [daughters.fragments as f64, daughters.primaries as f64];
            }
        }
        Some(totals)
    }

    /// Integral of the number of pairs over the volume up to a time [s/m³].
    fn exposure(&self, a: usize, b: usize, time: f64) -> f64 {
        if self.volume > 0.0 { self.pair_time(a, b, time) / self.volume } else { 0.0 }
    }

    /// Grains of each class now, class 0 first.
    pub fn populations(&self) -> impl Iterator<Item = u64> + '_ {
        self.populations.iter().map(|population| population.grains)
    }

    /// Kernels up to `time` [s], for every pair of classes that could collide or did, the larger class first. Nothing is
    /// changed.
    pub fn kernel_rows(&self, time: f64) -> Vec<KernelRow> {
        let classes = self.populations.len();
        let all = (0..classes).flat_map(|a| (0..=a).map(move |b| (a, b)));
        all.map(|(a, b)| self.kernel_row(a, b, time))
            .filter(|row| row.exposure > 0.0 || row.collisions > 0)
            .collect()
    }

    fn kernel_row(&self, a: usize, b: usize, time: f64) -> KernelRow {
        let pair = &self.pairs[place(a, b)];
        let exposure = self.exposure(a, b, time);
        let kernel = |events: u64| (exposure > 0.0).then(|| events as f64 / exposure);
        KernelRow {
            a: self.classes.bounds(a),
            b: self.classes.bounds(b),
            collisions: pair.collisions,
            merges: pair.merges,
            breaking: pair.breaking,
            exposure,
            collision_kernel: kernel(pair.collisions),
            aggregation_kernel: kernel(pair.merges),
            breaking_kernel: kernel(pair.breaking),
            sticking_probability: (pair.collisions > 0).then(|| pair.merges as f64 / pair.collisions as f64),
        }
    }

    /// Breakage up to `time` [s], for every class in which grains were or broke. Nothing is changed.
    pub fn breakage_rows(&self, time: f64) -> Vec<BreakageRow> {
        let row = |class: usize| {
            let population = &self.populations[class];
            let grain_time = self.grain_time(class, time);
            BreakageRow {
                class: self.classes.bounds(class),
                grains: population.grains,
                grain_time,
                mean_primaries: (grain_time > 0.0).then(|| self.primaries_time(class, time) / grain_time),
                breakages: population.breakages,
                breakage_rate: (grain_time > 0.0).then(|| population.breakages as f64 / grain_time),
            }
        };
        let rows = (0..self.populations.len()).map(row);
        rows.filter(|row| row.grain_time > 0.0 || row.breakages > 0 || row.grains > 0).collect()
    }

    /// What broke into what since the start, for every pair of a parent's and a daughter's class that occurred.
    pub fn daughter_rows(&self) -> Vec<DaughterRow> {
        let classes = self.populations.len();
        let all = (0..classes).flat_map(|parent| (0..=parent).map(move |daughter| (parent, daughter)));
        all.filter_map(|(parent, daughter)| {
            let (found, parents) = (self.daughters[place(parent, daughter)], &self.populations[parent]);
            (found.fragments > 0).then(|| DaughterRow {
                parent: self.classes.bounds(parent),
                daughter: self.classes.bounds(daughter),
                breakages: parents.breakages,
                fragments: found.fragments,
                primaries: found.primaries,
                fragments_per_breakage: found.fragments as f64 / parents.breakages as f64,
                mass_fraction: found.primaries as f64 / parents.broken as f64,
            })
        })
        .collect()
    }
}

/// Kernels of one pair of classes. Quantities that nothing can be said of are left out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct KernelRow {
    /// Fewest and most primaries of the larger class.
    pub a: [u32; 2],
    /// Fewest and most primaries of the smaller class.
    pub b: [u32; 2],
    /// Impacts.
    pub collisions: u64,
    /// Impacts after which the two were one.
    pub merges: u64,
    /// Impacts that broke one or both.
    pub breaking: u64,
    /// Integral over time of the number of pairs, over the volume [s/m³].
    pub exposure: f64,
    /// K: collisions over exposure [m³/s].
    pub collision_kernel: Option<f64>,
    /// Merges over exposure [m³/s].
    pub aggregation_kernel: Option<f64>,
    /// Breaking collisions over exposure [m³/s].
    pub breaking_kernel: Option<f64>,
    /// Merges over collisions.
    pub sticking_probability: Option<f64>,
}

/// Breakage of one class.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BreakageRow {
    /// Fewest and most primaries of the class.
    pub class: [u32; 2],
    /// Grains of the class now.
    pub grains: u64,
    /// Integral of their number over time [s].
    pub grain_time: f64,
    /// Primaries of a grain of the class in the mean over time.
    pub mean_primaries: Option<f64>,
    /// Grains that broke.
    pub breakages: u64,
    /// Breakages over the integral of the number [1/s].
    pub breakage_rate: Option<f64>,
}

/// Daughters of one class from parents of one class.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DaughterRow {
    /// Fewest and most primaries of the parents' class.
    pub parent: [u32; 2],
    /// Fewest and most primaries of the daughters' class.
    pub daughter: [u32; 2],
    /// Parents of the class that broke, whatever into.
    pub breakages: u64,
    /// Fragments.
    pub fragments: u64,
    /// Primaries in them.
    pub primaries: u64,
    /// Fragments over breakages.
    pub fragments_per_breakage: f64,
    /// Primaries in them over those in all parents of the class that broke.
    pub mass_fraction: f64,
}

#[cfg(test)]
#[path = "size_rates_tests.rs"]
mod tests;
