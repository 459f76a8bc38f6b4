//! A picture in the cells of a terminal: two pixels a cell, one above the other.

use agglo_view::render::Image;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Color;

/// How many colors the terminal has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Depth {
    /// All of 24 bits.
    Full,
    /// 256: a cube of 6 x 6 x 6, and grays.
    Indexed,
}

impl Depth {
    /// What the terminal says of itself.
    pub fn of_terminal() -> Self {
        let said = std::env::var("COLORTERM").unwrap_or_default();
        if matches!(said.as_str(), "truecolor" | "24bit") { Self::Full } else { Self::Indexed }
    }

    /// The terminal's color for red, green and blue.
    pub fn color(self, [r, g, b]: [u8; 3]) -> Color {
        match self {
            Self::Full => Color::Rgb(r, g, b),
            Self::Indexed => Color::Indexed(indexed([r, g, b])),
        }
    }
}

/// The nearest of the 240 fixed colors. The cube's levels are 0, 95, 135, 175, 215 and 255, the grays 8, 18 ... 238.
fn indexed(color: [u8; 3]) -> u8 {
    const LEVELS: [u8; 6] = [0, 95, 135, 175, 215, 255];
    let nearest = |part: u8| {
        let apart = |level: &usize| LEVELS[*level].abs_diff(part);
        (0..6).min_by_key(apart).unwrap_or(0)
    };
    let [r, g, b] = color.map(nearest);
    let mean = color.iter().map(|&part| u32::from(part)).sum::<u32>() / 3;
    let step = (mean.saturating_sub(3) / 10).min(23) as u8;
    let gray = 8 + 10 * step;
    let far = |other: [u8; 3]| -> u32 {
        color.iter().zip(other).map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    if far([gray; 3]) < far([LEVELS[r], LEVELS[g], LEVELS[b]]) {
        232 + step
    } else {
        (16 + 36 * r + 6 * g + b) as u8
    }
}

/// Draws an image of one pixel a column and two a row into an area. What is transparent stays as it is.
pub(super) fn draw(image: &Image, depth: Depth, area: Rect, buffer: &mut Buffer) {
    let [width, height] = image.size();
    for y in 0..area.height.min((height / 2) as u16) {
        for x in 0..area.width.min(width as u16) {
            let of = |row: u32| {
                let [r, g, b, cover] = image.pixel(u32::from(x), row);
                // On a dark terminal, what covers half of a pixel is half as bright.
                let faded = |part: u8| (u32::from(part) * u32::from(cover) / 255) as u8;
                (cover > 40).then(|| depth.color([r, g, b].map(faded)))
            };
            let [upper, lower] = [of(2 * u32::from(y)), of(2 * u32::from(y) + 1)];
            let cell = &mut buffer[(area.x + x, area.y + y)];
            match (upper, lower) {
                (None, None) => {}
                (Some(color), None) => {
                    cell.set_char('▀').set_fg(color);
                }
                (None, Some(color)) => {
                    cell.set_char('▄').set_fg(color);
                }
                (Some(upper), Some(lower)) => {
                    cell.set_char('▀').set_fg(upper).set_bg(lower);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fixed_colors_stand_for_the_nearest() {
        // The corners of the cube, a gray between its levels, and one beside them.
        assert_eq!((indexed([0, 0, 0]), indexed([255, 255, 255])), (16, 231));
        assert_eq!((indexed([255, 0, 0]), indexed([0, 95, 135])), (196, 16 + 6 + 2));
        assert_eq!((indexed([118, 118, 118]), indexed([120, 117, 117])), (243, 243));
    }
}
