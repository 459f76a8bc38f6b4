//! When what is due.
//!
//! Turn k is due at k times the interval, counted and not summed, so that turns never drift. It is taken at the first step
//! whose time is at or after that. A clock that adds up steps loses some of them to rounding; what it has lost counts as
//! reached, and so do [`ROUND_OFF`] of the time itself. So a turn that coincides with a step is taken at this step and not
//! at the next. Where one step passes several turns they are taken as one: the state between is not known.
//!
//! While rays fly another interval can hold besides: its turns count from the latest launch, and there is a last one when
//! the rays are gone.

use serde::{Deserialize, Serialize};

use crate::scenario::{Output, PulseOutput};
use crate::units::Time;

/// Part of the time within which a turn counts as reached: the interval, its multiple, the step and the sum of the steps
/// are each rounded by half of the last bit.
pub const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

/// Where a simulation stands in time, for those who ask what is due.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment {
    /// Simulated time [s].
    pub time: f64,
    /// What rounding has taken from it [s].
    pub lag: f64,
    /// When the latest pulse started [s], from its launch until its rays are gone.
    pub pulse: Option<f64>,
}

impl Moment {
    /// Whether `due` [s] is reached.
    fn reaches(&self, due: f64) -> bool {
        self.time >= due || self.time + self.lag + ROUND_OFF * self.time >= due
    }
}

/// Something that is due at equal intervals of simulated time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timer {
    start: f64,
    interval: f64,
    next: u64,
}

impl Timer {
    fn new(interval: Option<Time>, next: u64) -> Self {
        Self { start: 0.0, interval: interval.map_or(f64::INFINITY, Time::si), next }
    }

    fn turn(&self, number: u64) -> f64 {
        if number == 0 { self.start } else { self.start + number as f64 * self.interval }
    }

    /// Time [s] of the next turn.
    pub fn next(&self) -> f64 {
        self.turn(self.next)
    }

    /// Whether it is the one with this start and interval [s], and its next turn the first that is not reached.
    fn stands(&self, start: f64, interval: Option<Time>, now: f64) -> bool {
        let due = Self { start, ..Self::new(interval, self.next) };
        // Whether a turn is reached is a question of rounding, of which a part of the interval is far away.
        let slack = 1e-3 * due.interval + ROUND_OFF * now;
        let last = self.next.checked_sub(1).map_or(f64::NEG_INFINITY, |last| due.turn(last));
        *self == due && last <= now + slack && due.next() >= now - slack
    }

    /// How many turns were reached since the last call; the next one is the first that is not.
    pub fn take(&mut self, now: &Moment) -> u64 {
        if !now.reaches(self.next()) {
            return 0;
        }
        let first = self.next;
        // Near to the last turn at once, and from there one by one, as rounding has it.
        let passed = ((now.time - self.start) / self.interval) as u64;
        self.next = first.max(passed.saturating_sub(1));
        while now.reaches(self.next()) {
            self.next += 1;
        }
        self.next - first
    }
}

/// What is due at equal intervals, and more often while rays fly.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Schedule {
    always: Timer,
    /// Interval while rays fly [s]; none if they change nothing.
    in_pulses: Option<f64>,
    /// Counts from the latest launch while rays fly.
    pulse: Option<Timer>,
}

impl Schedule {
    fn new(always: Option<Time>, in_pulses: Option<Time>) -> Self {
        Self { always: Timer::new(always, 0), in_pulses: in_pulses.map(Time::si), pulse: None }
    }

    /// Time [s] of the next turn.
    pub fn next(&self) -> f64 {
        self.always.next().min(self.pulse.map_or(f64::INFINITY, |timer| timer.next()))
    }

    /// Whether it is the one with these intervals, and stands where it should at this moment.
    fn stands(&self, always: Option<Time>, in_pulses: Option<Time>, now: &Moment) -> bool {
        let of_pulse = match (self.pulse, now.pulse) {
            (Some(timer), Some(start)) => timer.stands(start, in_pulses, now.time),
            (None, start) => start.is_none() || in_pulses.is_none(),
            (Some(_), None) => false,
        };
        of_pulse && self.in_pulses == in_pulses.map(Time::si) && self.always.stands(0.0, always, now.time)
    }

    /// Whether it is due, and then how many turns of one interval fell into one with another.
    pub fn take(&mut self, now: &Moment) -> Option<u64> {
        let turns = [self.always.take(now), self.take_in_pulse(now)];
        turns.iter().any(|turns| *turns > 0).then(|| turns.iter().map(|turns| turns.saturating_sub(1)).sum())
    }

    fn take_in_pulse(&mut self, now: &Moment) -> u64 {
        let Some(interval) = self.in_pulses else { return 0 };
        let (before, start) = (self.pulse, now.pulse);
        let Some(start) = start else {
            // A last turn shows that the rays are gone.
            self.pulse = None;
            return u64::from(before.is_some());
        };
        let mut timer =
            before.filter(|timer| timer.start == start).unwrap_or(Timer { start, interval, next: 0 });
        let turns = timer.take(now);
        self.pulse = Some(timer);
        turns
    }
}

/// The timers of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timers {
    /// Rows of the tables.
    pub rows: Schedule,
    /// Frames.
    pub frames: Schedule,
    /// Checkpoints.
    pub checkpoints: Timer,
}

impl Timers {
    /// The timers as the scenario has them; the first checkpoint is written by hand.
    pub fn new(output: &Output) -> Self {
        let PulseOutput { series, frames } = output.pulses.clone().unwrap_or_default();
        Self {
            rows: Schedule::new(output.series, series),
            frames: Schedule::new(output.frames, frames),
            checkpoints: Timer::new(output.checkpoints, 1),
        }
    }

    /// Whether they are those of this scenario, and stand where they should at this moment.
    pub fn stand(&self, output: &Output, now: &Moment) -> bool {
        let PulseOutput { series, frames } = output.pulses.clone().unwrap_or_default();
        self.rows.stands(output.series, series, now)
            && self.frames.stands(output.frames, frames, now)
            && self.checkpoints.stands(0.0, output.checkpoints, now.time)
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

    fn every(seconds: f64) -> Time {
        Quantity(seconds)
    }

    fn at(time: f64) -> Moment {
        Moment { time, ..Moment::default() }
    }

    /// Turns are multiples of the interval to the last bit, however many there were.
    #[test]
    fn turns_do_not_drift() {
        let mut timer = Timer::new(Some(every(0.1)), 0);
        for turn in 0..1000_u64 {
            assert_eq!(timer.next(), if turn == 0 { 0.0 } else { turn as f64 * 0.1 });
            assert_eq!([timer.take(&at(timer.next() - 1e-9)), timer.take(&at(timer.next()))], [0, 1]);
        }
    }

    #[test]
    fn turns_that_one_step_passes_are_counted() {
        let mut timer = Timer::new(Some(every(1.0)), 1);
        assert_eq!([0.5, 7.5, 7.9, 8.0].map(|time| timer.take(&at(time))), [0, 7, 0, 1]);
        assert_eq!(timer.next(), 9.0);
        assert_eq!(Timer::new(None, 1).next(), f64::INFINITY);
        // A clock that has come far at once.
        assert_eq!(Timer::new(Some(every(1.0)), 1).take(&at(1e12 + 0.5)), 1_000_000_000_000);
    }

    /// Steps are summed with rounding, as engines do it, and each that coincides with a turn takes it.
    #[test]
    fn a_turn_at_a_step_is_taken_at_this_step() {
        // Step, steps between turns, steps.
        let cases =
            [(0.02, 1, 47), (1e-6, 10, 1000), (1e-5, 7, 100_000), (0.1, 3, 3000), (1.0 / 3.0, 1, 30_000)];
        for (step, share, count) in cases {
            let mut timer = Timer::new(Some(every(step * f64::from(share))), 0);
            let (mut time, mut lag) = (0.0, 0.0);
            assert_eq!(timer.take(&at(0.0)), 1);
            for number in 1..=count {
                let next: f64 = time + step;
                lag += crate::math::rounding_of_sum(time, step);
                time = next;
                let due = u64::from(number % share == 0);
                assert_eq!(timer.take(&Moment { time, lag, pulse: None }), due, "step {number} of {step} s");
            }
        }
    }

    #[test]
    fn the_next_thing_is_the_first_of_all() {
        let output = Output {
            series: Some(every(2.0)),
            frames: Some(every(3.0)),
            checkpoints: Some(every(0.5)),
            ..Output::default()
        };
        let mut timers = Timers::new(&output);
        assert_eq!(timers.next(), 0.0);
        assert_eq!((timers.rows.take(&at(0.0)), timers.frames.take(&at(0.0))), (Some(0), Some(0)));
        assert_eq!(timers.checkpoints.take(&at(0.0)), 0);
        assert_eq!(timers.next(), 0.5);
        assert_eq!(timers.checkpoints.take(&at(2.6)), 5);
        assert_eq!(timers.next(), 2.0);
    }

    /// Every 1 s; every 0.1 s from a launch at 2.05 s until the rays are gone at 2.33 s, and again from 2.5 s.
    #[test]
    fn turns_are_denser_while_rays_fly() {
        let mut rows = Schedule::new(Some(every(1.0)), Some(every(0.1)));
        let mut taken = Vec::new();
        for hundredths in 0..=300_u32 {
            let pulse = match hundredths {
                205..=232 => Some(2.05),
                250..=254 => Some(2.5),
                _ => None,
            };
            let now = Moment { pulse, ..at(f64::from(hundredths) / 100.0) };
            if let Some(merged) = rows.take(&now) {
                assert_eq!(merged, 0);
                taken.push(hundredths);
            }
        }
        assert_eq!(taken, [0, 100, 200, 205, 215, 225, 233, 250, 255, 300]);
    }

    #[test]
    fn a_launch_while_rays_fly_begins_anew() {
        let mut rows = Schedule::new(None, Some(every(1.0)));
        let times = [(0.25, 0.25), (0.5, 0.25), (1.25, 0.25), (1.75, 1.75), (2.25, 1.75), (2.75, 1.75)];
        let taken =
            times.map(|(time, start)| rows.take(&Moment { pulse: Some(start), ..at(time) }).is_some());
        assert_eq!(taken, [true, false, true, true, false, true]);
        assert_eq!(rows.take(&Moment { pulse: Some(1.75), ..at(9.75) }), Some(6));
        assert_eq!([rows.take(&at(9.8)), rows.take(&at(9.9))], [Some(0), None]);
    }

    /// As they are after each step of a run, and as nobody leaves them.
    #[test]
    fn timers_stand_where_the_clock_is() {
        let output = Output {
            series: Some(every(0.1)),
            frames: None,
            checkpoints: Some(every(0.5)),
            pulses: Some(PulseOutput { series: Some(every(0.03)), frames: Some(every(0.1)) }),
            ..Output::default()
        };
        let mut timers = Timers::new(&output);
        for step in 0..=400_u32 {
            let pulse = (step % 100 > 20 && step % 100 < 70).then(|| f64::from(step / 100) + 0.2);
            let now = Moment { pulse, ..at(0.01 * f64::from(step)) };
            timers.rows.take(&now);
            timers.frames.take(&now);
            timers.checkpoints.take(&now);
            assert!(timers.stand(&output, &now), "{step}: {timers:?}");
            let away = Moment { time: now.time + 0.7, ..now };
            assert!(!timers.stand(&output, &away), "{step}");
        }
        let now = Moment { pulse: Some(3.9), ..at(4.0) };
        let (mut flying, mut other) = (timers, output.clone());
        flying.rows.take(&now);
        flying.frames.take(&now);
        assert_true!(flying.stand(&output, &now), "the next times fit the interval of the outputs");
        assert_false!(flying.stand(&output, &at(4.0)), "the next times fit the interval of the outputs");
        other.series = Some(every(0.2));
        assert_false!(timers.stand(&other, &at(4.0)), "the next times fit the interval of the outputs");
        let forged: [fn(&mut Timers); 7] = [
            |timers| timers.rows.always.interval = 0.0,
            |timers| timers.rows.always.interval = f64::NAN,
            |timers| timers.rows.always.start = f64::NEG_INFINITY,
            |timers| timers.checkpoints.next = u64::MAX,
            |timers| timers.checkpoints.next = 0,
            |timers| timers.rows.in_pulses = Some(0.0),
            |timers| timers.rows.pulse = Some(Timer { start: 1.0, interval: 0.0, next: 0 }),
        ];
        for (number, forge) in forged.iter().enumerate() {
            let mut forged = timers;
            forge(&mut forged);
            assert!(!forged.stand(&output, &at(4.0)), "{number}");
        }
    }

    /// Turns that were passed and not taken are told, however short or long the interval.
    #[test]
    fn timers_that_lag_are_told() {
        for interval in [1e-9, 1e-3, 1e6] {
            let output = Output {
                series: Some(every(interval)),
                frames: None,
                checkpoints: None,
                ..Output::default()
            };
            let (mut timers, now) = (Timers::new(&output), at(3.5 * interval));
            assert_false!(timers.stand(&output, &now), "nobody took the rows every {interval} s");
            // Four turns at once, of which three have no row of their own.
            assert_eq!(timers.rows.take(&now), Some(3));
            assert_true!(timers.stand(&output, &now), "the rows every {interval} s are taken");
        }
    }
}
