//! Every parameter against every other, in a lower triangle, with the distribution of each on the diagonal.

use super::color::{GRID, INK, viridis};
use super::histogram::{bars, heights};
use super::panel::{Panel, Shades};
use super::scale::Scale;
use super::svg::{Anchor, Area, Pen, Style, Svg, text_width};
use crate::chart::{Axis, Candidates, Histogram};

/// Where the cells are [px].
const LEFT: f64 = 84.0;
const TOP: f64 = 54.0;
const REACH: f64 = 700.0;
const SMALL: f64 = 11.0;

/// Height with all that belongs to it [px].
pub const HEIGHT: f64 = TOP + REACH + 36.0;

/// What is drawn, and from where on.
struct Pairs<'a> {
    axes: &'a [Axis],
    /// Candidates and their color values, the best last.
    rows: Vec<(&'a Vec<f64>, f64)>,
    top: f64,
}

/// Draws them from `top` on; candidates with good color values lie on top.
pub fn draw(candidates: &Candidates, svg: &mut Svg, top: f64) {
    let Candidates { axes, shade, .. } = candidates;
    let mut rows = candidates.ranked();
    rows.reverse();
    let pairs = Pairs { axes, rows, top: top + TOP };
    let shades = Shades::over(shade, pairs.rows.iter().map(|(_, shade)| *shade));
    let column = |axis: usize| pairs.rows.iter().map(move |(row, _)| row[axis]);
    let scales: Vec<Scale> =
        axes.iter().enumerate().map(|(number, axis)| Scale::of(axis, column(number))).collect();
    for row in 0..axes.len() {
        for column in 0..row {
            pairs.cell(svg, [column, row], &scales, &shades);
        }
        pairs.diagonal(svg, row, &scales[row]);
        pairs.names(svg, row, &scales[row]);
    }
    if axes.len() > 1 {
        let bar = Area { left: 700.0, top: pairs.top + 40.0, width: 16.0, height: 0.26 * REACH };
        shades.bar(svg, bar, shade);
    }
}

impl Pairs<'_> {
    fn area(&self, column: usize, row: usize) -> Area {
        let each = REACH / self.axes.len() as f64;
        let gap = (0.06 * each).min(8.0);
        Area {
            left: LEFT + column as f64 * each,
            top: self.top + row as f64 * each,
            width: each - gap,
            height: each - gap,
        }
    }

    fn cell(&self, svg: &mut Svg, [column, row]: [usize; 2], scales: &[Scale], shades: &Shades) {
        let panel = Panel { area: self.area(column, row), x: scales[column].clone(), y: scales[row].clone() };
        border(svg, panel.area);
        let radius = (panel.area.width / 40.0).clamp(1.6, 3.5);
        for (values, shade) in &self.rows {
            if let Some(place) = panel.at([values[column], values[row]]) {
                svg.dot(place, radius, viridis(shades.part(*shade)), 0.9);
            }
        }
    }

    /// Values of one parameter; bins of equal width on its own scale.
    fn diagonal(&self, svg: &mut Svg, number: usize, scale: &Scale) {
        let area = self.area(number, number);
        border(svg, area);
        let parts: Vec<f64> = self.rows.iter().map(|(row, _)| scale.part(row[number])).collect();
        let choices = self.axes[number].labels.len();
        let histogram = Histogram::of(Axis::default(), &parts);
        let histogram = if choices == 0 { histogram } else { bins_of_choices(&parts, choices) };
        let panel = Panel { area, x: Scale::between(0.0, 1.0), y: heights(&histogram) };
        bars(&histogram, svg, &panel);
        if self.axes.len() > 1 {
            let style = Style { size: 12.0, is_bold: true, has_rim: true, ..Style::new(Anchor::Middle) };
            svg.text([area.center()[0], area.top - 2.0], &self.axes[number].name, style);
        }
    }

    /// Marks and names at the left and at the bottom.
    fn names(&self, svg: &mut Svg, number: usize, scale: &Scale) {
        let last = self.axes.len() - 1;
        let title = self.axes[number].title();
        let (below, beside) = (self.area(number, last), self.area(0, number));
        let target = (below.width / 60.0).clamp(1.0, 4.0) as usize;
        for tick in scale.ticks(target) {
            let part = scale.part(tick.value);
            let x = below.left + part * below.width;
            svg.line([x, below.bottom()], [x, below.bottom() + 4.0], Pen::new(INK, 1.0));
            let is_wide = text_width(&tick.label, SMALL) > below.width / 2.5;
            let style = if is_wide {
                Style { size: 9.0, turn: -25.0, ..Style::new(Anchor::End) }
            } else {
                Style { size: SMALL, ..Style::new(Anchor::Middle) }
            };
            svg.text([x, below.bottom() + if is_wide { 12.0 } else { 16.0 }], &tick.label, style);
            if number > 0 {
                let y = beside.bottom() - part * beside.height;
                svg.line([beside.left - 4.0, y], [beside.left, y], Pen::new(INK, 1.0));
                let style = Style { size: SMALL, ..Style::new(Anchor::End) };
                svg.text([beside.left - 6.0, y + 4.0], &tick.label, style);
            }
        }
        let size = if text_width(&title, 12.0) < below.width { 12.0 } else { 10.0 };
        // Neighbors with long names stand at two heights.
        let drop =
            if text_width(&title, size) < below.width || number.is_multiple_of(2) { 36.0 } else { 50.0 };
        svg.text(
            [below.center()[0], below.bottom() + drop],
            &title,
            Style { size, ..Style::new(Anchor::Middle) },
        );
        if number > 0 {
            let style = Style { size, turn: -90.0, ..Style::new(Anchor::Middle) };
            svg.text([beside.left - 64.0, beside.center()[1]], &title, style);
        }
    }
}

fn bins_of_choices(parts: &[f64], choices: usize) -> Histogram {
    let mut counts = vec![0_u64; choices];
    for part in parts.iter().filter(|part| part.is_finite()) {
        counts[((part * choices as f64) as usize).min(choices - 1)] += 1;
    }
    Histogram { range: [0.0, 1.0], counts, ..Histogram::default() }
}

fn border(svg: &mut Svg, area: Area) {
    let (right, bottom) = (area.right(), area.bottom());
    let corners = [
        [area.left, area.top],
        [right, area.top],
        [right, bottom],
        [area.left, bottom],
        [area.left, area.top],
    ];
    svg.path(&corners, Pen::new(GRID, 1.0));
}
