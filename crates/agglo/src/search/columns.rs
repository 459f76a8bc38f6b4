//! The numbers of a summary by name: which there are, and how those that are wanted are picked.

use serde_json::Value as Json;

use crate::ledger::{Balance, Entries};
use crate::measure::{SizeClasses, SizeTotals};
use crate::run::{HardSummary, PulseQuantities, SoftSummary, Summary};

/// Quantities that are not the same on another machine or with another number of threads.
const OF_THE_MACHINE: [&str; 3] = ["seed", "threads", "wall_s"];

/// The columns that a run's summary can have, in their order: dotted names, list entries with the number 0.
pub fn known(is_hard: bool) -> Vec<String> {
    let summary = if is_hard {
        let energy = Balance { entries: Entries::Hard, ..Balance::default() };
        Summary::Hard(Box::new(HardSummary { energy, ..HardSummary::default() }))
    } else {
        Summary::Soft(Box::new(SoftSummary {
            pulses: vec![PulseQuantities::default()],
            ..SoftSummary::default()
        }))
    };
    let mut names = Vec::new();
    list(&tree(&summary), "", &mut names);
    names.retain(|name| !OF_THE_MACHINE.contains(&name.as_str()));
    names
}

/// Whether a summary can have this column; entries of lists have any number.
pub fn is_known(name: &str, known: &[String]) -> bool {
    let first: Vec<&str> =
        name.split('.').map(|word| if word.parse::<u32>().is_ok() { "0" } else { word }).collect();
    known.contains(&first.join("."))
}

/// The first word of the columns that no summary shows: numbers that rates by size are worked out from.
const TOTALS: &str = "size_totals";

/// Names of the numbers that rates by these classes are worked out from; none for classes without an end.
pub fn of_totals(classes: &SizeClasses) -> impl Iterator<Item = String> + use<> {
    (0..SizeTotals::len_of(classes.count().unwrap_or(0))).map(|at| format!("{TOTALS}.{at}"))
}

/// The quantities of a summary in the order of `names`; not a number where it has none.
pub fn pick(summary: &Summary, names: &[String]) -> Vec<f64> {
    let tree = tree(summary);
    let totals = match summary {
        Summary::Hard(hard) => hard.size_totals.as_ref().map(SizeTotals::to_vec),
        Summary::Soft(_) => None,
    };
    let total = |at: &str| totals.as_ref()?.get(at.parse::<usize>().ok()?).copied();
    let of = |name: &str| match name.strip_prefix(TOTALS).and_then(|rest| rest.strip_prefix('.')) {
        Some(at) => total(at),
        None => quantity(&tree, name),
    };
    names.iter().map(|name| of(name).unwrap_or(f64::NAN)).collect()
}

fn quantity(tree: &Json, name: &str) -> Option<f64> {
    name.split('.').try_fold(tree, step)?.as_f64()
}

/// The value of a key or of an index.
fn step<'a>(value: &'a Json, word: &str) -> Option<&'a Json> {
    match value {
        Json::Array(items) => items.get(word.parse::<usize>().ok()?),
        _ => value.get(word),
    }
}

fn tree(summary: &Summary) -> Json {
    // A struct of numbers and strings always has a tree; numbers that are not finite become null.
    serde_json::to_value(summary).unwrap_or_default()
}

fn list(value: &Json, path: &str, names: &mut Vec<String>) {
    let join = |word: &str| if path.is_empty() { word.to_owned() } else { format!("{path}.{word}") };
    match value {
        Json::Object(entries) => entries.iter().for_each(|(key, inner)| list(inner, &join(key), names)),
        Json::Array(items) => {
            items.iter().take(1).for_each(|inner| list(inner, &join("0"), names));
        }
        // What may be missing is a number where it is there.
        Json::Number(_) | Json::Null => names.push(path.to_owned()),
        Json::String(_) | Json::Bool(_) => {}
    }
}
