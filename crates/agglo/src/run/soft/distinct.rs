//! A run of soft spheres in whose state no two quantities are equal.

use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::path::Path;

use serde_json::{Value as Json, json};

use super::*;
use crate::acoustics::PulseCount;
use crate::ledger::{Flows, Ledger, Momentum, Opening, Stored, Supplies, Supply};
use crate::math::Vec3;

/// Radii [m] and places [m] of the grains by their names: 0 presses on 1, cement holds 2 to 1, the pairs 3-4 and 5 alone are
/// 10 mm away, and 6 is farther.
pub const RADII: [f64; 7] = [1.0e-3, 2.0e-3, 1.5e-3, 1.2e-3, 0.8e-3, 0.9e-3, 0.7e-3];
/// See [`RADII`].
pub const PLACES: [[f64; 3]; 7] = [
    [0.0, 0.0, 0.0],
    [2.99e-3, 0.0, 0.0],
    [2.99e-3, 3.54e-3, 0.0],
    [0.0, 1.0e-3, 10.0e-3],
    [0.0, 3.3e-3, 10.0e-3],
    [0.5e-3, -8.0e-3, 3.0e-3],
    [-9.0e-3, 0.3e-3, 5.0e-3],
];
/// Masses [kg]: not those of the radii, so that motions come to a joule.
pub const MASSES: [f64; 7] = [0.5, 0.25, 0.375, 0.3, 0.2, 0.15, 0.1];
/// Velocities [m/s].
pub const VELOCITIES: [[f64; 3]; 7] = [
    [1.0, -2.0, 0.5],
    [0.3, 1.1, -0.7],
    [-0.4, 0.9, 1.3],
    [2.1, 0.2, -1.9],
    [0.6, -0.8, 0.1],
    [-1.7, 0.35, 0.45],
    [0.15, 2.6, -0.55],
];
/// Young's modulus [Pa] and Poisson's ratio of the grains.
pub const ELASTIC: (f64, f64) = (1e6, 0.2);
/// Force [N] and stiffness [N/m] of the tangential spring between grains 0 and 1.
pub const SPRING: ([f64; 3], f64) = ([0.0, 0.3, 0.4], 50.0);
/// Young's modulus [Pa] and shear ratio of the cement; shear force [N] in the bond 0-1; stretch of the bond 1-2.
pub const CEMENT: (f64, f64) = (2e6, 0.4);
/// See [`CEMENT`].
pub const SHEAR: [f64; 3] = [0.0, 0.0, 0.8];
/// Lengths [m] at which the bonds 0-1 and 1-2 were made.
pub const LENGTHS: [f64; 2] = [2.99e-3 / 1.01, 3.54e-3 / 0.98];
/// Relative permittivity of the near field.
pub const PERMITTIVITY: f64 = 2.0;
/// Stiffness [N/m] of a trap along y.
pub const TRAP: f64 = 3e4;
/// Simulated time [s] and length of the last step [s].
pub const TIMES: [f64; 2] = [0.5, 3e-3];

/// Spin [rad/s] of a grain.
pub fn angular_velocity(id: usize) -> Vec3 {
    Vec3::new(40.0 + 3.0 * id as f64, -20.0 + 7.0 * id as f64, 11.0 * id as f64 - 15.0)
}

/// Charge [C] of a grain.
pub fn charge(id: usize) -> f64 {
    1e-7 * [1.0, -2.0, 3.0, 2.5, -1.5, 0.5, 4.0][id]
}

/// The pulses: two of beam 0, between them one of beam 1.
pub fn pulses() -> [PulseCount; 3] {
    let of = |beam: u32, number: u32, k: f64| PulseCount {
        beam,
        number,
        start_s: 0.1 * k,
        rays: 100 * k as u32 + 7,
        reflections: 11 * k as u64 * k as u64,
        reflections_at_walls: 3 * k as u64 + 2,
        segments: 23 * k as u64 + 1,
        power_in: 100.0 * k * k + 3.0,
        power_absorbed: 17.0 * k * k,
        power_into_walls: 1.5 * k * k + 0.125,
        power_escaped: 5.0 * k + 0.25,
        power_truncated: 2.0 * k * k + 0.75,
        power_cut_off: 0.75 * k + 0.5,
        flow_ended: Vec3::new(0.3 * k * k, -0.4 * k, 0.55 + k),
        squares_ended: 3.7 * k * k,
        longest_chain: 5 + 2 * k as u32 * k as u32,
        ..PulseCount::default()
    };
    let pulses = [of(0, 0, 1.0), of(1, 0, 2.0), of(0, 1, 3.0)];
    [0, 1, 2].map(|at| PulseCount {
        in_flight: RAYS.iter().filter(|ray| ray.0 == at).count() as u32,
        ..pulses[at]
    })
}

/// Rays in flight: pulse, origin [m], direction, way [m], power [W].
pub type FlyingRay = (usize, [f64; 3], [f64; 3], f64, f64);
/// The rays: one of the first pulse, two of the second, four of the third.
pub const RAYS: [FlyingRay; 7] = [
    (0, [1.0, 2.0, 3.0], [0.6, 0.8, 0.0], 0.5, 10.0),
    (1, [-1.0, 2.5, 0.0], [0.0, 0.6, -0.8], 1.5, 12.0),
    (1, [-1.25, 2.75, 0.5], [0.8, 0.0, 0.6], 0.25, 7.0),
    (2, [4.0, 5.0, 6.0], [0.0, -1.0, 0.0], 2.0, 3.0),
    (2, [4.5, 5.5, 6.5], [1.0, 0.0, 0.0], 3.0, 5.0),
    (2, [7.0, 8.0, 9.0], [0.0, 0.0, 1.0], 4.0, 9.0),
    (2, [7.5, 8.5, 9.5], [-0.6, 0.0, 0.8], 6.0, 11.0),
];

/// The ledger: stores and momenta at the start, flows since.
pub fn ledger() -> Ledger {
    let supply = |power: f64| Supply {
        power,
        force: Vec3::new(0.11 * power, -0.07 * power, 0.05 * power + 0.3),
        torque: Vec3::new(0.02 * power - 0.4, 0.013 * power, -0.03 * power),
    };
    let mut supplies = Supplies::default();
    (supplies.drag, supplies.gravity, supplies.field) = (supply(-2.125), supply(5.0), supply(9.5));
    (supplies.hook, supplies.walls) = (supply(1.75), supply(3.625));
    let start = Opening {
        stored: Stored {
            kinetic: 1.0,
            rotational: 0.6,
            elastic: 0.35,
            tangential_spring: 0.4,
            bonds: 0.15,
            near_field: 0.45,
            fields: 0.55,
            thermal: 0.0,
        },
        momentum: Momentum { linear: Vec3::new(0.9, -1.3, 2.2), angular: Vec3::new(0.31, 0.62, -0.17) },
        momentum_size: 40.0,
        mass: 1.5,
    };
    let mut ledger = Ledger::of_soft(start, RADII.len());
    ledger.flows = Flows {
        rays: supply(20.0),
        supplies,
        damping: 3.25,
        driven: 0.875,
        strained: 1.375,
        tangential: 4.5,
        bond_damping: 6.5,
        broken_bonds: 7.75,
        absorbed: 2.875,
        carried_off: Momentum { linear: Vec3::new(0.07, 0.21, -0.4), angular: Vec3::new(-0.09, 0.16, 0.33) },
        ..Flows::default()
    };
    (ledger.scale, ledger.worst) = (1000.0, 0.0625);
    ledger
}

/// The clusters at the start.
pub const CLUSTERS_START: Clusters = Clusters { count: 9, largest_fraction: 0.8 };

/// The scenario.
pub fn scenario() -> Scenario {
    let (modulus, ratio) = ELASTIC;
    let grains = RADII.iter().zip(PLACES).zip(0..).map(|((radius, [x, y, z]), id)| {
        format!(
            "[[grains]]\nmaterial = \"{}\"\nsize.constant.radius = \"{radius:e} m\"\n\
             placement.list.positions = [[\"{x:e} m\", \"{y:e} m\", \"{z:e} m\"]]\n",
            if id == 2 { "sand" } else { "glass" }
        )
    });
    let material = |name: &str| {
        format!(
            "[materials.{name}]\ndensity = \"2500 kg/m3\"\nsound_speed = \"5000 m/s\"\n\
             youngs_modulus = \"{modulus:e} Pa\"\npoisson_ratio = {ratio}\n"
        )
    };
    let beam = |start: &str| {
        format!(
            "[[acoustics.beams]]\nstart = [\"{start}\", \"0 m\", \"0 m\"]\ndirection = [1.0, 0.0, 0.0]\n\
             radius = \"1 mm\"\nrays = 5\nstrength.power = \"2 W\"\n\
             pulses = {{ first = \"0.1 s\", period = \"0.2 s\", count = 2 }}\n"
        )
    };
    let text = format!(
        "version = 1\ntitle = \"distinct\"\nseed = 21\ntime.end = \"1 s\"\nengine.verlet.step = \"1 us\"\n{}{}{}\
         [contact.normal.hertz]\n[contact.friction.mindlin]\nstatic_friction = 0.5\n\
         [bonds.beam]\nyoungs_modulus = \"{:e} Pa\"\nshear_ratio = {}\ntensile_strength = \"1 TPa\"\n\
         shear_strength = \"1 TPa\"\ngap = 0.05\n\
         [fields.near_field.law.coulomb]\nrelative_permittivity = {PERMITTIVITY:?}\n\
         [fields.custom]\nforce = [\"0\", \"-{TRAP:?}*y\", \"0\"]\nenergy = \"{TRAP:?}/2*y^2\"\n\
         [volume]\nlower = [\"-1 m\", \"-1 m\", \"-1 m\"]\nupper = [\"1 m\", \"1 m\", \"1 m\"]\n\
         boundary = \"open\"\nfaces.z = \"absorbing\"\n\
         [measures]\ncluster_gap = 0.5\n[limits]\ndrift_warning = 0.003\n\
         [acoustics.force.impulse]\nduration = \"2 ms\"\n{}{}",
        material("glass"),
        material("sand"),
        grains.collect::<String>(),
        CEMENT.0,
        CEMENT.1,
        beam("-30 mm"),
        beam("-40 mm"),
    );
    Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"))
}

/// The run.
pub fn distinct() -> Soft {
    let scenario = scenario();
    let grains = crate::packing::place(&scenario, Path::new("")).unwrap();
    let job = Soft::start(&scenario, grains.into(), &mut |_| ControlFlow::Continue(())).unwrap();
    let mut state =
        serde_json::to_value(SoftState { simulation: job.simulation.state(), start: CLUSTERS_START })
            .unwrap();
    put(&mut state["simulation"]);
    let mut job = Soft::resume(&scenario, serde_json::from_value(state).unwrap()).unwrap();
    job.simulation.ledger = ledger();
    job.simulation.system.trial.contact.worst_strain = 0.0175;
    job
}

fn put(state: &mut Json) {
    state["clock"] = json!({
        "time": TIMES[0], "lag": 1e-17, "step": 71, "next_step": 2e-3, "last_step": TIMES[1],
        "iterations": 311, "rejected": 13,
    });
    let ids: Vec<usize> =
        state["grains"]["id"].as_array().unwrap().iter().map(|id| id.as_u64().unwrap() as usize).collect();
    let column = |of: &dyn Fn(usize) -> Json| ids.iter().map(|&id| of(id)).collect::<Json>();
    let grains = &mut state["grains"];
    grains["mass"] = column(&|id| json!(MASSES[id]));
    grains["velocity"] = column(&|id| vector(Vec3::from(VELOCITIES[id])));
    grains["angular_velocity"] = column(&|id| vector(angular_velocity(id)));
    grains["charge"] = column(&|id| json!(charge(id)));
    grains["temperature"] = column(&|id| json!(300.0 + id as f64));
    grains["polarity"] = column(&|id| json!(if id % 3 == 0 { -1.0 } else { 1.0 }));
    grains["contact_stiffness"] = column(&|id| json!(1e5 + 10.0 * id as f64));
    grains["absorbed_power"] = column(&|id| json!(50.0 + 0.5 * id as f64));
    let contacts = state["contacts"].as_array_mut().unwrap();
    assert_eq!(contacts.len(), 1, "grain 0 presses on grain 1");
    contacts[0][2] =
        json!({ "force": vector(Vec3::from(SPRING.0)), "stiffness": SPRING.1, "sliding": false });
    let bonds = state["bonds"].as_array_mut().unwrap();
    let pairs: Vec<&Json> = bonds.iter().map(|bond| &bond["ids"]).collect();
    assert_eq!(pairs, [&json!([0, 1]), &json!([1, 2])]);
    for (bond, length) in bonds.iter_mut().zip(LENGTHS) {
        bond["state"]["length"] = json!(length);
    }
    bonds[0]["state"]["shear"] = vector(Vec3::from(SHEAR));
    state["bonds_made_at_start"] = json!(8);
    state["truncation"] = json!({ "forces": 0.21, "energy": 0.23 });
    state["warnings"]["counts"] = json!({ "one": 14, "two": 16 });
    state["absorbed"] = json!({ "grains": 19, "mass": 0.375 });
    state["pulses"]["launched"] = json!(3);
    let mut number = 0;
    let rays = RAYS.map(|(pulse, origin, direction, traveled, power)| {
        number += 1;
        json!({
            "origin": vector(Vec3::from(origin)), "direction": vector(Vec3::from(direction)),
            "traveled": traveled, "power": power, "first_power": 20.0, "area": 1e-6,
            "way": 3.5, "last_hit": 0, "bounces": 1, "pulse": pulse, "number": number,
        })
    });
    state["pulses"]["flight"] = json!({ "rays": rays, "pulses": pulses() });
}

fn vector(vector: Vec3) -> Json {
    serde_json::to_value(vector).unwrap()
}

/// What the sums over grains come to, worked out here from the numbers above.
pub struct ByHand {
    /// Energies now [J].
    pub stored: Stored,
    /// Linear [kg m/s] and angular [kg m²/s] momentum now.
    pub momentum: [Vec3; 2],
    /// The same that impulses do not explain.
    pub drift: [Vec3; 2],
}

/// See [`ByHand`].
pub fn by_hand() -> ByHand {
    let (mut kinetic, mut rotational) = (0.0, 0.0);
    let mut momentum = [Vec3::ZERO; 2];
    for id in 0..RADII.len() {
        let (mass, velocity, place) = (MASSES[id], Vec3::from(VELOCITIES[id]), Vec3::from(PLACES[id]));
        let inertia = 2.0 / 5.0 * mass * RADII[id] * RADII[id];
        kinetic += mass * velocity.dot(velocity) / 2.0;
        rotational += inertia * angular_velocity(id).dot(angular_velocity(id)) / 2.0;
        momentum[0] += velocity * mass;
        momentum[1] += place.cross(velocity * mass) + angular_velocity(id) * inertia;
    }
    let (modulus, ratio) = ELASTIC;
    let effective = modulus / (2.0 * (1.0 - ratio * ratio));
    let overlap = RADII[0] + RADII[1] - PLACES[1][0];
    let shared = RADII[0] * RADII[1] / (RADII[0] + RADII[1]);
    let distance = |a: usize, b: usize| (Vec3::from(PLACES[b]) - Vec3::from(PLACES[a])).norm();
    let mut bonds = 0.0;
    for ((a, b), length) in [(0, 1), (1, 2)].into_iter().zip(LENGTHS) {
        let area = PI * RADII[a].min(RADII[b]).powi(2);
        bonds += CEMENT.0 / length * area * (distance(a, b) - length).powi(2) / 2.0;
    }
    let shearing = CEMENT.0 * CEMENT.1 / LENGTHS[0] * PI * RADII[0].powi(2);
    bonds += Vec3::from(SHEAR).norm_squared() / (2.0 * shearing);
    let mut near_field = 0.0;
    for a in 0..RADII.len() {
        for b in a + 1..RADII.len() {
            // Coulomb's constant, CODATA 2022.
            near_field += 8.987_551_786_2e9 * charge(a) * charge(b) / (PERMITTIVITY * distance(a, b));
        }
    }
    let ledger = ledger();
    let (flows, start) = (&ledger.flows, &ledger.start.momentum);
    let Supplies { drag, gravity, field, hook, walls, .. } = flows.supplies;
    let supplies = [flows.rays, drag, gravity, field, hook, walls];
    let impulse: Vec3 = supplies.iter().map(|supply| supply.force).sum();
    let twist: Vec3 = supplies.iter().map(|supply| supply.torque).sum();
    ByHand {
        stored: Stored {
            kinetic,
            rotational,
            elastic: 8.0 / 15.0 * effective * shared.sqrt() * overlap.powf(2.5),
            tangential_spring: Vec3::from(SPRING.0).norm_squared() / (2.0 * SPRING.1),
            bonds,
            near_field,
            fields: PLACES.iter().map(|[_, y, _]| TRAP / 2.0 * y * y).sum(),
            thermal: 0.0,
        },
        momentum,
        drift: [
            momentum[0] - start.linear - impulse + flows.carried_off.linear,
            momentum[1] - start.angular - twist + flows.carried_off.angular,
        ],
    }
}

/// What energies are due under the names of the table and of the summary, drawn up from [`by_hand`] and the flows of
/// [`ledger`].
pub fn energies() -> [(&'static str, f64); 21] {
    let (stored, start) = (by_hand().stored, ledger().start.stored);
    // Of the 4.5 J that tangential forces took, the springs gave back what they had more at the start.
    let friction = 4.5 + 0.4 - stored.tangential_spring;
    let drift = stored.mechanical() - start.mechanical() - (20.0 + 5.0 + 9.5 + 1.375 + 2.625 + 3.625)
        + (2.125 + 3.25 + friction + 6.5 + 7.75 + 2.875);
    [
        ("kinetic_J", stored.kinetic),
        ("rotational_J", stored.rotational),
        ("elastic_J", stored.elastic),
        ("tangential_spring_J", stored.tangential_spring),
        ("bonds_J", stored.bonds),
        ("near_field_J", stored.near_field),
        ("fields_J", stored.fields),
        ("work_rays_J", 20.0),
        ("work_gravity_J", 5.0),
        ("work_fields_J", 9.5),
        ("work_volume_J", 1.375),
        ("work_custom_J", 2.625),
        ("work_walls_J", 3.625),
        ("lost_drag_J", 2.125),
        ("lost_contact_damping_J", 3.25),
        ("lost_friction_J", friction),
        ("lost_bond_damping_J", 6.5),
        ("lost_broken_bonds_J", 7.75),
        ("lost_absorbed_J", 2.875),
        ("drift_J", drift),
        ("drift_relative", drift / 1000.0),
    ]
}

/// The clusters by hand: 0-1-2 hang together, 3-4 are closer than half the smaller radius, 5 and 6 are alone.
pub const LABELS: [u32; 7] = [0, 0, 0, 1, 1, 2, 3];
