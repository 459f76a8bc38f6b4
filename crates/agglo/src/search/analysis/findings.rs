//! What a study says, in sentences: where values have settled, and what there is nothing to say of.

use super::evaluations::Target;
use super::refinement::{Difference, LEVEL, Replicates, Verdict, differences, settled};
use super::{Evaluations, elementary_effects, variance_shares, varies};
use crate::search::plan::Plan;
use crate::text::readable;

/// Names of parameters that a sentence lists at the most.
const NAMED: usize = 6;

/// What the evaluations of a plan say, one sentence for each thing worth knowing; `seed` is the one that the plan was
/// started with.
pub fn findings(plan: &Plan, evaluations: &Evaluations, seed: u64) -> Vec<String> {
    let of = |target: Target<'_>| match plan {
        Plan::Refinement(refinement) => Some(settling(evaluations, &target, refinement.tolerance)),
        Plan::Morris(_) => sentence(unvaried(evaluations, &target), || effects(evaluations, &target)),
        Plan::SobolIndices(indices) => sentence(unvaried(evaluations, &target), || {
            let outcomes = evaluations.target(&target);
            let found = variance_shares(evaluations.parameters.len(), &outcomes, 0, indices.level, seed);
            shares(&target, found.blocks, found.noise_share)
        }),
        Plan::Grid(_) | Plan::List(_) => unvaried(evaluations, &target),
    };
    evaluations.targets().into_iter().filter_map(of).collect()
}

fn sentence(first: Option<String>, second: impl FnOnce() -> Option<String>) -> Option<String> {
    first.or_else(second)
}

/// Of an outcome that is the same for all candidates.
fn unvaried(evaluations: &Evaluations, target: &Target<'_>) -> Option<String> {
    let name = target.axis.title();
    let known: Vec<f64> = evaluations.target(target).into_iter().flatten().map(|pair| pair[0]).collect();
    match known.as_slice() {
        [] => Some(format!("{name} is not known for any candidate, so there is nothing to say of it")),
        [_] => None,
        [first, ..] if !varies(known.iter().copied()) => Some(format!(
            "{name} does not vary: it is {} for all {} candidates that have it, so no parameter has an effect or a share",
            readable(*first, ""),
            known.len()
        )),
        _ => None,
    }
}

/// Of parameters without an effect that is known.
fn effects(evaluations: &Evaluations, target: &Target<'_>) -> Option<String> {
    let points: Vec<Vec<f64>> = evaluations.rows.iter().map(|row| row.point.clone()).collect();
    let effects = elementary_effects(&points, &evaluations.target(target));
    let unknown = evaluations.parameters.iter().zip(&effects).filter(|(_, effect)| effect.count == 0);
    let names: Vec<&str> = unknown.map(|(axis, _)| axis.name.as_str()).collect();
    if names.is_empty() {
        return None;
    }
    let more = if names.len() > NAMED { " and others" } else { "" };
    let shown = names[..names.len().min(NAMED)].join(", ");
    Some(format!(
        "no effect of {shown}{more} on {} is known: one candidate of each of their steps failed",
        target.axis.title()
    ))
}

/// Of blocks that are too few, and of variance that may be noise.
fn shares(target: &Target<'_>, blocks: usize, noise_share: f64) -> Option<String> {
    let name = target.axis.title();
    if blocks < 2 {
        let count = if blocks == 1 { "a single block" } else { "no block" };
        return Some(format!(
            "there are no shares in the variance of {name}: {count} of candidates ran without a failure"
        ));
    }
    (noise_share >= 0.5).then(|| {
        format!(
            "{:.0} % of the variance of {name} may be scatter of the replicates, so its shares say little; more replicates would \
             tell",
            100.0 * noise_share.min(1.0)
        )
    })
}

/// Where a value has settled under refinement.
fn settling(evaluations: &Evaluations, target: &Target<'_>, tolerance: f64) -> String {
    let (levels, fineness) = evaluations.levels(target);
    let found = differences(&levels, tolerance, evaluations.replicates);
    let (from, verdict) = settled(&found);
    let axis = &evaluations.parameters[0];
    let at = |level: usize| format!("{} = {}", axis.name, axis.cell(fineness[level]));
    let name = target.axis.title();
    let (percent, confidence) = (readable(100.0 * tolerance, ""), 100.0 * LEVEL);
    let (Some(last), Some(finest)) = (found.last(), levels.last()) else {
        return format!("{name}: fewer than two levels are known, so nothing can be said of settling");
    };
    let difference = || of_the_last(last, finest.moments().mean);
    match (from, verdict) {
        (Some(level), _) => format!(
            "{name} is settled from {} on: within {percent} % of the finest level, with {confidence:.0} % confidence",
            at(level)
        ),
        (None, Verdict::NotSettled) => format!(
            "{name} has not settled: from {} to the finest level it differs by {}, more than {percent} %",
            at(found.len() - 1),
            difference()
        ),
        (None, _) if last.half_width.is_infinite() => format!(
            "{name} is not shown to have settled: one replicate of a level does not tell how much it scatters; give each 2 or \
             more"
        ),
        (None, _) => format!(
            "{name} is not shown to have settled: {} is {} off the finest level, which at {confidence:.0} % confidence may be \
             more than {percent} %; {} would tell",
            at(found.len() - 1),
            difference(),
            if evaluations.replicates == Replicates::Shared {
                "more replicates"
            } else {
                "more replicates, or replicates that levels share,"
            }
        ),
    }
}

/// "-1.3 +- 0.63 %" of the finest value, or the difference itself where that is 0.
fn of_the_last(difference: &Difference, finest: f64) -> String {
    let Difference { value, standard_error, .. } = difference;
    if finest == 0.0 {
        return format!("{} +- {}", readable(*value, ""), readable(*standard_error, ""));
    }
    let part = |quantity: f64| readable(100.0 * quantity / finest.abs(), "");
    format!("{} +- {} %", part(*value), part(*standard_error))
}
