//! What is drawn of one frame.

use std::path::{Path, PathBuf};

use crate::report::columns::NAMES;
use agglo::record::RecordError;
use agglo::record::frames::{FieldValues, Frame};
use agglo::text::cell;

/// No number of a frame is as large in SI units.
const LARGEST: f64 = 1e30;
/// How much further than most points no point gets.
const STRAY: f64 = 1e6;

/// A frame with what is drawn over its grains.
pub struct Scene {
    /// The grains.
    pub grains: Frame,
    /// Places of the bonded grains in the frame.
    pub bonds: Vec<[u32; 2]>,
    /// The rays in flight.
    pub rays: Option<Frame>,
    /// The walls: three by three the corners of triangles.
    pub walls: Option<Frame>,
}

/// The file of another kind that belongs to a frame of grains: `rays_000012.vtp` to `grains_000012.vtp`.
pub fn beside(grains: &Path, kind: &str) -> PathBuf {
    let name = grains.file_name().unwrap_or_default().to_string_lossy().replacen("grains", kind, 1);
    grains.with_file_name(name)
}

impl Scene {
    /// Reads a frame; bonds, rays and walls that cannot be used are noted.
    ///
    /// # Errors
    /// [`RecordError`] where the grains cannot be read, or cannot be.
    pub fn read(path: &Path, notes: &mut Vec<String>) -> Result<Self, RecordError> {
        let mut over = |kind: &str| {
            let path = beside(path, kind);
            let read = path.is_file().then(|| valid(&path))?;
            read.map_err(|error| notes.push(format!("{kind} of a frame are left out: {error}"))).ok()
        };
        let [bonds, rays, walls] = ["bonds", "rays", "walls"].map(&mut over);
        let grains = valid(path)?;
        // Those that end at an image, behind the grains, go out through a face: they would be drawn all through the volume.
        let inside = |bonds: &Frame| bonds.lines.iter().filter(|line| is_inside(&grains, **line)).count();
        let lines = bonds.as_ref().map_or(0, inside);
        let bonds = bonds.map(|bonds| between(&grains, &bonds)).unwrap_or_default();
        if bonds.len() < lines {
            notes.push(format!(
                "{} is damaged: {} of {lines} bonds join no grains and are left out",
                beside(path, "bonds").display(),
                lines - bonds.len()
            ));
        }
        Ok(Self { grains, bonds, rays, walls })
    }

    /// Keeps one of `share` grains and rays, and the bonds between the grains that are kept.
    pub fn thin(&mut self, share: u64) {
        if share <= 1 {
            return;
        }
        let kept = thin(&mut self.grains, share);
        let place = |grain: u32| kept.binary_search(&(grain as usize)).ok().map(|at| at as u32);
        self.bonds = self.bonds.iter().filter_map(|&[a, b]| Some([place(a)?, place(b)?])).collect();
        if let Some(rays) = &mut self.rays {
            thin(rays, share);
        }
    }
}

/// Reads a frame whose numbers can be true.
fn valid(path: &Path) -> Result<Frame, RecordError> {
    let frame = Frame::read(path)?;
    match fault(&frame) {
        Some(reason) => Err(RecordError::Damaged { path: path.to_owned(), reason }),
        None => Ok(frame),
    }
}

/// Why the numbers of a frame cannot be true.
fn fault(frame: &Frame) -> Option<String> {
    let is_real = |value: &f64| value.abs() < LARGEST;
    if !frame.points.as_flattened().iter().all(is_real) {
        return Some("it has places that are not finite, or absurd".to_owned());
    }
    if has_strays(&frame.points) {
        return Some("it has places absurdly far from all others".to_owned());
    }
    frame.fields.iter().find_map(|(name, values)| {
        let holds = match values {
            // Bonds have images behind their grains.
            FieldValues::Integers(values) => {
                name != NAMES || !frame.lines.is_empty() || values.is_sorted_by(|a, b| a < b)
            }
            FieldValues::Scalars(values) => values.iter().all(|value| {
                is_real(value)
                    && match name.as_str() {
                        "radius_m" | "mass_kg" => *value > 0.0,
                        "temperature_K" => *value >= 0.0,
                        _ => true,
                    }
            }),
            FieldValues::Vectors(values) => values.as_flattened().iter().all(is_real),
        };
        (!holds).then(|| format!("its {} has values that are not finite, or absurd", cell(name)))
    })
}

/// Whether a point is further from the middle than most are by so much that no motion takes it there.
fn has_strays(points: &[[f64; 3]]) -> bool {
    let middle = |mut values: Vec<f64>| {
        let at = values.len() / 2;
        *values.select_nth_unstable_by(at, f64::total_cmp).1
    };
    if points.len() < 3 {
        return false;
    }
    let center = [0, 1, 2].map(|axis| middle(points.iter().map(|point| point[axis]).collect()));
    let away = |point: &[f64; 3]| (0..3).map(|k| (point[k] - center[k]).abs()).fold(0.0, f64::max);
    let distances: Vec<f64> = points.iter().map(away).collect();
    let most = distances.iter().copied().fold(0.0, f64::max);
    let usual = middle(distances);
    usual > 0.0 && most > STRAY * usual
}

/// Places in the frame of the grains that bonds join, by their names.
fn between(grains: &Frame, bonds: &Frame) -> Vec<[u32; 2]> {
    let names = |frame: &Frame, field: &str| match frame.field(field) {
        Some(FieldValues::Integers(names)) => names.clone(),
        _ => Vec::new(),
    };
    // They rise: a frame where they do not is damaged and not read.
    let known = names(grains, NAMES);
    let place = |name: &u32| known.binary_search(name).ok().map(|at| at as u32);
    let ends = [names(bonds, "grain_i"), names(bonds, "grain_j")];
    let pairs = ends[0].iter().zip(&ends[1]).zip(&bonds.lines);
    let inside = pairs.filter(|(_, line)| is_inside(grains, **line));
    inside.filter_map(|((i, j), _)| Some([place(i)?, place(j)?])).collect()
}

/// Whether a line joins grains where they are, and not an image.
fn is_inside(grains: &Frame, line: [u32; 2]) -> bool {
    line.iter().all(|end| (*end as usize) < grains.points.len())
}

/// Keeps one of `share` points: by their names, so that a grain is in all frames or in none. Gives their places.
fn thin(frame: &mut Frame, share: u64) -> Vec<usize> {
    let names: Vec<u64> = match frame.field(NAMES) {
        Some(FieldValues::Integers(names)) => names.iter().map(|&name| u64::from(name)).collect(),
        _ => (0..frame.points.len() as u64).collect(),
    };
    let kept: Vec<usize> = (0..names.len()).filter(|&at| names[at].is_multiple_of(share)).collect();
    frame.points = kept.iter().map(|&at| frame.points[at]).collect();
    for (_, values) in &mut frame.fields {
        match values {
            FieldValues::Integers(values) => *values = kept.iter().map(|&at| values[at]).collect(),
            FieldValues::Scalars(values) => *values = kept.iter().map(|&at| values[at]).collect(),
            FieldValues::Vectors(values) => *values = kept.iter().map(|&at| values[at]).collect(),
        }
    }
    kept
}
