//! Tests of the start of hard spheres: the control volume filled, velocities that scatter, overlaps found.

use super::tests::{cube, group, lattice, radius, random, scenario};
use super::*;
use crate::domain::{Block, Boundary, Region, Volume};
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::packing::GrainGroup;
use crate::particles::{Particles, Row};
use crate::testing::place;
use crate::units::Quantity;

const BOUNDARIES: [Boundary; 4] =
    [Boundary::Periodic, Boundary::Antipodal, Boundary::Reflecting, Boundary::Open];

fn volume(edges: [f64; 3], boundary: Boundary) -> Volume {
    let lower = [-0.5, 2.0, 0.0];
    let upper = [0, 1, 2].map(|axis| Quantity(lower[axis] + edges[axis]));
    Volume { lower: lower.map(Quantity), upper, boundary, faces: None, deformation: None }
}

fn started(volume: &Volume, grains: Vec<GrainGroup>) -> Result<Particles, PackingError> {
    let kind = SphereKind::Hard { volume, may_leave: false };
    place(Groups { kind, ..Groups::from(&scenario(grains)) })
}

fn fill(count: Option<u32>, solid_fraction: Option<f64>, gap: f64) -> Placement {
    Placement::Fill(Fill { count, solid_fraction, gap: Quantity(gap) })
}

fn list(positions: &[[f64; 3]]) -> Placement {
    let positions = positions.iter().map(|position| position.map(Quantity)).collect();
    Placement::List(GrainList { positions, velocities: vec![] })
}

/// All overlaps [m] above zero with the ids of their pairs, over 27 images of every grain where there are images; a
/// grain has its own images too.
fn overlaps(grains: &Particles, images: Option<&Volume>) -> Vec<Overlap> {
    let edges = images.map_or(Vec3::ZERO, Volume::edges);
    let steps: &[f64] = if images.is_some() { &[-1.0, 0.0, 1.0] } else { &[0.0] };
    let mut found = Vec::new();
    for i in 0..grains.len() {
        for j in 0..=i {
            let mut most = 0.0_f64;
            for (x, y, z) in steps
                .iter()
                .flat_map(|&x| steps.iter().flat_map(move |&y| steps.iter().map(move |&z| (x, y, z))))
            {
                if i != j || (x, y, z) != (0.0, 0.0, 0.0) {
                    let shift = Vec3::new(x * edges.x, y * edges.y, z * edges.z);
                    let distance = (grains.position[i] - grains.position[j] + shift).norm();
                    most = most.max(grains.radius[i] + grains.radius[j] - distance);
                }
            }
            if most > 0.0 {
                let (a, b) = (grains.id[i], grains.id[j]);
                found.push(Overlap { ids: [a.min(b), a.max(b)], overlap: most });
            }
        }
    }
    found
}

#[test]
fn filled_volumes_are_clear_of_all_images() {
    let sizes =
        [radius(0.05), Size::Uniform(UniformSize { smallest: Quantity(0.01), largest: Quantity(0.1) })];
    for size in sizes {
        for boundary in BOUNDARIES {
            let volume = volume([1.0, 1.3, 0.7], boundary);
            let wanted = (0.25 * volume.volume() / size.mean_volume()).round() as usize;
            let request = group("ink", size.clone(), fill(None, Some(0.25), 0.001));
            let grains = started(&volume, vec![request]).unwrap();
            assert_eq!(grains.len(), wanted);
            assert_true!(
                grains.radius.is_sorted_by(|a, b| a >= b),
                "from the largest to the smallest: {:?}",
                grains.radius
            );
            let mut swollen = grains.clone();
            // The gap less the rounding of distances.
            swollen.radius.iter_mut().for_each(|radius| *radius += 0.0005 - 1e-12);
            let images = boundary.wraps().then_some(&volume);
            assert_eq!(overlaps(&swollen, images), [], "{boundary:?}");
            let block = Region::Box(Block { lower: volume.lower, upper: volume.upper });
            let whole = |at: usize| block.contains(grains.position[at], grains.radius[at] * (1.0 - 1e-12));
            assert_all!(grains.position.iter(), |&position| volume.contains(position));
            assert_eq!((0..grains.len()).all(whole), !boundary.wraps());
        }
    }
}

/// The same draws, each compared with all images of all grains before it, give the same places to the last bit.
#[test]
fn a_periodic_fill_is_sequential_addition_by_brute_force() {
    let (volume, radius) = (volume([1.0, 0.6, 0.45], Boundary::Periodic), 0.06);
    let request = group("ink", self::radius(radius), fill(None, Some(0.25), 0.0));
    let grains = started(&volume, vec![request]).unwrap();
    let mut stream = Stream::new(scenario(vec![]).seed, Purpose::Placement, 0);
    let middle = (volume.lower() + volume.upper()) * 0.5;
    let mut places: Vec<Vec3> = Vec::new();
    let mut attempt = 0;
    while places.len() < grains.len() {
        stream.jump_to((places.len() as u64) << 32 | attempt << 8);
        attempt += 1;
        let [x, y, z] = volume.edges().to_array().map(|edge| (2.0 * stream.uniform() - 1.0) * (0.5 * edge));
        let place = middle + Vec3::new(x, y, z);
        if places.iter().all(|&other| volume.shortest(place - other).norm() >= 2.0 * radius) {
            places.push(place);
            attempt = 0;
        }
    }
    assert_eq!(grains.position, places);
}

/// Without walls, equal spheres end at 0.3841 everywhere (Zhang and Torquato 2013). The number of some 17,000 grains
/// scatters by a few parts in a thousand.
#[test]
fn periodic_fills_saturate_where_others_found() {
    let volume = volume([40.0; 3], Boundary::Periodic);
    let request = group("ink", radius(0.7), fill(None, Some(0.39), 0.0));
    let error = started(&volume, vec![request]).unwrap_err();
    let PackingError::Saturated { placed, reached, .. } = error else { panic!("{error}") };
    assert!((reached / 0.3841 - 1.0).abs() < 0.01, "{reached}");
    let solid = placed as f64 * radius(0.7).mean_volume() / 40.0_f64.powi(3);
    assert_close!(reached, solid, 1e-12);
}

#[test]
fn volumes_that_are_only_just_wide_enough() {
    let one = |edges, gap| {
        let request = group("ink", radius(0.1), fill(Some(1), None, gap));
        started(&volume(edges, Boundary::Periodic), vec![request])
    };
    assert_eq!(one([0.2 + 1e-12, 0.3, 0.4], 0.0).unwrap().len(), 1);
    let narrow = one([0.3, 0.199, 0.4], 0.0).unwrap_err();
    assert!(matches!(narrow, PackingError::TooLarge { .. }), "{narrow}");
    // The grain's own image must be as far away as any other grain.
    assert_eq!(one([0.21, 0.3, 0.4], 0.009).unwrap().len(), 1);
    assert_err!(one([0.21, 0.3, 0.4], 0.011));
    let long = volume([0.205, 0.205, 10.0], Boundary::Periodic);
    let grains = started(&long, vec![group("ink", radius(0.1), fill(Some(35), None, 0.0))]).unwrap();
    assert_eq!(overlaps(&grains, Some(&long)), []);
}

/// A grain in the corner of the volume is near others at all eight corners, whether they fill the volume or a region.
#[test]
fn later_groups_keep_clear_of_images() {
    for boundary in [Boundary::Periodic, Boundary::Antipodal] {
        let volume = volume([1.0, 1.1, 0.9], boundary);
        let region = Region::Box(Block { lower: volume.lower, upper: volume.upper });
        for later in [fill(Some(1500), None, 0.0), random(region.clone(), Some(1500), None)] {
            let first = group("glass", radius(0.3), list(&[[-0.49, 3.09, 0.01]]));
            let second = group("ink", Size::Constant(ConstantSize { radius: Quantity(0.03) }), later);
            let grains = started(&volume, vec![first, second]).unwrap();
            assert_eq!(grains.len(), 1501);
            let found: Vec<Overlap> = overlaps(&grains, Some(&volume));
            assert!(found.iter().all(|overlap| overlap.overlap < 1e-12), "{found:?}");
        }
    }
}

#[test]
fn what_cannot_be_filled_is_refused() {
    let request = || vec![group("ink", radius(0.1), fill(Some(1), None, 0.0))];
    let message = place(&scenario(request())).unwrap_err().to_string();
    assert!(message.contains("grains[0].placement: `fill` needs the control volume [volume]"), "{message}");
    let unit = volume([1.0; 3], Boundary::Periodic);
    for (count, fraction, gap) in
        [(None, None, 0.0), (Some(1), Some(0.1), 0.0), (Some(0), None, 0.0), (Some(1), None, -1.0)]
    {
        let bad = group("ink", radius(0.1), fill(count, fraction, gap));
        let message = started(&unit, vec![bad]).unwrap_err().to_string();
        assert!(message.starts_with("grains[0].placement.fill: "), "{message}");
    }
    for edges in [[-1.0, -1.0, 1.0], [0.0, 1.0, 1.0]] {
        assert_err!(started(&volume(edges, Boundary::Periodic), request()));
    }
}

fn centered(deviation: f64) -> VelocitySpread {
    VelocitySpread::Maxwell(Maxwell { deviation: Quantity(deviation), centered: true })
}

/// The momentum of a centered group is its mass times the velocity that is asked for, to the rounding of the velocities
/// (a few m/s, so 1e-15 m/s each).
#[test]
fn velocities_scatter_about_the_groups_own() {
    let unit = volume([1.0; 3], Boundary::Periodic);
    let size = Size::Uniform(UniformSize { smallest: Quantity(0.01), largest: Quantity(0.05) });
    let scattered =
        GrainGroup { velocity_spread: Some(centered(2.0)), ..group("ink", size, fill(None, Some(0.1), 0.0)) };
    let grains = started(&unit, vec![scattered]).unwrap();
    let (mut momentum, mut mass, mut square) = (Vec3::ZERO, 0.0, 0.0);
    for at in 0..grains.len() {
        momentum += grains.velocity[at] * grains.mass[at];
        mass += grains.mass[at];
        square += (grains.velocity[at] - Vec3::new(1.0, 2.0, 3.0)).norm_squared();
    }
    assert_near_vector!(momentum / mass, Vec3::new(1.0, 2.0, 3.0), 1e-14);
    // Three components of deviation 2; the mean of n squares of normal numbers scatters by sqrt(2/n).
    let components = 3.0 * grains.len() as f64;
    assert_close!(square / components, 4.0, 5.0 * (2.0 / components).sqrt());
}

#[test]
fn velocities_do_not_depend_on_other_groups() {
    let unit = volume([1.0; 3], Boundary::Open);
    let scattered = |placement| GrainGroup {
        velocity_spread: Some(VelocitySpread::Maxwell(Maxwell { deviation: Quantity(2.0), centered: false })),
        ..group("ink", radius(0.02), placement)
    };
    let second = || scattered(lattice(LatticeKind::Cubic, 0.1, cube(0.3), None));
    let of_first = |count| list(&[[0.4, 2.9, 0.9], [0.4, 2.9, 0.8], [0.4, 2.8, 0.9]][..count]);
    let long = started(&unit, vec![scattered(of_first(3)), second()]).unwrap();
    let short = started(&unit, vec![scattered(of_first(2)), second()]).unwrap();
    assert_eq!(long.velocity[..2], short.velocity[..2]);
    assert_eq!(long.velocity[3..], short.velocity[2..]);
    assert_ne!(long.velocity[0], long.velocity[3]);
}

#[test]
fn rows_with_velocities_and_temperatures_of_their_own_keep_them() {
    let bare = |x: f64| TableGrain { position: Vec3::new(x, 0.0, 0.0), ..TableGrain::default() };
    let own = |x: f64, velocity: Vec3, temperature: f64| TableGrain {
        velocity: Some(velocity),
        temperature: Some(temperature),
        ..bare(x)
    };
    let mut read = |table: &Table| {
        Ok(if table.file.ends_with("own.csv") {
            vec![own(0.0, Vec3::new(7.0, 0.0, 0.0), 450.0), own(1.0, Vec3::new(0.0, 8.0, 0.0), 700.0)]
        } else {
            vec![bare(3.0), bare(4.0)]
        })
    };
    let table = |file: &str| GrainGroup {
        velocity_spread: Some(centered(2.0)),
        ..group("ink", radius(0.1), Placement::Table(Table { file: file.into() }))
    };
    let given = GrainList {
        positions: vec![[6.0, 0.0, 0.0].map(Quantity)],
        velocities: vec![[0.0, 0.0, 9.0].map(Quantity)],
    };
    let given = GrainGroup {
        velocity_spread: Some(centered(2.0)),
        ..group("ink", radius(0.1), Placement::List(given))
    };
    let grains =
        super::place(&scenario(vec![table("own.csv"), table("bare.csv"), given]), &mut read).unwrap();
    assert_eq!(grains.velocity[..2], [Vec3::new(7.0, 0.0, 0.0), Vec3::new(0.0, 8.0, 0.0)]);
    assert_eq!(grains.velocity[4], Vec3::new(0.0, 0.0, 9.0));
    assert_eq!(grains.temperature, [450.0, 700.0, 600.0, 600.0, 600.0]);
    // The material's stiffness is that at the row's temperature: 1e7 Pa exp(-(T/500 K - 1)).
    assert_close!(grains.contact_stiffness[0], 1e7 * 0.1_f64.exp(), 1e-14, "in N/m");
    // The two bare rows scatter about (1, 2, 3) m/s and have that mean.
    assert_above!((grains.velocity[2] - grains.velocity[3]).norm(), 0.1);
    let mean = (grains.velocity[2] + grains.velocity[3]) * 0.5;
    assert_near_vector!(mean, Vec3::new(1.0, 2.0, 3.0), 1e-14);
}

/// Clouds with few overlaps, of radii over a decade, in boxes from two to many diameters wide: the pair with the smallest
/// ids, and its overlap to round-off, whatever the order of the grains in memory.
#[test]
fn first_overlap_agrees_with_brute_force() {
    let mut stream = Stream::new(3, Purpose::Sampling, 0);
    let (mut none, mut own) = (0, 0);
    for case in 0..400 {
        let edges = [[1.0, 1.0, 1.0], [0.3, 0.35, 2.0], [0.19, 3.0, 0.9]][case % 3];
        let boundary = BOUNDARIES[case / 3 % 4];
        let volume = volume(edges, boundary);
        let mut grains = Particles::default();
        for id in 0..(2 + case as u32 % 40) {
            let [x, y, z] = edges.map(|edge| edge * stream.uniform());
            let radius = 0.1 * 0.1_f64.powf(stream.uniform().powi(2));
            grains.push(Row { id, position: volume.lower() + Vec3::new(x, y, z), radius, ..Row::default() });
        }
        let all = overlaps(&grains, (boundary == Boundary::Periodic).then_some(&volume));
        let expected = all.iter().min_by_key(|overlap| overlap.ids);
        let backwards: Vec<u32> = (0..grains.len() as u32).rev().collect();
        for _ in 0..2 {
            let found = first_overlap(&grains, Some(&volume));
            assert_eq!(found.map(|found| found.ids), expected.map(|expected| expected.ids));
            if let (Some(found), Some(expected)) = (found, expected) {
                assert_near!(found.overlap, expected.overlap, 1e-14, "in m");
                own += usize::from(found.ids[0] == found.ids[1]);
            }
            grains.reorder(&backwards);
        }
        none += usize::from(expected.is_none());
    }
    assert!((20..350).contains(&none) && own > 3, "{none} {own}");
}

#[test]
fn touching_is_not_overlapping() {
    let at = |apart: f64| {
        let mut grains = Particles::default();
        for (id, x) in [(0, 1.0), (1, 1.0 + apart)] {
            let position = Vec3::new(x, 2.0, 0.0);
            grains.push(Row { id, position, radius: 0.05, ..Row::default() });
        }
        first_overlap(&grains, None)
    };
    assert_eq!(at(0.1), None);
    // A billionth of the sum of the radii is let pass; a bit more is not.
    assert_eq!(at(0.1 - 0.9e-10), None);
    assert_eq!(at(0.1 - 1.1e-10).map(|found| found.ids), Some([0, 1]));
}

#[test]
fn hard_spheres_that_cannot_start_are_refused() {
    let message = |boundary, positions: &[[f64; 3]], radius: f64| {
        let request = group("ink", self::radius(radius), list(positions));
        started(&volume([1.0; 3], boundary), vec![request]).map_err(|error| error.to_string())
    };
    let close: &[[f64; 3]] = &[[0.0, 2.5, 0.5], [0.0, 2.5, 0.8], [0.0, 2.699_998, 0.5]];
    for boundary in BOUNDARIES {
        let found = message(boundary, close, 0.1).unwrap_err();
        assert!(
            found.starts_with("grains 0 and 2 overlap by 2 um at the start; hard spheres must not"),
            "{found}"
        );
    }
    // Across a face only periodic neighbors count.
    let across: &[[f64; 3]] = &[[0.49, 2.5, 0.5], [-0.45, 2.5, 0.5]];
    assert_contains!(message(Boundary::Periodic, across, 0.1).unwrap_err(), "overlap by 140 mm");
    assert_ok!(message(Boundary::Antipodal, across, 0.1));
    assert_ok!(message(Boundary::Open, across, 0.1));
    let walled = message(Boundary::Reflecting, across, 0.1).unwrap_err();
    assert!(
        walled.starts_with("grain 0 at (0.49 m, 2.5 m, 0.5 m) reaches past the walls of [volume]"),
        "{walled}"
    );
    assert_ok!(message(Boundary::Reflecting, &[[0.4, 2.5, 0.5], [-0.4, 2.1, 0.1]], 0.1));
    // The upper face is the lower one.
    for boundary in [Boundary::Periodic, Boundary::Antipodal] {
        let kept = message(boundary, &[[0.5, 2.5, 0.5]], 0.1).unwrap();
        assert_eq!(kept.position, [Vec3::new(-0.5, 2.5, 0.5)]);
    }
    let far: &[[f64; 3]] = &[[0.0, 2.5, 0.5], [0.6, 2.5, 0.5]];
    for boundary in [Boundary::Periodic, Boundary::Antipodal] {
        let found = message(boundary, far, 0.1).unwrap_err();
        assert!(found.starts_with("grain 1 at (0.6 m, 2.5 m, 0.5 m) lies outside [volume]"), "{found}");
    }
    assert_ok!(message(Boundary::Open, far, 0.1));
    let own = message(Boundary::Periodic, &[[0.0, 2.5, 0.5]], 0.6).unwrap_err();
    assert!(
        own.starts_with("grain 0 is too large for the periodic [volume]: it overlaps its own image"),
        "{own}"
    );
    // Soft spheres may overlap and know no volume.
    let soft = scenario(vec![group("ink", radius(0.1), list(close))]);
    assert_ok!(place(&soft));
}

/// Speed: a million equal grains, sparse and dense, in a periodic volume.
#[test]
#[ignore = "measures time"]
fn a_million_grains() {
    for fraction in [0.05, 0.25] {
        let edge = (4.0 / 3.0 * std::f64::consts::PI * 1e6 / fraction).cbrt();
        let volume = volume([edge; 3], Boundary::Periodic);
        let request = GrainGroup {
            velocity_spread: Some(centered(1.0)),
            ..group("ink", radius(1.0), fill(Some(1_000_000), None, 0.0))
        };
        assert_eq!(started(&volume, vec![request]).unwrap().len(), 1_000_000);
    }
}
