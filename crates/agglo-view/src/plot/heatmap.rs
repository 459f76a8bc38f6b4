//! Colors over two axes.

use super::color::viridis;
use super::panel::{FOOT, LEFT, Panel, Shades};
use super::scale::Scale;
use super::svg::{Area, Svg};
use crate::chart::Heatmap;

const EACH: f64 = 360.0;

/// Height with all that belongs to it [px].
pub const HEIGHT: f64 = EACH + 36.0 + FOOT;

/// Draws it from `top` on: each value as a cell that reaches half way to its neighbors.
pub fn draw(map: &Heatmap, svg: &mut Svg, top: f64) {
    let area = Area { left: LEFT, top: top + 66.0, width: 590.0, height: EACH };
    let (across, up) = (edges(&map.columns), edges(&map.rows));
    let y = if map.y.labels.is_empty() { between(&up) } else { Scale::choices(&map.y.labels) };
    let panel = Panel { area, x: between(&across), y };
    let shades = Shades::over(&map.shade, map.values.iter().flatten().copied());
    for (row, values) in map.values.iter().enumerate() {
        for (column, value) in values.iter().enumerate().filter(|(_, value)| value.is_finite()) {
            let corners = [across.get(column..column + 2), up.get(row..row + 2)];
            let [Some(&[left, right]), Some(&[low, high])] = corners else { continue };
            if let (Some([left, top]), Some([right, bottom])) =
                (panel.at([left, high]), panel.at([right, low]))
            {
                let cell = Area { left, top, width: right - left + 0.3, height: bottom - top + 0.3 };
                svg.rect(cell, viridis(shades.part(*value)), 1.0);
            }
        }
    }
    panel.axes(svg, &map.x, &map.y);
    shades.bar(svg, Area { left: area.right() + 22.0, width: 16.0, ..area }, &map.shade);
}

fn between(edges: &[f64]) -> Scale {
    match edges {
        [first, .., last] if last > first => Scale::between(*first, *last),
        _ => Scale::between(0.0, 1.0),
    }
}

/// Half way between neighbors, and as far beyond the outermost.
fn edges(places: &[f64]) -> Vec<f64> {
    let &[first, .., last] = places else {
        return places.iter().flat_map(|place| [place - 0.5, place + 0.5]).collect();
    };
    let middles = places.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let mut edges: Vec<f64> = middles.collect();
    let [before, after] = [2.0 * first - edges[0], 2.0 * last - edges[edges.len() - 1]];
    edges.insert(0, before);
    edges.push(after);
    edges
}
