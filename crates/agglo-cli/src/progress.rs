//! What people are told of a session: a bar on a terminal, a line every ten seconds elsewhere, a table at the end.

use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use agglo::run::Progress;
use agglo::search::campaign::CampaignProgress;
use agglo::text::{readable, visible};
use agglo_view::render::AnimationProgress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::failure::Failure;
use crate::print;
use crate::session::{End, Listener, News, Outcome};

const BETWEEN_LINES: Duration = Duration::from_secs(10);
/// The bar counts ten-thousandths of what is to be done.
const PARTS: f64 = 10_000.0;
const TEMPLATE: &str = "{bar:16} {percent:>3} %  {msg}";

/// Shows progress to people.
pub(crate) struct Display {
    bar: ProgressBar,
    on_terminal: bool,
    last_line: Instant,
    /// When the first picture was begun.
    drawing: Option<Instant>,
}

impl Display {
    /// A display that has shown nothing yet.
    pub(crate) fn new() -> Self {
        let on_terminal = io::stderr().is_terminal();
        let target = if on_terminal { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(PARTS as u64), target);
        if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
            bar.set_style(style);
        }
        Self { bar, on_terminal, last_line: Instant::now(), drawing: None }
    }

    /// Shows how far pictures are.
    pub(crate) fn show_animation(&mut self, progress: AnimationProgress) {
        let (done, all, state) = match progress {
            AnimationProgress::Without(what) => return self.warning(&what),
            AnimationProgress::Looking(done, all) => {
                (done, all, format!("{done} of {all} frames looked through"))
            }
            AnimationProgress::Drawing(done, all) => {
                let passed = self.drawing.get_or_insert_with(Instant::now).elapsed().as_secs_f64();
                let left = (done > 0).then(|| clock(passed / done as f64 * (all - done) as f64));
                (done, all, format!("{done} of {all} pictures, {} left", left.unwrap_or("?".to_owned())))
            }
        };
        self.show(Some(done as f64 / all.max(1) as f64), &state);
    }

    /// Shows what part is done, if that is known, and the words for it.
    fn show(&mut self, part: Option<f64>, state: &str) {
        if self.on_terminal {
            self.bar.set_position((PARTS * part.unwrap_or(0.0).min(1.0)) as u64);
            self.bar.set_message(visible(state).into_owned());
        } else if self.last_line.elapsed() >= BETWEEN_LINES {
            self.last_line = Instant::now();
            let part = part.map(|part| format!("{:>3.0} %  ", 100.0 * part)).unwrap_or_default();
            self.line(&format!("{part}{state}"));
        }
    }

    fn line(&self, text: &str) {
        let text = &*visible(text);
        if self.on_terminal {
            self.bar.println(text);
        } else {
            // A run goes on where nobody reads its messages.
            let _ = writeln!(io::stderr(), "{text}");
        }
    }
}

impl Listener for Display {
    fn started(&mut self, _: &'static str, _: &Path) {}

    fn progress(&mut self, news: News<'_>, _: f64) {
        match news {
            News::Run(progress, pace) => self.show(Some(part(progress)), &state(progress, pace)),
            News::Campaign(progress) => {
                let most = progress.evaluations_at_most;
                let part = most.map(|most| progress.evaluations as f64 / most.max(1) as f64);
                self.show(part, &campaign_state(progress));
            }
        }
    }

    fn warning(&mut self, words: &str) {
        self.line(&format!("warning: {words}"));
    }

    fn rest(&mut self) {
        self.bar.finish_and_clear();
    }

    fn finished(&mut self, end: &End<'_>) -> Result<(), Failure> {
        print(&format!("{}\n{}", columns(&end.outcome.table()), closing(end)))
    }
}

/// What stands below the closing table: where all is, how long it took, what shows it.
fn closing(end: &End<'_>) -> String {
    let shown = end.folder.display();
    let page = end.page.words(end.folder);
    match (end.outcome, end.wall_s) {
        (Outcome::Run(summary), Some(wall_s)) => {
            // Of the whole run, also where this was only the end of it.
            let warnings = count(summary.warnings().len());
            format!("in {shown} ({}, {warnings}){page}", clock(wall_s))
        }
        (Outcome::Campaign(_), Some(_)) if end.outcome.is_part() => {
            format!("in {shown}; `agglo join` puts all parts together")
        }
        (Outcome::Campaign(_), Some(_)) => {
            let best = end
                .best
                .as_ref()
                .map(|(run, page)| format!("\nthe best one's run in {}{}", run.display(), page.words(run)));
            format!("in {shown}{page}{}", best.unwrap_or_default())
        }
        (Outcome::Run(_), None) => format!("the run in {shown} has finished already{page}"),
        (Outcome::Campaign(_), None) => format!("what is in {shown} has finished already{page}"),
    }
}

/// Rows in two columns.
pub(crate) fn columns(rows: &[(String, String)]) -> String {
    let width = rows.iter().map(|(label, _)| label.chars().count()).max().unwrap_or(0);
    let lines: Vec<String> =
        rows.iter().map(|(label, value)| format!("  {label:<width$}  {value}")).collect();
    lines.join("\n")
}

/// "no warnings", "1 warning", "2 warnings".
pub(crate) fn count(warnings: usize) -> String {
    match warnings {
        0 => "no warnings".to_owned(),
        1 => "1 warning".to_owned(),
        count => format!("{count} warnings"),
    }
}

/// Part of the simulated time that has passed.
pub(crate) fn part(progress: &Progress) -> f64 {
    if progress.end > 0.0 { (progress.time / progress.end).clamp(0.0, 1.0) } else { 0.0 }
}

/// How fast the run goes: means over the reports so far that forget with [`Pace::MEMORY`].
///
/// Simulated time by itself is a poor guide to the time that is left: steps are short while rays fly, and impacts
/// become rare as hard spheres grow. The last seconds tell more than the whole run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace {
    last: (f64, f64, u64),
    /// Sums of wall time [s], simulated time [s] and steps, each weighted by its age.
    sums: [f64; 3],
}

impl Pace {
    /// Wall time [s] in which weights fall by a factor of e.
    const MEMORY: f64 = 8.0;

    /// Begins at a report at the wall time `wall` [s].
    pub(crate) fn from(progress: &Progress, wall: f64) -> Self {
        Self { last: (wall, progress.time, progress.step), sums: [0.0; 3] }
    }

    /// Takes a report at the wall time `wall` [s] into account.
    pub(crate) fn note(&mut self, progress: &Progress, wall: f64) {
        let (before, time, step) = self.last;
        let passed = wall - before;
        let parts = [passed, progress.time - time, progress.step.saturating_sub(step) as f64];
        let kept = (-passed / Self::MEMORY).exp();
        for (sum, part) in self.sums.iter_mut().zip(parts) {
            *sum = *sum * kept + part;
        }
        self.last = (wall, progress.time, progress.step);
    }

    fn per_second(part: f64, wall: f64) -> f64 {
        if wall > 0.0 { part / wall } else { 0.0 }
    }

    /// Steps in a second.
    pub(crate) fn steps(&self) -> f64 {
        Self::per_second(self.sums[2], self.sums[0])
    }

    /// Wall time left [s], if that can be said.
    pub(crate) fn left(&self, progress: &Progress) -> Option<f64> {
        let speed = Self::per_second(self.sums[1], self.sums[0]);
        (speed > 0.0).then(|| (progress.end - progress.time).max(0.0) / speed)
    }
}

/// "0.310 of 2 s, 812 steps/s, 1:02 left, pulse 2 of 4".
pub(crate) fn state(progress: &Progress, pace: &Pace) -> String {
    let left = pace.left(progress).map_or("?".to_owned(), clock);
    let rate = pace.steps();
    let rate = if rate >= 10.0 { format!("{rate:.0}") } else { format!("{rate:.1}") };
    let now = if progress.now.is_empty() { String::new() } else { format!(", {}", progress.now) };
    let (time, steps_are) = (time_of(progress.time, progress.end), progress.steps_are);
    format!("{time}, {rate} {steps_are}/s, {left} left{now}")
}

/// "search, best 0.3204 +- 0.004, 314 of 370 candidates in 21 batches, 1204 runs, 35.2/s, 1:02 left".
fn campaign_state(progress: &CampaignProgress) -> String {
    let CampaignProgress { evaluations, generations, replicates, failures, .. } = progress;
    let best = progress.best.map_or("none yet".to_owned(), |(cost, error)| {
        let error = if error > 0.0 { format!(" +- {}", readable(error, "")) } else { String::new() };
        format!("{}{error}", readable(cost, ""))
    });
    let best = if progress.has_goal { format!(", best {best}") } else { String::new() };
    let most = progress.evaluations_at_most.map(|most| format!(" of {most}")).unwrap_or_default();
    let failed = if *failures > 0 { format!(", {failures} failed") } else { String::new() };
    let left = progress.left_s.map(|left| format!(", {} left", clock(left))).unwrap_or_default();
    let (stage, rate) = (progress.stage.word(), readable(progress.replicates_per_second, ""));
    format!(
        "{stage}{best}, {evaluations}{most} candidates in {generations} batches{failed}, {replicates} runs, \
         {rate}/s{left}"
    )
}

/// Simulated time in the unit in which the end reads well: "35.120 of 120 us".
fn time_of(time: f64, end: f64) -> String {
    const UNITS: [(f64, &str); 5] = [(1.0, "s"), (1e-3, "ms"), (1e-6, "us"), (1e-9, "ns"), (1e-12, "ps")];
    // A hair below one, since 1e-3 may come as a sum.
    let fits = |unit: &&(f64, &str)| end >= 0.999_999 * unit.0;
    let (unit, name) = UNITS.iter().find(fits).unwrap_or(&UNITS[4]);
    let last = format!("{:.3}", end / unit);
    format!("{:.3} of {} {name}", time / unit, last.trim_end_matches('0').trim_end_matches('.'))
}

/// Minutes and seconds, or hours, minutes and seconds.
pub(crate) fn clock(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    let (hours, minutes, seconds) = (whole / 3600, whole / 60 % 60, whole % 60);
    if hours > 0 { format!("{hours}:{minutes:02}:{seconds:02}") } else { format!("{minutes}:{seconds:02}") }
}

#[cfg(test)]
mod tests {
    use agglo::search::campaign::Stage;

    use super::*;

    fn report(time: f64, step: u64) -> Progress {
        let now = "pulse 2 of 4".into();
        Progress { time, end: 2.0, step, steps_are: "steps", now, warnings: Vec::new() }
    }

    #[test]
    fn the_state_counts_from_where_the_run_began() {
        let mut pace = Pace::from(&report(1.0, 100), 5.0);
        assert_eq!(state(&report(1.0, 100), &pace), "1.000 of 2 s, 0.0 steps/s, ? left, pulse 2 of 4");
        pace.note(&report(1.5, 300), 65.0);
        // Half a second of simulated time in 60 s: another half takes 60 s; 200 steps in 60 s are 3.3 a second.
        assert_eq!(state(&report(1.5, 300), &pace), "1.500 of 2 s, 3.3 steps/s, 1:00 left, pulse 2 of 4");
    }

    #[test]
    fn a_campaign_shows_its_best_and_what_is_left() {
        let progress = CampaignProgress {
            best: Some((0.320_44, 0.004)),
            has_goal: true,
            stage: Stage::Search,
            evaluations: 314,
            evaluations_at_most: Some(370),
            generations: 21,
            replicates: 1204,
            replicates_per_second: 35.21,
            failures: 2,
            left_s: Some(62.0),
            warnings: Vec::new(),
        };
        let wanted = "search, best 0.3204 +- 0.004, 314 of 370 candidates in 21 batches, 2 failed, 1204 runs, \
                      35.21/s, 1:02 left";
        assert_eq!(campaign_state(&progress), wanted);
    }

    /// A slow beginning is forgotten: after 40 s at 0.02 of simulated time a second, exp(-5) of it is left.
    #[test]
    fn the_time_left_follows_the_last_seconds() {
        let mut pace = Pace::from(&report(0.0, 0), 0.0);
        let mut time = 0.0;
        for second in 1..=140_u64 {
            time += if second <= 100 { 1e-4 } else { 0.02 };
            pace.note(&report(time, second), second as f64);
        }
        let left = pace.left(&report(time, 140)).unwrap();
        let wanted = (2.0 - time) / 0.02;
        assert!((left / wanted - 1.0).abs() < 0.01, "{left} s instead of {wanted} s");
        assert_near!(pace.steps(), 1.0, 1e-12);
    }

    #[test]
    fn times_have_the_unit_of_the_end() {
        assert_eq!(time_of(35.12e-6, 120e-6), "35.120 of 120 us");
        assert_eq!(time_of(0.0, 1e-3), "0.000 of 1 ms");
        assert_eq!(time_of(7.0, 3600.0), "7.000 of 3600 s");
        assert_eq!(time_of(0.5e-13, 2.5e-13), "0.050 of 0.25 ps");
    }

    #[test]
    fn clocks() {
        assert_eq!(clock(59.6), "1:00");
        assert_eq!(clock(3725.0), "1:02:05");
    }
}
