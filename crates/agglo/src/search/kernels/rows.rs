//! What the replicates of a candidate say of each class and pair of classes.

use crate::measure::{SizeClasses, SizeTotals};

use super::ratio::{Ratio, ratio};

/// Kernels of one pair of classes.
#[derive(Clone, Debug, PartialEq)]
pub struct KernelMean {
    /// Number of the evaluation.
    pub evaluation: u64,
    /// How many replicates they are from.
    pub replicates: u64,
    /// Fewest and most primaries of the larger class.
    pub a: [u32; 2],
    /// Fewest and most primaries of the smaller class.
    pub b: [u32; 2],
    /// Exposure, collisions, merges and breaking collisions, in all.
    pub sums: [f64; 4],
    /// Collisions over exposure [m³/s].
    pub collision: Ratio,
    /// Merges over exposure [m³/s].
    pub aggregation: Ratio,
    /// Breaking collisions over exposure [m³/s].
    pub breaking: Ratio,
    /// Merges over collisions.
    pub sticking: Ratio,
}

/// Breakage of one class.
#[derive(Clone, Debug, PartialEq)]
pub struct BreakageMean {
    /// Number of the evaluation.
    pub evaluation: u64,
    /// How many replicates it is from.
    pub replicates: u64,
    /// Fewest and most primaries of the class.
    pub class: [u32; 2],
    /// Grain time [s], primaries' time [s] and breakages, in all.
    pub sums: [f64; 3],
    /// Primaries of a grain of the class, over time.
    pub primaries: Ratio,
    /// Breakages over grain time [1/s].
    pub rate: Ratio,
}

/// Daughters of one class from parents of one class.
#[derive(Clone, Debug, PartialEq)]
pub struct DaughterMean {
    /// Number of the evaluation.
    pub evaluation: u64,
    /// How many replicates they are from.
    pub replicates: u64,
    /// Fewest and most primaries of the parents' class.
    pub parent: [u32; 2],
    /// Fewest and most primaries of the daughters' class.
    pub daughter: [u32; 2],
    /// Breakages of parents, fragments, and primaries in them, in all.
    pub sums: [f64; 3],
    /// Fragments over breakages.
    pub fragments: Ratio,
    /// Primaries in them over those in all parents of the class that broke.
    pub mass_fraction: Ratio,
}

/// The replicates of a candidate.
pub struct Rates<'a> {
    /// Number of the evaluation.
    pub evaluation: u64,
    /// The classes.
    pub classes: &'a SizeClasses,
    /// Its replicates that count.
    pub replicates: Vec<SizeTotals>,
}

impl Rates<'_> {
    fn count(&self) -> u64 {
        self.replicates.len() as u64
    }

    /// Numbers of each replicate.
    fn each(&self, of: impl Fn(&SizeTotals) -> f64) -> Vec<f64> {
        self.replicates.iter().map(of).collect()
    }

    /// Kernels of all pairs of classes that could collide or did, the larger class first.
    pub fn kernels(&self) -> Vec<KernelMean> {
        let classes = self.classes.count().unwrap_or(0);
        let all = (0..classes).flat_map(|a| (0..=a).map(move |b| (a, b)));
        all.map(|(a, b)| self.kernel(a, b)).filter(|row| row.sums[0] > 0.0 || row.sums[1] > 0.0).collect()
    }

    fn kernel(&self, a: usize, b: usize) -> KernelMean {
        let [exposure, collisions, merges, breaking] =
            [0, 1, 2, 3].map(|k| self.each(|totals| totals.pair(a, b)[k]));
        KernelMean {
            evaluation: self.evaluation,
            replicates: self.count(),
            a: self.classes.bounds(a),
            b: self.classes.bounds(b),
            collision: ratio(&collisions, &exposure),
            aggregation: ratio(&merges, &exposure),
            breaking: ratio(&breaking, &exposure),
            sticking: ratio(&merges, &collisions),
            sums: [exposure, collisions, merges, breaking].map(|of| of.iter().sum()),
        }
    }

    /// Breakage of all classes in which grains were.
    pub fn breakage(&self) -> Vec<BreakageMean> {
        let classes = self.classes.count().unwrap_or(0);
        (0..classes).map(|class| self.breakage_of(class)).filter(|row| row.sums[0] > 0.0).collect()
    }

    fn breakage_of(&self, class: usize) -> BreakageMean {
        let [grain_time, primaries_time, breakages] =
            [0, 1, 2].map(|k| self.each(|totals| totals.class(class)[k]));
        BreakageMean {
            evaluation: self.evaluation,
            replicates: self.count(),
            class: self.classes.bounds(class),
            primaries: ratio(&primaries_time, &grain_time),
            rate: ratio(&breakages, &grain_time),
            sums: [grain_time, primaries_time, breakages].map(|of| of.iter().sum()),
        }
    }

    /// What broke into what, for all pairs of classes that occurred.
    pub fn daughters(&self) -> Vec<DaughterMean> {
        let classes = self.classes.count().unwrap_or(0);
        let all = (0..classes).flat_map(|parent| (0..=parent).map(move |daughter| (parent, daughter)));
        all.map(|(parent, daughter)| self.daughter(parent, daughter))
            .filter(|row| row.sums[1] > 0.0)
            .collect()
    }

    fn daughter(&self, parent: usize, daughter: usize) -> DaughterMean {
        let [breakages, broken] = [2, 3].map(|k| self.each(|totals| totals.class(parent)[k]));
        let [fragments, primaries] =
            [0, 1].map(|k| self.each(|totals| totals.daughters(parent, daughter)[k]));
        DaughterMean {
            evaluation: self.evaluation,
            replicates: self.count(),
            parent: self.classes.bounds(parent),
            daughter: self.classes.bounds(daughter),
            fragments: ratio(&fragments, &breakages),
            mass_fraction: ratio(&primaries, &broken),
            sums: [breakages, fragments, primaries].map(|of| of.iter().sum()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::SizeRates;

    /// Two replicates, of 4 and of 3 singles in 1 m³. In the first two merge at 1 s, and break again at 3 s; read at 4 s. In the
    /// second nothing happens for 2 s.
    #[test]
    fn two_replicates_by_hand() {
        let classes = SizeClasses::from_bounds(&[1, 2]);
        let mut first = SizeRates::new(classes.clone(), [1; 4].into_iter(), 1.0);
        first.collide([1, 1], true);
        first.merge([1, 1], 1.0);
        first.collide_and_break([2, 1]);
        first.shatter(2, &[1, 1], 3.0);
        let second = SizeRates::new(classes.clone(), [1; 3].into_iter(), 1.0);
        let replicates = vec![first.totals(4.0).unwrap(), second.totals(2.0).unwrap()];
        let rates = Rates { evaluation: 7, classes: &classes, replicates };
        let kernels = rates.kernels();
        assert_eq!(kernels.iter().map(|row| (row.a[0], row.b[0])).collect::<Vec<_>>(), [(1, 1), (2, 1)]);
        // Six pairs for 1 s, one for 2 s, six for 1 s; three pairs for 2 s.
        let singles = &kernels[0];
        assert_eq!((singles.evaluation, singles.replicates, singles.sums), (7, 2, [20.0, 1.0, 1.0, 0.0]));
        assert_eq!(singles.aggregation, ratio(&[1.0, 0.0], &[14.0, 6.0]));
        assert_eq!(singles.sticking.value, Some(1.0));
        // A double beside two singles for 2 s, in the first alone.
        assert_eq!(kernels[1].breaking, ratio(&[1.0, 0.0], &[4.0, 0.0]));
        assert_eq!(kernels[1].a, [2, u32::MAX]);
        let breakage = rates.breakage();
        assert_eq!(breakage[0].sums, [4.0 + 2.0 * 2.0 + 4.0 + 6.0, 18.0, 0.0]);
        assert_eq!((breakage[1].rate.value, breakage[1].primaries.value), (Some(0.5), Some(2.0)));
        let daughters = rates.daughters();
        assert_eq!(daughters.len(), 1);
        assert_eq!((daughters[0].parent[0], daughters[0].daughter), (2, [1, 1]));
        assert_eq!((daughters[0].fragments.value, daughters[0].mass_fraction.value), (Some(2.0), Some(1.0)));
    }
}
