//! Colors of charts: a map for values, and colors with dashes for names.

use std::fmt;

use super::map::Map;

/// A color: red, green and blue, one byte each, red first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color(pub u32);

impl fmt::Display for Color {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "#{:06x}", self.0)
    }
}

/// Text and axes.
pub(super) const INK: Color = Color(0x22_2222);
/// What is there to compare with.
pub(super) const GREY: Color = Color(0x99_9999);
/// Lines behind the data.
pub(super) const GRID: Color = Color(0xe4_e4e4);
/// The ground.
pub(super) const PAPER: Color = Color(0xff_ffff);

/// The color for a part from 0 (dark violet) to 1 (yellow) of a range of values: equal parts look equally far from each
/// other, in gray as well.
/// ```
/// use agglo_view::plot::viridis;
/// assert_eq!(viridis(0.0).to_string(), "#440154");
/// assert_eq!(viridis(1.0).to_string(), "#fde725");
/// ```
pub fn viridis(part: f64) -> Color {
    Color(Map::Viridis.color(part))
}

/// Colors and dashes (in pixels, as in SVG) of lines and bars that have names, in their order.
///
/// Source: M. Okabe and K. Ito, *Color universal design* (2008); without its yellow, which is too light for lines.
pub const LINES: [(Color, &str); 6] = [
    (Color(0x00_72b2), ""),
    (Color(0xd5_5e00), "7 3"),
    (Color(0x00_9e73), "2 3"),
    (Color(0xcc_79a7), "9 3 2 3"),
    (Color(0xe6_9f00), "4 4"),
    (Color(0x56_b4e9), "1 3"),
];

/// Color of the name with this number.
pub(super) fn named(number: usize) -> Color {
    LINES[number % LINES.len()].0
}

/// Dashes of the name with this number.
pub(super) fn dashes(number: usize) -> &'static str {
    LINES[number % LINES.len()].1
}
