//! The start of a simulation, and rest before its clock starts: contacts, bonds and fields act, motion is damped away.

use std::ops::ControlFlow;

use crate::engine::{SimError, Start};
use crate::math::Vec3;
use crate::particles::ById;
use crate::walls::Motion;

use super::forces::truncation;
use super::guard::space;
use super::settings::{Relaxation, Settings};
use super::simulation::Simulation;
use super::walls::refuse_grains_in_walls;

/// Where grains stand on their way to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resting {
    /// Simulated time of the relaxation so far [s].
    pub time: f64,
    /// Steps of it.
    pub step: u64,
    /// Speed of the fastest grain [m/s], or the one it would reach.
    pub speed: f64,
    /// What counts as rest [m/s].
    pub limit: f64,
}

/// Someone who is told how grains come to rest and may ask to stop.
pub type RestWatch<'a> = dyn FnMut(&Resting) -> ControlFlow<()> + 'a;

impl Simulation {
    /// Starts with grains as placed, or with what came out of another simulation.
    ///
    /// # Errors
    /// [`SimError::InWall`] where a grain is placed in a wall, [`SimError::NoRest`] where grains are to come to rest first and do not; [`SimError::OtherSpheres`] where the settings
    /// come from a scenario of hard spheres.
    pub fn start<S>(settings: S, start: impl Into<Start>) -> Result<Self, SimError>
    where
        S: TryInto<Settings>,
        SimError: From<S::Error>,
    {
        Self::begin(&settings.try_into()?, start.into(), &mut |_| ControlFlow::Continue(()))
    }

    /// The same; `watch` is told how grains come to rest, if they are to, and may ask to stop.
    ///
    /// # Errors
    /// As [`Simulation::start`], [`SimError::Truncated`] where a cut-off leaves out too much, [`SimError::NarrowSpace`] where grains
    /// would meet two images of one another, and [`SimError::StoppedAtRest`].
    pub fn start_watched<S>(
        settings: S,
        start: impl Into<Start>,
        watch: &mut RestWatch<'_>,
    ) -> Result<Self, SimError>
    where
        S: TryInto<Settings>,
        SimError: From<S::Error>,
    {
        Self::begin(&settings.try_into()?, start.into(), watch)
    }

    fn begin(settings: &Settings, mut start: Start, watch: &mut RestWatch<'_>) -> Result<Self, SimError> {
        space::hold(settings, &start.grains)?;
        refuse_grains_in_walls(settings, &start.grains)?;
        let truncation =
            truncation::hold(settings.fields.near_field.as_ref(), &start.grains, &settings.space())?;
        let warnings = std::mem::take(&mut start.warnings);
        let mut simulation = match &settings.relax {
            Some(relaxation) => rested(settings, relaxation, start, watch)?,
            None => Self::with(settings, start),
        };
        simulation.truncation = truncation;
        simulation.open_ledger();
        for warning in &warnings {
            simulation.warnings.add(warning);
        }
        Ok(simulation)
    }
}

/// A simulation whose grains came to rest under their laws, without rays and drag, and then got the
/// velocities that they were given. Contacts and bonds keep what they remember of the way there.
///
/// # Errors
/// [`SimError::NoRest`] where it takes longer than allowed; others as for any step.
fn rested(
    settings: &Settings,
    relaxation: &Relaxation,
    mut start: Start,
    watch: &mut RestWatch<'_>,
) -> Result<Simulation, SimError> {
    let mut quiet = settings.clone();
    quiet.acoustics = None;
    quiet.fields.drag = None;
    if let Some(volume) = &mut quiet.volume {
        volume.deformation = None;
    }
    // The clock has not started yet, by which walls move.
    quiet.walls.iter_mut().for_each(|wall| wall.motion = Motion::Fixed);
    quiet.end = relaxation.longest.si();
    // What is damped away is in no ledger.
    (quiet.limits.drift_warning, quiet.limits.drift_error) = (f64::INFINITY, f64::INFINITY);
    let still = &mut start.grains;
    let (places, motions) = (ById::of(&still.id), (still.velocity.clone(), still.angular_velocity.clone()));
    still.velocity.fill(Vec3::ZERO);
    still.angular_velocity.fill(Vec3::ZERO);
    let mut simulation = Simulation::with(&quiet, start);
    settle(&mut simulation, relaxation, watch)?;
    let grains = &mut simulation.system.grains;
    // They were sorted in space meanwhile.
    for at in 0..grains.len() {
        if let Some(before) = places.find(grains.id[at]) {
            (grains.velocity[at], grains.angular_velocity[at]) = (motions.0[before], motions.1[before]);
        }
    }
    Ok(simulation.restarted(settings))
}

fn settle(
    simulation: &mut Simulation,
    relaxation: &Relaxation,
    watch: &mut RestWatch<'_>,
) -> Result<(), SimError> {
    let (damping_time, limit) = (relaxation.damping_time.si(), relaxation.speed.si());
    loop {
        let speed = unrest(simulation, damping_time);
        if speed <= limit {
            return Ok(());
        }
        if simulation.is_finished() {
            return Err(SimError::NoRest { time: simulation.clock().time, speed, limit });
        }
        let (time, step) = (simulation.clock().time, simulation.clock().step);
        if watch(&Resting { time, step, speed, limit }).is_break() {
            return Err(SimError::StoppedAtRest);
        }
        simulation.step()?;
        let kept = (-simulation.clock().last_step / damping_time).exp();
        let grains = &mut simulation.system.grains;
        grains.velocity.iter_mut().chain(&mut grains.angular_velocity).for_each(|motion| *motion *= kept);
    }
}

/// Speed [m/s] of the fastest grain, or the one it would reach in the damping time if that is more.
fn unrest(simulation: &Simulation, damping_time: f64) -> f64 {
    let system = &simulation.system;
    let speeds = (0..system.grains.len()).map(|at| {
        let pushed = system.loads.force[at].norm() / system.inertial_mass[at] * damping_time;
        system.grains.velocity[at].norm().max(pushed)
    });
    speeds.fold(0.0, f64::max)
}
