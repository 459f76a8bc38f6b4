//! What is drawn of one frame.

use std::path::{Path, PathBuf};

use crate::record::RecordError;
use crate::record::frames::{FieldValues, Frame};
use crate::report::columns::NAMES;

/// A frame with what is drawn over its grains.
pub struct Scene {
    /// The grains.
    pub grains: Frame,
    /// Places of the bonded grains in the frame.
    pub bonds: Vec<[u32; 2]>,
    /// The rays in flight.
    pub rays: Option<Frame>,
}

/// The file of another kind that belongs to a frame of grains: `rays_000012.vtp` to `grains_000012.vtp`.
pub fn beside(grains: &Path, kind: &str) -> PathBuf {
    let name = grains.file_name().unwrap_or_default().to_string_lossy().replacen("grains", kind, 1);
    grains.with_file_name(name)
}

impl Scene {
    /// Reads a frame and keeps one of `share` grains; bonds and rays that cannot be read are noted.
    ///
    /// # Errors
    /// [`RecordError`] where the grains cannot be read.
    pub fn read(path: &Path, share: u64, notes: &mut Vec<String>) -> Result<Self, RecordError> {
        let mut over = |kind: &str| {
            let path = beside(path, kind);
            let read = path.is_file().then(|| Frame::read(&path))?;
            read.map_err(|error| notes.push(format!("{kind} of a frame are left out: {error}"))).ok()
        };
        let (bonds, mut rays) = (over("bonds"), over("rays"));
        let mut grains = Frame::read(path)?;
        let mut bonds = bonds.map(|bonds| between(&grains, &bonds)).unwrap_or_default();
        if share > 1 {
            bonds.clear();
            thin(&mut grains, share);
            if let Some(rays) = &mut rays {
                thin(rays, share);
            }
        }
        Ok(Self { grains, bonds, rays })
    }
}

/// The grains that bonds join. Bonds have points of their own, in another order, at the same places.
fn between(grains: &Frame, bonds: &Frame) -> Vec<[u32; 2]> {
    let compare = |a: &[f64; 3], b: &[f64; 3]| {
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
    };
    let points = &grains.points;
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_unstable_by(|&a, &b| compare(&points[a as usize], &points[b as usize]));
    let grain = |end: u32| {
        let place = &bonds.points[end as usize];
        order.binary_search_by(|&at| compare(&points[at as usize], place)).ok().map(|at| order[at])
    };
    bonds.lines.iter().filter_map(|&[a, b]| Some([grain(a)?, grain(b)?])).collect()
}

/// Keeps one of `share` points: by their names, so that a grain is in all frames or in none.
fn thin(frame: &mut Frame, share: u64) {
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
}
