//! Plans try what they say, and nothing else.

use super::*;

#[test]
fn grid_has_every_combination_once() {
    let plan = Plan::Grid(Grid { levels: 3 });
    let levels = [None, Some(2), Some(7)];
    let points = plan.points(&levels, 0);
    assert_eq!(points.len() as u64, plan.evaluations(&levels));
    assert_eq!(points.len(), 42);
    // Ends and middle of a range; both choices; seven whole numbers.
    assert_eq!(points[0], [0.0, 0.25, 0.5 / 7.0]);
    assert_eq!(points[1], [0.0, 0.25, 1.5 / 7.0]);
    assert_eq!(points[41], [1.0, 0.75, 6.5 / 7.0]);
    let mut sorted = points.clone();
    sorted.sort_by(|a, b| a.partial_cmp(b).unwrap());
    sorted.dedup();
    assert_eq!(sorted, points);
}

#[test]
fn list_goes_side_by_side() {
    let plan = Plan::List(List {});
    assert_eq!(plan.points(&[Some(2), Some(2)], 0), [[0.25, 0.25], [0.75, 0.75]]);
    assert_empty!(plan.faults(&[Some(2), Some(2)]));
    assert_contains!(plan.faults(&[Some(2), Some(3)])[0].1, "these have 2, 3");
    assert_contains!(plan.faults(&[Some(2), None])[0].1, "choices");
}

#[test]
fn refinement_goes_through_its_choices() {
    let plan = Plan::Refinement(Refinement::default());
    assert_eq!(plan.points(&[Some(4)], 0), [[0.125], [0.375], [0.625], [0.875]]);
    assert_empty!(plan.faults(&[Some(4)]));
    assert_eq!(
        plan.faults(&[Some(1)]).len() + plan.faults(&[None]).len() + plan.faults(&[Some(3), None]).len(),
        3
    );
}

/// Each trajectory moves once along each axis, by the step, within the cube; levels are hit equally often.
#[test]
fn trajectories_move_once_along_each_axis() {
    let morris = Morris { trajectories: 400, levels: 6 };
    let points = Plan::Morris(morris).points(&[None; 5], 9);
    let mut hits = [0_u32; 6];
    for trajectory in points.chunks(6) {
        let mut moved = [0; 5];
        for pair in trajectory.windows(2) {
            for axis in 0..5 {
                if pair[0][axis] != pair[1][axis] {
                    moved[axis] += 1;
                    assert_near!((pair[0][axis] - pair[1][axis]).abs(), morris.step(), 1e-15);
                }
            }
        }
        assert_eq!(moved, [1; 5]);
        for u in &trajectory[0] {
            assert_between!(*u, 0.0..=1.0);
            hits[(u * 5.0).round() as usize] += 1;
        }
    }
    // 2000 starts in six levels: 333 each, standard deviation sqrt(2000/6*5/6) = 17; four of them.
    assert!(hits.iter().all(|&hit| hit.abs_diff(333) < 67), "{hits:?}");
}

#[test]
fn plans_propose_once_and_recommend_the_best() {
    let mut laid = Plan::Grid(Grid { levels: 3 }).start(&[None], 0);
    assert_eq!(laid.ask(), [[0.0], [0.5], [1.0]]);
    laid.tell(&[Fitness::failed(), Fitness::new(vec![2.0]), Fitness::new(vec![1.0])]);
    assert_eq!(laid.recommended(), Some(vec![1.0]));
    assert_empty!(laid.ask());
}

#[test]
fn faults_are_named() {
    let key = |plan: Plan| plan.faults(&[None; 3]).into_iter().map(|(key, _)| key).collect::<Vec<_>>();
    assert_eq!(key(Plan::Grid(Grid { levels: 0 })), ["levels"]);
    assert_eq!(key(Plan::Grid(Grid { levels: 101 })), ["grid"]);
    assert_eq!(key(Plan::Morris(Morris { trajectories: 1, levels: 3 })), ["trajectories", "levels"]);
    let indices = SobolIndices { samples: 8, bootstraps: 0, level: 1.0 };
    assert_eq!(key(Plan::SobolIndices(indices)), ["samples", "bootstraps", "level"]);
}
