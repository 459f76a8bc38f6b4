//! Steps, time on the clock and bytes on the disk, carried on from the first moments of a run to its end.

use super::push::Push;
use super::{Plan, counts};
use crate::engine::soft::Scheme;
use crate::run::{Rehearsal, Stretches};
use crate::scenario::{Output, Scenario};

/// Pairs of grains at a distance in one evaluation of forces, above which not even one is tried: some seconds' work.
const MOST_PAIRS: f64 = 1e9;
/// Checkpoints that stay in a run's folder.
const CHECKPOINTS_KEPT: f64 = 2.0;
/// Bytes of a report without its frames: charts, words and what draws them; and of each grain in each frame that it shows.
const BYTES_PER_REPORT: f64 = 2e6;
const BYTES_PER_SHOWN_GRAIN: f64 = 14.0;
const BYTES_PER_SHOWN_RAY: f64 = 14.0;

/// Why the first steps are not tried, if they are not.
pub(super) fn too_much_to_try(scenario: &Scenario, grains: usize) -> Option<String> {
    let field = scenario.soft()?.fields.near_field.as_ref()?;
    let pairs = (grains as f64).powi(2);
    (field.cutoff.is_none() && pairs > MOST_PAIRS)
        .then(|| format!("fields.near_field has no cutoff, and {pairs:.1e} pairs act in every step"))
}

/// What a second of simulated time takes.
#[derive(Clone, Copy, Debug)]
struct Rate {
    steps: f64,
    wall_s: f64,
}

impl Rate {
    fn of(stretches: &Stretches) -> Option<Self> {
        let latest = stretches.latest();
        (latest.time > 0.0)
            .then(|| Self { steps: latest.steps / latest.time, wall_s: latest.wall_s / latest.time })
    }

    /// As many steps a second, each as long on the clock as before.
    fn at(self, steps: f64) -> Self {
        Self { steps, wall_s: self.wall_s * steps / self.steps }
    }
}

/// Steps and time of a run of soft spheres.
pub(super) fn of_soft(plan: &mut Plan, scenario: &Scenario, tried: &Rehearsal, pushes: &[Push]) {
    let so_far = tried.quiet.all.steps + tried.flying.all.steps;
    let wall_s = tried.start_s + tried.quiet.all.wall_s + tried.flying.all.wall_s;
    if let Some(trouble) = &tried.trouble {
        plan.notes.push(format!("a run would fail at {} s: {trouble}", tried.time));
        return;
    }
    let left = scenario.time.end.si() - tried.time;
    let flights = flights(scenario, pushes) - tried.flying.all.time;
    let flying = if tried.is_finished { 0.0 } else { flights.clamp(0.0, left) };
    let Some([quiet_rate, flying_rate]) = rates(scenario, tried, pushes) else { return };
    let quiet = left - flying;
    plan.steps = Some(so_far + quiet * quiet_rate.steps + flying * flying_rate.steps);
    plan.seconds = Some(wall_s + quiet * quiet_rate.wall_s + flying * flying_rate.wall_s);
}

/// Rates without and with rays in flight. Where only one kind was tried, the other is told from the scheme.
fn rates(scenario: &Scenario, tried: &Rehearsal, pushes: &[Push]) -> Option<[Rate; 2]> {
    let quiet = Rate::of(&tried.quiet).or_else(|| tried.calm.as_ref().and_then(Rate::of));
    let found = [quiet, Rate::of(&tried.flying)];
    match found {
        [Some(quiet), Some(flying)] => Some([quiet, flying]),
        [None, Some(flying)] => Some([flying.at(without_rays(scenario).unwrap_or(flying.steps)), flying]),
        [Some(quiet), None] => {
            let flights = flights(scenario, pushes);
            let traced: f64 = pushes.iter().map(|push| push.pulses * push.wall_s).sum();
            let rate =
                quiet.at(with_rays(pushes, scenario).map_or(quiet.steps, |steps| steps.max(quiet.steps)));
            let tracing = if flights > 0.0 { traced / flights } else { 0.0 };
            Some([quiet, Rate { wall_s: rate.wall_s + tracing, ..rate }])
        }
        [None, None] => None,
    }
}

/// Steps a second that the scheme takes where nothing happens, if it says.
fn without_rays(scenario: &Scenario) -> Option<f64> {
    match &scenario.soft()?.scheme {
        Scheme::Staggered(scheme) => Some(1.0 / scheme.largest_step.si()),
        Scheme::Verlet(_) => None,
    }
}

/// Steps a second that the law of the rays' force asks for, if it does.
fn with_rays(pushes: &[Push], scenario: &Scenario) -> Option<f64> {
    let is_stepped = scenario.acoustics().is_some_and(|acoustics| !acoustics.force.is_impulse());
    pushes.first().filter(|_| is_stepped).map(|push| 1.0 / push.duration)
}

/// Time [s] in which rays fly. Later pulses have a longer way, there and back, through grains that have spread.
pub(super) fn flights(scenario: &Scenario, pushes: &[Push]) -> f64 {
    let speed = scenario.medium.sound_speed.si();
    let of = |push: &Push| push.pulses * push.flight_s + 2.0 * push.spreads() / speed;
    pushes.iter().map(of).sum::<f64>().min(scenario.time.end.si())
}

/// Bytes of a run's folder: what was written, and as much more as is due until the end.
pub(super) fn of_files(plan: &mut Plan, scenario: &Scenario, tried: &Rehearsal, pushes: &[Push]) {
    let Some(weights) = tried.weights.filter(|_| tried.trouble.is_none()) else { return };
    let Output { series, frames, pulses, .. } = scenario.resolved().output;
    let left = scenario.time.end.si() - tried.time;
    let flying_left = (flights(scenario, pushes) - tried.flying.all.time).clamp(0.0, left);
    let (dense, times) = (pulses.unwrap_or_default(), [left - flying_left, flying_left]);
    let rows: f64 = counts::due([series, dense.series], times).iter().sum();
    let frame = weights.frame.or(weights.flying_frame).unwrap_or(0.0);
    let all_rays = weights.flying_frame.unwrap_or(frame) - frame;
    let flying_frame = frame + counts::PART_IN_FLIGHT * all_rays;
    let [quiet_frames, flying_frames] = counts::due([frames, dense.frames], times);
    let frames = quiet_frames * frame + flying_frames * flying_frame;
    let kept = CHECKPOINTS_KEPT * weights.checkpoint;
    let [grains, rays] = counts::shown(plan, scenario, flights(scenario, pushes));
    let report = BYTES_PER_REPORT + BYTES_PER_SHOWN_GRAIN * grains + BYTES_PER_SHOWN_RAY * rays;
    let more = rows * weights.row + frames;
    plan.disk = Some(weights.so_far + more + kept + report);
    plan.seconds = plan.seconds.map(|seconds| seconds + tried.writing_s * (1.0 + more / weights.so_far));
}

#[cfg(test)]
#[path = "cost_tests.rs"]
mod tests;
