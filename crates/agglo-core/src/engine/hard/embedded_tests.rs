//! Embedded grains against collisions by hand, and what is refused.

use std::f64::consts::PI;

use super::*;
use crate::testing::Scenario;

fn microscale(law: &str, engine: &str) -> Microscale {
    Microscale::new(Settings::try_from(&scenario(law, engine)).unwrap())
}

fn scenario(law: &str, engine: &str) -> Scenario {
    let text = format!(
        r#"
        version = 1
        time.end = "1 s"
        [engine.{engine}]
        [volume]
        lower = ["-5 mm", "-5 mm", "-5 mm"]
        upper = ["5 mm", "5 mm", "5 mm"]
        [materials.clay]
        density = "2000 kg/m3"
        heat_capacity = "1000 J/kg/K"
        [materials.lead]
        density = "11000 kg/m3"
        heat_capacity = "130 J/kg/K"
        {law}
        [[grains]]
        material = "clay"
        size.constant.radius = "0.5 mm"
        placement.fill.count = 1
        "#
    );
    Scenario::from_toml(&text).unwrap()
}

const STICKY: &str = "[impact.restitution.constant]\nrestitution = 0.0";
const ELASTIC: &str = "[impact.restitution.constant]\nrestitution = 1.0";

/// Clay at 4 m/s behind lead at rest, and a third grain of clay that the pair meets later.
fn three() -> MicroGrains {
    MicroGrains {
        radii: vec![5e-4; 3],
        velocities: vec![Vec3::new(4.0, 0.0, 0.0), Vec3::ZERO, Vec3::ZERO],
        temperatures: vec![300.0, 400.0, 350.0],
        positions: vec![Vec3::new(-4e-3, 0.0, 0.0), Vec3::new(-2e-3, 0.0, 0.0), Vec3::new(2e-3, 0.0, 0.0)],
        materials: vec![0, 1, 0],
        primaries: Vec::new(),
    }
}

fn primaries(state: &MicroState) -> Vec<u32> {
    state.grown.iter().map(|grown| grown.primaries).collect()
}

/// The first collision comes after 1 mm at 4 m/s, 0.25 ms; the pair flies on at 8/13 m/s. All quantities by hand.
#[test]
fn two_that_stick() {
    let microscale = microscale(STICKY, "event_driven");
    let start = microscale.state(&three()).unwrap();
    let (state, means) = microscale.step(&start, 1e-3).unwrap();
    let cubed = 4.0 / 3.0 * PI * 5e-4_f64.powi(3);
    let (clay, lead) = (2000.0 * cubed, 11000.0 * cubed);
    assert_eq!((means.grains, primaries(&state)), (2, vec![2, 1]));
    let pair = 0;
    assert_close!(state.grains.velocity[pair].x, 4.0 * 2.0 / 13.0, 1e-12, "in m/s");
    assert_close!(state.grains.radius[pair], 5e-4 * 2_f64.cbrt(), 1e-12, "in m");
    let heat = 0.5 * clay * lead / (clay + lead) * 16.0;
    assert_close!(means.heat, heat, 1e-12, "in J");
    assert_close!(means.mass, 2.0 * clay + lead, 1e-12, "in kg");
    assert_close!(means.momentum.x, clay * 4.0, 1e-12);
    assert_close!(means.mean_velocity.x, 8.0 / 15.0, 1e-12, "in m/s");
    assert_close!(means.kinetic, 0.5 * (clay * 4.0).powi(2) / (clay + lead), 1e-12, "in J");
    let capacities = [clay * 1000.0, lead * 130.0, clay * 1000.0];
    let thermal = capacities[0] * 300.0 + capacities[1] * 400.0 + capacities[2] * 350.0 + heat;
    assert_close!(means.thermal, thermal, 1e-12);
    assert_close!(means.mean_temperature, thermal / capacities.iter().sum::<f64>(), 1e-12, "in K");
    let box_volume = 1e-6;
    assert_close!(means.number_density, 2.0 / box_volume, 1e-12);
    assert_close!(means.solid_fraction, 3.0 * cubed / box_volume, 1e-12);
    assert_close!(means.mean_radius, 0.5 * 5e-4 * (1.0 + 2_f64.cbrt()), 1e-12, "in m");
    assert_close!(means.growth, (0.5 * (1.0 + 2_f64.cbrt())).powi(3), 1e-12);
    for rate in [means.collision_rate, means.merge_rate] {
        assert_close!(rate, 1.0 / (box_volume * 1e-3), 1e-12);
    }
    assert_eq!((means.breakage_rate, means.cooled, means.reaction), (0.0, 0.0, 0.0));
    // Three pairs for 0.25 ms, then none of two singles.
    assert_close!(means.kernels[0].exposure, 3.0 * 0.25e-3 / box_volume, 1e-12);
}

/// The pair of the first step is one of two primaries in the next ones, where it takes the third grain.
#[test]
fn a_state_carries_over() {
    let microscale = microscale(STICKY, "event_driven");
    let mut state = microscale.state(&three()).unwrap();
    let mut merges = 0.0;
    for _ in 0..8 {
        let (next, means) = microscale.step(&state, 1e-3).unwrap();
        merges += means.merge_rate * 1e-3 * 1e-6;
        state = next;
    }
    assert_eq!((primaries(&state), state.step), (vec![3], 8));
    let cubed = 4.0 / 3.0 * PI * 5e-4_f64.powi(3);
    assert_close!(state.grown[0].heat_capacity, cubed * (2.0 * 2000.0 * 1000.0 + 11000.0 * 130.0), 1e-12);
    assert!((merges - 2.0).abs() < 1e-12, "{merges}");
    assert_close!(state.grains.velocity[0].x, 8.0 / 15.0, 1e-12, "in m/s");
    assert_close!(state.grains.radius[0], 5e-4 * 3_f64.cbrt(), 1e-12, "in m");
}

/// A crowd placed at random that bounces without loss: energy and momentum stay to the round-off of some hundred
/// collisions, and kinetic = M V²/2 + 3 M Θ/2.
#[test]
fn an_elastic_crowd() {
    let microscale = microscale(ELASTIC, "event_driven");
    let mut stream = Stream::new(9, Purpose::Sampling, 0);
    let count = 100;
    let crowd = MicroGrains {
        radii: (0..count).map(|k| 3e-4 + 1e-6 * f64::from(k)).collect(),
        velocities: (0..count).map(|_| stream.direction() * 2.0 + Vec3::new(0.5, 0.0, 0.0)).collect(),
        temperatures: vec![300.0; count as usize],
        ..MicroGrains::default()
    };
    let start = microscale.state(&crowd).unwrap();
    assert_eq!(start, microscale.state(&crowd).unwrap());
    assert_eq!(start.grains.radius, crowd.radii);
    let kinetic_of = |grains: &Particles| -> f64 {
        grains.mass.iter().zip(&grains.velocity).map(|(mass, v)| 0.5 * mass * v.norm_squared()).sum()
    };
    let (state, means) = microscale.step(&start, 5e-3).unwrap();
    assert!(means.collision_rate * 5e-3 * 1e-6 > 100.0, "{}", means.collision_rate);
    assert_close!(means.kinetic, kinetic_of(&start.grains), 1e-12, "in J");
    assert_close!(means.kinetic, kinetic_of(&state.grains), 1e-12, "in J");
    let parts = 0.5 * means.mean_velocity.norm_squared() + 1.5 * means.granular_temperature;
    assert_close!(means.kinetic, means.mass * parts, 1e-12, "in J");
    let tensor = means.velocity_covariance;
    assert_eq!((tensor[0][1], tensor[2][0], tensor[1][2]), (tensor[1][0], tensor[0][2], tensor[2][1]));
    assert_close!(means.mean_temperature, 300.0, 1e-12, "in K");
    // A step is a pure function of its state.
    let (again, means_again) = microscale.step(&start, 5e-3).unwrap();
    assert_eq!((&state, &means), (&again, &means_again));
}

/// Masses 1 : 5.5 with velocities (1, 2, 0) and 0: V = (2/13)(1, 2, 0), Θ = (22/169) v v^T.
#[test]
fn the_tensor_of_two() {
    let microscale = microscale(ELASTIC, "event_driven");
    let mut grains = three();
    grains.velocities[0] = Vec3::new(1.0, 2.0, 0.0);
    for column in [&mut grains.radii, &mut grains.temperatures] {
        column.truncate(2);
    }
    grains.velocities.truncate(2);
    grains.positions.truncate(2);
    grains.materials.truncate(2);
    let state = microscale.state(&grains).unwrap();
    let (_, means) = microscale.step(&state, 1e-6).unwrap();
    let theta = 22.0 / 169.0;
    for (row, expected) in [(0, [1.0, 2.0]), (1, [2.0, 4.0])] {
        for (column, expected) in expected.into_iter().enumerate() {
            assert_close!(means.velocity_covariance[row][column], theta * expected, 1e-12);
        }
    }
    assert_eq!(means.velocity_covariance[2], [0.0; 3]);
    assert_close!(means.granular_temperature, theta * 5.0 / 3.0, 1e-12, "in K");
}

/// Both engines come to the same merge.
#[test]
fn step_by_step() {
    let microscale = microscale(STICKY, "time_stepped");
    let start = microscale.state(&three()).unwrap();
    let (state, means) = microscale.step(&start, 1e-3).unwrap();
    assert_eq!((means.grains, means.duration), (2, 1e-3));
    assert_close!(
        state.grains.velocity.iter().map(|velocity| velocity.x).fold(0.0, f64::max),
        8.0 / 13.0,
        1e-12
    );
}

#[test]
fn bad_input_is_refused_in_words() {
    let microscale = microscale(ELASTIC, "event_driven");
    let refused = |change: &dyn Fn(&mut MicroGrains), words: &str| {
        let mut grains = three();
        change(&mut grains);
        let message = microscale.state(&grains).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    };
    refused(&|grains| grains.radii[1] = 0.0, "`radii` of grain 1 is 0; it must be above zero and finite");
    refused(&|grains| grains.radii[2] = f64::NAN, "`radii` of grain 2 is NaN");
    refused(&|grains| grains.temperatures[0] = -3.0, "`temperatures` of grain 0 is -3");
    refused(
        &|grains| grains.velocities[0].y = f64::INFINITY,
        "`velocities` of grain 0 is (4, inf, 0); it must be finite",
    );
    refused(&|grains| grains.positions[1].x = f64::NAN, "`positions` of grain 1 is (NaN, 0, 0)");
    refused(&|grains| grains.positions[1].x = -3.5e-3, "grains 0 and 1 overlap by 5");
    refused(
        &|grains| grains.materials[1] = 2,
        "`materials` of grain 1 is 2; it must be the number of a material",
    );
    refused(&|grains| grains.primaries = vec![1, 0, 1], "`primaries` of grain 1 is 0; it must be at least 1");
    refused(&|grains| grains.primaries = vec![1], "`primaries` has 1 values for 3 grains");
    refused(&|grains| grains.velocities.clear(), "`velocities` has 0 values for 3 grains");
    refused(&|grains| *grains = MicroGrains::default(), "there are no grains");
    refused(
        &|grains| {
            grains.positions.clear();
            grains.radii[0] = 6e-3;
        },
        "cannot be placed at random",
    );
    let state = microscale.state(&three()).unwrap();
    for duration in [0.0, -1.0, f64::NAN] {
        assert_matches!(microscale.step(&state, duration), Err(EmbeddedError::Duration(_)));
    }
    let mut ragged = state.clone();
    ragged.grains.radius.pop();
    let message = microscale.step(&ragged, 1.0).unwrap_err().to_string();
    assert_eq!(message, "`radius` has 2 values for 3 grains");
    let mut spoiled = state;
    spoiled.grains.temperature[0] = f64::NAN;
    assert_contains!(microscale.step(&spoiled, 1.0).unwrap_err().to_string(), "`temperatures` of grain 0");
}

/// An agglomerate of eight is hit and breaks: where its fragments go is drawn anew in each step of the macroscale code, and a step
/// made twice is the same.
#[test]
fn each_step_draws_its_own_numbers() {
    let law = "[materials.sand]\ndensity = \"2000 kg/m3\"\nheat_capacity = \"1000 J/kg/K\"\nsurface_energy = \"1 J/m2\"\n\
               [impact.fragmentation]\n[impact.restitution.constant]\nrestitution = 0.5\n\
               [[grains]]\nmaterial = \"sand\"\nsize.constant.radius = \"0.5 mm\"\nplacement.fill.count = 1";
    let microscale = microscale(law, "event_driven");
    let start = microscale
        .state(&MicroGrains {
            radii: vec![1e-3, 1e-3],
            velocities: vec![Vec3::new(20.0, 0.0, 0.0), Vec3::ZERO],
            temperatures: vec![300.0; 2],
            positions: vec![Vec3::new(-2e-3, 0.0, 0.0), Vec3::new(2e-3, 0.0, 0.0)],
            materials: vec![2, 2],
            primaries: vec![8, 8],
        })
        .unwrap();
    let places = |step: u32| {
        let (state, _) = microscale.step(&MicroState { step, ..start.clone() }, 1.1e-4).unwrap();
        assert!(state.grains.len() > 2, "{}", state.grains.len());
        state.grains.position
    };
    assert_eq!(places(0), places(0));
    assert_ne!(places(0), places(1));
}
