//! Classes of sizes by the number of primary grains, and the size distribution over them.

use serde::{Deserialize, Serialize};

/// Where classes of sizes begin: at powers of two, or where they are told to.
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::measure::SizeClasses;
/// let own = SizeClasses::from_bounds(&[1, 2, 5]);
/// assert_eq!([1, 4, 400].map(|primaries| own.class_of(primaries)), [0, 1, 2]);
/// assert_eq!(own.bounds(1), [2, 4]);
/// let twos = SizeClasses::default();
/// assert_eq!((twos.class_of(7), twos.bounds(2)), (2, [4, 7]));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SizeClasses {
    /// Fewest primaries of each class, 1 first, each more than the one before; empty for powers of two.
    lower: Vec<u32>,
}

impl SizeClasses {
    /// Classes that are allowed at most: as many as numbers of primaries have binary digits.
    pub const MOST: usize = 32;

    /// Classes that begin at these numbers of primaries, 1 first; the last one has no end. Powers of two where there are none.
    pub fn from_bounds(lower: &[u32]) -> Self {
        Self { lower: lower.to_vec() }
    }

    /// How many there are; none for powers of two, of which there are as many as the largest grain needs.
    pub fn count(&self) -> Option<usize> {
        (!self.lower.is_empty()).then_some(self.lower.len())
    }

    /// Class of a grain of this many primaries, from 0.
    #[inline]
    pub fn class_of(&self, primaries: u32) -> usize {
        let primaries = primaries.max(1);
        if self.lower.is_empty() {
            primaries.ilog2() as usize
        } else {
            self.lower.partition_point(|lower| *lower <= primaries).saturating_sub(1)
        }
    }

    /// Fewest and most primaries of a class; the most of one without an end are as many as can be counted.
    pub fn bounds(&self, class: usize) -> [u32; 2] {
        if self.lower.is_empty() {
            let lower = 1_u32 << class.min(31);
            return [lower, lower - 1 + lower];
        }
        let next = self.lower.get(class + 1).map_or(u32::MAX, |next| next - 1);
        [self.lower[class], next]
    }

    /// The grains by classes, from singles up to the largest grain's class, empty classes in between included.
    ///
    /// `primaries` [n] and `masses` [n] [kg] belong to the same grains. No grains have no classes.
    ///
    /// ```
    /// # extern crate agglo_core as agglo;
    /// use agglo::measure::SizeClasses;
    /// let classes = SizeClasses::default().distribution(&[1, 5, 1, 7], &[1.0, 5.0, 1.0, 7.0]);
    /// let counts: Vec<_> = classes.iter().map(|class| (class.lower, class.upper, class.grains)).collect();
    /// assert_eq!(counts, [(1, 1, 2), (2, 3, 0), (4, 7, 2)]);
    /// assert_eq!(classes[2].mass, 12.0);
    /// ```
    pub fn distribution(&self, primaries: &[u32], masses: &[f64]) -> Vec<SizeClass> {
        let Some(&largest) = primaries.iter().max() else { return Vec::new() };
        let empty = |class| {
            let [lower, upper] = self.bounds(class);
            SizeClass { lower, upper, ..SizeClass::default() }
        };
        let mut classes: Vec<SizeClass> = (0..=self.class_of(largest)).map(empty).collect();
        for (&primaries, mass) in primaries.iter().zip(masses) {
            let class = &mut classes[self.class_of(primaries)];
            class.grains += 1;
            class.mass += mass;
        }
        classes
    }
}

/// Most primaries of a class as tables have it: none where the class has no end.
pub fn end_of_class(upper: u32) -> Option<u64> {
    (upper < u32::MAX).then_some(u64::from(upper))
}

/// The grains of one size class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SizeClass {
    /// Fewest primaries.
    pub lower: u32,
    /// Most primaries; as many as can be counted where the class has no end.
    pub upper: u32,
    /// Grains.
    pub grains: u64,
    /// Their mass [kg].
    pub mass: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_grain_is_within_the_bounds_of_its_class() {
        let own = SizeClasses::from_bounds(&[1, 2, 3, 10, 1 << 20]);
        for classes in [SizeClasses::default(), own] {
            for primaries in [1, 2, 3, 4, 7, 8, 9, 10, 11, 1023, 1024, 1 << 20, 1 << 31, u32::MAX] {
                let [lower, upper] = classes.bounds(classes.class_of(primaries));
                assert!((lower..=upper).contains(&primaries), "{primaries} in {classes:?}");
            }
        }
        assert_eq!(SizeClasses::default().bounds(31), [1 << 31, u32::MAX]);
    }

    #[test]
    fn no_grains_have_no_classes() {
        assert_empty!(SizeClasses::default().distribution(&[], &[]));
    }

    /// Masses of small whole numbers: their sums are exact.
    #[test]
    fn numbers_and_mass_add_up() {
        let primaries: Vec<u32> = (1..=1000).collect();
        let masses: Vec<f64> = primaries.iter().map(|&n| 2.0 * f64::from(n)).collect();
        let classes = SizeClasses::default().distribution(&primaries, &masses);
        assert_eq!(classes.len(), 10);
        assert_eq!(classes.iter().map(|class| class.grains).sum::<u64>(), 1000);
        assert_eq!(classes.iter().map(|class| class.mass).sum::<f64>(), 1000.0 * 1001.0);
        // 512 to 1000 are 489 grains of mean 756.
        assert_eq!((classes[9].grains, classes[9].mass), (489, 2.0 * 489.0 * 756.0));
        let own = SizeClasses::from_bounds(&[1, 101, 201]).distribution(&primaries, &masses);
        let found: Vec<_> = own.iter().map(|class| (class.lower, class.upper, class.grains)).collect();
        assert_eq!(found, [(1, 100, 100), (101, 200, 100), (201, u32::MAX, 800)]);
    }
}
