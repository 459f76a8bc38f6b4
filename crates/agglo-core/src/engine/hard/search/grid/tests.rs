use super::*;
use crate::math::rng::{Purpose, Stream};
use crate::units::Quantity;

const BOUNDARIES: [Boundary; 4] =
    [Boundary::Periodic, Boundary::Antipodal, Boundary::Reflecting, Boundary::Open];

/// A block that is no cube.
fn volume(boundary: Boundary) -> Volume {
    Volume {
        lower: [-1.0, 2.0, 0.0].map(Quantity),
        upper: [1.0, 3.5, 1.2].map(Quantity),
        boundary,
        faces: None,
        deformation: None,
    }
}

struct Filed {
    grid: Grid,
    spheres: Vec<Sphere>,
    next_events: Vec<NextEvent>,
}

/// Spheres of radii 1 : 30 at random, which may overlap; an open volume has them `spread` times as far out.
fn filed(boundary: Boundary, count: usize, spread: f64, seed: u64) -> Filed {
    let volume = volume(boundary);
    let mut stream = Stream::new(seed, Purpose::Sampling, 0);
    let middle = (volume.lower() + volume.upper()) * 0.5;
    let mut sphere = || {
        let part = Vec3::new(stream.uniform(), stream.uniform(), stream.uniform()) - Vec3::new(0.5, 0.5, 0.5);
        let [x, y, z] = (part * spread).to_array();
        let edges = volume.edges();
        Sphere {
            position: middle + Vec3::new(x * edges.x, y * edges.y, z * edges.z),
            velocity: stream.direction() * 3.0,
            time: 0.0,
            radius: 0.6 * 30_f64.powf(-stream.uniform()),
        }
    };
    let spheres: Vec<Sphere> = (0..count).map(|_| sphere()).collect();
    let smallest = spheres.iter().map(|sphere| 2.0 * sphere.radius).fold(f64::MAX, f64::min);
    let mut grid = Grid::new(&volume, smallest, count);
    grid.hold(count);
    let mut next_events = vec![NextEvent::EMPTY; count];
    for ((next_event, sphere), number) in next_events.iter_mut().zip(&spheres).zip(0..) {
        next_event.level = grid.level_of(sphere.radius);
        next_event.cell = grid.cell_of(next_event.level, sphere.position);
        grid.link(next_event, number);
    }
    Filed { grid, spheres, next_events }
}

fn images(boundary: Boundary) -> Vec<[i8; 3]> {
    let reach = i8::from(boundary == Boundary::Periodic);
    let line = || -reach..=reach;
    line().flat_map(|x| line().flat_map(move |y| line().map(move |z| [x, y, z]))).collect()
}

/// Who touches whom, in which image, by brute force; each must be seen from the finer one of the two, and once only.
#[test]
fn neighbors_are_those_of_brute_force() {
    let mut touching = 0;
    for boundary in BOUNDARIES {
        for (count, spread, seed) in [(2, 1.0, 1), (9, 1.0, 2), (60, 1.0, 3), (400, 1.0, 4), (60, 3.0, 5)] {
            let spread = if boundary == Boundary::Open { spread } else { 1.0 };
            let Filed { grid, spheres, next_events } = filed(boundary, count, spread, seed);
            for (a, one) in spheres.iter().enumerate() {
                let mut seen: Vec<(u32, [i8; 3])> = Vec::new();
                grid.visit_around(&next_events[a], |other, image| seen.push((other, image)));
                let visits = seen.len();
                seen.sort_unstable();
                seen.dedup();
                assert_eq!(seen.len(), visits, "seen twice with {boundary:?}");
                for (b, other) in spheres.iter().enumerate() {
                    if b == a || next_events[b].level > next_events[a].level {
                        continue;
                    }
                    for image in images(boundary) {
                        let between = other.position + grid.shift(image) - one.position;
                        if between.norm() <= one.radius + other.radius {
                            touching += 1;
                            assert!(seen.contains(&(b as u32, image)), "{a} {b} {image:?} {boundary:?}");
                        }
                    }
                }
            }
        }
    }
    assert!(touching > 10_000, "{touching}");
}

/// Far outside an open volume, where numbers of cells are large and fold into few lists.
#[test]
fn an_open_volume_has_no_end() {
    for spread in [30.0, 1e3, 1e6] {
        let mut found = filed(Boundary::Open, 40, spread, 7);
        // Twins next to each, of every size, so that somebody is near.
        let twins: Vec<Sphere> = found
            .spheres
            .iter()
            .map(|sphere| Sphere {
                position: sphere.position + Vec3::AXES[1] * (1.5 * sphere.radius),
                ..*sphere
            })
            .collect();
        found.grid.hold(80);
        for (twin, number) in twins.iter().zip(40..) {
            let mut next_event = NextEvent { level: found.grid.level_of(twin.radius), ..NextEvent::EMPTY };
            next_event.cell = found.grid.cell_of(next_event.level, twin.position);
            found.grid.link(&mut next_event, number);
        }
        for at in 0..40 {
            let mut seen = Vec::new();
            found.grid.visit_around(&found.next_events[at], |other, image| seen.push((other, image)));
            assert!(seen.contains(&(at as u32 + 40, [0; 3])), "{at} at {spread}");
            let mut near = Vec::new();
            let level = found.next_events[at].level as usize;
            let (place, reach) = (found.spheres[at].position, 1.6 * found.spheres[at].radius);
            found.grid.visit_within(level, block(place, reach), |other, image| near.push((other, image)));
            assert_has!(near, &(at as u32 + 40, [0; 3]));
            assert_has!(near, &(at as u32, [0; 3]));
        }
    }
}

/// All that is within reach along each axis.
fn block(place: Vec3, reach: f64) -> [Vec3; 2] {
    let corner = Vec3::new(reach, reach, reach);
    [place - corner, place + corner]
}

/// Everyone of a level whose center is within reach along each axis, once per image.
#[test]
fn searches_within_a_reach() {
    for boundary in BOUNDARIES {
        let Filed { grid, spheres, next_events } = filed(boundary, 120, 1.0, 11);
        for (center, reach) in spheres.iter().zip([0.01, 0.05, 0.2, 0.5, 1.1].into_iter().cycle()) {
            for number in 0..grid.levels().len() {
                let mut seen = Vec::new();
                grid.visit_within(number, block(center.position, reach), |other, image| {
                    seen.push((other, image));
                });
                let visits = seen.len();
                seen.sort_unstable();
                seen.dedup();
                assert_eq!(seen.len(), visits, "seen twice with {boundary:?}");
                for (b, other) in
                    spheres.iter().enumerate().filter(|(b, _)| next_events[*b].level as usize == number)
                {
                    for image in images(boundary) {
                        let between = (other.position + grid.shift(image) - center.position).to_array();
                        let is_near = between.iter().all(|along| along.abs() <= reach * (1.0 - 1e-12));
                        assert!(!is_near || seen.contains(&(b as u32, image)), "{b} {image:?} {boundary:?}");
                    }
                }
            }
        }
    }
}

/// Each sphere lies in the finest level whose cells are as wide as it, and a fine cell lies in one coarse cell.
#[test]
fn levels_are_nested() {
    let Filed { grid, spheres, next_events } = filed(Boundary::Periodic, 400, 1.0, 13);
    assert!(grid.levels().len() >= 3, "{}", grid.levels().len());
    for (sphere, next_event) in spheres.iter().zip(&next_events) {
        let fits = |level: usize| 2.0 * sphere.radius <= grid.levels()[level].widest();
        let own = next_event.level as usize;
        assert!(own == 0 || fits(own), "a grain does not fit into its level {own}");
        assert_all!(own + 1..grid.levels().len(), |finer| !fits(finer));
        for coarser in 0..own {
            let cell = grid.coarser_cell(next_event.cell, next_event.level, coarser);
            assert_eq!(cell, grid.cell_of(coarser as u8, sphere.position));
        }
    }
}

/// A sphere is in its cell until its exit and at a face or wall at that time.
#[test]
fn exits_are_at_faces() {
    for boundary in BOUNDARIES {
        let Filed { grid, spheres, next_events } = filed(boundary, 200, 1.0, 17);
        for (sphere, next_event) in spheres.iter().zip(&next_events) {
            let (time, exit) = grid.exit(next_event, sphere, 0.0);
            let level = &grid.levels()[next_event.level as usize];
            let (place, axis) = (sphere.at(time), exit.axis as usize);
            let face = next_event.cell[axis] + i32::from(exit.side > 0);
            let mut at = grid.frame.lower[axis] + grid.face(level, axis, face);
            if exit.is_wall {
                at -= f64::from(exit.side) * sphere.radius;
            }
            // One that overlaps a wall is there already.
            let overlaps = exit.is_wall && time == 0.0;
            assert!(overlaps || (place[axis] - at).abs() < 1e-14, "{} and not {at}", place[axis]);
            assert_eq!(exit.side > 0, sphere.velocity[axis] > 0.0);
            assert!(!exit.is_wall || boundary == Boundary::Reflecting, "a wall in {boundary:?}");
            let before = sphere.at(time * (1.0 - 1e-9));
            assert_eq!(grid.cell_of(next_event.level, before), next_event.cell);
        }
    }
}

/// Cells that fly: a sphere is in its cell until its exit, and whoever left the block comes back by whole edges.
#[test]
fn cells_fly_with_a_wind() {
    let volume = volume(Boundary::Periodic);
    let Filed { mut grid, spheres, .. } = filed(Boundary::Periodic, 200, 1.0, 19);
    grid.set_off(&volume, 0.5, Vec3::new(40.0, -2.0, 0.3));
    for (sphere, time) in spheres.iter().zip([0.5, 0.9, 7.0].into_iter().cycle()) {
        let mut sphere = *sphere;
        let back = grid.way_back(sphere.at(time), time);
        sphere.position += back;
        for axis in 0..3 {
            let edges = back[axis] / grid.edges[axis];
            assert_near!(edges, edges.round(), 1e-12);
            let from_corner = (sphere.at(time) - grid.frame.flown(time) - grid.frame.lower)[axis];
            // Positions of some hundred edges are rounded at 1e-14 of an edge.
            assert!((-1e-12..grid.edges[axis] + 1e-12).contains(&from_corner), "{from_corner}");
        }
        let mut next_event = NextEvent::EMPTY;
        grid.seat(&mut next_event, &sphere, time);
        let (exit, _) = grid.exit(&next_event, &sphere, time);
        let cell = |time: f64| grid.cell_of(next_event.level, sphere.at(time) - grid.frame.flown(time));
        let stay = exit - time;
        assert_above!(stay, 0.0);
        assert_finite!(stay);
        assert_eq!(cell(time + stay * (1.0 - 1e-6)), next_event.cell);
        // Beyond a face of the whole block cells are clamped.
        let later = time + stay * (1.0 + 1e-6);
        let after = sphere.at(later) - grid.frame.flown(later);
        assert!(
            !volume.contains(after) || cell(later) != next_event.cell,
            "still in cell {:?} at {after:?}",
            next_event.cell
        );
    }
    let back = grid.take_back(&volume, 7.0);
    let flown = Vec3::new(40.0, -2.0, 0.3) * 6.5 + back;
    for axis in 0..3 {
        assert!(flown[axis] >= -1e-12 && flown[axis] < grid.edges[axis], "{flown:?}");
    }
}

/// Whichever edge has the narrowest cells: with spheres of 1 two of 1.05 on an edge of 2.1, and seven of 1.14 on one of 8.
#[test]
fn the_narrowest_cell_of_any_axis() {
    for edges in [[2.1, 8.0, 8.0], [8.0, 2.1, 8.0], [8.0, 8.0, 2.1]] {
        let volume = Volume {
            lower: [Quantity(0.0); 3],
            upper: edges.map(Quantity),
            boundary: Boundary::Reflecting,
            faces: None,
            deformation: None,
        };
        let grid = Grid::new(&volume, 1.0, 200);
        let finest = grid.levels().last().unwrap();
        let widths = [0, 1, 2].map(|axis| edges[axis] / f64::from(finest.counts[axis]));
        assert_close!(
            grid.narrowest_cell(),
            widths.into_iter().fold(f64::MAX, f64::min),
            1e-15,
            "in m, {edges:?}"
        );
        assert!(
            widths.iter().any(|width| *width > 1.01 * grid.narrowest_cell()),
            "cells are cubes: {widths:?}"
        );
    }
}
