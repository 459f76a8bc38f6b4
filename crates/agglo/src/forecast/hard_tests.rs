//! Plans of hard spheres against numbers worked out by hand.

use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use super::gas::Gas;
use super::hard::means;
use super::mean_field::MeanField;
use super::{Effort, Plan};
use crate::packing::place_groups;
use crate::run::{Ending, Summary, quiet};
use crate::scenario::Scenario;

const SET_1: &str = include_str!("../../scenarios/reacting-agglomeration.toml");
const SET_2: &str = include_str!("../../scenarios/reacting-set-2.toml");
const SET_3: &str = include_str!("../../scenarios/reacting-set-3.toml");
const SET_4: &str = include_str!("../../scenarios/reacting-set-4.toml");
const SET_5: &str = include_str!("../../scenarios/reacting-set-5.toml");
const SET_6: &str = include_str!("../../scenarios/reacting-set-6.toml");
const PUBLISHED: &str = include_str!("../../scenarios/reacting-agglomeration-published.toml");

/// 1000 grains of radius 1 mm in a box of 10 cm, so that φ = 4.18879e-3; velocities as asked for.
fn gas_of(velocities: &str, restitution: &str) -> String {
    format!(
        r#"
version = 1
time.end = "10 s"
[engine.event_driven]
[volume]
lower = ["0 m", "0 m", "0 m"]
upper = ["10 cm", "10 cm", "10 cm"]
[materials.glass]
density = "2500 kg/m3"
[[grains]]
material = "glass"
size.constant.radius = "1 mm"
placement.fill.count = 1000
{velocities}
[impact.restitution.constant]
restitution = {restitution}
"#
    )
}

const MAXWELL: &str = "velocity_spread.maxwell.deviation = \"0.2 m/s\"";

/// The plan without a try of the first steps: what means alone say.
fn means_of(text: &str) -> Plan {
    Plan::with(&Scenario::from_toml(text).unwrap(), Path::new(""), Effort::NONE).unwrap()
}

fn plan_of(text: &str) -> Plan {
    Plan::new(&Scenario::from_toml(text).unwrap(), Path::new("")).unwrap()
}

fn start_of(text: &str, grains: u64) -> Gas {
    Gas::at_start(&Scenario::from_toml(text).unwrap(), &[grains], None).unwrap()
}

/// Enskog: 4 sqrt(pi) n σ² χ s with n = 1e6/m³, σ = 2 mm, s = 0.2 m/s and
/// χ = (1 - 0.00209440)/(1 - 0.00418879)³ = 1.01055145.
#[test]
fn a_gas_in_equilibrium() {
    let gas = start_of(&gas_of(MAXWELL, "1"), 1000);
    let chi = 1.010_551_45;
    let rate = 4.0 * std::f64::consts::PI.sqrt() * 1e6 * 4e-6 * chi * 0.2;
    // χ is written with nine digits.
    assert!((gas.free_time * rate - 1.0).abs() < 1e-7, "{}", gas.free_time);
    assert_close!(gas.rate, 500.0 * rate, 1e-7);
    // 1/(sqrt 2 pi n σ² χ)
    let path = 1.0 / (2.0_f64.sqrt() * std::f64::consts::PI * 4.0 * chi);
    assert_close!(gas.free_path, path, 1e-7);
    assert_near!(gas.solid_fraction, 4.188_790_2e-3, 1e-9);
    // Elastic: 500 x rate x 10 s.
    assert_close!(means_of(&gas_of(MAXWELL, "1")).impacts, 5000.0 * rate, 1e-7);
}

/// Haff: t_H = 6 t_free/(1 - e²), and ∫ rate dt = rate t_H ln(1 + t/t_H).
#[test]
fn a_gas_that_cools() {
    let gas = start_of(&gas_of(MAXWELL, "0.8"), 1000);
    let haff = 6.0 * gas.free_time / 0.36;
    let by_hand = gas.rate * haff * (1.0 + 10.0 / haff).ln();
    // The midpoint rule in steps of 5 % errs by their square over 24, 1e-4.
    assert_close!(means_of(&gas_of(MAXWELL, "0.8")).impacts, by_hand, 3e-4);
}

/// Where all stick, an impact takes 2 m s² of the energy 3 n m s²/2 with it, so that s² goes with n^(4/3), the rate with n (n - 1),
/// and (n - 1)/n falls exponentially.
#[test]
fn grains_that_all_stick() {
    let gas = start_of(&gas_of(MAXWELL, "0"), 1000);
    for end in [1.0, 10.0, 1000.0] {
        let text = gas_of(MAXWELL, "0").replace("time.end = \"10 s\"", &format!("time.end = \"{end} s\""));
        let left = 0.999 * (-gas.rate * end / 999_000.0).exp();
        let wanted = 1000.0 - 1.0 / (1.0 - left);
        // Number and rate change by 5 % and 10 % in a step: the square of that over 24, a few times.
        let found = means_of(&text).impacts;
        assert!((found / wanted - 1.0).abs() < 2e-3, "{found} and not {wanted} in {end} s");
    }
}

/// Two streams through one another: |u| = 3 m/s between them and none within.
#[test]
fn two_streams() {
    let text = gas_of("velocity = [\"3 m/s\", \"0 m/s\", \"0 m/s\"]", "1").replace(
        "[impact.restitution.constant]",
        "[[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"1 mm\"\nplacement.fill.count = 1000\n[impact.restitution.constant]",
    );
    let gas = Gas::at_start(&Scenario::from_toml(&text).unwrap(), &[1000, 1000], None).unwrap();
    let chi = (1.0 - 4.188_790_2e-3) / (1.0_f64 - 8.377_580_4e-3).powi(3);
    // Each grain meets the other stream: n σ² pi u χ = 1e6 x 4e-6 x pi x 3 x χ.
    assert_near!(gas.free_time * 12.0 * std::f64::consts::PI * chi, 1.0, 1e-9);
}

/// Two sizes at two temperatures: grain a meets n_b π (R_a + R_b)² χ √(8 (s_a² + s_b²)/π) of kind b a second, each pair seen from
/// both sides; 600 grains of 1 mm at 0.2 m/s and 150 of 3 mm at 0.1 m/s in a liter.
#[test]
fn two_sizes() {
    let text = gas_of(MAXWELL, "1").replace("fill.count = 1000", "fill.count = 600").replace(
        "[impact.restitution.constant]",
        "[[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"3 mm\"\nplacement.fill.count = 150\n\
         velocity_spread.maxwell.deviation = \"0.1 m/s\"\n[impact.restitution.constant]",
    );
    let gas = Gas::at_start(&Scenario::from_toml(&text).unwrap(), &[600, 150], None).unwrap();
    let kinds = [(600.0, 1e-3, 0.2), (150.0, 3e-3, 0.1_f64)];
    let phi: f64 =
        kinds.iter().map(|(n, r, _)| n * 4.0 / 3.0 * std::f64::consts::PI * r * r * r / 1e-3).sum();
    let chi = (1.0 - 0.5 * phi) / (1.0 - phi).powi(3);
    let mut met = 0.0;
    for (n, r, s) in kinds {
        for (m, q, t) in kinds {
            let section = std::f64::consts::PI * (r + q) * (r + q);
            met += n * m / 1e-3 * section * chi * (8.0 * (s * s + t * t) / std::f64::consts::PI).sqrt();
        }
    }
    assert_close!(gas.solid_fraction, phi, 1e-12);
    assert_close!(gas.rate, 0.5 * met, 1e-12, "in 1/s");
    assert_close!(gas.free_time, 750.0 / met, 1e-12, "in s");
}

/// At rest there are no impacts, and nothing is divided by them.
#[test]
fn a_gas_at_rest() {
    let plan = plan_of(&gas_of("", "0.5"));
    assert_eq!((plan.impacts, plan.grains), (0.0, 1000));
    assert!(!plan.to_string().contains("impact"), "{plan}");
}

/// So hard when cold that no number says how hard.
#[test]
fn a_quantity_that_is_no_number_is_not_known() {
    let scenario = Scenario::with_overrides(SET_1, &["materials.grain.activation_energy=1e18 J/mol"]);
    let page = plan_of(&scenario.unwrap().to_toml().unwrap()).to_string();
    let quantity = page.lines().find(|line| line.starts_with("  grains 0")).unwrap();
    assert!(quantity.ends_with("  not known") && !page.contains("inf"), "{page}");
}

/// Set 1: H = 0.26548 MPa x exp(352.41/(8.314463 x 502.18)) = 1.08807 x 0.26548 MPa, so that
/// 2 sqrt(1.5 H/6652.7) = 16.14 m/s; surfaces cost 8.4e15 J/m².
#[test]
fn the_papers_best_set() {
    let plan = plan_of(SET_1);
    let page = plan.to_string();
    assert!(page.contains("stick from an approach of 16.14 m/s\n") && page.contains("breakage"), "{page}");
    // (4/3) pi 0.79041³/8; 1/(sqrt 2 pi n σ² χ) with n = 1.25e8/m³, σ = 1.58082 mm, χ = 2.13622.
    assert!(page.contains("0.2586") && page.contains("337.3 um"), "{page}");
    // 1000 grains of radius b L-wise: n pi σ² χ sqrt(16 x 1.02/(9 pi)) v0 = 2.94153e5/s, two to an impact.
    let rate = start_of(SET_1, 1000).rate;
    assert!((rate / 1.470_764e8 - 1.0).abs() < 1e-5, "{rate}");
    // 24 MB of the program and its report, 400 B for each grain, and 41 frames of them in the report.
    assert!((plan.memory - (24.4e6 + 41.0 * 1000.0 * 190.0)).abs() < 1.0, "{}", plan.memory);
    assert!(plan.notes.is_empty(), "{:?}", plan.notes);
}

/// What runs of the shipped scenarios come to (seed 1): impacts, grains at the end.
#[test]
fn forecasts_are_near_what_runs_give() {
    let runs = [
        (SET_1, 1852.0, 50.0),
        (SET_2, 1804.0, 47.0),
        (SET_3, 2016.0, 56.0),
        (SET_4, 1843.0, 56.0),
        (SET_5, 1409.0, 34.0),
        (SET_6, 4025.0, 235.0),
    ];
    for (text, impacts, grains) in runs {
        let scenario = Scenario::from_toml(text).unwrap();
        let gas = Gas::at_start(&scenario, &[1000], None).unwrap();
        let found = MeanField::new(&scenario, &gas, 1000.0).unwrap().run(0.01, &|_| f64::INFINITY).unwrap();
        // One start scatters by some per cent; a mean field leaves the scatter of sizes out.
        assert!((found.impacts / impacts - 1.0).abs() < 0.25, "{found:?}");
        assert!((found.grains / grains - 1.0).abs() < 0.4, "{found:?}");
    }
}

#[test]
fn the_published_model_is_told_from_the_consistent_one() {
    let plan = plan_of(PUBLISHED);
    for word in [
        "nearest",
        "centers",
        "antipodal",
        "compression",
        "fixed_point",
        "tangential.limit",
        "heat.balance",
        "fragmentation.energy",
        "cooling.integration",
    ] {
        assert!(plan.notes.iter().any(|note| note.contains(word)), "{word} in\n{plan}");
    }
}

/// Steps of the means over a time, without a run.
fn steps_of(text: &str) -> f64 {
    let scenario = Scenario::from_toml(text).unwrap();
    means(&scenario, &start_of(text, 1000), 1000.0, scenario.time.end.si()).unwrap().steps
}

/// The published run takes 40 steps: first of half of σ over twice the mean relative speed, 1.58082 mm/(4 x 140.27 m/s) =
/// 2.817 us, then longer and longer. Over gaps the step is shorter than the shortest allowed here.
#[test]
fn steps_stay_within_their_bounds() {
    assert_between!(steps_of(PUBLISHED), 13.0..120.0);
    let over_gaps = PUBLISHED.replace("distance = \"centers\"", "distance = \"gap\"");
    let steps = steps_of(&over_gaps);
    let shortest = over_gaps.replace("longest_step = \"1 ms\"", "longest_step = \"10 ns\"");
    // Ten nanoseconds at the least and at the most.
    assert_near!(steps_of(&shortest), 1e6, 1e-3);
    assert!(steps < 1e6 && steps > 1000.0, "{steps}");
}

/// A run of set 1 step by step takes 9366 steps: gaps are halved until the shortest step is left.
#[test]
fn steps_over_gaps_halve_the_way_to_each_impact() {
    let steps = steps_of(&SET_1.replace("engine.event_driven", "engine.time_stepped"));
    assert!((4700.0..18_800.0).contains(&steps), "{steps}");
}

/// What is tried to the end is what the run comes to: 1852 impacts, of 1000 grains 50 left.
#[test]
fn a_short_run_is_known_by_running_it() {
    let scenario = Scenario::from_toml(SET_1).unwrap();
    let generous = Effort { budget: Duration::from_secs(600), ..Effort::default() };
    let plan = Plan::with(&scenario, Path::new(""), generous).unwrap();
    let stop = AtomicBool::new(false);
    let Ending::Finished(Summary::Hard(run)) = quiet(&scenario, Path::new(""), &stop).unwrap() else {
        panic!()
    };
    assert_eq!((plan.impacts, plan.steps), (run.counts.impacts as f64, Some(run.run.steps as f64)));
    assert_some!(plan.disk);
    assert_some!(plan.seconds);
}

/// Grains of a table are those of its columns, not the group's: 2 mm and 3 m/s instead of 1 mm and rest.
#[test]
fn a_gas_from_a_table_is_that_of_its_columns() {
    let folder = tempfile::tempdir().unwrap();
    let row = |at: u32| {
        let speed = if at.is_multiple_of(2) { 3 } else { -3 };
        format!("{},0.05,0.05,2e-3,{speed},0,0\n", 0.005 + 0.01 * f64::from(at))
    };
    let table: String = std::iter::once("x_m,y_m,z_m,radius_m,vx_m_s,vy_m_s,vz_m_s\n".to_owned())
        .chain((0..10).map(row))
        .collect();
    std::fs::write(folder.path().join("grains.csv"), table).unwrap();
    let text =
        gas_of("", "1").replace("placement.fill.count = 1000", "placement.table.file = \"grains.csv\"");
    let scenario = Scenario::from_toml(&text).unwrap();
    let (grains, counts) = place_groups(&scenario, folder.path()).unwrap();
    let gas = Gas::at_start(&scenario, &counts, Some(&grains)).unwrap();
    assert_close!(gas.solid_fraction, 10.0 * 4.0 / 3.0 * std::f64::consts::PI * 8e-9 / 1e-3, 1e-12);
    // One kind with a variance of 9 m²/s²: sqrt(8/(3π) 18).
    assert_close!(gas.relative_speed, (48.0 / std::f64::consts::PI).sqrt(), 1e-12, "in m/s");
}

#[test]
fn keys_without_effect_are_noted() {
    let text = gas_of(
        "angular_velocity = [\"1 Hz\", \"0 Hz\", \"0 Hz\"]\ncharge = \"1 pC\"\npolarity = -1",
        "1\n[impact.tangential]\nfriction = 0\n[impact.cooling]\n[medium]\ndensity = \"1 kg/m3\"\n[measures]\ncluster_gap = 0.1",
    )
    .replace("density = \"2500 kg/m3\"", "density = \"2500 kg/m3\"\nheat_capacity = \"1 J/(kg K)\"");
    let notes = plan_of(&text).notes;
    for word in [
        "angular_velocity",
        "charge",
        "polarity",
        "impact.tangential",
        "impact.cooling",
        "medium",
        "cluster_gap",
    ] {
        assert!(
            notes.iter().any(|note| note.contains(word) && note.contains("no effect")),
            "{word} in {notes:?}"
        );
    }
}

/// With the printed limit of friction and a coefficient of 3e5 an impact makes energy out of nothing, until means are no numbers.
/// The forecast says that it does not know, and does not wait for the end of a time that never comes.
#[test]
fn what_is_beyond_numbers_is_not_known() {
    let text = PUBLISHED;
    for settings in
        [vec!["impact.tangential.friction=3e5"], vec!["impact.tangential.friction=1e30", "time.end=1000 s"]]
    {
        let scenario = Scenario::with_overrides(text, &settings).unwrap();
        let effort = Effort { budget: Duration::from_millis(50), ..Effort::default() };
        let plan = Plan::with(&scenario, Path::new(""), effort).unwrap();
        let page = plan.to_string();
        for word in ["NaN", "inf"] {
            assert!(!page.split(|c: char| !c.is_alphanumeric()).any(|found| found == word), "{page}");
        }
        assert!(page.contains("not known"), "{page}");
    }
}
