//! What `check` says of a search or study.

use agglo::forecast::Plan;
use agglo::search::{Axis, Campaign, CampaignForecast, Ensemble, Problem, Scale, Until, campaign};
use serde_json::{Value as Json, json};

use crate::json::Line;
use crate::progress::columns;
use crate::read::Source;
use crate::search::threads;
use crate::{Failure, print};

/// Checks a search or study and says what it would do.
pub(crate) fn check(source: &Source, settings: &[String], is_json: bool) -> Result<(), Failure> {
    let shown = source.shown.as_str();
    let campaign = source.campaign(settings)?;
    let problem = Problem::new(&campaign, &source.base).map_err(|faults| {
        let message = format!("error: {faults}");
        Failure::bad_input(message).with_faults(shown, faults)
    })?;
    campaign::refuse_too_large(&problem, threads(None))
        .map_err(|error| Failure::bad_input(format!("error: {shown}: {error}")))?;
    let forecast = CampaignForecast::new(&campaign, &problem, threads(None));
    let notes: Vec<String> = problem.notes().into_iter().chain(problem.refused_ends()).collect();
    let middle = problem.scenario(&problem.center()).ok();
    let middle = middle.map(|scenario| Plan::new(&scenario, problem.folder()));
    let middle =
        middle.transpose().map_err(|error| Failure::bad_input(format!("error: {shown}: {error}")))?;
    if is_json {
        let campaign = Some(in_json(&campaign, &problem, &forecast, &notes));
        let run = middle.as_ref();
        return Line::Plan { file: shown, kind: source.kind().verb(), run, campaign }.print();
    }
    let mut parts = vec![format!("{shown} is valid"), columns(&rows(&campaign, &problem, &forecast))];
    parts.extend(notes.iter().map(|note| format!("note: {note}")));
    parts.extend(
        middle.map(|plan| format!("\nOne run, with all parameters in the middle of their ranges:\n{plan}")),
    );
    print(&parts.join("\n"))
}

/// The same for programs.
fn in_json(campaign: &Campaign, problem: &Problem, forecast: &CampaignForecast, notes: &[String]) -> Json {
    let parameters = problem.axes().iter().zip(&campaign.parameters);
    let parameters = parameters.map(|(axis, parameter)| parameter_in_json(axis, parameter.key.as_deref()));
    let objective = |(formula, is_to_be_large): (&str, bool)| json!({ "formula": formula, "is_to_be_large": is_to_be_large });
    let corridor = |formula: &str, at_least: Option<f64>, at_most: Option<f64>| json!({ "formula": formula, "at_least": at_least, "at_most": at_most });
    let constraints =
        campaign.constraints.iter().map(|one| corridor(&one.formula, one.at_least, one.at_most));
    let limits = campaign.limits.iter().map(|one| corridor(&one.formula, one.at_least, one.at_most));
    let stage = |(stage, candidates): &(campaign::Stage, u64)| json!({ "stage": stage.word(), "at_most": candidates });
    let ends = |[least, most]: [f64; 2]| json!({ "least": least, "most": most });
    let (way, word) = campaign::way_of(campaign);
    json!({
        "parameters": parameters.collect::<Vec<_>>(),
        "objectives": problem.objectives().map(objective).collect::<Vec<_>>(),
        "columns": campaign.columns,
        "constraints": constraints.collect::<Vec<_>>(),
        "limits": limits.collect::<Vec<_>>(),
        "way": way,
        "word": word,
        "replicates": replicates_in_json(&campaign.ensemble),
        "candidates": forecast.planned.iter().map(stage).collect::<Vec<_>>(),
        "runs": ends(forecast.runs),
        "threads": forecast.threads,
        "wall_s": forecast.seconds.map(ends),
        "budget_s": forecast.budget_s,
        "memory_B": forecast.memory,
        "disk_B": forecast.disk,
        "notes": notes,
    })
}

fn replicates_in_json(ensemble: &Ensemble) -> Json {
    let (least, most, are_common) = (ensemble.least(), ensemble.most(), ensemble.common_random_numbers);
    json!({ "least": least, "most": most, "are_common": are_common })
}

fn parameter_in_json(axis: &Axis, key: Option<&str>) -> Json {
    let scale = match &axis.scale {
        Scale::Linear(_) => "linear",
        Scale::Log(_) => "log",
        Scale::Whole(_) => "whole",
        Scale::Choices(_) => "choices",
    };
    let bounds = match &axis.scale {
        Scale::Linear(bounds) | Scale::Log(bounds) => Some(json!(bounds)),
        Scale::Whole(bounds) => Some(json!(bounds)),
        Scale::Choices(_) => None,
    };
    let choices = match &axis.scale {
        Scale::Choices(choices) => {
            Some(choices.iter().map(|choice| choice.label.as_str()).collect::<Vec<_>>())
        }
        _ => None,
    };
    json!({ "name": axis.name, "column": axis.column(), "key": key, "scale": scale, "bounds": bounds, "choices": choices })
}

/// What a search or study varies, wants and does, in two columns.
fn rows(campaign: &Campaign, problem: &Problem, forecast: &CampaignForecast) -> Vec<(String, String)> {
    let row = |what: &str, words: String| (what.to_owned(), words);
    let mut rows = Vec::new();
    for (axis, parameter) in problem.axes().iter().zip(&campaign.parameters) {
        let key = parameter.key.as_ref().map(|key| format!("  {key}")).unwrap_or_default();
        rows.push(row(&axis.name, format!("{}{key}", range(axis))));
    }
    for (formula, is_to_be_large) in problem.objectives() {
        rows.push(row(if is_to_be_large { "to be large" } else { "to be small" }, formula.to_owned()));
    }
    if campaign.objectives.is_empty() {
        rows.push(row("measured", campaign.columns.join(", ")));
    }
    let corridor = |formula: &str, at_least: Option<f64>, at_most: Option<f64>| {
        let least = at_least.map(|least| format!(" at least {least}")).unwrap_or_default();
        let most = at_most.map(|most| format!(" at most {most}")).unwrap_or_default();
        format!("{formula}{least}{most}")
    };
    let constraints =
        campaign.constraints.iter().map(|one| corridor(&one.formula, one.at_least, one.at_most));
    rows.extend(constraints.map(|words| row("constraint", words)));
    let limits = campaign.limits.iter().map(|one| corridor(&one.formula, one.at_least, one.at_most));
    rows.extend(limits.map(|words| row("limit", words)));
    let (what, word) = campaign::way_of(campaign);
    rows.push(row(what, word));
    rows.push(row("replicates", replicates(&campaign.ensemble)));
    rows.extend(forecast.rows());
    rows
}

fn range(axis: &Axis) -> String {
    let ends = |bounds: &[f64; 2], how: &str| {
        let [lower, upper] = bounds.map(|bound| axis.readable(bound));
        format!("{lower} to {upper}{how}")
    };
    match &axis.scale {
        Scale::Linear(bounds) => ends(bounds, ""),
        Scale::Log(bounds) => ends(bounds, ", logarithmic"),
        Scale::Whole(bounds) => ends(&bounds.map(|bound| bound as f64), ", whole numbers"),
        Scale::Choices(choices) => {
            let labels: Vec<&str> = choices.iter().map(|choice| choice.label.as_str()).collect();
            labels.join(", ")
        }
    }
}

fn replicates(ensemble: &Ensemble) -> String {
    let count = match &ensemble.until {
        Until::Fixed(fixed) => fixed.replicates.to_string(),
        Until::RunningMean(rule) => {
            let (least, most, part) = (ensemble.least(), ensemble.most(), rule.tolerance);
            format!("{least} to {most}, until one more moves the mean cost by less than {part} of itself")
        }
        Until::Confidence(rule) => {
            let (least, most, width) = (ensemble.least(), ensemble.most(), rule.half_width);
            format!(
                "{least} to {most}, until the mean cost is known to +- {width} ({} %)",
                100.0 * rule.level
            )
        }
    };
    let whose = if ensemble.common_random_numbers { "the same for all" } else { "each candidate its own" };
    format!("{count}; {whose}")
}
