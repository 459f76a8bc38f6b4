//! How fast a force can change the motion that it acts on, and the longest explicit step that follows.
//!
//! # Equation
//! $$ \Delta t_c = \frac{2}{\Gamma + \sqrt{\Gamma^2 + \omega^2}} $$          (S1)
//! the border of stability of x'' = -ω² x - Γ x' under velocity Verlet whose velocity-dependent force is that at the
//! predicted velocity: 2/ω for a spring, 1/Γ for a dashpot.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning |
//! |--------|--------------|------|---------|
//! | ω² | `square` | 1/s² | stiffness over mass |
//! | Γ  | `rate`   | 1/s  | dashpot coefficient over mass, or a frequency of rotation |
//!
//! # Valid when
//! Paces of laws that act together add up: stiffnesses and dashpots in parallel do.

use std::ops::Add;

use serde::{Deserialize, Serialize};

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

    #[test]
    fn paces_add_and_compare() {
        let (spring, dashpot) = (Pace::of_spring(-8.0, 2.0), Pace::of_dashpot(3.0, 2.0));
        assert_eq!(spring + dashpot, Pace { square: 4.0, rate: 1.5 });
        assert_eq!((spring + dashpot).critical_step(), 0.5);
        assert_eq!(spring.max(Pace { square: f64::NAN, rate: 1.0 }), Pace { square: 4.0, rate: 1.0 });
        assert_eq!(Pace::NONE.critical_step(), f64::INFINITY);
    }
}
