//! Every parameter against every other, in a lower triangle, with the distribution of each on the diagonal.

use super::Axis;
use super::color::{GRID, INK, viridis};
use super::histogram::Histogram;
use super::panel::{Panel, Shades};
use super::scale::Scale;
use super::svg::{Anchor, Area, Pen, Style, Svg, text_width};

/// Candidates in all pairs of their parameters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pairs {
    /// Title of the picture.
    pub title: String,
    /// What it shows, in words.
    pub description: String,
    /// What the parameters are.
    pub axes: Vec<Axis>,
    /// One value for each axis, for each candidate.
    pub rows: Vec<Vec<f64>>,
    /// What the colors stand for.
    pub shade: Axis,
    /// The value that gives each candidate its color.
    pub shades: Vec<f64>,
    /// Whether large color values are good, and not small ones.
    pub is_large_first: bool,
}

/// Where the cells are [px].
const LEFT: f64 = 84.0;
const TOP: f64 = 54.0;
const REACH: f64 = 700.0;
const SMALL: f64 = 11.0;

impl Pairs {
    /// The picture; candidates with good color values lie on top.
    pub fn svg(&self) -> String {
        let mut svg = Svg::new(TOP + REACH + 66.0, &self.title, &self.description);
        if self.axes.is_empty() {
            return svg.finish();
        }
        let mut order: Vec<usize> = (0..self.rows.len().min(self.shades.len())).collect();
        order.retain(|&index| self.rows[index].len() == self.axes.len() && self.shades[index].is_finite());
        order.sort_by(|&a, &b| self.shades[b].total_cmp(&self.shades[a]));
        if self.is_large_first {
            order.reverse();
        }
        let shades = Shades::over(&self.shade, order.iter().map(|&index| self.shades[index]));
        let scales: Vec<Scale> = (0..self.axes.len())
            .map(|axis| Scale::of(&self.axes[axis], order.iter().map(|&index| self.rows[index][axis])))
            .collect();
        for row in 0..self.axes.len() {
            for column in 0..row {
                self.cell(&mut svg, [column, row], &scales, &order, &shades);
            }
            self.diagonal(&mut svg, row, &scales[row], &order);
            self.names(&mut svg, row, &scales[row]);
        }
        if self.axes.len() > 1 {
            let bar = Area { left: 700.0, top: TOP + 40.0, width: 16.0, height: 0.26 * REACH };
            shades.bar(&mut svg, bar, &self.shade);
        }
        svg.finish()
    }

    fn area(&self, column: usize, row: usize) -> Area {
        let each = REACH / self.axes.len() as f64;
        let gap = (0.06 * each).min(8.0);
        Area {
            left: LEFT + column as f64 * each,
            top: TOP + row as f64 * each,
            width: each - gap,
            height: each - gap,
        }
    }

    fn cell(
        &self,
        svg: &mut Svg,
        [column, row]: [usize; 2],
        scales: &[Scale],
        order: &[usize],
        shades: &Shades,
    ) {
        let panel = Panel { area: self.area(column, row), x: scales[column].clone(), y: scales[row].clone() };
        border(svg, panel.area);
        let radius = (panel.area.width / 40.0).clamp(1.6, 3.5);
        for &index in order {
            if let Some(place) = panel.at([self.rows[index][column], self.rows[index][row]]) {
                svg.dot(place, radius, viridis(shades.part(self.shades[index])), 0.9);
            }
        }
    }

    /// Values of one parameter; bins of equal width on its own scale.
    fn diagonal(&self, svg: &mut Svg, number: usize, scale: &Scale, order: &[usize]) {
        let area = self.area(number, number);
        border(svg, area);
        let parts: Vec<f64> = order.iter().map(|&index| scale.part(self.rows[index][number])).collect();
        let choices = self.axes[number].labels.len();
        let histogram = Histogram::of(Axis::default(), &parts);
        let histogram = if choices == 0 { histogram } else { bins_of_choices(&parts, choices) };
        let panel = Panel { area, x: Scale::between(0.0, 1.0), y: histogram.heights() };
        histogram.bars(svg, &panel);
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
