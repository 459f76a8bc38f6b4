//! Tables, summary and frames of hard spheres: from a state of distinct quantities through the run's own path, and back by the
//! names of the columns.

use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::path::Path;

use serde_json::json;

use super::*;
use crate::engine::hard::{Counts, Descent, EventKind, GrainEvent, Grown};
use crate::impact::ImpactEnergy;
use crate::ledger::CollisionFlows;
use crate::math::Vec3;
use crate::record::frames::{FieldValues, Frame};
use crate::run::distinct::{Named, assert_quantities, assert_table, tables};
use crate::run::frames::FrameLists;

/// Round-off: sums of 3 grains and differences of a few energies.
const ROUND_OFF: f64 = 1e-12;

const RADII: [f64; 3] = [1e-3, 2e-3, 4.5e-3];
const PRIMARIES: [u32; 3] = [1, 2, 9];
const MASSES: [f64; 3] = [0.5, 0.75, 2.0];
const CAPACITIES: [f64; 3] = [3.0, 5.0, 7.0];
const TEMPERATURES: [f64; 3] = [310.0, 420.0, 290.0];
const VELOCITIES: [[f64; 3]; 3] = [[1.0, -2.0, 0.5], [0.25, 1.125, -0.75], [-0.375, 0.875, 1.25]];
/// Places [m] at 0.25 s.
const PLACES: [[f64; 3]; 3] = [[0.1, 0.2, 0.3], [-0.25, 0.35, -0.15], [0.4, -0.45, 0.05]];
/// Time [s] and length of the last step [s].
const TIMES: [f64; 2] = [0.5, 3e-3];
const MEAN_RADIUS_AT_START: f64 = 1.25e-3;
const STORES_AT_START: [f64; 2] = [50.0, 6000.0];
const MOMENTUM_AT_START: Vec3 = Vec3::new(0.9, -1.3, 2.2);
const WALLS: Vec3 = Vec3::new(0.41, 0.13, -0.29);
const IMPACTS: ImpactEnergy =
    ImpactEnergy { normal: 3.125, tangential: 4.0, reaction: 5.0, surface: 6.0, heat: 17.5 };

fn counts() -> Counts {
    Counts {
        collisions: 1000,
        bounces: 611,
        merges: 302,
        fragmentations: 87,
        events: 388,
        tc_bounces: 5,
        no_room: 14,
        overlapping: 13,
        walls: 12,
        iterations: 7700,
        most_iterations: 19,
        not_converged: 11,
    }
}

pub(super) fn scenario() -> Scenario {
    let grains = RADII.iter().zip(PLACES).map(|(radius, [x, y, z])| {
        format!(
            "[[grains]]\nmaterial = \"grain\"\nsize.constant.radius = \"{radius:e} m\"\n\
             placement.list.positions = [[\"{x} m\", \"{y} m\", \"{z} m\"]]\n"
        )
    });
    let text = format!(
        "version = 1\ntitle = \"distinct\"\nseed = 21\ntime.end = \"1 s\"\n\
         engine.time_stepped = {{ longest_step = \"1 ms\", shortest_step = \"1 us\" }}\n\
         volume = {{ lower = [\"-1 m\", \"-1 m\", \"-1 m\"], upper = [\"1 m\", \"1 m\", \"1 m\"] }}\n\
         [materials.grain]\ndensity = \"2000 kg/m3\"\nhardness = \"0.6 MPa\"\nheat_capacity = \"800 J/(kg K)\"\n\
         [medium]\ndensity = \"1.2 kg/m3\"\nsound_speed = \"340 m/s\"\nviscosity = \"18 uPa s\"\n\
         [impact.restitution.hardness]\n{}",
        grains.collect::<String>()
    );
    Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"))
}

pub(super) fn distinct() -> Hard {
    let scenario = scenario();
    let grains = crate::packing::place(&scenario, Path::new("")).unwrap();
    let grown = PRIMARIES.iter().zip(CAPACITIES);
    let grown = grown.map(|(&primaries, heat_capacity)| Grown { primaries, heat_capacity }).collect();
    let start = Start { grown, ..Start::from(grains) };
    let mut job = Hard::start(&scenario, start, &mut |_| ControlFlow::Continue(())).unwrap();
    let system = job.simulation.system_mut();
    system.contact_duration = 6.25e-6;
    let state = &mut system.state;
    for (motion, bulk) in state.spheres.motion.iter_mut().zip(&mut state.spheres.bulk) {
        let id = bulk.id as usize;
        (bulk.mass, bulk.temperature, bulk.bounced_at) = (MASSES[id], TEMPERATURES[id], 0.0);
        (motion.velocity, motion.time) = (VELOCITIES[id].into(), 0.25);
    }
    state.counts = counts();
    let ledger = &mut state.ledger;
    [ledger.start.stored.kinetic, ledger.start.stored.thermal] = STORES_AT_START;
    (ledger.start.momentum.linear, ledger.start.momentum_size) = (MOMENTUM_AT_START, 40.0);
    ledger.flows.collisions = CollisionFlows::default();
    ledger.flows.collisions.add(&IMPACTS);
    (ledger.flows.unkept, ledger.flows.walls) = (0.25.into(), WALLS);
    (ledger.flows.cooled, ledger.flows.kept) = (8.5, 0.002);
    for (text, times) in [("one", 15), ("two", 16)] {
        state.warnings.add_times(text, times);
    }
    let saved = HardState { simulation: job.simulation.state(), memory: job.memory };
    let mut state = serde_json::to_value(saved).unwrap();
    state["memory"] = json!({
        "mean_radius_at_start": MEAN_RADIUS_AT_START, "last_row": { "time": 0.3, "grains": 5.0, "impacts": 990 },
    });
    state["simulation"]["clock"] = json!({ "time": TIMES[0], "lag": 0.0, "step": 71, "last_step": TIMES[1] });
    state["simulation"]["grains_at_start"] = json!(10);
    Hard::resume(&scenario, serde_json::from_value(state).unwrap()).unwrap()
}

fn assert_row(table: &str, rest: &[Named<'_>]) {
    let folder = tempfile::tempdir().unwrap();
    let mut tables = tables(Hard::TABLES, folder.path());
    distinct().record_rows(&mut tables).unwrap();
    tables.flush().unwrap();
    let wanted: Vec<Named<'_>> = std::iter::once(("time_s", TIMES[0])).chain(rest.iter().copied()).collect();
    assert_table(folder.path(), table, &wanted, ROUND_OFF);
}

fn sum(of: impl Fn(usize) -> f64) -> f64 {
    (0..3).map(of).sum()
}

fn momentum() -> Vec3 {
    (0..3).map(|id| Vec3::from(VELOCITIES[id]) * MASSES[id]).sum()
}

fn speed(id: usize) -> f64 {
    Vec3::from(VELOCITIES[id]).norm()
}

/// What grains come to, under the names of the table where `is_table`, else under the keys of the summary.
fn growth(is_table: bool) -> Vec<Named<'static>> {
    let mass = sum(|id| MASSES[id]);
    let mean = sum(|id| RADII[id]) / 3.0;
    let united = sum(|id| RADII[id].powi(3)).cbrt();
    let center = momentum() / mass;
    let ratio = mean / MEAN_RADIUS_AT_START;
    let temperature = sum(|id| MASSES[id] * TEMPERATURES[id]) / mass;
    let speed_mean = sum(speed) / 3.0;
    let granular = sum(|id| (Vec3::from(VELOCITIES[id]) - center).norm_squared()) / 9.0;
    let both = [
        ("radius_ratio", ratio),
        ("n_f", ratio.powi(3)),
        ("growth_deficit", 1.0 - mean / united),
        ("mean_radius_m", mean),
        ("largest_radius_m", 4.5e-3),
        ("largest_primaries", 9.0),
        ("largest_fraction", 2.0 / 3.25),
        ("mean_speed_m_s", speed_mean),
        ("granular_temperature_m2_s2", granular),
    ];
    let table = [
        ("grains", 3.0),
        ("deviation_radius_m", (sum(|id| (RADII[id] - mean).powi(2)) / 3.0).sqrt()),
        ("mean_temperature_K", temperature),
        ("lowest_temperature_K", 290.0),
        ("highest_temperature_K", 420.0),
        ("mean_vx_m_s", center.x),
        ("mean_vy_m_s", center.y),
        ("mean_vz_m_s", center.z),
        ("largest_speed_m_s", speed(0)),
    ];
    let summary = [
        ("grains_end", 3.0),
        ("temperature_mean_K", temperature),
        ("temperature_lowest_K", 290.0),
        ("temperature_highest_K", 420.0),
        ("mean_radius_start_m", MEAN_RADIUS_AT_START),
        ("largest_radius_ratio", 4.5e-3 / MEAN_RADIUS_AT_START),
    ];
    let rest = if is_table { &table[..] } else { &summary[..] };
    both.iter().chain(rest).copied().collect()
}

#[test]
fn grains_of_hard_spheres_stand_under_their_names() {
    let order = [
        "grains",
        "mean_radius_m",
        "deviation_radius_m",
        "radius_ratio",
        "n_f",
        "growth_deficit",
        "largest_radius_m",
        "largest_primaries",
        "largest_fraction",
        "mean_temperature_K",
        "lowest_temperature_K",
        "highest_temperature_K",
        "mean_vx_m_s",
        "mean_vy_m_s",
        "mean_vz_m_s",
        "mean_speed_m_s",
        "largest_speed_m_s",
        "granular_temperature_m2_s2",
    ];
    let known = growth(true);
    let due = order.map(|column| *known.iter().find(|(name, _)| *name == column).unwrap());
    assert_row("series/grains.csv", &due);
}

/// The ledger by hand: 6.125 J of 17.5 J of heat are explained, 0.25 J had nowhere to stay, 8.5 J were given off.
fn energies() -> [Named<'static>; 12] {
    let kinetic = sum(|id| MASSES[id] * speed(id).powi(2) / 2.0);
    let thermal = sum(|id| CAPACITIES[id] * TEMPERATURES[id]);
    let (moved, warmed) = (kinetic - (50.0 - 3.125 - 4.0), thermal - (6000.0 + 17.5 - 0.25 - 8.5));
    [
        ("kinetic_J", kinetic),
        ("thermal_J", thermal),
        ("lost_normal_J", 3.125),
        ("lost_friction_J", 4.0),
        ("reaction_J", 5.0),
        ("surface_J", 6.0),
        ("heat_J", 17.5),
        ("unbalanced_J", 17.5 - (3.125 + 4.0 + 5.0 - 6.0)),
        ("cooled_J", 8.5),
        ("kinetic_drift_relative", moved / 50.0),
        ("drift_J", moved + warmed),
        ("drift_relative", (moved + warmed) / (50.0 + 6000.0 + 5.0 + 11.375)),
    ]
}

#[test]
fn energies_of_hard_spheres_stand_under_their_names() {
    assert_row("series/energy.csv", &energies());
}

#[test]
fn momenta_of_hard_spheres_stand_under_their_names() {
    let p = momentum();
    let drift = p - MOMENTUM_AT_START - WALLS;
    let wanted = [
        ("px_kg_m_s", p.x),
        ("py_kg_m_s", p.y),
        ("pz_kg_m_s", p.z),
        ("walls_px_kg_m_s", WALLS.x),
        ("walls_py_kg_m_s", WALLS.y),
        ("walls_pz_kg_m_s", WALLS.z),
        ("drift_px_kg_m_s", drift.x),
        ("drift_py_kg_m_s", drift.y),
        ("drift_pz_kg_m_s", drift.z),
    ];
    assert_row("series/momentum.csv", &wanted);
}

/// Since the last row 10 impacts of 4 grains in the mean in 0.2 s.
#[test]
fn impacts_of_hard_spheres_stand_under_their_names() {
    let wanted = [
        ("impacts", 1000.0),
        ("bounces", 611.0),
        ("merges", 302.0),
        ("fragmentations", 87.0),
        ("fragmentations_without_room", 14.0),
        ("tc_bounces", 5.0),
        ("overlapping", 13.0),
        ("walls", 12.0),
        ("iterations", 7700.0),
        ("most_iterations", 19.0),
        ("not_converged", 11.0),
        ("mean_free_time_s", 4.0 * 0.2 / 20.0),
    ];
    assert_row("series/impacts.csv", &wanted);
}

#[test]
fn steps_of_hard_spheres_stand_under_their_names() {
    assert_row("series/steps.csv", &[("step", 71.0), ("step_size_s", TIMES[1])]);
}

/// The next row's mean free time is since this row, and of the grains of both.
#[test]
fn a_row_is_remembered_for_the_next() {
    let folder = tempfile::tempdir().unwrap();
    let mut tables = tables(Hard::TABLES, folder.path());
    let mut job = distinct();
    job.record_rows(&mut tables).unwrap();
    let last = serde_json::to_value(job.memory.last_row).unwrap();
    assert_eq!(last, json!({ "time": TIMES[0], "grains": 3.0, "impacts": 1000 }));
}

#[test]
fn quantities_of_hard_spheres_stand_under_their_keys() {
    let Summary::Hard(summary) = distinct().summary(&scenario(), 7.25) else { panic!("of hard spheres") };
    let energy = energies().map(|(name, joule)| (format!("energy.{name}"), joule));
    let mut wanted = growth(false);
    wanted.extend(energy.iter().map(|(name, joule)| (name.as_str(), *joule)));
    // b = (3/rho) sqrt(H/(2 pi G)).
    let gravity = 3.0 / 2000.0 * (0.6e6 / (TAU * 6.6743e-11)).sqrt();
    let reynolds = (0..3).map(|id| 2.0 * RADII[id] * speed(id) * 1.2 / 18e-6).fold(0.0, f64::max);
    let drift = momentum() - MOMENTUM_AT_START - WALLS;
    wanted.extend([
        ("wall_s", 7.25),
        ("time_s", TIMES[0]),
        ("steps", 71.0),
        ("step_mean_s", TIMES[0] / 71.0),
        ("contact_duration_s", 6.25e-6),
        ("seed", 21.0),
        ("grains_start", 10.0),
        ("self_gravity_radius_m", gravity),
        ("largest_over_self_gravity", 4.5e-3 / gravity),
        ("reynolds_number", reynolds),
        ("impacts", 1000.0),
        ("bounces", 611.0),
        ("merges", 302.0),
        ("fragmentations", 87.0),
        ("fragmentations_without_room", 14.0),
        ("tc_kept_J", 0.002),
        ("impacts_overlapping", 13.0),
        ("impacts_walls", 12.0),
        ("events", 388.0),
        ("events_per_impact", 71.0 / 1000.0),
        ("solver_iterations_mean", 7.7),
        ("solver_iterations_most", 19.0),
        ("solves_not_converged", 11.0),
        ("energy.kinetic_at_start_J", 50.0),
        ("energy.thermal_at_start_J", 6000.0),
        ("momentum_drift_relative", drift.norm() / 40.0),
        ("warnings.one", 15.0),
        ("warnings.two", 16.0),
    ]);
    let mut tree = serde_json::to_value(&summary).unwrap();
    for (key, due) in [("grains", 3.0), ("tc_bounces", 5.0)] {
        assert_eq!(tree[key].as_f64(), Some(due), "summary.json: {key}: found on the left, due on the right");
    }
    assert_eq!(
        (summary.scales.biot_number, summary.run.steps_are.as_str()),
        (None, "steps"),
        "nothing cools"
    );
    assert_eq!((summary.run.title.as_str(), summary.run.threads), ("distinct", rayon::current_num_threads()));
    // Warnings of laws are no quantities of the state.
    tree["warnings"].as_object_mut().unwrap().retain(|text, _| ["one", "two"].contains(&text.as_str()));
    assert_quantities("summary.json", &tree, &wanted, &["threads", "grains", "tc_bounces"], ROUND_OFF);
}

/// What is printed at the end, each row with its own quantities.
#[test]
fn rows_of_the_closing_table_have_their_own_quantities() {
    let Summary::Hard(summary) = distinct().summary(&scenario(), 7.25) else { panic!("of hard spheres") };
    let table = summary.table();
    let quantity = |what: &str| table.iter().find(|(known, _)| known == what).unwrap().1.as_str();
    let wanted = [
        ("simulated time", "500 ms in 71 steps"),
        ("grains", "3 left of 10"),
        ("mean radius", "2.5 mm, 2.0000 times the 1.25 mm at the start"),
        ("growth", "n_f 8.0000, Pi 0.46162 (0 if all were one sphere)"),
        ("largest grain", "radius 4.5 mm, 9 primaries, 61.54 % of the mass"),
        ("impacts", "1000: 611 bounces, 302 merges, 87 breakages"),
        ("temperature", "323.1 K in the mean, 290 K to 420 K"),
    ];
    for (what, due) in wanted {
        assert_eq!(quantity(what), due, "row {what}: found on the left, due on the right");
    }
}

/// Half the time after their own times the grains are where their velocities bring them.
#[test]
fn fields_of_hard_spheres_stand_under_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let folder = RunFolder::create(&folder.path().join("run")).unwrap();
    distinct().record_frame(&mut Frames::new(&folder, FrameLists::default())).unwrap();
    let frame = Frame::read(&folder.frames().join("grains_000000.vtp")).unwrap();
    assert_eq!(frame.time, TIMES[0], "time [s]");
    for (id, found) in frame.points.iter().enumerate() {
        let due = Vec3::from(PLACES[id]) + Vec3::from(VELOCITIES[id]) * 0.25;
        // One rounding of a sum of about 1 m.
        assert!((Vec3::from(*found) - due).norm() < 1e-15, "grain {id}: point {found:?} is due {due:?} [m]");
    }
    let scalars = |of: &dyn Fn(usize) -> f64| FieldValues::Scalars((0..3).map(of).collect());
    let counts = |values: [u32; 3]| FieldValues::Integers(values.to_vec());
    let wanted = [
        ("id", counts([0, 1, 2])),
        ("primaries", counts(PRIMARIES)),
        ("velocity_m_s", FieldValues::Vectors(VELOCITIES.to_vec())),
        ("radius_m", scalars(&|id| RADII[id])),
        ("mass_kg", scalars(&|id| MASSES[id])),
        ("temperature_K", scalars(&|id| TEMPERATURES[id])),
    ];
    for (name, due) in &wanted {
        assert_eq!(
            frame.field(name),
            Some(due),
            "field {name}: found on the left, due on the right (in its unit)"
        );
    }
}

/// All events first, with their lines of descent in the table of those.
#[test]
fn events_of_hard_spheres_go_into_their_tables() {
    let folder = tempfile::tempdir().unwrap();
    let mut tables = tables(Hard::TABLES, folder.path());
    let mut job = distinct();
    let system = job.simulation.system_mut();
    system.events.push(GrainEvent {
        number: 3,
        time: 0.125,
        kind: EventKind::Break,
        grains: [4, 9],
        masses: [1.5, 2.5],
        speed: 2.0,
        restitution: 0.75,
        energy: IMPACTS,
    });
    let merge = GrainEvent { number: 4, kind: EventKind::Merge, ..system.events[0] };
    system.events.push(merge);
    system.descents.push(Descent { event: 3, parent: 4, child: 11, primaries: 12, mass: 0.625 });
    job.record_events(&mut tables).unwrap();
    tables.flush().unwrap();
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let wanted = "event,time_s,kind,grain_i,grain_j,mass_i_kg,mass_j_kg,approach_speed_m_s,restitution,lost_normal_J,\
                  lost_friction_J,reaction_J,surface_J,heat_J\n3,0.125,break,4,9,1.5,2.5,2,0.75,3.125,4,5,6,17.5\n\
                  4,0.125,merge,4,9,1.5,2.5,2,0.75,3.125,4,5,6,17.5\n";
    assert_eq!(read("events.csv"), wanted, "events.csv: found on the left, due on the right");
    let wanted = "event,parent,child,primaries,mass_kg\n3,4,11,12,0.625\n";
    assert_eq!(read("genealogy.csv"), wanted, "genealogy.csv: found on the left, due on the right");
}

/// Grains of 1, 2 and 9 primaries for 0.5 s: singles met the double 7 times and merged twice, and 9 broke into 4, 4 and 1.
#[test]
fn tables_at_the_end_stand_under_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let folder = RunFolder::create(&folder.path().join("run")).unwrap();
    let mut job = distinct();
    let rates = &mut job.simulation.system_mut().state.rates;
    (0..7).for_each(|number| rates.collide([1, 2], number < 2));
    rates.collide_and_break([9, 1]);
    rates.shatter(9, &[4, 4, 1], 0.5);
    job.record_end(&folder).unwrap();
    let rows = |name: &str| -> Vec<Vec<String>> {
        let text = std::fs::read_to_string(folder.root().join(name)).unwrap();
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let cell = |name: &str, column: &str, is_row: &dyn Fn(&[String]) -> bool| -> f64 {
        let rows = rows(name);
        let at = rows[0].iter().position(|known| known == column);
        let at = at.unwrap_or_else(|| panic!("{name} has no column {column}: {:?}", rows[0]));
        let row = rows[1..].iter().find(|row| is_row(row)).unwrap_or_else(|| panic!("{name}: {rows:?}"));
        row[at].parse().unwrap()
    };
    let begins = |row: &[String], with: &[&str]| row[..with.len()] == *with;
    let pair = |row: &[String]| begins(row, &["2", "3", "1", "1"]);
    // One pair for 0.5 s in 8 m3.
    let exposure = 0.5 / 8.0;
    let wanted = [
        ("collisions", 7.0),
        ("merges", 2.0),
        ("breaking_collisions", 0.0),
        ("exposure_s_m3", exposure),
        ("collision_kernel_m3_s", 7.0 / exposure),
        ("aggregation_kernel_m3_s", 2.0 / exposure),
        ("breaking_kernel_m3_s", 0.0),
        ("sticking_probability", 2.0 / 7.0),
    ];
    for (column, due) in wanted {
        let found = cell("kernels.csv", column, &pair);
        assert!(
            (found - due).abs() <= 1e-14 * due,
            "kernels.csv: column {column} is due {due}, found {found}"
        );
    }
    assert_eq!(cell("kernels.csv", "breaking_collisions", &|row| begins(row, &["8", "15", "1", "1"])), 1.0);
    let wanted = [("grains", 0.0), ("grain_time_s", 0.5), ("breakages", 1.0), ("breakage_rate_1_s", 2.0)];
    for (column, due) in wanted {
        let found = cell("breakage.csv", column, &|row| begins(row, &["8", "15"]));
        assert_eq!(found, due, "breakage.csv: column {column}: found on the left, due on the right");
    }
    let found = cell("breakage.csv", "grain_time_s", &|row| begins(row, &["2", "3"]));
    assert_eq!(found, 0.5, "breakage.csv: the double was there for 0.5 s and is untouched: grain_time_s");
    let wanted = [
        ("breakages", 1.0),
        ("fragments", 2.0),
        ("primaries", 8.0),
        ("fragments_per_breakage", 2.0),
        ("mass_fraction", 8.0 / 9.0),
    ];
    for (column, due) in wanted {
        let found = cell("daughters.csv", column, &|row| begins(row, &["8", "15", "4", "7"]));
        assert_eq!(found, due, "daughters.csv: column {column}: found on the left, due on the right");
    }
}
