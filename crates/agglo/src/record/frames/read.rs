//! Frames read back: for reports and pictures.

use std::path::Path;

use crate::record::{RecordError, door};

/// What a `.vtp` file of ours holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Time [s].
    pub time: f64,
    /// Points [n, 3] [m]; in a frame of walls three by three the corners of triangles.
    pub points: Vec<[f64; 3]>,
    /// Pairs of points that lines join [m, 2]; empty where points stand alone.
    pub lines: Vec<[u32; 2]>,
    /// Fields by name.
    pub fields: Vec<(String, FieldValues)>,
}

/// Values of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldValues {
    /// Whole numbers [n].
    Integers(Vec<u32>),
    /// Numbers [n].
    Scalars(Vec<f64>),
    /// Vectors [n, 3].
    Vectors(Vec<[f64; 3]>),
}

/// An array as the file's head announces it.
struct Announced<'a> {
    name: &'a str,
    kind: &'a str,
    components: usize,
    offset: usize,
}

impl Frame {
    /// Reads a frame.
    ///
    /// # Errors
    /// [`RecordError::File`] where it cannot be read, [`RecordError::Damaged`] where it is not whole.
    pub fn read(path: &Path) -> Result<Self, RecordError> {
        let bytes = door::read(path, door::MOST_OF_A_TABLE).map_err(RecordError::file("read", path))?;
        Self::parse(&bytes)
            .map_err(|reason| RecordError::Damaged { path: path.to_owned(), reason: reason.to_owned() })
    }

    /// The field of that name.
    pub fn field(&self, name: &str) -> Option<&FieldValues> {
        self.fields.iter().find(|(known, _)| known == name).map(|(_, values)| values)
    }

    fn parse(bytes: &[u8]) -> Result<Self, &'static str> {
        const MARK: &[u8] = b"<AppendedData encoding=\"raw\">\n_";
        let at = bytes.windows(MARK.len()).position(|window| window == MARK).ok_or("it has no data")?;
        let head = std::str::from_utf8(&bytes[..at]).map_err(|_| "its head is not text")?;
        let data = &bytes[at + MARK.len()..];
        let mut frame = Self { time: time_of(head)?, ..Self::default() };
        for array in announced(head) {
            frame.take(&array, block(data, array.offset)?)?;
        }
        let count = frame.points.len();
        let rows = |values: &FieldValues| match values {
            FieldValues::Integers(values) => values.len(),
            FieldValues::Scalars(values) => values.len(),
            FieldValues::Vectors(values) => values.len(),
        };
        let due = |length: usize| length == count || length == frame.lines.len();
        let fits = frame.fields.iter().all(|(_, values)| due(rows(values)));
        let ends = frame.lines.iter().flatten().all(|&end| (end as usize) < count);
        if fits && ends { Ok(frame) } else { Err("its arrays do not fit each other") }
    }

    fn take(&mut self, array: &Announced<'_>, block: &[u8]) -> Result<(), &'static str> {
        match (array.name, array.kind, array.components) {
            ("Points", "Float64", 3) => self.points = vectors(block)?,
            ("connectivity", "Int64", 1) => {
                let ends =
                    numbers(block, |bytes| u32::try_from(i64::from_le_bytes(bytes)).unwrap_or(u32::MAX))?;
                let (pairs, rest) = ends.as_chunks::<2>();
                if !rest.is_empty() {
                    return Err("a line has one end");
                }
                self.lines = pairs.to_vec();
            }
            ("offsets", ..) => {}
            (name, "UInt32", 1) => {
                self.fields
                    .push((name.to_owned(), FieldValues::Integers(numbers(block, u32::from_le_bytes)?)));
            }
            (name, "Float64", 1) => {
                self.fields
                    .push((name.to_owned(), FieldValues::Scalars(numbers(block, f64::from_le_bytes)?)));
            }
            (name, "Float64", 3) => {
                self.fields.push((name.to_owned(), FieldValues::Vectors(vectors(block)?)));
            }
            _ => return Err("it has an array of a kind that agglo does not write"),
        }
        Ok(())
    }
}

/// The time in the head [s].
fn time_of(head: &str) -> Result<f64, &'static str> {
    let text = head.split("Name=\"TimeValue\"").nth(1).and_then(|rest| between(rest, ">", "<"));
    text.and_then(|text| text.parse().ok()).ok_or("it has no time")
}

/// The arrays that the head announces; lines have their ends in `Lines`; vertices, and triangles of three points each, are left out.
fn announced(head: &str) -> impl Iterator<Item = Announced<'_>> {
    let shown = ["<Verts>", "<Polys>"].iter().fold(head, |head, tag| head.split(tag).next().unwrap_or(head));
    shown.split("<DataArray ").skip(1).filter_map(|tag| {
        let attribute = |name: &str| between(tag, &format!("{name}=\""), "\"");
        Some(Announced {
            name: attribute(" Name")?,
            kind: attribute("type")?,
            components: attribute("NumberOfComponents")?.parse().ok()?,
            offset: attribute("offset")?.parse().ok()?,
        })
    })
}

fn between<'a>(text: &'a str, before: &str, after: &str) -> Option<&'a str> {
    text.split_once(before)?.1.split_once(after).map(|(found, _)| found)
}

/// The bytes of the array at an offset: its length, then itself.
fn block(data: &[u8], offset: usize) -> Result<&[u8], &'static str> {
    const CUT: &str = "it is cut short";
    let (length, rest) = data.get(offset..).and_then(|rest| rest.split_first_chunk::<8>()).ok_or(CUT)?;
    let length = usize::try_from(u64::from_le_bytes(*length)).map_err(|_| CUT)?;
    rest.get(..length).ok_or(CUT)
}

fn numbers<T, const N: usize>(block: &[u8], from: impl Fn([u8; N]) -> T) -> Result<Vec<T>, &'static str> {
    let (chunks, rest) = block.as_chunks::<N>();
    if rest.is_empty() {
        Ok(chunks.iter().map(|chunk| from(*chunk)).collect())
    } else {
        Err("an array has an odd length")
    }
}

fn vectors(block: &[u8]) -> Result<Vec<[f64; 3]>, &'static str> {
    let parts = numbers(block, f64::from_le_bytes)?;
    let (vectors, rest) = parts.as_chunks::<3>();
    if rest.is_empty() { Ok(vectors.to_vec()) } else { Err("an array of vectors has an odd length") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::record::frames::{Cells, Field, PolyData};

    fn written(cells: Cells<'_>, cell_fields: Vec<Field<'_>>) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("frame.vtp");
        let points = [Vec3::new(1.0, 2.0, 3.0), Vec3::new(-4.0, 0.1, 1e-9)];
        let point_fields = vec![Field::new("mass_kg", &[10.0, 20.0][..]), Field::new("id", &[7_u32, 9][..])];
        PolyData { time: 2.5e-7, points: &points, order: None, point_fields, cells, cell_fields }
            .write(&path)
            .unwrap();
        std::fs::read(&path).unwrap()
    }

    #[test]
    fn what_was_written_is_read() {
        let frame = Frame::parse(&written(Cells::Vertices, Vec::new())).unwrap();
        assert_eq!((frame.time, frame.lines.len()), (2.5e-7, 0));
        assert_eq!(frame.points, [[1.0, 2.0, 3.0], [-4.0, 0.1, 1e-9]]);
        assert_eq!(frame.field("mass_kg"), Some(&FieldValues::Scalars(vec![10.0, 20.0])));
        assert_eq!(frame.field("id"), Some(&FieldValues::Integers(vec![7, 9])));
        let stretch = [0.25];
        let lines = written(Cells::Lines(&[[1, 0]]), vec![Field::new("stretch", &stretch[..])]);
        let frame = Frame::parse(&lines).unwrap();
        assert_eq!(frame.lines, [[1, 0]]);
        assert_eq!(frame.field("stretch"), Some(&FieldValues::Scalars(vec![0.25])));
    }

    /// Wherever a file is cut before its last array's end, it is refused and nothing panics.
    #[test]
    fn a_cut_file_is_refused() {
        let whole = written(Cells::Lines(&[[1, 0]]), Vec::new());
        let tail = b"\n</AppendedData>\n</VTKFile>\n".len();
        // The list of offsets is last and is not read: 8 bytes of length and one number.
        for length in 0..whole.len() - tail - 16 {
            assert!(Frame::parse(&whole[..length]).is_err(), "{length} of {} bytes", whole.len());
        }
    }
}
