//! Which columns the charts show, under which names and in which units: from tables of distinct quantities.

use std::ops::ControlFlow;
use std::path::Path;

use super::*;
use agglo::scenario::Scenario;

/// A chart: its name, the table, what the vertical axis counts and its unit, and each line's name with its column.
type Shown = (&'static str, &'static str, [&'static str; 2], &'static [(&'static str, &'static str)]);

const SHOWN_SOFT: &[Shown] = &[
    (
        "dispersion",
        "clusters",
        ["part of the mass", ""],
        &[
            ("largest cluster", "largest_fraction"),
            ("dispersion degree", "dispersion_degree"),
            ("dispersion degree relative to the start", "dispersion_degree_relative"),
        ],
    ),
    (
        "clusters",
        "clusters",
        ["how many", ""],
        &[("clusters", "clusters"), ("contacts", "contacts"), ("bonds", "bonds")],
    ),
    (
        "rays",
        "rays",
        ["how many", ""],
        &[("rays in flight", "in_flight"), ("reflections", "reflections"), ("segments", "segments")],
    ),
    (
        "beam",
        "rays",
        ["part of the pulse's power", ""],
        &[
            ("beam power along x", "beam_x"),
            ("beam power along y", "beam_y"),
            ("beam power along z", "beam_z"),
            ("beam power in all", "beam_magnitude"),
        ],
    ),
    (
        "flying",
        "rays",
        ["part of the pulse's power", ""],
        &[
            ("power in flight along x", "flying_x"),
            ("power in flight along y", "flying_y"),
            ("power in flight along z", "flying_z"),
            ("power in flight", "flying_magnitude"),
        ],
    ),
    (
        "power",
        "rays",
        ["power", "W"],
        &[
            ("launched", "power_in_W"),
            ("taken up by grains", "power_absorbed_W"),
            ("taken up by walls", "power_into_walls_W"),
            ("left for good", "power_escaped_W"),
            ("dropped", "power_truncated_W"),
            ("cut off", "power_cut_off_W"),
        ],
    ),
    (
        "stores",
        "energy",
        ["energy", "J"],
        &[
            ("kinetic energy", "kinetic_J"),
            ("rotational energy", "rotational_J"),
            ("elastic energy", "elastic_J"),
            ("energy of tangential springs", "tangential_spring_J"),
            ("energy of bonds", "bonds_J"),
            ("energy of the near field", "near_field_J"),
            ("energy in fields", "fields_J"),
        ],
    ),
    (
        "flows",
        "energy",
        ["energy", "J"],
        &[
            ("put in by rays", "work_rays_J"),
            ("put in by gravity", "work_gravity_J"),
            ("put in by fields", "work_fields_J"),
            ("put in by the volume", "work_volume_J"),
            ("put in by custom laws", "work_custom_J"),
            ("put in by walls", "work_walls_J"),
            ("lost to drag", "lost_drag_J"),
            ("lost in contacts", "lost_contact_damping_J"),
            ("lost to friction", "lost_friction_J"),
            ("lost in bonds", "lost_bond_damping_J"),
            ("lost with broken bonds", "lost_broken_bonds_J"),
            ("lost with grains that left", "lost_absorbed_J"),
            ("not explained", "drift_J"),
        ],
    ),
    (
        "speed",
        "moments",
        ["speed", "m/s"],
        &[("mean speed", "mean_speed_m_s"), ("largest speed", "largest_speed_m_s")],
    ),
    ("step", "steps", ["step", "s"], &[("step", "step_size_s")]),
    ("iterations", "steps", ["so far", ""], &[("iterations", "iterations"), ("rejected tries", "rejected")]),
    ("strain", "steps", ["part of the sum of the radii", ""], &[("largest overlap", "largest_strain")]),
];

const SHOWN_HARD: &[Shown] = &[
    ("grains", "grains", ["how many", ""], &[("grains", "grains")]),
    ("growth", "grains", ["over the mean radius at the start", ""], &[("radius ratio", "radius_ratio")]),
    ("largest", "grains", ["primaries", ""], &[("primaries of the largest grain", "largest_primaries")]),
    (
        "temperature",
        "grains",
        ["temperature", "K"],
        &[
            ("mean temperature", "mean_temperature_K"),
            ("lowest temperature", "lowest_temperature_K"),
            ("highest temperature", "highest_temperature_K"),
        ],
    ),
    (
        "impacts",
        "impacts",
        ["so far", ""],
        &[
            ("impacts", "impacts"),
            ("bounces", "bounces"),
            ("merges", "merges"),
            ("breakages", "fragmentations"),
            ("bounces off walls", "walls"),
        ],
    ),
    (
        "iterations",
        "impacts",
        ["most of one impact", ""],
        &[("most iterations", "most_iterations"), ("not converged, in all", "not_converged")],
    ),
    (
        "energy",
        "energy",
        ["energy", "J"],
        &[
            ("kinetic energy", "kinetic_J"),
            ("lost along the normal", "lost_normal_J"),
            ("lost to friction", "lost_friction_J"),
            ("new surfaces", "surface_J"),
        ],
    ),
    (
        "heat",
        "energy",
        ["energy", "J"],
        &[
            ("thermal energy", "thermal_J"),
            ("set free by reactions", "reaction_J"),
            ("heat of impacts", "heat_J"),
            ("given off", "cooled_J"),
        ],
    ),
    (
        "speeds",
        "grains",
        ["speed", "m/s"],
        &[("mean speed", "mean_speed_m_s"), ("largest speed", "largest_speed_m_s")],
    ),
    ("step", "steps", ["step", "s"], &[("time between steps", "step_size_s")]),
];

/// A grain at rest for a step: a folder with all tables of its engine.
fn folder_of(engine: &str) -> Folder {
    let text = format!(
        "version = 1\ntime.end = \"1 ms\"\n{engine}\nmaterials.glass.density = \"2500 kg/m3\"\n[[grains]]\n\
         material = \"glass\"\nsize.constant.radius = \"1 mm\"\nplacement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"]]\n"
    );
    let scenario = Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"));
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("run");
    run::run(&scenario, Path::new(""), &dir, &mut |_| ControlFlow::Continue(())).unwrap();
    Folder::read(&dir)
}

/// The same with two rows of quantities that are nowhere the same; sizes of the table of sizes are none.
fn distinct(engine: &str) -> Folder {
    let mut folder = folder_of(engine);
    folder.tables.retain(|(name, _)| name != "sizes");
    let mut quantity = 0.0;
    for (_, table) in &mut folder.tables {
        for (name, column) in table.names.iter().zip(&mut table.columns) {
            quantity += 1.0;
            *column = if name == "time_s" { vec![0.25, 0.75] } else { vec![quantity, quantity + 0.5] };
        }
    }
    folder
}

/// The unit that ends the name of a column.
fn unit_of(column: &str) -> &'static str {
    let units = [("_m_s", "m/s"), ("_J", "J"), ("_W", "W"), ("_K", "K"), ("_s", "s"), ("_m", "m")];
    units.into_iter().find(|(end, _)| column.ends_with(end)).map_or("", |(_, unit)| unit)
}

fn assert_shown(engine: &str, shown: &[Shown]) {
    let folder = distinct(engine);
    let charts = charts(&folder);
    let found: Vec<&str> = charts.iter().map(|chart| chart.id.as_str()).collect();
    let due: Vec<&str> = shown.iter().map(|(id, ..)| *id).collect();
    assert_eq!(found, due, "charts: found on the left, due on the right");
    for (chart, (id, table, [label, unit], lines)) in charts.iter().zip(shown) {
        let Drawn::Curves(curves) = &chart.drawn else { panic!("chart {id}: lines are due") };
        assert_eq!(curves.y, Axis::new(label, unit), "chart {id}: vertical axis");
        assert_eq!(curves.x, Axis::new("time", "s"), "chart {id}: horizontal axis");
        assert!(
            chart.caption.ends_with(&format!("From series/{table}.csv.")),
            "chart {id}: {}",
            chart.caption
        );
        let found: Vec<&str> = curves.series.iter().map(|series| series.name.as_str()).collect();
        let due: Vec<&str> = lines.iter().map(|(name, _)| *name).collect();
        assert_eq!(found, due, "chart {id}: lines: found on the left, due on the right");
        for (series, (name, column)) in curves.series.iter().zip(*lines) {
            assert_eq!(*unit, unit_of(column), "chart {id}: unit of {column}");
            let values = folder.table(table).and_then(|table| table.column(column));
            assert_eq!(
                Some(&series.y[..]),
                values,
                "chart {id}: line \"{name}\" shows another column than {column} [{unit}]"
            );
            assert_eq!(series.x, [0.25, 0.75], "chart {id}: line \"{name}\": times [s]");
        }
        assert_eq!(chart.words.len(), lines.len(), "chart {id}: words");
    }
}

#[test]
fn charts_of_soft_spheres_show_their_columns() {
    assert_shown("engine.verlet.step = \"1 ms\"", SHOWN_SOFT);
}

const HARD_ENGINE: &str = "engine.event_driven = {}\n\
    volume = { lower = [\"-1 m\", \"-1 m\", \"-1 m\"], upper = [\"1 m\", \"1 m\", \"1 m\"] }\n\
    impact.restitution.constant.restitution = 1.0";

#[test]
fn charts_of_hard_spheres_show_their_columns() {
    assert_shown(HARD_ENGINE, SHOWN_HARD);
}

/// Only the published balance makes heat from nothing.
#[test]
fn heat_from_nowhere_is_shown_where_it_can_be() {
    let engine = format!("{HARD_ENGINE}\nimpact.heat.balance = \"published\"");
    let folder = distinct(&engine);
    let charts = charts(&folder);
    let heat = charts.iter().find(|chart| chart.id == "heat").unwrap();
    let line = heat.series().iter().find(|series| series.name.contains("from nowhere")).unwrap();
    assert_eq!(Some(&line.y[..]), folder.table("energy").unwrap().column("unbalanced_J"), "unbalanced_J [J]");
}
