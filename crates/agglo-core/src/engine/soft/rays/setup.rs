//! What is the same for all pulses of a run, and what is said of them while they fly.

use crate::acoustics::fresnel::Interface;
use crate::acoustics::{ALLOWANCE, Acoustics, Ends, Flight, Impedance, Medium, PulseCount, Targets, Tracer};
use crate::engine::Warnings;
use crate::engine::soft::settings::Settings;
use crate::particles::Particles;
use crate::text::readable;
use crate::units::Velocity;
use crate::walls::Walls;

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
    /// Names of the walls.
    pub names: Vec<String>,
    /// Numbers of their materials.
    pub wall_materials: Vec<u32>,
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
        let walls = Walls::new(&settings.walls, &settings.materials, settings.end);
        Some(Self {
            names: settings.walls.iter().map(|wall| wall.name.clone()).collect(),
            wall_materials: walls.materials().collect(),
            tracer: Tracer::new(acoustics.ends(), interfaces.collect())
                .in_space(settings.space())
                .among(walls),
            impedances: impedances.collect(),
            seed: settings.seed,
            duration: acoustics.force.duration(radius, &medium),
            acoustics,
            medium,
        })
    }

    /// Drops the rays of the latest pulse that start in grains, and those that start in walls, at a time [s]: how many, and in which first.
    pub(super) fn drop_rays(
        &mut self,
        flight: &mut Flight,
        grains: &Particles,
        now: f64,
    ) -> [Option<(u32, u32)>; 2] {
        self.tracer.stand_walls([now; 2]);
        [self.tracer.drop_blocked(flight, &targets(grains, &self.medium)), self.tracer.drop_walled(flight)]
    }

    /// Warns of rays that start in grains, and of a pulse that comes to nothing in the time that is left [s].
    pub(super) fn warn_of_launch(
        &self,
        beam: u32,
        (grains, flight): (&Particles, &Flight),
        [blocked, walled]: [Option<(u32, u32)>; 2],
        left: f64,
        warnings: &mut Warnings,
    ) {
        for (dropped, what) in [(blocked, "grain"), (walled, "wall")] {
            let Some((rays, _)) = dropped else { continue };
            let text = format!(
                "acoustics.beams.{beam}: rays of a pulse would have started inside a {what}; they were dropped"
            );
            warnings.add_times(&text, u64::from(rays));
        }
        let first_hit = || self.acoustics.beams[beam as usize].first_hit(&grains.position, &grains.radius);
        let arrival = if self.tracer.repeats() { self.tracer.first_image(flight) } else { first_hit() };
        // Off walls rays come back.
        if arrival.is_none() && self.tracer.walls() > 0 {
            return;
        }
        if let Some(text) = warning_of_launch(beam, arrival, self.medium.sound_speed.si(), left) {
            warnings.add(&text);
        }
    }
}

/// The grains as rays see them.
pub(super) fn targets<'a>(grains: &'a Particles, medium: &Medium) -> Targets<'a> {
    let fastest = grains.velocity.iter().map(|velocity| velocity.norm()).fold(0.0, f64::max);
    Targets {
        positions: &grains.position,
        radii: &grains.radius,
        material: &grains.material,
        mach: fastest / medium.sound_speed.si(),
    }
}

/// Rays that were dropped so far: at the largest number of bounces, crushed between grains, at the longest way.
pub(super) fn dropped(pulses: &[PulseCount]) -> [u64; 3] {
    let sum = |count: fn(&PulseCount) -> u32| pulses.iter().map(|pulse| u64::from(count(pulse))).sum();
    [sum(|pulse| pulse.capped), sum(|pulse| pulse.crushed), sum(|pulse| pulse.overlong)]
}

pub(super) fn warn_of_drops(before: [u64; 3], now: [u64; 3], ends: &Ends, warnings: &mut Warnings) {
    let [capped, crushed, overlong] = [0, 1, 2].map(|k| now[k] - before[k]);
    let bounces = ends.bounces;
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
    if overlong > 0 {
        let way = readable(ends.way, "m");
        let text = format!(
            "acoustics.way: rays were dropped after a way of {way}, their power stands in power_cut_off_W; give a longer way, or a \
             truncation that ends them before"
        );
        warnings.add_times(&text, overlong);
    }
}

/// Where grains are out of what rays can know of: outside a given region, or nearly as fast as sound.
pub(super) fn warn_of_flight(setup: &Setup, targets: &Targets<'_>, warnings: &mut Warnings) {
    if targets.mach > ALLOWANCE {
        warnings.add(
            "acoustics: a grain is faster than a tenth of the speed of sound while rays fly; rays see grains held still in each \
             step, and one that was given up could have been overtaken",
        );
    }
    let Some(region) = &setup.tracer.ends().region else { return };
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
