//! Which charts a run gets.

use super::chart::{Axis, Chart, Kind, Lines, Series, kept};
use super::folder::Folder;
use super::pulses;
use super::table::Table;
use crate::impact::heat::Balance;

const fn lines(
    [table, id, title, label, unit]: [&'static str; 5],
    about: &'static str,
    columns: &'static [(&'static str, &'static str)],
) -> Lines {
    Lines { table, id, title, about, label, unit, log: false, columns }
}

/// Heat that only the published balance makes; in the consistent one it is round-off.
const FALSE_HEAT: &str = "from nowhere (published balance)";

/// Charts of soft spheres.
const SOFT: &[Lines] = &[
    lines(
        ["clusters", "dispersion", "Dispersion", "part of the mass", ""],
        "The mass of the largest cluster, what is not in it (the dispersion degree), and how much of the largest cluster \
         of the start is no longer together.",
        &[
            ("dispersion_degree", "dispersion degree"),
            ("dispersion_degree_relative", "relative to the start"),
            ("largest_fraction", "largest cluster"),
        ],
    ),
    lines(
        ["clusters", "clusters", "Clusters, contacts and bonds", "how many", ""],
        "A cluster is what contacts and bonds hold together; single grains count as clusters.",
        &[("clusters", "clusters"), ("contacts", "contacts"), ("bonds", "bonds")],
    ),
    lines(
        ["rays", "rays", "Rays", "how many", ""],
        "Rays in flight, reflections so far, and straight pieces of their ways so far.",
        &[("in_flight", "in flight"), ("reflections", "reflections"), ("segments", "segments")],
    ),
    lines(
        ["rays", "beam", "Beam power left", "part of the pulse's power", ""],
        "Power of all rays of the latest pulse by direction, those that left as they were then: their powers times the parts of \
         their directions, over the pulse's power. What is missing to 1 in all is what grains took.",
        &[("beam_x", "along x"), ("beam_y", "along y"), ("beam_z", "along z"), ("beam_magnitude", "in all")],
    ),
    lines(
        ["rays", "flying", "Power in flight", "part of the pulse's power", ""],
        "The same of the rays in flight alone. Rays cross the grains in a short time; rows further apart see single moments of it.",
        &[
            ("flying_x", "along x"),
            ("flying_y", "along y"),
            ("flying_z", "along z"),
            ("flying_magnitude", "in all"),
        ],
    ),
    lines(
        ["rays", "power", "Power of the pulses", "power", "W"],
        "What was launched so far, and where it went.",
        &[
            ("power_in_W", "launched"),
            ("power_absorbed_W", "taken up by grains"),
            ("power_escaped_W", "left for good"),
            ("power_truncated_W", "dropped"),
        ],
    ),
    lines(
        ["energy", "stores", "Energy: where it is", "energy", "J"],
        "The stores of the ledger.",
        &[
            ("kinetic_J", "kinetic"),
            ("spin_J", "spin"),
            ("elastic_J", "elastic"),
            ("tangential_spring_J", "tangential springs"),
            ("bonds_J", "bonds"),
            ("near_field_J", "near field"),
        ],
    ),
    lines(
        ["energy", "flows", "Energy: put in and lost", "energy", "J"],
        "The channels of the ledger since the start, and what they and the stores do not explain.",
        &[
            ("work_rays_J", "put in by rays"),
            ("work_gravity_J", "put in by gravity"),
            ("work_fields_J", "put in by fields"),
            ("lost_drag_J", "lost to drag"),
            ("lost_contact_damping_J", "lost in contacts"),
            ("lost_friction_J", "lost to friction"),
            ("lost_bond_damping_J", "lost in bonds"),
            ("lost_broken_bonds_J", "lost with broken bonds"),
            ("drift_J", "not explained"),
        ],
    ),
    lines(
        ["moments", "speed", "Speed", "speed", "m/s"],
        "Speeds of the grains.",
        &[("mean_speed_m_s", "mean by mass"), ("largest_speed_m_s", "largest")],
    ),
    lines(
        ["steps", "step", "Step size", "step", "s"],
        "Length of the last accepted step.",
        &[("step_size_s", "step size")],
    ),
    lines(
        ["steps", "iterations", "Iterations of the staggered scheme", "so far", ""],
        "Iterations and rejected tries since the start.",
        &[("iterations", "iterations"), ("rejected", "rejected tries")],
    ),
    lines(
        ["steps", "strain", "Largest overlap", "part of the sum of the radii", ""],
        "The largest overlap of two grains, over the sum of their radii.",
        &[("largest_strain", "largest overlap")],
    ),
];

/// Charts of hard spheres.
const HARD: &[Lines] = &[
    lines(
        ["grains", "grains", "Grains left", "how many", ""],
        "Grains become fewer when they merge and more when they break.",
        &[("grains", "grains")],
    ),
    lines(
        ["grains", "growth", "Growth", "over the mean radius at the start", ""],
        "The mean radius by number.",
        &[("radius_ratio", "mean radius")],
    ),
    lines(
        ["grains", "largest", "The largest grain", "primaries", ""],
        "How many of the first grains it holds.",
        &[("largest_primaries", "largest grain")],
    ),
    lines(
        ["grains", "temperature", "Temperature", "temperature", "K"],
        "Temperatures of the grains.",
        &[
            ("mean_temperature_K", "mean by mass"),
            ("lowest_temperature_K", "lowest"),
            ("highest_temperature_K", "highest"),
        ],
    ),
    lines(
        ["impacts", "impacts", "Impacts", "so far", ""],
        "Impacts since the start, and what came of them.",
        &[
            ("impacts", "impacts"),
            ("bounces", "bounces"),
            ("merges", "merges"),
            ("fragmentations", "breakages"),
            ("walls", "bounces off walls"),
        ],
    ),
    lines(
        ["impacts", "iterations", "Iterations of an impact's solution", "most of one impact", ""],
        "The coupled solution of an impact: most iterations that one needed so far.",
        &[("most_iterations", "most iterations"), ("not_converged", "not converged, in all")],
    ),
    lines(
        ["energy", "energy", "Kinetic energy and where it went", "energy", "J"],
        "The ledger's kinetic energy now, and its losses since the start.",
        &[
            ("kinetic_J", "kinetic"),
            ("lost_normal_J", "lost along the normal"),
            ("lost_friction_J", "lost to friction"),
            ("surface_J", "new surfaces"),
        ],
    ),
    lines(
        ["energy", "heat", "Heat", "energy", "J"],
        "The ledger's heat since the start, and what is stored in warm grains now.",
        &[
            ("thermal_J", "stored"),
            ("reaction_J", "set free by reactions"),
            ("heat_J", "taken up in impacts"),
            ("cooled_J", "given off"),
            ("unbalanced_J", FALSE_HEAT),
        ],
    ),
    lines(
        ["grains", "speeds", "Speed", "speed", "m/s"],
        "Speeds of the grains as seen from the box.",
        &[("mean_speed_m_s", "mean"), ("largest_speed_m_s", "largest")],
    ),
    lines(
        ["steps", "step", "Step size", "step", "s"],
        "Length of the last step; from event to event, the mean time between two impacts.",
        &[("step_size_s", "step size")],
    ),
];

/// The charts of a run; those without data are left out.
pub fn charts(folder: &Folder) -> Vec<Chart> {
    let is_hard = match &folder.scenario {
        Some(scenario) => scenario.engine.is_hard(),
        None => folder.table("grains").is_some() || folder.table("impacts").is_some(),
    };
    let wanted = if is_hard { HARD } else { SOFT };
    let mut charts: Vec<Chart> =
        wanted.iter().filter_map(|lines| lines.chart(folder.table(lines.table)?)).collect();
    if !is_published(folder) {
        for chart in &mut charts {
            chart.leave_out(FALSE_HEAT);
        }
    }
    // Beside the charts of the same figures over the whole run.
    let after = charts.iter().rposition(|chart| ["rays", "beam"].contains(&chart.id.as_str()));
    let of_pulses = folder.table("rays").map(|rays| pulses::charts(rays, wanted)).unwrap_or_default();
    let place = after.map_or(charts.len(), |at| at + 1);
    charts.splice(place..place, of_pulses);
    charts.extend(folder.table("sizes").and_then(sizes));
    charts
}

/// Whether heat follows the published balance.
fn is_published(folder: &Folder) -> bool {
    let impact = folder.scenario.as_ref().and_then(|scenario| scenario.impact.as_ref());
    impact.is_some_and(|impact| impact.heat.balance == Balance::Published)
}

/// Classes of size over time: how much of the mass is in each.
fn sizes(table: &Table) -> Option<Chart> {
    let [time, lower, upper, part] =
        ["time_s", "lower_primaries", "upper_primaries", "mass_fraction"].map(|name| table.column(name));
    let (time, lower, upper, part) = (time?, lower?, upper?, part?);
    let times = distinct(time);
    let x: Vec<f64> = kept(times.len()).into_iter().map(|at| times[at]).collect();
    let classes = distinct(lower);
    let place = |values: &[f64], value: f64| values.binary_search_by(|known| known.total_cmp(&value)).ok();
    let mut z = vec![vec![0.0; x.len()]; classes.len()];
    let mut names = vec![String::new(); classes.len()];
    for row in 0..time.len() {
        let class = place(&classes, lower[row])?;
        names[class] = if upper[row] > lower[row] {
            format!("{}–{}", lower[row], upper[row])
        } else {
            lower[row].to_string()
        };
        if let Some(column) = place(&x, time[row]) {
            z[class][column] = part[row];
        }
    }
    let at_last = z.iter().zip(&names).filter_map(|(parts, name)| {
        let part = 100.0 * *parts.last()?;
        (part > 0.0).then(|| format!("{name} primaries: {part:.1} % of the mass at last"))
    });
    let words = at_last.collect();
    let y = (0..classes.len()).map(|class| class as f64).collect();
    let label = "part of the mass".to_owned();
    Some(Chart {
        id: "sizes".to_owned(),
        title: "Sizes over time".to_owned(),
        caption: "How much of the mass is in grains of each class of size. From series/sizes.csv.".to_owned(),
        words,
        kind: Kind::Map,
        x: Axis::new("time", "s"),
        y: Axis { names, ..Axis::new("primaries in a grain", "") },
        series: vec![Series { name: "mass".to_owned(), x, y, z, label, ..Series::default() }],
    })
}

fn distinct(column: &[f64]) -> Vec<f64> {
    let mut values = column.to_vec();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_that_are_not_there_at_a_time_hold_nothing() {
        let names = ["time_s", "lower_primaries", "upper_primaries", "mass_fraction"].map(str::to_owned);
        let columns =
            vec![vec![0.0, 1.0, 1.0], vec![1.0, 1.0, 2.0], vec![1.0, 1.0, 3.0], vec![1.0, 0.25, 0.75]];
        let chart = sizes(&Table { names: names.to_vec(), columns, dropped: 0 }).unwrap();
        assert_eq!(chart.y.names, ["1", "2–3"]);
        assert_eq!(chart.series[0].x, [0.0, 1.0]);
        assert_eq!(chart.series[0].z, [[1.0, 0.25], [0.0, 0.75]]);
        assert_eq!(chart.words[1], "2–3 primaries: 75.0 % of the mass at last");
    }
}

#[cfg(test)]
#[path = "charts_tests.rs"]
mod shown_tests;
