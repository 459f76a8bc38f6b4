//! Beams in time: when pulses start, how their rays fly along with the grains, and what they do to them.
//!
//! Rays have a clock of their own. In a step they fly the whole of it past grains held still, and the grains then
//! feel the hits in that step. Where the grains' step is cut short, the rays wait until the grains catch up.

use serde::{Deserialize, Serialize};

use crate::acoustics::fresnel::Interface;
use crate::acoustics::{
    self, ALLOWANCE, Acoustics, Beam, Flight, Impedance, Medium, PulseCount, Targets, Tracer,
};
use crate::engine::validate::{Fault, ensure, length};
use crate::engine::{Moment, SimError, Warnings};
use crate::math::Vec3;
use crate::particles::Particles;
use crate::units::{Quantity, Velocity};

use super::flight::validate_flight;
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
}

/// What is the same for all pulses.
#[derive(Debug)]
pub(super) struct Setup {
    pub acoustics: Acoustics,
    pub medium: Medium,
    pub seed: u64,
    pub tracer: Tracer,
    /// Impedances of the materials, by number.
    pub impedances: Vec<Impedance>,
    /// How long a hit presses [s].
    pub duration: f64,
}

/// Grains that were hit are made a list without doubles whenever it is as long as this.
const MANY_HITS: usize = 1 << 16;

impl PulseState {
    /// Whether it is one that a scenario's pulses among `n` grains can have come to.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(in crate::engine::soft) fn validate(&self, settings: &Settings, n: usize) -> Result<(), Fault> {
        let times = [self.ray_time, self.mean_radius];
        ensure(times.iter().all(|value| value.is_finite() && *value >= 0.0), || {
            "pulses: not finite".to_owned()
        })?;
        let pulses = self.flight.pulses().len();
        length("pulses that have started", self.launched.saturating_add(self.asked), pulses)?;
        validate_flight(&self.flight, settings, n)?;
        let due = schedule(settings).len();
        ensure(self.launched <= due, || format!("{} pulses have started of {due}", self.launched))
    }
}

impl Setup {
    pub fn new(settings: &Settings, radius: f64) -> Option<Self> {
        let acoustics = settings.acoustics.clone()?;
        let medium = settings.medium.clone();
        let materials = || {
            settings.materials.values().map(|material| {
                let speed = |speed: Option<Velocity>| speed.map_or(0.0, Velocity::si);
                let speeds = [speed(material.sound_speed), speed(material.shear_sound_speed)];
                (material.density.si(), speeds)
            })
        };
        let interfaces =
            materials().map(|(density, [sound, shear])| Interface::new(&medium, density, sound, shear));
        let impedances = materials()
            .map(|(density, [sound, shear])| Impedance { sound: density * sound, shear: density * shear });
        Some(Self {
            tracer: Tracer::new(acoustics.ends(), interfaces.collect()),
            impedances: impedances.collect(),
            seed: settings.seed,
            duration: acoustics.force.duration(radius, &medium),
            acoustics,
            medium,
        })
    }
}

impl Setup {
    /// Warns of rays that start in grains, and of a pulse that comes to nothing in the time that is left [s].
    fn warn_of_launch(
        &self,
        beam: u32,
        grains: &Particles,
        blocked: Option<(u32, u32)>,
        left: f64,
        warnings: &mut Warnings,
    ) {
        if let Some((rays, _)) = blocked {
            let text = format!(
                "acoustics.beams.{beam}: rays of a pulse would have started inside a grain; they were dropped"
            );
            warnings.add_times(&text, u64::from(rays));
        }
        let arrival = self.acoustics.beams[beam as usize].first_hit(&grains.position, &grains.radius);
        if let Some(text) = warning_of_launch(beam, arrival, self.medium.sound_speed.si(), left) {
            warnings.add(&text);
        }
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

/// The grains as rays see them.
fn targets<'a>(grains: &'a Particles, medium: &Medium) -> Targets<'a> {
    let fastest = grains.velocity.iter().map(|velocity| velocity.norm()).fold(0.0, f64::max);
    Targets {
        positions: &grains.position,
        radii: &grains.radius,
        material: &grains.material,
        mach: fastest / medium.sound_speed.si(),
    }
}

impl Pulses {
    /// The pulses of a scenario, none started.
    pub fn new(settings: &Settings, grains: &Particles) -> Self {
        let mean_radius = grains.radius.iter().sum::<f64>() / grains.len().max(1) as f64;
        Self::resume(settings, PulseState { mean_radius, ..PulseState::default() })
    }

    /// The pulses of a scenario as they were saved.
    ///
    /// The state has been held to the scenario before.
    pub fn resume(settings: &Settings, state: PulseState) -> Self {
        let schedule = schedule(settings);
        let setup = Setup::new(settings, state.mean_radius);
        Self { setup, state, schedule, hit_grains: Vec::new() }
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
            let blocked = setup.tracer.drop_blocked(flight, &targets(grains, &setup.medium));
            if let Some((rays, grain)) = blocked.filter(|_| moment.step <= 1) {
                let grain = grains.id[grain as usize];
                return Err(SimError::BeamInGrain { at: moment.clone(), beam: launch.beam, rays, grain });
            }
            setup.warn_of_launch(launch.beam, grains, blocked, end - now, warnings);
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
        let blocked = setup.tracer.drop_blocked(&mut self.state.flight, &targets(grains, &setup.medium));
        setup.warn_of_launch(beam, grains, blocked, end - now, warnings);
        Ok(())
    }

    /// Lets the rays fly for `dt` [s] from `now` [s] and puts their hits on the grains.
    pub fn fly(&mut self, system: &mut System, now: f64, dt: f64, warnings: &mut Warnings) {
        for &grain in &self.hit_grains {
            system.ray_loads.force[grain as usize] = Vec3::ZERO;
            system.ray_loads.torque[grain as usize] = Vec3::ZERO;
        }
        self.hit_grains.clear();
        system.has_ray_loads = false;
        let impulses = self.are_impulses();
        let Some(setup) = &mut self.setup else { return };
        if self.state.flight.rays().is_empty() || self.state.ray_time > now {
            return;
        }
        self.state.ray_time = now + dt;
        system.ray_loads.fit(system.grains.len());
        let before = dropped(self.state.flight.pulses());
        let mut absorbed_power = std::mem::take(&mut system.grains.absorbed_power);
        let (grains, loads, hit_grains) = (&system.grains, &mut system.ray_loads, &mut self.hit_grains);
        let (law, medium, impedances) = (&setup.acoustics.force, &setup.medium, &setup.impedances);
        let (targets, way) = (targets(grains, medium), medium.sound_speed.si() * dt);
        setup.tracer.advance(&mut self.state.flight, &targets, way, |hits| {
            for hit in hits {
                let grain = hit.grain as usize;
                let force = law.force(hit, impedances[grains.material[grain] as usize], medium);
                let load = if impulses { force * setup.duration } else { force };
                loads.force[grain] += load;
                loads.torque[grain] += (hit.point - grains.position[grain]).cross(load);
                absorbed_power[grain] += hit.power_in * (1.0 - hit.reflectance);
                hit_grains.push(hit.grain);
            }
            if hit_grains.len() >= MANY_HITS {
                sort_and_dedup(hit_grains);
            }
        });
        warn_of_flight(setup, &targets, warnings);
        warn_of_drops(before, dropped(self.state.flight.pulses()), setup.acoustics.bounces, warnings);
        system.grains.absorbed_power = absorbed_power;
        sort_and_dedup(&mut self.hit_grains);
        system.has_ray_loads = !self.hit_grains.is_empty();
    }

    /// Energy, impulse and angular impulse that the rays' loads gave in the step of `dt` [s] that led to where the grains are.
    pub fn supply(&self, system: &System, dt: f64) -> Supply {
        let scale = system.ray_load_scale(dt) * dt;
        let grains = &system.grains;
        let mut sum = Supply::default();
        for &grain in &self.hit_grains {
            let grain = grain as usize;
            let impulse = system.ray_loads.force[grain] * scale;
            let twist = system.ray_loads.torque[grain] * scale;
            // Where it came, if that is out of the block, and not where it went back in.
            let ((r, _, spin_before), (s, ..)) =
                (system.records[grain].before(), system.records[grain].now());
            let mean_angular_velocity = (spin_before + grains.angular_velocity[grain]) * 0.5;
            let work = impulse.dot(s - r) / dt + twist.dot(mean_angular_velocity);
            let torque = ((r + s) * 0.5).cross(impulse) + twist;
            sum = sum + Supply { power: work, force: impulse, torque };
        }
        sum
    }

    /// The grains came to new places.
    pub fn reindex(&mut self, place: &[u32]) {
        self.state.flight.reindex(place);
        for grain in &mut self.hit_grains {
            *grain = place[*grain as usize];
        }
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

/// Rays that were dropped so far: at the largest number of bounces, crushed between grains.
fn dropped(pulses: &[PulseCount]) -> [u64; 2] {
    let sum = |count: fn(&PulseCount) -> u32| pulses.iter().map(|pulse| u64::from(count(pulse))).sum();
    [sum(|pulse| pulse.capped), sum(|pulse| pulse.crushed)]
}

fn warn_of_drops(before: [u64; 2], now: [u64; 2], bounces: u32, warnings: &mut Warnings) {
    let [capped, crushed] = [0, 1].map(|k| now[k] - before[k]);
    if capped > 0 {
        let text = format!(
            "acoustics.bounces: rays were dropped after {bounces} bounces, their power stands in power_truncated_W"
        );
        warnings.add_times(&text, capped);
    }
    if crushed > 0 {
        let text = "acoustics: rays were dropped between grains that closed in on them, their power stands in \
                    power_truncated_W";
        warnings.add_times(text, crushed);
    }
}

/// Where grains are out of what rays can know of: outside a given region, or nearly as fast as sound.
fn warn_of_flight(setup: &Setup, targets: &Targets<'_>, warnings: &mut Warnings) {
    if targets.mach > ALLOWANCE {
        warnings.add(
            "acoustics: a grain is faster than a tenth of the speed of sound while rays fly; rays see grains held still in each \
             step, and one that was given up could have been overtaken",
        );
    }
    let Some(region) = setup.tracer.region() else { return };
    let mut grains = targets.positions.iter().zip(targets.radii);
    if grains.any(|(&position, &radius)| !region.contains(position, radius)) {
        warnings.add(
            "acoustics.region leaves grains outside, and rays that leave it are lost to them; without the key rays live until \
             they can hit nothing any more",
        );
    }
}

/// What a launch has to tell: `arrival` is the way [m] to the first grain, `left` the time [s] until the end of the run.
fn warning_of_launch(beam: u32, arrival: Option<f64>, sound_speed: f64, left: f64) -> Option<String> {
    match arrival {
        None => Some(format!("acoustics.beams.{beam}: a pulse passes all grains by")),
        Some(way) if way > sound_speed * left => Some(format!(
            "acoustics.beams.{beam}: a pulse would reach the first grain after the end of the run"
        )),
        Some(_) => None,
    }
}
