//! Searches for the conditions that do something best, and studies of how an outcome depends on them.
//!
//! Optimizers propose points of a unit cube and are told how good they are; the space turns points into scenarios; an
//! ensemble of random replicates tells how good a scenario is.

pub mod analysis;
mod axes;
mod base;
pub mod campaign;
mod columns;
mod ensemble;
mod file;
mod fitness;
mod forecast;
mod formula;
mod formulas;
pub mod functions;
pub mod kernels;
mod model;
pub mod optimizer;
mod plan;
mod pool;
mod problem;
mod runner;
mod setter;
mod space;
mod student;
#[cfg(test)]
mod test_models;

pub use ensemble::{Confidence, Ensemble, Fixed, RunningMean, Until};
pub use file::{
    Base, Bounds, Budget, Campaign, Confirm, Constraint, Derived, Limit, Objective, Parameter, Range, Scalar,
    campaign_schema,
};
pub use fitness::Fitness;
pub use forecast::CampaignForecast;
pub use model::{Candidate, Model, Trouble};
pub use plan::{Grid, List, Morris, Plan, Refinement, SobolIndices};
pub use problem::{Prepared, Problem};
pub use runner::{Here, Replicate, Runner, quantities};
pub use space::{Axis, Choice, Scale};
