use super::*;

use crate::folder::RunFolder;
use crate::run::{rehearse, run};

/// The plan of grains that are placed and pushed, with a single step tried.
fn plan_of(text: &str) -> Plan {
    let one_step = Effort { budget: Duration::ZERO, ..Effort::default() };
    Plan::with(&Scenario::from_toml(text).unwrap(), Path::new(""), one_step).unwrap()
}

fn template(name: &str) -> &'static str {
    crate::scenario::template(name).unwrap().text
}

/// The sample problem, worked out by hand: 2000 grains, four pulses of 10,000 rays, 150 MPa <-> 4.7e10 W.
#[test]
fn the_sample_problem() {
    let plan = plan_of(template("acoustic-published"));
    assert_eq!((plan.grains, plan.rays_per_pulse, plan.pulses), (2000, 10_000, 4));
    // Grains scatter at 1/sqrt(2) of the speed at which they meet, and Stokes' drag takes it in 2 rho R²/(9 eta). While rays fly, as
    // long as those of the first pulse and for the way through the scattered grains, a frame every 0.5 ms, else every 50 ms. The program and
    // the report; grains in all frames; half the rays in those of flights; grains with three contacts each; rays.
    let scenario = Scenario::from_toml(template("acoustic-published")).unwrap();
    let pushes = push::all(&scenario, &crate::packing::place(&scenario, Path::new("")).unwrap());
    let viscosity = scenario.medium.viscosity.si();
    let stopping = 2.0 * 6000.0 * 0.05 * 0.05 / (9.0 * viscosity);
    let scattered =
        |time: f64| pushes[0].collision_speed / 2_f64.sqrt() * stopping * (1.0 - (-time / stopping).exp());
    let later = [0.5, 1.0, 1.5].map(|time| 2.0 * scattered(time) / 1500.0).iter().sum::<f64>();
    let flights = 4.0 * pushes[0].flight_s + later;
    let [quiet, flying] = [1.0 + (2.0 - flights) / 0.05, flights / 0.5e-3];
    let by_hand = 24e6
        + (quiet + flying) * 2000.0 * 190.0
        + flying * 0.5 * 10_000.0 * 56.0
        + 2000.0 * 1000.0
        + 10_000.0 * 120.0;
    assert!((plan.memory - by_hand).abs() < 1.0, "expected {by_hand} B, found {} B", plan.memory);
    let page = plan.to_string();
    // p = sqrt(7.06e13 W x 1.5e6 / pi m²) = 5.806 GPa.
    assert!(page.contains("5.806 GPa"), "{page}");
    for law in ["regularized", "strain_bond", "published_step", "stokes"] {
        assert!(plan.notes.iter().any(|note| note.contains(law)), "{law} in\n{page}");
    }
}

/// One grain of 10 cm in a beam of 1 m: a ray hits it with the probability 0.01, and no ray hits twice. A ray head-on gives
/// sqrt(I (1-R) rho c a) with R = (17/19)². Beyond sin i = 1/3 all is reflected, so that a ninth of the hits push, and
/// no one harder than head-on.
#[test]
fn a_single_grain_is_hit_by_the_rays_that_its_cross_section_meets() {
    let text = template("acoustic")
        .replace("count = 2000", "count = 1")
        .replace("region.sphere = { radius = \"1 m\" }", "region.sphere = { radius = \"0.1 m\" }")
        .replace("radius = \"5 cm\"", "radius = \"10 cm\"");
    let scenario = Scenario::from_toml(&text).unwrap();
    let push = &push::all(&scenario, &crate::packing::place(&scenario, Path::new("")).unwrap())[0];
    assert_close!(push.power, 4.712_389e10, 1e-6, "in W");
    // 10,000 rays: 100 hits, with a standard deviation of 10.
    assert!((push.hits - 100.0).abs() < 40.0, "{}", push.hits);
    let by_hand = (4.712_389e6_f64 * (1.0 - 289.0 / 361.0) * 2.7e7 * 3.141_593e-4).sqrt();
    let mass = 6000.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-3;
    let head_on = push.hits * by_hand * 1e-5 / mass;
    let part = push.fastest / head_on;
    assert!(part < 1.3 / 9.0 && part > 0.6 / 9.0, "{part}");
    assert_eq!((push.mean_speed, push.common_speed, push.collision_speed), (push.fastest, push.fastest, 0.0));
}

/// A grain of 1 m in a beam of 1 cm cannot be hit by more rays than there are.
#[test]
fn a_narrow_beam_hits_no_more_often_than_it_has_rays() {
    let text = template("acoustic")
        .replace("count = 2000", "count = 1")
        .replace("radius = \"5 cm\"", "radius = \"1 m\"")
        .replace("radius = \"1 m\"\nrays = 10000", "radius = \"1 cm\"\nrays = 1000");
    let scenario = Scenario::from_toml(&text).unwrap();
    let push = &push::all(&scenario, &crate::packing::place(&scenario, Path::new("")).unwrap())[0];
    assert_eq!(push.hits, 1000.0);
}

/// The speeds are those that the run's own first pulse gives. It moves the grains while it flies, by some per cent of a radius, and
/// so hits a little otherwise than among grains that stand still.
#[test]
fn speeds_after_a_pulse_are_those_of_a_run() {
    let settings = [
        "time.end=20 ms",
        "grains.0.placement.random.count=300",
        "grains.0.placement.random.region.sphere.radius=0.6 m",
        "acoustics.beams.0.radius=0.6 m",
        "acoustics.beams.0.rays=3000",
        "acoustics.beams.0.pulses.count=1",
    ];
    let scenario = Scenario::with_overrides(template("acoustic"), &settings).unwrap();
    let grains = crate::packing::place(&scenario, Path::new("")).unwrap();
    let push = &push::all(&scenario, &grains)[0];
    let mut free = scenario.clone();
    let soft = free.soft_mut().unwrap();
    (soft.contact, soft.bonds, soft.fields) = (None, None, crate::fields::Fields::default());
    soft.limits.on_breach = crate::engine::soft::Breach::Warn;
    let mut run = crate::engine::soft::Simulation::start(&free, grains).unwrap();
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "the end of the run");
    while !run.is_finished() {
        turns.take();
        run.step().unwrap();
    }
    let speeds = || run.system.grains.velocity.iter().map(|velocity| velocity.norm());
    let (mean, fastest) = (speeds().sum::<f64>() / 300.0, speeds().fold(0.0, f64::max));
    assert!((push.mean_speed / mean - 1.0).abs() < 0.03, "{} {mean}", push.mean_speed);
    assert!((push.fastest / fastest - 1.0).abs() < 0.1, "{} {fastest}", push.fastest);
    let hits = run.pulses.counts()[0].reflections as f64;
    assert!((push.hits / hits - 1.0).abs() < 0.03, "{} {hits}", push.hits);
}

/// Overlap of a Hertz impact against the energy balance m* v²/2 = (8/15) E* sqrt(R*) delta^(5/2).
#[test]
fn the_overlap_of_an_impact() {
    let scenario = Scenario::from_toml(template("acoustic")).unwrap();
    let push = &push::all(&scenario, &crate::packing::place(&scenario, Path::new("")).unwrap())[0];
    let mass = 6000.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.05_f64.powi(3);
    let overlap = push.strain.unwrap() * 0.1;
    let stored = 8.0 / 15.0 * (0.5e9 / (1.0 - 0.0625)) * 0.025_f64.sqrt() * overlap.powf(2.5);
    assert_close!(stored, 0.25 * mass * push.collision_speed.powi(2), 1e-9, "in J");
}

/// The same balance for the other laws: k δ²/2, and π R K δ^(p+2)/((p+2) (2R)^p) with p = 2 and K at 300 K.
#[test]
fn the_overlap_of_an_impact_of_other_laws() {
    let hertz = template("acoustic");
    let start = hertz.find("[contact.normal.hertz]").unwrap();
    let end = hertz[start..].find("\n[").unwrap() + start;
    let [published, hooke] = [
        template("acoustic-published").to_owned(),
        format!("{}[contact.normal.hooke]\nstiffness = \"1e7 N/m\"\n{}", &hertz[..start], &hertz[end..]),
    ];
    let mass = 6000.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.05_f64.powi(3);
    let stiffness = 0.4_f64.exp() * 1e7;
    for (text, is_published) in [(published, true), (hooke, false)] {
        let scenario = Scenario::from_toml(&text).unwrap();
        let push = &push::all(&scenario, &crate::packing::place(&scenario, Path::new("")).unwrap())[0];
        let overlap = push.strain.unwrap() * 0.1;
        let stored = if is_published {
            // (π/4) S³ K (u⁴/2 - u⁵/5) of equal spheres.
            let (sum, strain) = (0.1_f64, overlap / 0.1);
            let part = strain.powi(4) / 2.0 - strain.powi(5) / 5.0;
            0.25 * std::f64::consts::PI * sum.powi(3) * stiffness * part
        } else {
            0.5e7 * overlap * overlap
        };
        assert_close!(stored, 0.25 * mass * push.collision_speed.powi(2), 1e-9, "in J");
    }
}

#[test]
fn low_frequencies_are_noted() {
    let audible = template("microscale").replace("250 MHz", "20 kHz");
    let plan = plan_of(&audible);
    // The smallest grain that was placed counts: k a = 2 pi 2e4 Hz x R / 1500 m/s.
    let scenario = Scenario::from_toml(&audible).unwrap();
    let grains = crate::packing::place(&scenario, Path::new("")).unwrap();
    let smallest = grains.radius.iter().copied().fold(f64::INFINITY, f64::min);
    let ka = format!("k a = {}", digits(std::f64::consts::TAU * 2e4 * smallest / 1500.0));
    assert!(plan.notes.iter().any(|note| note.contains(&ka)), "{ka} in {:?}", plan.notes);
    let notes = plan_of(template("microscale")).notes;
    assert_no!(notes.iter(), |note| note.contains("do not hold"));
    assert!(notes.iter().any(|note| note.contains("a wave pushes less than rays do")), "{notes:?}");
    let silent = template("microscale").replace("frequency = \"250 MHz\"", "");
    assert_any!(plan_of(&silent).notes.iter(), |note| note.contains("no frequency"));
}

/// The plan counts the grains that are placed, cuts of a lognormal included: 0.25 (300 um)³/(21.996 um)³ = 634.
#[test]
fn the_plan_counts_what_is_placed() {
    let scenario = Scenario::from_toml(template("microscale")).unwrap();
    let placed = crate::packing::place(&scenario, Path::new("")).unwrap().len() as u64;
    let counted = Plan::with(&scenario, Path::new(""), Effort::NONE).unwrap();
    assert_eq!((counted.grains, counted.seconds, placed), (634, None, 634));
}

#[test]
fn lattices_are_counted() {
    let text = include_str!("../../tests/scenario/good/a_single_grain.toml").replace(
        "placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"]]",
        "placement.lattice = { kind = \"cubic\", spacing = \"80 um\", region.box = { lower = [\"0 m\", \"0 m\", \"0 m\"], upper = [\"0.88 mm\", \"0.88 mm\", \"0.88 mm\"] } }",
    );
    // Centers fill a cube of 0.8 mm: ten spacings along each edge. By volume, and one by one with both ends.
    let counted = Plan::with(&Scenario::from_toml(&text).unwrap(), Path::new(""), Effort::NONE).unwrap();
    assert_eq!((counted.grains, plan_of(&text).grains), (1000, 1331));
}

#[test]
fn a_beam_that_misses_is_noted() {
    let misses = |text: &str| plan_of(text).notes.iter().any(|note| note.contains("misses all grains"));
    let text = template("microscale");
    assert_false!(misses(text), "the plan notes that the rays miss all grains");
    assert_true!(
        misses(&text.replace("direction = [1.0, 0.0, 0.0]", "direction = [-1.0, 0.0, 0.0]")),
        "the plan notes that the rays miss all grains"
    );
    // Grains reach to 0.3 mm and the beam is as wide: it misses them from 0.6 mm on.
    assert_true!(
        misses(&text.replace("\"-0.33 mm\", \"0 mm\"", "\"-0.33 mm\", \"0.61 mm\"")),
        "the plan notes that the rays miss all grains"
    );
    assert_false!(
        misses(&text.replace("\"-0.33 mm\", \"0 mm\"", "\"-0.33 mm\", \"0.59 mm\"")),
        "the plan notes that the rays miss all grains"
    );
    // Grains in a box: the ball about it would reach the beam, the box does not.
    let box_of = |high: &str| {
        let region = format!(
            "region.box = {{ lower = [\"-0.3 mm\", \"-0.3 mm\", \"-0.3 mm\"], upper = [\"0.3 mm\", \"{high}\", \"0.3 mm\"] }}"
        );
        text.replace("region.sphere = { radius = \"300 um\" }", &region)
            .replace("\"-0.33 mm\", \"0 mm\"", "\"-0.33 mm\", \"0.7 mm\"")
    };
    assert_true!(misses(&box_of("0.39 mm")), "the plan notes that the rays miss all grains");
    assert_false!(misses(&box_of("0.41 mm")), "the plan notes that the rays miss all grains");
    // A single grain, named by its place: the beam passes it within a tenth of its radius.
    let one = |y: &str| {
        let grain = format!("placement.list.positions = [[\"0 m\", \"{y}\", \"0 m\"]]\n");
        let (head, rest) = text.split_once("[grains.size.lognormal]").unwrap();
        let (_, rest) = rest.split_once("[contact.normal.hertz]").unwrap();
        format!("{head}size.constant.radius = \"20 um\"\n{grain}[contact.normal.hertz]{rest}")
    };
    assert_true!(misses(&one("0.322 mm")), "the plan notes that the rays miss all grains");
    assert_false!(misses(&one("0.318 mm")), "the plan notes that the rays miss all grains");
}

#[test]
fn a_plan_says_what_has_no_effect() {
    let text = template("acoustic-published").replace("end = \"2 s\"", "end = \"0.6 s\"");
    let notes = plan_of(&text).notes;
    assert!(notes.iter().any(|note| note.contains("only 2 of 4 pulses")), "{notes:?}");
}

/// Steps, time and files of a run that is cut off early are carried on: 100 grains at rest, 2,000 steps, of which some are tried.
#[test]
fn what_is_tried_is_carried_on_to_the_end() {
    let text = include_str!("../../tests/scenario/good/a_single_grain.toml");
    let scenario = Scenario::from_toml(text).unwrap();
    let mut tried = rehearse(
        &scenario,
        crate::packing::place(&scenario, Path::new("")).unwrap().into(),
        Duration::from_secs(600),
    )
    .unwrap();
    let (steps, seconds) = (tried.quiet.all.steps, tried.start_s + tried.quiet.all.wall_s);
    assert_true!(tried.is_finished, "the run has come to its end");
    assert_above!(steps, 10.0);
    // A frame is one file, and its line in the list of all.
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("run");
    run(&scenario, Path::new(""), &out, &mut |_| ControlFlow::Continue(())).unwrap();
    let file = std::fs::metadata(out.join("frames/grains_000000.vtp")).unwrap().len() as f64;
    let weights = tried.weights.unwrap();
    assert_between!(weights.frame.unwrap(), file..=file + 200.0, "in B");
    // Two checkpoints stay, and differ by some bytes.
    let newest = RunFolder::newest_state(&out);
    let saved = std::fs::metadata(newest).unwrap().len() as f64;
    assert_between!(weights.checkpoint, 0.9 * saved..=1.6 * saved, "in B");
    let mut plan = Plan::default();
    cost::of_soft(&mut plan, &scenario, &tried, &[]);
    assert_eq!((plan.steps, plan.seconds), (Some(steps), Some(seconds)));
    // As if half of the time were left.
    tried.time *= 0.5;
    tried.is_finished = false;
    cost::of_soft(&mut plan, &scenario, &tried, &[]);
    // The pace of the last steps, which are all alike.
    let more = plan.steps.unwrap() / steps;
    assert!((more - 1.5).abs() < 0.1, "{more}");
}

#[test]
fn a_run_that_would_fail_says_so() {
    let text = template("acoustic").replace("largest_strain = 0.1", "");
    let deep = text.replace("[time]", "[limits]\nstrain = 1e-9\n\n[time]");
    let plan = Plan::new(&Scenario::from_toml(&deep).unwrap(), Path::new("")).unwrap();
    assert_eq!((plan.seconds, plan.disk), (None, None));
    assert!(plan.notes.iter().any(|note| note.contains("a run would fail at")), "{plan}");
    assert!(plan.to_string().contains("time of the run    not known"), "{plan}");
}

/// `check` refuses what `run` refuses: a table is read, not only counted.
#[test]
fn tables_are_read_as_a_run_reads_them() {
    let folder = tempfile::tempdir().unwrap();
    let text = include_str!("../../tests/scenario/good/a_single_grain.toml").replace(
        "placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"]]",
        "placement.table.file = \"grains.csv\"",
    );
    let scenario = Scenario::from_toml(&text).unwrap();
    for (table, words) in [
        ("x_m,y_m\n1,2\n", "column z_m: the column is missing"),
        ("x_m,y_m,z_m\n1,2,NaN\n", "`NaN` is not a finite number"),
        ("x_m,y_m,z_m,radius_m\n1,2,3,-1\n", "a radius must be above zero"),
        ("x_m,y_m,z_m\n1,2,3\n1,2,3\n", "same place"),
    ] {
        std::fs::write(folder.path().join("grains.csv"), table).unwrap();
        let found = Plan::new(&scenario, folder.path()).unwrap_err().to_string();
        assert!(found.contains(words), "{table}: {found}");
    }
}

/// Beams that overlap in time, that are shorter than a cycle, that arrive after the end, or that start among grains.
#[test]
fn beams_that_cannot_do_what_they_say_are_noted() {
    let text = template("microscale");
    let says = |text: &str, words: &str| plan_of(text).notes.iter().any(|note| note.contains(words));
    let overlaps = |text: &str| says(text, "pulses overlap in time");
    assert_false!(overlaps(text), "the plan notes that pulses overlap in time");
    assert_false!(
        overlaps(&text.replace("period = \"50 us\"", "period = \"50 ns\"")),
        "the plan notes that pulses overlap in time"
    );
    assert_true!(
        overlaps(&text.replace("period = \"50 us\"", "period = \"49 ns\"")),
        "the plan notes that pulses overlap in time"
    );
    // 50 ns is a cycle of 20 MHz.
    let short = |text: &str| says(text, "shorter than a cycle");
    assert_false!(short(&text.replace("250 MHz", "20 MHz")), "the plan notes a pulse shorter than a cycle");
    assert_true!(short(&text.replace("250 MHz", "19.9 MHz")), "the plan notes a pulse shorter than a cycle");
    // From -0.33 mm to the ball of 0.3 mm it is 30 um, 20 ns in water; pulses start at 0 and then every 50 us.
    let late =
        |end: &str| says(&text.replace("end = \"300 us\"", &format!("end = \"{end}\"")), "after the end");
    assert_false!(late("300 us"), "the plan notes a pulse after this end of the run");
    assert_true!(late("50.019 us"), "the plan notes a pulse after this end of the run");
    assert_false!(late("50.021 us"), "the plan notes a pulse after this end of the run");
    let among = |text: &str| says(text, "starts where grains.0 are placed");
    assert_false!(among(text), "the plan notes a beam that starts among the grains");
    assert_true!(
        among(&text.replace("\"-0.33 mm\"", "\"-0.29 mm\"")),
        "the plan notes a beam that starts among the grains"
    );
    // A grain on the disc's rim, named by its place, and a first pulse that comes later.
    let beside = |y: &str| {
        let grain = format!("placement.list.positions = [[\"-0.33 mm\", \"{y}\", \"0 m\"]]\n");
        let (head, rest) = text.split_once("[grains.size.lognormal]").unwrap();
        let (_, rest) = rest.split_once("[contact.normal.hertz]").unwrap();
        let text = format!("{head}size.constant.radius = \"20 um\"\n{grain}[contact.normal.hertz]{rest}");
        text.replace("period = \"50 us\"", "period = \"50 us\"\nfirst = \"1 us\"")
    };
    assert_false!(among(&beside("0.3201 mm")), "the plan notes a beam that starts among the grains");
    assert_true!(among(&beside("0.3199 mm")), "the plan notes a beam that starts among the grains");
}

/// Grains that take longer to come to rest than a forecast waits are tried without it, and the plan says so.
#[test]
fn rest_that_takes_long_is_left_out() {
    let scenario = Scenario::from_toml(include_str!("../../tests/scenario/good/every_choice.toml")).unwrap();
    assert_some!(scenario.soft().unwrap().relax);
    let no_patience = Effort { budget: Duration::ZERO, ..Effort::default() };
    let plan = Plan::with(&scenario, Path::new("tests/scenario/good"), no_patience).unwrap();
    assert!(plan.notes.iter().any(|note| note.contains("start.relax takes long")), "{plan}");
}

#[test]
fn counts_in_words() {
    assert_eq!([0.2, 1.0, 1640.0, 3.17e6].map(about), ["1", "1", "1600", "3.2e6"]);
}
