//! Rays where space repeats itself: closed forms, balances, and what must not matter.

use agglo::acoustics::PulseCount;
use agglo::domain::Space;
use rayon::ThreadPoolBuilder;

use super::*;

const LOWER: Vec3 = Vec3::new(-0.2, 0.1, 0.3);
const EDGES: Vec3 = Vec3::new(1.0, 1.1, 0.9);
const ALL: [bool; 3] = [true; 3];

fn space(axes: [bool; 3]) -> Space {
    Space::repeating([LOWER, LOWER + EDGES], axes)
}

fn tracer(axes: [bool; 3], ends: Ends) -> Tracer {
    Tracer::new(ends, vec![CERAMIC]).in_space(space(axes))
}

/// Spheres of radius 0.09 at random in the block, apart across its faces too; 12 % of it.
fn packing(count: usize) -> Packing {
    let (space, mut stream) = (space(ALL), Stream::new(11, Purpose::Sampling, 0));
    let mut positions: Vec<Vec3> = Vec::new();
    while positions.len() < count {
        let part =
            Vec3::new(stream.uniform() * EDGES.x, stream.uniform() * EDGES.y, stream.uniform() * EDGES.z);
        let place = LOWER + part;
        if positions.iter().all(|other| space.shortest(*other - place).norm() > 0.18) {
            positions.push(place);
        }
    }
    Packing::new(positions, 0.09)
}

/// Rays from a disc of radius 0.05 in the block.
fn beam_in(rays: u32) -> Beam {
    Beam {
        start: (LOWER + EDGES * 0.5).to_array().map(Quantity),
        radius: Quantity(0.05),
        direction: [0.3, -0.5, 0.8],
        ..beam(Vec3::AXES[0], rays, Pattern::Sunflower)
    }
}

fn launched(beam: &Beam, tracer: &mut Tracer, grains: &Packing) -> Flight {
    let mut flight = Flight::default();
    flight.launch(beam, &Medium::default(), 1, 0, 0);
    tracer.drop_blocked(&mut flight, &grains.targets());
    flight
}

fn shot(beam: &Beam, tracer: &mut Tracer, grains: &Packing) -> (PulseCount, Vec<Hit>) {
    let mut flight = launched(beam, tracer, grains);
    let hits = tracer.trace(&mut flight, &grains.targets());
    assert_empty!(flight.rays());
    (flight.pulses()[0], hits)
}

/// A ray through the middle of a sphere comes back through the faces to its other side, again and again: 0.4 m there first, then one
/// edge less a diameter each time, (17/19)² of the power at each hit. An offset of 1e-13 m grows by about 2 · 0.8/0.1 at each.
#[test]
fn val_a_ray_comes_back_to_the_same_sphere() {
    let grains = Packing::new(vec![LOWER + EDGES * 0.5], 0.1);
    let mut tracer = tracer([true, false, false], Ends { truncation: 0.5, ..FOLLOW_ALL });
    let middle = LOWER + EDGES * 0.5;
    let start = middle - Vec3::AXES[0] * 0.5;
    let beam = Beam {
        start: start.to_array().map(Quantity),
        radius: Quantity(1e-13),
        ..beam(Vec3::AXES[0], 1, Pattern::Sunflower)
    };
    let mut flight = launched(&beam, &mut tracer, &grains);
    let power = flight.pulses()[0].power_in;
    let mut way = 0.0;
    let mut found = Vec::new();
    while !flight.rays().is_empty() {
        let before = found.len();
        tracer.advance(&mut flight, &grains.targets(), 0.01, |hits| found.extend_from_slice(hits));
        way += 0.01;
        for number in before..found.len() {
            assert_near!(way, 0.4 + 0.8 * number as f64, 0.01 + 1e-9, "m: way to hit {number}");
        }
    }
    let reflected = (17.0_f64 / 19.0).powi(2);
    assert_eq!(found.len(), 4, "hits until a half is gone");
    for (number, hit) in (0_i32..).zip(&found) {
        let side = if number % 2 == 0 { -1.0 } else { 1.0 };
        assert_near_vector!(hit.point, middle + Vec3::AXES[0] * (0.1 * side), 1e-8, "m: hit {number}");
        assert_near_vector!(hit.direction_in, Vec3::AXES[0] * -side, 1e-6, "hit {number}");
        assert_close!(hit.power_in, power * f64::powi(reflected, number), 1e-9, "W");
    }
    let count = flight.pulses()[0];
    assert_close!(count.power_truncated, power * f64::powi(reflected, 4), 1e-9, "W");
}

/// Along a channel a ray meets nothing; it is cut off after a thousand of the longest edge, or after a way that is given, and its power
/// stands apart.
#[test]
fn rays_that_meet_nothing_are_cut_off_after_a_way() {
    let grains = Packing::new(vec![LOWER + EDGES * 0.5], 0.1);
    let start = LOWER + Vec3::new(0.0, 0.05, 0.05);
    let beam = Beam {
        start: start.to_array().map(Quantity),
        radius: Quantity(1e-3),
        ..beam(Vec3::AXES[2], 5, Pattern::Sunflower)
    };
    let (count, hits) = shot(&beam, &mut tracer(ALL, FOLLOW_ALL), &grains);
    assert_empty!(hits);
    assert_eq!((count.overlong, count.power_cut_off, count.in_flight), (5, count.power_in, 0));
    assert_near_vector!(count.flow_ended, Vec3::AXES[2] * count.power_in, 1e-12 * count.power_in, "W");
    let mut short = tracer(ALL, Ends { way: 12.5, ..FOLLOW_ALL });
    assert_eq!(short.ends().way, 12.5);
    assert_near!(tracer(ALL, FOLLOW_ALL).ends().way, 1100.0, 1e-9, "m: a thousand of the longest edge");
    let mut flight = launched(&beam, &mut short, &grains);
    for step in 1..=13 {
        advance(&mut short, &mut flight, &grains, 1.0);
        assert_eq!(flight.rays().len(), if step < 13 { 5 } else { 0 }, "after {step} m");
    }
}

/// What comes in is absorbed, leaves, falls below the truncation or is cut off, and what momentum rays lose grains get: each hit changes it
/// by power times direction. To the rounding of some ten thousand hits.
#[test]
fn val_power_and_momentum_close_across_faces() {
    let grains = packing(35);
    for axes in [ALL, [true, true, false], [false, true, false], [true, false, true]] {
        for way in [7.0, f64::INFINITY] {
            let mut tracer = tracer(axes, Ends { truncation: 0.05, way, ..FOLLOW_ALL });
            let (count, hits) = shot(&beam_in(700), &mut tracer, &grains);
            assert_above!(hits.len(), if axes == ALL { 2000 } else { 50 }, "hits, {axes:?}");
            let out =
                count.power_absorbed + count.power_escaped + count.power_truncated + count.power_cut_off;
            assert_close!(out, count.power_in, 1e-12, "W, {axes:?}");
            if axes == ALL || way > 10.0 {
                assert_eq!(count.overlong > 0, way < 10.0, "rays that are cut off, {axes:?}");
            }
            assert_eq!(count.power_escaped > 0.0, axes != ALL, "rays that leave, {axes:?}");
            let given = hits.iter().fold(Vec3::ZERO, |sum, hit| {
                sum + (hit.direction_in - hit.direction_out * hit.reflectance) * hit.power_in
            });
            let axis = beam_in(1).axis() * count.power_in;
            assert_near_vector!(given + count.flow_ended, axis, 1e-10 * count.power_in, "W, {axes:?}");
            // Hits are on the grains where these are at home.
            for hit in &hits {
                let away = hit.point - grains.positions[hit.grain as usize];
                assert_near!(away.norm(), 0.09, 1e-12, "m from the center");
                assert_near_vector!(away / 0.09, hit.normal, 1e-11);
            }
        }
    }
}

/// Steps of any length, batches of hits that fill up and any number of threads: the same hits of each ray, and in the same order, to the
/// last bit.
#[test]
fn hits_do_not_depend_on_steps_and_threads() {
    let grains = packing(35);
    let ends = || Ends { truncation: 0.02, ..FOLLOW_ALL };
    let with = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| shot(&beam_in(700), &mut tracer(ALL, ends()), &grains))
    };
    let alone = with(1);
    assert_above!(alone.1.len(), 3 * 2048, "more than one batch of hits in each block");
    for threads in [2, 3, 7] {
        assert_true!(with(threads) == alone, "{threads} threads and one");
    }
    let mut stepped = tracer(ALL, ends());
    let mut flight = launched(&beam_in(700), &mut stepped, &grains);
    let mut hits = Vec::new();
    while !flight.rays().is_empty() {
        hits.extend(advance(&mut stepped, &mut flight, &grains, 0.037));
    }
    let sorted = |mut hits: Vec<Hit>| {
        hits.sort_by(|a, b| a.power_in.total_cmp(&b.power_in).then(a.point.x.total_cmp(&b.point.x)));
        hits
    };
    assert_true!(sorted(hits) == sorted(alone.1), "hits in steps and at once");
}

/// Sums of a pulse go by the numbers of its rays: the same bits beside rays of another pulse that are gone or still fly as without them.
#[test]
fn sums_do_not_depend_on_what_else_flies() {
    let grains = packing(35);
    let axes = [true, true, false];
    let ends = || Ends { truncation: 0.05, ..FOLLOW_ALL };
    let mut other = beam_in(333);
    other.direction = [0.5, 0.4, -0.2];
    let after = |with_other: bool| {
        let mut tracer = tracer(axes, ends());
        let mut flight = Flight::default();
        if with_other {
            flight.launch(&other, &Medium::default(), 1, 0, 0);
            (0..8).for_each(|_| drop(advance(&mut tracer, &mut flight, &grains, 0.2)));
            assert_between!(flight.rays().len(), 1..=332, "other rays");
        }
        flight.launch(&beam_in(1100), &Medium::default(), 1, 1, 0);
        (0..60).for_each(|_| drop(advance(&mut tracer, &mut flight, &grains, 0.05)));
        *flight.pulses().last().unwrap()
    };
    let (alone, beside) = (after(false), after(true));
    assert_above!(alone.reflections, 500, "reflections");
    assert_eq!(alone, beside, "books of the same pulse, alone and beside another");
}

/// All grains and the source moved by part of a period, so that other grains are cut by faces: the same impulses on the same grains. Each
/// bounce makes an offset some tens of times larger: 1e-16 becomes 1e-11 after three.
#[test]
fn val_where_the_faces_are_does_not_matter() {
    let grains = packing(35);
    for axes in [ALL, [true, false, false], [false, true, true]] {
        let ends = || Ends { bounces: 3, ..FOLLOW_ALL };
        let impulses = |by: Vec3| {
            let space = space(axes);
            let home = |place: &Vec3| space.home(*place + by).0;
            let moved = Packing { positions: grains.positions.iter().map(home).collect(), ..packing(35) };
            let mut beam = beam_in(500);
            beam.start = (LOWER + EDGES * 0.5 + by).to_array().map(Quantity);
            let (_, hits) = shot(&beam, &mut tracer(axes, ends()), &moved);
            let mut sums = vec![(Vec3::ZERO, Vec3::ZERO); 35];
            for hit in hits {
                let at = hit.grain as usize;
                let load = (hit.direction_in - hit.direction_out * hit.reflectance) * hit.power_in;
                sums[at].0 += load;
                sums[at].1 += (hit.point - moved.positions[at]).cross(load);
            }
            sums
        };
        let here = impulses(Vec3::ZERO);
        let most = here.iter().map(|(load, _)| load.norm()).fold(0.0, f64::max);
        for by in [[0.31, 0.0, 0.0], [0.0, 0.77, 0.13], [0.5, -0.45, 0.62]] {
            for (there, here) in impulses(by.into()).iter().zip(&here) {
                assert_near_vector!(there.0, here.0, 1e-8 * most, "W, moved by {by:?}, {axes:?}");
                assert_near_vector!(there.1, here.1, 1e-9 * most, "W m, moved by {by:?}, {axes:?}");
            }
        }
    }
}
