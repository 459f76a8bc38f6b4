//! Bars with error bars, one group for each name.

use super::Axis;
use super::color::{GRID, INK, named};
use super::panel::{FOOT, legend};
use super::scale::Scale;
use super::svg::{Anchor, Area, FONT, Pen, Style, Svg, WIDTH, text_width};

/// One bar for each name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// What the legend says.
    pub name: String,
    /// One value for each name.
    pub values: Vec<f64>,
    /// Lower and upper end of each value's error bar; empty for none.
    pub intervals: Vec<[f64; 2]>,
}

/// Bars that lie, one group for each name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bars {
    /// Title of the picture.
    pub title: String,
    /// What it shows, in words.
    pub description: String,
    /// What the lengths stand for.
    pub axis: Axis,
    /// Names of the groups, from the top.
    pub names: Vec<String>,
    /// The bars of each group.
    pub series: Vec<Series>,
}

impl Bars {
    /// The picture.
    pub fn svg(&self) -> String {
        let each = 12.0 + 16.0 * self.series.len().max(1) as f64;
        let widest = self.names.iter().map(|name| text_width(name, FONT)).fold(0.0, f64::max);
        let left = (widest + 24.0).clamp(60.0, 300.0);
        let height = each * self.names.len() as f64;
        let area = Area { left, top: 66.0, width: WIDTH - left - 24.0, height };
        let mut svg = Svg::new(area.bottom() + FOOT, &self.title, &self.description);
        let ends = self.series.iter().flat_map(|series| series.intervals.iter().flatten());
        let values = self.series.iter().flat_map(|series| &series.values);
        let scale = Scale::over(values.chain(ends).copied(), false).with(0.0);
        marks(&mut svg, area, &scale);
        let zero = area.left + scale.part(0.0) * area.width;
        for (group, name) in self.names.iter().enumerate() {
            let top = area.top + 6.0 + group as f64 * each;
            svg.text([left - 10.0, top + 0.5 * each - 1.5], name, Style::new(Anchor::End));
            for (number, series) in self.series.iter().enumerate() {
                let top = top + 16.0 * number as f64;
                series.bar(&mut svg, group, number, |value| area.left + scale.part(value) * area.width, top);
            }
        }
        svg.line([zero, area.top], [zero, area.bottom()], Pen::new(INK, 1.2));
        svg.text([area.center()[0], area.bottom() + 46.0], &self.axis.title(), Style::new(Anchor::Middle));
        let entry =
            |(number, series): (usize, &'_ Series)| (series.name.clone(), Pen::new(named(number), 9.0));
        let entries: Vec<(String, Pen<'_>)> = self.series.iter().enumerate().map(entry).collect();
        let entries: Vec<(&str, Pen<'_>)> = entries.iter().map(|(name, pen)| (&**name, *pen)).collect();
        legend(&mut svg, area, &entries);
        svg.finish()
    }
}

impl Series {
    fn bar(&self, svg: &mut Svg, group: usize, number: usize, across: impl Fn(f64) -> f64, top: f64) {
        let Some(&value) = self.values.get(group) else { return };
        if !value.is_finite() {
            return;
        }
        let (zero, end) = (across(0.0), across(value));
        let area = Area { left: zero.min(end), top, width: (end - zero).abs(), height: 14.0 };
        svg.rect(area, named(number), 0.85);
        let Some(&[low, high]) = self.intervals.get(group) else { return };
        if low.is_finite() && high > low {
            let (low, high, middle) = (across(low), across(high), top + 7.0);
            let pen = Pen::new(INK, 1.3);
            svg.line([low, middle], [high, middle], pen);
            for x in [low, high] {
                svg.line([x, middle - 4.0], [x, middle + 4.0], pen);
            }
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
