//! Guests of a run that writes a folder: forces of the caller's own, measures that get a table, a rule that ends the run, and other
//! domains that help.
//!
//! # Example
//! How far the farthest grain is from the origin, in `series/own.csv`, until that is more than a meter:
//! ```
//! use std::ops::ControlFlow;
//!
//! use agglo::run::{Guests, Look, Onlooker, Sight, run_with};
//!
//! struct Spread;
//!
//! impl Onlooker for Spread {
//!     fn measures(&self) -> Vec<String> {
//!         vec!["spread_m".to_owned()]
//!     }
//!
//!     fn has_rule(&self) -> bool {
//!         true
//!     }
//!
//!     fn look(&mut self, now: &Sight<'_>) -> Result<Look, String> {
//!         let places = now.grains.position.iter();
//!         let spread = places.map(|place| place.norm()).fold(0.0, f64::max);
//!         Ok(Look { values: vec![spread], is_over: spread > 1.0 })
//!     }
//! }
//!
//! # let text = agglo::scenario::template("acoustic").unwrap().text;
//! # let small = ["grains.0.placement.random.count=20", "time.end=0.1 ms"];
//! # let scenario = agglo::scenario::Scenario::with_overrides(text, &small).unwrap();
//! # let folder = tempfile::tempdir().unwrap();
//! # let dir = folder.path().join("run");
//! let mut spread = Spread;
//! let guests = Guests { onlooker: Some(&mut spread), ..Guests::default() };
//! run_with(&scenario, "".as_ref(), &dir, guests, &mut |_| ControlFlow::Continue(())).unwrap();
//! let table = std::fs::read_to_string(dir.join("series/own.csv")).unwrap();
//! assert!(table.starts_with("time_s,spread_m\n0,"));
//! ```

use std::fmt;
use std::num::NonZeroU32;

use serde::{Deserialize, Serialize};

use super::RunError;
use crate::engine::soft::{Hook, Hooks};
use crate::particles::Particles;

/// What is seen of a run.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a> {
    /// Simulated time [s].
    pub time: f64,
    /// The grains. Those of hard spheres stand in the order of their ids, soft ones change places in memory.
    pub grains: &'a Particles,
    /// Of hard spheres: how many primaries each one is of.
    pub primaries: Option<&'a [u32]>,
}

/// What a look at a run came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    /// The measures in the order of their names; not a number where there is none.
    pub values: Vec<f64>,
    /// Whether the run is to end here, as if its end were now.
    pub is_over: bool,
}

/// Who looks at a run whenever a row of its tables is due, at the first and the last one too.
///
/// A checkpoint does not have what it remembers: for the same files after a stop, let its looks follow from what it sees.
pub trait Onlooker: Send {
    /// Names of its measures, the columns of `series/own.csv`: letters, digits and underscores, with the unit at the end.
    fn measures(&self) -> Vec<String> {
        Vec::new()
    }

    /// Whether a look may end the run.
    fn has_rule(&self) -> bool {
        false
    }

    /// Looks.
    ///
    /// # Errors
    /// Why it cannot, in words: the run then stops with a checkpoint, and with nothing where it has not begun.
    fn look(&mut self, now: &Sight<'_>) -> Result<Look, String>;
}

/// The guests of a run. Whoever goes on with it hands over the same.
#[derive(Default)]
pub struct Guests<'a> {
    /// Forces on soft spheres, which add up; from the moment at which the clock starts, not while grains come to rest. A
    /// checkpoint does not have what they remember: let them follow from time, grains and motion.
    pub forces: Vec<Box<dyn Hook>>,
    /// Who takes measures, or ends the run.
    pub onlooker: Option<&'a mut dyn Onlooker>,
    /// Over how many domains soft spheres are spread; see [`link`](crate::link). Results do not depend on it: whoever goes on may take
    /// another number. One if left out.
    pub domains: Option<NonZeroU32>,
}

impl fmt::Debug for Guests<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", self.known())
    }
}

impl Guests<'_> {
    /// What checkpoints know of them.
    pub(super) fn known(&self) -> Known {
        let looks = self
            .onlooker
            .as_ref()
            .map(|onlooker| Looks { measures: onlooker.measures(), has_rule: onlooker.has_rule() });
        Known { forces: self.forces.iter().map(|force| force.name().to_owned()).collect(), looks }
    }

    /// Over how many domains the run is spread.
    pub(super) fn domains(&self) -> usize {
        self.domains.map_or(1, NonZeroU32::get) as usize
    }

    /// Refuses what cannot take part in such a run.
    ///
    /// # Errors
    /// [`RunError::Guests`].
    pub(super) fn check(&self, is_hard: bool) -> Result<Known, RunError> {
        let domains = self.domains();
        let why = if is_hard {
            "events of hard spheres come one after the other"
        } else if !self.forces.is_empty() {
            "the other domains do not know of forces of the caller's own"
        } else {
            return self.known().check(is_hard);
        };
        if domains > 1 {
            let reason = format!("{domains} domains: {why}; run it with one domain");
            return Err(RunError::Guests { reason });
        }
        self.known().check(is_hard)
    }

    /// The forces as one, if there are some.
    pub(super) fn take_forces(&mut self) -> Option<Box<dyn Hook>> {
        let mut forces = std::mem::take(&mut self.forces);
        if forces.len() > 1 { Some(Box::new(Hooks::new(forces))) } else { forces.pop() }
    }
}

/// What a checkpoint knows of an onlooker.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Looks {
    /// Names of its measures.
    pub measures: Vec<String>,
    /// Whether it may end the run.
    pub has_rule: bool,
}

/// What a checkpoint knows of the guests of its run.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Known {
    /// Names of the forces.
    pub forces: Vec<String>,
    /// What is looked at.
    pub looks: Option<Looks>,
}

impl Known {
    /// Refuses what cannot be the guests of such a run.
    ///
    /// # Errors
    /// [`RunError::Guests`].
    pub fn check(self, is_hard: bool) -> Result<Self, RunError> {
        match self.fault(is_hard) {
            Some(reason) => Err(RunError::Guests { reason }),
            None => Ok(self),
        }
    }

    fn fault(&self, is_hard: bool) -> Option<String> {
        if is_hard && !self.forces.is_empty() {
            let help = "leave it out; measures and rules are for hard spheres as well";
            return Some(format!(
                "{self}: forces act on soft spheres, and this scenario has hard ones; {help}"
            ));
        }
        let measures = self.measures();
        measures.iter().enumerate().find_map(|(at, name)| {
            let odd = name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
            let what = if odd {
                "letters, digits and underscores are allowed, with the unit at the end, such as spread_m"
            } else if name == TIME {
                "the table has the time already; leave it out"
            } else if measures[..at].contains(name) {
                "two measures have this name; give one of them another"
            } else {
                return None;
            };
            Some(format!("the measure {name:?}: {what}"))
        })
    }

    /// Names of the measures.
    pub fn measures(&self) -> &[String] {
        self.looks.as_ref().map_or(&[], |looks| &looks.measures)
    }

    /// Names of the columns of their table, which is there if there are measures.
    pub fn columns(&self) -> Vec<&str> {
        std::iter::once(TIME).chain(self.measures().iter().map(String::as_str)).collect()
    }
}

/// The first column of their table.
const TIME: &str = "time_s";

impl fmt::Display for Known {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts: Vec<String> = self.forces.iter().map(|name| format!("the force {name:?}")).collect();
        if let Some(Looks { measures, has_rule }) = &self.looks {
            parts.extend(measures.iter().map(|name| format!("the measure {name}")));
            parts.extend(has_rule.then(|| "a rule that ends it".to_owned()));
            if parts.is_empty() {
                parts.push("an onlooker".to_owned());
            }
        }
        let words =
            if parts.is_empty() { "nothing of the caller's own".to_owned() } else { parts.join(", ") };
        write!(formatter, "{words}")
    }
}
