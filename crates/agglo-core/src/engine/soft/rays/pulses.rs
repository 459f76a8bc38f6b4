//! Beams in time: when pulses start, how their rays fly along with the grains, and what they do to them.
//!
//! Rays have a clock of their own. In a step they fly the whole of it past grains held still, and the grains then
//! feel the hits in that step. Where the grains' step is cut short, the rays wait until the grains catch up.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::acoustics::{self, Beam, Flight, Hit, NONE, PulseCount};
use crate::engine::validate::{Fault, ensure, finite, length};
use crate::engine::{Moment, SimError, Warnings};
use crate::math::Vec3;
use crate::math::parallel::{self, BLOCK};
use crate::particles::Particles;
use crate::units::Quantity;

use super::flight::validate_flight;
use super::setup::{Setup, dropped, targets, warn_of_drops, warn_of_flight};
use crate::engine::soft::settings::Settings;
use crate::engine::soft::system::System;
use crate::ledger::Supply;

/// A pulse that starts at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Launch {
    time: f64,
    beam: u32,
    pulse: u32,
}

/// What of the pulses changes in time.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct PulseState {
    flight: Flight,
    launched: usize,
    /// Pulses that were asked for besides.
    asked: usize,
    ray_time: f64,
    /// Start of the step in which rays flew last [s].
    flew_at: f64,
    /// What rays gave each wall so far, once they met any.
    given: Vec<WallSound>,
    /// Mean radius of the grains at the start [m].
    mean_radius: f64,
}

/// All beams of a scenario with their rays.
#[derive(Debug)]
pub struct Pulses {
    setup: Option<Setup>,
    state: PulseState,
    schedule: Vec<Launch>,
    hit_grains: Vec<u32>,
    /// Force [N] of the rays on each wall in this step, or impulse [N s], and power [W] that it takes.
    on_walls: Vec<(Vec3, f64)>,
}

/// What rays have given a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WallSound {
    /// Impulse [N s].
    pub impulse: Vec3,
    /// Energy that went into it [J]: power times how long a hit presses.
    pub energy: f64,
}

/// Grains that were hit are made a list without doubles whenever it is as long as this.
const MANY_HITS: usize = 1 << 16;

impl PulseState {
    /// Whether it is one that a scenario's pulses among `n` grains can have come to.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(in crate::engine::soft) fn validate(&self, settings: &Settings, n: usize) -> Result<(), Fault> {
        let times = [self.ray_time, self.flew_at, self.mean_radius];
        ensure(times.iter().all(|value| value.is_finite() && *value >= 0.0), || {
            "pulses: not finite".to_owned()
        })?;
        let pulses = self.flight.pulses().len();
        length("pulses that have started", self.launched.saturating_add(self.asked), pulses)?;
        validate_flight(&self.flight, settings, n)?;
        let known = self.given.is_empty() || self.given.len() == settings.walls.len();
        ensure(known, || format!("rays on {} walls of {}", self.given.len(), settings.walls.len()))?;
        finite("rays on walls", &self.given)?;
        let due = schedule(settings).len();
        ensure(self.launched <= due, || format!("{} pulses have started of {due}", self.launched))
    }
}

/// All launches before the end of the run, in the order of time.
fn schedule(settings: &Settings) -> Vec<Launch> {
    let mut schedule: Vec<Launch> = Vec::new();
    for (acoustics, beam) in settings.acoustics.iter().flat_map(|a| a.beams.iter()).zip(0..) {
        // Those after the end never fly, however many there are.
        let end = settings.end;
        let starts = acoustics.pulses.start_times().take_while(|start| *start < end);
        schedule.extend(starts.zip(0..).map(|(time, pulse)| Launch { time, beam, pulse }));
    }
    schedule.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.beam.cmp(&b.beam)));
    schedule
}

impl Pulses {
    /// The pulses of a scenario, none started.
    pub fn new(settings: &Settings, grains: &Particles) -> Self {
        let mean_radius = parallel::mean(&grains.radius);
        Self::resume(settings, PulseState { mean_radius, ..PulseState::default() })
    }

    /// The pulses of a scenario as they were saved.
    ///
    /// The state has been held to the scenario before.
    pub fn resume(settings: &Settings, state: PulseState) -> Self {
        let schedule = schedule(settings);
        let setup = Setup::new(settings, state.mean_radius);
        Self { setup, state, schedule, hit_grains: Vec::new(), on_walls: Vec::new() }
    }

    /// What is needed to go on with the same bits.
    pub fn state(&self) -> PulseState {
        self.state.clone()
    }

    /// Whether hits give impulses; otherwise forces for one step.
    pub fn are_impulses(&self) -> bool {
        self.setup.as_ref().is_none_or(|setup| setup.acoustics.force.is_impulse())
    }

    /// Time [s] of the next launch after `now`.
    pub fn next_launch(&self, now: f64) -> Option<f64> {
        self.schedule[self.state.launched..].iter().map(|launch| launch.time).find(|time| *time > now)
    }

    /// When the latest pulse started [s], from its launch until its rays are gone.
    pub fn since(&self, now: f64) -> Option<f64> {
        let due = self.schedule[self.state.launched..].first().filter(|launch| launch.time <= now);
        let flight = &self.state.flight;
        let latest = || flight.pulses().last().filter(|_| !flight.rays().is_empty());
        due.map(|launch| launch.time).or_else(|| latest().map(|pulse| pulse.start_s))
    }

    /// Longest step [s] from `now` that the rays allow.
    pub fn longest_step(&self, now: f64) -> f64 {
        let due = self.schedule.get(self.state.launched).is_some_and(|launch| launch.time <= now);
        let flying = due || !self.state.flight.rays().is_empty();
        // The published law presses for one step, whose length it fixes while rays fly.
        let bound =
            self.setup.as_ref().filter(|_| flying && !self.are_impulses()).map(|setup| setup.duration);
        let behind = self.state.ray_time - now;
        let catch_up = if behind > 0.0 { behind } else { f64::INFINITY };
        bound.unwrap_or(f64::INFINITY).min(catch_up)
    }

    /// Launches the pulses whose time has come at a `moment`, in a run until `end` [s].
    ///
    /// # Errors
    /// [`SimError::BeamInGrain`] where rays start inside a grain before any has moved; later that is a warning, and those rays
    /// are dropped.
    pub fn launch_due(
        &mut self,
        grains: &Particles,
        moment: &Moment,
        end: f64,
        warnings: &mut Warnings,
    ) -> Result<(), SimError> {
        let Some(setup) = &mut self.setup else { return Ok(()) };
        let now = moment.time;
        while let Some(launch) = self.schedule.get(self.state.launched).filter(|launch| launch.time <= now) {
            let (beam, flight) = (&setup.acoustics.beams[launch.beam as usize], &mut self.state.flight);
            flight.launch(beam, &setup.medium, setup.seed, launch.beam, launch.pulse);
            self.state.launched += 1;
            let dropped = setup.drop_rays(flight, grains, now);
            if moment.step <= 1 {
                let (at, beam) = (|| moment.clone(), launch.beam);
                if let Some((rays, grain)) = dropped[0] {
                    let grain = grains.id[grain as usize];
                    return Err(SimError::BeamInGrain { at: at(), beam, rays, grain });
                }
                if let Some((rays, wall)) = dropped[1] {
                    let wall = setup.names[wall as usize].clone();
                    return Err(SimError::BeamInWall { at: at(), beam, rays, wall });
                }
            }
            setup.warn_of_launch(launch.beam, (grains, flight), dropped, end - now, warnings);
        }
        Ok(())
    }

    /// Launches a pulse of a beam now, which is not among those that the scenario has; its rays scatter as those of no other.
    ///
    /// # Errors
    /// [`SimError::NoBeam`] where there is no such beam.
    pub fn launch_now(
        &mut self,
        beam: u32,
        grains: &Particles,
        now: f64,
        end: f64,
        warnings: &mut Warnings,
    ) -> Result<(), SimError> {
        let beams = self.setup.as_ref().map_or(0, |setup| setup.acoustics.beams.len());
        let Some(setup) = self.setup.as_mut().filter(|_| (beam as usize) < beams) else {
            return Err(SimError::NoBeam { beam, beams });
        };
        let of_beam = |launch: &&Launch| launch.beam == beam;
        let asked = self.state.flight.pulses().iter().filter(|pulse| pulse.beam == beam).count()
            - self.schedule[..self.state.launched].iter().filter(of_beam).count();
        let pulse = (self.schedule.iter().filter(of_beam).count() + asked) as u32;
        let mut once = setup.acoustics.beams[beam as usize].clone();
        once.pulses = acoustics::Pulses { first: Quantity(now), period: None, count: 1 };
        self.state.flight.launch(&once, &setup.medium, setup.seed, beam, pulse);
        self.state.asked += 1;
        let dropped = setup.drop_rays(&mut self.state.flight, grains, now);
        setup.warn_of_launch(beam, (grains, &self.state.flight), dropped, end - now, warnings);
        Ok(())
    }

    /// Lets the rays fly for `dt` [s] from `now` [s] and puts their hits on the grains.
    pub fn fly(&mut self, system: &mut System, now: f64, dt: f64, warnings: &mut Warnings) {
        for &grain in &self.hit_grains {
            system.ray_loads.force[grain as usize] = Vec3::ZERO;
            system.ray_loads.torque[grain as usize] = Vec3::ZERO;
        }
        self.hit_grains.clear();
        self.on_walls.clear();
        system.has_ray_loads = false;
        let impulses = self.are_impulses();
        let Some(setup) = &mut self.setup else { return };
        if self.state.flight.rays().is_empty() || self.state.ray_time > now {
            return;
        }
        self.state.ray_time = now + dt;
        system.ray_loads.fit(system.grains.len());
        setup.tracer.stand_walls([self.state.flew_at, now]);
        self.state.flew_at = now;
        self.on_walls.resize(setup.names.len(), Default::default());
        let before = dropped(self.state.flight.pulses());
        let mut absorbed_power = std::mem::take(&mut system.grains.absorbed_power);
        let (grains, loads, hit_grains) = (&system.grains, &mut system.ray_loads, &mut self.hit_grains);
        let (law, medium, impedances) = (&setup.acoustics.force, &setup.medium, &setup.impedances);
        let (materials, on_walls) = (&setup.wall_materials, &mut self.on_walls);
        let duration = setup.duration;
        let load = |hit: &Hit, material: u32| {
            let force = law.force(hit, impedances[material as usize], medium);
            if impulses { force * duration } else { force }
        };
        let (targets, way) = (targets(grains, medium), medium.sound_speed.si() * dt);
        setup.tracer.advance(&mut self.state.flight, &targets, way, |hits| {
            for hit in hits {
                if hit.grain == NONE {
                    let wall = hit.wall as usize;
                    on_walls[wall].0 += load(hit, materials[wall]);
                    on_walls[wall].1 += hit.power_taken();
                    continue;
                }
                let grain = hit.grain as usize;
                let load = load(hit, grains.material[grain]);
                loads.force[grain] += load;
                loads.torque[grain] += (hit.point - grains.position[grain]).cross(load);
                absorbed_power[grain] += hit.power_taken();
                hit_grains.push(hit.grain);
            }
            if hit_grains.len() >= MANY_HITS {
                sort_and_dedup(hit_grains);
            }
        });
        warn_of_flight(setup, &targets, warnings);
        warn_of_drops(before, dropped(self.state.flight.pulses()), setup.tracer.ends(), warnings);
        system.grains.absorbed_power = absorbed_power;
        sort_and_dedup(&mut self.hit_grains);
        system.has_ray_loads = !self.hit_grains.is_empty();
    }

    /// Keeps what rays give walls in a step; `scale` [s or 1] is the factor from loads to impulses.
    fn book_walls(&mut self, scale: f64) {
        if self.on_walls.is_empty() {
            return;
        }
        let duration = self.duration();
        self.state.given.resize(self.on_walls.len(), WallSound::default());
        for (given, (load, power)) in self.state.given.iter_mut().zip(&self.on_walls) {
            given.impulse += *load * scale;
            given.energy += power * duration;
        }
    }

    /// What rays have given a wall so far.
    pub fn given_to(&self, wall: usize) -> WallSound {
        self.state.given.get(wall).copied().unwrap_or_default()
    }

    /// Energy, impulse and angular impulse that the rays' loads gave grains in the step of `dt` [s] that led to where
    /// these are; what they gave walls is kept.
    pub fn book(&mut self, system: &System, dt: f64) -> Supply {
        let scale = system.ray_load_scale(dt) * dt;
        self.book_walls(scale);
        let grains = &system.grains;
        let of_grain = |&grain: &u32| {
            let grain = grain as usize;
            let impulse = system.ray_loads.force[grain] * scale;
            let twist = system.ray_loads.torque[grain] * scale;
            // Where it came, if that is out of the block, and not where it went back in.
            let ((r, _, spin_before), (s, ..)) =
                (system.records[grain].before(), system.records[grain].now());
            let mean_angular_velocity = (spin_before + grains.angular_velocity[grain]) * 0.5;
            let work = impulse.dot(s - r) / dt + twist.dot(mean_angular_velocity);
            let torque = ((r + s) * 0.5).cross(impulse) + twist;
            Supply { power: work, force: impulse, torque }
        };
        let hit = &self.hit_grains[..];
        let leaf = |range: Range<usize>, ()| {
            let [first, end] =
                [range.start, range.end].map(|at| hit.partition_point(|grain| (*grain as usize) < at));
            hit[first..end].iter().map(of_grain).fold(Supply::default(), |a, b| a + b)
        };
        parallel::over(0..grains.len(), BLOCK, (), &leaf, &|a, b| a + b)
    }

    /// The grains came to new places, or are gone.
    pub fn reindex(&mut self, place: &[Option<u32>]) {
        self.state.flight.reindex(place);
        self.hit_grains = self.hit_grains.iter().filter_map(|grain| place[*grain as usize]).collect();
    }

    /// Quantities of all pulses so far.
    pub fn counts(&self) -> &[PulseCount] {
        self.state.flight.pulses()
    }

    /// How long a hit presses [s]; 0 without beams.
    pub fn duration(&self) -> f64 {
        self.setup.as_ref().map_or(0.0, |setup| setup.duration)
    }

    /// Acoustic energy [J] of all pulses so far: their powers times how long a hit presses.
    pub fn energy(&self) -> f64 {
        self.counts().iter().map(|pulse| pulse.power_in).sum::<f64>() * self.duration()
    }

    /// The rays in flight.
    pub fn flight(&self) -> &Flight {
        &self.state.flight
    }

    /// How many pulses there will be, with those that were asked for so far.
    pub fn scheduled(&self) -> usize {
        self.schedule.len() + self.state.asked
    }

    /// The beams.
    pub fn beams(&self) -> &[Beam] {
        self.setup.as_ref().map_or(&[], |setup| &setup.acoustics.beams)
    }

    /// Warnings that hold for the whole run.
    pub fn standing_warnings(&self) -> &'static [&'static str] {
        self.setup.as_ref().map_or(&[], |setup| setup.acoustics.force.chosen().warnings())
    }
}

fn sort_and_dedup(list: &mut Vec<u32>) {
    list.sort_unstable();
    list.dedup();
}
