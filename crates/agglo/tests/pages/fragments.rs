//! The part of a file that each page shows: with the rest of a file around it, it is read without a fault.

use agglo::pages::{Fragment, Page, Scope, all, keys};
use agglo::scenario::Scenario;
use agglo::search::Campaign;
use toml::{Table, Value};

const GRAINS: &str = r#"
version = 1
time.end = "1 ms"
[materials.grain]
density = "2500 kg/m3"
[[grains]]
material = "grain"
size.constant.radius = "1 mm"
placement.list.positions = [["0 m", "0 m", "0 m"], ["0 m", "0 m", "1 cm"]]
"#;

/// What makes them soft.
const SOFT: &str = r#"
[engine.verlet]
[contact.normal.hooke]
stiffness = "10 kN/m"
"#;

/// What sound needs besides.
const ACOUSTICS: &str = r#"
[materials.grain]
sound_speed = "5600 m/s"
[acoustics.force.impulse]
duration = "1 us"
[[acoustics.beams]]
start = ["-1 cm", "0 m", "0 m"]
direction = [1.0, 0.0, 0.0]
radius = "5 mm"
rays = 10
strength.power = "1 W"
"#;

/// What makes them hard.
const HARD: &str = r#"
[engine.event_driven]
[volume]
lower = ["-1 m", "-1 m", "-1 m"]
upper = ["1 m", "1 m", "1 m"]
[impact.restitution.constant]
restitution = 0.9
"#;

const CAMPAIGN: &str = r#"
version = 1
base.template = "reacting"
[[parameters]]
name = "end"
key = "time.end"
range.linear = { lower = "1 us", upper = "2 us" }
[[objectives]]
minimize = "growth_deficit"
"#;

fn tree(text: &str) -> Table {
    text.parse().unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Puts a part of a file into a whole one: what a material has is added, other tables take the place of those of the file.
fn place(whole: &mut Table, part: Table) {
    for (top, value) in part {
        match (whole.get_mut(&top), value) {
            (Some(Value::Table(there)), Value::Table(more)) if top == "materials" => {
                for (name, keys) in more {
                    let material = there.entry(name).or_insert_with(|| Value::Table(Table::new()));
                    material.as_table_mut().unwrap().extend(keys.as_table().unwrap().clone());
                }
            }
            // Of these two there is one in a file.
            (Some(Value::Table(there)), Value::Table(more)) if top != "engine" && top != "bonds" => {
                there.extend(more);
            }
            (_, value) => drop(whole.insert(top, value)),
        }
    }
}

fn whole_scenario(page: &Page, part: &str) -> String {
    let mut whole = tree(GRAINS);
    place(&mut whole, tree(if page.scope() == Scope::Hard { HARD } else { SOFT }));
    if page.group.starts_with("acoustics") {
        place(&mut whole, tree(ACOUSTICS));
    }
    place(&mut whole, tree(part));
    whole.to_string()
}

fn whole_campaign(part: &str) -> String {
    let (mut whole, part) = (tree(CAMPAIGN), tree(part));
    if !part.contains_key("plan") {
        place(&mut whole, tree("method.random.points = 4"));
    }
    for (top, value) in part {
        whole.insert(top, value);
    }
    whole.to_string()
}

#[test]
fn what_a_page_shows_of_a_file_can_be_run() {
    let mut wrong = Vec::new();
    for page in all() {
        let faults = match page.fragment().unwrap_or_else(|| panic!("{} shows no part of a file", page.name))
        {
            Fragment::Scenario(part) => Scenario::from_toml(&whole_scenario(page, &part)).err(),
            Fragment::Campaign(part) => Campaign::from_toml(&whole_campaign(&part)).err(),
        };
        wrong.extend(faults.map(|faults| format!("{}:\n{faults}", page.name)));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn a_part_of_a_file_with_a_fault_is_noticed() {
    let hertz = all().find(|page| page.name == "hertz").unwrap();
    assert_contains!(
        Scenario::from_toml(&whole_scenario(hertz, "[contact.normal.hertz]")).unwrap_err().to_string(),
        "youngs_modulus"
    );
    assert!(Campaign::from_toml(&whole_campaign("[plan.morris]\nlevel = 3")).is_err(), "a misspelt key");
}

fn paths(word: &str) -> Vec<&'static str> {
    let page = all().find(|page| page.has(word)).unwrap();
    keys(page).iter().map(|key| key.path.as_str()).collect()
}

#[test]
fn keys_of_a_page_are_those_of_its_tables_and_its_example() {
    assert_eq!(
        paths("hertz"),
        ["contact.normal.hertz", "materials.NAME.poisson_ratio", "materials.NAME.youngs_modulus"]
    );
    let beam = paths("beam");
    assert_eq!(beam.len(), 8, "{beam:?}");
    assert!(beam.iter().all(|path| path.starts_with("bonds.beam.")), "{beam:?}");
    for (law, key) in
        [("impulse", "duration"), ("published_step", "step_fraction"), ("radiation_pressure", "duration")]
    {
        assert_eq!(paths(law), [format!("acoustics.force.{law}.{key}")]);
    }
    assert_eq!(paths("sticking"), ["impact.sticking"]);
    assert_has!(paths("hardness"), &"impact.restitution.hardness.solver.fixed_point.tolerance");
    assert_has!(paths("hardness"), &"materials.NAME.hardness");
    // `constant` is also a size of grains.
    assert_eq!(paths("constant"), ["impact.restitution.constant.restitution"]);
    assert_eq!(paths("grid"), ["plan.grid.levels"]);
    assert_has!(paths("polish"), &"polish.evaluations");
}
