//! A session before the dashboard: reads the folder, draws, listens to keys, until the run ends or the user leaves.

use std::collections::BTreeSet;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use agglo::run::{Progress, Summary};
use agglo::text::visible;
use agglo_view::watch::{Follower, Sight, WatchError};
use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

use super::cells::Depth;
use super::portrait::Portrait;
use super::screen::{Screen, picture_area};
use crate::progress::{Pace, columns, part, state};
use crate::run::Companion;
use crate::{Failure, print};

/// How often the folder is read.
const LOOK_EVERY: Duration = Duration::from_millis(500);
/// How long a key may wait.
const KEYS_EVERY: Duration = Duration::from_millis(100);
/// How often a line is written where there is no terminal.
const LINE_EVERY: Duration = Duration::from_secs(5);
/// After this time without news the run may have stopped.
const QUIET: Duration = Duration::from_secs(30);
const KEYS: &str = "q leave   c color   arrows turn   Ctrl-C leave";
const GUEST_KEYS: &str = "q plain bar   c color   arrows turn   Ctrl-C stop the run";

/// Why a session ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Leave {
    /// The run has finished, or whoever runs it says that it is over.
    Over,
    /// The user left.
    Quit,
    /// The user pressed Ctrl-C.
    Stop,
}

/// Watches the run in a folder.
pub(crate) fn watch(dir: &Path) -> Result<(), Failure> {
    crate::read::folder(dir)?;
    if agglo::search::campaign::is_one(dir) {
        let shown = dir.display();
        let best = if dir.join("best").is_dir() { format!(", such as {shown}/best") } else { String::new() };
        let message = format!("error: {shown} is a search or study; watch follows single runs{best}");
        return Err(Failure::bad_input(message));
    }
    let follower = Follower::open(dir).map_err(|error| refused(&error))?;
    let finished =
        if io::stdout().is_terminal() { sit_at_terminal(follower)? } else { write_lines(follower)? };
    let shown = dir.display();
    match finished {
        Some(summary) => print(&format!("{}\nthe run in {shown} has finished", columns(&summary.table()))),
        None => print(&format!("left; `agglo watch {shown}` looks on, the run is not touched")),
    }
}

fn refused(error: &WatchError) -> Failure {
    let message = format!("error: {error}");
    match error {
        WatchError::NoRun { .. } | WatchError::Scenario { .. } => Failure::bad_input(message),
        WatchError::Record(_) => Failure::failed(message),
    }
}

fn sit_at_terminal(follower: Follower) -> Result<Option<Summary>, Failure> {
    let mut dashboard = Dashboard::new(follower, KEYS);
    dashboard.look();
    if dashboard.sight.summary.is_none() {
        dashboard.sit(&Shared::default()).map_err(|error| no_terminal(&error))?;
    }
    Ok(dashboard.sight.summary)
}

fn no_terminal(error: &io::Error) -> Failure {
    Failure::failed(format!("error: the terminal cannot be used: {error}"))
}

/// A line every few seconds, until the run has finished.
fn write_lines(mut follower: Follower) -> Result<Option<Summary>, Failure> {
    let (mut pace, mut written, mut news) = (None, None, News::new());
    loop {
        let sight = follower.look().map_err(|error| refused(&error))?;
        if sight.summary.is_some() {
            return Ok(sight.summary);
        }
        news.take(&sight);
        if written.is_none_or(|at: Instant| at.elapsed() >= LINE_EVERY)
            && let Some(line) = news.line(|| {
                let progress = progress_of(&follower, &sight);
                line(&progress, paced(&mut pace, &progress), &sight)
            })
        {
            written = Some(Instant::now());
            match writeln!(io::stdout(), "{}", visible(&line)) {
                // A reader that closed the pipe has seen enough.
                Err(error) if error.kind() == io::ErrorKind::BrokenPipe => return Ok(None),
                Err(error) => return Err(Failure::failed(format!("error: cannot write: {error}"))),
                Ok(()) => {}
            }
        }
        std::thread::sleep(LOOK_EVERY);
    }
}

/// When the newest row came, and what was said of it.
struct News {
    time: Option<f64>,
    at: Instant,
    said: Said,
}

/// What was said since the newest row came.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Said {
    Nothing,
    Row,
    Quiet,
}

impl News {
    fn new() -> Self {
        Self { time: None, at: Instant::now(), said: Said::Nothing }
    }

    fn take(&mut self, sight: &Sight) {
        if self.time != Some(sight.time) {
            *self = Self { time: Some(sight.time), ..Self::new() };
        }
    }

    /// What is said where the folder has been quiet for long.
    fn quiet(&self) -> Option<String> {
        let quiet = self.at.elapsed();
        let seconds = quiet.as_secs();
        (quiet >= QUIET).then(|| format!("nothing new for {seconds} s: the run is slow, or has stopped"))
    }

    /// A line about what is new; where nothing has been for long, once that nothing is.
    fn line(&mut self, text: impl FnOnce() -> String) -> Option<String> {
        let (line, said) = match self.said {
            Said::Nothing => (Some(text()), Said::Row),
            Said::Row => (self.quiet(), Said::Quiet),
            Said::Quiet => (None, Said::Quiet),
        };
        if line.is_some() {
            self.said = said;
        }
        line
    }
}

/// " 31 %  0.310 of 1 s, 812 steps/s, 0:04 left: clusters 12, mean speed 3 mm/s".
fn line(progress: &Progress, pace: &Pace, sight: &Sight) -> String {
    let quantities: Vec<String> =
        sight.quantities.iter().map(|quantity| format!("{} {}", quantity.name, quantity.text())).collect();
    format!("{:>3.0} %  {}: {}", 100.0 * part(progress), state(progress, pace), quantities.join(", "))
}

/// What the folder tells, as a run would tell it.
fn progress_of(follower: &Follower, sight: &Sight) -> Progress {
    Progress {
        time: sight.time,
        end: follower.end(),
        step: sight.step,
        steps_are: follower.steps_are(),
        now: String::new(),
        warnings: Vec::new(),
    }
}

/// The pace with this report taken into account, where it brings news.
fn paced<'a>(pace: &'a mut Option<(Pace, Instant)>, progress: &Progress) -> &'a Pace {
    let (pace, begun) = pace.get_or_insert_with(|| (Pace::from(progress, 0.0), Instant::now()));
    pace.note(progress, begun.elapsed().as_secs_f64());
    pace
}

/// What a run and its dashboard tell each other.
#[derive(Debug, Default)]
struct Shared {
    /// The newest report and all warnings, each wording once.
    told: Mutex<(Option<Progress>, Vec<String>)>,
    /// The run is over: the dashboard must leave.
    is_over: AtomicBool,
}

/// A dashboard beside the run of this same program.
pub(crate) struct Guest {
    shared: Arc<Shared>,
    warned: BTreeSet<String>,
    session: Option<JoinHandle<io::Result<()>>>,
}

impl Guest {
    /// Opens the dashboard of the run in a folder, as soon as the run has made it. `stop` is what Ctrl-C sets.
    pub fn new(dir: &Path, stop: Arc<AtomicBool>) -> Self {
        let (dir, shared) = (dir.to_owned(), Arc::new(Shared::default()));
        let seen = Arc::clone(&shared);
        let session = std::thread::spawn(move || {
            let Some(follower) = wait_for(&dir, &seen) else { return Ok(()) };
            let sit = || Dashboard::new(follower, GUEST_KEYS).sit(&seen);
            // Drawing must not wait for the run's threads, all of which may be busy until the run ends.
            let leave = match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
                Ok(pool) => pool.install(sit),
                Err(error) => Err(io::Error::other(error)),
            };
            if matches!(leave, Ok(Leave::Stop)) {
                stop.store(true, Ordering::Relaxed);
            }
            leave.map(|_| ())
        });
        Self { shared, warned: BTreeSet::new(), session: Some(session) }
    }
}

impl Companion for Guest {
    fn tell(&mut self, progress: &Progress) -> bool {
        let fresh: Vec<String> = progress
            .warnings
            .iter()
            .filter(|warning| self.warned.insert((*warning).clone()))
            .cloned()
            .collect();
        if let Ok(mut told) = self.shared.told.lock() {
            told.0 = Some(progress.clone());
            told.1.extend(fresh);
        }
        self.session.as_ref().is_some_and(|session| !session.is_finished())
    }

    fn close(mut self: Box<Self>) -> io::Result<()> {
        self.shared.is_over.store(true, Ordering::Relaxed);
        match self.session.take().map(JoinHandle::join) {
            Some(Ok(ended)) => ended,
            Some(Err(_)) => Err(io::Error::other("it broke off")),
            None => Ok(()),
        }
    }
}

/// The run's folder, once it is there; nothing if the run is over before.
fn wait_for(dir: &Path, shared: &Shared) -> Option<Follower> {
    while !shared.is_over.load(Ordering::Relaxed) {
        // The tables are made right after the scenario.
        if let (true, Ok(follower)) = (dir.join("series").is_dir(), Follower::open(dir)) {
            return Some(follower);
        }
        std::thread::sleep(KEYS_EVERY);
    }
    None
}

/// What is known and shown.
struct Dashboard {
    follower: Follower,
    sight: Sight,
    portrait: Portrait,
    pace: Option<(Pace, Instant)>,
    news: News,
    trouble: Option<String>,
    keys: &'static str,
}

impl Dashboard {
    fn new(follower: Follower, keys: &'static str) -> Self {
        Self {
            portrait: Portrait::new(follower.dir()),
            follower,
            sight: Sight::default(),
            pace: None,
            news: News::new(),
            trouble: None,
            keys,
        }
    }

    /// Reads the folder.
    fn look(&mut self) {
        match self.follower.look() {
            Ok(sight) => {
                self.news.take(&sight);
                (self.sight, self.trouble) = (sight, None);
            }
            // A file may be in the middle of being cut back; it is shown as long as it lasts.
            Err(error) => self.trouble = Some(error.to_string()),
        }
    }

    /// Until the run has finished or the user leaves.
    fn sit(&mut self, shared: &Shared) -> io::Result<Leave> {
        let mut terminal = ratatui::try_init()?;
        let leave = self.go_on(&mut terminal, shared);
        ratatui::try_restore()?;
        leave
    }

    fn go_on(&mut self, terminal: &mut DefaultTerminal, shared: &Shared) -> io::Result<Leave> {
        let depth = Depth::of_terminal();
        let mut looked = None;
        loop {
            if looked.is_none_or(|at: Instant| at.elapsed() >= LOOK_EVERY) {
                self.look();
                looked = Some(Instant::now());
            }
            if self.sight.summary.is_some() || shared.is_over.load(Ordering::Relaxed) {
                return Ok(Leave::Over);
            }
            let area = picture_area(terminal.size()?.into());
            self.portrait.update([u32::from(area.width), 2 * u32::from(area.height)]);
            self.draw(terminal, shared, depth)?;
            if event::poll(KEYS_EVERY)?
                && let Event::Key(key) = event::read()?
                && let Some(leave) = self.press(key)
            {
                return Ok(leave);
            }
        }
    }

    fn draw(&mut self, terminal: &mut DefaultTerminal, shared: &Shared, depth: Depth) -> io::Result<()> {
        let told = shared.told.lock().map(|told| told.clone()).unwrap_or_default();
        let (progress, mut notes) = (told.0, told.1);
        let progress = progress.unwrap_or_else(|| progress_of(&self.follower, &self.sight));
        let state = state(&progress, paced(&mut self.pace, &progress));
        for note in &mut notes {
            *note = format!("warning: {note}");
        }
        notes.extend(self.news.quiet());
        notes.extend(self.trouble.iter().chain(&self.portrait.trouble).cloned());
        let screen = Screen {
            title: self.follower.title(),
            part: part(&progress),
            state: &state,
            sight: &self.sight,
            picture: self.portrait.shown(),
            depth,
            notes: &notes,
            keys: self.keys,
        };
        terminal.draw(|frame| screen.draw(frame))?;
        Ok(())
    }

    /// What a key does; an answer if it ends the session.
    fn press(&mut self, key: KeyEvent) -> Option<Leave> {
        if key.kind == KeyEventKind::Release {
            return None;
        }
        match key.code {
            KeyCode::Char('c') if key.modifiers.contains(KeyModifiers::CONTROL) => return Some(Leave::Stop),
            KeyCode::Char('q') | KeyCode::Esc => return Some(Leave::Quit),
            KeyCode::Char('c') => self.portrait.next_color(),
            KeyCode::Left => self.portrait.turn(-1.0, 0.0),
            KeyCode::Right => self.portrait.turn(1.0, 0.0),
            KeyCode::Up => self.portrait.turn(0.0, 1.0),
            KeyCode::Down => self.portrait.turn(0.0, -1.0),
            _ => {}
        }
        None
    }
}
