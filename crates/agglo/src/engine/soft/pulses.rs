//! Beams in time: when pulses start, how their rays fly along with the grains, and what they do to them.
//!
//! Rays have a clock of their own. In a step they fly the whole of it past grains held still, and the grains then
//! feel the hits in that step. Where the grains' step is cut short, the rays wait until the grains catch up.

use serde::{Deserialize, Serialize};

use crate::acoustics::fresnel::Interface;
use crate::acoustics::{Acoustics, Beam, Flight, Medium, PulseCount, RayForce, Tracer, default_region};
use crate::domain::Region;
use crate::math::Vec3;
use crate::particles::{Material, Particles};
use crate::scenario::Scenario;
use crate::units::Velocity;

use super::loads::Supply;
use super::system::System;

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
    ray_time: f64,
    region: Option<Region>,
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

#[derive(Debug)]
struct Setup {
    acoustics: Acoustics,
    medium: Medium,
    seed: u64,
    tracer: Tracer,
    /// Impedances of the materials [Pa s/m], by number.
    impedances: Vec<f64>,
    /// How long a hit presses [s].
    duration: f64,
}

impl Setup {
    fn new(scenario: &Scenario, region: &Region, radius: f64) -> Option<Self> {
        let acoustics = scenario.acoustics.clone()?;
        let medium = scenario.medium.clone();
        let sound = |material: &Material| material.sound_speed.map_or(0.0, Velocity::si);
        let materials =
            || scenario.materials.values().map(|material| (material.density.si(), sound(material)));
        let interfaces =
            materials().map(|(density, speed)| Interface::new(&medium, density, speed)).collect();
        Some(Self {
            tracer: Tracer::new(region.clone(), interfaces, acoustics.truncation),
            impedances: materials().map(|(density, speed)| density * speed).collect(),
            seed: scenario.seed,
            duration: acoustics.force.duration(radius, &medium),
            acoustics,
            medium,
        })
    }
}

impl Pulses {
    /// The pulses of a scenario, none started.
    pub fn new(scenario: &Scenario, grains: &Particles) -> Self {
        let region = scenario.acoustics.as_ref().map(|acoustics| {
            let default = || default_region(&grains.position, &grains.radius, &acoustics.beams);
            acoustics.region.clone().unwrap_or_else(default)
        });
        let mean_radius = grains.radius.iter().sum::<f64>() / grains.len().max(1) as f64;
        Self::resume(scenario, PulseState { region, mean_radius, ..PulseState::default() })
    }

    /// The pulses of a scenario as they were saved.
    pub fn resume(scenario: &Scenario, state: PulseState) -> Self {
        let mut schedule: Vec<Launch> = Vec::new();
        for (acoustics, beam) in scenario.acoustics.iter().flat_map(|a| a.beams.iter()).zip(0..) {
            let starts = acoustics.pulses.start_times();
            schedule.extend(starts.zip(0..).map(|(time, pulse)| Launch { time, beam, pulse }));
        }
        schedule.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.beam.cmp(&b.beam)));
        let setup = state.region.as_ref().and_then(|region| Setup::new(scenario, region, state.mean_radius));
        Self { setup, state, schedule, hit_grains: Vec::new() }
    }

    /// What is needed to go on with the same bits.
    pub fn state(&self) -> PulseState {
        self.state.clone()
    }

    /// Whether hits give impulses; otherwise forces for one step.
    pub fn are_impulses(&self) -> bool {
        !matches!(
            &self.setup,
            Some(Setup { acoustics: Acoustics { force: RayForce::PublishedStep(_), .. }, .. })
        )
    }

    /// Time [s] of the next launch after `now`.
    pub fn next_launch(&self, now: f64) -> Option<f64> {
        self.schedule[self.state.launched..].iter().map(|launch| launch.time).find(|time| *time > now)
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

    /// Launches the pulses whose time has come.
    pub fn launch_due(&mut self, now: f64) {
        let Some(setup) = &mut self.setup else { return };
        while let Some(launch) = self.schedule.get(self.state.launched).filter(|launch| launch.time <= now) {
            let beam = &setup.acoustics.beams[launch.beam as usize];
            self.state.flight.launch(beam, &setup.medium, setup.seed, launch.beam, launch.pulse);
            self.state.launched += 1;
        }
    }

    /// Lets the rays fly for `dt` [s] from `now` [s] and puts their hits on the grains.
    pub fn fly(&mut self, system: &mut System, now: f64, dt: f64) {
        for &grain in &self.hit_grains {
            system.ray_loads.force[grain as usize] = Vec3::ZERO;
            system.ray_loads.moment[grain as usize] = Vec3::ZERO;
        }
        self.hit_grains.clear();
        system.has_ray_loads = false;
        let impulses = self.are_impulses();
        let Some(setup) = &mut self.setup else { return };
        if self.state.flight.rays().is_empty() || self.state.ray_time > now {
            return;
        }
        self.state.ray_time = now + dt;
        let grains = &mut system.grains;
        let way = setup.medium.sound_speed.si() * dt;
        let hits = setup.tracer.advance(
            &mut self.state.flight,
            &grains.position,
            &grains.radius,
            &grains.material,
            way,
        );
        for hit in hits {
            let grain = hit.grain as usize;
            let force = setup.acoustics.force.force(
                hit,
                setup.impedances[grains.material[grain] as usize],
                &setup.medium,
            );
            let load = if impulses { force * setup.duration } else { force };
            system.ray_loads.force[grain] += load;
            system.ray_loads.moment[grain] += (hit.point - grains.position[grain]).cross(load);
            grains.absorbed_power[grain] += hit.power_in * (1.0 - hit.reflectance);
            self.hit_grains.push(hit.grain);
        }
        self.hit_grains.sort_unstable();
        self.hit_grains.dedup();
        system.has_ray_loads = !self.hit_grains.is_empty();
    }

    /// Energy, impulse and moment of the impulse that the rays' loads give in the step that is tried.
    pub fn supply(&self, system: &System, dt: f64) -> Supply {
        let scale = system.ray_load_scale(dt) * dt;
        let (grains, trial) = (&system.grains, &system.trial);
        let mut sum = Supply::default();
        for &grain in &self.hit_grains {
            let grain = grain as usize;
            let impulse = system.ray_loads.force[grain] * scale;
            let twist = system.ray_loads.moment[grain] * scale;
            let (r, s) = (grains.position[grain], trial.position[grain]);
            let mean_spin = (grains.spin[grain] + trial.spin[grain]) * 0.5;
            let work = impulse.dot(s - r) / dt + twist.dot(mean_spin);
            let moment = ((r + s) * 0.5).cross(impulse) + twist;
            sum = sum + Supply { power: work, force: impulse, moment };
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

    /// Figures of all pulses so far.
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

    /// How many pulses there will be.
    pub fn scheduled(&self) -> usize {
        self.schedule.len()
    }

    /// The beams.
    pub fn beams(&self) -> &[Beam] {
        self.setup.as_ref().map_or(&[], |setup| &setup.acoustics.beams)
    }

    /// Warnings that hold for the whole run.
    pub fn standing_warnings(&self) -> Vec<&'static str> {
        if self.are_impulses() {
            return Vec::new();
        }
        vec![
            "acoustics.force.published_step gives a force for one step: halving the step halves the impulse, so the \
             answer does not converge",
        ]
    }
}
