//! How many random replicates tell how good a candidate is.
//!
//! # Equation
//! ```text
//! |m(E+1) - m(E)| <= TOL |m(E+1)|                                            [B] 8.1, `running_mean`
//! t(level, E - 1) s(E) / √E <= h                                             SA5, `confidence`
//! ```
//! m(E) and s(E) are the mean and the standard deviation of the costs of the first E replicates. The rules are asked after
//! each replicate in the order of the replicates, and the first yes ends the candidate.
//!
//! # Source
//! T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 8; for `confidence`: A. M. Law, *Simulation Modeling and
//! Analysis*, 5th ed. (2015), section 9.4.1.
//!
//! # Symbols
//! | symbol | name in code | unit         | meaning                                            |
//! |--------|--------------|--------------|----------------------------------------------------|
//! | E      | `replicates`     | 1            | replicates so far                                      |
//! | m      | `mean`       | of the cost  | mean cost                                          |
//! | TOL    | `tolerance`  | 1            | part of the mean                                   |
//! | t      | `quantile`   | 1            | Student's t of both tails together                 |
//! | h      | `half_width` | of the cost  | half width of the confidence interval of the mean  |
//!
//! # Valid when
//! `running_mean` compares one replicate with the mean, and says yes too early when that replicate happens to lie near the mean:
//! the error of the mean that it leaves is not tied to its tolerance. With costs that scatter by s it stops after about
//! s/(TOL |m|) replicates or earlier. `confidence` bounds the error, for costs that are about normally distributed; its level
//! is that of one look, and since it looks after each replicate it is right somewhat less often. With several costs all
//! must be enough.
//!
//! # Compared with others
//! [B] does not say with how many replicates it begins; `least` = 2 is the least that the rule can be asked with.
//!
//! # In a campaign
//! ```toml
//! [ensemble]
//! common_random_numbers = true
//! until.confidence = { half_width = 0.01, level = 0.95, most = 50 }
//! ```
//!
//! # Example
//! ```
//! use agglo::search::{Ensemble, RunningMean, Until};
//! let published = Ensemble { until: Until::RunningMean(RunningMean::default()), common_random_numbers: false };
//! // Means 0.7, 0.705: they differ by 0.7 %. Then 0.7051: by 0.02 %.
//! assert!(!published.is_enough(&[0.7, 0.71]));
//! assert!(published.is_enough(&[0.7, 0.71, 0.7054]));
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::analysis::Moments;
use super::student::within;
use crate::math::rng::{Purpose, Stream};

/// How many random replicates a candidate gets, and which.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Ensemble {
    /// When there are enough.
    pub until: Until,
    /// Whether all candidates get the same replicates, so that luck does not decide between them.
    pub common_random_numbers: bool,
}

impl Default for Ensemble {
    fn default() -> Self {
        Self { until: Until::Fixed(Fixed { replicates: 1 }), common_random_numbers: true }
    }
}

/// When there are enough replicates.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Until {
    /// After a number of replicates.
    Fixed(Fixed),
    /// When the mean cost settles ([B] 8.1).
    RunningMean(RunningMean),
    /// When the confidence interval of the mean cost is narrow.
    Confidence(Confidence),
}

/// A number of replicates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fixed {
    /// How many.
    pub replicates: u32,
}

/// Until one more replicate moves the mean by less than a part of itself ([B] 8.1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RunningMean {
    /// The part.
    pub tolerance: f64,
    /// Replicates at the least.
    pub least: u32,
    /// Replicates at the most.
    pub most: u32,
}

impl Default for RunningMean {
    fn default() -> Self {
        Self { tolerance: 5e-4, least: 2, most: 100 }
    }
}

/// Until the half width of the mean's confidence interval is small.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Confidence {
    /// Half width in units of the cost.
    pub half_width: f64,
    /// Confidence level.
    #[serde(default = "usual_level")]
    pub level: f64,
    /// Replicates at the least.
    #[serde(default = "least")]
    pub least: u32,
    /// Replicates at the most.
    #[serde(default = "most")]
    pub most: u32,
}

fn usual_level() -> f64 {
    0.95
}
fn least() -> u32 {
    3
}
fn most() -> u32 {
    100
}

impl Ensemble {
    /// The same number of replicates for all.
    pub fn fixed(replicates: u32) -> Self {
        Self { until: Until::Fixed(Fixed { replicates }), ..Self::default() }
    }

    /// Replicates that every candidate gets.
    pub fn least(&self) -> u32 {
        match self.until {
            Until::Fixed(Fixed { replicates }) => replicates.max(1),
            Until::RunningMean(RunningMean { least, .. }) | Until::Confidence(Confidence { least, .. }) => {
                least.max(2).min(self.most())
            }
        }
    }

    /// Replicates that no candidate gets more of.
    pub fn most(&self) -> u32 {
        match self.until {
            Until::Fixed(Fixed { replicates: most })
            | Until::RunningMean(RunningMean { most, .. })
            | Until::Confidence(Confidence { most, .. }) => most.max(1),
        }
    }

    /// Whether the costs so far, one a replicate in the order of the replicates, are enough.
    pub fn is_enough(&self, costs: &[f64]) -> bool {
        let replicates = costs.len() as u32;
        if replicates >= self.most() {
            return true;
        }
        replicates >= self.least()
            && match self.until {
                Until::Fixed(_) => true,
                Until::RunningMean(RunningMean { tolerance, .. }) => has_settled(costs, tolerance),
                Until::Confidence(Confidence { half_width, level, .. }) => {
                    let error = Moments::of(costs).standard_error();
                    error == 0.0 || within(half_width / error, u64::from(replicates) - 1) >= level
                }
            }
    }

    /// The seed of replicate number `replicate` of evaluation number `evaluation` under the campaign's `seed`.
    ///
    /// It is below 2⁵³, so that every reader of numbers keeps it.
    pub fn seed(&self, seed: u64, evaluation: u64, replicate: u32) -> u64 {
        if self.common_random_numbers {
            draw(seed, COMMON, u64::from(replicate))
        } else {
            draw(seed, FIRST_OWN.saturating_add(replicate), evaluation)
        }
    }

    /// As [`Ensemble::seed`], of replicates that no search has seen.
    pub fn fresh_seed(&self, seed: u64, evaluation: u64, replicate: u32) -> u64 {
        let own = if self.common_random_numbers { 0 } else { (evaluation + 1) << 32 };
        draw(seed, FRESH, own + u64::from(replicate))
    }
}

/// Part of the seeds that all candidates share.
const COMMON: u32 = 0;
/// Part of the seeds of replicates that no search has seen.
const FRESH: u32 = 1;
/// Part of the seeds of each candidate's own first replicate; its second replicate is the part after that.
const FIRST_OWN: u32 = 2;

fn draw(seed: u64, part: u32, index: u64) -> u64 {
    let mut stream = Stream::new(seed, Purpose::Start, part);
    stream.jump_to(index);
    (stream.uniform() * (1_u64 << f64::MANTISSA_DIGITS) as f64) as u64
}

/// [B] 8.1 for the last of the costs.
fn has_settled(costs: &[f64], tolerance: f64) -> bool {
    let replicates = costs.len() as f64;
    let sum: f64 = costs.iter().sum();
    let before = sum - costs.last().copied().unwrap_or(0.0);
    let (mean, before) = (sum / replicates, before / (replicates - 1.0));
    (mean - before).abs() <= tolerance * mean.abs()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn running_mean(tolerance: f64, most: u32) -> Ensemble {
        let until = Until::RunningMean(RunningMean { tolerance, least: 2, most });
        Ensemble { until, common_random_numbers: true }
    }

    fn confidence(half_width: f64) -> Ensemble {
        let until = Until::Confidence(Confidence { half_width, level: 0.95, least: 3, most: 50 });
        Ensemble { until, common_random_numbers: true }
    }

    /// Means 1, 1.05: |Δ| = 0.05 of 1.05, 4.76 %. Means 1.05, 1.04: 0.962 % of the latter.
    #[test]
    fn running_mean_by_hand() {
        let costs = [1.0, 1.1, 1.02];
        assert_false!(running_mean(0.0476, 9).is_enough(&costs[..2]), "so many costs settle the comparison");
        assert_true!(running_mean(0.0477, 9).is_enough(&costs[..2]), "so many costs settle the comparison");
        assert_false!(running_mean(0.0096, 9).is_enough(&costs), "so many costs settle the comparison");
        assert_true!(running_mean(0.0097, 9).is_enough(&costs), "so many costs settle the comparison");
        assert!(!running_mean(1.0, 9).is_enough(&costs[..1]), "one replicate has no mean before it");
        assert!(running_mean(1e-9, 3).is_enough(&costs), "three are the most");
        // A cost that is always the same is enough at once, whatever its sign; about 0 only the same cost is.
        assert_true!(running_mean(0.0, 9).is_enough(&[-2.0, -2.0]), "so many costs settle the comparison");
        assert_true!(running_mean(5e-4, 9).is_enough(&[0.0, 0.0]), "so many costs settle the comparison");
        assert_false!(running_mean(0.5, 9).is_enough(&[1.0, -1.0]), "so many costs settle the comparison");
    }

    /// 1, 2, 3: s = 1, standard error 1/√3, t(95 %, 2) = 4.30265: half width 2.48414.
    #[test]
    fn confidence_by_hand() {
        let costs = [1.0, 2.0, 3.0];
        assert_false!(confidence(2.484).is_enough(&costs), "so many costs settle the comparison");
        assert_true!(confidence(2.4842).is_enough(&costs), "so many costs settle the comparison");
        assert!(!confidence(9.0).is_enough(&costs[..2]), "three are the least");
        assert!(confidence(0.0).is_enough(&[0.5; 3]), "no scatter, no error");
        assert!(confidence(0.0).is_enough(&[1.0, 2.0].repeat(25)), "fifty are the most");
    }

    #[test]
    fn fixed_numbers() {
        assert_false!(Ensemble::fixed(2).is_enough(&[1.0]), "so many costs settle the comparison");
        assert_true!(Ensemble::fixed(2).is_enough(&[1.0, 9.0]), "so many costs settle the comparison");
        assert_eq!((Ensemble::default().least(), Ensemble::default().most()), (1, 1));
        assert_eq!((running_mean(0.1, 1).least(), running_mean(0.1, 1).most()), (1, 1));
    }

    #[test]
    fn common_seeds_depend_on_the_replicate_alone_and_own_ones_on_both() {
        let all = |ensemble: &Ensemble| -> BTreeSet<u64> {
            (0..30_u64)
                .flat_map(|e| (0..30).map(move |s| (e, s)))
                .map(|(e, s)| ensemble.seed(7, e, s))
                .collect()
        };
        let (common, own) =
            (Ensemble::fixed(1), Ensemble { common_random_numbers: false, ..Ensemble::fixed(1) });
        assert_eq!((all(&common).len(), all(&own).len()), (30, 900));
        assert_true!(all(&common).is_disjoint(&all(&own)), "seeds that must not come twice");
        assert_ne!(common.seed(7, 0, 0), common.seed(8, 0, 0));
        for ensemble in [&common, &own] {
            let fresh: BTreeSet<u64> =
                (0..900).map(|k| ensemble.fresh_seed(7, k / 30, k as u32 % 30)).collect();
            assert_eq!(fresh.len(), if ensemble.common_random_numbers { 30 } else { 900 });
            assert_true!(fresh.is_disjoint(&all(ensemble)), "seeds that must not come twice");
            assert_all!(fresh.iter(), |seed| *seed < 1 << 53);
        }
    }
}
