//! The automatic step in time: it shrinks at once, and grows when it has been shorter than need be for a while.
//!
//! A step that followed the state up and down would cost the scheme its good energy; one that only shrinks would stay
//! short for ever after one deep contact. All of it is counted in steps, so that a resumed run has the same bits.

use serde::{Deserialize, Serialize};

use crate::engine::validate::{Fault, ensure};

/// Steps after which the step may grow to what the last two such windows asked for.
const WINDOW: u64 = 500;
/// A step this many times as long as wanted is tried again.
const MUCH_TOO_LONG: f64 = 2.0;

/// The automatic step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tempo {
    /// Part of the critical step that a step takes.
    safety: f64,
    /// Longest step [s].
    longest: f64,
    /// Shortest wanted steps [s] of the last window and of this one.
    shortest: [f64; 2],
}

impl Tempo {
    /// Before the first step.
    pub fn new(safety: f64, longest: f64) -> Self {
        Self { safety, longest, shortest: [f64::INFINITY; 2] }
    }

    /// The same with another longest step [s]: a run may have got another end.
    pub fn up_to(self, longest: f64) -> Self {
        Self { longest, ..self }
    }

    /// Whether it is one that [`Tempo::next`] can have come to.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(in crate::engine::soft) fn validate(&self) -> Result<(), Fault> {
        let positive = |value: f64| value > 0.0 && !value.is_nan();
        let holds = positive(self.safety) && self.safety.is_finite() && positive(self.longest);
        ensure(holds && self.shortest.into_iter().all(positive), || "tempo: a step is not above 0".to_owned())
    }

    /// The step [s] that a critical step [s] asks for.
    pub fn wanted(&self, critical: f64) -> f64 {
        (self.safety * critical).min(self.longest)
    }

    /// The length [s] with which a step of `dt` [s] is to be tried again, if it is much too long for the critical step
    /// [s] where it led.
    pub fn shorter(&self, dt: f64, critical: f64) -> Option<f64> {
        let wanted = self.wanted(critical);
        (dt > MUCH_TOO_LONG * wanted).then(|| wanted.max(0.1 * dt).min(0.5 * dt))
    }

    /// The next step [s] after `current` [s], step number `step` having led to this critical step [s].
    pub fn next(&mut self, current: f64, critical: f64, step: u64) -> f64 {
        let wanted = self.wanted(critical);
        self.shortest[1] = self.shortest[1].min(wanted);
        if !step.is_multiple_of(WINDOW) {
            return current.min(wanted);
        }
        let allowed = self.shortest[0].min(self.shortest[1]);
        self.shortest = [self.shortest[1], f64::INFINITY];
        allowed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_shrinks_at_once_and_grows_after_two_calm_windows() {
        let mut tempo = Tempo::new(0.125, 1.0);
        let mut step = 1.0;
        let mut lengths = Vec::new();
        for number in 1..=3 * WINDOW {
            let critical = if number == 10 { 0.25 } else { 4.0 };
            step = tempo.next(step, critical, number);
            lengths.push(step);
        }
        let at = |number: u64| lengths[number as usize - 1];
        assert_eq!([at(9), at(10), at(WINDOW), at(2 * WINDOW - 1)], [0.5, 0.03125, 0.03125, 0.03125]);
        assert_eq!([at(2 * WINDOW), at(3 * WINDOW)], [0.03125, 0.5]);
    }

    #[test]
    fn a_step_that_leads_into_a_wall_is_tried_again() {
        let tempo = Tempo::new(0.125, 1.0);
        assert_eq!(tempo.shorter(0.25, 1.0), None);
        assert_eq!(tempo.shorter(0.251, 1.0), Some(0.125));
        assert_eq!(tempo.shorter(0.5, 1.0), Some(0.125));
        assert_eq!(tempo.shorter(0.5, 1.5), Some(0.1875));
        assert_eq!(tempo.shorter(1.0, 1e-9), Some(0.1));
    }

    /// Each of its quantities alone makes it one that no run can have come to.
    #[test]
    fn forged_steps_are_told() {
        let whole = Tempo { safety: 0.125, longest: 1.0, shortest: [0.5, f64::INFINITY] };
        assert_eq!(whole.validate(), Ok(()));
        let forged = [
            Tempo { safety: 0.0, ..whole },
            Tempo { safety: f64::INFINITY, ..whole },
            Tempo { longest: -1.0, ..whole },
            Tempo { longest: f64::NAN, ..whole },
            Tempo { shortest: [0.0, 1.0], ..whole },
            Tempo { shortest: [1.0, -1.0], ..whole },
            Tempo { shortest: [1.0, f64::NAN], ..whole },
        ];
        assert_all!(forged, |tempo| tempo.validate().is_err());
    }
}
