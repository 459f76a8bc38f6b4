//! How much each parameter matters, from steps of one parameter at a time.
//!
//! # Equation
//! ```text
//! μ_i = mean(EE_i),   μ*_i = mean(|EE_i|),   σ_i = standard deviation of EE_i           (SA3)
//! ```
//! The effects EE are those of (SA1).
//!
//! # Source
//! μ and σ: M. D. Morris, Technometrics 33, 161 (1991); μ*: F. Campolongo, J. Cariboni and A. Saltelli, *An effective
//! screening design for sensitivity analysis of large models*, Environ. Model. Softw. 22, 1509 (2007).
//!
//! # Symbols
//! | symbol | name in code         | unit         | meaning                                        |
//! |--------|----------------------|--------------|------------------------------------------------|
//! | EE     |                      | the outcome's| change of the outcome, per whole range         |
//! | μ      | `mean`               | the outcome's| whether it rises or falls with the parameter   |
//! | μ*     | `mean_size`          | the outcome's| how much the parameter matters                 |
//! | σ      | `standard_deviation` | the outcome's| whether it acts by itself: 0 if it does        |
//!
//! # Valid when
//! Effects below `noise` cannot be told from the noise of the random replicates, which makes μ* and σ larger, μ not. Of an
//! outcome that does not vary beyond round-off, and of a parameter whose candidates all failed, there are no effects: all
//! quantities are then not numbers.
//!
//! # Compared with others
//! The measures of `SALib.analyze.morris`; the same definition, for the same points.
//!
//! # Example
//! ```
//! use agglo::search::analysis::elementary_effects;
//! let points = [vec![0.0, 0.0], vec![0.5, 0.0], vec![0.5, 0.5]];
//! let outcomes = [1.0, 2.0, 5.0].map(|mean| Some([mean, 0.0]));
//! let effects = elementary_effects(&points, &outcomes);
//! // Steps of a half change the outcome by 1 and by 3.
//! assert_eq!((effects[0].mean, effects[1].mean), (2.0, 6.0));
//! ```

use super::{Moments, varies};

/// How much one parameter matters; in units of the outcome, for a step over its whole range. What is not known is not a
/// number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElementaryEffects {
    /// Mean effect.
    pub mean: f64,
    /// Mean of the effects' sizes.
    pub mean_size: f64,
    /// Standard error of that.
    pub standard_error: f64,
    /// Standard deviation of the effects.
    pub standard_deviation: f64,
    /// Root mean square of the effects' own standard errors; not a number where candidates had a single replicate.
    pub noise: f64,
    /// How many effects there are: fewer than trajectories if candidates failed.
    pub count: usize,
}

/// The effects of each parameter, from the points of the plan (`[n]`, in its order) and the outcome's mean and standard error
/// at each (`[n]`, none for those that failed; an error that is not known is not a number).
pub fn elementary_effects(points: &[Vec<f64>], outcomes: &[Option<[f64; 2]>]) -> Vec<ElementaryEffects> {
    let dimensions = points.first().map_or(0, Vec::len);
    let does_vary = varies(outcomes.iter().flatten().map(|outcome| outcome[0]));
    let mut effects: Vec<Vec<[f64; 2]>> = vec![Vec::new(); dimensions];
    for (points, outcomes) in points.chunks(dimensions + 1).zip(outcomes.chunks(dimensions + 1)) {
        for (pair, ends) in points.windows(2).zip(outcomes.windows(2)) {
            let moved = (0..dimensions).find(|&axis| pair[0][axis] != pair[1][axis]);
            if let (Some(axis), [Some(before), Some(after)]) = (moved, ends) {
                let step = pair[1][axis] - pair[0][axis];
                effects[axis].push([(after[0] - before[0]) / step, before[1].hypot(after[1]) / step]);
            }
        }
    }
    let shown = |effects: &Vec<[f64; 2]>| if does_vary { summary(effects) } else { none(effects.len()) };
    effects.iter().map(shown).collect()
}

fn none(count: usize) -> ElementaryEffects {
    ElementaryEffects { count, ..summary(&[]) }
}

fn summary(effects: &[[f64; 2]]) -> ElementaryEffects {
    let signed = Moments::of(&effects.iter().map(|effect| effect[0]).collect::<Vec<_>>());
    let sizes = Moments::of(&effects.iter().map(|effect| effect[0].abs()).collect::<Vec<_>>());
    let squares: f64 = effects.iter().map(|effect| effect[1] * effect[1]).sum();
    ElementaryEffects {
        mean: signed.mean,
        mean_size: sizes.mean,
        standard_error: sizes.standard_error(),
        standard_deviation: signed.standard_deviation,
        noise: (squares / effects.len() as f64).sqrt(),
        count: effects.len(),
    }
}
