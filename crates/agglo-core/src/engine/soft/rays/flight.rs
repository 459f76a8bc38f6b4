//! Whether saved rays are ones that a run can have in flight.

use crate::acoustics::Flight;
use crate::engine::soft::settings::Settings;
use crate::engine::validate::{Fault, MOST_COUNTED, ensure, finite};
use crate::neighbors::ray_grid::NO_SPHERE;

/// Rays in flight with their pulses, among `n` grains.
pub(in crate::engine::soft) fn validate_flight(
    flight: &Flight,
    settings: &Settings,
    n: usize,
) -> Result<(), Fault> {
    let beams = settings.acoustics.as_ref().map_or(0, |acoustics| acoustics.beams.len());
    for pulse in flight.pulses() {
        finite("pulse", pulse)?;
        let counts = [pulse.reflections, pulse.reflections_at_walls, pulse.segments]
            .iter()
            .all(|count| *count < MOST_COUNTED);
        let rays = [pulse.capped, pulse.crushed, pulse.blocked, pulse.overlong, pulse.in_flight]
            .iter()
            .all(|rays| *rays <= pulse.rays);
        let longest = pulse.longest_chain < u32::MAX / 2;
        ensure(counts && rays && longest && (pulse.beam as usize) < beams, || {
            "pulse: a count is too large".to_owned()
        })?;
    }
    let pulses = flight.pulses().len();
    let mut flying = vec![0_u32; pulses];
    let faces: usize = settings.walls.iter().map(|wall| wall.shape.faces() as usize).sum();
    let mut last = None;
    for ray in flight.rays() {
        let of_walls = ray.last_face().is_some_and(|face| (face as usize) < faces);
        let hit = ray.last_hit == NO_SPHERE || of_walls || (ray.last_hit as usize) < n;
        let bounces = ray.bounces < u32::MAX / 2;
        ensure(hit && bounces && (ray.pulse as usize) < pulses, || "ray: an index is too large".to_owned())?;
        flying[ray.pulse as usize] += 1;
        // Sums go by the numbers of rays.
        let place = (ray.pulse, ray.number);
        let in_order =
            last.is_none_or(|last| last < place) && ray.number < flight.pulses()[ray.pulse as usize].rays;
        last = Some(place);
        ensure(in_order, || "ray: out of order".to_owned())?;
        let numbers = [ray.traveled, ray.power, ray.first_power, ray.area, ray.way];
        let holds = ray.origin.is_finite() && numbers.iter().all(|value| value.is_finite() && *value >= 0.0);
        // Directions are unit vectors but for rounding.
        ensure(holds && (ray.direction.norm() - 1.0).abs() < 1e-6, || "ray: not a ray".to_owned())?;
    }
    let same = flight.pulses().iter().zip(&flying).all(|(pulse, rays)| pulse.in_flight == *rays);
    ensure(same, || "pulse: another number of rays in flight".to_owned())
}
