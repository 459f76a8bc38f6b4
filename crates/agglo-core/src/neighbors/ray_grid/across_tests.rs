//! Rays across faces against all images, and by hand.

use super::*;
use crate::math::rng::{Purpose, Stream};

/// Images that are looked at on either side of the block: rays fly no farther than four of the shortest edges.
const MOST: i32 = 6;

fn place(stream: &mut Stream, [lower, upper]: [Vec3; 2]) -> Vec3 {
    let edges = upper - lower;
    lower + Vec3::new(edges.x * stream.uniform(), edges.y * stream.uniform(), edges.z * stream.uniform())
}

/// The nearest of all images, but that which the ray left: the one nearest to its origin.
fn brute_force(space: &Space, span: &RaySpan, positions: &[Vec3], radii: &[f64]) -> Option<ImageHit> {
    let steps = |axis: usize| if space.repeats_along(axis) { -MOST..=MOST } else { 0..=0 };
    let mut best: Option<ImageHit> = None;
    for (number, (&center, &radius)) in (0_u32..).zip(positions.iter().zip(radii)) {
        let mut images = Vec::new();
        for x in steps(0) {
            for y in steps(1) {
                images.extend(steps(2).map(|z| [x, y, z]));
            }
        }
        let away = |image: &[i32; 3]| (span.origin - space.shift_to(*image) - center).norm();
        let left = images.iter().copied().min_by(|a, b| away(a).total_cmp(&away(b)));
        for image in images {
            let shift = space.shift_to(image);
            let moved = RaySpan { origin: span.origin - shift, ..*span };
            if let Some(at) = moved.meets(Sphere { center, radius })
                && at <= span.to
                && !(number == span.skip && Some(image) == left)
                && best.is_none_or(|best| at < best.hit.at)
            {
                best = Some(ImageHit { hit: SphereHit { at, sphere: number }, shift });
            }
        }
    }
    best
}

/// Every choice of axes, blocks of unequal edges, sizes of ratio 5, rays along axes and askew that start on spheres and anywhere, while
/// spheres wander and come home through the faces: equal to the last bit, and the grid is kept while none has moved by the margin.
#[test]
fn the_grid_finds_the_nearest_of_all_images_while_spheres_wander() {
    let mut stream = Stream::new(21, Purpose::Sampling, 0);
    for axes in 1..8_u32 {
        let axes = [0, 1, 2].map(|axis| axes >> axis & 1 == 1);
        let corners = [Vec3::new(-0.4, 1.0, -7.0), Vec3::new(0.6, 1.8, -5.7)];
        let space = Space::repeating(corners, axes);
        let count = [1, 6, 40][(stream.uniform() * 3.0) as usize];
        let mut positions: Vec<Vec3> = (0..count).map(|_| place(&mut stream, corners)).collect();
        // Diameters are below half of the shortest edge, 0.8.
        let radii: Vec<f64> = (0..count).map(|_| 0.03 * 5.0_f64.powf(stream.uniform())).collect();
        let mut grid = RayGrid::across(space);
        let (mut hits, mut again) = (0, 0);
        for _ in 0..12 {
            grid.update(&positions, &radii);
            for _ in 0..40 {
                let mut direction = stream.direction();
                if stream.uniform() < 0.3 {
                    direction = Vec3::AXES[(stream.uniform() * 3.0) as usize];
                }
                let skip = (stream.uniform() * 1.5 * f64::from(count)) as u32;
                let mut origin = place(&mut stream, corners);
                if let Some(center) = positions.get(skip as usize) {
                    // It leaves a sphere, at home or in some image of it.
                    origin = space.home(*center + direction * radii[skip as usize]).0;
                }
                let from = if stream.uniform() < 0.5 { 0.0 } else { 0.3 * stream.uniform() };
                let span = RaySpan { origin, direction, from, to: from + 3.0 * stream.uniform(), skip };
                let found = grid.nearest_image(&span);
                assert_eq!(found, brute_force(&space, &span, &positions, &radii), "{axes:?} {span:?}");
                hits += usize::from(found.is_some());
                again += usize::from(found.is_some_and(|found| found.hit.sphere == skip));
            }
            for position in &mut positions {
                *position = space.home(*position + stream.direction() * (0.004 * stream.uniform())).0;
            }
        }
        assert_above!(hits, 20, "{axes:?}, {count} spheres");
        assert!(count > 1 || again > 0, "rays that come back to the sphere that they left: {axes:?}");
        assert_below!(grid.builds(), 12, "{axes:?}");
    }
}

/// Whatever spheres do within the margin, a ray that is clear meets none of their images.
#[test]
fn clear_rays_meet_no_image() {
    let mut stream = Stream::new(22, Purpose::Sampling, 0);
    let corners = [Vec3::ZERO, Vec3::new(1.0, 1.2, 0.9)];
    let space = Space::repeating(corners, [true, true, false]);
    let start: Vec<Vec3> = (0..60).map(|_| place(&mut stream, corners)).collect();
    let radii = vec![0.06; 60];
    let mut grid = RayGrid::across(space);
    grid.update(&start, &radii);
    let spans: Vec<RaySpan> = (0..300)
        .map(|_| {
            let (origin, direction) = (place(&mut stream, corners), stream.direction());
            RaySpan { origin, direction, from: 0.0, to: 2.0, skip: NO_SPHERE }
        })
        .collect();
    let clear: Vec<Clear> = spans.iter().map(|span| grid.clear_until(span)).collect();
    assert_above!(clear.iter().filter(|clear| clear.until > 0.1).count(), 50);
    for _ in 0..30 {
        let moved = |place: &Vec3| space.home(*place + stream.direction() * (0.999_999 * grid.margin)).0;
        let moved: Vec<Vec3> = start.iter().map(moved).collect();
        grid.update(&moved, &radii);
        assert_eq!(grid.builds(), 1, "builds");
        for (span, clear) in spans.iter().zip(&clear).filter(|(_, clear)| clear.until > 0.0) {
            let to = clear.until * (1.0 - 1e-14);
            let met = grid.nearest_image(&RaySpan { to, ..*span });
            assert!(met.is_none() && grid.is_clear(clear, to), "clear until {}, met {met:?}", clear.until);
        }
    }
}

/// One sphere in a block of edge 1: a ray that leaves it meets its next image, one edge less a diameter on, and in another direction
/// the one across a corner.
#[test]
fn a_sphere_is_met_again_as_its_own_image() {
    let space = Space::repeating([Vec3::ZERO, Vec3::new(1.0, 1.0, 1.0)], [true; 3]);
    let mut grid = RayGrid::across(space);
    let center = Vec3::new(0.95, 0.5, 0.5);
    grid.update(&[center], &[0.1]);
    let from = |direction: Vec3| RaySpan {
        origin: center + direction * 0.1,
        direction,
        from: 0.0,
        to: 9.0,
        skip: 0,
    };
    for (direction, way) in [
        (Vec3::AXES[0], 0.8),
        (-Vec3::AXES[1], 0.8),
        (Vec3::new(1.0, 1.0, 0.0).normalized(), 2.0_f64.sqrt() - 0.2),
        (Vec3::new(1.0, -2.0, 3.0).normalized(), 14.0_f64.sqrt() - 0.2),
    ] {
        let met = grid.nearest_image(&from(direction)).unwrap();
        assert_near!(met.hit.at, way, 1e-14, "m, along {direction:?}");
    }
    // The surface reaches across the face: a point just inside the lower face is in the sphere's image.
    assert_eq!(grid.sphere_around(Vec3::new(0.04, 0.5, 0.5)), Some(0));
    assert_eq!(grid.sphere_around(Vec3::new(0.06, 0.5, 0.5)), None);
    assert_eq!(grid.sphere_around(Vec3::new(-2.96, 7.5, 0.5)), Some(0));
}
