//! The verbs `search` and `study`, and what `resume` does with their folders.

use agglo::folder::names::CAMPAIGN;
use agglo::search::campaign::{self, CampaignEnding, CampaignError, CampaignObserver};
use agglo_view::pictures::campaign_pictures;

use crate::Failure;
use crate::arguments::{CommonOptions, ResumeOptions};
use crate::brake::WallTime;
use crate::failure::shown;
use crate::read::{Kind, Source};
use crate::run::{default_folder, refuse_occupied, settings};
use crate::session::{self, Outcome, Session};

/// Conducts a search or study into a folder.
pub(crate) fn conduct(options: &CommonOptions, kind: Kind) -> Result<(), Failure> {
    let wall = WallTime::of(options.session.wall_time.as_deref())?;
    let source = Source::read(&options.scenario)?;
    source.refuse_other_kind(kind)?;
    let campaign = source.campaign(&settings(options))?;
    let folder = options.output.clone().unwrap_or_else(|| default_folder(&options.scenario));
    refuse_occupied(&folder)?;
    let threads = threads(options.session.threads);
    let session = Session::open(kind.verb(), &folder, wall, &options.session)?;
    go(session, &source.shown, |observer| {
        campaign::run(&campaign, &source.base, &folder, threads, Some(&campaign_pictures), observer)
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
        return session::has_finished(folder, &Outcome::Campaign(Box::new(summary)), &options.session);
    }
    let threads = threads(options.session.threads);
    let session = Session::open("resume", folder, wall, &options.session)?;
    let file = shown(&folder.join(CAMPAIGN));
    go(session, &file, |observer| campaign::resume(folder, threads, Some(&campaign_pictures), observer))
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
