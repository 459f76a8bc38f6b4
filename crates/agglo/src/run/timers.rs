//! When what is due.

use serde::{Deserialize, Serialize};

use crate::scenario::Output;
use crate::units::Time;

/// Something that is due at equal intervals of simulated time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timer {
    interval: f64,
    next: u64,
}

impl Timer {
    fn new(interval: Option<Time>, first: u64) -> Self {
        Self { interval: interval.map_or(f64::INFINITY, Time::si), next: first }
    }

    fn turn(&self, number: u64) -> f64 {
        if number == 0 { 0.0 } else { number as f64 * self.interval }
    }

    /// Time [s] of the next turn: a multiple of the interval, so that it does not drift.
    pub fn next(&self) -> f64 {
        self.turn(self.next)
    }

    /// Whether it is due at `time` [s]; then the next turn is the first after that.
    pub fn is_due(&mut self, time: f64) -> bool {
        if time < self.next() {
            return false;
        }
        let passed = (time / self.interval) as u64;
        self.next = self.next.max(passed);
        while time >= self.next() {
            self.next += 1;
        }
        true
    }
}

/// The timers of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timers {
    /// Rows of the tables.
    pub rows: Timer,
    /// Frames.
    pub frames: Timer,
    /// Checkpoints.
    pub checkpoints: Timer,
}

impl Timers {
    /// The timers as the scenario has them; the first checkpoint is written by hand.
    pub fn new(output: &Output) -> Self {
        Self {
            rows: Timer::new(output.series, 0),
            frames: Timer::new(output.frames, 0),
            checkpoints: Timer::new(output.checkpoints, 1),
        }
    }

    /// Time [s] at which the next thing is due.
    pub fn next(&self) -> f64 {
        self.rows.next().min(self.frames.next()).min(self.checkpoints.next())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Quantity;

    /// Turns are multiples of the interval to the last bit, however many there were.
    #[test]
    fn turns_do_not_drift() {
        let mut timer = Timer::new(Some(Quantity(0.1)), 0);
        for turn in 0..1000_u64 {
            assert_eq!(timer.next(), if turn == 0 { 0.0 } else { turn as f64 * 0.1 });
            assert!(!timer.is_due(timer.next() - 1e-9) && timer.is_due(timer.next()));
        }
    }

    #[test]
    fn turns_that_were_missed_count_as_one() {
        let mut timer = Timer::new(Some(Quantity(1.0)), 1);
        assert!(!timer.is_due(0.5) && timer.is_due(7.5) && !timer.is_due(7.9));
        assert_eq!(timer.next(), 8.0);
        let never = Timer::new(None, 1);
        assert_eq!(never.next(), f64::INFINITY);
    }

    #[test]
    fn the_next_thing_is_the_first_of_all() {
        let every = |seconds| Some(Quantity(seconds));
        let output =
            Output { series: every(2.0), frames: every(3.0), checkpoints: every(0.5), ..Output::default() };
        let mut timers = Timers::new(&output);
        assert_eq!(timers.next(), 0.0);
        assert!(timers.rows.is_due(0.0) && timers.frames.is_due(0.0) && !timers.checkpoints.is_due(0.0));
        assert_eq!(timers.next(), 0.5);
        assert!(timers.checkpoints.is_due(2.6));
        assert_eq!(timers.next(), 2.0);
    }
}
