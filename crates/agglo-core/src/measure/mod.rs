//! Quantities taken from a state: moments, clusters, sizes. Nothing here changes a state.

mod biot;
mod clusters;
mod moments;
mod nearest;
mod pairs;
mod rigid_motion;
mod shape;
mod size_classes;
mod size_rates;
mod size_totals;
mod whole;

pub use biot::{biot_number, is_uniform};
pub use clusters::{Clusters, Joiner};
pub use moments::{Moments, moment_about, moments};
pub use nearest::mean_nearest_distance;
pub use pairs::close_pairs;
pub use rigid_motion::RigidMotion;
pub use shape::{ClusterSummary, center_of_mass, fractal_dimension, radius_of_gyration, summarize};
pub use size_classes::{SizeClass, SizeClasses, end_of_class};
pub use size_rates::{BreakageRow, DaughterRow, KernelRow, SizeRates};
pub use size_totals::SizeTotals;
pub use whole::whole;
