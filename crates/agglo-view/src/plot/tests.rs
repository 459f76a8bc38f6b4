//! Charts of made-up data: they are well-formed, say what they show, and keep to their frame.

use super::*;
use crate::chart::{Axis, Bar, Bars, Candidates, Curves, Heatmap, Look, Place, Reference, Series, Spread};
use crate::plot::svg::short;
use agglo::math::rng::{Purpose, Stream};
use agglo::record::frames::{FieldValues, Frame};

/// Candidates with ten parameters about an optimum, as a search leaves them.
fn candidates(count: usize) -> (Vec<Axis>, Vec<Vec<f64>>, Vec<f64>) {
    let axes = vec![
        Axis::new("v0", "m/s"),
        Axis::new("L", ""),
        Axis::new("density", "kg/m³"),
        Axis::new("hardness", "Pa").log(),
        Axis::new("capacity", "J/kg/K"),
        Axis::choice("law", &["published", "consistent"]),
    ];
    let lows = [20.0, 0.4, 1e3, 1e5, 200.0, 0.0];
    let highs = [200.0, 0.8, 1e4, 1e6, 2000.0, 1.99];
    let mut stream = Stream::new(3, Purpose::Sampling, 0);
    let (mut rows, mut costs) = (Vec::new(), Vec::new());
    for number in 0..count {
        let spread = 1.0 / (1.0 + number as f64 / 60.0);
        let parts: Vec<f64> =
            (0..6).map(|_| (0.4 + spread * (stream.uniform() - 0.4)).clamp(0.0, 1.0)).collect();
        costs.push(0.65 + parts.iter().map(|p| (p - 0.4).powi(2)).sum::<f64>() + 0.01 * stream.normal());
        let mut row: Vec<f64> = (0..6).map(|k| lows[k] + parts[k] * (highs[k] - lows[k])).collect();
        row[3] = 1e5 * 10.0_f64.powf(parts[3]);
        row[5] = (2.0 * parts[5]).floor().min(1.0);
        rows.push(row);
    }
    (axes, rows, costs)
}

fn chart(drawn: Drawn) -> Chart {
    Chart { drawn, ..Chart::default() }
}

fn lines() -> Vec<Chart> {
    let cost = |k: f64| 0.66 + 0.2 * (-k / 6.0).exp();
    let x: Vec<f64> = (0..26).map(f64::from).collect();
    let best: Vec<f64> = x.iter().map(|k| cost(*k)).collect();
    let mean: Vec<f64> = best.iter().map(|cost| cost + 0.05).collect();
    let band = mean.iter().map(|mean| [mean - 0.04, mean + 0.06]).collect();
    let size = best.iter().map(|cost| 1.0 / (1.0 - cost)).collect();
    let panel = |name: &str, series| {
        let (x, y) = (Axis::new("generation", ""), Axis::new(name, ""));
        chart(Drawn::Curves(Curves { x, y, series, references: Vec::new() }))
    };
    let mean = Series { spread: Spread::Band(band), ..Series::new("mean", x.clone(), mean) };
    vec![
        panel("cost", vec![Series::new("best so far", x.clone(), best), mean]),
        panel("radius ratio", vec![Series::new("", x, size)]),
    ]
}

fn staircase() -> Chart {
    let rays: Vec<f64> = vec![1e3, 2e3, 4e3, 8e3, 2e4];
    let offs = [1.0, -0.5, 0.3, 0.2, 0.1];
    let means = rays.iter().zip(offs).map(|(rays, off)| 1.0 + off / rays.sqrt()).collect();
    let errors = rays.iter().map(|rays| 0.5 / rays.sqrt()).collect();
    let reference = |name: &str, at| Reference { name: name.to_owned(), at };
    chart(Drawn::Curves(Curves {
        x: Axis::new("rays", "").log(),
        y: Axis::new("power", "W"),
        series: vec![Series {
            look: Look::Dotted,
            spread: Spread::Errors(errors),
            ..Series::new("", rays, means)
        }],
        references: vec![
            reference("within the tolerance of the last", Place::Heights([0.99, 1.01])),
            reference("settled from", Place::Across(4e3)),
            reference("extrapolated", Place::Height(1.0)),
        ],
    }))
}

fn bars() -> Chart {
    let total = vec![0.5576, 0.4424, 0.2437];
    let around = |values: &[f64]| Spread::Intervals(values.iter().map(|v| [v - 0.03, v + 0.03]).collect());
    let first = vec![0.3139, 0.4424, 0.0];
    chart(Drawn::Bars(Bars {
        label: "parameter".to_owned(),
        names: ["speed", "hardness", "activation energy"].map(str::to_owned).to_vec(),
        axis: Axis::new("share of the variance", ""),
        series: vec![
            Bar { name: "alone".to_owned(), spread: around(&first), values: first },
            Bar { name: "with all others".to_owned(), spread: around(&total), values: total },
        ],
    }))
}

fn front() -> Chart {
    let mut stream = Stream::new(5, Purpose::Sampling, 1);
    let front: Vec<f64> = (0..12).map(|k| f64::from(k) / 11.0).collect();
    let heights = front.iter().map(|t| 1.0 - t.sqrt()).collect();
    let beaten: Vec<f64> = (0..200).map(|_| stream.uniform()).collect();
    let above = beaten.iter().map(|t| 1.0 - t.sqrt() + stream.uniform()).collect();
    let on_front = Series {
        look: Look::StairsAfter,
        spread: Spread::Errors(vec![0.02; 12]),
        x_errors: vec![0.01; 12],
        ..Series::new("front", front, heights)
    };
    chart(Drawn::Curves(Curves {
        x: Axis::new("energy", "J"),
        y: Axis::new("largest fragment", ""),
        series: vec![Series { look: Look::Faint, ..Series::new("beaten", beaten, above) }, on_front],
        references: Vec::new(),
    }))
}

fn map() -> Chart {
    let (columns, rows): (Vec<f64>, Vec<f64>) = ((0..20).map(f64::from).collect(), vec![0.0, 1.0, 2.0]);
    let values = rows.iter().map(|row| columns.iter().map(|x| (x * (row + 1.0)).sin()).collect()).collect();
    let y = Axis::choice("primaries", &["1", "2–3", "4–7"]);
    let (x, shade) = (Axis::new("time", "s"), Axis::new("part of the mass", ""));
    chart(Drawn::Heatmap(Heatmap { x, y, shade, columns, rows, values }))
}

fn all() -> Vec<(&'static str, Vec<Chart>)> {
    let (axes, rows, costs) = candidates(500);
    let cost = Axis::new("cost", "");
    let with_cost = rows.iter().zip(&costs).map(|(row, cost)| [row.as_slice(), &[*cost]].concat()).collect();
    let parallel = Candidates {
        axes: axes.iter().cloned().chain([cost.clone()]).collect(),
        rows: with_cost,
        shade: cost.clone(),
        shades: costs.clone(),
        is_large_good: false,
    };
    let histogram = |axis: usize| {
        let values: Vec<f64> = rows.iter().map(|row| row[axis]).collect();
        let mean = Some([values.iter().sum::<f64>() / 500.0, 0.01]);
        chart(Drawn::Histogram(Histogram { mean, ..Histogram::of(axes[axis].clone(), &values) }))
    };
    let histograms = [0, 1, 2, 4].map(histogram).to_vec();
    let pairs = Candidates { axes, rows, shade: cost, shades: costs, is_large_good: false };
    vec![
        ("lines", lines()),
        ("parallel", vec![chart(Drawn::Parallel(parallel))]),
        ("map", vec![map()]),
        ("histograms", histograms),
        ("pairs", vec![chart(Drawn::Pairs(pairs))]),
        ("staircase", vec![staircase()]),
        ("bars", vec![bars()]),
        ("front", vec![front()]),
    ]
}

/// All tags are closed, in order; no number is missing.
fn check_form(name: &str, svg: &str) {
    let mut open = Vec::new();
    for part in svg.split('<').skip(1) {
        let tag = part.split(['>', ' ', '/']).next().unwrap();
        if let Some(closed) = part.strip_prefix('/') {
            assert_eq!(open.pop(), closed.split('>').next(), "{name}");
        } else if !part.split('>').next().unwrap().ends_with('/') {
            open.push(tag);
        }
    }
    assert!(open.is_empty(), "{name}: {open:?}");
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
    assert!(svg.contains("<title id=\"title\">") && svg.contains("<desc id=\"description\">"), "{name}");
}

/// No line or dot lies outside of the picture.
fn check_frame(name: &str, svg: &str) {
    let height: f64 = svg.split("height=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    for (attribute, most) in
        [("x1", 800.0), ("x2", 800.0), ("cx", 800.0), ("y1", height), ("y2", height), ("cy", height)]
    {
        for found in svg.split(&format!(" {attribute}=\"")).skip(1) {
            let value: f64 = found.split('"').next().unwrap().parse().unwrap();
            assert!((0.0..=most).contains(&value), "{name} {attribute} {value}");
        }
    }
}

/// With `AGGLO_PICTURES` set to a folder, the charts are left there to be looked at.
#[test]
fn charts_are_well_formed() {
    for (name, charts) in all() {
        let svg = picture(name, "What it shows.", &charts);
        check_form(name, &svg);
        check_frame(name, &svg);
        if let Some(folder) = std::env::var_os("AGGLO_PICTURES") {
            std::fs::write(std::path::Path::new(&folder).join(format!("{name}.svg")), svg).unwrap();
        }
    }
}

fn alone(drawn: Drawn) -> String {
    picture("", "", &[chart(drawn)])
}

/// A dot is where its values say: the middle of the axes is the middle of the panel, on a logarithmic axis by ratios.
#[test]
fn dots_are_where_their_values_say() {
    let series =
        Series { look: Look::Points, ..Series::new("", vec![1.0, 10.0, 100.0], vec![-1.0, 0.0, 1.0]) };
    let x = Axis::new("x", "").log();
    let svg = alone(Drawn::Curves(Curves { x, series: vec![series], ..Curves::default() }));
    let middle = svg.split("<circle ").nth(2).unwrap();
    // The panel reaches from 92 to 776 and from 66 to 406.
    assert!(middle.starts_with("cx=\"434\" cy=\"236\""), "{middle}");
}

/// A bar reaches from nothing to its value, and its interval from one end to the other.
#[test]
fn bars_are_as_long_as_their_values_say() {
    let spread = Spread::Intervals(vec![[0.25, 1.0]]);
    let series = vec![Bar { name: String::new(), values: vec![0.5], spread }];
    let svg = alone(Drawn::Bars(Bars { names: vec![String::new()], series, ..Bars::default() }));
    let scale = Scale::over([0.5, 0.25, 1.0], false).with(0.0);
    // The panel reaches from 60 to 776.
    let [zero, low, value, high] = [0.0, 0.25, 0.5, 1.0].map(|value| 60.0 + 716.0 * scale.part(value));
    assert_near!((value - zero) / (high - low), 0.5 / 0.75, 1e-12);
    assert_contains!(svg, &format!("<rect x=\"{}\"", short(zero)));
    assert_contains!(svg, &format!("width=\"{}\" height=\"14\"", short(value - zero)));
    for [from, to] in [[low, high], [low, low], [high, high]] {
        let [from, to] = [from, to].map(short);
        let line = svg.split("<line ").find(|line| {
            line.starts_with(&format!("x1=\"{from}\"")) && line.contains(&format!("x2=\"{to}\""))
        });
        assert!(line.is_some(), "no line from {from} to {to} in {svg}");
    }
}

/// A cell reaches half way to its neighbors, and its color is that of its value.
#[test]
fn cells_are_as_large_as_their_places_say() {
    let map = Heatmap {
        columns: vec![0.0, 1.0, 3.0],
        rows: vec![0.0, 1.0],
        values: vec![vec![0.0, 1.0, f64::NAN], vec![0.5, 0.0, 1.0]],
        ..Heatmap::default()
    };
    let svg = alone(Drawn::Heatmap(map));
    // From -0.5 over 0.5 and 2 to 4 in 590 pixels from 92 on; what is no number is left out.
    let cells: Vec<&str> = svg.split("<rect ").filter(|rect| rect.contains("height=\"180.3\"")).collect();
    assert_eq!(cells.len(), 5, "cells of {svg}");
    let edge = |value: f64| short(92.0 + 590.0 * (value + 0.5) / 4.5);
    for (cell, left) in cells.iter().zip([-0.5, 0.5, -0.5, 0.5, 2.0]) {
        assert!(cell.starts_with(&format!("x=\"{}\"", edge(left))), "from {left}: {cell}");
    }
}

/// Numbers are as they stand, and a vector is as long as it is.
#[test]
fn quantities_of_vectors_are_their_lengths() {
    let quantity = Quantity::ALL.into_iter().find(|quantity| quantity.field == "velocity_m_s").unwrap();
    let vectors = vec![[2.0, 3.0, 6.0], [-1.0, 2.0, -2.0], [0.0, -4.0, 3.0]];
    let fields = vec![("velocity_m_s".to_owned(), FieldValues::Vectors(vectors))];
    let frame = Frame { fields, ..Frame::default() };
    assert_eq!(quantity.of(&frame), Some(vec![7.0, 3.0, 5.0]));
    assert_none!(quantity.of(&Frame::default()));
}

#[test]
fn nothing_to_show_is_no_trouble() {
    let empty_bars = Bars { series: vec![Bar::default()], names: vec![String::new()], ..Bars::default() };
    let unknown = Series::new("a", vec![f64::NAN], vec![1.0]);
    let two = Candidates { axes: vec![Axis::default(); 2], ..Candidates::default() };
    let empty = [
        Drawn::Curves(Curves::default()),
        Drawn::Curves(Curves { series: vec![Series::default(), unknown], ..Curves::default() }),
        Drawn::Bars(Bars::default()),
        Drawn::Bars(empty_bars),
        Drawn::Heatmap(Heatmap::default()),
        Drawn::Heatmap(Heatmap { rows: vec![1.0], values: vec![Vec::new()], ..Heatmap::default() }),
        Drawn::Histogram(Histogram::default()),
        Drawn::Parallel(Candidates::default()),
        Drawn::Parallel(two.clone()),
        Drawn::Pairs(Candidates::default()),
        Drawn::Pairs(two),
    ];
    for drawn in empty {
        check_form(&format!("{drawn:?}"), &alone(drawn.clone()));
    }
    check_form("no chart", &picture("", "", &[]));
}

#[test]
fn words_cannot_break_the_file() {
    assert_contains!(picture("a < b & \"c\"\u{7}", "", &lines()), "a &lt; b &amp; &quot;c&quot; <");
}
