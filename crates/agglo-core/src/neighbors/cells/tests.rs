//! Cells find all who are near, each image once, and cost no more than the spheres are worth.

use super::*;
use crate::domain::Space;
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};

/// Found by index with the number of the image.
type Seen = Vec<(u32, [i8; 3])>;

/// Spheres in the box between (-1, -1, -1) and (1, 2, 3) times `spread`, with radii down to a part `ratio` of 0.05.
fn cloud(n: usize, spread: f64, ratio: f64) -> (Vec<Vec3>, Vec<f64>) {
    let mut stream = Stream::new(3, Purpose::Sampling, 0);
    let mut along = |from: f64, to: f64| (from + (to - from) * stream.uniform()) * spread;
    let positions = (0..n).map(|_| Vec3::new(along(-1.0, 1.0), along(-1.0, 2.0), along(-1.0, 3.0))).collect();
    let radii = (0..n).map(|_| 0.05 * ratio.powf(stream.uniform())).collect();
    (positions, radii)
}

/// Those whose surface is nearer to a place than `reach`, by looking at all.
fn brute(positions: &[Vec3], radii: &[f64], center: Vec3, reach: f64, images: i8, edges: Vec3) -> Seen {
    let mut seen = Vec::new();
    for (at, (position, radius)) in (0..).zip(positions.iter().zip(radii)) {
        for number in 0..(2 * i32::from(images) + 1).pow(3) {
            let side = 2 * i32::from(images) + 1;
            let image = [number % side, number / side % side, number / side / side];
            let image = image.map(|along| (along - i32::from(images)) as i8);
            let shift = Vec3::from([0, 1, 2].map(|axis| f64::from(image[axis]) * edges[axis]));
            if (*position + shift - center).norm() < reach + radius {
                seen.push((at, image));
            }
        }
    }
    seen.sort_unstable();
    seen
}

#[test]
fn all_who_are_near_are_found_once() {
    for (spread, ratio, reach) in
        [(1.0, 1.0, 0.02), (1.0, 0.03, 0.02), (50.0, 1.0, 0.02), (50.0, 0.1, 8.0), (0.02, 0.5, 0.1)]
    {
        let (positions, radii) = cloud(300, spread, ratio);
        let (lower, upper) = (Vec3::new(-1.0, -1.0, -1.0) * spread, Vec3::new(1.0, 2.0, 3.0) * spread);
        let inner = [lower * 0.5, upper * 0.5];
        let spans = [
            Span::Free(Space::OPEN),
            Span::Around,
            Span::Block(inner, [false; 3]),
            Span::Block([lower, upper], [true; 3]),
        ];
        for span in spans {
            let images = i8::from(matches!(span, Span::Block(_, [true, ..])));
            // Cells about free spheres are for searches that reach no farther than a few of them.
            let reach = if matches!(span, Span::Free(_)) { f64::min(reach, 0.1) } else { reach };
            let mut cells = CellIndex::<Sorted>::default();
            cells.fill(&(&positions[..], &radii[..]), &span, 0.02);
            for of in 0..300_u32 {
                let (center, own) = (positions[of as usize], radii[of as usize]);
                let due = brute(&positions, &radii, center, own + reach, images, upper - lower);
                let is_near = |(at, image): &(u32, [i8; 3])| due.binary_search(&(*at, *image)).is_ok();
                let mut seen = Vec::new();
                cells.visit_all(center, own + reach, &mut |at, image| seen.push((at, image)));
                seen.retain(is_near);
                seen.sort_unstable();
                assert_eq!(seen, due, "about sphere {of}: {span:?}, spread {spread}, radii down to {ratio}");
                let mut partners = Vec::new();
                cells.visit_partners(of, center, own + reach, &mut |at, image| partners.push((at, image)));
                let level = |at: u32| (cells.level_of[at as usize], at);
                let due = due.iter().copied().filter(|(at, _)| level(*at) > level(of));
                partners.retain(is_near);
                partners.sort_unstable();
                assert_eq!(partners, due.collect::<Seen>(), "partners of {of}: {span:?}, spread {spread}");
            }
        }
    }
}

/// Where the spheres were when they were sorted, though their cells share buckets: where they are now is not asked.
#[test]
fn spheres_are_found_where_they_were() {
    let (positions, radii) = cloud(300, 50.0, 1.0);
    let mut cells = CellIndex::<Sorted>::default();
    cells.fill(&(&positions[..], &radii[..]), &Span::Free(Space::OPEN), 0.02);
    assert_true!(cells.levels[0].lattice.is_hashed(), "300 spheres of 0.05 m in a box of 6e6 m³");
    drop(radii);
    for (at, position) in (0..).zip(positions) {
        let mut seen = Vec::new();
        cells.visit_all(position, 0.0, &mut |other, _| seen.push(other));
        assert_has!(seen, &at);
    }
}

/// However far spheres have spread: 4 cells each are allowed, up to a power of two.
#[test]
fn buckets_are_in_proportion_to_spheres() {
    for spread in [1.0, 1e3, 1e9, 1e300] {
        let (positions, radii) = cloud(1000, spread, 1.0);
        for span in [Span::Free(Space::OPEN), Span::Around] {
            let mut cells = CellIndex::<Sorted>::default();
            cells.fill(&(&positions[..], &radii[..]), &span, 0.02);
            assert_at_most!(cells.levels[0].lattice.buckets(), 8000);
        }
    }
}

/// 0.6/0.2 is just below 3, 0.6 times 5 is not: the outermost of spheres in a row at whole numbers of cells must
/// still have a cell, and meet its neighbor, along every axis.
#[test]
fn the_outermost_sphere_has_a_cell() {
    let mut cells = CellIndex::<Sorted>::default();
    for axis in Vec3::AXES {
        for count in 2..200 {
            let row = |k: u32| axis * (f64::from(k) * 0.6 / f64::from(count - 1) + f64::from(count / 50));
            let mut positions: Vec<Vec3> = (0..count).map(row).collect();
            // Not a row of one cell across.
            positions.push(positions[0] + Vec3::new(0.45, 0.45, 0.45));
            let radii = vec![0.1; positions.len()];
            cells.fill(&(&positions[..], &radii[..]), &Span::Free(Space::OPEN), 0.0);
            for (sphere, center) in positions.iter().enumerate() {
                let near = |other: usize| other > sphere && (positions[other] - *center).norm() < 0.2;
                let mut found = Vec::new();
                cells.visit_partners(sphere as u32, *center, 0.1, &mut |other, _| found.push(other as usize));
                assert_all!((0..positions.len()).filter(|&other| near(other)), |other| found
                    .contains(&other));
            }
        }
    }
}
