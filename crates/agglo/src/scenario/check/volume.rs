//! Rules of the control volume and of what lies in it.

use super::{Check, corners, shown};
use crate::domain::{Boundary, Region, Volume, resolution};
use crate::math::Vec3;
use crate::packing::{GrainGroup, GrainList, Placement};
use crate::scenario::file::ScenarioFile;
use crate::text::readable;
use crate::units::{Length, Triple, vector};

/// Lists with more positions than this are held to overlaps when they are placed, where cells make that cheap.
const MOST_PAIRED: usize = 4000;

pub(super) fn check(check: &mut Check, scenario: &ScenarioFile) {
    let Some(volume) = &scenario.volume else { return };
    if !corners(check, "volume", volume.lower, volume.upper) || !scenario.engine.is_hard() {
        return;
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
    let margin = match volume.boundary {
        Boundary::Periodic | Boundary::Antipodal => 0.0,
        Boundary::Reflecting => radius,
        Boundary::Open => return true,
    };
    let (low, high) = (volume.lower(), volume.upper());
    // Room for the rounding of a place that is written as a face and a radius.
    let slack = 1e-12 * volume.edges().norm();
    let above = |x: f64, bound: f64| x - bound >= margin - slack;
    above(lower.x, low.x)
        && above(lower.y, low.y)
        && above(lower.z, low.z)
        && above(high.x, upper.x)
        && above(high.y, upper.y)
        && above(high.z, upper.z)
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
