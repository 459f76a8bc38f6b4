//! The size distribution by powers of two of the number of primary grains.

use serde::{Deserialize, Serialize};

/// Class of a grain of this many primaries: class k has 2^k to 2^(k+1) - 1 of them.
#[inline]
pub(super) fn class_of(primaries: u32) -> usize {
    primaries.max(1).ilog2() as usize
}

/// The grains of one size class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SizeClass {
    /// Fewest primaries.
    pub lower: u32,
    /// Most primaries.
    pub upper: u32,
    /// Grains.
    pub grains: u64,
    /// Their mass [kg].
    pub mass: f64,
}

impl SizeClass {
    /// Fewest and most primaries of a class.
    pub(super) fn bounds(class: usize) -> [u32; 2] {
        let lower = 1_u32 << class.min(31);
        [lower, lower - 1 + lower]
    }
}

/// The grains by classes of powers of two of their primaries, from singles up to the largest grain's class, empty
/// classes in between included.
///
/// `primaries` [n] and `masses` [n] [kg] belong to the same grains. No grains have no classes.
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::measure::size_classes;
/// let classes = size_classes(&[1, 5, 1, 7], &[1.0, 5.0, 1.0, 7.0]);
/// let counts: Vec<_> = classes.iter().map(|class| (class.lower, class.upper, class.grains)).collect();
/// assert_eq!(counts, [(1, 1, 2), (2, 3, 0), (4, 7, 2)]);
/// assert_eq!(classes[2].mass, 12.0);
/// ```
pub fn size_classes(primaries: &[u32], masses: &[f64]) -> Vec<SizeClass> {
    let Some(&largest) = primaries.iter().max() else { return Vec::new() };
    let empty = |class| {
        let [lower, upper] = SizeClass::bounds(class);
        SizeClass { lower, upper, ..SizeClass::default() }
    };
    let mut classes: Vec<SizeClass> = (0..=class_of(largest)).map(empty).collect();
    for (&primaries, mass) in primaries.iter().zip(masses) {
        let class = &mut classes[class_of(primaries)];
        class.grains += 1;
        class.mass += mass;
    }
    classes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_grain_is_within_the_bounds_of_its_class() {
        for primaries in [1, 2, 3, 4, 7, 8, 1023, 1024, 1 << 31, u32::MAX] {
            let [lower, upper] = SizeClass::bounds(class_of(primaries));
            assert!((lower..=upper).contains(&primaries), "{primaries}");
        }
        assert_eq!(SizeClass::bounds(31), [1 << 31, u32::MAX]);
    }

    #[test]
    fn no_grains_have_no_classes() {
        assert_empty!(size_classes(&[], &[]));
    }

    /// Masses of small whole numbers: their sums are exact.
    #[test]
    fn numbers_and_mass_add_up() {
        let primaries: Vec<u32> = (1..=1000).collect();
        let masses: Vec<f64> = primaries.iter().map(|&n| 2.0 * f64::from(n)).collect();
        let classes = size_classes(&primaries, &masses);
        assert_eq!(classes.len(), 10);
        assert_eq!(classes.iter().map(|class| class.grains).sum::<u64>(), 1000);
        assert_eq!(classes.iter().map(|class| class.mass).sum::<f64>(), 1000.0 * 1001.0);
        // 512 to 1000 are 489 grains of mean 756.
        assert_eq!((classes[9].grains, classes[9].mass), (489, 2.0 * 489.0 * 756.0));
    }
}
