//! Frames for ParaView and VTK: points with fields, and collections of files with their times.
//!
//! Files are VTK's XML PolyData (`.vtp`) with raw appended data, little-endian, and a `.pvd` list of them. Grains, and
//! the grains that bonds join, stand in the order of their names in every frame, whatever their order in memory.

mod collection;
mod polydata;
mod read;

pub use collection::Collection;
pub use polydata::{Cells, Field, PolyData};
pub use read::{FieldValues, Frame};

use std::path::Path;

use super::RecordError;
use crate::domain::Space;
use crate::folder::Mark;
use crate::math::Vec3;
use crate::particles::{ById, ColumnValues, Particles};

/// Name of a column with its unit as it stands in files: (`velocity`, `m/s`) gives `velocity_m_s`.
pub fn name_with_unit(name: &str, unit: &str) -> String {
    let unit: String = unit
        .chars()
        .filter_map(|letter| match letter {
            '²' => Some('2'),
            '³' => Some('3'),
            '^' => None,
            letter if letter.is_alphanumeric() => Some(letter),
            _ => Some('_'),
        })
        .collect();
    if unit.is_empty() { name.to_owned() } else { format!("{name}_{unit}") }
}

/// Writes the grains at `time` [s] with all their columns and `extra` fields [n] (a cluster number, say), both in
/// memory's order; gives the file's mark, as the others do.
///
/// # Errors
/// [`RecordError::Shape`] where an extra field is of another length, [`RecordError::File`].
pub fn write_grains(
    path: &Path,
    time: f64,
    grains: &Particles,
    extra: &[Field<'_>],
) -> Result<Mark, RecordError> {
    let order: Vec<u32> = ById::of(&grains.id).places().collect();
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

/// Writes bonds at `time` [s] as lines between centers of grains. `pairs` [m, 2] are places in memory; `fields` have one
/// value per bond [m].
///
/// Points are all grains in the order of their names, with these in `id`; lines have the names of what they join in
/// `grain_i` and `grain_j`, the lower first, and begin at that grain. Where the nearest image of the other grain is another than the
/// one inside, the line ends there: such images are points behind those of the grains.
///
/// # Errors
/// [`RecordError::Shape`] where a pair names no grain or a field is of another length, [`RecordError::File`].
pub fn write_bonds(
    path: &Path,
    time: f64,
    grains: &Particles,
    space: &Space,
    pairs: &[[u32; 2]],
    fields: &[Field<'_>],
) -> Result<Mark, RecordError> {
    let order: Vec<u32> = ById::of(&grains.id).places().collect();
    let mut place = vec![0_u32; order.len()];
    (0..).zip(&order).for_each(|(to, &from)| place[from as usize] = to);
    let named = pairs.iter().flatten().max().map_or(0, |&end| end as usize + 1);
    if named > order.len() {
        let (path, what) = (path.to_owned(), "the list of points".to_owned());
        return Err(RecordError::Shape { path, what, found: order.len(), expected: named });
    }
    // Places follow names, so that the lower place is the lower name.
    let ends = |pair: &[u32; 2]| {
        let [a, b] = pair.map(|grain| place[grain as usize]);
        [a.min(b), a.max(b)]
    };
    let mut lines: Vec<[u32; 2]> = pairs.iter().map(ends).collect();
    let name = |place: u32| grains.id[order[place as usize] as usize];
    let [i, j] = [0, 1].map(|end| lines.iter().map(|line| name(line[end])).collect::<Vec<u32>>());
    let names = [Field::new("grain_i", i.as_slice()), Field::new("grain_j", j.as_slice())];
    // The order of points is that of the lines' ends already.
    let mut points: Vec<Vec3> = order.iter().map(|&at| grains.position[at as usize]).collect();
    let mut ids: Vec<u32> = order.iter().map(|&at| grains.id[at as usize]).collect();
    for line in &mut lines {
        let [from, to] = line.map(|end| points[end as usize]);
        let nearest = space.shortest(to - from);
        if nearest != to - from {
            ids.push(ids[line[1] as usize]);
            line[1] = points.len() as u32;
            points.push(from + nearest);
        }
    }
    let frame = PolyData {
        time,
        points: &points,
        order: None,
        point_fields: vec![Field::new("id", ids.as_slice())],
        cells: Cells::Lines(&lines),
        cell_fields: names.into_iter().chain(fields.iter().cloned()).collect(),
    };
    frame.write(path)
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
) -> Result<Mark, RecordError> {
    let point_fields = vec![
        Field::new("direction", ColumnValues::Vectors(directions)),
        Field::new("power_W", ColumnValues::Scalars(powers)),
    ];
    let (cells, cell_fields) = (Cells::Vertices, Vec::new());
    PolyData { time, points: positions, order: None, point_fields, cells, cell_fields }.write(path)
}

/// Writes walls at `time` [s]: triangles [m] `[n, 3, 3]`, and the number of the wall that each corner is of `[3 n]`.
///
/// # Errors
/// [`RecordError::Shape`] where the lengths differ, [`RecordError::File`].
pub fn write_walls(
    path: &Path,
    time: f64,
    triangles: &[[Vec3; 3]],
    walls: &[u32],
) -> Result<Mark, RecordError> {
    let points = triangles.as_flattened();
    let point_fields = vec![Field::new("wall", walls)];
    let (cells, cell_fields) = (Cells::Triangles, Vec::new());
    PolyData { time, points, order: None, point_fields, cells, cell_fields }.write(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Grains whose names fall where their places in memory rise, and skip one.
    fn backwards() -> Particles {
        let mut grains = Particles::default();
        for id in [7_u32, 5, 2] {
            let position = Vec3::new(f64::from(id), 0.0, 0.0);
            grains.push(crate::particles::Row { id, position, ..Default::default() });
        }
        grains
    }

    #[test]
    fn bonds_carry_the_names_of_their_grains() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bonds.vtp");
        let stretch = [0.5, -0.5];
        let fields = [Field::new("stretch", stretch.as_slice())];
        write_bonds(&path, 0.0, &backwards(), &Space::OPEN, &[[0, 2], [2, 1]], &fields).unwrap();
        let frame = Frame::read(&path).unwrap();
        let names = |name: &str| match frame.field(name) {
            Some(FieldValues::Integers(names)) => names.clone(),
            other => panic!("{name}: {other:?}"),
        };
        assert_eq!(
            (names("id"), names("grain_i"), names("grain_j")),
            (vec![2, 5, 7], vec![2, 2], vec![7, 5])
        );
        assert_eq!(frame.lines, [[0, 2], [0, 1]]);
        for (place, name) in frame.points.iter().zip(names("id")) {
            assert_eq!(place[0], f64::from(name), "points are where the grains of these names are");
        }
        assert_eq!(frame.field("stretch"), Some(&FieldValues::Scalars(stretch.to_vec())));
        let lost =
            write_bonds(&path, 0.0, &backwards(), &Space::OPEN, &[[0, 3]], &[]).unwrap_err().to_string();
        assert!(lost.ends_with("the list of points has 3 values where 4 are due"), "{lost}");
    }

    /// In a box of 6 m grains at 2 m and 7 m are 1 m apart: the line leads from the one to the other's image at 1 m.
    #[test]
    fn bonds_through_a_face_end_at_an_image() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bonds.vtp");
        let space =
            Space::repeating([Vec3::new(2.0, 0.0, 0.0), Vec3::new(8.0, 9.0, 9.0)], [true, false, false]);
        write_bonds(&path, 0.0, &backwards(), &space, &[[0, 2], [2, 1]], &[]).unwrap();
        let frame = Frame::read(&path).unwrap();
        assert_eq!(frame.lines, [[0, 3], [0, 1]]);
        assert_eq!(frame.points[3], [1.0, 0.0, 0.0]);
        assert_eq!(frame.field("id"), Some(&FieldValues::Integers(vec![2, 5, 7, 7])));
        assert_eq!(frame.field("grain_j"), Some(&FieldValues::Integers(vec![7, 5])));
    }

    #[test]
    fn units_become_part_of_the_name() {
        let cases = [("m/s", "v_m_s"), ("", "v"), ("Pa", "v_Pa"), ("rad/s", "v_rad_s"), ("J/m²", "v_J_m2")];
        for (unit, name) in cases {
            assert_eq!(name_with_unit("v", unit), name);
        }
    }
}
