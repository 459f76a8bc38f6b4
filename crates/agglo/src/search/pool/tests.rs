//! Workers: the same outcome for any number of them, and nothing lost.

use std::sync::atomic::AtomicUsize;
use std::time::Instant;

use super::*;
use crate::search::test_models::Analytic;
use crate::search::{RunningMean, Until};

fn settling() -> Ensemble {
    let until = Until::RunningMean(RunningMean { tolerance: 0.01, least: 2, most: 20 });
    Ensemble { until, common_random_numbers: false }
}

fn tasks(model: &Analytic, count: u64) -> Vec<Task> {
    let point = |k: u64| [(k as f64 + 0.5) / count as f64, 0.3];
    let task = |k| Task { evaluation: k, candidate: model.candidate(&point(k)), known: Vec::new() };
    (0..count).map(task).collect()
}

fn seeds(ensemble: &Ensemble) -> Seeds {
    let ensemble = ensemble.clone();
    Arc::new(move |evaluation, replicate| ensemble.seed(3, evaluation, replicate))
}

/// Evaluates in batches on so many workers.
fn evaluate(model: &Analytic, ensemble: &Ensemble, workers: usize, batches: usize) -> Vec<Vec<Outcome>> {
    let noted = AtomicUsize::new(0);
    let notebook = |_: &Finished<'_>| {
        noted.fetch_add(1, Ordering::Relaxed);
        Ok(())
    };
    let pool = Pool::new(model, &notebook);
    let outcomes = std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| pool.work());
        }
        let mut all = Vec::new();
        for _ in 0..batches {
            let go_on = |_: &Pool<'_, Analytic>| ControlFlow::Continue(());
            all.extend(pool.evaluate(tasks(model, 24), ensemble, &seeds(ensemble), go_on).unwrap());
        }
        pool.close();
        all
    });
    assert_eq!(
        noted.load(Ordering::Relaxed) as u64,
        pool.replicates(),
        "each replicate that ended was told of"
    );
    outcomes
}

#[test]
fn any_number_of_workers_comes_to_the_same() {
    let slowest = Duration::from_micros(300);
    let model =
        || Analytic { sigma: 5.0, slowest, fails_below: 0.1, panics_above: 0.9, ..Analytic::default() };
    let alone = evaluate(&model(), &settling(), 1, 2);
    assert_eq!(alone[..24], alone[24..]);
    assert_above!(alone.iter().map(Vec::len).max(), Some(2));
    for workers in [2, 5] {
        assert_eq!(evaluate(&model(), &settling(), workers, 2), alone, "{workers} workers");
    }
}

#[test]
fn failures_and_errors_of_the_program_are_told_and_cost_one_candidate_each() {
    let model = Analytic { fails_below: 0.1, panics_above: 0.9, ..Analytic::default() };
    let outcomes = evaluate(&model, &settling(), 2, 1);
    let failed = |outcomes: &[Outcome]| match outcomes {
        [Outcome::Failed(reason)] => Some(reason.clone()),
        _ => None,
    };
    // 24 points at (k + 1/2)/24: two of them below 0.1, two above 0.9.
    let reasons: Vec<_> = outcomes.iter().map(|outcomes| failed(outcomes)).collect();
    assert_all!(reasons[2..22].iter(), Option::is_none);
    assert_eq!(reasons[0].as_deref(), Some("too low,\nfar \"too\" low"));
    assert_eq!(reasons[23].as_deref(), Some("the program made an error: first is 0.9791666666666666"));
    assert_some!(reasons[1]);
    assert_some!(reasons[22]);
}

#[test]
fn costs_that_are_not_numbers_are_failures() {
    let model = Analytic { sigma: f64::NAN, ..Analytic::default() };
    let outcomes = evaluate(&model, &Ensemble::fixed(3), 2, 1);
    assert_all!(outcomes.iter(), |replicates| replicates[..]
        == [Outcome::Failed("its cost is NaN".to_owned())]);
}

#[test]
fn candidates_that_cannot_be_prepared_say_why() {
    let outcomes = evaluate(&Analytic { is_broken: true, ..Analytic::default() }, &Ensemble::fixed(3), 2, 1);
    let wanted = [Outcome::Failed("there is no scenario, \"really\"".to_owned())];
    assert_all!(outcomes.iter(), |replicates| replicates[..] == wanted);
}

/// Two workers and replicates of up to 2 ms: without look-ahead one would wait while the other settles a lone candidate.
#[test]
fn idle_workers_run_ahead() {
    let slowest = Duration::from_millis(2);
    let model = Analytic { sigma: 50.0, slowest, ..Analytic::default() };
    let notebook = |_: &Finished<'_>| Ok(());
    let pool = Pool::new(&model, &notebook);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| pool.work());
        }
        let go_on = |_: &Pool<'_, Analytic>| ControlFlow::Continue(());
        let one = tasks(&model, 1);
        let until = Until::RunningMean(RunningMean { tolerance: 0.0, least: 2, most: 400 });
        let ensemble = Ensemble { until, common_random_numbers: true };
        let begun = Instant::now();
        let outcomes = pool.evaluate(one, &ensemble, &seeds(&ensemble), go_on).unwrap();
        // 400 replicates of 1 ms in the mean: 400 ms on one worker, 100 ms on four, which only sleep.
        assert!(begun.elapsed() < Duration::from_millis(300), "{:?}", begun.elapsed());
        assert_eq!(outcomes[0].len(), 400);
        pool.close();
    });
}

#[test]
fn it_stops_when_asked_and_when_a_replicate_cannot_be_written_down() {
    let slowest = Duration::from_millis(400);
    let model = Analytic { slowest, ..Analytic::default() };
    let refuse = |_: &Finished<'_>| {
        Err(RecordError::file("write", std::path::Path::new("replicates.journal"))(
            std::io::ErrorKind::StorageFull.into(),
        ))
    };
    let accept = |_: &Finished<'_>| Ok(());
    let notebooks: [&Notebook<'_>; 2] = [&accept, &refuse];
    for (notebook, is_full) in notebooks.into_iter().zip([false, true]) {
        let pool = Pool::new(&model, notebook);
        std::thread::scope(|scope| {
            scope.spawn(|| pool.work());
            let look_up = |_: &Pool<'_, Analytic>| {
                if is_full { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            };
            let ensemble = Ensemble::fixed(2);
            let halt = pool.evaluate(tasks(&model, 4), &ensemble, &seeds(&ensemble), look_up);
            assert_eq!(matches!(halt, Err(Halt::Record(_))), is_full);
            assert_eq!(matches!(halt, Err(Halt::Stopped)), !is_full);
            pool.close();
        });
    }
}
