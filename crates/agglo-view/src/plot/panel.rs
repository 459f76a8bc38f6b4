//! A pair of axes, and the bar that says what colors mean.

use super::color::{GRID, INK, viridis};
use super::scale::Scale;
use super::svg::{Anchor, Area, FONT, Pen, Place, Style, Svg, text_width};
use crate::chart::Axis;

/// Left edge of panels [px]: room for the marks and the name of the y axis.
pub(super) const LEFT: f64 = 92.0;
/// Right edge of panels that have no color bar [px].
pub(super) const RIGHT: f64 = 776.0;
/// Room for the marks and the name of an x axis [px].
pub(super) const FOOT: f64 = 62.0;

/// A rectangle with an x and a y scale.
#[derive(Clone, Debug)]
pub(super) struct Panel {
    pub area: Area,
    pub x: Scale,
    pub y: Scale,
}

impl Panel {
    /// Where a pair of values is; none if it cannot be shown.
    pub fn at(&self, [x, y]: [f64; 2]) -> Option<Place> {
        let (across, up) = (self.x.part(x), self.y.part(y));
        let place = [self.area.left + across * self.area.width, self.area.bottom() - up * self.area.height];
        (across.is_finite() && up.is_finite()).then_some(place)
    }

    /// Those of the pairs that can be shown.
    pub fn places(&self, pairs: impl IntoIterator<Item = [f64; 2]>) -> Vec<Place> {
        pairs.into_iter().filter_map(|pair| self.at(pair)).collect()
    }

    /// Grid, marks and names; comes before the data.
    pub fn axes(&self, svg: &mut Svg, x: &Axis, y: &Axis) {
        self.x_marks(svg);
        self.y_marks(svg);
        self.frame(svg);
        let [middle, center] = self.area.center();
        svg.text([middle, self.area.bottom() + 46.0], &x.title(), Style::new(Anchor::Middle));
        let turned = Style { turn: -90.0, ..Style::new(Anchor::Middle) };
        svg.text([self.area.left - 68.0, center], &y.title(), turned);
    }

    /// The lines at the left and at the bottom.
    pub fn frame(&self, svg: &mut Svg) {
        let Area { left, top, .. } = self.area;
        let (right, bottom) = (self.area.right(), self.area.bottom());
        svg.path(&[[left, top], [left, bottom], [right, bottom]], Pen::new(INK, 1.0));
    }

    /// Marks of the x axis; turned where they would run into each other.
    pub fn x_marks(&self, svg: &mut Svg) {
        let ticks = self.x.ticks((self.area.width / 90.0).max(2.0) as usize);
        let widest = ticks.iter().map(|tick| text_width(&tick.label, FONT)).fold(0.0, f64::max);
        let is_crowded = widest > self.area.width / ticks.len().max(1) as f64;
        let bottom = self.area.bottom();
        for tick in ticks {
            let x = self.area.left + self.x.part(tick.value) * self.area.width;
            svg.line([x, self.area.top], [x, bottom + 4.0], Pen::new(GRID, 1.0));
            let (style, drop) = if is_crowded {
                (Style { turn: -25.0, ..Style::new(Anchor::End) }, 16.0)
            } else {
                (Style::new(Anchor::Middle), 19.0)
            };
            svg.text([x, bottom + drop], &tick.label, style);
        }
    }

    /// Marks of the y axis.
    pub fn y_marks(&self, svg: &mut Svg) {
        for tick in self.y.ticks((self.area.height / 50.0).max(2.0) as usize) {
            let y = self.area.bottom() - self.y.part(tick.value) * self.area.height;
            svg.line([self.area.left - 4.0, y], [self.area.right(), y], Pen::new(GRID, 1.0));
            svg.text([self.area.left - 8.0, y + 4.5], &tick.label, Style::new(Anchor::End));
        }
    }

    /// A bar from one height to another, with ends.
    pub fn error_bar(&self, svg: &mut Svg, x: f64, [low, high]: [f64; 2], pen: Pen<'_>) {
        // Below zero a logarithmic axis has no place: the bar then ends at the axis.
        let low = self.at([x, low]).or(self.at([x, self.y.low]));
        if let (Some(low), Some(high)) = (low, self.at([x, high])) {
            svg.line(low, high, pen);
            for [x, y] in [low, high] {
                svg.line([x - 4.0, y], [x + 4.0, y], pen);
            }
        }
    }
}

/// Which color a value has: the smallest is dark, the largest yellow.
#[derive(Clone, Debug)]
pub(super) struct Shades {
    scale: Scale,
}

impl Shades {
    pub fn over(axis: &Axis, values: impl IntoIterator<Item = f64>) -> Self {
        Self { scale: Scale::of(axis, values) }
    }

    /// The part of the color map for a value.
    pub fn part(&self, value: f64) -> f64 {
        // The last yellow is too light for a white ground.
        0.95 * self.scale.part(value).clamp(0.0, 1.0)
    }

    /// The bar at the right of a picture.
    pub fn bar(&self, svg: &mut Svg, area: Area, axis: &Axis) {
        const STRIPES: usize = 64;
        let height = area.height / STRIPES as f64;
        for stripe in 0..STRIPES {
            let part = 0.95 * (stripe as f64 + 0.5) / STRIPES as f64;
            let top = area.bottom() - (stripe as f64 + 1.0) * height;
            // A little higher than its share, so that no gap shows between stripes.
            svg.rect(Area { top, height: height + 0.4, ..area }, viridis(part), 1.0);
        }
        for tick in self.scale.ticks((area.height / 50.0) as usize) {
            let y = area.bottom() - self.scale.part(tick.value) * area.height;
            svg.line([area.right(), y], [area.right() + 4.0, y], Pen::new(INK, 1.0));
            svg.text([area.right() + 7.0, y + 4.5], &tick.label, Style::new(Anchor::Start));
        }
        svg.text([area.right() + 20.0, area.top - 12.0], &axis.title(), Style::new(Anchor::End));
    }
}

/// The legend of named lines: samples side by side, from the right end of `area`, above it.
pub(super) fn legend(svg: &mut Svg, area: Area, entries: &[(&str, Pen<'_>)]) {
    let mut right = area.right();
    for (name, pen) in entries.iter().rev().filter(|(name, _)| !name.is_empty()) {
        let y = area.top - 10.0;
        right -= text_width(name, FONT);
        svg.text([right, y], name, Style::new(Anchor::Start));
        right -= 8.0;
        svg.line([right - 26.0, y - 4.0], [right, y - 4.0], *pen);
        right -= 44.0;
    }
}
