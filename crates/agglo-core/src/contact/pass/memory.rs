//! What contacts remember from step to step, by the pair's number.

use crate::contact::friction::TangentialSpring;
use crate::math::{Vec3, refill};
use crate::neighbors::PairList;

/// One remembered contact, named by its grains: for checkpoints and for lists that are built anew.
pub type Remembered = (u32, u32, TangentialSpring);

/// Whether a pair touches.
pub(super) const TOUCHES: u8 = 1;
/// Whether it slides.
pub(super) const SLIDES: u8 = 2;

/// States of all pairs of a list, and springs if the laws have any.
#[derive(Debug, Default)]
pub(super) struct Memory {
    /// [`TOUCHES`] and [`SLIDES`].
    pub states: Vec<u8>,
    /// Force on the owner [N] and stiffness [N/m]; of touching pairs alone.
    pub springs: Vec<[f64; 4]>,
}

impl Memory {
    /// Makes room for pairs, of which none touches.
    pub fn resize(&mut self, pairs: usize, with_springs: bool) {
        refill(&mut self.states, pairs, 0);
        if with_springs {
            refill(&mut self.springs, pairs, [0.0; 4]);
        } else {
            self.springs = Vec::new();
        }
    }

    /// Leaves nothing but the room.
    pub fn clear(&mut self) {
        self.states.clear();
        self.springs.clear();
    }

    /// Adds a touching pair at the end.
    pub fn push(&mut self, spring: &TangentialSpring) {
        self.states.push(state_of(spring));
        self.springs.push(row_of(spring));
    }

    /// Puts a touching pair in its place.
    pub fn put(&mut self, pair: usize, spring: &TangentialSpring) {
        self.states[pair] = state_of(spring);
        if let Some(place) = self.springs.get_mut(pair) {
            *place = row_of(spring);
        }
    }

    /// What a pair remembers if it touches.
    pub fn of(&self, pair: usize) -> Option<TangentialSpring> {
        let state = self.states[pair];
        let [x, y, z, stiffness] = self.springs.get(pair).copied().unwrap_or_default();
        let spring = TangentialSpring { force: Vec3::new(x, y, z), stiffness, sliding: state & SLIDES != 0 };
        (state & TOUCHES != 0).then_some(spring)
    }

    /// All pairs that touch, with the grains' places.
    pub fn touching<'a>(&'a self, list: &'a PairList) -> impl Iterator<Item = Remembered> + 'a {
        list.pairs().enumerate().filter_map(|(pair, (a, b))| Some((a, b, self.of(pair)?)))
    }
}

fn state_of(spring: &TangentialSpring) -> u8 {
    TOUCHES | if spring.sliding { SLIDES } else { 0 }
}

fn row_of(spring: &TangentialSpring) -> [f64; 4] {
    let force = spring.force;
    [force.x, force.y, force.z, spring.stiffness]
}
