//! The page of a search or study.

mod charts;
#[cfg(test)]
mod distinct_tests;
mod distributions;
mod folder;
mod study;
mod tables;
#[cfg(test)]
mod tests;

use std::path::Path;

use super::cite::{citations, methods};
use super::listing::{listing, plain};
use super::{Listing, Report};
use agglo::folder::{CampaignFolder, names};
use agglo::record::door;
use agglo::scenario::Scenario;
use agglo::search::campaign::CampaignSummary as Summary;
use folder::Folder;

/// The report of the folder of a search or study.
pub fn report(dir: &Path) -> Report {
    let folder = Folder::read(dir);
    let title = folder.campaign.as_ref().map(|campaign| campaign.title.clone()).unwrap_or_default();
    // What a study is for comes first.
    let mut charts = study::charts(&folder);
    charts.extend(charts::charts(&folder));
    charts.extend(distributions::charts(&folder));
    let run = format!("{}/{}", names::BEST_RUN, names::REPORT);
    let run = dir.join(&run).is_file().then_some(run);
    let methods = folder.campaign.as_ref().map(methods).unwrap_or_default();
    let what = "The run of the best candidate: its replay and charts";
    Report {
        kind: if folder.is_study() { "A study" } else { "A search" }.to_owned(),
        title: if title.is_empty() { "A search or study without a title".to_owned() } else { title },
        story: story(&folder),
        notes: folder.notes.clone(),
        replay: None,
        links: run.map(|run| [run, what.to_owned()]).into_iter().collect(),
        charts,
        tables: tables::tables(&folder),
        files: files(&folder),
        citations: methods.into_iter().chain(folder.scenario.iter().flat_map(citations)).collect(),
        laws_are_unknown: folder.scenario.is_none(),
    }
}

/// What it came to, in words.
fn story(folder: &Folder) -> String {
    let Some(summary) = &folder.summary else {
        let count = folder.evaluations.rows.len();
        return format!("It has not finished; {count} candidates are written down so far.");
    };
    let parameters = folder.parameters().len();
    let space = if parameters == 1 { "1 parameter".to_owned() } else { format!("{parameters} parameters") };
    let what = if folder.is_study() { "The study" } else { "The search" };
    let Summary { evaluations, runs, .. } = summary;
    let mut words = vec![format!("{what} tried {evaluations} candidates over {space} in {runs} runs.")];
    if summary.infeasible > 0 {
        words.push(format!("{} of them miss the limits.", summary.infeasible));
    }
    words.extend(summary.function.as_ref().map(|name| {
        format!("Their quantities come from the function {name} instead of runs; the run of the best is agglo's own.")
    }));
    words.extend(summary.best_in_words());
    if !summary.front.is_empty() {
        words.push(format!("{} candidates are beaten by no other in every cost.", summary.front.len()));
    }
    words.extend(summary.findings.iter().map(|finding| sentence(finding)));
    words.join(" ")
}

/// With a capital letter and a full stop.
fn sentence(words: &str) -> String {
    let first = words.chars().next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    let is_name = words.split_whitespace().next().is_some_and(|word| word.contains(['_', '.']));
    let rest: String = words.chars().skip(1).collect();
    if is_name { format!("{words}.") } else { format!("{first}{rest}.") }
}

fn files(folder: &Folder) -> Vec<Listing> {
    let mut files = vec![Listing {
        title: if folder.is_study() { "The study" } else { "The search" }.to_owned(),
        lines: plain(&folder.campaign_text),
    }];
    if let Ok(text) =
        door::read_text(&CampaignFolder::at(&folder.root).best_run().scenario(), door::MOST_OF_A_TEXT)
    {
        let lines = match Scenario::from_toml(&text) {
            Ok(scenario) => listing(&scenario, &text),
            Err(_) => plain(&text),
        };
        files.push(Listing { title: "The best candidate's scenario".to_owned(), lines });
    }
    files
}
