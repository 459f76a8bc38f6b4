//! The verbs `search` and `study`, and what `resume` and `check` do with their files.

use std::path::Path;

use agglo::folder::names::CAMPAIGN;
use agglo::forecast::Plan;
use agglo::search::campaign::{self, CampaignEnding, CampaignError, CampaignObserver, CampaignSummary};
use agglo::search::{Axis, Campaign, CampaignForecast, Ensemble, Problem, Scale, Until};
use agglo_view::pictures::campaign_pictures;

use crate::arguments::{CommonOptions, ResumeOptions, SessionOptions};
use crate::brake::{Brake, WallTime};
use crate::progress::Display;
use crate::read::{Kind, Source};
use crate::run::{columns, default_folder, refuse_occupied, settings};
use crate::signals::Ear;
use crate::{Failure, print, report};

/// Conducts a search or study into a folder.
pub(crate) fn conduct(options: &CommonOptions, kind: Kind) -> Result<(), Failure> {
    let wall = WallTime::of(options.session.wall_time.as_deref())?;
    let source = Source::read(&options.scenario)?;
    source.refuse_other_kind(kind)?;
    let (campaign, base) = (source.campaign(&settings(options))?, source.base);
    let folder = options.output.clone().unwrap_or_else(|| default_folder(&options.scenario));
    refuse_occupied(&folder)?;
    let threads = threads(options.session.threads);
    go(&folder, wall, &options.session, |observer| {
        campaign::run(&campaign, &base, &folder, threads, Some(&campaign_pictures), observer)
    })
}

/// Goes on with the search or study in a folder.
pub(crate) fn resume(options: &ResumeOptions) -> Result<(), Failure> {
    let folder = options.folder.as_path();
    let wall = WallTime::of(options.session.wall_time.as_deref())?;
    if options.until.is_some() {
        let shown = folder.display();
        let help = format!("a budget of time, and how many candidates there are, stand in its {CAMPAIGN}");
        let message = format!("error: {shown} holds a search or study; --until is for runs\nhelp: {help}");
        return Err(Failure::bad_input(message));
    }
    if let Some(summary) = campaign::finished(folder) {
        let shown = folder.display();
        return print(&format!("{}\nwhat is in {shown} has finished already", columns(&summary.table())));
    }
    let threads = threads(options.session.threads);
    go(folder, wall, &options.session, |observer| {
        campaign::resume(folder, threads, Some(&campaign_pictures), observer)
    })
}

fn threads(wanted: Option<u32>) -> usize {
    let all = || std::thread::available_parallelism().map_or(1, usize::from);
    wanted.map_or_else(all, |threads| threads as usize)
}

/// Conducts with a display, stops at Ctrl-C or when the wall time is up, writes the reports of what finished, and says how it
/// ended.
fn go(
    folder: &Path,
    wall: WallTime,
    options: &SessionOptions,
    work: impl FnOnce(&mut CampaignObserver<'_>) -> Result<CampaignEnding, CampaignError>,
) -> Result<(), Failure> {
    let mut brake = Brake::open(folder, wall)?;
    let mut display = Display::new();
    let outcome = work(&mut |progress| {
        display.show_campaign(progress);
        brake.look()
    });
    let (_, closing) = display.finish();
    let shown = folder.display();
    match outcome {
        Ok(CampaignEnding::Finished(summary)) => {
            let reports = (!options.no_report).then(|| brake.ear());
            print(&finished(&summary, folder, reports))
        }
        Ok(CampaignEnding::Interrupted) => {
            let (reason, kept) = (brake.reason(), "all simulations that ended are kept");
            let why = reason.words();
            let message =
                format!("stopped{why} ({closing}); {kept}, `agglo resume {shown}` goes on from there");
            Err(Failure::with_code(message, reason.exit_code()))
        }
        Err(error) => Err(Failure::with_code(format!("error: {error}\n({closing})"), error.exit_code())),
    }
}

fn finished(summary: &CampaignSummary, folder: &Path, reports: Option<&Ear>) -> String {
    let page = |of: &Path| reports.map(|ear| report::at_the_end(of, ear)).unwrap_or_default();
    let run = folder.join("best");
    let best = if run.is_dir() {
        let shown = run.display();
        format!("\nthe best one's run in {shown}{}", page(&run))
    } else {
        String::new()
    };
    format!("{}\nin {}{}{best}", columns(&summary.table()), folder.display(), page(folder))
}

/// Checks a search or study and says what it would do.
pub(crate) fn check(source: &Source, settings: &[String]) -> Result<(), Failure> {
    let campaign = source.campaign(settings)?;
    let problem = Problem::new(&campaign, &source.base)
        .map_err(|faults| Failure::bad_input(format!("error: {faults}")))?;
    campaign::refuse_too_large(&problem, threads(None))
        .map_err(|error| Failure::bad_input(format!("error: {}: {error}", source.shown)))?;
    let mut parts = vec![format!("{} is valid", source.shown), columns(&rows(&campaign, &problem))];
    let notes = problem.notes().into_iter().chain(problem.refused_ends());
    parts.extend(notes.map(|note| format!("note: {note}")));
    if let Ok(scenario) = problem.scenario(&problem.center()) {
        let plan = Plan::new(&scenario, problem.folder())
            .map_err(|error| Failure::bad_input(format!("error: {}: {error}", source.shown)))?;
        parts.push(format!("\nOne run, with all parameters in the middle of their ranges:\n{plan}"));
    }
    print(&parts.join("\n"))
}

/// What a search or study varies, wants and does, in two columns.
fn rows(campaign: &Campaign, problem: &Problem) -> Vec<(String, String)> {
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
    rows.extend(CampaignForecast::new(campaign, problem, threads(None)).rows());
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
