//! Walls as the simulation knows them: who meets them when, what they hold and how fast they are.

use serde::{Deserialize, Serialize};

use crate::contact::{Bonds, ContactGeometry, ContactLaws};
use crate::engine::validate::{Fault, ensure, finite, length};
use crate::engine::{SimError, SpringAtWall};
use crate::ledger::Supply;
use crate::math::{Pace, Vec3};
use crate::particles::{ById, Motion, Particles};
use crate::walls::{Passed, RememberedAtWall, Wall, WallRates, WallSnapshot, Walls};

use super::forces::laws::Laws;
use super::settings::Settings;
use super::system::System;
use super::types::Breach;

/// What has to be kept of walls in a saved state; where they are follows from time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct WallMemory {
    /// By the ids of the grains.
    contacts: Vec<RememberedAtWall>,
    rates: Vec<WallRates>,
    flows: Vec<Supply>,
}

impl WallMemory {
    /// Whether it can be of grains with these ids and of these walls.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn validate(&self, walls: &[Wall], places: &ById) -> Result<(), Fault> {
        length("walls", self.rates.len(), walls.len())?;
        length("works of walls", self.flows.len(), walls.len())?;
        finite("walls", &(&self.rates, &self.flows))?;
        for (grain, wall, face, spring) in &self.contacts {
            let faces = walls.get(*wall as usize).map_or(0, |wall| wall.shape.faces());
            ensure(places.find(*grain).is_some() && *face < faces, || {
                format!("contact of {grain} with face {face} of wall {wall}")
            })?;
            finite("contact with a wall", spring)?;
        }
        Ok(())
    }
}

/// A wall and what it has done so far.
#[derive(Clone, Copy, Debug)]
pub struct WallState<'a> {
    /// Its name.
    pub name: &'a str,
    /// Force [N] of all grains on it.
    pub force: Vec3,
    /// Their torque [N m] about the point that it turns about.
    pub torque: Vec3,
    /// Work [J] that it has put in since the start.
    pub work: f64,
    /// Contacts with grains.
    pub contacts: u32,
    /// Grains beyond a plane with an opening; nothing of other walls.
    pub passed: Option<Passed>,
}

impl System {
    /// What has to be kept of walls in a saved state.
    pub(super) fn wall_memory(&self) -> WallMemory {
        let walls = &self.walls;
        WallMemory {
            contacts: self.walls_remembered_at(|grain| Some(self.grains.id[grain as usize])),
            rates: walls.rates().to_vec(),
            flows: walls.flows().to_vec(),
        }
    }

    /// The springs of contacts with walls, by the names of these.
    pub(super) fn springs_at_walls(&self) -> Vec<SpringAtWall> {
        let named = |(grain, wall, face, spring): RememberedAtWall| {
            let wall = self.laws.walls.name(wall as usize).to_owned();
            SpringAtWall { grain, wall, face, spring }
        };
        self.walls.remembered().into_iter().map(named).collect()
    }

    /// Takes over springs of contacts with walls of the same names, where these have such faces; before the first step.
    pub(super) fn take_over_walls(&mut self, springs: &[SpringAtWall]) {
        let walls = &self.laws.walls;
        let known = springs.iter().filter_map(|of| {
            let wall = (0..walls.len()).find(|wall| walls.name(*wall) == of.wall)? as u32;
            let holds = of.face < walls.faces(wall) && (of.grain as usize) < self.grains.len();
            holds.then_some((of.grain, wall, of.face, of.spring))
        });
        let known: Vec<RememberedAtWall> = known.collect();
        self.remember_walls(&known, Some(0.0));
    }

    /// Goes on with what was kept, at a time [s].
    pub(super) fn resume_walls(&mut self, memory: WallMemory, places: &ById, time: f64) {
        self.walls.resume(memory.rates, memory.flows);
        let placed = memory
            .contacts
            .into_iter()
            .filter_map(|(grain, wall, face, spring)| Some((places.find(grain)? as u32, wall, face, spring)));
        self.remember_walls(&placed.collect::<Vec<_>>(), Some(time));
    }

    /// What contacts with walls remember, each grain under the number that it has here: a new place, or its id. Those without one are
    /// gone.
    pub(super) fn walls_remembered_at(&self, number: impl Fn(u32) -> Option<u32>) -> Vec<RememberedAtWall> {
        let moved =
            |(grain, wall, face, spring): RememberedAtWall| Some((number(grain)?, wall, face, spring));
        self.walls.remembered().into_iter().filter_map(moved).collect()
    }

    /// Puts back what contacts with walls remember, and lists grains near walls anew where they are at a time [s]; where none is
    /// given, walls are where they were when grains met them last.
    pub(super) fn remember_walls(&mut self, remembered: &[RememberedAtWall], time: Option<f64>) {
        let Self { walls, laws, grains, records, .. } = self;
        let time = time.unwrap_or(walls.time());
        walls.list(&laws.wall_step(grains, records, [time, 0.0, 0.0]), remembered);
    }

    /// Grains at walls at the committed motion, at its time [s].
    pub(super) fn at_walls(&self, time: f64) -> WallSnapshot<'_> {
        self.at_walls_in(self.grains.motion(), time)
    }

    /// The same at the trial motion.
    pub(super) fn pace_at_walls_at_trial(&mut self) -> Pace {
        if self.laws.walls.is_empty() {
            return Pace::NONE;
        }
        self.look_at_trial();
        self.at_walls_in(self.trial.motion(), self.walls.time()).pace()
    }

    fn at_walls_in<'a>(&'a self, now: Motion<'a>, time: f64) -> WallSnapshot<'a> {
        let Self { laws, walls, grains, .. } = self;
        WallSnapshot {
            walls: &laws.walls,
            contacts: walls,
            laws: laws.contact.as_ref(),
            bond: laws.bonds.as_ref().and_then(Bonds::in_contact),
            pairs: &laws.pairs,
            grains,
            now,
            time,
        }
    }

    /// How fast contacts with walls are that reach a strain, and walls themselves.
    pub(super) fn wall_pace(&self, strain: f64) -> Pace {
        let Laws { walls, contact, pairs, .. } = &self.laws;
        let Some(laws) = contact.as_ref().map(ContactLaws::bounded).filter(|_| !walls.is_empty()) else {
            return Pace::NONE;
        };
        let (grains, kinds) = (&self.grains, walls.kinds());
        let fastest = self.over_grains(|at| {
            let with = |(material, stiffness): &(u32, f64)| {
                let radius = grains.radius[at];
                let geometry = ContactGeometry::at_wall(
                    radius,
                    grains.mass[at],
                    [grains.contact_stiffness[at], *stiffness],
                    radius * (1.0 - strain),
                );
                laws.pace(pairs.of(grains.material[at], *material), &geometry)
            };
            kinds.iter().map(with).fold(Pace::NONE, Pace::max)
        });
        fastest.max(walls.pace())
    }

    /// Each wall with what it does and has done, at a time [s].
    pub fn wall_states(&self, time: f64) -> impl Iterator<Item = WallState<'_>> {
        let walls = &self.laws.walls;
        let done = self.walls.rates().iter().zip(self.walls.flows()).enumerate();
        done.map(move |(wall, (WallRates { supply, contacts }, flow))| {
            let about = walls.pose(wall, time).center();
            WallState {
                name: walls.name(wall),
                force: -supply.force,
                torque: -(supply.torque - about.cross(supply.force)),
                work: flow.power,
                contacts: *contacts,
                passed: walls.passed(wall, time, &self.grains),
            }
        })
    }
}

/// Refuses grains that are placed in a wall.
///
/// # Errors
/// [`SimError::InWall`].
pub fn refuse_grains_in_walls(settings: &Settings, grains: &Particles) -> Result<(), SimError> {
    let walls = Walls::new(&settings.walls, &settings.materials, settings.end);
    let part = match settings.limits.on_breach {
        Breach::Stop => settings.limits.strain.min(1.0),
        Breach::Warn => 1.0,
    };
    match walls.holding(&grains.position, &grains.radius, part) {
        None => Ok(()),
        Some((grain, wall, overlap)) => Err(SimError::InWall {
            grain: grains.id[grain],
            wall: walls.name(wall).into(),
            overlap,
            part: overlap / grains.radius[grain],
            limit: part,
        }),
    }
}
