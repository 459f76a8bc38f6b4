//! Charts of made-up data: they are well-formed, say what they show, and keep to their frame.

use super::*;
use crate::plot::scale::Scale;
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

fn lines() -> Lines {
    let cost = |k: f64| 0.66 + 0.2 * (-k / 6.0).exp();
    let band = (0..26).map(|k| [f64::from(k), cost(f64::from(k)) + 0.05]);
    let mean = Line {
        name: "mean".to_owned(),
        points: band.clone().collect(),
        band: band.map(|[_, c]| [c - 0.04, c + 0.06]).collect(),
    };
    let best = (0..26).map(|k| [f64::from(k), cost(f64::from(k))]).collect();
    let best = Line { name: "best so far".to_owned(), points: best, band: Vec::new() };
    let size = Line {
        points: (0..26).map(|k| [f64::from(k), 1.0 / (1.0 - cost(f64::from(k)))]).collect(),
        ..Line::default()
    };
    Lines {
        title: "Cost in each generation".to_owned(),
        description: "The cost falls from 0.86 to 0.66.".to_owned(),
        x: Axis::new("generation", ""),
        panels: vec![
            LinePanel { y: Axis::new("cost", ""), lines: vec![best, mean] },
            LinePanel { y: Axis::new("radius ratio", ""), lines: vec![size] },
        ],
    }
}

fn staircase() -> Staircase {
    let level = |rays: f64, sign: f64| Level {
        fineness: rays,
        mean: 1.0 + sign / rays.sqrt(),
        standard_error: 0.5 / rays.sqrt(),
    };
    let levels =
        [(1e3, 1.0), (2e3, -0.5), (4e3, 0.3), (8e3, 0.2), (2e4, 0.1)].map(|(rays, sign)| level(rays, sign));
    Staircase {
        title: "Power absorbed against the number of rays".to_owned(),
        description: "It settles at 4,000 rays.".to_owned(),
        x: Axis::new("rays", "").log(),
        panels: vec![(
            Axis::new("power", "W"),
            levels.to_vec(),
            Settled { value: 1.0007, tolerance: 0.01, from: Some(4e3), limit: Some(1.0) },
        )],
    }
}

fn bars() -> Bars {
    let total = vec![0.5576, 0.4424, 0.2437];
    let around = |values: &[f64]| values.iter().map(|v| [v - 0.03, v + 0.03]).collect();
    let first = vec![0.3139, 0.4424, 0.0];
    Bars {
        title: "Shares of the variance of the cost".to_owned(),
        description: "Sobol indices.".to_owned(),
        axis: Axis::new("share of the variance", ""),
        names: ["speed", "hardness", "activation energy"].map(str::to_owned).to_vec(),
        series: vec![
            Series { name: "alone".to_owned(), intervals: around(&first), values: first },
            Series { name: "with all others".to_owned(), intervals: around(&total), values: total },
        ],
    }
}

fn front() -> Front {
    let mut stream = Stream::new(5, Purpose::Sampling, 1);
    let mut points: Vec<FrontPoint> = (0..12)
        .map(|k| f64::from(k) / 11.0)
        .map(|t| FrontPoint { costs: [t, 1.0 - t.sqrt()], standard_errors: [0.01, 0.02], is_on_front: true })
        .collect();
    points.extend((0..200).map(|_| {
        let t = stream.uniform();
        FrontPoint { costs: [t, 1.0 - t.sqrt() + stream.uniform()], ..FrontPoint::default() }
    }));
    Front {
        title: "Two costs".to_owned(),
        description: "The front.".to_owned(),
        x: Axis::new("energy", "J"),
        y: Axis::new("largest fragment", ""),
        points,
        is_large_right: false,
    }
}

fn all() -> Vec<(&'static str, String)> {
    let (axes, rows, costs) = candidates(500);
    let cost = Axis::new("cost", "");
    let with_cost = rows.iter().zip(&costs).map(|(row, cost)| [row.as_slice(), &[*cost]].concat()).collect();
    let parallel = Parallel {
        title: "All candidates".to_owned(),
        description: "Each line a candidate.".to_owned(),
        axes: axes.iter().cloned().chain([cost.clone()]).collect(),
        rows: with_cost,
        ..Parallel::default()
    };
    let scatter = Scatter {
        title: "Cost against hardness".to_owned(),
        description: "Cost falls with hardness.".to_owned(),
        x: axes[3].clone(),
        y: axes[0].clone(),
        points: rows.iter().map(|row| [row[3], row[0]]).collect(),
        shade: cost.clone(),
        shades: costs.clone(),
    };
    let histogram = |axis: usize| {
        let values: Vec<f64> = rows.iter().map(|row| row[axis]).collect();
        Histogram {
            mean: Some([values.iter().sum::<f64>() / 500.0, 0.01]),
            ..Histogram::of(axes[axis].clone(), &values)
        }
    };
    let histograms = Histograms {
        title: "Measures".to_owned(),
        description: "How measures are distributed.".to_owned(),
        panels: [0, 1, 2, 4].map(histogram).to_vec(),
    };
    let pairs = Pairs {
        title: "The good region".to_owned(),
        description: "Every pair of parameters.".to_owned(),
        axes,
        rows,
        shade: cost,
        shades: costs,
        ..Pairs::default()
    };
    vec![
        ("lines", lines().svg()),
        ("parallel", parallel.svg()),
        ("scatter", scatter.svg()),
        ("histograms", histograms.svg()),
        ("pairs", pairs.svg()),
        ("staircase", staircase().svg()),
        ("bars", bars().svg()),
        ("front", front().svg()),
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
    for (name, svg) in all() {
        check_form(name, &svg);
        check_frame(name, &svg);
        if let Some(folder) = std::env::var_os("AGGLO_PICTURES") {
            std::fs::write(std::path::Path::new(&folder).join(format!("{name}.svg")), svg).unwrap();
        }
    }
}

/// A dot is where its values say: the middle of the axes is the middle of the panel, on a logarithmic axis by ratios.
#[test]
fn dots_are_where_their_values_say() {
    let scatter = Scatter {
        x: Axis::new("x", "").log(),
        points: vec![[1.0, -1.0], [10.0, 0.0], [100.0, 1.0]],
        ..Scatter::default()
    };
    let svg = scatter.svg();
    let middle = svg.split("<circle ").nth(2).unwrap();
    // The panel reaches from 92 to 776 and from 66 to 426.
    assert!(middle.starts_with("cx=\"434\" cy=\"246\""), "{middle}");
}

/// A bar reaches from nothing to its value, and its interval from one end to the other.
#[test]
fn bars_are_as_long_as_their_values_say() {
    let series = Series { name: String::new(), values: vec![0.5], intervals: vec![[0.25, 1.0]] };
    let bars = Bars { names: vec![String::new()], series: vec![series], ..Bars::default() };
    let scale = Scale::over([0.5, 0.25, 1.0], false).with(0.0);
    // The panel reaches from 60 to 776.
    let [zero, low, value, high] = [0.0, 0.25, 0.5, 1.0].map(|value| 60.0 + 716.0 * scale.part(value));
    assert_near!((value - zero) / (high - low), 0.5 / 0.75, 1e-12);
    let svg = bars.svg();
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
    let empty = [
        Lines::default().svg(),
        Lines { panels: vec![LinePanel::default()], ..Lines::default() }.svg(),
        Parallel::default().svg(),
        Parallel { axes: vec![Axis::default()], ..Parallel::default() }.svg(),
        Scatter::default().svg(),
        Scatter { points: vec![[f64::NAN, 1.0]], ..Scatter::default() }.svg(),
        Histograms::default().svg(),
        Histograms { panels: vec![Histogram::default()], ..Histograms::default() }.svg(),
        Pairs::default().svg(),
        Pairs { axes: vec![Axis::default(); 2], ..Pairs::default() }.svg(),
        Staircase { panels: vec![Default::default()], ..Staircase::default() }.svg(),
        Bars::default().svg(),
        Front::default().svg(),
    ];
    for (number, svg) in empty.iter().enumerate() {
        check_form(&number.to_string(), svg);
    }
}

#[test]
fn words_cannot_break_the_file() {
    let lines = Lines { title: "a < b & \"c\"\u{7}".to_owned(), ..Lines::default() };
    assert_contains!(lines.svg(), "a &lt; b &amp; &quot;c&quot; <");
}
