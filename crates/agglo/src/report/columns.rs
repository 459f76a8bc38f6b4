//! What grains can be coloured by.

use serde::Serialize;

use crate::record::frames::{FieldValues, Frame};

/// Something that grains can be coloured by.
#[derive(Clone, Debug, Serialize)]
pub struct Column {
    /// Its name in the page.
    pub name: &'static str,
    /// What people call it.
    pub label: &'static str,
    /// Its unit; empty for pure numbers.
    pub unit: &'static str,
    /// The least value of the run.
    pub low: f64,
    /// The largest value of the run.
    pub high: f64,
    /// Where the colours begin and end: all but the rarest values lie between.
    pub colors: [f64; 2],
    /// "number" where values have an order, "name" where they only differ.
    pub kind: &'static str,
    #[serde(skip)]
    field: &'static str,
}

/// Name of the numbers by which grains are known; packed on its own, exactly.
pub const NAMES: &str = "id";

/// Name in the page, name of the field, what people call it, unit, kind.
const KNOWN: [[&str; 5]; 12] = [
    ["speed", "velocity_m_s", "speed", "m/s", "number"],
    ["temperature", "temperature_k", "temperature", "K", "number"],
    ["radius", "radius_m", "radius", "m", "number"],
    ["primaries", "primaries", "primaries", "", "number"],
    ["cluster", "cluster", "cluster", "", "name"],
    ["absorbed", "absorbed_power_w", "absorbed power", "W", "number"],
    ["mass", "mass_kg", "mass", "kg", "number"],
    ["spin", "spin_rad_s", "spin", "rad/s", "number"],
    ["charge", "charge_c", "charge", "C", "number"],
    ["polarity", "polarity", "polarity", "", "number"],
    ["material", "material", "material", "", "name"],
    ["id", "id", "grain number", "", "number"],
];

/// Part of all values at either end that gets the colour of the end.
const RAREST: f64 = 0.02;

impl Column {
    /// The values of a frame [n]; vectors give their lengths.
    pub fn values(&self, frame: &Frame) -> Option<Vec<f64>> {
        Some(match frame.field(self.field)? {
            FieldValues::Scalars(values) => values.clone(),
            FieldValues::Integers(values) => values.iter().map(|&value| f64::from(value)).collect(),
            FieldValues::Vectors(values) => {
                values.iter().map(|[x, y, z]| (x * x + y * y + z * z).sqrt()).collect()
            }
        })
    }
}

/// The columns that the frames have and that are not the same for all grains at all times; radii always.
pub fn known(frames: &[&Frame]) -> Vec<Column> {
    let mut columns = Vec::new();
    for [name, field, label, unit, kind] in KNOWN {
        let mut column = Column {
            name,
            label,
            unit,
            low: f64::INFINITY,
            high: f64::NEG_INFINITY,
            colors: [0.0; 2],
            kind,
            field,
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
        if column.high > column.low || (name == "radius" && column.high.is_finite()) {
            columns.push(column);
        }
    }
    columns
}
