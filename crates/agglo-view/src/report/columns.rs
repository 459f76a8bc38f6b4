//! What grains can be colored by.

use serde::Serialize;

use crate::plot::{Coloring, Quantity};
use agglo::record::frames::Frame;

/// Something that grains can be colored by.
#[derive(Clone, Debug, Serialize)]
pub struct Column {
    /// Its name in the page.
    pub name: &'static str,
    /// What people call it.
    pub label: String,
    /// Its unit; empty for pure numbers.
    pub unit: &'static str,
    /// The least value of the run.
    pub low: f64,
    /// The largest value of the run.
    pub high: f64,
    /// Where the colors begin and end: all but the rarest values lie between.
    pub colors: [f64; 2],
    /// The color map of values; none where they are names.
    pub map: Option<&'static str>,
    #[serde(skip)]
    quantity: Quantity,
}

/// Name of the numbers by which grains are known; packed on its own, exactly.
pub const NAMES: &str = "id";
/// Name of the radii, which are always there.
pub const SIZES: &str = "size";

/// Part of all values at either end that gets the color of the end.
const RAREST: f64 = 0.02;

impl Column {
    /// The values of a frame [n]; vectors give their lengths.
    pub fn values(&self, frame: &Frame) -> Option<Vec<f64>> {
        self.quantity.of(frame)
    }
}

/// The columns that the frames have and that are not the same for all grains at all times; radii always.
pub fn known(frames: &[&Frame]) -> Vec<Column> {
    let mut columns = Vec::new();
    for quantity in Quantity::ALL {
        let mut column = Column {
            name: quantity.word,
            label: quantity.title.to_lowercase(),
            unit: quantity.unit,
            low: f64::INFINITY,
            high: f64::NEG_INFINITY,
            colors: [0.0; 2],
            map: match quantity.coloring {
                Coloring::Values(map) => Some(map.word()),
                Coloring::Clusters | Coloring::Materials => None,
            },
            quantity,
        };
        let mut values: Vec<f64> = frames
            .iter()
            .filter_map(|frame| column.values(frame))
            .flatten()
            .filter(|value| value.is_finite())
            .collect();
        values.sort_unstable_by(f64::total_cmp);
        let at =
            |part: f64| values.get((values.len().saturating_sub(1) as f64 * part).round() as usize).copied();
        if let (Some(low), Some(high), Some(from), Some(to)) =
            (at(0.0), at(1.0), at(RAREST), at(1.0 - RAREST))
        {
            let colors = if to > from { [from, to] } else { [low, high] };
            column = Column { low, high, colors, ..column };
        }
        if column.high > column.low || (column.name == SIZES && column.high.is_finite()) {
            columns.push(column);
        }
    }
    columns
}
