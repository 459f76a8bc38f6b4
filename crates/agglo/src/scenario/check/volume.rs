//! Rules of the control volume and of what lies in it.

use super::{Check, corners, shown};
use crate::domain::{Boundary, Deformation, Faces, Region, Space, Volume, resolution};
use crate::fields::NearField;
use crate::math::Vec3;
use crate::packing::{GrainGroup, GrainList, Placement};
use crate::scenario::file::ScenarioFile;
use crate::text::{readable, told_apart};
use crate::units::{Frequency, Length, Triple, vector};

/// Lists with more positions than this are held to overlaps when they are placed, where cells make that cheap.
const MOST_PAIRED: usize = 4000;

pub(super) fn check(check: &mut Check, scenario: &ScenarioFile) {
    let Some(volume) = &scenario.volume else { return };
    if !corners(check, "volume", volume.lower, volume.upper) {
        return;
    }
    if !scenario.engine.is_hard() {
        return of_soft_spheres(check, scenario, volume);
    }
    if volume.boundary == Boundary::Absorbing {
        let message =
            format!("absorbing faces belong to soft spheres; {} moves hard ones", scenario.engine.key());
        let help = "take \"open\": grains that leave the volume do not come back";
        check.fail_with("volume.boundary", message, help);
    }
    let foreign = [
        ("volume.faces", volume.faces.is_some(), "hard spheres have one boundary for all faces"),
        ("volume.deformation", volume.deformation.is_some(), "remove it: hard spheres do not feel it"),
    ];
    for (key, _, help) in foreign.into_iter().filter(|(_, is_given, _)| *is_given) {
        let message = format!("belongs to soft spheres; {} moves hard ones", scenario.engine.key());
        check.fail_with(key, message, help);
    }
    for (index, group) in scenario.grains.iter().enumerate() {
        let key = format!("grains.{index}");
        if group.size.fault().is_none() {
            fits(check, &key, group, volume);
            can_be_told(check, &key, group, volume);
            inside(check, &format!("{key}.placement"), group, volume);
        }
    }
    overlaps(check, scenario, volume);
}

/// Soft spheres know all faces but those that are printed for hard ones.
fn of_soft_spheres(check: &mut Check, scenario: &ScenarioFile, volume: &Volume) {
    let Faces { x, y, z } = volume.faces.unwrap_or_default();
    let faces = [("boundary", Some(volume.boundary)), ("faces.x", x), ("faces.y", y), ("faces.z", z)];
    for (key, _) in faces.iter().filter(|(_, of)| *of == Some(Boundary::Antipodal)) {
        let message =
            format!("antipodal faces belong to hard spheres; {} moves soft ones", scenario.engine.key());
        let help = "take \"periodic\", \"open\", \"reflecting\" or \"absorbing\"";
        check.fail_with(&format!("volume.{key}"), message, help);
    }
    if volume.deformation.is_some() && volume.boundaries().contains(&Boundary::Absorbing) {
        let message = "does not go with absorbing faces: what leaves would change where it stops".to_owned();
        check.fail_with(
            "volume.deformation",
            message,
            "let these faces be open or reflecting, or leave it out",
        );
    }
    let space = volume.space();
    if let Some(law) = &volume.deformation {
        deformation(check, law, &space);
    }
    for (index, group) in scenario.grains.iter().enumerate() {
        let key = format!("grains.{index}");
        if group.size.fault().is_none() {
            meets_one_image(check, &format!("{key}.size"), 2.0 * group.size.largest(), &space);
            inside(check, &format!("{key}.placement"), group, volume);
        }
    }
    let near_field = scenario.fields.as_ref().and_then(|fields| fields.near_field.as_ref());
    if let Some(law) = near_field.filter(|_| space.repeats()) {
        near_field_across(check, law, &space);
    }
}

/// A volume is deformed where space repeats itself, and toward the solid fraction at which it is to stop.
fn deformation(check: &mut Check, law: &Deformation, space: &Space) {
    let rates = law.strain_rate.map(Frequency::si);
    for (axis, (rate, name)) in rates.into_iter().zip(["x", "y", "z"]).enumerate() {
        if rate != 0.0 && !space.repeats_along(axis) {
            let message =
                format!("space does not repeat itself along {name}: there is nothing that presses there");
            let help = "take 0 there, or let the faces across it be periodic";
            check.fail_with(&format!("volume.deformation.strain_rate.{axis}"), message, help);
        }
    }
    if rates == [0.0; 3] {
        let message = "is 0 along all axes".to_owned();
        check.fail_with("volume.deformation.strain_rate", message, "remove volume.deformation");
    }
    if let Some(fraction) = law.solid_fraction
        && !(fraction > 0.0 && fraction < 1.0)
    {
        let message = format!("found {fraction}; a number above 0 and below 1 is wanted");
        check.fail("volume.deformation.solid_fraction", message);
    }
}

/// Two grains may meet in one of their images alone: the distance of centers at which they do is below half a period.
fn meets_one_image(check: &mut Check, key: &str, distance: f64, space: &Space) {
    let shortest = space.shortest_period();
    if 2.0 * distance >= shortest {
        let [distance, half] = told_apart([distance, 0.5 * shortest], "m");
        let message = format!(
            "grains would meet two images of one another: {distance} from center to center is not below half of the shortest \
             edge of [volume] across which space repeats itself, {half}"
        );
        check.fail_with(key, message, "enlarge the volume, or let its faces be open");
    }
}

/// Sums over all images are taken for laws that end at a cut-off.
fn near_field_across(check: &mut Check, law: &NearField, space: &Space) {
    if law.law.is_by_charge() {
        let message = "charges act on all images without end, which is not summed up".to_owned();
        let help = "let the faces of [volume] be open, or take another law";
        return check.fail_with("fields.near_field.law", message, help);
    }
    match law.cutoff {
        None => {
            let message = "is missing; where space repeats itself there are pairs without end".to_owned();
            let help = "give one below half of the shortest edge of [volume]";
            check.fail_with("fields.near_field.cutoff", message, help);
        }
        Some(cutoff) => meets_one_image(check, "fields.near_field.cutoff", cutoff.si(), space),
    }
}

/// The largest grain must fit into the volume.
fn fits(check: &mut Check, key: &str, group: &GrainGroup, volume: &Volume) {
    let edges = volume.edges();
    let (diameter, narrowest) = (2.0 * group.size.largest(), edges.x.min(edges.y).min(edges.z));
    if diameter > narrowest && volume.boundary != Boundary::Open {
        let (diameter, narrowest) = (shown(diameter, Length::DIMENSION), shown(narrowest, Length::DIMENSION));
        let message = format!("a grain of diameter {diameter} does not fit into [volume], {narrowest} wide");
        check.fail_with(&format!("{key}.size"), message, "enlarge the volume or take smaller grains");
    }
}

/// Places must have digits enough for the smallest grain.
fn can_be_told(check: &mut Check, key: &str, group: &GrainGroup, volume: &Volume) {
    let corner = volume.lower().max(volume.lower() * -1.0).max(volume.upper()).max(volume.upper() * -1.0);
    let (radius, mut farthest) = (group.size.smallest(), corner);
    match &group.placement {
        Placement::List(list) => {
            for place in list.positions.iter().map(|position| vector(*position)) {
                if resolution::spacing(place) > resolution::spacing(farthest) {
                    farthest = place;
                }
            }
        }
        // Tables bring their own radii; the run looks at them when it starts.
        Placement::Table(_) => return,
        _ => {}
    }
    let rounding = resolution::spacing(farthest);
    if !resolution::is_fine(rounding, radius) {
        let (radius, rounding, place) =
            (readable(radius, "m"), readable(rounding, "m"), readable(farthest.norm(), "m"));
        let message = format!(
            "a radius of {radius} is too small for places up to {place} from the origin: with 16 digits they are known to {rounding}"
        );
        let help = "put the origin amid the grains, or take a smaller volume or larger grains: a place must be known to 1e-5 \
                    of the radius";
        check.fail_with(&format!("{key}.size"), message, help);
    }
}

/// Whether a center may be there: anywhere within faces that grains pass, a radius away from faces that reflect them.
fn holds(volume: &Volume, [lower, upper]: [Vec3; 2], radius: f64) -> bool {
    let (low, high) = (volume.lower(), volume.upper());
    // Room for the rounding of a place that is written as a face and a radius.
    let slack = 1e-12 * volume.edges().norm();
    volume.boundaries().into_iter().enumerate().all(|(axis, boundary)| {
        let margin = match boundary {
            Boundary::Periodic | Boundary::Antipodal | Boundary::Absorbing => 0.0,
            Boundary::Reflecting => radius,
            Boundary::Open => return true,
        };
        let above = |x: f64, bound: f64| x - bound >= margin - slack;
        above(lower[axis], low[axis]) && above(high[axis], upper[axis])
    })
}

fn inside(check: &mut Check, key: &str, group: &GrainGroup, volume: &Volume) {
    match &group.placement {
        Placement::Random(law) => region(check, &format!("{key}.random"), &law.region, group, volume),
        Placement::Lattice(law) => region(check, &format!("{key}.lattice"), &law.region, group, volume),
        Placement::List(list) => {
            for (index, position) in list.positions.iter().enumerate() {
                let (here, center) = (format!("{key}.list.positions.{index}"), vector(*position));
                if holds(volume, [center; 2], group.size.smallest()) {
                    continue;
                }
                if holds(volume, [center; 2], 0.0) {
                    let message = "reaches out of [volume], whose faces reflect it".to_owned();
                    check.fail(&here, message);
                } else {
                    check.fail(&here, "lies outside [volume]".to_owned());
                }
            }
        }
        // Tables are held to the volume when they are placed.
        Placement::Fill(_) | Placement::Table(_) => {}
    }
}

/// Grains lie wholly inside their region, so centers keep a radius away from its surface.
fn region(check: &mut Check, key: &str, region: &Region, group: &GrainGroup, volume: &Volume) {
    let radius = group.size.smallest();
    let margin = Vec3::new(radius, radius, radius);
    let (lower, upper) = region.bounds();
    if lower.is_finite() && upper.is_finite() && !holds(volume, [lower + margin, upper - margin], radius) {
        let message = "reaches out of [volume]".to_owned();
        let help = "grains must start inside the volume; placement.fill fills it";
        check.fail_with(&format!("{key}.region"), message, help);
    }
}

/// A grain that a scenario writes out.
struct Written {
    key: String,
    center: Vec3,
    radius: f64,
}

/// Hard spheres must not overlap at the start, as far as positions and radii are written out.
fn overlaps(check: &mut Check, scenario: &ScenarioFile, volume: &Volume) {
    let written: Vec<Written> = scenario.grains.iter().enumerate().flat_map(of_group).collect();
    if written.len() > MOST_PAIRED {
        return;
    }
    for (index, grain) in written.iter().enumerate() {
        for other in &written[..index] {
            let (touching, distance) =
                (grain.radius + other.radius, volume.shortest(grain.center - other.center).norm());
            // The same place is another fault; what is written as touching may round to less.
            if distance > 0.0 && distance < touching * (1.0 - 1e-9) {
                let overlap = readable(touching - distance, "m");
                let message = format!("overlaps {} by {overlap}", other.key);
                check.fail_with(&grain.key, message, "hard spheres must be apart at the start");
                break;
            }
        }
    }
}

fn of_group((index, group): (usize, &GrainGroup)) -> Vec<Written> {
    let (smallest, largest) = (group.size.smallest(), group.size.largest());
    let Placement::List(GrainList { positions, .. }) = &group.placement else { return Vec::new() };
    if smallest != largest {
        return Vec::new();
    }
    let grain = |(number, position): (usize, &Triple<Length>)| Written {
        key: format!("grains.{index}.placement.list.positions.{number}"),
        center: vector(*position),
        radius: largest,
    };
    positions.iter().enumerate().map(grain).collect()
}
