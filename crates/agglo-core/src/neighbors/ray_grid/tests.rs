//! The grid against brute force and by hand.

use super::*;
use crate::math::rng::{Purpose, Stream};

fn point(stream: &mut Stream, scale: f64) -> Vec3 {
    Vec3::new(stream.uniform() - 0.5, stream.uniform() - 0.5, stream.uniform() - 0.5) * (2.0 * scale)
}

fn brute_force(span: &RaySpan, positions: &[Vec3], radii: &[f64]) -> Option<SphereHit> {
    let mut best: Option<SphereHit> = None;
    for (number, (&center, &radius)) in positions.iter().zip(radii).enumerate() {
        let number = number as u32;
        if let Some(at) = span.meets(Sphere { center, radius })
            && number != span.skip
            && at <= span.to
            && best.is_none_or(|hit| at < hit.at)
        {
            best = Some(SphereHit { at, sphere: number });
        }
    }
    best
}

/// Spheres of size ratio 10 that overlap, move and partly lie outside; results are equal to the last bit.
#[test]
fn grid_finds_what_brute_force_finds_while_spheres_move() {
    let mut stream = Stream::new(3, Purpose::Sampling, 0);
    for count in [1, 2, 40, 700] {
        let corner = Vec3::new(1.0, 1.0, 1.0);
        let mut grid = RayGrid::new(-corner, corner);
        let mut positions: Vec<Vec3> = (0..count).map(|_| point(&mut stream, 1.3)).collect();
        let radii: Vec<f64> = (0..count).map(|_| 0.02 * 10.0_f64.powf(stream.uniform())).collect();
        let mut hits = 0;
        for _ in 0..25 {
            grid.update(&positions, &radii);
            for _ in 0..400 {
                let mut direction = stream.direction();
                if stream.uniform() < 0.2 {
                    direction = Vec3::AXES[(stream.uniform() * 3.0) as usize];
                }
                let from = if stream.uniform() < 0.5 { 0.0 } else { 0.3 * stream.uniform() };
                let origin = point(&mut stream, 1.0) - direction * from;
                let inside = crate::domain::Region::Box(crate::domain::Block {
                    lower: (-corner).to_array().map(crate::units::Quantity),
                    upper: corner.to_array().map(crate::units::Quantity),
                });
                let to = inside.exit_distance(origin, direction).min(from + 3.0 * stream.uniform());
                let skip = (stream.uniform() * count as f64) as u32;
                let span = RaySpan { origin, direction, from, to, skip };
                let found = grid.nearest(&span);
                assert_eq!(found, brute_force(&span, &positions, &radii), "{span:?}");
                hits += usize::from(found.is_some());
            }
            for position in &mut positions {
                *position += stream.direction() * (0.002 * stream.uniform());
            }
        }
        assert!(grid.builds() < 25 && (count < 700 || hits > 5000), "{} {hits}", grid.builds());
    }
}

/// Whatever the spheres do within the margin, a ray that is clear meets nothing; and clear it often is.
#[test]
fn clear_rays_meet_nothing() {
    let mut stream = Stream::new(4, Purpose::Sampling, 0);
    let corner = Vec3::new(1.0, 1.0, 1.0);
    let mut grid = RayGrid::new(-corner, corner);
    let start: Vec<Vec3> = (0..300).map(|_| point(&mut stream, 1.0)).collect();
    let radii: Vec<f64> = (0..300).map(|_| 0.01 + 0.09 * stream.uniform()).collect();
    grid.update(&start, &radii);
    let spans: Vec<RaySpan> = (0..500)
        .map(|_| {
            let (origin, direction) = (point(&mut stream, 0.5), stream.direction());
            RaySpan { origin, direction, from: 0.0, to: 0.5, skip: (stream.uniform() * 300.0) as u32 }
        })
        .collect();
    let clear: Vec<Clear> = spans.iter().map(|span| grid.clear_until(span)).collect();
    let clear_way: f64 = clear.iter().map(|clear| clear.until).sum();
    assert!(clear_way > 0.1 * 500.0 * 0.5, "{clear_way}");
    for _ in 0..50 {
        let moved: Vec<Vec3> =
            start.iter().map(|&place| place + stream.direction() * (0.999_999 * grid.margin)).collect();
        grid.update(&moved, &radii);
        assert_eq!(grid.builds(), 1);
        for (span, clear) in spans.iter().zip(&clear) {
            // 0 says that the ray starts where a sphere may be.
            let to = clear.until * (1.0 - 1e-15);
            let is_met = grid.nearest(&RaySpan { to, ..*span }).is_some();
            assert!(
                clear.until == 0.0 || (!is_met && grid.is_clear(clear, to)),
                "clear until {} but met: {is_met}",
                clear.until
            );
        }
    }
    let far: Vec<Vec3> = start.iter().map(|&place| place + Vec3::AXES[0] * grid.margin * 1.01).collect();
    grid.update(&far, &radii);
    assert_all!(clear.iter(), |clear| !grid.is_clear(clear, 0.0));
}

/// A ray that grazes past a sphere on its way out is not clear: the sphere may move so that it lies ahead.
#[test]
fn a_ray_beside_a_sphere_is_not_clear() {
    let mut grid = RayGrid::new(Vec3::new(-9.0, -9.0, -9.0), Vec3::new(9.0, 9.0, 9.0));
    grid.update(&[Vec3::ZERO], &[1.0]);
    let direction = Vec3::new(1.0, 1e-3, 0.0).normalized();
    let origin = Vec3::new(0.0, 1.02, 0.0);
    let span = RaySpan { origin, direction, from: 0.0, to: 5.0, skip: NO_SPHERE };
    assert_none!(grid.nearest(&span));
    assert_eq!(grid.clear_until(&span).until, 0.0);
    grid.update(&[Vec3::new(0.05, 0.08, 0.0)], &[1.0]);
    assert_eq!((grid.builds(), grid.nearest(&span).unwrap().at), (1, 0.0));
}

#[test]
fn distance_and_limits_by_hand() {
    let mut grid = RayGrid::new(Vec3::new(-9.0, -9.0, -9.0), Vec3::new(9.0, 9.0, 9.0));
    grid.update(&[Vec3::new(3.0, 0.6, 0.0), Vec3::new(3.0, 0.6, 0.0)], &[1.0, 1.0]);
    let span = RaySpan { origin: Vec3::ZERO, direction: Vec3::AXES[0], from: 0.0, to: 9.0, skip: NO_SPHERE };
    // 3 - sqrt(1 - 0.36) = 2.2; of two equal spheres the first is hit.
    let hit = grid.nearest(&span).unwrap();
    assert_near!(hit.at, 2.2, 1e-15);
    assert_eq!(hit.sphere, 0);
    assert_eq!(grid.nearest(&RaySpan { skip: 0, ..span }).unwrap().sphere, 1);
    assert_eq!(grid.nearest(&RaySpan { to: 2.19, ..span }), None);
    assert_eq!(grid.nearest(&RaySpan { to: hit.at, ..span }), Some(hit));
}

#[test]
fn a_sphere_that_swept_over_the_ray_is_hit_at_once_or_never() {
    let mut grid = RayGrid::new(Vec3::new(-9.0, -9.0, -9.0), Vec3::new(9.0, 9.0, 9.0));
    grid.update(&[Vec3::new(3.0, 0.0, 0.0)], &[1.0]);
    let span = RaySpan { origin: Vec3::ZERO, direction: Vec3::AXES[0], from: 2.5, to: 9.0, skip: NO_SPHERE };
    assert_eq!(grid.nearest(&span).unwrap().at, 2.5);
    assert_eq!(grid.nearest(&RaySpan { from: 3.5, ..span }), None);
}

#[test]
fn far_spheres_cost_no_rebuild_until_they_come_near() {
    let mut grid = RayGrid::new(Vec3::new(-1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, 1.0));
    let mut positions = [Vec3::ZERO, Vec3::new(50.0, 0.0, 0.0)];
    for _ in 0..48 {
        grid.update(&positions, &[0.1, 0.1]);
        assert_eq!(grid.builds(), 1);
        positions[1].x -= 1.0;
    }
    positions[1].x = 1.0;
    grid.update(&positions, &[0.1, 0.1]);
    assert_eq!(grid.builds(), 2);
}
