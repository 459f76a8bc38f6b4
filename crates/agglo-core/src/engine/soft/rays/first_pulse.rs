//! What the first pulse of a beam does to grains that are held still. It is a look ahead, no part of a run: the rays
//! bounce among the grains by the run's own laws, but nothing moves while they fly.

use crate::acoustics::PulseCount;
use crate::domain::extent;
use crate::engine::{Moment, Warnings};
use crate::math::Vec3;
use crate::particles::{ById, Particles};
use crate::units::Quantity;

use crate::engine::soft::settings::Settings;
use crate::engine::soft::simulation::Simulation;

/// Parts of the widest way through the grains in which the rays are followed.
const PARTS_OF_THE_WAY: f64 = 16.0;
/// Parts after which rays that are still about are left to themselves.
const MOST_PARTS: u32 = 4000;
/// Part of a pulse's power that is left to itself where rays do not leave, but come back off walls and across faces.
const NEGLIGIBLE: f64 = 1e-3;

/// A pulse that has flown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FirstPulse {
    /// Its counts and powers.
    pub count: PulseCount,
    /// Time until its last ray has left [s], a little more; or as long as its rays were followed.
    pub flight_s: f64,
    /// How long a hit presses [s].
    pub duration_s: f64,
    /// Change of velocity of each grain [m/s], in the order in which they were given; [n].
    pub kicks: Vec<Vec3>,
}

impl FirstPulse {
    /// The first pulse of beam number `beam` with no more rays than
    /// `most_rays`: fewer rays of the same beam carry more power each.
    pub fn of(settings: &Settings, grains: &Particles, beam: usize, most_rays: u32) -> Self {
        let (count, places) = (grains.len(), ById::of(&grains.id));
        let mut simulation = Simulation::with(&alone(settings, beam, most_rays), grains.clone().into());
        let comes_back = settings.space().repeats() || !settings.walls.is_empty();
        let part = widest_way(&simulation.system.grains) / PARTS_OF_THE_WAY;
        let dt = part / settings.medium.sound_speed.si();
        let Simulation { system, pulses, .. } = &mut simulation;
        let (moment, mut warnings) = (Moment { step: 1, time: 0.0, dt }, Warnings::default());
        // What is wrong with a launch the run says itself; rays that start in a grain are left out here.
        let _ = pulses.launch_due(&system.grains, &moment, f64::INFINITY, &mut warnings);
        let mut found =
            Self { duration_s: pulses.duration(), kicks: vec![Vec3::ZERO; count], ..Self::default() };
        for number in 0..MOST_PARTS {
            let flight = pulses.flight();
            if flight.rays().is_empty() || (comes_back && flight.power_flying().magnitude < NEGLIGIBLE) {
                break;
            }
            let now = f64::from(number) * dt;
            pulses.fly(system, now, dt, &mut warnings);
            found.flight_s = now + dt;
            // A force presses for as long as the law says, an impulse is whole.
            let time = if pulses.are_impulses() { 1.0 } else { pulses.duration() };
            for at in 0..count {
                let kick = system.ray_loads.force[at] * (time / system.inertial_mass[at]);
                if let Some(given) = places.find(system.grains.id[at]) {
                    found.kicks[given] += kick;
                }
            }
        }
        found.count = pulses.counts().first().copied().unwrap_or_default();
        found
    }
}

/// The same with one pulse of one beam at once, and nothing but rays.
fn alone(settings: &Settings, beam: usize, most_rays: u32) -> Settings {
    let mut alone = settings.clone();
    (alone.contact, alone.bonds, alone.fields.near_field) = (None, None, None);
    if let Some(acoustics) = &mut alone.acoustics {
        let mut beam = acoustics.beams.swap_remove(beam);
        beam.rays = beam.rays.min(most_rays);
        beam.pulses.first = Quantity(0.0);
        (beam.pulses.period, beam.pulses.count) = (None, 1);
        acoustics.beams = vec![beam];
    }
    alone
}

/// Diagonal [m] of the box around the grains.
fn widest_way(grains: &Particles) -> f64 {
    extent(&grains.position, &grains.radius).map_or(0.0, |(lower, upper)| (upper - lower).norm())
}
