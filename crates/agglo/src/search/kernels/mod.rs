//! Rates by size over all replicates of a candidate: what a population balance is fed with.

mod ratio;
mod rows;

use crate::measure::SizeClasses;
use crate::scenario::{Fault, Scenario};

use super::file::Campaign;

pub use ratio::{Ratio, ratio};
pub use rows::{BreakageMean, DaughterMean, KernelMean, Rates};

/// The key of a campaign that asks for them.
const KEY: &str = "kernels";
/// The key of the scenario that says by which classes.
const CLASSES: &str = "output.size_classes";

/// The classes by which a campaign wants rates; none where it wants none, or there is a [`fault`].
pub(super) fn classes(campaign: &Campaign, base: &Scenario) -> Option<SizeClasses> {
    let lower = base.output.size_classes.as_ref().filter(|_| campaign.kernels)?;
    Some(SizeClasses::from_bounds(lower))
}

/// Why a campaign that wants rates by size cannot have them.
pub(super) fn fault(campaign: &Campaign, base: &Scenario) -> Option<Fault> {
    let keys = campaign.parameters.iter().filter_map(|parameter| parameter.key.as_deref());
    let mut keys = keys.chain(campaign.derived.iter().map(|derived| derived.key.as_str()));
    let (message, help) = if !campaign.kernels {
        return None;
    } else if campaign.plan.is_none() {
        ("kernels are for studies, and this is a search", "leave it out, or make a study of the best")
    } else if !base.is_hard() {
        let help = "leave it out; merges and breakages are counted of hard spheres alone";
        ("kernels are for hard spheres, and the base has soft ones", help)
    } else if base.output.size_classes.is_none() {
        let help =
            "name the fewest primaries of each class: settings = [\"output.size_classes=[1, 2, 5, 20]\"]";
        ("the base does not say by which classes: it has no output.size_classes", help)
    } else if keys.any(|key| key.starts_with(CLASSES)) {
        ("output.size_classes is varied, and kernels have one set of classes", "leave it as it is")
    } else {
        return None;
    };
    Some(Fault::new(KEY, message).with_help(help))
}
