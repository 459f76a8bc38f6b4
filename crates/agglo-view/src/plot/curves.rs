//! Lines, points and what they are held against, in a panel.

use super::color::{GREY, INK, dashes, named};
use super::panel::{FOOT, LEFT, Panel, RIGHT, legend};
use super::scale::Scale;
use super::svg::{Area, Pen, Place as Spot, Svg};
use crate::chart::{Curves, Look, Place, Series, Spread};

/// Room above a panel [px].
const HEAD: f64 = 66.0;

/// How high a panel is [px].
fn panel_height(is_alone: bool) -> f64 {
    if is_alone { 340.0 } else { 220.0 }
}

/// Height with all that belongs to it [px].
pub fn height(is_alone: bool) -> f64 {
    panel_height(is_alone) + 36.0 + FOOT
}

/// All horizontal places, with how far they are known.
pub fn places(curves: &Curves) -> impl Iterator<Item = f64> {
    let of_series = curves.series.iter().flat_map(|series| {
        let error = |number: usize| known(series.x_errors.get(number));
        series.x.iter().enumerate().flat_map(move |(number, x)| [x - error(number), x + error(number)])
    });
    let of_references = curves.references.iter().filter_map(|reference| match reference.at {
        Place::Across(x) => Some(x),
        Place::Height(_) | Place::Heights(_) => None,
    });
    of_series.chain(of_references)
}

/// An error, or 0 where it is not known.
fn known(error: Option<&f64>) -> f64 {
    error.copied().filter(|error| error.is_finite()).unwrap_or(0.0)
}

fn heights(curves: &Curves) -> impl Iterator<Item = f64> {
    let of_series = curves.series.iter().flat_map(|series| {
        let ends = |(number, y): (usize, &f64)| series.spread.of(number, *y).unwrap_or([*y, *y]);
        series.y.iter().enumerate().flat_map(move |one| [*one.1].into_iter().chain(ends(one)))
    });
    let of_references = curves.references.iter().flat_map(|reference| match reference.at {
        Place::Height(y) => [y, y],
        Place::Heights(ends) => ends,
        Place::Across(_) => [f64::NAN; 2],
    });
    of_series.chain(of_references)
}

/// Draws a panel from `top` on, over a horizontal axis that others may share.
pub fn draw(curves: &Curves, svg: &mut Svg, top: f64, x: Scale, is_alone: bool) {
    let area = Area { left: LEFT, top: top + HEAD, width: RIGHT - LEFT, height: panel_height(is_alone) };
    let panel = Panel { area, x, y: Scale::of(&curves.y, heights(curves)) };
    panel.axes(svg, &curves.x, &curves.y);
    let mut entries = Vec::new();
    let pens = pens(&curves.series);
    bands(curves, &panel, svg, &pens);
    for (series, pen) in curves.series.iter().zip(&pens) {
        draw_series(series, *pen, &panel, svg);
        let sample = if series.look == Look::Faint { Pen::new(GREY, 4.0) } else { *pen };
        entries.push((series.name.as_str(), sample));
    }
    for reference in &curves.references {
        entries.push((reference.name.as_str(), through(reference.at, &panel, svg)));
    }
    legend(svg, area, &entries);
}

/// The pen of each series: those that stand back are gray.
fn pens(series: &[Series]) -> Vec<Pen<'static>> {
    let mut next = 0;
    let pen = |series: &Series| match series.look {
        Look::Faint => Pen::new(GREY, 1.0),
        look => {
            let number = next;
            next += 1;
            let dashes = if look == Look::Line { dashes(number) } else { "" };
            Pen { dashes, ..Pen::new(named(number), if look == Look::Points { 4.0 } else { 2.0 }) }
        }
    };
    series.iter().map(pen).collect()
}

/// What lies behind all lines.
fn bands(curves: &Curves, panel: &Panel, svg: &mut Svg, pens: &[Pen<'_>]) {
    for reference in &curves.references {
        if let Place::Heights(ends) = reference.at {
            let [bottom, top] = ends.map(|y| panel.area.bottom() - panel.y.part(y) * panel.area.height);
            svg.rect(Area { top, height: (bottom - top).max(0.0), ..panel.area }, named(2), 0.2);
        }
    }
    for (series, pen) in curves.series.iter().zip(pens) {
        let Spread::Band(band) = &series.spread else { continue };
        let edge =
            |side: usize| panel.places(series.x.iter().zip(band).map(move |(x, ends)| [*x, ends[side]]));
        let mut lower = edge(0);
        lower.extend(edge(1).into_iter().rev());
        if lower.len() > 3 {
            svg.polygon(&lower, pen.color, 0.18);
        }
    }
}

fn draw_series(series: &Series, pen: Pen<'_>, panel: &Panel, svg: &mut Svg) {
    let places = panel.places(series.points());
    match series.look {
        Look::Line | Look::Dotted => svg.path(&places, pen),
        Look::StairsAfter | Look::StairsBefore => {
            svg.path(&stairs(&places, series.look == Look::StairsAfter), Pen { width: 1.5, ..pen });
        }
        Look::Points | Look::Faint => {}
    }
    let is_band = matches!(series.spread, Spread::Band(_));
    for (number, [x, y]) in series.points().enumerate().filter(|_| !is_band) {
        let bar = Pen::new(INK, 1.1);
        if let Some([low, high]) = series.spread.of(number, y) {
            panel.error_bar(svg, x, [low, high], bar);
        }
        let error = known(series.x_errors.get(number));
        if let (true, Some(left), Some(right)) =
            (error > 0.0, panel.at([x - error, y]), panel.at([x + error, y]))
        {
            svg.line(left, right, bar);
        }
    }
    let radius = match series.look {
        Look::Line if places.len() > 40 => return,
        Look::Line | Look::Faint => 3.0,
        Look::Points | Look::Dotted | Look::StairsAfter | Look::StairsBefore => 4.5,
    };
    for place in places {
        svg.dot(place, radius, pen.color, if series.look == Look::Faint { 0.7 } else { 1.0 });
    }
}

/// Stairs through places from left to right.
fn stairs(places: &[Spot], keeps_left: bool) -> Vec<Spot> {
    let mut stairs = Vec::with_capacity(2 * places.len());
    for pair in places.windows(2) {
        let [[left, before], [right, after]] = [pair[0], pair[1]];
        stairs.extend([pair[0], if keeps_left { [right, before] } else { [left, after] }]);
    }
    stairs.extend(places.last());
    stairs
}

/// Draws a line all the way through; gives the sample for the legend.
fn through(at: Place, panel: &Panel, svg: &mut Svg) -> Pen<'static> {
    let area = panel.area;
    match at {
        Place::Across(x) => {
            let pen = Pen { dashes: "2 3", ..Pen::new(INK, 1.5) };
            let x = area.left + panel.x.part(x) * area.width;
            svg.line([x, area.top], [x, area.bottom()], pen);
            pen
        }
        Place::Height(y) => {
            let pen = Pen { dashes: "7 3", ..Pen::new(named(1), 1.8) };
            let y = area.bottom() - panel.y.part(y) * area.height;
            svg.line([area.left, y], [area.right(), y], pen);
            pen
        }
        Place::Heights(_) => Pen { opacity: 0.3, ..Pen::new(named(2), 9.0) },
    }
}
