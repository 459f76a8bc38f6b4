//! Two costs against each other, and the front of those that none beats in both.

use super::Axis;
use super::color::{GREY, INK, named};
use super::panel::{FOOT, LEFT, Panel, RIGHT, legend};
use super::scale::Scale;
use super::svg::{Area, Pen, Svg};

/// A candidate with two costs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrontPoint {
    /// The two costs.
    pub costs: [f64; 2],
    /// Their standard errors; 0 where they are not known.
    pub standard_errors: [f64; 2],
    /// Whether no other candidate beats it.
    pub is_on_front: bool,
}

/// Candidates over their two costs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Front {
    /// Title of the picture.
    pub title: String,
    /// What it shows, in words.
    pub description: String,
    /// What the first value is.
    pub x: Axis,
    /// What the second value is.
    pub y: Axis,
    /// The candidates.
    pub points: Vec<FrontPoint>,
    /// Whether the first value is to be large: what lies left of the front is beaten then.
    pub is_large_right: bool,
}

impl Front {
    /// The picture.
    pub fn svg(&self) -> String {
        let area = Area { left: LEFT, top: 66.0, width: RIGHT - LEFT, height: 400.0 };
        let mut svg = Svg::new(area.bottom() + FOOT, &self.title, &self.description);
        let values = |cost: usize| {
            self.points.iter().flat_map(move |point| {
                let error = if point.is_on_front { point.standard_errors[cost] } else { 0.0 };
                [point.costs[cost] - error, point.costs[cost] + error]
            })
        };
        let panel = Panel { area, x: Scale::of(&self.x, values(0)), y: Scale::of(&self.y, values(1)) };
        panel.axes(&mut svg, &self.x, &self.y);
        let mut front: Vec<&FrontPoint> = self.points.iter().filter(|point| point.is_on_front).collect();
        front.sort_by(|a, b| a.costs[0].total_cmp(&b.costs[0]));
        for place in panel.places(self.points.iter().filter(|p| !p.is_on_front).map(|p| p.costs)) {
            svg.dot(place, 3.0, GREY, 0.7);
        }
        let places = panel.places(front.iter().map(|point| point.costs));
        svg.path(&steps(&places, self.is_large_right), Pen::new(named(0), 1.5));
        for point in front {
            panel.error_bar(&mut svg, point.costs, point.standard_errors[1], Pen::new(INK, 1.0));
            across(&mut svg, &panel, point);
            if let Some(place) = panel.at(point.costs) {
                svg.dot(place, 4.5, named(0), 1.0);
            }
        }
        legend(&mut svg, area, &[("front", Pen::new(named(0), 2.0)), ("beaten", Pen::new(GREY, 4.0))]);
        svg.finish()
    }
}

fn across(svg: &mut Svg, panel: &Panel, point: &FrontPoint) {
    let ([x, y], error) = (point.costs, point.standard_errors[0]);
    if let (true, Some(low), Some(high)) = (error > 0.0, panel.at([x - error, y]), panel.at([x + error, y])) {
        svg.line(low, high, Pen::new(INK, 1.0));
    }
}

/// A staircase through places from left to right: its corners are beaten, at the right of a place or at its left.
fn steps(places: &[[f64; 2]], is_large_right: bool) -> Vec<[f64; 2]> {
    let mut stairs = Vec::with_capacity(2 * places.len());
    for pair in places.windows(2) {
        let [[left, before], [right, after]] = [pair[0], pair[1]];
        stairs.extend([pair[0], if is_large_right { [left, after] } else { [right, before] }]);
    }
    stairs.extend(places.last());
    stairs
}
