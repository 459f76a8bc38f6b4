//! Colours of charts: a map for values, and colours with dashes for names.

use std::fmt;

use super::map::Map;

/// A colour: red, green and blue, one byte each, red first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub u32);

impl fmt::Display for Colour {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "#{:06x}", self.0)
    }
}

/// Text and axes.
pub(super) const INK: Colour = Colour(0x22_2222);
/// What is there to compare with.
pub(super) const GREY: Colour = Colour(0x99_9999);
/// Lines behind the data.
pub(super) const GRID: Colour = Colour(0xe4_e4e4);
/// The ground.
pub(super) const PAPER: Colour = Colour(0xff_ffff);

/// The colour for a part from 0 (dark violet) to 1 (yellow) of a range of values: equal parts look equally far from each
/// other, in grey as well.
/// ```
/// use agglo::plot::viridis;
/// assert_eq!(viridis(0.0).to_string(), "#440154");
/// assert_eq!(viridis(1.0).to_string(), "#fde725");
/// ```
pub fn viridis(part: f64) -> Colour {
    Colour(Map::Viridis.color(part))
}

/// Colours and dashes (in pixels, as in SVG) of lines and bars that have names, in their order.
///
/// Source: M. Okabe and K. Ito, *Color universal design* (2008); without its yellow, which is too light for lines.
pub const LINES: [(Colour, &str); 6] = [
    (Colour(0x00_72b2), ""),
    (Colour(0xd5_5e00), "7 3"),
    (Colour(0x00_9e73), "2 3"),
    (Colour(0xcc_79a7), "9 3 2 3"),
    (Colour(0xe6_9f00), "4 4"),
    (Colour(0x56_b4e9), "1 3"),
];

/// Colour of the name with this number.
pub(super) fn named(number: usize) -> Colour {
    LINES[number % LINES.len()].0
}

/// Dashes of the name with this number.
pub(super) fn dashes(number: usize) -> &'static str {
    LINES[number % LINES.len()].1
}
