//! Bars that lie, one group for each name.

use super::color::{GRID, INK, named};
use super::panel::{FOOT, legend};
use super::scale::Scale;
use super::svg::{Anchor, Area, FONT, Pen, Style, Svg, WIDTH, text_width};
use crate::chart::{Bar, Bars};

/// Height of a group [px].
fn each(bars: &Bars) -> f64 {
    12.0 + 16.0 * bars.series.len().max(1) as f64
}

/// Height with all that belongs to it [px].
pub fn height(bars: &Bars) -> f64 {
    each(bars) * bars.names.len() as f64 + 36.0 + FOOT
}

/// Draws them from `top` on.
pub fn draw(bars: &Bars, svg: &mut Svg, top: f64) {
    let each = each(bars);
    let widest = bars.names.iter().map(|name| text_width(name, FONT)).fold(0.0, f64::max);
    let left = (widest + 24.0).clamp(60.0, 300.0);
    let height = each * bars.names.len() as f64;
    let area = Area { left, top: top + 66.0, width: WIDTH - left - 24.0, height };
    let ends = |series: &Bar| -> Vec<f64> {
        let of = |(number, value): (usize, &f64)| series.spread.of(number, *value);
        series
            .values
            .iter()
            .enumerate()
            .filter_map(of)
            .flatten()
            .chain(series.values.iter().copied())
            .collect()
    };
    let scale = Scale::over(bars.series.iter().flat_map(ends), false).with(0.0);
    marks(svg, area, &scale);
    let zero = area.left + scale.part(0.0) * area.width;
    for (group, name) in bars.names.iter().enumerate() {
        let top = area.top + 6.0 + group as f64 * each;
        svg.text([left - 10.0, top + 0.5 * each - 1.5], name, Style::new(Anchor::End));
        for (number, series) in bars.series.iter().enumerate() {
            let top = top + 16.0 * number as f64;
            bar(series, svg, [group, number], |value| area.left + scale.part(value) * area.width, top);
        }
    }
    svg.line([zero, area.top], [zero, area.bottom()], Pen::new(INK, 1.2));
    svg.text([area.center()[0], area.bottom() + 46.0], &bars.axis.title(), Style::new(Anchor::Middle));
    let entry = |(number, series): (usize, &'_ Bar)| (series.name.clone(), Pen::new(named(number), 9.0));
    let entries: Vec<(String, Pen<'_>)> = bars.series.iter().enumerate().map(entry).collect();
    let entries: Vec<(&str, Pen<'_>)> = entries.iter().map(|(name, pen)| (&**name, *pen)).collect();
    legend(svg, area, &entries);
}

/// The bar of a group.
fn bar(series: &Bar, svg: &mut Svg, [group, number]: [usize; 2], across: impl Fn(f64) -> f64, top: f64) {
    let Some(value) = series.values.get(group).copied().filter(|value| value.is_finite()) else { return };
    let (zero, end) = (across(0.0), across(value));
    let area = Area { left: zero.min(end), top, width: (end - zero).abs(), height: 14.0 };
    svg.rect(area, named(number), 0.85);
    if let Some(ends) = series.spread.of(group, value) {
        let ([low, high], middle) = (ends.map(across), top + 7.0);
        let pen = Pen::new(INK, 1.3);
        svg.line([low, middle], [high, middle], pen);
        for x in [low, high] {
            svg.line([x, middle - 4.0], [x, middle + 4.0], pen);
        }
    }
}

fn marks(svg: &mut Svg, area: Area, scale: &Scale) {
    for tick in scale.ticks(7) {
        let x = area.left + scale.part(tick.value) * area.width;
        svg.line([x, area.top], [x, area.bottom() + 4.0], Pen::new(GRID, 1.0));
        svg.text([x, area.bottom() + 19.0], &tick.label, Style::new(Anchor::Middle));
    }
}
