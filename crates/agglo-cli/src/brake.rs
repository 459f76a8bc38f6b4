//! What stops a session before its work is done: a signal, or the wall time that it was given.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use agglo::units::{Quantity, Time, parse_quantity};

use crate::Failure;
use crate::signals::{Ear, Late};

/// How long a session may last, counted from the time at which it was told so.
pub(crate) struct WallTime {
    began: Instant,
    /// As it was typed, and in seconds; none for as long as it takes.
    allowed: Option<(String, f64)>,
}

impl WallTime {
    /// Reads what was typed.
    pub(crate) fn of(typed: Option<&str>) -> Result<Self, Failure> {
        let began = Instant::now();
        let Some(text) = typed else { return Ok(Self { began, allowed: None }) };
        let help = "help: write it with its unit, such as \"90 s\", \"30 min\" or \"2 h\"";
        let bad = |reason: String| Failure::bad_input(format!("error: --wall-time: {reason}\n{help}"));
        let time: Time =
            Quantity(parse_quantity(text, Time::DIMENSION).map_err(|error| bad(error.to_string()))?);
        if time.si() > 0.0 {
            Ok(Self { began, allowed: Some((text.trim().to_owned(), time.si())) })
        } else {
            Err(bad(format!("found \"{text}\"; more than 0 is wanted")))
        }
    }

    /// Whether it is over.
    fn is_up(&self) -> bool {
        self.allowed.as_ref().is_some_and(|(_, allowed_s)| self.began.elapsed().as_secs_f64() >= *allowed_s)
    }
}

/// Why a session stops.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Reason {
    /// A signal asked for it.
    Signal,
    /// The wall time, which was given in these words, is up.
    WallTime(String),
}

impl Reason {
    /// Exit code of the program where there is something to go on from.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Signal => 1,
            Self::WallTime(_) => 3,
        }
    }

    /// What is put behind "stopped"; nothing of a signal, which the user has sent.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Signal => String::new(),
            Self::WallTime(allowed) => format!(": the wall time of {allowed} is up"),
        }
    }
}

/// Asked ten times a second whether the session goes on.
pub(crate) struct Brake {
    ear: Ear,
    wall: WallTime,
    /// Whether the session was told to stop since its time is up.
    is_up: bool,
}

impl Brake {
    /// Listens to signals, as [`Ear::open`] does, and keeps an eye on the clock.
    pub(crate) fn open(folder: &Path, wall: WallTime) -> Result<Self, Failure> {
        Ok(Self { ear: Ear::open(Some(folder), Late::GoesOn)?, wall, is_up: false })
    }

    /// Whether to go on.
    pub(crate) fn look(&mut self) -> ControlFlow<()> {
        if self.ear.is_asked() {
            return ControlFlow::Break(());
        }
        self.is_up = self.is_up || self.wall.is_up();
        if self.is_up { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Why a session that stopped has done so.
    pub(crate) fn reason(&self) -> Reason {
        match &self.wall.allowed {
            Some((allowed, _)) if self.is_up => Reason::WallTime(allowed.clone()),
            _ => Reason::Signal,
        }
    }

    /// What hears signals.
    pub(crate) fn ear(&self) -> &Ear {
        &self.ear
    }

    /// The flag that asks for an end.
    pub(crate) fn flag(&self) -> Arc<AtomicBool> {
        self.ear.flag()
    }
}
