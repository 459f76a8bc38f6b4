//! One `.vtp` file.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use crate::folder::Mark;
use crate::math::Vec3;
use crate::particles::ColumnValues;
use crate::record::RecordError;
use crate::record::atomic::{self, Durability};
use crate::text::Number;

/// A named quantity, one value per point or per line.
#[derive(Clone, Debug)]
pub struct Field<'a> {
    name: String,
    values: ColumnValues<'a>,
}

impl<'a> Field<'a> {
    /// Names values; the name carries their unit.
    pub fn new(name: impl Into<String>, values: impl Into<ColumnValues<'a>>) -> Self {
        Self { name: name.into(), values: values.into() }
    }

    fn len(&self) -> usize {
        match self.values {
            ColumnValues::Integers(values) => values.len(),
            ColumnValues::Scalars(values) => values.len(),
            ColumnValues::Vectors(values) => values.len(),
        }
    }
}

/// What is drawn.
#[derive(Clone, Copy, Debug)]
pub enum Cells<'a> {
    /// A vertex at every point.
    Vertices,
    /// Lines between two points each, by their places in the list of points.
    Lines(&'a [[u32; 2]]),
    /// A triangle for every three points.
    Triangles,
}

/// Points with fields, and what is drawn with them.
#[derive(Clone, Debug)]
pub struct PolyData<'a> {
    /// Time [s].
    pub time: f64,
    /// Points [n, 3] [m].
    pub points: &'a [Vec3],
    /// Order in which points and their fields are written; theirs if left out. Not for lines.
    pub order: Option<&'a [u32]>,
    /// Fields with a value per point [n].
    pub point_fields: Vec<Field<'a>>,
    /// What is drawn.
    pub cells: Cells<'a>,
    /// Fields with a value per vertex, line or triangle [m].
    pub cell_fields: Vec<Field<'a>>,
}

/// An array of the file: how it is announced, and its values.
struct Array<'a> {
    name: &'a str,
    kind: &'static str,
    components: usize,
    bytes: u64,
    values: Values<'a>,
}

enum Values<'a> {
    Integers(&'a [u32], Option<&'a [u32]>),
    Scalars(&'a [f64], Option<&'a [u32]>),
    Vectors(&'a [Vec3], Option<&'a [u32]>),
    /// `count` numbers in steps of `step` from `first`.
    Counting {
        first: u32,
        step: u32,
        count: usize,
    },
    Pairs(&'a [[u32; 2]]),
}

impl PolyData<'_> {
    /// Writes the file, which is there wholly or not at all, and gives its mark.
    ///
    /// # Errors
    /// [`RecordError::Shape`] where lengths do not fit, [`RecordError::File`].
    pub fn write(&self, path: &Path) -> Result<Mark, RecordError> {
        self.check(path)?;
        let (head, arrays) = self.head();
        atomic::write_with(path, Durability::Process, |file| {
            file.write_all(head.as_bytes())?;
            for array in &arrays {
                file.write_all(&array.bytes.to_le_bytes())?;
                array.values.write(file)?;
            }
            file.write_all(b"\n</AppendedData>\n</VTKFile>\n")
        })
    }

    fn cell_count(&self) -> usize {
        match self.cells {
            Cells::Vertices => self.points.len(),
            Cells::Lines(pairs) => pairs.len(),
            Cells::Triangles => self.points.len() / 3,
        }
    }

    fn check(&self, path: &Path) -> Result<(), RecordError> {
        let shape = |what: String, found, expected| {
            Err(RecordError::Shape { path: path.to_owned(), what, found, expected })
        };
        let points = self.point_fields.iter().map(|field| (field, self.points.len()));
        let cells = self.cell_fields.iter().map(|field| (field, self.cell_count()));
        for (field, expected) in points.chain(cells) {
            if field.len() != expected {
                return shape(format!("the field `{}`", field.name), field.len(), expected);
            }
        }
        let ends = match self.cells {
            Cells::Vertices | Cells::Triangles => 0,
            Cells::Lines(pairs) => pairs.iter().flatten().max().map_or(0, |&end| end as usize + 1),
        };
        let (count, order) = (self.points.len(), self.order.unwrap_or_default());
        let named = ends.max(order.iter().max().map_or(0, |&at| at as usize + 1));
        if named > count {
            return shape("the list of points".to_owned(), count, named);
        }
        match self.order {
            Some(order) if order.len() != count => {
                shape("the order of points".to_owned(), order.len(), count)
            }
            _ => Ok(()),
        }
    }

    /// The XML before the data, and the arrays that follow it in the order of their offsets.
    fn head(&self) -> (String, Vec<Array<'_>>) {
        let (count, cells) = (self.points.len(), self.cell_count());
        let [vertices, lines, triangles] = match self.cells {
            Cells::Vertices => [cells, 0, 0],
            Cells::Lines(_) => [0, cells, 0],
            Cells::Triangles => [0, 0, cells],
        };
        let mut head = Head::default();
        head.text += "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
                      header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n";
        head.line(format_args!(
            "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n\
             </FieldData>\n<Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"{vertices}\" NumberOfLines=\"{lines}\" \
             NumberOfStrips=\"0\" NumberOfPolys=\"{triangles}\">",
            Number(self.time)
        ));
        let point_fields = self.point_fields.iter().map(|field| Array::of(field, self.order));
        head.section("PointData", point_fields);
        head.section("CellData", self.cell_fields.iter().map(|field| Array::of(field, None)));
        head.section("Points", [Array::vectors("Points", self.points, self.order)]);
        let offsets = |name, step| Array::counting(name, step, step, cells);
        match self.cells {
            Cells::Vertices => {
                head.section("Verts", [Array::counting("connectivity", 0, 1, cells), offsets("offsets", 1)]);
            }
            Cells::Lines(pairs) => head.section("Lines", [Array::pairs(pairs), offsets("offsets", 2)]),
            Cells::Triangles => {
                let corners = Array::counting("connectivity", 0, 1, 3 * cells);
                head.section("Polys", [corners, offsets("offsets", 3)]);
            }
        }
        head.text += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
        (head.text, head.arrays)
    }
}

/// The XML as it grows, with the arrays that it has announced.
#[derive(Default)]
struct Head<'a> {
    text: String,
    arrays: Vec<Array<'a>>,
    offset: u64,
}

impl<'a> Head<'a> {
    fn line(&mut self, line: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{line}");
    }

    fn section(&mut self, tag: &str, arrays: impl IntoIterator<Item = Array<'a>>) {
        self.line(format_args!("<{tag}>"));
        for array in arrays {
            let (kind, components, offset) = (array.kind, array.components, self.offset);
            let name = escaped(array.name);
            self.line(format_args!(
                "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" \
                 offset=\"{offset}\"/>"
            ));
            self.offset += size_of::<u64>() as u64 + array.bytes;
            self.arrays.push(array);
        }
        self.line(format_args!("</{tag}>"));
    }
}

impl<'a> Array<'a> {
    fn of(field: &'a Field<'a>, order: Option<&'a [u32]>) -> Self {
        let name = field.name.as_str();
        match field.values {
            ColumnValues::Integers(values) => {
                Self::new(name, "UInt32", 1, size_of_val(values), Values::Integers(values, order))
            }
            ColumnValues::Scalars(values) => {
                Self::new(name, "Float64", 1, size_of_val(values), Values::Scalars(values, order))
            }
            ColumnValues::Vectors(values) => Self::vectors(name, values, order),
        }
    }

    fn vectors(name: &'a str, values: &'a [Vec3], order: Option<&'a [u32]>) -> Self {
        Self::new(name, "Float64", 3, size_of_val(values), Values::Vectors(values, order))
    }

    fn counting(name: &'a str, first: u32, step: u32, count: usize) -> Self {
        let values = Values::Counting { first, step, count };
        Self::new(name, "Int64", 1, count * size_of::<i64>(), values)
    }

    fn pairs(pairs: &'a [[u32; 2]]) -> Self {
        Self::new("connectivity", "Int64", 1, 2 * pairs.len() * size_of::<i64>(), Values::Pairs(pairs))
    }

    fn new(name: &'a str, kind: &'static str, components: usize, bytes: usize, values: Values<'a>) -> Self {
        Self { name, kind, components, bytes: bytes as u64, values }
    }
}

impl Values<'_> {
    fn write(&self, file: &mut impl Write) -> io::Result<()> {
        match *self {
            Self::Integers(values, order) => {
                each(values, order, |value| file.write_all(&value.to_le_bytes()))
            }
            Self::Scalars(values, order) => each(values, order, |value| file.write_all(&value.to_le_bytes())),
            Self::Vectors(values, order) => each(values, order, |value| {
                value.to_array().iter().try_for_each(|part| file.write_all(&part.to_le_bytes()))
            }),
            Self::Counting { first, step, count } => {
                let mut numbers = (u64::from(first)..).step_by(step as usize).take(count);
                numbers.try_for_each(|number| file.write_all(&number.to_le_bytes()))
            }
            Self::Pairs(pairs) => {
                pairs.iter().flatten().try_for_each(|&end| file.write_all(&i64::from(end).to_le_bytes()))
            }
        }
    }
}

fn each<T: Copy>(
    values: &[T],
    order: Option<&[u32]>,
    mut write: impl FnMut(T) -> io::Result<()>,
) -> io::Result<()> {
    match order {
        None => values.iter().try_for_each(|&value| write(value)),
        Some(order) => order.iter().try_for_each(|&at| write(values[at as usize])),
    }
}

/// A name as it may stand between the quotes of XML.
pub(super) fn escaped(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame<'a>(points: &'a [Vec3], mass: &'a [f64]) -> PolyData<'a> {
        PolyData {
            time: 0.5,
            points,
            order: None,
            point_fields: vec![Field::new("mass_kg", mass)],
            cells: Cells::Vertices,
            cell_fields: Vec::new(),
        }
    }

    /// The block at the offset that the header announces has the length and the values that it should.
    fn block(file: &[u8], name: &str) -> Vec<u8> {
        let data = file.windows(2).position(|pair| pair == b"\n_").unwrap();
        let head = std::str::from_utf8(&file[..data]).unwrap();
        let at = head.find(&format!("Name=\"{name}\"")).unwrap();
        let offset = head[at..].split("offset=\"").nth(1).unwrap().split('"').next().unwrap();
        let start = data + 2 + offset.parse::<usize>().unwrap();
        let length = u64::from_le_bytes(file[start..start + 8].try_into().unwrap()) as usize;
        file[start + 8..start + 8 + length].to_vec()
    }

    fn floats(bytes: &[u8]) -> Vec<f64> {
        bytes.chunks(8).map(|chunk| f64::from_le_bytes(chunk.try_into().unwrap())).collect()
    }

    #[test]
    fn announced_offsets_lead_to_the_values() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("grains.vtp");
        let points = [Vec3::new(1.0, 2.0, 3.0), Vec3::new(-4.0, 0.1, 1e-9)];
        let mut frame = frame(&points, &[10.0, 20.0]);
        frame.order = Some(&[1, 0]);
        frame.write(&path).unwrap();
        let file = std::fs::read(&path).unwrap();
        assert_eq!(floats(&block(&file, "Points")), [-4.0, 0.1, 1e-9, 1.0, 2.0, 3.0]);
        assert_eq!(floats(&block(&file, "mass_kg")), [20.0, 10.0]);
        assert_eq!(block(&file, "connectivity"), [0_i64, 1].map(i64::to_le_bytes).concat());
        assert_eq!(block(&file, "offsets"), [1_i64, 2].map(i64::to_le_bytes).concat());
        let lines = PolyData { order: None, cells: Cells::Lines(&[[1, 0]]), ..frame };
        lines.write(&path).unwrap();
        let file = std::fs::read(&path).unwrap();
        assert_eq!(block(&file, "connectivity"), [1_i64, 0].map(i64::to_le_bytes).concat());
        assert_eq!(block(&file, "offsets"), 2_i64.to_le_bytes());
    }

    #[test]
    fn lengths_that_do_not_fit_are_refused() {
        let points = [Vec3::ZERO; 2];
        let path = Path::new("/nowhere/grains.vtp");
        let message = |frame: PolyData<'_>| frame.write(path).unwrap_err().to_string();
        let short = message(frame(&points, &[1.0]));
        assert!(short.ends_with("the field `mass_kg` has 1 values where 2 are due"), "{short}");
        let lost = PolyData { cells: Cells::Lines(&[[0, 2]]), ..frame(&points, &[1.0, 2.0]) };
        assert_ends!(message(lost), "the list of points has 2 values where 3 are due");
        let order = PolyData { order: Some(&[0]), ..frame(&points, &[1.0, 2.0]) };
        assert_ends!(message(order), "the order of points has 1 values where 2 are due");
    }
}
