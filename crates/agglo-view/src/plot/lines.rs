//! Lines with bands, in panels one above the other that share their x axis.

use super::Axis;
use super::color::{dashes, named};
use super::panel::{FOOT, LEFT, Panel, RIGHT, legend};
use super::scale::Scale;
use super::svg::{Area, Pen, Svg};

/// A line, with or without a band about it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// What the legend says; empty for no entry.
    pub name: String,
    /// x and y of its points.
    pub points: Vec<[f64; 2]>,
    /// Lower and upper edge of the band at each point; empty for no band.
    pub band: Vec<[f64; 2]>,
}

/// One y axis and its lines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinePanel {
    /// What the y axis stands for.
    pub y: Axis,
    /// The lines, in the order of the legend.
    pub lines: Vec<Line>,
}

/// Lines with bands, in panels one above the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lines {
    /// Title of the picture.
    pub title: String,
    /// What it shows, in words.
    pub description: String,
    /// What the x axis stands for.
    pub x: Axis,
    /// The panels, from the top.
    pub panels: Vec<LinePanel>,
}

impl Lines {
    /// The picture.
    pub fn svg(&self) -> String {
        let each = if self.panels.len() > 1 { 220.0 } else { 320.0 };
        let (head, gap) = (66.0, 36.0 + FOOT);
        let count = self.panels.len() as f64;
        let mut svg = Svg::new(head + count * (each + gap) - 36.0, &self.title, &self.description);
        let all = self.panels.iter().flat_map(|panel| &panel.lines).flat_map(|line| &line.points);
        let x = Scale::of(&self.x, all.map(|point| point[0]));
        for (number, panel) in self.panels.iter().enumerate() {
            let top = head + number as f64 * (each + gap);
            let area = Area { left: LEFT, top, width: RIGHT - LEFT, height: each };
            panel.draw(&mut svg, &Panel { area, x: x.clone(), y: panel.scale() }, &self.x);
        }
        svg.finish()
    }
}

impl LinePanel {
    fn scale(&self) -> Scale {
        let values = self.lines.iter().flat_map(|line| line.points.iter().map(|point| point[1]));
        let bands = self.lines.iter().flat_map(|line| line.band.iter().flatten().copied());
        Scale::of(&self.y, values.chain(bands))
    }

    fn draw(&self, svg: &mut Svg, panel: &Panel, x: &Axis) {
        panel.axes(svg, x, &self.y);
        for (number, line) in self.lines.iter().enumerate() {
            let edge = |side: usize| {
                let edges = line.points.iter().zip(&line.band);
                panel.places(edges.map(move |(point, band)| [point[0], band[side]]))
            };
            let (mut lower, upper) = (edge(0), edge(1));
            lower.extend(upper.into_iter().rev());
            if lower.len() > 3 {
                svg.polygon(&lower, named(number), 0.18);
            }
        }
        for (number, line) in self.lines.iter().enumerate() {
            let places = panel.places(line.points.iter().copied());
            svg.path(&places, pen(number));
            if places.len() <= 40 {
                for place in places {
                    svg.dot(place, 3.0, named(number), 1.0);
                }
            }
        }
        let entries: Vec<_> = self.lines.iter().enumerate().map(|(n, line)| (&*line.name, pen(n))).collect();
        legend(svg, panel.area, &entries);
    }
}

fn pen(number: usize) -> Pen<'static> {
    Pen { dashes: dashes(number), ..Pen::new(named(number), 2.0) }
}
