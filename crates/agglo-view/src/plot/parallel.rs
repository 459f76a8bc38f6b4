//! Parallel coordinates: each axis a parameter, each line a candidate.
//!
//! Source: A. Inselberg, *The plane with parallel coordinates*, Vis. Comput. 1, 69 (1985).

use super::Axis;
use super::color::{INK, viridis};
use super::panel::Shades;
use super::scale::Scale;
use super::svg::{Anchor, Area, Pen, Place, Style, Svg, WIDTH, text_width};

/// Most lines that are drawn: the best half of them, and the others from all the rest at equal distances.
const MOST: usize = 1500;
/// Size of the axes' names [px].
const NAME: f64 = 12.0;

/// Candidates as lines across the axes of their parameters and their cost.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parallel {
    /// Title of the picture.
    pub title: String,
    /// What it shows, in words.
    pub description: String,
    /// What the axes stand for; the last one gives the colors.
    pub axes: Vec<Axis>,
    /// One value for each axis, for each candidate; values that are not finite leave a candidate out.
    pub rows: Vec<Vec<f64>>,
    /// Whether large last values are good, and not small ones.
    pub is_large_first: bool,
}

impl Parallel {
    /// The picture; candidates with a good last value lie on top.
    pub fn svg(&self) -> String {
        let mut svg = Svg::new(520.0, &self.title, &self.description);
        let Some(cost) = self.axes.last() else { return svg.finish() };
        let area = Area { left: 60.0, top: 112.0, width: WIDTH - 124.0, height: 370.0 };
        let rows = self.drawn();
        let column = |index: usize| rows.iter().map(move |row| row[index]);
        let scales: Vec<Scale> =
            self.axes.iter().enumerate().map(|(index, axis)| Scale::of(axis, column(index))).collect();
        let shades = Shades::over(cost, column(self.axes.len() - 1));
        let gap = area.width / (self.axes.len() - 1).max(1) as f64;
        let across = |index: usize| area.left + gap * index as f64;
        let last = rows.len().saturating_sub(1).max(1) as f64;
        for (rank, row) in rows.iter().enumerate().rev() {
            let places: Vec<Place> = scales
                .iter()
                .zip(*row)
                .enumerate()
                .map(|(index, (scale, &value))| {
                    [across(index), area.bottom() - scale.part(value) * area.height]
                })
                .collect();
            let good = 1.0 - rank as f64 / last;
            let color = viridis(shades.part(row[self.axes.len() - 1]));
            let (width, opacity) = (0.8 + 1.2 * good.powi(40), 0.2 + 0.7 * good.powi(20));
            svg.path(&places, Pen { opacity, ..Pen::new(color, width) });
        }
        let is_crowded = self.axes.iter().any(|axis| text_width(&axis.title(), NAME) > gap);
        for (index, (axis, scale)) in self.axes.iter().zip(&scales).enumerate() {
            upright(&mut svg, axis, scale, across(index), area);
            let style = if is_crowded {
                Style { size: NAME, turn: -28.0, ..Style::new(Anchor::Start) }
            } else {
                Style { size: NAME, ..Style::new(Anchor::Middle) }
            };
            svg.text([across(index), area.top - 13.0], &axis.title(), style);
        }
        svg.finish()
    }

    /// Whole rows, the one with the best last value first.
    fn drawn(&self) -> Vec<&Vec<f64>> {
        let is_whole =
            |row: &&Vec<f64>| row.len() == self.axes.len() && row.iter().all(|value| value.is_finite());
        let mut rows: Vec<&Vec<f64>> = self.rows.iter().filter(is_whole).collect();
        rows.sort_by(|a, b| a.last().unwrap_or(&0.0).total_cmp(b.last().unwrap_or(&0.0)));
        if self.is_large_first {
            rows.reverse();
        }
        if rows.len() > MOST {
            let rest = rows.split_off(MOST / 2);
            let stride = rest.len().div_ceil(MOST / 2);
            rows.extend(rest.into_iter().step_by(stride));
        }
        rows
    }
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
