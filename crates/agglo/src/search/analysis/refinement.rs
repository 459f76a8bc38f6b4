//! Whether a value converges under refinement, at which order, and where it has settled.
//!
//! # Equation
//! ```text
//! (f_3 - f_2)/(f_2 - f_1) = r_21^p (r_32^p - 1)/(r_21^p - 1),   r_21 = h_2/h_1, r_32 = h_3/h_2      (CV1)
//! f_0 = f_1 + (f_1 - f_2)/(r_21^p - 1)                                                          (CV2)
//! GCI = 1.25 |f_1 - f_2|/(r_21^p - 1)                                                           (CV3)
//! ```
//! Levels are numbered from the finest: 1 is the finest, 3 the coarsest.
//!
//! # Source
//! P. J. Roache, *Perspective: a method for uniform reporting of grid refinement studies*, J. Fluids Eng. 116, 405 (1994);
//! I. B. Celik et al., *Procedure for estimation and reporting of uncertainty due to discretization in CFD
//! applications*, J. Fluids Eng. 130, 078001 (2008), for ratios that vary.
//!
//! # Symbols
//! | symbol | name in code | unit      | meaning                                                           |
//! |--------|--------------|-----------|-------------------------------------------------------------------|
//! | h      | `size`       |           | step size, or 1 over the number of rays or grains                 |
//! | f      | `mean`       | the value's | mean of the value at a level                                    |
//! | p      | `order`      |           | observed order: the error falls like h^p                          |
//! | f_0    | `limit`      | the value's | Richardson's extrapolation to h = 0                             |
//! | GCI    | `uncertainty`| the value's | Roache's grid convergence index, not divided by f_1             |
//!
//! # Valid when
//! The three finest levels are in the asymptotic range: the order of the three levels before is the same
//! (`is_asymptotic`). Differences within two standard errors are noise and give no order.
//!
//! # Compared with others
//! Standard errors of the levels are taken as independent; with common random numbers the order is better known than
//! its standard error says.
//!
//! # Example
//! ```
//! use agglo::search::analysis::{Convergence, Level, observed_order};
//! // f = 1 + h² at h = 0.4, 0.2, 0.1.
//! let levels = [0.4_f64, 0.2, 0.1].map(|size| Level { size, mean: 1.0 + size * size, standard_error: 0.0 });
//! let Convergence::Converging(found) = observed_order(&levels) else { panic!("it converges") };
//! assert!((found.order - 2.0).abs() < 1e-12 && (found.limit - 1.0).abs() < 1e-12);
//! ```

use crate::math::roots::root_between;

/// A level of refinement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Size that goes to zero: a step, or 1 over a number of rays or grains.
    pub size: f64,
    /// Mean of the value.
    pub mean: f64,
    /// Its standard error; 0 where there is no noise or it is not known.
    pub standard_error: f64,
}

/// What the finest levels say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Convergence {
    /// Fewer than three levels, or sizes that do not fall.
    TooFewLevels,
    /// Differences are not larger than two standard errors, or none is left: nothing can be said about the order.
    WithinNoise,
    /// The differences change their sign: not in the asymptotic range.
    Oscillating,
    /// The differences do not fall: not in the asymptotic range.
    Diverging,
    /// The differences fall.
    Converging(Order),
}

/// How a value converges.
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

/// Largest order times logarithm of the ratio: beyond it the last difference is as good as zero.
const MOST: f64 = 50.0;
/// Differences are noise up to so many standard errors.
const NOISE: f64 = 2.0;
/// Roache's factor of safety for orders that are observed on three levels.
const SAFETY: f64 = 1.25;

/// Order and limit from the three finest of these levels, which stand from coarse to fine.
pub fn observed_order(levels: &[Level]) -> Convergence {
    let Some((before, three)) = levels.split_last_chunk::<3>() else { return Convergence::TooFewLevels };
    let found = of_three(three);
    let Convergence::Converging(order) = found else { return found };
    let Some(&level) = before.last() else { return found };
    let is_asymptotic = match of_three(&[level, three[0], three[1]]) {
        Convergence::Converging(earlier) => {
            let error = order.order_standard_error.hypot(earlier.order_standard_error);
            Some((order.order - earlier.order).abs() <= 0.1 * order.order + NOISE * error)
        }
        Convergence::Oscillating | Convergence::Diverging => Some(false),
        Convergence::WithinNoise | Convergence::TooFewLevels => None,
    };
    Convergence::Converging(Order { is_asymptotic, ..order })
}

fn of_three(&[third, second, first]: &[Level; 3]) -> Convergence {
    let [r21, r32] = [second.size / first.size, third.size / second.size].map(f64::ln);
    if !(r21 > 0.0 && r32 > 0.0 && r21.is_finite() && r32.is_finite()) {
        return Convergence::TooFewLevels;
    }
    let (e21, e32) = (second.mean - first.mean, third.mean - second.mean);
    let noise = |a: Level, b: Level| NOISE * a.standard_error.hypot(b.standard_error);
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
    Convergence::Converging(extrapolated([first, second, third], [r21, r32], order))
}

/// The limit, and how errors of the means spread to it and to the order: first derivatives of (CV1) and (CV2).
fn extrapolated([first, second, third]: [Level; 3], [r21, r32]: [f64; 2], order: f64) -> Order {
    let (e21, e32) = (second.mean - first.mean, third.mean - second.mean);
    let growth = (order * r21).exp_m1();
    let slope = r21 + r32 / -(-order * r32).exp_m1() - r21 / -(-order * r21).exp_m1();
    // d ln(e32/e21) over the three means, and with it that of the order.
    let of_order = [1.0 / e21, -1.0 / e32 - 1.0 / e21, 1.0 / e32].map(|d| d / slope);
    let of_growth = e21 * r21 * (growth + 1.0) / (growth * growth);
    let direct = [1.0 + 1.0 / growth, -1.0 / growth, 0.0];
    let of_limit = [0, 1, 2].map(|k| direct[k] + of_growth * of_order[k]);
    let errors = [first, second, third].map(|level| level.standard_error);
    let spread = |slopes: [f64; 3]| (0..3).map(|k| (slopes[k] * errors[k]).powi(2)).sum::<f64>().sqrt();
    Order {
        order,
        order_standard_error: spread(of_order),
        limit: first.mean - e21 / growth,
        limit_standard_error: spread(of_limit),
        uncertainty: SAFETY * e21.abs() / growth,
        is_asymptotic: None,
    }
}

/// The first level from which on all means stay within `tolerance` times the last mean, or within two standard errors of
/// the difference, of the last mean. None if only the last one does.
/// ```
/// use agglo::search::analysis::{Level, settled};
/// let levels = [1.2, 1.02, 0.995, 1.0].map(|mean| Level { size: 1.0, mean, standard_error: 0.0 });
/// assert_eq!(settled(&levels, 0.01), Some(2));
/// assert_eq!(settled(&levels, 0.001), None);
/// ```
pub fn settled(levels: &[Level], tolerance: f64) -> Option<usize> {
    let (last, before) = levels.split_last()?;
    let is_near = |level: &&Level| {
        let noise = NOISE * level.standard_error.hypot(last.standard_error);
        (level.mean - last.mean).abs() <= noise.max(tolerance * last.mean.abs())
    };
    let near = before.iter().rev().take_while(is_near).count();
    (near > 0).then(|| before.len() - near)
}
