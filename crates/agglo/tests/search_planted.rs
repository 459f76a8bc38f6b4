//! Searches that must find again what was put in: parameters that are known, from what runs with them came to.

#![allow(clippy::unwrap_used, reason = "a test that cannot run has failed")]

use std::fs;
use std::ops::ControlFlow;

use agglo::search::campaign::{self, CampaignEnding, CampaignSummary, Means};
use agglo::search::{Campaign, Model, Problem};

/// What the campaign `text` over the scenario `base` comes to, on two threads.
fn searched(base: &str, text: &str) -> CampaignSummary {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("base.toml"), base).unwrap();
    let file = folder.path().join("search.toml");
    fs::write(&file, text).unwrap();
    let campaign = Campaign::load(&file).unwrap_or_else(|error| panic!("{error}"));
    let dir = folder.path().join("out");
    let go_on = &mut |_: &campaign::CampaignProgress| ControlFlow::Continue(());
    match campaign::run(&campaign, folder.path(), &dir, Means::threads(2), go_on).unwrap() {
        CampaignEnding::Finished(summary) => *summary,
        CampaignEnding::Interrupted => panic!("nobody asked it to stop"),
    }
}

fn found(summary: &CampaignSummary) -> Vec<f64> {
    let best = summary.best.as_ref().unwrap();
    best.parameters.0.iter().filter_map(|(_, value)| value.as_f64()).collect()
}

const PAIR: &str = r#"
version = 1
time.end = "4 ms"
[engine.verlet]
safety = 0.05
[materials.glass]
density = "2500 kg/m3"
youngs_modulus = "10 MPa"
poisson_ratio = 0.2
[[grains]]
material = "glass"
size.constant.radius = "1 mm"
placement.list.positions = [["-1.1 mm", "0 m", "0 m"]]
[[grains]]
material = "glass"
size.constant.radius = "1 mm"
placement.list.positions = [["1.1 mm", "0 m", "0 m"]]
[contact.normal.hertz]
[contact.damping.restitution]
restitution = 0.9
"#;

/// Soft spheres, without noise: two grains of mass m that meet head-on at ±v keep e² m v² of their motion and lose the
/// rest. Planted are e = 0.6 and v = 0.3 m/s. The step is a twentieth of its limit, so that the integrated impact keeps
/// e to better than a thousandth; half a hundredth is allowed.
#[test]
fn restitution_and_speed_of_a_pair_are_found_again() {
    let mass = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-9;
    let (restitution, speed) = (0.6_f64, 0.3_f64);
    let kept = mass * speed * speed * restitution * restitution;
    let lost = mass * speed * speed - kept;
    let text = format!(
        r#"
        version = 1
        seed = 3
        base.file = "base.toml"
        [[objectives]]
        minimize = "(energy.kinetic_J/{kept:e} - 1)^2 + (energy.lost_contact_damping_J/{lost:e} - 1)^2"
        [[parameters]]
        name = "restitution"
        key = "contact.damping.restitution.restitution"
        range.linear = {{ lower = 0.2, upper = 0.95 }}
        [[parameters]]
        name = "v"
        key = "grains.0.velocity.0"
        range.log = {{ lower = "0.1 m/s", upper = "1 m/s" }}
        [[derived]]
        key = "grains.1.velocity.0"
        formula = "-v"
        [method.cma_es]
        evaluations = 250
        [confirm]
        candidates = 0
        "#
    );
    let found = found(&searched(PAIR, &text));
    assert!(
        (found[0] / restitution - 1.0).abs() < 5e-3 && (found[1] / speed - 1.0).abs() < 5e-3,
        "{found:?}"
    );
}

const GAS: &str = r#"
version = 1
time.end = "20 ms"
[engine.event_driven]
[volume]
lower = ["-1 cm", "-1 cm", "-1 cm"]
upper = ["1 cm", "1 cm", "1 cm"]
[materials.glass]
density = "2500 kg/m3"
[[grains]]
material = "glass"
size.constant.radius = "0.5 mm"
placement.fill.count = 500
velocity_spread.maxwell = { deviation = "1 m/s", centered = true }
[impact]
restitution.constant.restitution = 0.9
sticking = "never"
"#;

/// Hard spheres, with noise: a gas that cools by its impacts. Planted are e = 0.8 and a spread of 1.3 m/s; what they come
/// to is the mean over 16 random replicates, and the search has twelve others a candidate. The granular temperature at the
/// end scatters by about a hundredth from replicate to replicate and follows e twice as steeply as that, so 3 % is allowed.
#[test]
fn restitution_and_spread_of_a_gas_are_found_again() {
    let planted = [0.8, 1.3];
    let text = |objective: &str| {
        format!(
            r#"
            version = 1
            seed = 5
            base.file = "base.toml"
            columns = ["granular_temperature_m2_s2", "impacts"]
            [[objectives]]
            minimize = "{objective}"
            [[parameters]]
            name = "restitution"
            key = "impact.restitution.constant.restitution"
            range.linear = {{ lower = 0.5, upper = 0.98 }}
            [[parameters]]
            name = "spread"
            key = "grains.0.velocity_spread.maxwell.deviation"
            range.linear = {{ lower = "0.5 m/s", upper = "2 m/s" }}
            [ensemble.until.fixed]
            replicates = 12
            [method.cma_es]
            evaluations = 200
            [confirm]
            candidates = 0
            "#
        )
    };
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("base.toml"), GAS).unwrap();
    let file = folder.path().join("search.toml");
    fs::write(&file, text("impacts")).unwrap();
    let problem = Problem::new(&Campaign::load(&file).unwrap(), folder.path()).unwrap();
    let point = [(planted[0] - 0.5) / 0.48, (planted[1] - 0.5) / 1.5];
    let truth = problem.prepare(&problem.candidate(&point)).unwrap();
    let columns = |name: &str| problem.columns().iter().position(|column| column == name).unwrap();
    let (temperature, impacts) = (columns("granular_temperature_m2_s2"), columns("impacts"));
    let mut sums = [0.0; 2];
    for seed in 1..=16 {
        let quantities = problem.run(&truth, seed, &false.into()).unwrap();
        sums[0] += quantities[temperature] / 16.0;
        sums[1] += quantities[impacts] / 16.0;
    }
    let [temperature, impacts] = sums;
    let objective =
        format!("(granular_temperature_m2_s2/{temperature:e} - 1)^2 + (impacts/{impacts:e} - 1)^2");
    let found = found(&searched(GAS, &text(&objective)));
    for (found, planted) in found.iter().zip(planted) {
        assert!((found / planted - 1.0).abs() < 0.03, "{found} {planted}");
    }
}
