//! A value against the fineness of the computation, and where it has settled.

use super::Axis;
use super::color::{INK, named};
use super::panel::{FOOT, LEFT, Panel, RIGHT, legend};
use super::scale::Scale;
use super::svg::{Area, Pen, Svg};

/// A value at one level of refinement.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Level {
    /// What is refined: rays, a step, grains; the number of the level where it is a word.
    pub fineness: f64,
    /// Mean of the value.
    pub mean: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// Where a value has settled.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settled {
    /// The value that it has settled at.
    pub value: f64,
    /// How far the later means may be from it.
    pub tolerance: f64,
    /// The first level from which on they are not farther; none if none.
    pub from: Option<f64>,
    /// Extrapolated value, where there is one.
    pub limit: Option<f64>,
}

/// A value at all levels of refinement.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Staircase {
    /// Title of the picture.
    pub title: String,
    /// What it shows, in words.
    pub description: String,
    /// What is refined.
    pub x: Axis,
    /// For each value: what it is, its levels, where it settled.
    pub panels: Vec<(Axis, Vec<Level>, Settled)>,
}

impl Staircase {
    /// The picture.
    pub fn svg(&self) -> String {
        let each = if self.panels.len() > 1 { 200.0 } else { 320.0 };
        let (head, gap) = (66.0, 36.0 + FOOT);
        let mut svg =
            Svg::new(head + self.panels.len() as f64 * (each + gap) - 36.0, &self.title, &self.description);
        for (number, (y, levels, settled)) in self.panels.iter().enumerate() {
            let top = head + number as f64 * (each + gap);
            let area = Area { left: LEFT, top, width: RIGHT - LEFT, height: each };
            let ends = levels.iter().flat_map(|l| [l.mean - l.standard_error, l.mean + l.standard_error]);
            let band = [settled.value - settled.tolerance, settled.value + settled.tolerance];
            let panel = Panel {
                area,
                x: Scale::of(&self.x, levels.iter().map(|level| level.fineness)),
                y: Scale::of(y, ends.chain(band).chain(settled.limit)),
            };
            panel.axes(&mut svg, &self.x, y);
            draw(&mut svg, &panel, levels, settled, band);
        }
        svg.finish()
    }
}

fn draw(svg: &mut Svg, panel: &Panel, levels: &[Level], settled: &Settled, band: [f64; 2]) {
    let area = panel.area;
    let [bottom, top] = band.map(|value| area.bottom() - panel.y.part(value) * area.height);
    let blue = Pen::new(named(0), 2.0);
    let limit = Pen { dashes: "7 3", ..Pen::new(named(1), 1.8) };
    let from = Pen { dashes: "2 3", ..Pen::new(INK, 1.5) };
    svg.rect(Area { top, height: (bottom - top).max(0.0), ..area }, named(2), 0.2);
    let mut entries =
        vec![("within the tolerance of the last", Pen { opacity: 0.3, ..Pen::new(named(2), 9.0) })];
    if let Some(fineness) = settled.from {
        let x = area.left + panel.x.part(fineness) * area.width;
        svg.line([x, area.top], [x, area.bottom()], from);
        entries.push(("settled from", from));
    }
    if let Some(value) = settled.limit {
        let y = area.bottom() - panel.y.part(value) * area.height;
        svg.line([area.left, y], [area.right(), y], limit);
        entries.push(("extrapolated", limit));
    }
    svg.path(&panel.places(levels.iter().map(|level| [level.fineness, level.mean])), blue);
    for level in levels {
        let pair = [level.fineness, level.mean];
        panel.error_bar(svg, pair, level.standard_error, Pen::new(INK, 1.2));
        if let Some(place) = panel.at(pair) {
            svg.dot(place, 4.5, named(0), 1.0);
        }
    }
    legend(svg, area, &entries);
}
