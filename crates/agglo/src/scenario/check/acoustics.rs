//! Rules of beams, rays and what they press with.

use super::laws::needed;
use super::{Check, region};
use crate::acoustics::{Acoustics, Beam, MOST_PERIODS, Profile, Strength};
use crate::domain::{Space, Volume};
use crate::math::Vec3;
use crate::packing::{Placement, Size};
use crate::particles::property::SOUND_SPEED;
use crate::scenario::file::ScenarioFile;
use crate::text::told_apart;
use crate::units::vector;
use crate::walls::{Mirrors, Walls};

pub(super) fn check(check: &mut Check, scenario: &ScenarioFile) {
    let Some(acoustics) = &scenario.acoustics else { return };
    needed(check, scenario, "acoustics", &SOUND_SPEED);
    if let Some(volume) = scenario.volume.as_ref().filter(|_| !scenario.engine.is_hard()) {
        across_faces(check, acoustics, volume);
    }
    if let Some(way) = acoustics.way {
        check.positive("acoustics.way", way);
    }
    if !(0.0..1.0).contains(&acoustics.truncation) {
        let message = format!("found {}; a number from 0 and below 1 is wanted", acoustics.truncation);
        check.fail("acoustics.truncation", message);
    }
    check.at_least_one("acoustics.bounces", acoustics.bounces);
    let region_holds =
        acoustics.region.as_ref().is_some_and(|region| self::region(check, "acoustics.region", region));
    if acoustics.beams.is_empty() {
        check.fail_with("acoustics.beams", "is empty".to_owned(), "add a [[acoustics.beams]] table");
    }
    for (index, beam) in acoustics.beams.iter().enumerate() {
        let key = format!("acoustics.beams.{index}");
        if one(check, &key, beam, scenario) {
            if region_holds {
                inside(check, &key, beam, acoustics);
            }
            in_grains(check, &key, beam, scenario);
            in_walls(check, &key, beam, scenario);
        }
    }
}

/// Where space repeats itself, rays fly on across its faces: not in one that changes meanwhile, nor to the end of a region.
fn across_faces(check: &mut Check, acoustics: &Acoustics, volume: &Volume) {
    let space = volume.space();
    if !space.repeats() {
        return;
    }
    if volume.deformation.is_some() {
        let message = "is given beside [acoustics], whose rays do not follow it".to_owned();
        check.fail_with("volume.deformation", message, "leave out one of the two");
    }
    if acoustics.region.is_some() {
        let message = "is given where space repeats itself, and its images are not known".to_owned();
        check.fail_with("acoustics.region", message, "leave it out, or let the faces of [volume] be open");
    }
    let most = MOST_PERIODS * space.shortest_period();
    if let Some(way) = acoustics.way.filter(|way| way.si() > most) {
        let [way, most] = told_apart([way.si(), most], "m");
        let message = format!(
            "{way} is more than {most}, a million of the shortest edge across which space repeats itself"
        );
        check.fail_with("acoustics.way", message, "give a shorter way");
    }
}

fn one(check: &mut Check, key: &str, beam: &Beam, scenario: &ScenarioFile) -> bool {
    let before = check.found().len();
    check.at_least_one(&format!("{key}.rays"), beam.rays);
    check.positive(&format!("{key}.radius"), beam.radius);
    if Vec3::from(beam.direction).norm() == 0.0 {
        let message = "has no direction: all components are 0".to_owned();
        check.fail_with(&format!("{key}.direction"), message, "for example [1, 0, 0]");
    }
    match beam.strength {
        Strength::Power(power) => check.positive(&format!("{key}.strength.power"), power),
        Strength::Pressure(pressure) => check.positive(&format!("{key}.strength.pressure"), pressure),
    }
    if let Profile::Gaussian(profile) = beam.profile {
        check.positive(&format!("{key}.profile.gaussian.waist"), profile.waist);
    }
    if let Some(frequency) = beam.frequency {
        check.positive(&format!("{key}.frequency"), frequency);
    }
    let geometry_holds = check.found().len() == before;
    pulses(check, &format!("{key}.pulses"), beam, scenario);
    geometry_holds
}

fn pulses(check: &mut Check, key: &str, beam: &Beam, scenario: &ScenarioFile) {
    let pulses = &beam.pulses;
    check.not_negative(&format!("{key}.first"), pulses.first);
    match pulses.period {
        Some(period) => check.positive(&format!("{key}.period"), period),
        None if pulses.count > 1 => {
            let message = format!("is missing; {} pulses need the time from one to the next", pulses.count);
            check.fail_with(&format!("{key}.period"), message, "for example period = \"0.5 s\"");
        }
        None => {}
    }
    if scenario.time.end.si() > 0.0 && pulses.count > 0 && pulses.first >= scenario.time.end {
        let [first, end] = told_apart([pulses.first.si(), scenario.time.end.si()], "s");
        let message = format!("the first pulse at {first} comes after the end of the run at {end}");
        check.fail(&format!("{key}.first"), message);
    }
}

/// The region must hold the whole disc: a ray that starts outside would be lost at once.
fn inside(check: &mut Check, key: &str, beam: &Beam, acoustics: &Acoustics) {
    let Some(region) = &acoustics.region else { return };
    if !region.contains(vector(beam.start), 0.0) {
        let message = "lies outside acoustics.region, where rays live".to_owned();
        return check.fail_with(&format!("{key}.start"), message, "enlarge the region or leave it out");
    }
    if !beam.disc().lies_in(region) {
        let message = "part of the disc of rays lies outside acoustics.region, where rays live".to_owned();
        check.fail_with(&format!("{key}.radius"), message, "enlarge the region or leave it out");
    }
}

/// Rays that start inside a grain at time zero, where the scenario itself says where grains are.
fn in_grains(check: &mut Check, key: &str, beam: &Beam, scenario: &ScenarioFile) {
    if beam.pulses.first.si() > 0.0 || scenario.start.relax.is_some() {
        return;
    }
    let (disc, space) = (beam.disc(), space_of(scenario));
    for (index, group) in scenario.grains.iter().enumerate() {
        let (Placement::List(list), Size::Constant(size)) = (&group.placement, &group.size) else { continue };
        for (place, position) in list.positions.iter().enumerate() {
            let nearest = space
                .images_about(vector(*position))
                .map(|image| disc.distance(image))
                .fold(f64::INFINITY, f64::min);
            let depth = size.radius.si() - nearest;
            if depth > 1e-9 * size.radius.si() {
                let message =
                    format!("the disc of rays cuts grains.{index}.placement.list.positions.{place}");
                let help = "move the start away from the grains, or make the radius smaller: rays start outside grains";
                return check.fail_with(&format!("{key}.start"), message, help);
            }
        }
    }
}

/// Space as soft spheres have it.
fn space_of(scenario: &ScenarioFile) -> Space {
    let volume = scenario.volume.as_ref().filter(|_| !scenario.engine.is_hard());
    volume.map_or(Space::OPEN, Volume::space)
}

/// Rays that start inside a wall when the first pulse does.
fn in_walls(check: &mut Check, key: &str, beam: &Beam, scenario: &ScenarioFile) {
    if scenario.engine.is_hard() || scenario.walls.is_empty() {
        return;
    }
    let starts = beam.ray_starts(&scenario.medium, scenario.seed, 0, 0);
    for (index, wall) in scenario.walls.iter().enumerate() {
        let mut alone = Check::default();
        wall.faults(&mut alone, scenario.time.end.si());
        if !alone.found().is_empty() {
            return;
        }
        let walls = Walls::new(std::slice::from_ref(wall), &scenario.materials, scenario.time.end.si());
        let mut mirrors = Mirrors::new(walls);
        mirrors.stand([beam.pulses.first.si(); 2]);
        let rays = starts.iter().filter(|start| mirrors.holding(start.position).is_some()).count();
        if rays > 0 {
            let message =
                format!("{rays} rays of the disc start inside the wall \"{}\", walls.{index}", wall.name);
            let help = "move the start to the side of the wall where grains are, or make the radius smaller";
            check.fail_with(&format!("{key}.start"), message, help);
            return;
        }
    }
}
