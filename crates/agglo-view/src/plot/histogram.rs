//! Histograms, three in a row.

use super::color::{INK, named};
use super::panel::{FOOT, Panel};
use super::scale::{Scale, with_error};
use super::svg::{Anchor, Area, Pen, Style, Svg, WIDTH};
use crate::chart::{Axis, Histogram};

/// Room above the first row [px].
const HEAD: f64 = 62.0;
/// Room below a row [px].
const GAP: f64 = 24.0 + FOOT;

/// How many stand in a row, and how high they are [px].
fn layout(count: usize) -> (usize, f64) {
    let columns = count.clamp(1, 3);
    (columns, if columns == 1 { 320.0 } else { 170.0 })
}

/// Height of so many [px].
pub fn height(count: usize) -> f64 {
    let (columns, each) = layout(count);
    HEAD + count.div_ceil(columns) as f64 * (each + GAP) - 46.0
}

/// Draws histograms from `top` on.
pub fn draw(svg: &mut Svg, top: f64, histograms: &[&Histogram]) {
    let (columns, each) = layout(histograms.len());
    let share = (WIDTH - 20.0) / columns as f64;
    for (number, histogram) in histograms.iter().enumerate() {
        let [column, row] = [number % columns, number / columns].map(|place| place as f64);
        let (left, top) = (10.0 + column * share + 46.0, top + HEAD + row * (each + GAP));
        draw_one(histogram, svg, Area { left, top, width: share - 62.0, height: each });
    }
}

fn draw_one(histogram: &Histogram, svg: &mut Svg, area: Area) {
    let axis = Axis { is_log: false, ..histogram.axis.clone() };
    let panel = Panel { area, x: Scale::of(&axis, histogram.range), y: heights(histogram) };
    panel.x_marks(svg);
    panel.y_marks(svg);
    bars(histogram, svg, &panel);
    panel.frame(svg);
    let [middle, _] = area.center();
    svg.text([middle, area.bottom() + 42.0], &axis.title(), Style::new(Anchor::Middle));
    let Some([mean, error]) = histogram.mean else { return };
    if let (Some(low), Some(high)) = (panel.at([mean, 0.0]), panel.at([mean, panel.y.high])) {
        svg.line(low, high, Pen { dashes: "5 3", ..Pen::new(INK, 1.5) });
        let text = with_error(mean, error);
        svg.text([middle, area.top - 6.0], &text, Style::new(Anchor::Middle));
    }
}

/// Bars, without marks, between the edges of a panel.
pub fn bars(histogram: &Histogram, svg: &mut Svg, panel: &Panel) {
    let Histogram { range: [low, high], counts, .. } = histogram;
    let width = (high - low) / counts.len().max(1) as f64;
    for (number, &count) in counts.iter().enumerate() {
        let low = low + number as f64 * width;
        let corners = (panel.at([low, count as f64]), panel.at([low + width, 0.0]));
        if let (Some([left, top]), Some([right, bottom])) = corners {
            let area = Area { left, top, width: (right - left - 0.7).max(0.7), height: bottom - top };
            svg.rect(area, named(0), 0.75);
        }
    }
}

/// Scale of the counts.
pub fn heights(histogram: &Histogram) -> Scale {
    Scale::between(0.0, 1.08 * histogram.counts.iter().copied().max().unwrap_or(0).max(1) as f64)
}
