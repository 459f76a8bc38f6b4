//! What the evaluations of a search or study say: statistics, convergence, sensitivity.

mod axes;
mod axis;
mod evaluations;
mod findings;
mod moments;
mod morris;
mod refinement;
#[cfg(test)]
mod refinement_tests;
mod sobol_indices;
mod tables;
#[cfg(test)]
mod tests;

pub use axes::{parameter_axis, parameter_value};
pub use axis::Axis;
pub use evaluations::{EvaluationRow, Evaluations, Generation, Objective, Status, Target};
pub use findings::findings;
pub use moments::{Moments, varies};
pub use morris::{ElementaryEffects, elementary_effects};
pub use refinement::{
    Convergence, Difference, Level, Order, Replicates, Verdict, differences, observed_order, settled,
};
pub use sobol_indices::{Share, VarianceShares, variance_shares};
pub use tables::{measures_table, study_tables};
