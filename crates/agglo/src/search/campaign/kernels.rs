//! The tables of rates by size over replicates: a line declares a column. Those of the parameters follow them.

use super::archive::Evaluation;
use super::records::{Value, parameters};
use super::tables::Table as Written;
use crate::folder::{CampaignFolder, names};
use crate::measure::{SizeTotals, end_of_class as end};
use crate::record::RecordError;
use crate::record::columns::{Table, Tables, count, count_or_none, number, number_or_none};
use crate::search::kernels::{BreakageMean, DaughterMean, KernelMean, Rates};
use crate::search::{Axis, Model, Problem};

/// How often grains collide, merge and break, by size.
#[rustfmt::skip]
pub static KERNELS: Table<KernelMean> = Table { file: names::KERNELS, columns: &[
    count("evaluation", "evaluation", "number of the candidate's", |row: &KernelMean| row.evaluation),
    count("replicates", "replicates", "random replicates that count", |row: &KernelMean| row.replicates),
    count("a_lower_primaries", "fewest primaries of the larger class", "", |row: &KernelMean| u64::from(row.a[0])),
    count_or_none("a_upper_primaries", "most primaries of the larger class", "none if it has no end", |row: &KernelMean| end(row.a[1])),
    count("b_lower_primaries", "fewest primaries of the smaller class", "", |row: &KernelMean| u64::from(row.b[0])),
    count_or_none("b_upper_primaries", "most primaries of the smaller class", "none if it has no end", |row: &KernelMean| end(row.b[1])),
    number("exposure_s_m3", "s/m3", "exposure", "pairs that could collide, integrated over time, over the volume, in all replicates", |row: &KernelMean| row.sums[0]),
    count("collisions", "collisions", "between the two, in all replicates", |row: &KernelMean| row.sums[1] as u64),
    count("merges", "merges", "", |row: &KernelMean| row.sums[2] as u64),
    count("breaking_collisions", "collisions that broke a grain", "", |row: &KernelMean| row.sums[3] as u64),
    number_or_none("collision_kernel_m3_s", "m3/s", "collision kernel", "collisions over the exposure", |row: &KernelMean| row.collision.value),
    number_or_none("collision_kernel_standard_error_m3_s", "m3/s", "its standard error", "over the replicates, as of all others", |row: &KernelMean| row.collision.error),
    number_or_none("aggregation_kernel_m3_s", "m3/s", "aggregation kernel", "merges over the exposure", |row: &KernelMean| row.aggregation.value),
    number_or_none("aggregation_kernel_standard_error_m3_s", "m3/s", "its standard error", "", |row: &KernelMean| row.aggregation.error),
    number_or_none("breaking_kernel_m3_s", "m3/s", "breaking kernel", "collisions that broke a grain over the exposure", |row: &KernelMean| row.breaking.value),
    number_or_none("breaking_kernel_standard_error_m3_s", "m3/s", "its standard error", "", |row: &KernelMean| row.breaking.error),
    number_or_none("sticking_probability", "", "sticking probability", "merges over collisions", |row: &KernelMean| row.sticking.value),
    number_or_none("sticking_probability_standard_error", "", "its standard error", "", |row: &KernelMean| row.sticking.error),
] };

/// How often grains break, by size.
#[rustfmt::skip]
pub static BREAKAGE: Table<BreakageMean> = Table { file: names::BREAKAGE, columns: &[
    count("evaluation", "evaluation", "number of the candidate's", |row: &BreakageMean| row.evaluation),
    count("replicates", "replicates", "random replicates that count", |row: &BreakageMean| row.replicates),
    count("lower_primaries", "fewest primaries", "of the class", |row: &BreakageMean| u64::from(row.class[0])),
    count_or_none("upper_primaries", "most primaries", "of the class; none if it has no end", |row: &BreakageMean| end(row.class[1])),
    number("grain_time_s", "s", "grain time", "the number of grains, integrated over time, in all replicates", |row: &BreakageMean| row.sums[0]),
    number_or_none("mean_primaries", "", "mean primaries", "of a grain of the class, over time", |row: &BreakageMean| row.primaries.value),
    count("breakages", "breakages", "grains of the class that broke, in all replicates", |row: &BreakageMean| row.sums[2] as u64),
    number_or_none("breakage_rate_1_s", "1/s", "breakage rate", "breakages over the grain time", |row: &BreakageMean| row.rate.value),
    number_or_none("breakage_rate_standard_error_1_s", "1/s", "its standard error", "over the replicates", |row: &BreakageMean| row.rate.error),
] };

/// What they broke into.
#[rustfmt::skip]
pub static DAUGHTERS: Table<DaughterMean> = Table { file: names::DAUGHTERS, columns: &[
    count("evaluation", "evaluation", "number of the candidate's", |row: &DaughterMean| row.evaluation),
    count("replicates", "replicates", "random replicates that count", |row: &DaughterMean| row.replicates),
    count("parent_lower_primaries", "fewest primaries of the parents", "", |row: &DaughterMean| u64::from(row.parent[0])),
    count_or_none("parent_upper_primaries", "most primaries of the parents", "none if it has no end", |row: &DaughterMean| end(row.parent[1])),
    count("daughter_lower_primaries", "fewest primaries of the daughters", "", |row: &DaughterMean| u64::from(row.daughter[0])),
    count_or_none("daughter_upper_primaries", "most primaries of the daughters", "none if it has no end", |row: &DaughterMean| end(row.daughter[1])),
    count("breakages", "breakages", "of parents of the class, whatever into, in all replicates", |row: &DaughterMean| row.sums[0] as u64),
    count("fragments", "fragments", "of the daughters' class", |row: &DaughterMean| row.sums[1] as u64),
    count("primaries", "primaries", "in these fragments", |row: &DaughterMean| row.sums[2] as u64),
    number_or_none("fragments_per_breakage", "", "fragments per breakage", "", |row: &DaughterMean| row.fragments.value),
    number_or_none("fragments_per_breakage_standard_error", "", "its standard error", "over the replicates", |row: &DaughterMean| row.fragments.error),
    number_or_none("mass_fraction", "", "part of the mass", "of the parents that broke", |row: &DaughterMean| row.mass_fraction.value),
    number_or_none("mass_fraction_standard_error", "", "its standard error", "", |row: &DaughterMean| row.mass_fraction.error),
] };

/// All of them.
pub const RATES: Tables = &[&KERNELS, &BREAKAGE, &DAUGHTERS];

/// Writes the tables of all evaluations that were run, if the campaign wants rates by size.
///
/// # Errors
/// [`RecordError::File`].
pub fn write(folder: &CampaignFolder, problem: &Problem, all: &[Evaluation]) -> Result<(), RecordError> {
    let Some(classes) = problem.classes() else { return Ok(()) };
    let axes = problem.axes();
    let names: Vec<String> = axes.iter().map(Axis::column).collect();
    let mut kernels = Written::begin(folder.root(), &KERNELS, &names)?;
    let mut breakage = Written::begin(folder.root(), &BREAKAGE, &names)?;
    let mut daughters = Written::begin(folder.root(), &DAUGHTERS, &names)?;
    let (shown, count) = (problem.shown().len(), classes.count().unwrap_or(0));
    for evaluation in all.iter().filter(|evaluation| evaluation.has_quantities()) {
        let totals = |row: &Vec<f64>| SizeTotals::from_slice(count, row.get(shown..)?);
        let replicates = evaluation.quantities.iter().filter_map(totals).collect();
        let rates = Rates { evaluation: evaluation.number, classes, replicates };
        let values = parameters(axes, &evaluation.candidate.values);
        let more = || values.iter().map(Value::cell);
        rates.kernels().iter().try_for_each(|row| kernels.put(KERNELS.columns, row, more()))?;
        rates.breakage().iter().try_for_each(|row| breakage.put(BREAKAGE.columns, row, more()))?;
        rates.daughters().iter().try_for_each(|row| daughters.put(DAUGHTERS.columns, row, more()))?;
    }
    [kernels, breakage, daughters].iter_mut().try_for_each(Written::flush)
}
