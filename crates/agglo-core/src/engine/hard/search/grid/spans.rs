//! Stretches of cells along an axis, cut where blocks of 4 x 4 x 4 cells end: the occupied cells of a box are found a block
//! at a time, by the bits that say which cells hold any.

#![allow(clippy::inline_always, reason = "part of the innermost loop of the engine")]

/// Bits of the cells of a block whose coordinate along an axis is one of four, for each choice of the four.
const BITS: [[u64; 16]; 3] = [along(0), along(1), along(2)];

const fn along(axis: u32) -> [u64; 16] {
    let mut all = [0; 16];
    let mut choice = 0;
    while choice < 16 {
        let mut cell = 0;
        while cell < 64 {
            let coordinate = (cell >> (2 * axis)) & 3;
            all[choice] |= ((choice as u64 >> coordinate) & 1) << cell;
            cell += 1;
        }
        choice += 1;
    }
    all
}

/// Cells next to one another along an axis, in one block of an image of the volume.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Span {
    /// What it adds to the number of a block.
    pub block: u32,
    /// The cells of the block whose coordinate lies in it.
    pub bits: u64,
    /// Edges of the volume to add.
    pub image: i8,
}

/// Cells from one to another along an axis, folded into the volume.
#[derive(Clone, Debug)]
pub struct Spans {
    axis: usize,
    /// Cells along the axis.
    count: i32,
    /// What one block further adds to the number of a block.
    stride: u32,
    within: i32,
    left: i32,
    image: i8,
    /// Edges that one round adds.
    round: i8,
}

impl Spans {
    /// Cells `from..=to` of `count` along an axis; what lies beyond the volume is an image where `has_images`.
    #[inline(always)]
    pub fn new(axis: usize, stride: u32, count: i32, (from, to): (i32, i32), has_images: bool) -> Self {
        // Division is slow, and seldom needed.
        let (round, within) = if from >= 0 && from < count {
            (0, from)
        } else {
            (from.div_euclid(count), from.rem_euclid(count))
        };
        let (image, round) = if has_images { (round as i8, 1) } else { (0, 0) };
        Self { axis, count, stride, within, left: to - from + 1, image, round }
    }
}

impl Iterator for Spans {
    type Item = Span;

    #[inline(always)]
    fn next(&mut self) -> Option<Span> {
        if self.left <= 0 {
            return None;
        }
        let first = self.within & 3;
        let cells = (4 - first).min(self.count - self.within).min(self.left);
        let choice = ((1_usize << cells) - 1) << first;
        let span = Span {
            block: (self.within as u32 >> 2) * self.stride,
            bits: BITS[self.axis][choice],
            image: self.image,
        };
        self.left -= cells;
        self.within += cells;
        if self.within == self.count {
            self.within = 0;
            self.image += self.round;
        }
        Some(span)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of a span along its axis, as coordinates within the volume.
    fn cells(span: Span, axis: usize, stride: u32) -> Vec<(u32, i8)> {
        let first = span.block / stride * 4;
        let is_in = |along: u32| span.bits >> (along << (2 * axis)) & 1 == 1;
        (0..4).filter(|&along| is_in(along)).map(|along| (first + along, span.image)).collect()
    }

    #[test]
    fn spans_hold_each_cell_once_with_its_image() {
        for axis in 0..3 {
            for count in [1, 2, 3, 4, 5, 8, 11] {
                for from in -2 * count..2 * count {
                    for to in from - 1..from + 3 * count {
                        let spans = Spans::new(axis, 7, count, (from, to), true);
                        let found: Vec<_> = spans.flat_map(|span| cells(span, axis, 7)).collect();
                        let wanted: Vec<_> = (from..=to)
                            .map(|cell| (cell.rem_euclid(count) as u32, cell.div_euclid(count) as i8))
                            .collect();
                        assert_eq!(found, wanted, "axis {axis}: {from}..={to} of {count}");
                    }
                }
            }
        }
    }

    #[test]
    fn bits_of_a_span_are_a_slab_of_its_block() {
        // Coordinates 1 and 2 of four along each axis: half of the 64 cells, and an eighth where all three meet.
        let slab = |axis| Spans::new(axis, 1, 8, (1, 2), false).next().map_or(0, |span| span.bits);
        for axis in 0..3 {
            assert_eq!(slab(axis).count_ones(), 32);
        }
        let corner = slab(0) & slab(1) & slab(2);
        assert_eq!(corner.count_ones(), 8);
        assert_eq!(corner.trailing_zeros(), 1 + 4 + 16);
    }

    #[test]
    fn without_images_what_lies_beyond_is_folded() {
        let spans = Spans::new(0, 1, 6, (4, 7), false);
        let found: Vec<_> = spans.flat_map(|span| cells(span, 0, 1)).collect();
        assert_eq!(found, [(4, 0), (5, 0), (0, 0), (1, 0)]);
    }
}
