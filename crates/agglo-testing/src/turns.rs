//! Loops that come to an end.

/// Counts the turns of a loop that waits for something, so that it fails where that never comes.
#[derive(Clone, Copy, Debug)]
pub struct Turns {
    most: u64,
    left: u64,
    what: &'static str,
}

impl Turns {
    /// So many turns at the most; `what` is waited for.
    pub const fn at_most(most: u64, what: &'static str) -> Self {
        Self { most, left: most, what }
    }

    /// Takes a turn, and fails where none is left.
    #[track_caller]
    pub fn take(&mut self) {
        let Self { most, left, what } = *self;
        assert!(left > 0, "after {most} turns still waiting for {what}");
        self.left -= 1;
    }
}
