//! What is known of frames before any is drawn: how far things reach, and the range of values.

use std::collections::BTreeMap;

use super::camera::Side;
use super::error::RenderError;
use super::frame_sequence::{Ball, FrameSequence};
use super::renderer::{Options, View};
use crate::plot::{Coloring, Quantity};
use agglo::math::Vec3;

/// What is known of a frame before it is drawn.
#[derive(Clone, Debug)]
pub(super) struct Survey {
    /// Reaches along right, up and forward [m], without the outermost grains; nothing without grains.
    pub reach: Option<[[f64; 2]; 3]>,
    /// The same of each wall, by its number.
    walls: BTreeMap<u32, [[f64; 2]; 3]>,
    /// Least and largest value, without outliers.
    range: [f64; 2],
    /// Least and largest value of all.
    all: [f64; 2],
}

/// Part of the grains that may be outside of the picture, on each side.
const OUTSIDE: f64 = 0.025;
/// Part of the values that may be above the range, where a quantity has outliers.
const ABOVE: f64 = 0.01;

/// Looks at a frame.
///
/// # Errors
/// [`RenderError`] where it cannot be read.
pub(super) fn survey(
    sequence: &FrameSequence,
    number: usize,
    quantity: &Quantity,
    options: &Options,
) -> Result<Survey, RenderError> {
    let frame = sequence.read(number)?;
    let balls = sequence.balls(number, &frame)?;
    let missing = || RenderError::Field { path: sequence.path(number).to_owned(), field: quantity.field };
    let mut values = quantity.of(&frame).ok_or_else(missing)?;
    values.retain(|value| value.is_finite());
    let all = values
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &value| [low.min(value), high.max(value)]);
    let range = if quantity.has_outliers {
        [all[0], quantile(&mut values, 1.0 - ABOVE).unwrap_or(all[1])]
    } else {
        all
    };
    let sheets = if options.walls { sequence.walls(number)? } else { Vec::new() };
    let mut walls: BTreeMap<u32, [[f64; 2]; 3]> = BTreeMap::new();
    for sheet in &sheets {
        let own = sheet.corners.map(|corner| seen(corner, options.side));
        let own = own.into_iter().chain(walls.get(&sheet.wall).copied()).reduce(joined);
        walls.extend(own.map(|own| (sheet.wall, own)));
    }
    Ok(Survey { reach: reach(&balls, options.side), walls, range, all })
}

/// How far a point reaches along right, up and forward.
pub(super) fn seen(point: Vec3, side: Side) -> [[f64; 2]; 3] {
    side.axes().map(|axis| [axis.dot(point); 2])
}

/// What is framed: grains, and of walls what is near these, or of the first frame alone.
pub(super) fn framed(surveys: &[Survey], sequence: &FrameSequence, view: View) -> Option<[[f64; 2]; 3]> {
    let surveys = match view {
        View::First => {
            let first = surveys.iter().position(|survey| survey.reach.is_some())?;
            &surveys[first..=first]
        }
        _ => surveys,
    };
    let grains = surveys.iter().filter_map(|survey| survey.reach).reduce(joined)?;
    let longest = grains.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
    let walls = surveys.iter().flat_map(|survey| &survey.walls);
    Some(walls.fold(grains, |framed, (&wall, &reach)| {
        let near = sequence.room_for(wall) * longest;
        let within = |axis: usize| {
            reach[axis].map(|end: f64| end.max(grains[axis][0] - near).min(grains[axis][1] + near))
        };
        joined(framed, std::array::from_fn(within))
    }))
}

/// How far grains reach along right, up and forward, without the outermost.
fn reach(balls: &[Ball], side: Side) -> Option<[[f64; 2]; 3]> {
    let along = |axis: Vec3| {
        let mut ends = [-1.0, 1.0].map(|sign| -> Vec<f64> {
            balls.iter().map(|(center, radius)| center.dot(axis) + sign * radius).collect()
        });
        let [lower, upper] = &mut ends;
        Some([quantile(lower, OUTSIDE)?, quantile(upper, 1.0 - OUTSIDE)?])
    };
    let [right, up, forward] = side.axes();
    Some([along(right)?, along(up)?, along(forward)?])
}

/// The value below which this part of all is; nothing without values. Few values are never left out.
fn quantile(values: &mut [f64], part: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    let place = part * last as f64;
    let at = if part < 0.5 { place.floor() } else { place.ceil() } as usize;
    Some(*values.select_nth_unstable_by(at, f64::total_cmp).1)
}

/// The reach of both.
pub(super) fn joined(a: [[f64; 2]; 3], b: [[f64; 2]; 3]) -> [[f64; 2]; 3] {
    std::array::from_fn(|axis| [a[axis][0].min(b[axis][0]), a[axis][1].max(b[axis][1])])
}

/// The range of the color map, and whether values are below or above it.
pub(super) fn range(
    surveys: &[Survey],
    quantity: &Quantity,
    wanted: Option<[f64; 2]>,
) -> ([f64; 2], [bool; 2]) {
    let over = |of: fn(&Survey) -> [f64; 2]| {
        surveys.iter().map(of).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [least, most]| {
            [low.min(least), high.max(most)]
        })
    };
    let all = over(|survey| survey.all);
    let found = wanted.unwrap_or_else(|| over(|survey| survey.range));
    let range = match found {
        [low, high] if low < high => [low, high],
        // All the same: the value is in the middle.
        [low, _] if low.is_finite() && low != 0.0 => [low - 0.05 * low.abs(), low + 0.05 * low.abs()],
        _ => [0.0, 1.0],
    };
    let is_map = matches!(quantity.coloring, Coloring::Values(_));
    (range, [is_map && all[0] < range[0], is_map && all[1] > range[1]])
}
