//! What walls did: charts over time, one line for each, and a table of how they were at the end.

use super::QuantityTable;
use super::folder::Folder;
use super::lines::kept;
use super::table::Table;
use crate::chart::{Axis, Chart, Curves, Drawn, Series};
use agglo::folder::names::WALLS;
use agglo::run::Summary;
use agglo::text::readable;

/// A chart with a line for each wall.
struct Shown {
    id: &'static str,
    title: &'static str,
    about: &'static str,
    label: &'static str,
    unit: &'static str,
    /// How many of that unit the table's is: prefixes go before gram, and tables have kilograms.
    factor: f64,
    /// Columns of the table of walls; of several the line shows the length of the vector.
    columns: &'static [&'static str],
}

const SHOWN: [Shown; 4] = [
    Shown {
        id: "walls-passed",
        title: "Out through openings",
        about: "Mass of the grains that are beyond each plane with an opening.",
        label: "mass",
        unit: "g",
        factor: 1e3,
        columns: &["passed_kg"],
    },
    Shown {
        id: "walls-force",
        title: "Force on walls",
        about: "Size of the sum of all forces of grains on each wall: what presses on opposite sides of a wall cancels.",
        label: "force",
        unit: "N",
        factor: 1.0,
        columns: &["force_x_N", "force_y_N", "force_z_N"],
    },
    Shown {
        id: "walls-work",
        title: "Work of walls",
        about: "What each wall that moves has put in since the start; negative where grains drive it.",
        label: "work",
        unit: "J",
        factor: 1.0,
        columns: &["work_J"],
    },
    Shown {
        id: "walls-sound",
        title: "Sound into walls",
        about: "Energy of rays that went into each wall since the start.",
        label: "energy",
        unit: "J",
        factor: 1.0,
        columns: &["sound_energy_J"],
    },
];

/// The charts of walls; those in which nothing moves are left out.
pub fn charts(folder: &Folder) -> Vec<Chart> {
    let Some(table) = folder.table("walls") else { return Vec::new() };
    SHOWN.iter().filter_map(|shown| shown.chart(table, &names(folder))).collect()
}

/// Names of the walls, in the order of their numbers; none where the scenario is not known.
fn names(folder: &Folder) -> Vec<String> {
    let soft = folder.scenario.as_ref().and_then(|scenario| scenario.soft());
    soft.map_or(Vec::new(), |soft| soft.walls.iter().map(|wall| wall.name.clone()).collect())
}

impl Shown {
    fn chart(&self, table: &Table, names: &[String]) -> Option<Chart> {
        let (time, number) = (table.column("time_s")?, table.column("wall")?);
        let parts: Option<Vec<&[f64]>> = self.columns.iter().map(|name| table.column(name)).collect();
        let parts = parts?;
        let value = |row: usize| match parts[..] {
            [only] => only[row],
            _ => parts.iter().map(|part| part[row] * part[row]).sum::<f64>().sqrt(),
        };
        let mut walls: Vec<f64> = number.to_vec();
        walls.sort_by(f64::total_cmp);
        walls.dedup();
        let mut series = Vec::new();
        for wall in walls {
            let rows: Vec<usize> = (0..number.len()).filter(|&row| number[row] == wall).collect();
            let rows: Vec<usize> = kept(rows.len()).into_iter().map(|at| rows[at]).collect();
            let y: Vec<f64> = rows.iter().map(|&row| self.factor * value(row)).collect();
            if y.iter().any(|value| *value != 0.0 && value.is_finite()) {
                let known = names.get(wall as usize).cloned();
                let name = known.unwrap_or_else(|| format!("wall {wall}"));
                series.push(Series::new(&name, rows.iter().map(|&row| time[row]).collect(), y));
            }
        }
        (!series.is_empty()).then(|| Chart {
            id: self.id.to_owned(),
            title: self.title.to_owned(),
            caption: format!("{} From {WALLS}.", self.about),
            words: series.iter().map(|series| series.in_words(self.unit)).collect(),
            drawn: Drawn::Curves(Curves {
                x: Axis::new("time", "s"),
                y: Axis::new(self.label, self.unit),
                series,
                references: Vec::new(),
            }),
        })
    }
}

/// The walls at the end, if there are any.
pub fn table(summary: &Summary) -> Option<QuantityTable> {
    let Summary::Soft(summary) = summary else { return None };
    let triple = |parts: [f64; 3], unit: &str| parts.map(|part| readable(part, unit)).join(", ");
    let is_heard = summary.walls.iter().any(|wall| wall.sound_energy > 0.0 || wall.sound_impulse != [0.0; 3]);
    let row = |wall: &agglo::run::WallQuantities| {
        let passed = match (wall.passed, wall.passed_mass) {
            (Some(grains), Some(mass)) => format!("{grains} grains, {}", readable(mass, "kg")),
            _ => "–".to_owned(),
        };
        let sound = if is_heard {
            vec![triple(wall.sound_impulse, "N s"), readable(wall.sound_energy, "J")]
        } else {
            Vec::new()
        };
        let mut cells = vec![
            wall.name.clone(),
            wall.contacts.to_string(),
            triple(wall.force, "N"),
            triple(wall.torque, "N m"),
            readable(wall.work, "J"),
            passed,
        ];
        cells.extend(sound);
        cells
    };
    let rows: Vec<Vec<String>> = summary.walls.iter().map(row).collect();
    let mut head = vec![
        "wall",
        "contacts",
        "force (x, y, z)",
        "torque (x, y, z)",
        "work put in",
        "out through its opening",
    ];
    if is_heard {
        head.extend(["impulse of sound (x, y, z)", "sound that went in"]);
    }
    (!rows.is_empty()).then(|| QuantityTable {
        title: "Walls".to_owned(),
        about: "At the end: forces of all grains on each wall, and their torques through the point that it turns about.".to_owned(),
        is_first: false,
        head: head.into_iter().map(str::to_owned).collect(),
        rows,
    })
}

#[cfg(test)]
mod tests {
    use agglo::run::{SoftSummary, WallQuantities};

    use super::*;

    fn folder(names: &[&str], columns: Vec<Vec<f64>>) -> Folder {
        let names = names.iter().map(|name| (*name).to_owned()).collect();
        let table = Table { names, columns, dropped: 0 };
        Folder { tables: vec![("walls".to_owned(), table)], ..Folder::default() }
    }

    /// Two walls at two times: forces of 5 N and 13 N on one, of 3 N on the other; only the second one has an opening, and none works.
    #[test]
    fn each_wall_has_a_line() {
        let names = ["time_s", "wall", "force_x_N", "force_y_N", "force_z_N", "work_J", "passed_kg"];
        let columns = vec![
            vec![0.0, 0.0, 1.0, 1.0],
            vec![0.0, 1.0, 0.0, 1.0],
            vec![3.0, 0.0, 5.0, 0.0],
            vec![0.0, 0.0, 0.0, 0.0],
            vec![4.0, 0.0, -12.0, -3.0],
            vec![0.0; 4],
            vec![f64::NAN, 0.0, f64::NAN, 0.25],
        ];
        let charts = charts(&folder(&names, columns));
        let found: Vec<&str> = charts.iter().map(|chart| chart.id.as_str()).collect();
        assert_eq!(found, ["walls-passed", "walls-force"], "what stays 0 is left out");
        let [out, force] = [0, 1].map(|at| charts[at].series());
        assert_eq!((out.len(), &out[0].name[..], &out[0].y[..]), (1, "wall 1", &[0.0, 250.0][..]));
        let lines: Vec<&[f64]> = force.iter().map(|line| &line.y[..]).collect();
        assert_eq!(lines, [&[5.0, 13.0][..], &[0.0, 3.0][..]], "in N");
        assert_empty!(super::charts(&Folder::default()));
    }

    #[test]
    fn walls_at_the_end_are_a_table() {
        let wall = |name: &str, passed| WallQuantities {
            name: name.to_owned(),
            contacts: 7,
            force: [0.0, -0.5, 2e-3],
            torque: [0.0; 3],
            work: 0.25,
            passed,
            passed_mass: passed.map(|count| 1e-3 * count as f64),
            sound_impulse: [0.0; 3],
            sound_energy: 0.0,
        };
        let mut walls = vec![wall("plate", Some(30)), wall("pipe", None)];
        let summary = Summary::Soft(Box::new(SoftSummary { walls: walls.clone(), ..SoftSummary::default() }));
        assert_eq!(table(&summary).unwrap().head.len(), 6, "nothing sounds");
        (walls[1].sound_impulse, walls[1].sound_energy) = ([1e-6, 0.0, 0.0], 2e-3);
        let summary = Summary::Soft(Box::new(SoftSummary { walls, ..SoftSummary::default() }));
        let rows = table(&summary).unwrap().rows;
        assert_eq!(rows[0][..3], ["plate", "7", "0 N, -500 mN, 2 mN"]);
        assert_eq!(
            (&rows[0][4][..], &rows[0][5][..], &rows[1][5][..]),
            ("250 mJ", "30 grains, 0.03 kg", "–")
        );
        assert_eq!(
            [&rows[0][7][..], &rows[1][6][..], &rows[1][7][..]],
            ["0 J", "1e-6 N s, 0 N s, 0 N s", "2 mJ"]
        );
        assert_none!(table(&Summary::Soft(Box::default())));
    }
}
