//! How large grains are.
//!
//! All distributions are by number. A lognormal cut at two radii keeps the shape of its density between them
//! (it is not the distribution clamped to the bounds): ln r is drawn uniformly between the cuts and kept with the
//! probability of the normal density over its peak there. Where the density has fallen to e^-39 of that peak, about
//! nine geometric deviations out, nothing is drawn: a double cannot tell.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::rng::Stream;
use crate::units::{Length, Quantity};

/// The closed set of size distributions (by number).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Size {
    /// All the same.
    Constant(ConstantSize),
    /// Uniform between two radii.
    Uniform(UniformSize),
    /// Lognormal, cut at two radii.
    Lognormal(LognormalSize),
    /// Classes with their shares.
    Table(SizeTable),
    /// All the same, from [B]'s ratio of radius and subvolume.
    LengthRatio(LengthRatio),
}

/// All grains of radius b = L D / n^(1/3) ([B], section 7).
///
/// D is half the edge of the paper's box, so the solid fraction in that box is (4/3) pi L³ / 8, an eighth of what [B]
/// prints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LengthRatio {
    /// L: all have the radius L D/n^(1/3).
    pub ratio: f64,
    /// D: half the edge of the cubic box.
    pub half_edge: Length,
    /// n: the number of grains in it, which is the placement's.
    pub count: u32,
}

/// All grains of one radius.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConstantSize {
    /// The radius.
    pub radius: Length,
}

/// Radii uniform between two bounds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UniformSize {
    /// Smallest radius.
    pub smallest: Length,
    /// Largest radius.
    pub largest: Length,
}

/// Lognormal radii.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LognormalSize {
    /// Median radius (the geometric mean).
    pub median: Length,
    /// Geometric standard deviation, above 1.
    pub geometric_deviation: f64,
    /// Smallest radius.
    pub smallest: Length,
    /// Largest radius.
    pub largest: Length,
}

/// Classes of radii with their shares by number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SizeTable {
    /// Radii of the classes.
    pub radii: Vec<Length>,
    /// Shares by number, of any sum.
    pub shares: Vec<f64>,
}

impl Size {
    /// What is wrong with it, if anything.
    pub fn fault(&self) -> Option<String> {
        let valid = |radius: &Length| radius.si().is_finite() && radius.si() > 0.0;
        let ordered = |smallest: &Length, largest: &Length| {
            (valid(smallest) && valid(largest) && smallest <= largest)
                .then_some(())
                .ok_or("radii must be above zero and `smallest` not above `largest`")
        };
        let checked = match self {
            Self::Constant(size) if valid(&size.radius) => Ok(()),
            Self::Constant(_) => Err("the radius must be above zero"),
            Self::Uniform(size) => ordered(&size.smallest, &size.largest),
            Self::Lognormal(size) if !valid(&size.median) => Err("the median must be above zero"),
            Self::Lognormal(size)
                if !size.geometric_deviation.is_finite() || size.geometric_deviation <= 1.0 =>
            {
                Err("the geometric deviation must be above 1")
            }
            Self::Lognormal(size) => ordered(&size.smallest, &size.largest),
            Self::Table(size) => size.checked(),
            Self::LengthRatio(size) if valid(&Quantity(size.radius())) => Ok(()),
            Self::LengthRatio(_) => Err("the ratio, half_edge and count must be above zero"),
        };
        checked.err().map(str::to_owned)
    }

    /// Largest radius [m] that can come up.
    pub fn largest(&self) -> f64 {
        match self {
            Self::Constant(size) => size.radius.si(),
            Self::LengthRatio(size) => size.radius(),
            Self::Uniform(size) => size.largest.si(),
            Self::Lognormal(size) => size.largest.si(),
            Self::Table(size) => size.classes().fold(0.0, |largest, (radius, _)| radius.max(largest)),
        }
    }

    /// Smallest radius [m] that can come up.
    pub fn smallest(&self) -> f64 {
        match self {
            Self::Constant(size) => size.radius.si(),
            Self::LengthRatio(size) => size.radius(),
            Self::Uniform(size) => size.smallest.si(),
            Self::Lognormal(size) => size.smallest.si(),
            Self::Table(size) => {
                size.classes().fold(f64::INFINITY, |smallest, (radius, _)| radius.min(smallest))
            }
        }
    }

    /// Mean volume [m³] of a grain.
    ///
    /// Closed forms; for the lognormal a Simpson sum whose error is below 1e-9 of the value.
    pub fn mean_volume(&self) -> f64 {
        let mean_cube = match self {
            Self::Constant(size) => size.radius.si().powi(3),
            Self::LengthRatio(size) => size.radius().powi(3),
            Self::Uniform(size) => {
                // (b⁴ - a⁴)/(4 (b - a)), written so that a = b is no exception.
                let (a, b) = (size.smallest.si(), size.largest.si());
                0.25 * (a + b) * (a * a + b * b)
            }
            Self::Lognormal(size) => size.mean_cube(),
            Self::Table(size) => {
                let (cubes, shares) = size.classes().fold((0.0, 0.0), |(cubes, shares), (radius, share)| {
                    (cubes + share * radius.powi(3), shares + share)
                });
                cubes / shares
            }
        };
        4.0 / 3.0 * std::f64::consts::PI * mean_cube
    }

    /// Draws a radius [m]. The size must have no [`fault`](Self::fault).
    pub fn sample(&self, stream: &mut Stream) -> f64 {
        match self {
            Self::Constant(size) => size.radius.si(),
            Self::LengthRatio(size) => size.radius(),
            Self::Uniform(size) => {
                let (a, b) = (size.smallest.si(), size.largest.si());
                a + (b - a) * stream.uniform()
            }
            Self::Lognormal(size) => size.sample(stream),
            Self::Table(size) => size.sample(stream),
        }
    }
}

impl LengthRatio {
    /// The radius [m].
    pub fn radius(&self) -> f64 {
        self.ratio * self.half_edge.si() / f64::from(self.count).cbrt()
    }
}

/// Exponent below the peak at which the normal density counts as nothing.
const NOTHING: f64 = 39.0;

impl LognormalSize {
    fn deviation(&self) -> f64 {
        self.geometric_deviation.ln()
    }

    /// Bounds of y = ln(r/median)/ln(geometric deviation), and the y of highest density between them.
    fn window(&self) -> (f64, f64, f64) {
        let y_of = |radius: Length| (radius.si() / self.median.si()).ln() / self.deviation();
        let (low, high) = (y_of(self.smallest), y_of(self.largest));
        let peak = if low > 0.0 { low } else { high.min(0.0) };
        let reach = (peak * peak + 2.0 * NOTHING).sqrt();
        (low.max(-reach), high.min(reach), peak)
    }

    fn radius(&self, y: f64) -> f64 {
        let radius = self.median.si() * (y * self.deviation()).exp();
        radius.clamp(self.smallest.si(), self.largest.si())
    }

    fn sample(&self, stream: &mut Stream) -> f64 {
        let (low, high, peak) = self.window();
        // At least one draw in fifty is kept however narrow or far out the window is.
        loop {
            let y = low + (high - low) * stream.uniform();
            if stream.uniform() < (0.5 * (peak * peak - y * y)).exp() {
                return self.radius(y);
            }
        }
    }

    fn mean_cube(&self) -> f64 {
        const INTERVALS: u32 = 2000;
        let (low, high, peak) = self.window();
        if high <= low {
            return self.radius(low).powi(3);
        }
        let (mut cubes, mut shares) = (0.0, 0.0);
        for k in 0..=INTERVALS {
            let simpson = match k {
                0 | INTERVALS => 1.0,
                _ if k % 2 == 1 => 4.0,
                _ => 2.0,
            };
            let y = low + (high - low) * f64::from(k) / f64::from(INTERVALS);
            let share = simpson * (0.5 * (peak * peak - y * y)).exp();
            cubes += share * self.radius(y).powi(3);
            shares += share;
        }
        cubes / shares
    }
}

impl SizeTable {
    fn classes(&self) -> impl Iterator<Item = (f64, f64)> {
        let pairs = self.radii.iter().zip(&self.shares);
        pairs.map(|(radius, &share)| (radius.si(), share)).filter(|&(_, share)| share > 0.0)
    }

    fn checked(&self) -> Result<(), &'static str> {
        if self.radii.len() != self.shares.len() {
            return Err("`radii` and `shares` must be of the same length");
        }
        if self.radii.iter().any(|radius| !radius.si().is_finite() || radius.si() <= 0.0) {
            return Err("radii must be above zero");
        }
        if self.shares.iter().any(|share| !share.is_finite() || *share < 0.0) {
            return Err("shares must not be below zero");
        }
        let some = self.shares.iter().any(|share| *share > 0.0);
        if some { Ok(()) } else { Err("at least one share must be above zero") }
    }

    fn sample(&self, stream: &mut Stream) -> f64 {
        let total: f64 = self.classes().map(|(_, share)| share).sum();
        let mut left = stream.uniform() * total;
        let mut last = 0.0;
        for (radius, share) in self.classes() {
            last = radius;
            left -= share;
            if left < 0.0 {
                break;
            }
        }
        last
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::Purpose;

    fn lognormal(median: f64, geometric_deviation: f64, smallest: f64, largest: f64) -> Size {
        Size::Lognormal(LognormalSize {
            median: Quantity(median),
            geometric_deviation,
            smallest: Quantity(smallest),
            largest: Quantity(largest),
        })
    }

    fn uniform(smallest: f64, largest: f64) -> Size {
        Size::Uniform(UniformSize { smallest: Quantity(smallest), largest: Quantity(largest) })
    }

    fn table() -> Size {
        Size::Table(SizeTable {
            radii: [1.0, 2.0, 9.0, 3.0].map(Quantity).into(),
            shares: vec![6.0, 3.0, 0.0, 1.0],
        })
    }

    /// The mean volume of many draws is the one that is claimed, within five standard errors (below 1 %).
    #[test]
    fn draws_have_the_claimed_mean_volume() {
        let sizes = [
            Size::Constant(ConstantSize { radius: Quantity(2.0) }),
            uniform(1.0, 3.0),
            lognormal(1.0, 1.4, 0.5, 2.0),
            lognormal(1.0, 1.25, 1e-3, 1e3),
            lognormal(1.0, 1.2, 6.0, 8.0),
            table(),
        ];
        for size in sizes {
            let mut stream = Stream::new(11, Purpose::Size, 0);
            let n = 1_000_000;
            let (mut sum, mut squares) = (0.0, 0.0);
            for _ in 0..n {
                let radius = size.sample(&mut stream);
                assert_between!(radius, size.smallest()..=size.largest());
                let volume = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
                sum += volume;
                squares += volume * volume;
            }
            let mean = sum / f64::from(n);
            let error = ((squares / f64::from(n) - mean * mean).max(0.0) / f64::from(n)).sqrt();
            let bound = 5.0 * error + 1e-9 * mean;
            assert!((mean - size.mean_volume()).abs() < bound, "{size:?}: {mean} {}", size.mean_volume());
            assert_below!(bound, 0.01 * mean);
        }
    }

    /// E r³ = m³ exp(9 s²/2) for an uncut lognormal; (a+b)(a²+b²)/4 for a uniform one; 0.6 + 0.3 8 + 0.1 27.
    #[test]
    fn mean_volumes_in_closed_form() {
        let ball = 4.0 / 3.0 * std::f64::consts::PI;
        let s = 1.5_f64.ln();
        let uncut = lognormal(2.0, 1.5, 1e-9, 1e9).mean_volume() / ball;
        // The window ends at 8.8 deviations, 7.6 from the peak of the integrand: 1e-13 is cut off.
        assert_close!(uncut, 8.0 * (4.5 * s * s).exp(), 1e-9);
        assert_near!(uniform(1.0, 3.0).mean_volume() / ball, 10.0, 1e-13);
        assert_near!(uniform(2.0, 2.0).mean_volume() / ball, 8.0, 1e-13);
        assert_near!(table().mean_volume() / ball, 0.6 + 2.4 + 2.7, 1e-13);
        assert_near!(lognormal(2.0, 1.5, 3.0, 3.0).mean_volume() / ball, 27.0, 1e-12);
    }

    /// Half of the draws of a lognormal that is cut evenly lie below its median: within five standard errors.
    #[test]
    fn median_of_a_lognormal() {
        let size = lognormal(2.0, 1.5, 2.0 / 3.0, 6.0);
        let mut stream = Stream::new(2, Purpose::Size, 3);
        let n = 1_000_000;
        let below = (0..n).filter(|_| size.sample(&mut stream) < 2.0).count();
        assert_near!(below as f64 / f64::from(n), 0.5, 5.0 * 0.5 / f64::from(n).sqrt());
    }

    /// [B]'s best length ratio in its box: a thousand grains of 0.79041 mm, which fill (4/3) pi L³/8 = 0.25856 of it.
    #[test]
    fn length_ratio_by_hand() {
        let law = LengthRatio { ratio: 0.79041, half_edge: Quantity(0.01), count: 1000 };
        let size = Size::LengthRatio(law.clone());
        let mut stream = Stream::new(1, Purpose::Size, 0);
        // A cube root and two roundings.
        for radius in [size.largest(), size.smallest(), size.sample(&mut stream)] {
            assert_close!(radius, 0.790_41e-3, 1e-15, "in m");
        }
        let fraction = 1000.0 * size.mean_volume() / 0.02_f64.powi(3);
        // Five digits are written.
        assert!((fraction - 0.258_56).abs() < 5e-6, "{fraction}");
        assert_eq!(size.fault(), None);
        for bad in [
            LengthRatio { count: 0, ..law.clone() },
            LengthRatio { ratio: -1.0, ..law.clone() },
            LengthRatio { half_edge: Quantity(0.0), ..law },
        ] {
            assert_some!(Size::LengthRatio(bad).fault());
        }
    }

    #[test]
    fn faults_are_named() {
        let bad = [
            (Size::Constant(ConstantSize { radius: Quantity(0.0) }), "above zero"),
            (uniform(2.0, 1.0), "not above `largest`"),
            (lognormal(1.0, 1.0, 0.5, 2.0), "above 1"),
            (lognormal(f64::NAN, 1.2, 0.5, 2.0), "median"),
            (Size::Table(SizeTable { radii: vec![Quantity(1.0)], shares: vec![] }), "same length"),
            (Size::Table(SizeTable { radii: vec![Quantity(1.0)], shares: vec![0.0] }), "at least one"),
        ];
        for (size, words) in bad {
            assert!(size.fault().is_some_and(|fault| fault.contains(words)), "{size:?}");
        }
        assert_eq!(table().fault(), None);
    }
}
