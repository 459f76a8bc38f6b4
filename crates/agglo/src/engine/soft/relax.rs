//! Rest before the clock starts: contacts, bonds and fields act, motion is damped away.

use crate::engine::SimError;
use crate::particles::Particles;
use crate::scenario::{Relaxation, Scenario};

use super::simulation::Simulation;

/// The grains at rest under the scenario's laws, without rays and drag.
///
/// # Errors
/// [`SimError::NoRest`] where it takes longer than allowed; others as for any step.
pub fn relaxed(
    scenario: &Scenario,
    relaxation: &Relaxation,
    grains: Particles,
) -> Result<Particles, SimError> {
    let mut quiet = scenario.clone();
    quiet.acoustics = None;
    quiet.fields.drag = None;
    quiet.time.end = relaxation.longest;
    let velocity = grains.velocity.clone();
    let spin = grains.spin.clone();
    let mut simulation = Simulation::with(&quiet, grains);
    simulation.system.grains.velocity.fill(crate::math::Vec3::ZERO);
    simulation.system.grains.spin.fill(crate::math::Vec3::ZERO);
    let damping_time = relaxation.damping_time.si();
    loop {
        let speed = unrest(&simulation, damping_time);
        if speed <= relaxation.speed.si() {
            break;
        }
        if simulation.is_finished() {
            let time = simulation.clock().time;
            return Err(SimError::NoRest { time, speed, limit: relaxation.speed.si() });
        }
        simulation.step()?;
        let kept = (-simulation.clock().last_step / damping_time).exp();
        let grains = &mut simulation.system.grains;
        grains.velocity.iter_mut().chain(&mut grains.spin).for_each(|motion| *motion *= kept);
    }
    let mut rested = simulation.system.grains;
    let mut order: Vec<u32> = (0..rested.len() as u32).collect();
    order.sort_unstable_by_key(|at| rested.id[*at as usize]);
    rested.reorder(&order);
    rested.velocity = velocity;
    rested.spin = spin;
    Ok(rested)
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
