//! Rays at walls: closed forms in corners, cavities and boxes, balances, and grains and walls together.

use std::collections::BTreeMap;

use agglo::walls::{Constant, Cuboid, Cylinder, Motion, Plane, Shape, Side, Sphere, Wall, Walls};

use super::*;

/// Nearly all is reflected: 1 - ℛ = 4/1e12 at normal incidence.
const MIRROR: Interface = Interface { impedance_ratio: 1e12, speed_ratio: 1.0, shear_ratio: 0.0 };

fn wall(shape: Shape, motion: Motion) -> Wall {
    Wall {
        name: "wall".to_owned(),
        shape,
        material: "steel".to_owned(),
        temperature: Quantity(300.0),
        motion,
    }
}

fn plane(point: [f64; 3], normal: [f64; 3]) -> Shape {
    Shape::Plane(Plane { point: point.map(Quantity), normal, opening: None })
}

fn cavity(radius: f64) -> Shape {
    Shape::Sphere(Sphere { center: [Quantity(0.0); 3], radius: Quantity(radius), side: Side::Inside })
}

fn among(shapes: Vec<Shape>, interface: Interface, ends: Ends) -> Tracer {
    let walls: Vec<Wall> = shapes.into_iter().map(|shape| wall(shape, Motion::Fixed)).collect();
    Tracer::new(ends, vec![interface]).among(Walls::new(&walls, &BTreeMap::new(), 1.0))
}

fn none() -> Packing {
    Packing::new(Vec::new(), 0.1)
}

/// Rays from a small disc.
fn from(start: [f64; 3], direction: [f64; 3], radius: f64, rays: u32) -> Beam {
    let axis = Vec3::from(direction).normalized();
    Beam { start: start.map(Quantity), radius: Quantity(radius), ..beam(axis, rays, Pattern::Sunflower) }
}

fn shot(beam: &Beam, tracer: &mut Tracer, grains: &Packing) -> (Flight, Vec<Hit>) {
    let mut flight = Flight::default();
    flight.launch(beam, &Medium::default(), 1, 0, 0);
    let hits = tracer.trace(&mut flight, &grains.targets());
    assert_empty!(flight.rays());
    (flight, hits)
}

/// A plane mirror takes 2 P cos²θ/c of the beam's momentum along its normal: 2 I/c as a pressure at normal incidence. One of ceramic takes
/// 1 + ℛ of it and 1 - ℛ of the power, ℛ = (17/19)² at normal incidence.
#[test]
fn val_pressure_on_a_plane_mirror() {
    let law = RayForce::RadiationPressure(RadiationPressure { duration: Quantity(1.0) });
    for (interface, degrees, reflected) in
        [(MIRROR, 0.0_f64, 1.0), (MIRROR, 40.0, 1.0), (CERAMIC, 0.0, 289.0 / 361.0)]
    {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let mut tracer = among(vec![plane([0.0, 0.0, 0.0], [0.0, 0.0, 1.0])], interface, FOLLOW_ALL);
        let (flight, hits) = shot(&from([0.0, 0.0, 1.0], [sin, 0.0, -cos], 0.2, 50), &mut tracer, &none());
        let count = flight.pulses()[0];
        assert_eq!((hits.len(), count.reflections_at_walls, count.segments), (50, 50, 100));
        assert_all!(hits.iter(), |hit| hit.wall == 0 && hit.grain == agglo::acoustics::NONE);
        let force =
            hits.iter().fold(Vec3::ZERO, |sum, hit| sum + law.force(hit, WHATEVER, &Medium::default()));
        let wanted = count.power_in / 1500.0 * cos * (1.0 + reflected);
        assert_close!(-force.z, wanted, 1e-9, "N at {degrees} degrees");
        assert_close!(count.power_escaped, count.power_in * reflected, 1e-9, "W");
        assert_near!(count.power_into_walls, count.power_in * (1.0 - reflected), 1e-9 * count.power_in, "W");
    }
}

/// Three mirrors at right angles send every ray back where it came from.
#[test]
fn val_a_corner_returns_the_ray() {
    let planes = Vec3::AXES.map(|axis| plane([0.0; 3], axis.to_array()));
    let mut tracer = among(planes.to_vec(), MIRROR, FOLLOW_ALL);
    let beam = from([1.0, 0.9, 1.2], [-1.0, -0.8, -1.1], 0.05, 100);
    let (flight, _) = shot(&beam, &mut tracer, &none());
    let count = flight.pulses()[0];
    assert_eq!(count.reflections_at_walls, 300);
    assert_near_vector!(count.flow_ended, -beam.axis() * count.power_in, 1e-9 * count.power_in, "W");
}

/// In a box a ray is where its unfolded straight line, folded at the faces, says; in a sphere and in a cylinder all chords are as long as the first.
/// Rounding adds up over 400 bounces.
#[test]
fn val_chords_in_a_box_a_sphere_and_a_cylinder() {
    let ends = || Ends { bounces: 400, ..FOLLOW_ALL };
    let (start, direction) = ([0.3, 0.2, 0.4], [0.48, -0.6, 0.64]);
    let beam = from(start, direction, 1e-9, 1);
    let edges = [1.0, 0.7, 0.9];
    let block =
        Shape::Box(Cuboid { lower: [Quantity(0.0); 3], upper: edges.map(Quantity), side: Side::Inside });
    let (_, hits) = shot(&beam, &mut among(vec![block], MIRROR, ends()), &none());
    assert_eq!(hits.len(), 400);
    let (mut way, mut last) = (0.0, Vec3::from(start));
    for hit in &hits {
        way += (hit.point - last).norm();
        last = hit.point;
        for axis in 0..3 {
            let unfolded =
                (start[axis] + Vec3::from(direction).normalized()[axis] * way).rem_euclid(2.0 * edges[axis]);
            let folded = unfolded.min(2.0 * edges[axis] - unfolded);
            assert_near!(hit.point[axis], folded, 1e-6, "m along axis {axis}, after {way} m");
        }
    }
    let cylinder = Shape::Cylinder(Cylinder {
        point: [Quantity(0.0); 3],
        axis: [0.0, 0.0, 1.0],
        radius: Quantity(1.0),
        length: None,
        side: Side::Inside,
    });
    for shape in [cavity(1.0), cylinder] {
        let (_, hits) = shot(&beam, &mut among(vec![shape.clone()], MIRROR, ends()), &none());
        assert_eq!(hits.len(), 400);
        let chord = (hits[1].point - hits[0].point).norm();
        for pair in hits.windows(2) {
            assert_near!((pair[1].point - pair[0].point).norm(), chord, 1e-10, "m, {}", shape.word());
        }
    }
}

/// Whatever a ray meets first in a cavity with grains is what naive formulas say: all grains and the cavity, one by one. Three bounces, an
/// offset of 1e-16 growing some tens of times at each.
#[test]
fn grains_and_walls_are_met_as_brute_force_says() {
    let grains = Packing::random(60, 0.12, 5);
    let beam = from([-0.05, 0.02, 0.03], [0.2, 0.5, -0.7], 0.03, 400);
    let mut tracer = among(vec![cavity(1.1)], CERAMIC, Ends { bounces: 3, ..FOLLOW_ALL });
    let mut flight = Flight::default();
    flight.launch(&beam, &Medium::default(), 1, 0, 0);
    tracer.drop_blocked(&mut flight, &grains.targets());
    let rays: Vec<(Vec3, Vec3)> = flight.rays().iter().map(|ray| (ray.origin, ray.direction)).collect();
    assert_filled!(rays);
    let hits = tracer.trace(&mut flight, &grains.targets());
    let (mut at, mut walls) = (0, 0);
    for (mut origin, mut direction) in rays {
        for bounce in 0..3 {
            // The far root in the cavity, the near one at grains ahead.
            let roots = |center: Vec3, radius: f64| {
                let (b, c) =
                    ((origin - center).dot(direction), (origin - center).norm_squared() - radius * radius);
                (b * b - c >= 0.0).then(|| [-b - (b * b - c).sqrt(), -b + (b * b - c).sqrt()])
            };
            let mut nearest = (roots(Vec3::ZERO, 1.1).unwrap()[1], None);
            for (grain, center) in grains.positions.iter().enumerate() {
                if let Some([near, _]) =
                    roots(*center, 0.12).filter(|roots| roots[0] > 1e-9 && roots[0] < nearest.0)
                {
                    nearest = (near, Some(grain));
                }
            }
            let hit = &hits[at];
            let found = (hit.grain != agglo::acoustics::NONE).then_some(hit.grain as usize);
            assert_eq!(found, nearest.1, "what bounce {bounce} meets");
            assert_near_vector!(hit.point, origin + direction * nearest.0, 1e-9, "m");
            walls += usize::from(found.is_none());
            at += 1;
            (origin, direction) = (hit.point, hit.direction_out);
        }
    }
    assert_eq!(at, hits.len(), "hits");
    assert_between!(walls, 50..=hits.len() - 50, "of them at the wall");
}

/// Nothing leaves a vessel: power is in grains, in walls or below the truncation; and what momentum rays lose, grains and walls get.
#[test]
fn val_power_and_momentum_close_in_a_vessel() {
    let grains = Packing::random(100, 0.1, 8);
    let beam = from([-0.02, 0.02, 0.03], [0.2, 0.5, -0.7], 0.02, 500);
    let mut tracer = among(vec![cavity(1.05)], CERAMIC, Ends { truncation: 0.1, ..FOLLOW_ALL });
    let (flight, hits) = shot(&beam, &mut tracer, &grains);
    let count = flight.pulses()[0];
    let out = count.power_absorbed + count.power_into_walls + count.power_truncated;
    assert_close!(out, count.power_in, 1e-12, "W");
    assert_eq!(count.power_escaped, 0.0);
    assert_above!(count.power_into_walls, 1e-3 * count.power_in, "W");
    let given = hits.iter().fold(Vec3::ZERO, |sum, hit| {
        sum + (hit.direction_in - hit.direction_out * hit.reflectance) * hit.power_in
    });
    assert_near_vector!(given + count.flow_ended, beam.axis() * count.power_in, 1e-10 * count.power_in, "W");
}

/// Rays meet a moving wall where it is at the time, and those that start behind it are dropped.
#[test]
fn moving_walls_are_met_where_they_are() {
    let velocity = [0.0, 0.0, 2.0].map(Quantity);
    let motion = Motion::Constant(Constant { velocity, angular_velocity: [Quantity(0.0); 3], about: None });
    let walls = Walls::new(&[wall(plane([0.0; 3], [0.0, 0.0, 1.0]), motion)], &BTreeMap::new(), 1.0);
    let mut tracer = Tracer::new(FOLLOW_ALL, vec![MIRROR]).among(walls);
    for (time, height) in [(0.0, 0.0), (0.1, 0.2), (0.4, 0.8)] {
        tracer.stand_walls([time; 2]);
        let (_, hits) = shot(&from([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], 0.1, 3), &mut tracer, &none());
        assert_eq!(hits.len(), 3);
        assert_all!(hits.iter(), |hit| (hit.point.z - height).abs() < 1e-14);
    }
    tracer.stand_walls([0.6; 2]);
    let mut flight = Flight::default();
    flight.launch(&from([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], 0.1, 3), &Medium::default(), 1, 0, 0);
    assert_eq!(tracer.drop_walled(&mut flight), Some((3, 0)));
    assert_eq!(flight.pulses()[0].power_truncated, flight.pulses()[0].power_in, "W");
}
