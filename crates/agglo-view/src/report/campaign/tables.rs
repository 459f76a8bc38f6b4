//! Tables of searches and studies.

use super::folder::Folder;
use crate::report::QuantityTable;
use agglo::folder::CampaignFolder;
use agglo::folder::names::{
    BEST, BEST_RUN, CAMPAIGN, DIFFERENCES, EVALUATIONS, FAILURES, REFINEMENT, SCENARIO, SENSITIVITY,
};
use agglo::record::Sheet;
use agglo::text::column;

/// Rows of failures at the most.
const MOST_FAILURES: usize = 50;

/// The tables; those without data are left out.
pub fn tables(folder: &Folder) -> Vec<QuantityTable> {
    let best = [parameters(folder), outcomes(folder)];
    let studied = [
        whole(&folder.refinement, "What refinement says", &format!("From {REFINEMENT}.")),
        whole(
            &folder.differences,
            "How far each level is from the finest",
            &format!(
                "Replicate by replicate where levels share their replicates, with 95 % confidence: settled within the tolerance, not \
                 settled, or not shown, where the interval has both. From {DIFFERENCES}."
            ),
        ),
        whole(&folder.sensitivity, "Sensitivity", &format!("From {SENSITIVITY}.")),
    ];
    let tables = best.into_iter().chain(studied).chain([quantities(folder), failures(folder)]);
    tables.flatten().chain([again(folder)]).collect()
}

/// The parameters of the best candidates ([B], tables 1 and 2).
fn parameters(folder: &Folder) -> Option<QuantityTable> {
    if folder.is_study() {
        return None;
    }
    let columns = [&["rank", "evaluation"][..], &folder.parameters()].concat();
    picked(
        &folder.best,
        &columns,
        "The best candidates: their parameters",
        &format!("In SI units; the letters after the last underscores are the units. From {BEST}."),
    )
}

/// What the best candidates come to ([B], table 3).
fn outcomes(folder: &Folder) -> Option<QuantityTable> {
    if folder.is_study() {
        return None;
    }
    let mut sheet = folder.best.clone();
    let at = sheet.place("evaluation")?;
    let outcomes = folder.outcomes();
    sheet.names.extend(outcomes.iter().map(|name| (*name).to_owned()));
    let key = folder.evaluations.place("evaluation")?;
    for row in &mut sheet.rows {
        let found = folder.evaluations.rows.iter().find(|other| other[key] == row[at]);
        let entry = |name: &&str| Some(found?[folder.evaluations.place(name)?].clone());
        row.extend(outcomes.iter().map(|name| entry(name).unwrap_or_default()));
    }
    let goal = folder.goals().into_iter().next().unwrap_or_default();
    own_signs(folder, &mut sheet, &goal);
    let limits = if folder.has_limits() { &["limits"][..] } else { &[] };
    let fixed = ["replicates", "once_more", "once_more_standard_error", "in_the_search", "search_replicates"];
    let new: Vec<&str> = outcomes.into_iter().filter(|name| *name != goal).collect();
    picked(
        &sheet,
        &[&["rank"][..], limits, &[&goal, "standard_error"], &fixed, &new].concat(),
        "The best candidates: what they come to",
        &format!(
            "Means over replicates that the search had not seen, where they were run again. The first was chosen by these, so it \
             was run once more, and what it came to then is what counts. From {BEST} and {EVALUATIONS}."
        ),
    )
}

/// The costs of the best candidates as values of what was to be small or large, and their violations as words.
fn own_signs(folder: &Folder, sheet: &mut Sheet, goal: &str) {
    const NAMES: [(&str, &str); 5] = [
        ("cost_standard_error", "standard_error"),
        ("search_cost", "in_the_search"),
        ("final_cost", "once_more"),
        ("final_cost_standard_error", "once_more_standard_error"),
        ("violation", "limits"),
    ];
    let is_to_be_large = folder.signs().first().is_some_and(|sign| *sign < 0.0);
    for name in ["cost", "search_cost", "final_cost"] {
        if let Some(at) = sheet.place(name).filter(|_| is_to_be_large) {
            sheet.rows.iter_mut().for_each(|row| row[at] = negated(&row[at]));
        }
    }
    let last = sheet.place("final_violation");
    if let Some(at) = sheet.place("violation") {
        for row in &mut sheet.rows {
            // What counts is what it came to at last.
            let missed = last.map(|last| row[last].clone()).filter(|entry| !entry.is_empty());
            let missed = missed.unwrap_or_else(|| row[at].clone()).parse::<f64>();
            let mark = missed.map_or("", |missed| if missed > 0.0 { "MISSED" } else { "kept" });
            mark.clone_into(&mut row[at]);
        }
    }
    if let Some(at) = sheet.place("cost") {
        goal.clone_into(&mut sheet.names[at]);
    }
    for (name, shown) in NAMES {
        if let Some(at) = sheet.place(name) {
            shown.clone_into(&mut sheet.names[at]);
        }
    }
}

/// A number with the other sign; as it is if it is none.
fn negated(entry: &str) -> String {
    match entry.strip_prefix('-') {
        Some(rest) => rest.to_owned(),
        None if entry.parse::<f64>().is_ok_and(|value| value != 0.0) => format!("-{entry}"),
        None => entry.to_owned(),
    }
}

fn whole(sheet: &Sheet, title: &str, about: &str) -> Option<QuantityTable> {
    let columns: Vec<&str> = sheet.names.iter().map(String::as_str).collect();
    picked(sheet, &columns, title, about)
}

/// Some columns of a sheet, before the charts.
fn picked(sheet: &Sheet, columns: &[&str], title: &str, about: &str) -> Option<QuantityTable> {
    let says_something = |at: &usize| sheet.rows.iter().any(|row| !row[*at].is_empty());
    let places: Vec<usize> =
        columns.iter().filter_map(|name| sheet.place(name)).filter(says_something).collect();
    if sheet.rows.is_empty() {
        return None;
    }
    let columns: Vec<Vec<String>> = places.iter().map(|&at| shown(sheet, at)).collect();
    let row = |row: usize| columns.iter().map(|column| column[row].clone()).collect();
    let rows = (0..sheet.rows.len()).map(row).collect();
    let head = places.iter().map(|&at| sheet.names[at].clone()).collect();
    Some(QuantityTable { title: title.to_owned(), about: about.to_owned(), is_first: true, head, rows })
}

/// A column as people read it: numbers with enough digits to be told apart, words and counts as they are.
fn shown(sheet: &Sheet, at: usize) -> Vec<String> {
    let number = |row: &Vec<String>| match row[at].parse::<i64>() {
        Ok(_) => None,
        Err(_) => row[at].parse::<f64>().ok(),
    };
    let numbers: Vec<f64> = sheet.rows.iter().filter_map(number).collect();
    let mut texts = column(&numbers).into_iter();
    let mut text = |row: &Vec<String>| match number(row) {
        Some(_) => texts.next().unwrap_or_default(),
        None => row[at].clone(),
    };
    sheet.rows.iter().map(&mut text).collect()
}

fn quantities(folder: &Folder) -> Option<QuantityTable> {
    let rows =
        folder.summary.as_ref()?.table().into_iter().map(|(what, quantity)| vec![what, quantity]).collect();
    Some(QuantityTable { title: "Quantities".to_owned(), rows, ..QuantityTable::default() })
}

fn failures(folder: &Folder) -> Option<QuantityTable> {
    let sheet = &folder.failures;
    if sheet.rows.is_empty() {
        return None;
    }
    let count = sheet.rows.len();
    let about = if count > MOST_FAILURES {
        format!("The first {MOST_FAILURES} of {count}; {FAILURES} has all.")
    } else {
        String::new()
    };
    Some(QuantityTable {
        title: "Warnings: candidates that could not be run".to_owned(),
        about,
        head: sheet.names.clone(),
        rows: sheet.rows.iter().take(MOST_FAILURES).cloned().collect(),
        ..QuantityTable::default()
    })
}

/// How to run it again: version, seed, command.
fn again(folder: &Folder) -> QuantityTable {
    let mut rows = Vec::new();
    let mut row = |what: &str, value: String| rows.push(vec![what.to_owned(), value]);
    if let Some(summary) = &folder.summary {
        row("version", format!("agglo {}", summary.version));
    }
    if let Some(campaign) = &folder.campaign {
        row("seed", campaign.seed.to_string());
    }
    let verb = if folder.is_study() { "study" } else { "search" };
    row("command", format!("agglo {verb} {CAMPAIGN} -o again"));
    if CampaignFolder::at(&folder.root).best_run().scenario().is_file() {
        row("command of the best one's run", format!("agglo run {BEST_RUN}/{SCENARIO} -o best-again"));
    }
    QuantityTable {
        title: "To run it again".to_owned(),
        about: "In this folder. The same version, files and seed give the same numbers, to the last bit, on the same \
                machine and any number of threads."
            .to_owned(),
        rows,
        ..QuantityTable::default()
    }
}
