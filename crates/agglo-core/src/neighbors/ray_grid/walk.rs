//! A ray's walk through the cells of a grid.

use super::span::RaySpan;
use crate::math::Vec3;

/// A box cut into cubes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    /// Lower corner of the box [m].
    pub(super) lower: Vec3,
    /// Edge of a cube [m].
    pub(super) size: f64,
    /// Cubes along each axis; none where nothing is in the box.
    pub(super) dims: [usize; 3],
}

/// A ray's walk from cell to cell.
pub(super) struct Walk {
    pub(super) cell: usize,
    /// Distance at which the ray crosses the next face across each axis.
    next: [f64; 3],
    /// From face to face.
    between: [f64; 3],
    stride: [isize; 3],
    /// Cells left before the box ends.
    left: [usize; 3],
}

impl Walk {
    #[inline]
    pub(super) fn new(cells: &Cells, span: &RaySpan, enter: f64) -> Self {
        let start = span.origin + span.direction * enter;
        let mut walk =
            Self { cell: 0, next: [f64::INFINITY; 3], between: [0.0; 3], stride: [0; 3], left: [0; 3] };
        let mut row = 1;
        for axis in 0..3 {
            let dims = cells.dims[axis];
            let place = (((start[axis] - cells.lower[axis]) / cells.size).max(0.0) as usize).min(dims - 1);
            walk.cell += row * place;
            let d = span.direction[axis];
            if d != 0.0 {
                let ahead = d > 0.0;
                let face = cells.lower[axis] + (place + usize::from(ahead)) as f64 * cells.size;
                walk.next[axis] = (face - span.origin[axis]) / d;
                walk.between[axis] = cells.size / d.abs();
                walk.stride[axis] = if ahead { row.cast_signed() } else { -row.cast_signed() };
                walk.left[axis] = if ahead { dims - 1 - place } else { place };
            }
            row *= dims;
        }
        walk
    }

    #[inline]
    fn axis(&self) -> usize {
        let [x, y, z] = self.next;
        if x <= y && x <= z {
            0
        } else if y <= z {
            1
        } else {
            2
        }
    }

    #[inline]
    pub(super) fn next_face(&self) -> f64 {
        self.next[self.axis()]
    }

    /// Goes into the next cell; false if the box ends here.
    #[inline]
    pub(super) fn step(&mut self) -> bool {
        let axis = self.axis();
        if self.left[axis] == 0 {
            return false;
        }
        self.left[axis] -= 1;
        self.next[axis] += self.between[axis];
        self.cell = self.cell.wrapping_add_signed(self.stride[axis]);
        true
    }
}
