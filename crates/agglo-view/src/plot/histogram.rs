//! How often values fall into bins.

use super::Axis;
use super::color::{INK, named};
use super::panel::{FOOT, Panel};
use super::scale::{Scale, with_error};
use super::svg::{Anchor, Area, Pen, Style, Svg, WIDTH};

/// Bins of equal width and how many values each holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Histogram {
    /// What the values are.
    pub axis: Axis,
    /// Where the first bin begins and the last ends.
    pub range: [f64; 2],
    /// Values in each bin.
    pub counts: Vec<u64>,
    /// Mean of the values and its standard error, where they are known.
    pub mean: Option<[f64; 2]>,
}

/// Histograms, three in a row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Histograms {
    /// Title of the picture.
    pub title: String,
    /// What it shows, in words.
    pub description: String,
    /// The histograms.
    pub panels: Vec<Histogram>,
}

impl Histogram {
    /// Bins by the rule of Freedman and Diaconis, 2 IQR/n^(1/3), at least 5 and at most 60; values that are not finite are
    /// left out.
    ///
    /// Source: D. Freedman and P. Diaconis, Z. Wahrscheinlichkeitstheorie 57, 453 (1981).
    pub fn of(axis: Axis, values: &[f64]) -> Self {
        let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (sorted.first(), sorted.last()) else {
            return Self { axis, range: [0.0, 1.0], counts: Vec::new(), mean: None };
        };
        let count = sorted.len() as f64;
        let quartile = |part: f64| sorted[(part * (count - 1.0)).round() as usize];
        let width = 2.0 * (quartile(0.75) - quartile(0.25)) / count.cbrt();
        let bins = if width > 0.0 { ((high - low) / width).ceil().clamp(5.0, 60.0) } else { 5.0 };
        let [low, high] = if high > low { [low, high] } else { [low - 0.5, high + 0.5] };
        let mut counts = vec![0_u64; bins as usize];
        for value in &sorted {
            let bin = ((value - low) / (high - low) * bins) as usize;
            counts[bin.min(bins as usize - 1)] += 1;
        }
        Self { axis, range: [low, high], counts, mean: None }
    }

    /// Bars, without marks, between the edges of a panel.
    pub(super) fn bars(&self, svg: &mut Svg, panel: &Panel) {
        let width = (self.range[1] - self.range[0]) / self.counts.len().max(1) as f64;
        for (number, &count) in self.counts.iter().enumerate() {
            let low = self.range[0] + number as f64 * width;
            let corners = (panel.at([low, count as f64]), panel.at([low + width, 0.0]));
            if let (Some([left, top]), Some([right, bottom])) = corners {
                let area = Area { left, top, width: (right - left - 0.7).max(0.7), height: bottom - top };
                svg.rect(area, named(0), 0.75);
            }
        }
    }

    /// Scale of the counts.
    pub(super) fn heights(&self) -> Scale {
        Scale::between(0.0, 1.08 * self.counts.iter().copied().max().unwrap_or(0).max(1) as f64)
    }

    fn draw(&self, svg: &mut Svg, area: Area) {
        let axis = Axis { is_log: false, ..self.axis.clone() };
        let panel = Panel { area, x: Scale::of(&axis, self.range), y: self.heights() };
        panel.x_marks(svg);
        panel.y_marks(svg);
        self.bars(svg, &panel);
        panel.frame(svg);
        let [middle, _] = area.center();
        svg.text([middle, area.bottom() + 42.0], &axis.title(), Style::new(Anchor::Middle));
        let Some([mean, error]) = self.mean else { return };
        if let (Some(low), Some(high)) = (panel.at([mean, 0.0]), panel.at([mean, panel.y.high])) {
            svg.line(low, high, Pen { dashes: "5 3", ..Pen::new(INK, 1.5) });
            let text = with_error(mean, error);
            svg.text([middle, area.top - 6.0], &text, Style::new(Anchor::Middle));
        }
    }
}

impl Histograms {
    /// The picture.
    pub fn svg(&self) -> String {
        let columns = self.panels.len().clamp(1, 3);
        let rows = self.panels.len().div_ceil(columns).max(1);
        let (head, each, gap) = (62.0, if columns == 1 { 320.0 } else { 170.0 }, 24.0 + FOOT);
        let share = (WIDTH - 20.0) / columns as f64;
        let mut svg = Svg::new(head + rows as f64 * (each + gap) - 16.0, &self.title, &self.description);
        for (number, histogram) in self.panels.iter().enumerate() {
            let [column, row] = [number % columns, number / columns].map(|place| place as f64);
            let (left, top) = (10.0 + column * share + 46.0, head + row * (each + gap));
            histogram.draw(&mut svg, Area { left, top, width: share - 62.0, height: each });
        }
        svg.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_in_one_bin() {
        let values: Vec<f64> = (0..100).map(f64::from).chain([f64::NAN]).collect();
        let histogram = Histogram::of(Axis::new("x", ""), &values);
        assert_eq!(histogram.counts.iter().sum::<u64>(), 100);
        // Quartiles are 50 apart (index 25 and 74: 49), so bins are 2*49/100^(1/3) = 21.1 wide: 99/21.1 = 4.7, so 5.
        assert_eq!(histogram.counts, [20, 20, 20, 20, 20]);
    }

    #[test]
    fn equal_values_and_none() {
        assert_eq!(Histogram::of(Axis::default(), &[2.0; 9]).counts.iter().sum::<u64>(), 9);
        assert_empty!(Histogram::of(Axis::default(), &[]).counts);
    }
}
