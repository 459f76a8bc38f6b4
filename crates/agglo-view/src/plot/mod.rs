//! Charts as SVG text: what is in them is given, nothing is computed but the layout. And what grains can be colored by, for
//! pictures and pages.
//!
//! Colors are told apart by readers with any kind of color vision: the map for values is perceptually uniform, the colors
//! for names come with dashes. Each picture has a title and a text for readers who cannot see it. The same charts are the
//! same text, byte by byte. Fonts are the reader's; room for text is estimated from the number of letters.

mod bars;
mod color;
mod curves;
mod heatmap;
mod histogram;
mod map;
mod pairs;
mod panel;
mod parallel;
mod quantity;
pub(crate) mod scale;
mod svg;
#[cfg(test)]
mod tests;

pub use color::{Color, LINES, viridis};
pub use map::{Map, NAMED, PLAIN, name_color};
pub use quantity::{Coloring, Quantity};

use crate::chart::{Chart, Drawn, Histogram};
use scale::Scale;
use svg::Svg;

/// Room below the last chart [px].
const BELOW: f64 = 30.0;

/// A picture of charts, one below the other, histograms side by side; `description` is for readers who cannot see it. Lines
/// and points share their horizontal axis where it is the same.
pub fn picture(title: &str, description: &str, charts: &[Chart]) -> String {
    let is_alone = charts.len() == 1;
    let histograms: Vec<&Histogram> = charts.iter().filter_map(histogram).collect();
    let others = charts.iter().filter(|chart| histogram(chart).is_none());
    let of_histograms = if histograms.is_empty() { 0.0 } else { histogram::height(histograms.len()) };
    let height: f64 = others.clone().map(|chart| height(&chart.drawn, is_alone)).sum();
    let mut svg = Svg::new(of_histograms + height + BELOW, title, description);
    let mut top = 0.0;
    for chart in others {
        draw(&chart.drawn, charts, &mut svg, top, is_alone);
        top += self::height(&chart.drawn, is_alone);
    }
    if !histograms.is_empty() {
        histogram::draw(&mut svg, top, &histograms);
    }
    svg.finish()
}

fn histogram(chart: &Chart) -> Option<&Histogram> {
    if let Drawn::Histogram(histogram) = &chart.drawn { Some(histogram) } else { None }
}

fn height(drawn: &Drawn, is_alone: bool) -> f64 {
    match drawn {
        Drawn::Curves(_) => curves::height(is_alone),
        Drawn::Bars(bars) => bars::height(bars),
        Drawn::Heatmap(_) => heatmap::HEIGHT,
        Drawn::Parallel(_) => parallel::HEIGHT,
        Drawn::Pairs(_) => pairs::HEIGHT,
        Drawn::Histogram(_) => 0.0,
    }
}

fn draw(drawn: &Drawn, all: &[Chart], svg: &mut Svg, top: f64, is_alone: bool) {
    match drawn {
        Drawn::Curves(curves) => {
            let sharing = all.iter().filter_map(|chart| match &chart.drawn {
                Drawn::Curves(other) if other.x == curves.x => Some(other),
                _ => None,
            });
            let x = Scale::of(&curves.x, sharing.flat_map(curves::places));
            curves::draw(curves, svg, top, x, is_alone);
        }
        Drawn::Bars(bars) => bars::draw(bars, svg, top),
        Drawn::Heatmap(map) => heatmap::draw(map, svg, top),
        Drawn::Parallel(candidates) => parallel::draw(candidates, svg, top),
        Drawn::Pairs(candidates) => pairs::draw(candidates, svg, top),
        Drawn::Histogram(_) => {}
    }
}
