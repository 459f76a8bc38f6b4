//! Points, colored by a third value.

use super::Axis;
use super::color::{named, viridis};
use super::panel::{FOOT, LEFT, Panel, RIGHT, Shades};
use super::scale::Scale;
use super::svg::{Area, Svg};

/// Points over two axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scatter {
    /// Title of the picture.
    pub title: String,
    /// What it shows, in words.
    pub description: String,
    /// What the axes stand for.
    pub x: Axis,
    /// What the axes stand for.
    pub y: Axis,
    /// x and y of each point.
    pub points: Vec<[f64; 2]>,
    /// What the colors stand for.
    pub shade: Axis,
    /// The value that gives each point its color; empty for one color.
    pub shades: Vec<f64>,
}

impl Scatter {
    /// The picture; points with small color values lie on top.
    pub fn svg(&self) -> String {
        let mut svg = Svg::new(66.0 + 360.0 + FOOT, &self.title, &self.description);
        let is_shaded = self.shades.len() == self.points.len() && !self.points.is_empty();
        let width = if is_shaded { 590.0 } else { RIGHT - LEFT };
        let area = Area { left: LEFT, top: 66.0, width, height: 360.0 };
        let x = Scale::of(&self.x, self.points.iter().map(|point| point[0]));
        let y = Scale::of(&self.y, self.points.iter().map(|point| point[1]));
        let panel = Panel { area, x, y };
        panel.axes(&mut svg, &self.x, &self.y);
        let shades = Shades::over(&self.shade, self.shades.iter().copied());
        let mut order: Vec<usize> = (0..self.points.len()).collect();
        if is_shaded {
            order.sort_by(|&a, &b| self.shades[b].total_cmp(&self.shades[a]));
            let bar = Area { left: area.right() + 22.0, width: 16.0, ..area };
            shades.bar(&mut svg, bar, &self.shade);
        }
        for index in order {
            let color = if is_shaded { viridis(shades.part(self.shades[index])) } else { named(0) };
            if let Some(place) = panel.at(self.points[index]) {
                svg.dot(place, 4.0, color, 0.9);
            }
        }
        svg.finish()
    }
}
