//! Parallel coordinates: each axis a parameter, each line a candidate.
//!
//! Source: A. Inselberg, *The plane with parallel coordinates*, Vis. Comput. 1, 69 (1985).

use super::color::{INK, viridis};
use super::panel::Shades;
use super::scale::Scale;
use super::svg::{Anchor, Area, Pen, Place, Style, Svg, WIDTH, text_width};
use crate::chart::{Axis, Candidates};

/// Most lines that are drawn: the best half of them, and the others from all the rest at equal distances.
const MOST: usize = 1500;
/// Size of the axes' names [px].
const NAME: f64 = 12.0;

/// Height with all that belongs to it [px].
pub const HEIGHT: f64 = 490.0;

/// Draws them from `top` on; candidates with a good color value lie on top.
pub fn draw(candidates: &Candidates, svg: &mut Svg, top: f64) {
    let Candidates { axes, shade, .. } = candidates;
    if axes.is_empty() {
        return;
    }
    let area = Area { left: 60.0, top: top + 112.0, width: WIDTH - 124.0, height: 370.0 };
    let rows = drawn(candidates);
    let column = |index: usize| rows.iter().map(move |(row, _)| row[index]);
    let scales: Vec<Scale> =
        axes.iter().enumerate().map(|(index, axis)| Scale::of(axis, column(index))).collect();
    let shades = Shades::over(shade, rows.iter().map(|(_, shade)| *shade));
    let gap = area.width / (axes.len() - 1).max(1) as f64;
    let across = |index: usize| area.left + gap * index as f64;
    let last = rows.len().saturating_sub(1).max(1) as f64;
    for (rank, (row, shade)) in rows.iter().enumerate().rev() {
        let place = |(index, (scale, value)): (usize, (&Scale, &f64))| {
            [across(index), area.bottom() - scale.part(*value) * area.height]
        };
        let places: Vec<Place> = scales.iter().zip(*row).enumerate().map(place).collect();
        let good = 1.0 - rank as f64 / last;
        let (width, opacity) = (0.8 + 1.2 * good.powi(40), 0.2 + 0.7 * good.powi(20));
        svg.path(&places, Pen { opacity, ..Pen::new(viridis(shades.part(*shade)), width) });
    }
    let is_crowded = axes.iter().any(|axis| text_width(&axis.title(), NAME) > gap);
    for (index, (axis, scale)) in axes.iter().zip(&scales).enumerate() {
        upright(svg, axis, scale, across(index), area);
        let style = if is_crowded {
            Style { size: NAME, turn: -28.0, ..Style::new(Anchor::Start) }
        } else {
            Style { size: NAME, ..Style::new(Anchor::Middle) }
        };
        svg.text([across(index), area.top - 13.0], &axis.title(), style);
    }
}

/// Whole rows with their color values, the best first.
fn drawn(candidates: &Candidates) -> Vec<(&Vec<f64>, f64)> {
    let mut rows = candidates.ranked();
    if rows.len() > MOST {
        let rest = rows.split_off(MOST / 2);
        let stride = rest.len().div_ceil(MOST / 2);
        rows.extend(rest.into_iter().step_by(stride));
    }
    rows
}

/// An axis with its marks at `x`.
fn upright(svg: &mut Svg, axis: &Axis, scale: &Scale, x: f64, area: Area) {
    let is_choice = !axis.labels.is_empty();
    svg.line([x, area.top], [x, area.bottom()], Pen::new(INK, 1.2));
    for tick in scale.ticks(5) {
        let y = area.bottom() - scale.part(tick.value) * area.height;
        svg.line([x - 4.0, y], [x + 4.0, y], Pen::new(INK, 1.0));
        let style = Style { size: 11.0, has_rim: true, is_bold: is_choice, ..Style::new(Anchor::Start) };
        svg.text([x + 6.0, y + 4.0], &tick.label, style);
    }
}
