//! Small spheres in large volumes, where numbers end, and spheres that have no room.

use super::Simulation;
use super::test_systems::{Grain, advance_to, particles, restitution};
use crate::engine::SimError;
use crate::testing::Scenario;

const EVENTS: &str = "[engine.event_driven]";
const STEPS: &str = "[engine.time_stepped]";

/// A scenario in a cube from 0 to `edge` [m].
fn scenario(engine: &str, boundary: &str, edge: f64, e: f64) -> Scenario {
    let text = format!(
        "version = 1\ntime.end = \"1e12 s\"\n{engine}\n[materials.stone]\ndensity = \"1000 kg/m3\"\n\
         [[grains]]\nmaterial = \"stone\"\nsize.constant.radius = \"1 mm\"\nplacement.table.file = \"none\"\n\
         [volume]\nlower = [\"0 m\", \"0 m\", \"0 m\"]\nupper = [\"{edge:e} m\", \"{edge:e} m\", \"{edge:e} m\"]\n\
         boundary = \"{boundary}\"\n{}\n",
        restitution(e)
    );
    toml::from_str(&text).unwrap()
}

fn start(engine: &str, boundary: &str, edge: f64, e: f64, grains: &[Grain]) -> Simulation {
    Simulation::start(&scenario(engine, boundary, edge, e), &particles(grains)).unwrap()
}

/// The error with which a simulation ends, and who it is about.
fn error_of(mut simulation: Simulation) -> SimError {
    for _ in 0..10_000_000 {
        if let Err(error) = simulation.advance(f64::INFINITY) {
            return error;
        }
        assert_false!(simulation.is_finished(), "the run has come to its end");
    }
    panic!("it goes on for ever");
}

/// Two of 1 nm that fly 2 m toward one another, head-on and past the middle by 0.6 of the sum of their radii: they meet once,
/// when they should, and fly on as the closed form says.
#[test]
fn small_spheres_meet_over_a_long_way() {
    let r = 1e-9;
    for engine in [EVENTS, STEPS] {
        for boundary in ["periodic", "reflecting", "antipodal", "open"] {
            for aside in [0.0, 0.6] {
                // 0.8 of the sum of the radii before the middle.
                let grains: [Grain; 2] = [
                    ([4.0, 5.0, 5.0], [0.5, 0.0, 0.0], r),
                    ([6.0, 5.0 + aside * 2.0 * r, 5.0], [-0.5, 0.0, 0.0], r),
                ];
                let mut simulation = start(engine, boundary, 10.0, 1.0, &grains);
                advance_to(&mut simulation, 3.0);
                let counts = &simulation.system().state.counts;
                assert_eq!(
                    (counts.collisions, counts.overlapping),
                    (1, u64::from(engine == STEPS)),
                    "{engine} {boundary}"
                );
                // The normal is (cos, sin): what is along it is exchanged. Steps come in by a tenth of the radii at most.
                let cos_squared = 1.0 - aside * aside;
                let wanted = 0.5 - cos_squared;
                let found = simulation.snapshot().grains.velocity[0].x;
                let error = if engine == STEPS && aside > 0.0 { 0.2 } else { 1e-5 };
                // Places at 5 m are rounded to 1e-15 m, 1e-6 of the radii.
                assert!((found - wanted).abs() < error, "{found} and not {wanted}: {engine} {boundary}");
            }
        }
    }
}

/// The same at sizes and ways of all kinds: the shortest step of 10 ns lets nobody through.
#[test]
fn nobody_is_passed_within_a_step() {
    for radius in [1e-10, 1e-8, 1e-6, 1e-4] {
        for speed in [1.0, 30.0, 1000.0] {
            for boundary in ["periodic", "reflecting", "open"] {
                let grains =
                    [([0.2, 0.5, 0.5], [speed, 0.0, 0.0], radius), ([0.7, 0.5, 0.5], [0.0; 3], radius)];
                let mut simulation = start(STEPS, boundary, 1.0, 1.0, &grains);
                advance_to(&mut simulation, 0.55 / speed);
                assert_eq!(
                    simulation.system().state.counts.collisions,
                    1,
                    "{radius} at {speed} in {boundary}"
                );
                // The step after the collision may end behind a wall.
                assert_close!(simulation.snapshot().grains.velocity[1].x.abs(), speed, 1e-14, "in m/s");
            }
        }
    }
}

/// A tiny sphere that is thrown back at the wall within the shortest step meets the slow one that follows it.
#[test]
fn nobody_is_passed_at_a_wall() {
    let r = 1e-9;
    let grains =
        [([1.0 - 2.5 * r, 0.5, 0.5], [100.0, 0.0, 0.0], r), ([1.0 - 8.0 * r, 0.5, 0.5], [1.0, 0.0, 0.0], r)];
    let mut simulation = start(STEPS, "reflecting", 1.0, 1.0, &grains);
    advance_to(&mut simulation, 1e-6);
    let counts = &simulation.system().state.counts;
    // The slow one is hit on its way, then flies off at 100 m/s; the other goes on to the wall at 1 m/s.
    assert_eq!((counts.collisions, counts.walls), (1, 2), "{counts:?}");
}

/// Where a place is known to more than 1e-5 of a radius, that is said: at the start, on a far flight, and late.
#[test]
fn the_end_of_digits_is_told() {
    let rest = [0.0; 3];
    for engine in [EVENTS, STEPS] {
        let scenario = scenario(engine, "open", 1.0, 1.0);
        // Doubles are 1.4e-14 m apart at 80 m, 7e-15 m at 40 m; 1e-5 of the radius is 1e-14 m.
        let far = particles(&[([80.0, 0.5, 0.5], rest, 1e-9)]);
        let started = Simulation::start(&scenario, &far).and_then(|mut simulation| simulation.advance(1.0));
        assert!(matches!(started, Err(SimError::OutOfDigits { grain: 0, .. })), "{started:?}");
        let near = particles(&[([40.0, 0.5, 0.5], rest, 1e-9)]);
        Simulation::start(&scenario, &near).and_then(|mut simulation| simulation.advance(1.0)).unwrap();
    }
    // A slow clock: to and fro between walls at 1 m/s.
    let grains = [([0.5; 3], [1.0, 0.0, 0.0], 1e-7)];
    let late = start(EVENTS, "reflecting", 1.0, 1.0, &grains);
    let SimError::OutOfDigits { time, .. } = error_of(late) else { panic!("another error") };
    // 2.2e-16 (0.5 m + 1 m/s t) = 1e-12 m at 4503 s; it is looked at when it bounces, each second.
    assert!((4501.0..4506.0).contains(&time), "{time}");
}

/// An open volume has 1e9 cells on each side.
#[test]
fn the_end_of_cells_is_told() {
    let grains = [([3e9, 0.5, 0.5], [0.0; 3], 0.1), ([0.5; 3], [0.0; 3], 0.1)];
    let started = Simulation::start(&scenario(EVENTS, "open", 1.0, 1.0), &particles(&grains));
    assert!(matches!(started, Err(SimError::OutOfCells { grain: 0, .. })), "{:?}", started.err());
}

fn row(places: &[f64]) -> Vec<Grain> {
    places.iter().map(|&x| ([x, 0.4, 0.4], [if x < 0.2 { 1.0 } else { 0.0 }, 0.0, 0.0], 0.1)).collect()
}

/// Rows without room, whose gaps are rounding or none: the clock stands or creeps. The message names those that are there,
/// and a remedy that is one.
#[test]
fn spheres_without_room_are_told() {
    // Places in meters: gaps of 1e-17 m between walls; three that touch through a face; one between two walls.
    let cases: [(&str, f64, &[f64], &[&str]); 4] = [
        ("reflecting", 0.8, &[0.1, 0.3, 0.5, 0.7], &["grain", "and"]),
        ("periodic", 0.6, &[0.1, 0.3, 0.5], &["grains ", " and "]),
        ("reflecting", 0.2, &[0.1], &["grain 0 and a wall"]),
        ("periodic", 0.4, &[0.1, 0.3], &["grains 0 and 1"]),
    ];
    for (boundary, edge, places, words) in cases {
        let mut grains = row(places);
        for grain in &mut grains {
            (grain.0[1], grain.0[2]) = (0.5 * edge, 0.5 * edge);
        }
        for guard in ["", "contact_duration = \"0 s\""] {
            let error = error_of(start(&format!("{EVENTS}\n{guard}"), boundary, edge, 1.0, &grains));
            let text = error.to_string();
            assert!(matches!(error, SimError::Standstill { .. }), "{text}");
            assert!(
                words.iter().all(|word| text.contains(word)) && text.contains("enlarge [volume]"),
                "{text}"
            );
            assert!(!text.contains("4294967295") && !text.contains("raise"), "{text}");
            assert_eq!(text.contains("contact_duration"), !guard.is_empty(), "{text}");
        }
    }
}
