//! The block of bytes and where things are in it.
//!
//! Numbers are rounded to 65,535 steps between the least and the largest value: far finer than a pixel.

use std::collections::BTreeMap;

use serde::Serialize;

use super::scene::Scene;
use crate::report::columns::{Column, NAMES};
use agglo::record::frames::{FieldValues, Frame};

/// Steps between the least and the largest value.
pub const STEPS: f64 = 65_535.0;

/// Where the arrays of a frame are.
#[derive(Clone, Debug, Default, Serialize)]
pub struct FramePlan {
    /// Time [s].
    pub time: f64,
    /// The arrays by name.
    pub arrays: BTreeMap<&'static str, Array>,
}

/// Where an array is, and what its numbers stand for.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Array {
    /// Place of the first byte.
    pub offset: usize,
    /// How many numbers.
    pub count: usize,
    /// Numbers as they are ("u32"), or steps between `low` and `high` ("u16").
    pub kind: &'static str,
    /// What step 0 stands for.
    pub low: f64,
    /// What the last step stands for.
    pub high: f64,
}

/// The block as it grows.
#[derive(Default)]
pub struct Block {
    /// The bytes so far.
    pub bytes: Vec<u8>,
    /// Corners of the walls that were packed last, and where they are.
    walls: (Vec<[f64; 3]>, BTreeMap<&'static str, Array>),
}

impl Block {
    /// Packs a frame with these columns.
    pub fn frame(&mut self, scene: &Scene, columns: &[Column]) -> FramePlan {
        let grains = &scene.grains;
        let mut arrays = BTreeMap::new();
        let names: Vec<u32> = match grains.field(NAMES) {
            Some(FieldValues::Integers(names)) => names.clone(),
            _ => (0..grains.points.len() as u32).collect(),
        };
        arrays.insert(NAMES, self.integers(&names));
        self.places(grains, ["x", "y", "z"], &mut arrays);
        for column in columns.iter().filter(|column| column.name != NAMES) {
            if let Some(values) = column.values(grains) {
                let array = if column.map.is_none() {
                    self.integers(&values.iter().map(|value| *value as u32).collect::<Vec<_>>())
                } else {
                    self.rounded(&values, [column.low, column.high])
                };
                arrays.insert(column.name, array);
            }
        }
        if !scene.bonds.is_empty() {
            arrays.insert("bonds", self.integers(scene.bonds.as_flattened()));
        }
        if let Some(rays) = &scene.rays {
            self.rays(rays, &mut arrays);
        }
        if let Some(walls) = scene.walls.as_ref().filter(|walls| !walls.points.is_empty()) {
            self.walls(walls, &mut arrays);
        }
        FramePlan { time: grains.time, arrays }
    }

    /// Walls that stand still are packed once.
    fn walls(&mut self, walls: &Frame, arrays: &mut BTreeMap<&'static str, Array>) {
        if self.walls.0 != walls.points {
            let mut own = BTreeMap::new();
            self.places(walls, ["wall_x", "wall_y", "wall_z"], &mut own);
            self.walls = (walls.points.clone(), own);
        }
        arrays.extend(&self.walls.1);
    }

    fn places(
        &mut self,
        frame: &Frame,
        names: [&'static str; 3],
        arrays: &mut BTreeMap<&'static str, Array>,
    ) {
        for (axis, name) in names.into_iter().enumerate() {
            let places: Vec<f64> = frame.points.iter().map(|point| point[axis]).collect();
            let finite = || places.iter().copied().filter(|place| place.is_finite());
            let ends = [finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max)];
            arrays.insert(name, self.rounded(&places, if ends[0] <= ends[1] { ends } else { [0.0; 2] }));
        }
    }

    fn rays(&mut self, rays: &Frame, arrays: &mut BTreeMap<&'static str, Array>) {
        let (Some(FieldValues::Vectors(ways)), Some(powers)) =
            (rays.field("direction"), numbers(rays, "power_W"))
        else {
            return;
        };
        if rays.points.is_empty() {
            return;
        }
        self.places(rays, ["ray_x", "ray_y", "ray_z"], arrays);
        for (axis, name) in ["ray_u", "ray_v", "ray_w"].into_iter().enumerate() {
            let parts: Vec<f64> = ways.iter().map(|part| part[axis]).collect();
            arrays.insert(name, self.rounded(&parts, [-1.0, 1.0]));
        }
        let most = powers.iter().copied().fold(0.0, f64::max);
        arrays.insert("ray_power", self.rounded(&powers, [0.0, most]));
    }

    fn integers(&mut self, values: &[u32]) -> Array {
        self.array(values.len(), "u32", [0.0, 0.0], values.iter().flat_map(|value| value.to_le_bytes()))
    }

    fn rounded(&mut self, values: &[f64], [low, high]: [f64; 2]) -> Array {
        let scale = if high > low { STEPS / (high - low) } else { 0.0 };
        let step = |value: &f64| (((value - low) * scale).round().clamp(0.0, STEPS)) as u16;
        self.array(
            values.len(),
            "u16",
            [low, high],
            values.iter().flat_map(|value| step(value).to_le_bytes()),
        )
    }

    fn array(
        &mut self,
        count: usize,
        kind: &'static str,
        [low, high]: [f64; 2],
        bytes: impl Iterator<Item = u8>,
    ) -> Array {
        // Browsers read numbers of four bytes at multiples of four.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let offset = self.bytes.len();
        self.bytes.extend(bytes);
        Array { offset, count, kind, low, high }
    }
}

/// A field of numbers.
pub fn numbers(frame: &Frame, name: &str) -> Option<Vec<f64>> {
    match frame.field(name)? {
        FieldValues::Scalars(values) => Some(values.clone()),
        FieldValues::Integers(values) => Some(values.iter().map(|&value| f64::from(value)).collect()),
        FieldValues::Vectors(_) => None,
    }
}
