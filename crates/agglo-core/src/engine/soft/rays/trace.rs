//! A pulse traced to its end among spheres held still: what rays do, without anything that moves.

use crate::acoustics::{Flight, Hit, NONE, PulseCount, Targets};
use crate::engine::SimError;
use crate::math::{Vec3, parallel};

use super::setup::Setup;
use crate::engine::soft::settings::Settings;

/// What became of a pulse.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Traced {
    /// All hits, those of one ray in the order of time; [`Hit::grain`] is the index of the sphere, [`Hit::wall`] the number of the wall.
    pub hits: Vec<Hit>,
    /// What each hit does to its sphere or wall: an impulse [N s], or a force [N] where the law of the scenario gives one; as `hits`.
    pub loads: Vec<Vec3>,
    /// Whether `loads` are impulses.
    pub are_impulses: bool,
    /// Counts and powers of the pulse.
    pub count: PulseCount,
}

/// Spheres of which only place, size and material count.
#[derive(Clone, Copy, Debug)]
pub struct Spheres<'a> {
    /// Centers [n] [m].
    pub position: &'a [Vec3],
    /// Radii [n] [m].
    pub radius: &'a [f64],
    /// Numbers of the materials [n], in the order of their names.
    pub material: &'a [u32],
}

/// Traces pulse number `pulse` of a scenario's beam number `beam` among spheres held still, by the scenario's laws of rays.
///
/// # Errors
/// [`SimError::NoBeam`] where there is no such beam.
pub fn trace(settings: &Settings, spheres: Spheres<'_>, beam: u32, pulse: u32) -> Result<Traced, SimError> {
    let Spheres { position, radius, material } = spheres;
    let mean_radius = parallel::mean(radius);
    let beams = settings.acoustics.as_ref().map_or(0, |acoustics| acoustics.beams.len());
    let setup = Setup::new(settings, mean_radius).filter(|_| (beam as usize) < beams);
    let Some(mut setup) = setup else { return Err(SimError::NoBeam { beam, beams }) };
    let targets = Targets { positions: position, radii: radius, material, mach: 0.0 };
    let mut flight = Flight::default();
    flight.launch(&setup.acoustics.beams[beam as usize], &setup.medium, setup.seed, beam, pulse);
    setup.tracer.drop_blocked(&mut flight, &targets);
    setup.tracer.drop_walled(&mut flight);
    let hits = setup.tracer.trace(&mut flight, &targets);
    let law = &setup.acoustics.force;
    let press = if law.is_impulse() { setup.duration } else { 1.0 };
    let load = |hit: &Hit| {
        let material = if hit.grain == NONE {
            &setup.wall_materials[hit.wall as usize]
        } else {
            &material[hit.grain as usize]
        };
        law.force(hit, setup.impedances[*material as usize], &setup.medium) * press
    };
    let loads = hits.iter().map(load).collect();
    let count = flight.pulses().first().copied().unwrap_or_default();
    Ok(Traced { hits, loads, are_impulses: law.is_impulse(), count })
}
