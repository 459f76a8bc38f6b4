//! Frames for ParaView and VTK: points with fields, and collections of files with their times.
//!
//! Files are VTK's XML PolyData (`.vtp`) with raw appended data, little-endian, and a `.pvd` list of them. Grains stand
//! in the order of their names in every frame, whatever their order in memory.

mod collection;
mod polydata;
mod read;

pub use collection::Collection;
pub use polydata::{Cells, Field, PolyData};
pub use read::{FieldValues, Frame};

use std::path::Path;

use super::RecordError;
use crate::math::Vec3;
use crate::particles::{ColumnValues, Particles};

/// Name of a column with its unit as it stands in files: (`velocity`, `m/s`) gives `velocity_m_s`.
pub fn name_with_unit(name: &str, unit: &str) -> String {
    let unit: String = unit
        .chars()
        .filter_map(|letter| match letter {
            '²' => Some('2'),
            '³' => Some('3'),
            '^' => None,
            letter if letter.is_alphanumeric() => Some(letter.to_ascii_lowercase()),
            _ => Some('_'),
        })
        .collect();
    if unit.is_empty() { name.to_owned() } else { format!("{name}_{unit}") }
}

/// Writes the grains at `time` [s] with all their columns and `extra` fields [n] (a cluster number, say), both in
/// memory's order.
///
/// # Errors
/// [`RecordError::Shape`] where an extra field is of another length, [`RecordError::File`].
pub fn write_grains(
    path: &Path,
    time: f64,
    grains: &Particles,
    extra: &[Field<'_>],
) -> Result<(), RecordError> {
    let mut order: Vec<u32> = (0..grains.len() as u32).collect();
    order.sort_by_key(|&at| grains.id[at as usize]);
    let columns = grains.columns().into_iter().filter(|(column, _)| column.name != "position");
    let fields = columns.map(|(column, values)| Field::new(name_with_unit(column.name, column.unit), values));
    let frame = PolyData {
        time,
        points: &grains.position,
        order: Some(&order),
        point_fields: fields.chain(extra.iter().cloned()).collect(),
        cells: Cells::Vertices,
        cell_fields: Vec::new(),
    };
    frame.write(path)
}

/// Writes lines between points at `time` [s]: bonds. `pairs` [m, 2] are places in `points` [n, 3] [m]; `fields` have
/// one value per line [m].
///
/// # Errors
/// [`RecordError::Shape`] where a pair names no point or a field is of another length, [`RecordError::File`].
pub fn write_lines(
    path: &Path,
    time: f64,
    points: &[Vec3],
    pairs: &[[u32; 2]],
    fields: &[Field<'_>],
) -> Result<(), RecordError> {
    let cells = Cells::Lines(pairs);
    PolyData { time, points, order: None, point_fields: Vec::new(), cells, cell_fields: fields.to_vec() }
        .write(path)
}

/// Writes rays in flight at `time` [s]: where they are [m] `[n, 3]`, where they go (unit vectors) `[n, 3]`, and the
/// power [W] `[n]` that each carries.
///
/// # Errors
/// [`RecordError::Shape`] where the lengths differ, [`RecordError::File`].
pub fn write_rays(
    path: &Path,
    time: f64,
    positions: &[Vec3],
    directions: &[Vec3],
    powers: &[f64],
) -> Result<(), RecordError> {
    let point_fields = vec![
        Field::new("direction", ColumnValues::Vectors(directions)),
        Field::new("power_w", ColumnValues::Scalars(powers)),
    ];
    let (cells, cell_fields) = (Cells::Vertices, Vec::new());
    PolyData { time, points: positions, order: None, point_fields, cells, cell_fields }.write(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_become_part_of_the_name() {
        let cases = [("m/s", "v_m_s"), ("", "v"), ("Pa", "v_pa"), ("rad/s", "v_rad_s"), ("J/m²", "v_j_m2")];
        for (unit, name) in cases {
            assert_eq!(name_with_unit("v", unit), name);
        }
    }
}
