//! Campaigns over models whose outcome is known.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::Duration;

use super::*;
use crate::folder::FolderError;
use crate::record::RecordError;
use crate::search::optimizer::{Method, PublishedGenetic, Random};
use crate::search::test_models::Analytic;
use crate::search::{Axis, Confirm, Ensemble, Fixed, RunningMean, Scale, Until};

const TEXT: &str = "version = 1\n";

fn settling() -> Ensemble {
    let until = Until::RunningMean(RunningMean { tolerance: 0.01, least: 2, most: 12 });
    Ensemble { until, common_random_numbers: true }
}

fn genetic() -> Method {
    Method::PublishedGenetic(PublishedGenetic { generations: 4, ..PublishedGenetic::default() })
}

/// What campaigns of these tests differ in.
pub(super) struct Setup {
    pub seed: u64,
    pub ensemble: Ensemble,
    pub budget_s: Option<f64>,
    pub polishes: bool,
    /// Whether it is interrupted when all is evaluated.
    pub is_interrupted: bool,
}

impl Default for Setup {
    fn default() -> Self {
        Self { seed: 11, ensemble: settling(), budget_s: None, polishes: true, is_interrupted: false }
    }
}

fn made(dir: &Path) -> Result<CampaignFolder, FolderError> {
    let folder = CampaignFolder::create(dir)?;
    folder.put(TEXT, "")?;
    Ok(folder)
}

/// Conducts a campaign in `dir`, anew or as a resumption.
fn conducted(
    model: &Analytic,
    dir: &Path,
    (threads, method): (usize, &Method),
    observer: &mut CampaignObserver<'_>,
) -> Result<CampaignEnding, CampaignError> {
    conducted_with(model, dir, (threads, method), &Setup::default(), observer)
}

pub(super) fn conducted_with(
    model: &Analytic,
    dir: &Path,
    (threads, method): (usize, &Method),
    setup: &Setup,
    observer: &mut CampaignObserver<'_>,
) -> Result<CampaignEnding, CampaignError> {
    let folder = if dir.exists() { CampaignFolder::take(dir)? } else { made(dir)? };
    let axis = |name: &str| Axis {
        name: name.to_owned(),
        unit: "m/s".to_owned(),
        scale: Scale::Linear([-5.12, 5.12]),
    };
    let goals = 1 + usize::from(model.second.is_some());
    let polish: &Polish<'_> = &|_| Box::new(Random { points: 5 }.start(2, 12));
    let course = Course {
        title: "bowl",
        seed: setup.seed,
        is_study: false,
        part: None,
        threads,
        parameters: ["x", "y"].map(axis).to_vec(),
        objectives: vec![Goal { formula: "value".to_owned(), is_to_be_large: false }; goals],
        ensemble: setup.ensemble.clone(),
        function: None,
        is_led: false,
        optimizer: method.start(2, goals, setup.seed).unwrap(),
        planned: vec![
            (Stage::Search, method.evaluations() as u64),
            (Stage::Polish, 5),
            (Stage::Confirm, 3),
            (Stage::Final, 1),
        ],
        budget_s: setup.budget_s,
        limits: &|_| Vec::new(),
        polish: setup.polishes.then_some(polish),
        confirm: Confirm { candidates: 3, replicates: 5 },
        settings: &|candidate| candidate.values.iter().map(|value| format!("x={value}")).collect(),
        findings: &|known| vec![format!("{} candidates were tried", known.len())],
        closing: &mut |results, _| {
            let file = results.folder.root().join("closed.txt");
            fs::write(&file, format!("{:?}", results.best)).map_err(RecordError::file("write", &file))?;
            Ok(if setup.is_interrupted { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
        },
    };
    conduct(model, course, (&folder, TEXT), observer)
}

pub(super) fn whole(model: &Analytic, dir: &Path, threads: usize, method: &Method) -> CampaignSummary {
    match conducted(model, dir, (threads, method), &mut |_| ControlFlow::Continue(())).unwrap() {
        CampaignEnding::Finished(summary) => *summary,
        CampaignEnding::Interrupted => panic!("nobody asked it to stop"),
    }
}

fn noisy() -> Analytic {
    let (sigma, slowest) = (3.0, Duration::from_micros(200));
    Analytic {
        sigma,
        slowest,
        fails_below: 0.05,
        panics_above: 0.97,
        excluded_above: 0.9,
        ..Analytic::default()
    }
}

/// All files but for the wall time.
pub(super) fn results(dir: &Path) -> BTreeMap<String, String> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(dir).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        let kept: Vec<&str> = text.lines().filter(|line| !line.contains("\"wall_s\"")).collect();
        files.insert(path.file_name().unwrap().to_str().unwrap().to_owned(), kept.join("\n"));
    }
    files
}

pub(super) fn rows(dir: &Path, table: &str) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(dir.join(table)).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let header = lines.next().unwrap();
    lines.map(|line| header.iter().cloned().zip(line).collect()).collect()
}

pub(super) fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap()
}

#[test]
fn any_number_of_threads_writes_the_same_files() {
    let folder = tempfile::tempdir().unwrap();
    let dirs = [1, 2, 5].map(|threads| {
        let dir = folder.path().join(threads.to_string());
        whole(&noisy(), &dir, threads, &genetic());
        dir
    });
    let wanted = results(&dirs[0]);
    let names: Vec<&str> = wanted.keys().map(String::as_str).collect();
    let known = [
        "best.csv",
        "closed.txt",
        "evaluations.csv",
        "failures.csv",
        "generations.csv",
        "runs.csv",
        "scenario.toml",
        "search.toml",
        "summary.json",
    ];
    assert_eq!(names, known);
    for dir in &dirs[1..] {
        assert_eq!(results(dir), wanted);
    }
}

/// Stopped again and again, with the journal cut at any byte in between, as by a kill in the middle of a line.
#[test]
fn a_campaign_that_was_stopped_and_cut_ends_with_the_same_files() {
    let folder = tempfile::tempdir().unwrap();
    let (straight, dir) = (folder.path().join("straight"), folder.path().join("stopped"));
    let reference = noisy();
    whole(&reference, &straight, 2, &genetic());
    let model = noisy();
    let mut sessions = 0;
    let mut turns = agglo_testing::Turns::at_most(1_000, "the campaign to end");
    loop {
        turns.take();
        sessions += 1;
        let mut stop = |progress: &CampaignProgress| {
            if progress.replicates > 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        match conducted(&model, &dir, (2, &genetic()), &mut stop).unwrap() {
            CampaignEnding::Finished(_) => break,
            CampaignEnding::Interrupted => {
                assert_none!(finished(&dir));
                assert_gone!(dir.join("summary.json"));
                let journal = dir.join("replicates.journal");
                let bytes = fs::read(&journal).unwrap();
                // Not for ever: the last replicate would be lost again and again.
                let cut = if sessions < 6 { 3 * sessions } else { 0 };
                fs::write(&journal, &bytes[..bytes.len() - cut]).unwrap();
            }
        }
    }
    assert!(sessions > 2, "it was stopped {sessions} times");
    assert_eq!(results(&dir), results(&straight));
    assert_eq!(finished(&dir).unwrap().best, finished(&straight).unwrap().best);
    // Two replicates in each session may have been in progress, one line is cut, and decisions may come a little later.
    let (runs, wanted) = (model.runs.into_inner(), reference.runs.into_inner());
    assert!(runs <= wanted + 8 * sessions as u64, "{runs} replicates instead of {wanted}");
}

#[test]
fn tables_and_summary_tell_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("run");
    let summary = whole(&noisy(), &dir, 2, &genetic());
    let (evaluations, runs) = (rows(&dir, "evaluations.csv"), rows(&dir, "runs.csv"));
    // 20 strings, four times 14, five points of the polish, three candidates with fresh replicates, the best of them once more.
    assert_eq!((evaluations.len(), summary.evaluations), (85, 85));
    let spent: Vec<(&str, Option<u64>, u64)> =
        summary.stages.iter().map(|one| (one.stage.as_str(), one.allowed, one.candidates)).collect();
    let wanted =
        [("search", Some(76), 76), ("polish", Some(5), 5), ("confirm", Some(3), 3), ("final", Some(1), 1)];
    assert_eq!((spent.as_slice(), &summary.ended_early), (&wanted[..], &None));
    assert_eq!(summary.stages.iter().map(|one| one.runs).sum::<u64>(), summary.runs);
    assert_eq!(runs.len() as u64, summary.runs);
    for (n, evaluation) in evaluations.iter().enumerate() {
        let costs: Vec<f64> = runs
            .iter()
            .filter(|row| row["evaluation"] == n.to_string())
            .map(|row| number(row, "cost"))
            .collect();
        assert_eq!(number(evaluation, "replicates") as usize, costs.len());
        match evaluation["status"].as_str() {
            "ok" => {
                let mean = costs.iter().sum::<f64>() / costs.len() as f64;
                assert_eq!(number(evaluation, "cost"), mean);
                // The cost is the sum of both quantities; round-off of the means.
                let sum = number(evaluation, "value") + number(evaluation, "noise");
                assert_near!(sum, mean, 1e-12 * (1.0 + mean.abs()));
            }
            "failed" => {
                assert_empty!(evaluation["cost"]);
                assert_empty!(costs);
            }
            "excluded" => {
                assert_above!(number(evaluation, "violation"), 0.0);
                assert_empty!(costs);
            }
            other => panic!("{other}"),
        }
    }
    let count = |status: &str| evaluations.iter().filter(|row| row["status"] == status).count() as u64;
    assert_eq!((count("failed"), count("excluded")), (summary.failures, summary.excluded));
    assert_above!(summary.failures, 0);
    assert_above!(summary.excluded, 0);
    let failures = fs::read_to_string(dir.join("failures.csv")).unwrap();
    assert!(failures.contains("\"too low,\nfar \"\"too\"\" low\""), "{failures}");
    let generations = rows(&dir, "generations.csv");
    // Five of the search, one of the polish, one of the confirmation, one for the best of them.
    assert_eq!((generations.len() as u64, summary.generations), (8, 8));
    let last = generations.last().unwrap();
    assert_eq!((number(last, "evaluations"), number(last, "runs")), (85.0, summary.runs as f64));
}

/// Where all candidates are equally good, the lowest of many costs is low by luck: the fresh mean is not.
#[test]
fn the_best_is_told_by_replicates_that_the_search_did_not_see() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("run");
    let model = Analytic { sigma: 1000.0, ..Analytic::default() };
    let summary = whole(&model, &dir, 2, &genetic());
    let best = summary.best.unwrap();
    assert_true!(best.is_confirmed, "the best was run again on new seeds");
    assert_eq!(best.replicates, 5);
    let (evaluations, runs) = (rows(&dir, "evaluations.csv"), rows(&dir, "runs.csv"));
    let stage =
        |row: &BTreeMap<String, String>| evaluations[number(row, "evaluation") as usize]["stage"].clone();
    let seeds = |wanted: fn(&str) -> bool| -> BTreeSet<&str> {
        runs.iter().filter(|row| wanted(&stage(row))).map(|row| row["seed"].as_str()).collect()
    };
    let (seen, fresh) = (seeds(|stage| stage == "search"), seeds(|stage| stage == "confirm"));
    let last = seeds(|stage| stage == "final");
    assert_eq!((fresh.len(), last.len()), (5, 5), "common to the three candidates; of the best of them");
    assert_true!(seen.is_disjoint(&fresh), "{seen:?} and {fresh:?}");
    assert_true!(seen.is_disjoint(&last), "{seen:?} and {last:?}");
    assert_true!(fresh.is_disjoint(&last), "{fresh:?} and {last:?}");
    assert_has!(last, best.replicate_seed.to_string().as_str());
    let table = rows(&dir, "best.csv");
    assert_eq!(table.len(), 3);
    assert_all!(table.windows(2), |pair| number(&pair[0], "cost") <= number(&pair[1], "cost"));
    assert_eq!(
        ["cost", "search_cost", "final_cost"].map(|column| number(&table[0], column)),
        [best.confirm_cost.unwrap(), best.search_cost.unwrap(), best.cost]
    );
    assert_empty!(table[1]["final_cost"]);
    assert_empty!(table[1]["final_evaluation"]);
    // The error of the fresh mean from its five replicates.
    let costs: Vec<f64> = runs
        .iter()
        .filter(|row| row["evaluation"] == best.evaluation.to_string())
        .map(|row| number(row, "cost"))
        .collect();
    let mean = costs.iter().sum::<f64>() / 5.0;
    let error = (costs.iter().map(|cost| (cost - mean).powi(2)).sum::<f64>() / 20.0).sqrt();
    assert_close!(best.cost_standard_error.unwrap(), error, 1e-12);
    // About 300 replicates of which the pooled deviation is made: 4 % of scatter, five times that.
    let deviation = summary.noise.replicate_deviation.unwrap();
    assert!((deviation / 1000.0 - 1.0).abs() < 0.35, "{deviation}");
}

/// The best so far is the lowest cost of search and polish until then, the first of equals; the best in the end is the one
/// of the lowest fresh mean, which is not always the search's own best.
#[test]
fn the_best_so_far_and_the_best_of_fresh_replicates() {
    let folder = tempfile::tempdir().unwrap();
    let mut changed = 0;
    for seed in 0..8 {
        let dir = folder.path().join(seed.to_string());
        let model = Analytic { sigma: 8.0, ..noisy() };
        let ensemble = Ensemble { common_random_numbers: false, ..settling() };
        let setup = Setup { seed, ensemble, ..Setup::default() };
        let go_on = &mut |_: &CampaignProgress| ControlFlow::Continue(());
        let ended = conducted_with(&model, &dir, (2, &genetic()), &setup, go_on).unwrap();
        let CampaignEnding::Finished(summary) = ended else { panic!("nobody asked it to stop") };
        let evaluations = rows(&dir, "evaluations.csv");
        let of = |stages: &[&str], generation: f64| {
            let known = evaluations.iter().filter(|row| row["status"] == "ok");
            let known = known.filter(|row| stages.contains(&row["stage"].as_str()));
            let known = known.filter(|row| number(row, "generation") <= generation);
            known.min_by(|a, b| number(a, "cost").total_cmp(&number(b, "cost"))).unwrap()
        };
        for row in rows(&dir, "generations.csv") {
            let wanted = of(&["search", "polish"], number(&row, "generation"));
            for (column, of_best) in [
                ("best_evaluation", "evaluation"),
                ("best_cost", "cost"),
                ("best_cost_standard_error", "cost_standard_error"),
            ] {
                let (found, wanted) = (&row[column], &wanted[of_best]);
                assert_eq!(found, wanted, "{column} after generation {}, seed {seed}", row["generation"]);
            }
        }
        let (searched, fresh) = (of(&["search", "polish"], f64::INFINITY), of(&["confirm"], f64::INFINITY));
        let best = summary.best.unwrap();
        assert_eq!(best.confirm_cost, Some(number(fresh, "cost")), "cost of the chosen, seed {seed}");
        let last = evaluations.last().unwrap();
        assert_eq!((last["stage"].as_str(), best.cost), ("final", number(last, "cost")), "seed {seed}");
        for column in ["x_m_s", "y_m_s"] {
            let found =
                best.parameters.0.iter().find(|(name, _)| name == column).unwrap().1.as_f64().unwrap();
            assert_eq!(found, number(fresh, column), "{column} of the best, seed {seed}");
            assert_eq!(number(last, column), number(fresh, column), "{column} of the last, seed {seed}");
        }
        changed += u32::from(searched["x_m_s"] != fresh["x_m_s"]);
    }
    assert!(
        (2..8).contains(&changed),
        "in {changed} of 8 searches fresh replicates chose another than the search"
    );
}

#[test]
fn a_campaign_that_comes_to_nothing_is_given_up_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    let broken = || Analytic { is_broken: true, ..Analytic::default() };
    let go_on = &mut |_: &CampaignProgress| ControlFlow::Continue(());
    for (points, tried) in [(100, 32), (7, 7)] {
        let dir = folder.path().join(points.to_string());
        let method = Method::Random(Random { points });
        let error = conducted(&broken(), &dir, (2, &method), go_on).unwrap_err();
        let wanted = format!(
            "none of {tried} candidates could be evaluated: {tried} failed, 0 miss the constraints\n\
             the first one failed so: there is no scenario, \"really\""
        );
        assert_eq!((error.to_string(), error.exit_code()), (wanted, 1));
    }
    let dir = folder.path().join("excluded");
    let nowhere = Analytic { excluded_above: -1.0, ..Analytic::default() };
    let error = conducted(&nowhere, &dir, (2, &Method::Random(Random { points: 40 })), go_on).unwrap_err();
    let wanted = "none of 40 candidates could be evaluated: 0 failed, 40 miss the constraints";
    assert_eq!(error.to_string(), wanted);
    assert_eq!(nowhere.runs.load(Ordering::Relaxed), 0);
}

#[test]
fn folders_in_use_and_foreign_journals_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("run");
    whole(&Analytic::default(), &dir, 1, &Method::Random(Random { points: 3 }));
    let error = CampaignFolder::create(&dir).unwrap_err();
    assert_matches!(error, FolderError::InUse { .. });
    assert_eq!(error.exit_code(), 2);
    let error = CampaignFolder::take(folder.path()).unwrap_err();
    assert_matches!(error, FolderError::NoCampaign { .. });
    assert_eq!(error.exit_code(), 2);
    fs::write(dir.join("replicates.journal"), "agglo 0.0.1,00000000\n").unwrap();
    let go_on = &mut |_: &CampaignProgress| ControlFlow::Continue(());
    let error = conducted(&Analytic::default(), &dir, (1, &genetic()), go_on).unwrap_err();
    assert!(error.to_string().contains("its journal is of \"agglo 0.0.1,00000000\""), "{error}");
}

#[test]
fn the_observer_is_told_how_far_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let model = Analytic { slowest: Duration::from_millis(8), ..Analytic::default() };
    let mut told: Vec<CampaignProgress> = Vec::new();
    let observer = &mut |progress: &CampaignProgress| {
        told.push(progress.clone());
        ControlFlow::Continue(())
    };
    conducted(&model, &folder.path().join("run"), (2, &genetic()), observer).unwrap();
    let last = told.last().unwrap();
    assert_at_least!(told.len(), 2);
    assert_above!(last.evaluations, 0);
    assert_eq!(last.evaluations_at_most, Some(85));
    assert_some!(last.best);
    assert_at_least!(last.replicates, last.evaluations);
    assert_above!(last.replicates_per_second, 0.0);
    assert_all!(told.windows(2), |pair| pair[0].evaluations <= pair[1].evaluations);
    assert_any!(told.iter(), |progress| progress.left_s.is_some());
}

/// Sixty searches among candidates that are all equal but for noise of standard deviation 1000 (the bowl has 52 at most),
/// each replicate with its own luck. What the best is reported by is the mean of five replicates, so its mean over the searches
/// is 0 ± 1000/√300 = 58; what it was chosen by is the lowest of three such means, 0.846 · 1000/√5 = 378 too low.
#[test]
fn the_best_is_reported_without_the_luck_of_being_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let model = Analytic { sigma: 1000.0, ..Analytic::default() };
    let until = Until::Fixed(Fixed { replicates: 2 });
    let (mut told, mut chosen) = (0.0, 0.0);
    for seed in 0..60 {
        let ensemble = Ensemble { until: until.clone(), common_random_numbers: false };
        let setup = Setup { seed, ensemble, polishes: false, ..Setup::default() };
        let (dir, method) = (folder.path().join(seed.to_string()), Method::Random(Random { points: 6 }));
        let go_on = &mut |_: &CampaignProgress| ControlFlow::Continue(());
        let ended = conducted_with(&model, &dir, (2, &method), &setup, go_on).unwrap();
        let CampaignEnding::Finished(summary) = ended else { panic!("nobody asked it to stop") };
        let best = summary.best.unwrap();
        told += best.cost / 60.0;
        chosen += best.confirm_cost.unwrap() / 60.0;
    }
    // Four standard deviations, and the bowl itself.
    assert!(told.abs() < 4.0 * 58.0 + 52.0, "{told}");
    assert!((-378.0 - chosen).abs() < 4.0 * 58.0 + 52.0 && chosen < -100.0, "{chosen}");
}
