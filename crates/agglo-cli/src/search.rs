//! The verbs `search`, `study` and `join`, and what `resume` does with their folders.

use std::path::{Path, PathBuf};

use agglo::folder::names::CAMPAIGN;
use agglo::search::campaign::{self, CampaignEnding, CampaignError, CampaignObserver, Means, Part};
use agglo_view::pictures::campaign_pictures;

use crate::Failure;
use crate::arguments::{CommonOptions, JoinOptions, ResumeOptions, StudyOptions};
use crate::brake::WallTime;
use crate::failure::shown;
use crate::read::{self, Kind, Source};
use crate::run::{default_folder, refuse_occupied, settings};
use crate::session::{self, Outcome, Session};

/// Conducts a study, or a part of it, into a folder.
pub(crate) fn study(options: &StudyOptions) -> Result<(), Failure> {
    let part = options.part.as_deref().map(str::parse::<Part>).transpose();
    let part = part.map_err(|error| Failure::bad_input(format!("error: --part: {error}")))?;
    conduct(&options.common, Kind::Study, part)
}

/// Conducts a search or study, or a part of one, into a folder.
pub(crate) fn conduct(options: &CommonOptions, kind: Kind, part: Option<Part>) -> Result<(), Failure> {
    let wall = WallTime::of(options.session.wall_time.as_deref())?;
    let source = Source::read(&options.scenario)?;
    source.refuse_other_kind(kind)?;
    let campaign = source.campaign(&settings(options))?;
    let folder = options.output.clone().unwrap_or_else(|| {
        let whole = default_folder(&options.scenario);
        part.map_or_else(|| whole.clone(), |part| of_part(&whole, part))
    });
    refuse_occupied(&folder)?;
    let means = means(options.session.threads);
    let session = Session::open(kind.verb(), &folder, wall, &options.session)?;
    let base = &source.base;
    go(session, &source.shown, |observer| match part {
        Some(part) => campaign::run_part(&campaign, base, (&folder, part), means, observer),
        None => campaign::run(&campaign, base, &folder, means, observer),
    })
}

/// Where a part goes if no folder is named: beside the others.
fn of_part(whole: &Path, part: Part) -> PathBuf {
    let name = whole.file_name().unwrap_or_default().to_string_lossy();
    whole.with_file_name(format!("{name}-{}-of-{}", part.number, part.of))
}

/// Puts the parts of a study together.
pub(crate) fn join(options: &JoinOptions) -> Result<(), Failure> {
    let wall = WallTime::of(options.session.wall_time.as_deref())?;
    let folder = options.output.as_path();
    options.parts.iter().try_for_each(|part| read::folder(part))?;
    refuse_occupied(folder)?;
    let means = means(options.session.threads);
    let session = Session::open("join", folder, wall, &options.session)?;
    go(session, &shown(folder), |observer| campaign::join(&options.parts, folder, means, observer))
}

/// Goes on with the search or study in a folder.
pub(crate) fn resume(options: &ResumeOptions) -> Result<(), Failure> {
    let folder = options.folder.as_path();
    let wall = WallTime::of(options.session.wall_time.as_deref())?;
    let help = format!("a budget of time, and how many candidates there are, stand in its {CAMPAIGN}");
    let for_runs = [
        (options.until.is_some(), "--until", help.as_str()),
        (
            options.spread.is_given(),
            "--domains",
            "--threads says how many candidates are worked out at a time",
        ),
    ];
    if let Some((_, option, help)) = for_runs.into_iter().find(|(is_given, ..)| *is_given) {
        let shown = folder.display();
        let message = format!("error: {shown} holds a search or study; {option} is for runs\nhelp: {help}");
        return Err(Failure::bad_input(message));
    }
    if let Some(summary) = campaign::finished(folder) {
        return session::has_finished(folder, &Outcome::Campaign(Box::new(summary)), &options.session);
    }
    let means = means(options.session.threads);
    let session = Session::open("resume", folder, wall, &options.session)?;
    let file = shown(&folder.join(CAMPAIGN));
    go(session, &file, |observer| campaign::resume(folder, means, observer))
}

/// Threads of this process, and pictures at the end.
fn means(threads_wanted: Option<u32>) -> Means<'static> {
    Means { draw: Some(&campaign_pictures), ..Means::threads(threads(threads_wanted)) }
}

/// Threads that are wanted, or all processors.
pub(crate) fn threads(wanted: Option<u32>) -> usize {
    let all = || std::thread::available_parallelism().map_or(1, usize::from);
    wanted.map_or_else(all, |threads| threads as usize)
}

/// Conducts while somebody is told, stops at Ctrl-C or when the wall time is up, and says how it ended; `file` says what is
/// conducted.
fn go(
    mut session: Session,
    file: &str,
    work: impl FnOnce(&mut CampaignObserver<'_>) -> Result<CampaignEnding, CampaignError>,
) -> Result<(), Failure> {
    let outcome = work(&mut |progress| session.campaign(progress));
    session.rest();
    match outcome {
        Ok(CampaignEnding::Finished(summary)) => session.finished(&Outcome::Campaign(summary)),
        Ok(CampaignEnding::Interrupted) => {
            Err(session.stopped("stopped", "all simulations that ended are kept, ", None))
        }
        Err(error) => {
            let failure = session.failed(&error, error.exit_code());
            Err(if let CampaignError::Faulty(faults) = error {
                failure.with_faults(file, faults)
            } else {
                failure
            })
        }
    }
}
