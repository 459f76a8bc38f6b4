//! Whether a value converges under refinement, at which order, and where it has settled.
//!
//! # Equation
//! ```text
//! (f_3 - f_2)/(f_2 - f_1) = r_21^p (r_32^p - 1)/(r_21^p - 1),   r_21 = h_2/h_1, r_32 = h_3/h_2      (CV1)
//! f_0 = f_1 + (f_1 - f_2)/(r_21^p - 1)                                                          (CV2)
//! GCI = 1.25 |f_1 - f_2|/(r_21^p - 1)                                                           (CV3)
//! d_k = f_k - f_1,   |d_k| + t s_k <= TOL |f_1|: settled,   |d_k| - t s_k > TOL |f_1|: not settled     (CV4)
//! ```
//! Levels are numbered from the finest: 1 is the finest, 3 the coarsest. Where neither of (CV4) holds, the replicates scatter
//! too much to tell, and that it has settled is *not shown*.
//!
//! # Source
//! P. J. Roache, *Perspective: a method for uniform reporting of grid refinement studies*, J. Fluids Eng. 116, 405 (1994);
//! I. B. Celik et al., *Procedure for estimation and reporting of uncertainty due to discretization in CFD
//! applications*, J. Fluids Eng. 130, 078001 (2008), for ratios that vary. Paired differences and the two intervals of
//! (CV4): A. M. Law, *Simulation Modeling and Analysis*, 5th ed. (2015), sections 10.2 (paired t, Welch) and 11.2
//! (common random numbers).
//!
//! # Symbols
//! | symbol | name in code | unit      | meaning                                                           |
//! |--------|--------------|-----------|-------------------------------------------------------------------|
//! | h      | `size`       |           | step size, or 1 over the number of rays or grains                 |
//! | f      | `mean`       | the value's | mean of the value at a level                                    |
//! | p      | `order`      |           | observed order: the error falls like h^p                          |
//! | f_0    | `limit`      | the value's | Richardson's extrapolation to h = 0                             |
//! | GCI    | `uncertainty`| the value's | Roache's grid convergence index, not divided by f_1             |
//! | d_k    | `value`      | the value's | a level less the finest one                                     |
//! | s_k    | `standard_error` | the value's | standard error of d_k                                       |
//! | t      | `quantile`   | 1         | Student's t for [`LEVEL`]                                         |
//! | TOL    | `tolerance`  | 1         | part of the finest level's value                                  |
//!
//! # Valid when
//! The three finest levels are in the asymptotic range: the order of the three levels before is the same
//! (`is_asymptotic`). Differences within two standard errors are noise and give no order; so are those of round-off.
//! Intervals are those of one level; of many levels one in twenty may be outside its own.
//!
//! # Compared with others
//! Where levels share their replicates (common random numbers), replicate k of one is compared with replicate k of the other: much of
//! the scatter is in both and cancels. Standard errors of the means by themselves would call differences noise that are not.
//!
//! # Example
//! ```
//! use agglo::search::analysis::{Convergence, Level, Replicates, observed_order};
//! // f = 1 + h² at h = 0.4, 0.2, 0.1.
//! let levels = [0.4_f64, 0.2, 0.1].map(|size| Level { size, replicates: vec![1.0 + size * size] });
//! let Convergence::Converging(found) = observed_order(&levels, Replicates::Own) else { panic!("it converges") };
//! assert!((found.order - 2.0).abs() < 1e-12 && (found.limit - 1.0).abs() < 1e-12);
//! ```

use super::Moments;
use super::moments::ROUND_OFF;
use crate::math::roots::root_between;
use crate::search::student::quantile;

/// A level of refinement.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Level {
    /// Size that goes to zero: a step, or 1 over a number of rays or grains.
    pub size: f64,
    /// The value in each replicate, in their order.
    pub replicates: Vec<f64>,
}

/// Whether replicate k of one level and replicate k of another have the same seed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Replicates {
    /// They have: their difference is that of the levels.
    Shared,
    /// Each level has replicates of its own.
    #[default]
    Own,
}

/// What the finest levels say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Convergence {
    /// Fewer than three levels, or sizes that do not fall.
    TooFewLevels,
    /// Differences are not larger than two standard errors or than round-off: nothing can be said about the order.
    WithinNoise,
    /// The differences change their sign: not in the asymptotic range.
    Oscillating,
    /// The differences do not fall: not in the asymptotic range.
    Diverging,
    /// The differences fall.
    Converging(Order),
}

/// How a value converges. Standard errors are not numbers where each level has a single replicate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Order {
    /// Observed order.
    pub order: f64,
    /// Its standard error.
    pub order_standard_error: f64,
    /// Extrapolated value.
    pub limit: f64,
    /// Its standard error.
    pub limit_standard_error: f64,
    /// Roache's grid convergence index of the finest level, in units of the value.
    pub uncertainty: f64,
    /// Whether the three levels before have the same order to a tenth, or within two standard errors; none if there
    /// are no such levels, or they are noise.
    pub is_asymptotic: Option<bool>,
}

/// Whether a value has settled at a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It differs from the finest by no more than the tolerance, with confidence.
    Settled,
    /// It differs by more, with confidence.
    NotSettled,
    /// The replicates scatter too much to tell, or there is only one.
    NotShown,
}

/// How far a level is from the finest one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// The level's value less that of the finest.
    pub value: f64,
    /// Its standard error; not a number from a single replicate.
    pub standard_error: f64,
    /// Half the width of its confidence interval; infinite from a single replicate.
    pub half_width: f64,
    /// Whether it has settled there.
    pub verdict: Verdict,
}

/// Confidence level of the intervals.
pub const LEVEL: f64 = 0.95;
/// Largest order times logarithm of the ratio: beyond it the last difference is as good as zero.
const MOST: f64 = 50.0;
/// Differences are noise up to so many standard errors.
const NOISE: f64 = 2.0;
/// Roache's factor of safety for orders that are observed on three levels.
const SAFETY: f64 = 1.25;

impl Level {
    /// Mean and scatter of its replicates.
    pub fn moments(&self) -> Moments {
        Moments::of(&self.replicates)
    }

    fn mean(&self) -> f64 {
        self.moments().mean
    }
}

impl Verdict {
    /// Its word in tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Settled => "settled",
            Self::NotSettled => "not_settled",
            Self::NotShown => "not_shown",
        }
    }

    fn of(difference: f64, half_width: f64, allowed: f64) -> Self {
        if difference.abs() + half_width <= allowed {
            Self::Settled
        } else if difference.abs() - half_width > allowed {
            Self::NotSettled
        } else {
            Self::NotShown
        }
    }
}

/// Standard error and degrees of freedom of the weighted sum of the levels' means; not a number from single replicates.
fn error_of_sum(levels: &[&Level], weights: &[f64], replicates: Replicates) -> (f64, u64) {
    if replicates == Replicates::Shared {
        let count = levels.iter().map(|level| level.replicates.len()).min().unwrap_or(0);
        let sum = |replicate: usize| {
            levels.iter().zip(weights).map(|(level, w)| w * level.replicates[replicate]).sum()
        };
        let sums: Vec<f64> = (0..count).map(sum).collect();
        return (Moments::of(&sums).standard_error(), (count as u64).saturating_sub(1));
    }
    let square = |(level, weight): (&&Level, &f64)| {
        let moments = level.moments();
        ((weight * moments.standard_error()).powi(2), moments.count as f64 - 1.0)
    };
    let squares: Vec<(f64, f64)> = levels.iter().zip(weights).map(square).collect();
    let sum: f64 = squares.iter().map(|(square, _)| square).sum();
    // Welch's degrees of freedom, rounded down.
    let freedom = sum * sum / squares.iter().map(|(square, freedom)| square * square / freedom).sum::<f64>();
    (sum.sqrt(), if freedom.is_finite() { freedom as u64 } else { 1 })
}

/// How far each level but the last, the finest, is from that one, and whether the value has settled there: within
/// `tolerance` times the finest value.
/// ```
/// use agglo::search::analysis::{Level, Replicates, Verdict, differences};
/// // Two levels whose replicates differ by 1.0 +- 0.1 although each of them scatters by 50.
/// let coarse = Level { size: 2.0, replicates: vec![151.1, 101.0, 50.9] };
/// let fine = Level { size: 1.0, replicates: vec![150.0, 100.0, 50.0] };
/// let found = differences(&[coarse, fine], 0.02, Replicates::Shared);
/// assert!((found[0].value - 1.0).abs() < 1e-12 && found[0].verdict == Verdict::Settled);
/// ```
pub fn differences(levels: &[Level], tolerance: f64, replicates: Replicates) -> Vec<Difference> {
    let Some((last, before)) = levels.split_last() else { return Vec::new() };
    let finest = last.mean();
    let of = |level: &Level| {
        let value = level.mean() - finest;
        let (standard_error, freedom) = error_of_sum(&[level, last], &[1.0, -1.0], replicates);
        let half_width = if standard_error == 0.0 {
            0.0
        } else if standard_error.is_nan() {
            f64::INFINITY
        } else {
            quantile(LEVEL, freedom.max(1)) * standard_error
        };
        let verdict = Verdict::of(value, half_width, tolerance * finest.abs());
        Difference { value, standard_error, half_width, verdict }
    };
    before.iter().map(of).collect()
}

/// The first level from which on all differences are settled, and the verdict on the value as a whole: that of the last
/// difference where it has not settled anywhere.
pub fn settled(differences: &[Difference]) -> (Option<usize>, Verdict) {
    let is_settled = |one: &&Difference| one.verdict == Verdict::Settled;
    let count = differences.iter().rev().take_while(is_settled).count();
    let from = (count > 0).then(|| differences.len() - count);
    (from, differences.last().map_or(Verdict::NotShown, |last| last.verdict))
}

/// Order and limit from the three finest of these levels, which stand from coarse to fine.
pub fn observed_order(levels: &[Level], replicates: Replicates) -> Convergence {
    let Some((before, three)) = levels.split_last_chunk::<3>() else { return Convergence::TooFewLevels };
    let [third, second, first] = three;
    let found = of_three([third, second, first], replicates);
    let Convergence::Converging(order) = found else { return found };
    let Some(level) = before.last() else { return found };
    let is_asymptotic = match of_three([level, third, second], replicates) {
        Convergence::Converging(earlier) => {
            let error = known(order.order_standard_error).hypot(known(earlier.order_standard_error));
            Some((order.order - earlier.order).abs() <= 0.1 * order.order + NOISE * error)
        }
        Convergence::Oscillating | Convergence::Diverging => Some(false),
        Convergence::WithinNoise | Convergence::TooFewLevels => None,
    };
    Convergence::Converging(Order { is_asymptotic, ..order })
}

/// An error, or 0 where it is not known.
fn known(error: f64) -> f64 {
    if error.is_nan() { 0.0 } else { error }
}

fn of_three([third, second, first]: [&Level; 3], replicates: Replicates) -> Convergence {
    let [r21, r32] = [second.size / first.size, third.size / second.size].map(f64::ln);
    if !(r21 > 0.0 && r32 > 0.0 && r21.is_finite() && r32.is_finite()) {
        return Convergence::TooFewLevels;
    }
    let (e21, e32) = (second.mean() - first.mean(), third.mean() - second.mean());
    let noise = |a: &Level, b: &Level| {
        let (error, _) = error_of_sum(&[a, b], &[1.0, -1.0], replicates);
        (NOISE * known(error)).max(ROUND_OFF * a.mean().abs().max(b.mean().abs()))
    };
    if !(e21.abs() > noise(first, second) && e32.abs() > noise(second, third)) {
        return Convergence::WithinNoise;
    }
    let wanted = (e32 / e21).ln();
    if e32 / e21 < 0.0 {
        return Convergence::Oscillating;
    }
    // ln of the right-hand side of (CV1); it rises with p, from ln(r32/r21) at 0.
    let side = |p: f64| p * r21 + (p * r32).exp_m1().ln() - (p * r21).exp_m1().ln();
    let residual = |p: f64| side(p) - wanted;
    let (least, most) = (1e-6, MOST / r21.max(r32));
    if residual(least) >= 0.0 {
        return Convergence::Diverging;
    }
    if residual(most) <= 0.0 {
        return Convergence::WithinNoise;
    }
    let order = root_between(residual, [least, most], [residual(least), residual(most)], 1e-14).at;
    Convergence::Converging(extrapolated([first, second, third], [r21, r32], order, replicates))
}

/// The limit, and how errors of the means spread to it and to the order: first derivatives of (CV1) and (CV2).
fn extrapolated(
    levels @ [first, second, third]: [&Level; 3],
    [r21, r32]: [f64; 2],
    order: f64,
    replicates: Replicates,
) -> Order {
    let (e21, e32) = (second.mean() - first.mean(), third.mean() - second.mean());
    let growth = (order * r21).exp_m1();
    let slope = r21 + r32 / -(-order * r32).exp_m1() - r21 / -(-order * r21).exp_m1();
    // d ln(e32/e21) over the three means, and with it that of the order.
    let of_order = [1.0 / e21, -1.0 / e32 - 1.0 / e21, 1.0 / e32].map(|d| d / slope);
    let of_growth = e21 * r21 * (growth + 1.0) / (growth * growth);
    let direct = [1.0 + 1.0 / growth, -1.0 / growth, 0.0];
    let of_limit = [0, 1, 2].map(|k| direct[k] + of_growth * of_order[k]);
    let spread = |slopes: [f64; 3]| error_of_sum(&levels, &slopes, replicates).0;
    Order {
        order,
        order_standard_error: spread(of_order),
        limit: first.mean() - e21 / growth,
        limit_standard_error: spread(of_limit),
        uncertainty: SAFETY * e21.abs() / growth,
        is_asymptotic: None,
    }
}
