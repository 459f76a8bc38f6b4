//! How fast a force can change the motion that it acts on, and the longest explicit step that follows.
//!
//! # Equation
//! $$ \Delta t_c = \frac{2}{\Gamma + \sqrt{\Gamma^2 + \omega^2}} $$          (S1)
//! the border of stability of x'' = -ω² x - Γ x' under velocity Verlet whose velocity-dependent force is that at the
//! predicted velocity: 2/ω for a spring, 1/Γ for a dashpot.
//!
//! # What is solved for
//! A drag -c v whose end of step is solved for (trapezoidal rule) has no border of stability: with z = c Δt/m a velocity
//! shrinks by (1 - z/2)/(1 + z/2) a step, the spring's border is ω Δt < 2 at least, and the way on which a grain comes to
//! rest is exact. Only the decay's pace is off: -ln of that factor is z (1 + z²/12 + z⁴/80 + ...), so that
//! $$ \left| v - v_0 e^{-t/\tau} \right| \le \frac{z^2}{12 e} v_0, \qquad \tau = m/c $$          (S2)
//! with the largest error at t = τ. Where drag is faster than a spring, the slow motion against the spring is nearer to
//! the truth than that. A step of `safety` s takes z = 6 s, so (S2) is 1.1 s²: 0.1 % of what is lost at s = 0.03, as much
//! as half a period of a contact is off (π s²/6 = 0.5 s² in phase, s²/2 in energy). So a drag that is solved for counts
//! with Γ = c/(6 m). Frequencies and decays of spring and drag together are then within 1.2 s² for all but the fast
//! decay, which has z²/12 = 3 s² at most. A rotation that is solved for is off by z²/12 of all the angle that it turns
//! through, not once, and counts in full.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning |
//! |--------|--------------|------|---------|
//! | ω² | `square` | 1/s² | stiffness over mass |
//! | Γ  | `rate`   | 1/s  | dashpot coefficient over mass, a sixth of that if solved for, or a frequency of rotation |
//!
//! # Valid when
//! Paces of laws that act together add up: stiffnesses and dashpots in parallel do.

use std::ops::Add;

use serde::{Deserialize, Serialize};

/// How many times as long a decay's steps are if its end is solved for.
const SOLVED: f64 = 6.0;

/// What a law can do at its fastest: the square of a frequency and the rate of a decay.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pace {
    /// ω² [1/s²].
    pub square: f64,
    /// Γ [1/s].
    pub rate: f64,
}

impl Pace {
    /// Nothing changes.
    pub const NONE: Self = Self { square: 0.0, rate: 0.0 };

    /// A spring [N/m] that moves a mass [kg]; one that pushes away is as fast as one that pulls back.
    #[inline]
    pub fn of_spring(stiffness: f64, mass: f64) -> Self {
        Self { square: stiffness.abs() / mass, rate: 0.0 }
    }

    /// A dashpot [N s/m] that slows a mass [kg].
    #[inline]
    pub fn of_dashpot(coefficient: f64, mass: f64) -> Self {
        Self { square: 0.0, rate: coefficient.abs() / mass }
    }

    /// A drag [N s/m] that slows a mass [kg] and is solved for: (S2).
    #[inline]
    pub fn of_solved_drag(coefficient: f64, mass: f64) -> Self {
        Self { square: 0.0, rate: coefficient.abs() / (SOLVED * mass) }
    }

    /// The faster of two springs and the faster of two dashpots, for modes that do not act together. What is not a
    /// number does not count.
    #[inline]
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self { square: self.square.max(other.square), rate: self.rate.max(other.rate) }
    }

    /// Δt_c [s]; infinite where nothing changes.
    #[inline]
    pub fn critical_step(&self) -> f64 {
        2.0 / (self.rate + (self.rate * self.rate + self.square).sqrt())
    }
}

impl Add for Pace {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { square: self.square + other.square, rate: self.rate + other.rate }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Amplitude after many steps of velocity Verlet with the velocity-dependent force at the predicted velocity.
    fn amplitude(pace: Pace, dt: f64) -> f64 {
        let force = |x: f64, v: f64| -pace.square * x - pace.rate * v;
        let (mut x, mut v) = (0.0, 1.0);
        let mut load = force(x, v);
        for _ in 0..4000 {
            x += dt * v + 0.5 * dt * dt * load;
            let next = force(x, v + dt * load);
            v += 0.5 * dt * (load + next);
            load = next;
        }
        x.abs() + v.abs()
    }

    /// Half a per cent below the border nothing grows, half a per cent above everything does.
    #[test]
    fn the_critical_step_is_the_border_of_stability() {
        for (square, rate) in [(1.0, 0.0), (1.0, 0.1), (1.0, 0.5), (1.0, 3.0), (1.0, 100.0), (0.0, 1.0)] {
            let pace = Pace { square, rate };
            let critical = pace.critical_step();
            assert!(amplitude(pace, 0.995 * critical) < 1e3, "{pace:?}");
            // Without a spring only the velocity grows.
            let above = amplitude(pace, 1.005 * critical);
            assert!(above > 1e6 || !above.is_finite(), "{pace:?}: {above}");
        }
    }

    /// A step (x, v) of velocity Verlet for x'' = -w² x - z x' in units of its length, the drag solved for.
    fn with_solved_drag(w: f64, z: f64, (x, v): (f64, f64)) -> (f64, f64) {
        let (kept, slower) = (1.0 - 0.5 * z, 1.0 + 0.5 * z);
        let moved = x + 0.5 * (v + (kept * v - w * w * x) / slower);
        (moved, (kept * v - 0.5 * w * w * (x + moved)) / slower)
    }

    /// (S2), and no more than that by half: the error is what the pace promises.
    #[test]
    fn a_decay_that_is_solved_for_errs_as_promised() {
        for safety in [0.01, 0.03, 0.1] {
            let z = safety * Pace::of_solved_drag(3.0, 2.0).critical_step() * 1.5;
            let (mut state, mut worst) = ((0.0, 1.0), 0.0_f64);
            for step in 1..2000 {
                state = with_solved_drag(0.0, z, state);
                worst = worst.max((state.1 - (-z * f64::from(step)).exp()).abs());
            }
            // z²/(12 e) = 3 s²/e; the next term of the series is 0.15 z², 5 % at s = 0.1, and steps miss t = τ by z/2.
            let part = worst / (3.0 * safety * safety / std::f64::consts::E);
            assert!((part - 1.0).abs() < 0.005 + 6.0 * safety * safety, "{safety}: {part}");
            assert!((state.0 * z - 1.0).abs() < 1e-12, "{safety}: the way");
        }
    }

    /// A spring and a drag that is solved for, from weak drag to one that the spring creeps against: position to 1.2 s² of
    /// the swing for each 1/w or slow decay, and stable up to w Δt = 2 with any drag.
    #[test]
    fn a_spring_with_drag_that_is_solved_for() {
        let safety = 0.03;
        for ratio in [0.0_f64, 0.3, 1.0, 1.9, 3.0, 10.0, 100.0, 1000.0] {
            let pace = Pace::of_spring(1.0, 1.0) + Pace::of_solved_drag(ratio, 1.0);
            let dt = safety * pace.critical_step();
            // Roots of x² + ratio x + 1 from a rest at x = 1: the exact motion.
            let half = 0.5 * ratio;
            let exact = |t: f64| match half * half - 1.0 {
                square if square > 0.0 => {
                    let (root, t) = (square.sqrt(), t);
                    let (slow, fast) = (-1.0 / (half + root), -half - root);
                    (fast * (slow * t).exp() - slow * (fast * t).exp()) / (fast - slow)
                }
                square => {
                    let root = (-square).sqrt();
                    (-half * t).exp() * ((root * t).cos() + half / root * (root * t).sin())
                }
            };
            let (mut state, mut time, mut worst) = ((1.0, 0.0), 0.0, 0.0_f64);
            let end = 1.0_f64.max(ratio);
            while time < end {
                state = with_solved_drag(dt, ratio * dt, state);
                time += dt;
                worst = worst.max((state.0 - exact(time)).abs());
            }
            assert!(worst < 1.2 * safety * safety, "{ratio}: {worst}");
        }
        for z in [0.0, 0.1, 1.0, 10.0, 1e4] {
            let end = (0..4000).fold((1.0, 1.0), |state, _| with_solved_drag(1.99, z, state));
            assert!(end.0.abs() + end.1.abs() < 1e3, "{z}: {end:?}");
        }
    }

    #[test]
    fn paces_add_and_compare() {
        let (spring, dashpot) = (Pace::of_spring(-8.0, 2.0), Pace::of_dashpot(3.0, 2.0));
        assert_eq!(spring + dashpot, Pace { square: 4.0, rate: 1.5 });
        assert_eq!((spring + dashpot).critical_step(), 0.5);
        assert_eq!(spring.max(Pace { square: f64::NAN, rate: 1.0 }), Pace { square: 4.0, rate: 1.0 });
        assert_eq!(Pace::NONE.critical_step(), f64::INFINITY);
    }
}
