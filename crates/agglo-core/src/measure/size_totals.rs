//! What rates by size are worked out from, as numbers that add up over simulations.

/// Place of the pair (a, b) in a triangle that grows by rows.
pub(super) fn place(a: usize, b: usize) -> usize {
    let (row, column) = if a >= b { (a, b) } else { (b, a) };
    row * (row + 1) / 2 + column
}

/// Counts and integrals of one simulation by classes of sizes, or sums of several.
///
/// `[4]` of each class: the integrals of its grains and of their primaries over time [s], its breakages, and the primaries of those
/// that broke. `[4]` of each pair of classes: the exposure [s/m³], collisions, merges, breaking collisions. `[2]` of each pair of a
/// parent's and a daughter's class: fragments, and the primaries in them.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeTotals {
    classes: Vec<[f64; 4]>,
    pairs: Vec<[f64; 4]>,
    daughters: Vec<[f64; 2]>,
}

impl SizeTotals {
    /// Of so many classes, all zero.
    pub fn none(classes: usize) -> Self {
        let pairs = classes * (classes + 1) / 2;
        Self {
            classes: vec![[0.0; 4]; classes],
            pairs: vec![[0.0; 4]; pairs],
            daughters: vec![[0.0; 2]; pairs],
        }
    }

    /// How many numbers they are for so many classes.
    pub fn len_of(classes: usize) -> usize {
        4 * classes + 6 * (classes * (classes + 1) / 2)
    }

    /// All of them in a row.
    pub fn to_vec(&self) -> Vec<f64> {
        [self.classes.as_flattened(), self.pairs.as_flattened(), self.daughters.as_flattened()].concat()
    }

    /// From all of them in a row; none where it is not as long as so many classes make it.
    pub fn from_slice(classes: usize, row: &[f64]) -> Option<Self> {
        let mut totals = Self::none(classes);
        let (own, rest) = row.split_at_checked(4 * classes)?;
        let (pairs, daughters) = rest.split_at_checked(totals.pairs.len() * 4)?;
        totals.classes.as_flattened_mut().copy_from_slice(own);
        totals.pairs.as_flattened_mut().copy_from_slice(pairs);
        if daughters.len() != totals.daughters.len() * 2 {
            return None;
        }
        totals.daughters.as_flattened_mut().copy_from_slice(daughters);
        Some(totals)
    }

    /// How many classes there are.
    pub fn classes(&self) -> usize {
        self.classes.len()
    }

    /// Of a class: grain time [s], primaries' time [s], breakages, primaries of those that broke.
    pub fn class(&self, class: usize) -> [f64; 4] {
        self.classes[class]
    }

    /// Of a pair of classes: exposure [s/m³], collisions, merges, breaking collisions.
    pub fn pair(&self, a: usize, b: usize) -> [f64; 4] {
        self.pairs[place(a, b)]
    }

    /// Of a parent's and a daughter's class: fragments, primaries in them.
    pub fn daughters(&self, parent: usize, daughter: usize) -> [f64; 2] {
        self.daughters[place(parent, daughter)]
    }

    pub(super) fn class_mut(&mut self, class: usize) -> &mut [f64; 4] {
        &mut self.classes[class]
    }

    pub(super) fn pair_mut(&mut self, a: usize, b: usize) -> &mut [f64; 4] {
        &mut self.pairs[place(a, b)]
    }

    pub(super) fn daughters_mut(&mut self, parent: usize, daughter: usize) -> &mut [f64; 2] {
        &mut self.daughters[place(parent, daughter)]
    }
}
