//! A simulation of soft spheres: one step after another, with rays, bonds, the ledger and the guards.

use serde::{Deserialize, Serialize};

use crate::contact::Bonds;
use crate::contact::network::{BondEvent, Network};
use crate::engine::{Moment, SimError, Start, Warnings};
use crate::ledger::{Ledger, Opening};
use crate::math::rounding_of_sum;

use super::crew::Crew;
use super::faces::{Absorbed, EndFaces};
use super::forces::laws::Laws;
use super::forces::truncation::Truncation;
use super::rays::Pulses;
use super::settings::Settings;
use super::step::change::Change;
use super::step::step_size::{self, Fast, Paces};
use super::step::tempo::Tempo;
use super::step::{staggered, verlet};
use super::system::System;
use super::types::{Limits, Scheme};

/// Steps between two sortings of the grains in space. Counted in steps, so that it is the same after a resume.
pub(super) const SORT_EVERY: u64 = 2000;
/// Most steps of single grains between two looks from outside.
const MOST_GRAIN_STEPS: usize = 1 << 22;
/// Part of the time that whoever asks for a moment may allow for rounding.
const ROUND_OFF: f64 = 16.0 * f64::EPSILON;
/// An automatic step below this part of the run would never end it.
const SHORTEST: f64 = 1e-13;

/// Where the simulation stands in time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// Simulated time [s].
    pub time: f64,
    /// What rounding has taken from the sum of the steps since the last pulse [s].
    pub lag: f64,
    /// Accepted steps.
    pub step: u64,
    /// Length of the next step [s], unless a pulse or the end comes first.
    pub next_step: f64,
    /// Length of the last step [s].
    pub last_step: f64,
    /// Iterations since the start (staggered scheme).
    pub iterations: u64,
    /// Rejected tries since the start (staggered scheme).
    pub rejected: u64,
}

impl Clock {
    /// Whether a time [s] is reached, or may be but for rounding.
    fn is_near(&self, time: f64) -> bool {
        self.time + self.lag.abs() + ROUND_OFF * self.time >= time
    }
}

/// A simulation.
#[derive(Debug)]
pub struct Simulation {
    /// Grains, laws, loads.
    pub system: System,
    /// Beams and their rays.
    pub pulses: Pulses,
    /// The ledger.
    pub ledger: Ledger,
    /// Warnings.
    pub warnings: Warnings,
    /// Bonds that broke or were made since they were last taken.
    pub events: Vec<BondEvent>,
    pub(super) clock: Clock,
    pub(super) scheme: Scheme,
    pub(super) limits: Limits,
    /// The automatic step; nothing where the step is given.
    pub(super) tempo: Option<Tempo>,
    /// How fast the laws were at the last look.
    pub(super) paces: Paces,
    /// What the cut-off of the near field left out at the start.
    pub truncation: Option<Truncation>,
    /// Steps between two sortings of the grains.
    pub(super) sort_every: u64,
    pub(super) end: f64,
    /// Faces that turn grains back or take them out, where there are some.
    pub(super) faces: Option<EndFaces>,
    /// What has left through them.
    pub(super) absorbed: Absorbed,
    /// Whether the loads have those of a hook in them.
    pub(super) is_hooked: bool,
    /// The other domains, if the run is spread over several.
    pub(super) crew: Crew,
}

impl Simulation {
    /// Grains under their laws, at time zero.
    pub(super) fn with(settings: &Settings, start: Start) -> Self {
        let space = settings.space();
        let network = Network::start(settings.beam(), start.bonds, &start.grains, &space);
        let laws = Laws::new(settings, &start.grains);
        let space_in_time = settings.space_in_time(&start.grains);
        let mut system = System::new(start.grains, laws, network, (space_in_time, 0.0));
        if !start.contacts.is_empty() {
            system.remember(&start.contacts);
        }
        system.take_over_walls(&start.walls);
        system.sort_in_space();
        Self::at_zero(settings, system)
    }

    /// The same grains, contacts and bonds, at time zero under other laws.
    pub(super) fn restarted(self, settings: &Settings) -> Self {
        let mut system = self.system;
        let space_in_time = settings.space_in_time(&system.grains);
        system.change_laws(Laws::new(settings, &system.grains), space_in_time);
        Self::at_zero(settings, system)
    }

    fn at_zero(settings: &Settings, mut system: System) -> Self {
        let pulses = Pulses::new(settings, &system.grains);
        system.rays_are_impulses = pulses.are_impulses();
        system.list_neighbors();
        let first = step_size::first(settings, &system);
        let clock = Clock {
            time: 0.0,
            lag: 0.0,
            step: 0,
            next_step: first,
            last_step: first,
            iterations: 0,
            rejected: 0,
        };
        system.evaluate_start(first);
        Self {
            tempo: settings.tempo(),
            truncation: None,
            paces: Paces::new(&system, Some(settings.limits.strain), 0.0),
            system,
            pulses,
            ledger: Ledger::default(),
            warnings: Warnings::default(),
            events: Vec::new(),
            clock,
            scheme: settings.scheme.clone(),
            limits: settings.limits.clone(),
            sort_every: SORT_EVERY,
            end: settings.end,
            faces: EndFaces::of(settings.volume.as_ref()),
            absorbed: Absorbed::default(),
            is_hooked: false,
            crew: Crew::default(),
        }
    }

    /// What another simulation can start from: grains with their ids, loaded springs and bonds. Rays in flight are left
    /// behind, with a warning.
    pub fn into_start(self) -> Start {
        let rays = self.pulses.flight().rays().len();
        let left = "rays were in flight in the run that this one starts from, and are left behind";
        let warnings = if rays > 0 { vec![format!("{rays} {left}")] } else { Vec::new() };
        let (network, contacts) = (&self.system.network, self.system.remembered());
        let bonds = network.is_active().then(|| network.bonds().to_vec());
        let walls = self.system.springs_at_walls();
        Start { contacts, walls, bonds, warnings, ..Start::from(self.system.grains) }
    }

    /// Where the simulation stands in time.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Whether the end is reached.
    pub fn is_finished(&self) -> bool {
        self.clock.time >= self.end
    }

    /// Simulated time at the end [s].
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Makes one step: rays fly, grains move, bonds break, the ledger is kept.
    ///
    /// # Errors
    /// [`SimError`] where the step does not converge or passes a limit; the grains are then where they were before the
    /// step, while rays may have flown on.
    pub fn step(&mut self) -> Result<(), SimError> {
        self.advance(f64::NEG_INFINITY)
    }

    /// Makes some steps, at least one, and none from a time [s] on: as many as grains can fly on without a look at them. They have the
    /// same bits as one by one, and take less time.
    ///
    /// # Errors
    /// As [`Simulation::step`].
    pub fn advance(&mut self, until: f64) -> Result<(), SimError> {
        self.set_out(until)?;
        let mut left = MOST_GRAIN_STEPS / self.system.grains.len().max(1);
        loop {
            left = left.saturating_sub(1);
            let made = self.make_step(if left > 0 { until } else { f64::NEG_INFINITY });
            if made.is_err() {
                self.system.fall_back();
                self.system.move_space(self.clock.time, self.clock.time);
            }
            made?;
            if self.system.afloat.is_none() {
                return Ok(());
            }
        }
    }

    fn make_step(&mut self, until: f64) -> Result<(), SimError> {
        self.warn_of_lost_hook();
        self.sort_grains_when_due();
        let (dt, lands_on) = self.next_step();
        self.launch_due(dt)?;
        self.pulses.fly(&mut self.system, self.clock.time, dt, &mut self.warnings);
        let step = self.try_step(dt);
        self.hook_fault().map_or(Ok(()), Err)?;
        let step = step?;
        self.guard(&step)?;
        let ends_at = self.clock.time + step.dt;
        self.advance_clock(&step, dt, lands_on);
        self.end_step(&step, ends_at, until);
        self.book(&step);
        self.system.commit();
        self.change_bonds();
        self.end_at_faces()?;
        self.system.tell_hook(self.clock.time);
        self.look_when_due()
    }

    /// Brings the grains to where the step led, or right on into the next one where nobody looks at them in between.
    fn end_step(&mut self, step: &Step, time: f64, until: f64) {
        if matches!(self.scheme, Scheme::Staggered(_)) {
            self.system.settle();
        } else if !self.clock.is_near(until) && self.flies_on() {
            let (next, _) = self.next_step();
            self.system.fly_on(time, step.dt, next);
        } else {
            self.system.finish(time, step.dt);
        }
    }

    /// Whether the next step can begin without a look at the grains.
    fn flies_on(&self) -> bool {
        self.faces.is_none()
            && self.system.flies_freely()
            && self.pulses.since(self.clock.time).is_none()
            && !self.sorting_is_due()
            && !self.look_is_due()
    }

    fn sorting_is_due(&self) -> bool {
        self.clock.step > 0 && self.clock.step.is_multiple_of(self.sort_every)
    }

    fn sort_grains_when_due(&mut self) {
        if self.sorting_is_due()
            && let Some(place) = self.system.sort_in_space()
        {
            self.pulses.reindex(&place);
        }
    }

    fn launch_due(&mut self, dt: f64) -> Result<(), SimError> {
        let moment = self.moment(dt);
        self.pulses.launch_due(&self.system.grains, &moment, self.end, &mut self.warnings)
    }

    /// Length of the next step [s] and, if a pulse or the end bounds it, the time on which it lands.
    fn next_step(&self) -> (f64, Option<f64>) {
        let now = self.clock.time;
        let wanted = self.clock.next_step.min(self.pulses.longest_step(now));
        let event = self.pulses.next_launch(now).map_or(self.end, |launch| launch.min(self.end));
        if now + self.clock.lag + wanted * (1.0 + 1e-9) >= event {
            (event - now, Some(event))
        } else {
            (wanted, None)
        }
    }

    fn try_step(&mut self, dt: f64) -> Result<Step, SimError> {
        let time = self.clock.time;
        match &self.scheme {
            Scheme::Staggered(scheme) => {
                let accepted = staggered::step(&mut self.system, scheme, time, dt)
                    .map_err(|trouble| self.not_converged(&trouble))?;
                self.clock.iterations += u64::from(accepted.iterations);
                self.clock.rejected += u64::from(accepted.rejected);
                Ok(Step {
                    dt: accepted.dt,
                    next: accepted.next,
                    change: accepted.change,
                    phi: scheme.implicitness,
                })
            }
            Scheme::Verlet(_) => self.try_verlet(dt),
        }
    }

    /// A step of `dt` [s], or a shorter one where an automatic step would lead to where it is much too long.
    fn try_verlet(&mut self, dt: f64) -> Result<Step, SimError> {
        let mut dt = dt;
        let mut change = verlet::step(&mut self.system, self.clock.time, dt);
        loop {
            let Some(mut tempo) = self.tempo else {
                return Ok(Step { dt, next: self.clock.next_step, change, phi: 0.5 });
            };
            let paces = self.paces.with_fast(Fast::at_trial(&mut self.system, self.limits.strain));
            let critical = paces.total().critical_step();
            if tempo.wanted(critical) < SHORTEST * self.end {
                let (at, law) = (self.moment(dt), paces.fastest());
                return Err(SimError::TooFast { at, law, wanted: tempo.wanted(critical) });
            }
            if let Some(shorter) = tempo.shorter(dt, critical) {
                change = verlet::again(&mut self.system, self.clock.time, dt, shorter);
                dt = shorter;
                self.clock.rejected += 1;
                continue;
            }
            let next = tempo.next(self.clock.next_step, critical, self.clock.step + 1);
            self.tempo = Some(tempo);
            return Ok(Step { dt, next, change, phi: 0.5 });
        }
    }

    fn book(&mut self, step: &Step) {
        let system = &mut self.system;
        system.walls.book(step.phi, step.dt);
        self.ledger.flows.add_step(&system.rates, &system.trial.rates, step.phi, step.dt);
        let rays = self.pulses.book(&self.system, step.dt);
        self.ledger.flows.rays = self.ledger.flows.rays + rays;
    }

    fn advance_clock(&mut self, step: &Step, tried: f64, lands_on: Option<f64>) {
        let clock = &mut self.clock;
        let full = step.dt == tried;
        (clock.time, clock.lag) = match lands_on {
            Some(event) if full => (event, 0.0),
            _ => (clock.time + step.dt, clock.lag + rounding_of_sum(clock.time, step.dt)),
        };
        // A step of the staggered scheme that a pulse cut short says little about the next one.
        let is_cut = full && lands_on.is_some() && matches!(self.scheme, Scheme::Staggered(_));
        clock.next_step = if is_cut { step.next.max(clock.next_step) } else { step.next };
        clock.last_step = step.dt;
        clock.step += 1;
    }

    fn change_bonds(&mut self) {
        let system = &mut self.system;
        let broken = system.break_bonds(self.clock.time);
        self.ledger.flows.broken_bonds += broken.iter().map(|event| event.energy).sum::<f64>();
        self.events.extend(broken);
        let made = system.bond_pressed(self.clock.time);
        if !made.is_empty() {
            self.paces.bonds = system.network.pace(&system.grains);
        }
        self.events.extend(made);
    }

    pub(super) fn moment(&self, dt: f64) -> Moment {
        Moment { step: self.clock.step + 1, time: self.clock.time, dt }
    }

    pub(super) fn acting_laws(&self) -> String {
        let mut names: Vec<&str> = self.system.laws.names();
        names.extend(self.system.hook.as_ref().map(|attached| attached.hook.name()));
        if names.is_empty() { "no law at all".to_owned() } else { names.join(", ") }
    }

    pub(super) fn open_ledger(&mut self) {
        let start = Opening {
            stored: self.stored_energy(),
            momentum: self.momentum(),
            momentum_size: self.momentum_size(),
            mass: self.total_mass(),
        };
        self.ledger = Ledger::of_soft(start, self.system.grains.len());
        for warning in self.system.laws.standing_warnings() {
            self.warnings.add(warning);
        }
        let made = self.system.network.made_at_start();
        let bonds = self.system.laws.bonds.as_ref().and_then(Bonds::lasting);
        if let Some(warning) = bonds.and_then(|law| law.warning(made)) {
            self.warnings.add(warning);
        }
        for warning in self.pulses.standing_warnings() {
            self.warnings.add(warning);
        }
        let smallest = self.system.grains.radius.iter().copied().fold(f64::INFINITY, f64::min);
        for (number, beam) in self.pulses.beams().iter().enumerate() {
            if let Some(warning) = beam.warning(number, &self.system.laws.medium, smallest) {
                self.warnings.add(&warning);
            }
        }
        self.warn_of_drag();
    }
}

/// A step that was tried.
pub(super) struct Step {
    /// Its length [s].
    pub dt: f64,
    /// Length [s] of the next.
    pub next: f64,
    /// How far grains moved.
    pub change: Change,
    /// Part of the loads that counts at its end.
    pub phi: f64,
}
