//! Where grains are in memory, by their ids.

/// Places of grains by their ids, which may be any numbers.
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::particles::ById;
/// let places = ById::of(&[30, 7]);
/// assert_eq!((places.find(30), places.find(7), places.find(8)), (Some(0), Some(1), None));
/// ```
#[derive(Clone, Debug, Default)]
pub struct ById {
    /// Ids in their order, each with its place.
    sorted: Vec<(u32, u32)>,
}

impl ById {
    /// Of grains with these ids [n].
    pub fn of(ids: &[u32]) -> Self {
        let mut sorted: Vec<(u32, u32)> = ids.iter().copied().zip(0..).collect();
        sorted.sort_unstable();
        Self { sorted }
    }

    /// The place of the grain with this id, if there is one.
    pub fn find(&self, id: u32) -> Option<usize> {
        let at = self.sorted.binary_search_by_key(&id, |(id, _)| *id).ok()?;
        Some(self.sorted[at].1 as usize)
    }

    /// The places of all grains, in the order of their ids.
    pub fn places(&self) -> impl ExactSizeIterator<Item = u32> + '_ {
        self.sorted.iter().map(|(_, place)| *place)
    }

    /// An id that two grains have, if there is one.
    pub fn twice(&self) -> Option<u32> {
        self.sorted.windows(2).find(|pair| pair[0].0 == pair[1].0).map(|pair| pair[0].0)
    }
}
