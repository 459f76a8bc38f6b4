//! A simulation of hard spheres: one of the two drivers, the spheres, the clock and the ledger.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::domain::Boundary;
use crate::engine::soft::Limits;
use crate::engine::validate::{Fault, MOST_COUNTED, ensure, finite};
use crate::engine::{SimError, Start, Warnings};
use crate::impact::ImpactLaws;
use crate::ledger::{Balance, Ledger, Momentum};
use crate::math::Vec3;
use crate::measure::SizeRates;
use crate::particles::{Material, Particles};

use super::collide::{Collapse, HardSystem, HardSystemState};
use super::drive::{Clock, Events, EventsState, Steps};
use super::grown::Grown;
use super::record::{self, Counts};
use super::settings::{self, Settings};
use super::spheres::Spheres;

const UNEXPLAINED: &str = "energy that the ledger of collisions do not explain is above 0.001 of all energy";

/// How the spheres are driven.
#[derive(Clone, Debug)]
enum Driver {
    Events(Box<Events>),
    Steps(Box<Steps>),
}

/// What a driver has to remember.
#[derive(Clone, Debug, Serialize, Deserialize)]
enum DriverState<'a> {
    Events(EventsState<'a>),
    /// Nothing: the next step follows from the spheres.
    Steps,
}

/// All that a simulation needs to go on with the same bits; borrowed where it is written, owned where it is read.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SimulationState<'a> {
    clock: Clock,
    system: Cow<'a, HardSystemState>,
    driver: DriverState<'a>,
    grains_at_start: u64,
    primaries_at_start: u64,
    contact_duration: f64,
}

impl SimulationState<'_> {
    /// Whether a run under these settings can have come to it, but for its driver.
    ///
    /// # Errors
    /// What is wrong with it.
    fn validate(&self, settings: &Settings) -> Result<(), Fault> {
        let (clock, system) = (&self.clock, &*self.system);
        finite("clock", clock)?;
        let times = [clock.time, clock.last_step, self.contact_duration];
        ensure(times.iter().all(|time| *time >= 0.0 && time.is_finite()), || {
            "clock: a time is below 0".to_owned()
        })?;
        ensure(clock.step < MOST_COUNTED, || "clock: too many steps".to_owned())?;
        system.spheres.validate(settings.materials.len(), clock.time)?;
        let living = system.spheres.bulk.iter().filter(|bulk| bulk.lives()).map(|bulk| bulk.primaries);
        let primaries: u64 = living.clone().map(u64::from).sum();
        ensure(primaries == self.primaries_at_start && self.grains_at_start <= primaries, || {
            "there are other grains than at the start".to_owned()
        })?;
        system.rates.validate(&settings.classes, living)?;
        system.collapse.validate()?;
        finite("ledger", &system.ledger)?;
        finite("counts", &system.counts)?;
        system.counts.validate()
    }

    /// Where the simulation stands in time.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }
}

/// The grains at one moment, in the order of their ids.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// The columns.
    pub grains: Particles,
    /// How many primary grains each is made of [n].
    pub primaries: Vec<u32>,
}

/// A simulation.
#[derive(Clone, Debug)]
pub struct Simulation {
    system: HardSystem,
    driver: Driver,
    clock: Clock,
    grains_at_start: u64,
    primaries_at_start: u64,
    end: f64,
}

impl Simulation {
    /// Starts with grains as placed, or with what came out of another simulation.
    ///
    /// # Errors
    /// [`SimError::OtherSpheres`] where the settings come from a scenario of soft spheres; [`SimError::OutOfDigits`] where a
    /// grain is too far out for its size; [`SimError::ForeignVolume`] where the volume has what hard spheres do not know.
    pub fn start<S>(settings: S, start: impl Into<Start>) -> Result<Self, SimError>
    where
        S: TryInto<Settings>,
        SimError: From<S::Error>,
    {
        let Start { grains, grown, warnings, .. } = start.into();
        let mut simulation = Self::begin(settings.try_into()?, &grains, &grown)?;
        for warning in &warnings {
            simulation.system.state.warnings.add(warning);
        }
        Ok(simulation)
    }

    /// Starts with grains that stay with the caller, and what grown ones keep of their parts.
    pub(super) fn begin(settings: Settings, grains: &Particles, grown: &[Grown]) -> Result<Self, SimError> {
        settings.hold_volume()?;
        let heat_capacities: Vec<f64> = settings.materials.values().map(Material::specific_heat).collect();
        let mut spheres = Spheres::new(grains, |material| heat_capacities[material as usize]);
        for (bulk, grown) in spheres.bulk.iter_mut().zip(grown) {
            bulk.primaries = grown.primaries;
            bulk.heat_capacity = grown.heat_capacity;
        }
        let volume = settings.volume.volume();
        let state = HardSystemState {
            ledger: Ledger::of_hard(record::opening(&spheres)),
            counts: Counts::default(),
            rates: SizeRates::new(
                settings.classes.clone(),
                spheres.bulk.iter().map(|bulk| bulk.primaries),
                volume,
            ),
            warnings: Warnings::default(),
            collapse: Collapse::default(),
            spheres,
        };
        let grains_at_start = state.spheres.len() as u64;
        let primaries_at_start = state.spheres.bulk.iter().map(|bulk| u64::from(bulk.primaries)).sum();
        let (clock, end) = (Clock::default(), settings.end);
        let options = settings.driver.clone();
        let mut system = Self::system_of(settings, state);
        for warning in system.laws.standing_warnings() {
            system.state.warnings.add(warning);
        }
        let driver = match &options {
            settings::Driver::EventDriven(options) => {
                system.contact_duration = options.duration(&system.state.spheres, system.volume.boundary);
                Driver::Events(Box::new(Events::start(&mut system)?))
            }
            settings::Driver::TimeStepped(options) => Driver::Steps(Box::new(Steps::new(options))),
        };
        Ok(Self { system, driver, clock, grains_at_start, primaries_at_start, end })
    }

    /// Goes on from a saved state.
    ///
    /// # Errors
    /// [`SimError::Forged`] where the state is none that a run under these settings can have come to; others as
    /// [`Simulation::start`].
    pub fn resume<S>(settings: S, state: SimulationState<'_>) -> Result<Self, SimError>
    where
        S: TryInto<Settings>,
        SimError: From<S::Error>,
    {
        Self::restored(settings.try_into()?, state)
    }

    fn restored(settings: Settings, state: SimulationState<'_>) -> Result<Self, SimError> {
        let forged = |reason| SimError::Forged { reason };
        state.validate(&settings).map_err(forged)?;
        let (end, options) = (settings.end, settings.driver.clone());
        let mut system = Self::system_of(settings, state.system.into_owned());
        system.contact_duration = state.contact_duration;
        let driver = match (&options, state.driver) {
            (settings::Driver::EventDriven(_), DriverState::Events(saved)) => {
                saved.validate(&system, state.clock.time).map_err(forged)?;
                Driver::Events(Box::new(Events::resume(&system, saved)))
            }
            (settings::Driver::TimeStepped(options), DriverState::Steps) => {
                Driver::Steps(Box::new(Steps::new(options)))
            }
            _ => return Err(forged("it is of the other driver of hard spheres".to_owned())),
        };
        let SimulationState { clock, grains_at_start, primaries_at_start, .. } = state;
        Ok(Self { system, driver, clock, grains_at_start, primaries_at_start, end })
    }

    fn system_of(settings: Settings, state: HardSystemState) -> HardSystem {
        HardSystem {
            state,
            laws: ImpactLaws::new(&settings.impact, &settings.materials, &settings.mixtures),
            volume: settings.volume,
            events: Vec::new(),
            descents: Vec::new(),
            keeps_events: true,
            contact_duration: 0.0,
            seed: settings.seed,
            fragments: Vec::new(),
        }
    }

    /// All that is needed to go on with the same bits.
    pub fn state(&self) -> SimulationState<'_> {
        SimulationState {
            clock: self.clock,
            system: Cow::Borrowed(&self.system.state),
            driver: match &self.driver {
                Driver::Events(events) => DriverState::Events(events.state()),
                Driver::Steps(_) => DriverState::Steps,
            },
            grains_at_start: self.grains_at_start,
            primaries_at_start: self.primaries_at_start,
            contact_duration: self.system.contact_duration,
        }
    }

    /// What another simulation can start from: grains with their ids and what they are made of. The times of their last
    /// bounces end here.
    pub fn into_start(self) -> Start {
        Start { grown: self.grown(), ..Start::from(self.snapshot().grains) }
    }

    /// What the grains keep of their parts, in the order of ids [n].
    pub(super) fn grown(&self) -> Vec<Grown> {
        let spheres = &self.system.state.spheres;
        let of = |at: &u32| {
            let bulk = &spheres.bulk[*at as usize];
            Grown { primaries: bulk.primaries, heat_capacity: bulk.heat_capacity }
        };
        spheres.by_id().iter().map(of).collect()
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

    /// Grains at the start.
    pub fn grains_at_start(&self) -> u64 {
        self.grains_at_start
    }

    /// Grains now.
    pub fn grains(&self) -> usize {
        self.system.state.spheres.len()
    }

    /// The spheres with their laws and ledger.
    pub fn system(&self) -> &HardSystem {
        &self.system
    }

    /// The same, for taking events and warnings out.
    pub fn system_mut(&mut self) -> &mut HardSystem {
        &mut self.system
    }

    /// Goes on toward `until` [s], or the end if that is sooner. The event-driven engine stops exactly there, or before
    /// after some thousand events; the time-stepped one makes one step, of a length that does not depend on `until`.
    ///
    /// # Errors
    /// [`SimError`] where the motion is not finite or the clock comes to a halt.
    pub fn advance(&mut self, until: f64) -> Result<(), SimError> {
        let (until, before) = (until.min(self.end), self.clock.step);
        match &mut self.driver {
            Driver::Events(events) => events.advance(&mut self.system, &mut self.clock, until)?,
            Driver::Steps(steps) => steps.step(&mut self.system, &mut self.clock, self.end)?,
        }
        // Seldom enough to cost nothing beside the events.
        let every = (10 * self.grains() as u64).max(1000);
        let is_due = self.clock.step / every != before / every;
        if is_due || self.is_finished() { self.look_at_the_energy() } else { Ok(()) }
    }

    /// Energy that the ledger does not explain is a warning at the end, and soon an error where it is much.
    fn look_at_the_energy(&mut self) -> Result<(), SimError> {
        let limits = Limits::default();
        let balance = self.balance();
        if !balance.is_finite() {
            let laws = self.system.laws.names().join(", ");
            return Err(SimError::HardLedgerNotFinite { time: self.clock.time, laws });
        }
        let part = balance.unexplained();
        if self.is_finished() && part > limits.drift_warning {
            self.system.state.warnings.add(UNEXPLAINED);
        }
        if part > limits.drift_error && self.system.laws.standing_warnings().is_empty() {
            let laws = self.system.laws.names().join(", ");
            return Err(SimError::HardUnexplained { time: self.clock.time, part, laws });
        }
        Ok(())
    }

    /// The grains now. Taking it changes nothing.
    pub fn snapshot(&self) -> Snapshot {
        let (spheres, time) = (&self.system.state.spheres, self.clock.time);
        let mut snapshot = Snapshot::default();
        // A step may leave a grain of an antipodal volume outside.
        let wraps = match self.driver {
            Driver::Events(_) => self.system.volume.boundary.wraps(),
            Driver::Steps(_) => self.system.volume.boundary == Boundary::Periodic,
        };
        for at in spheres.by_id() {
            let mut row = spheres.row(at, time);
            row.temperature = self.system.cooled(at as usize, time).0;
            if wraps {
                row.position = self.system.volume.wrap(row.position);
            }
            snapshot.grains.push(row);
            snapshot.primaries.push(spheres.bulk[at as usize].primaries);
        }
        snapshot
    }

    /// The ledger now.
    pub fn balance(&self) -> Balance {
        let (spheres, time) = (&self.system.state.spheres, self.clock.time);
        let order = spheres.by_id();
        let mut pending = 0.0;
        let stored = record::stored(spheres, &order, |at| {
            let (temperature, given_off) = self.system.cooled(at as usize, time);
            pending += given_off;
            temperature
        });
        self.system.state.ledger.balance(stored, pending)
    }

    /// Momentum [kg m/s] now.
    pub fn momentum(&self) -> Vec3 {
        let spheres = &self.system.state.spheres;
        record::momentum(spheres, &spheres.by_id())
    }

    /// Momentum that walls do not explain, over the sum of the momenta's sizes at the start.
    pub fn momentum_drift_relative(&self) -> f64 {
        let momentum = Momentum { linear: self.momentum(), angular: Vec3::ZERO };
        self.system.state.ledger.momentum_drift_relative(&momentum, 0.0)
    }
}
