//! Numbers in groups, side by side in memory.

/// The items of each group, in the order in which they were given.
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::math::Groups;
/// let mut groups = Groups::default();
/// groups.fill(3, [(2, 10), (0, 11), (2, 12)].into_iter());
/// assert_eq!([groups.of(0), groups.of(1), groups.of(2)], [&[11][..], &[], &[10, 12]]);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Groups {
    /// Items of group k: `items[starts[k]..starts[k + 1]]`.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Groups {
    /// Puts other items into so many groups, each given with its group's number before it; in the room that there is already.
    pub fn fill(&mut self, groups: usize, items: impl Iterator<Item = (u32, u32)> + Clone) {
        // Each start stands one place late while the group is counted and filled, which moves it on to the next.
        self.starts.clear();
        self.starts.resize(groups + 2, 0);
        for (group, _) in items.clone() {
            self.starts[group as usize + 2] += 1;
        }
        for k in 1..groups + 2 {
            self.starts[k] += self.starts[k - 1];
        }
        self.items.clear();
        self.items.resize(self.starts[groups + 1] as usize, 0);
        for (group, item) in items {
            let place = &mut self.starts[group as usize + 1];
            self.items[*place as usize] = item;
            *place += 1;
        }
        self.starts.pop();
    }

    /// The items of a group.
    #[inline]
    pub fn of(&self, group: usize) -> &[u32] {
        &self.items[self.starts[group] as usize..self.starts[group + 1] as usize]
    }
}
