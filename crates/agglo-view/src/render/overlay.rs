//! Words over a picture: the legend of colors, a scale, the time.

use super::image::Image;
use super::text::{Align, Writer};
use crate::plot::scale::Scale;
use crate::plot::{Map, Quantity};

/// What the colors mean.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Legend {
    /// A map over values.
    Values {
        title: String,
        map: Map,
        /// Marks: place from 0 to 1, and label.
        marks: Vec<(f64, String)>,
        /// Whether values are below and above the map's ends.
        beyond: [bool; 2],
    },
    /// A list of names.
    Names { title: String, entries: Vec<Entry> },
}

/// A name with its colors.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub label: String,
    pub colors: Vec<u32>,
}

impl Legend {
    pub fn values(quantity: &Quantity, map: Map, [low, high]: [f64; 2], beyond: [bool; 2]) -> Self {
        let largest = low.abs().max(high.abs());
        let (factor, unit) = prefixed(largest, quantity.unit);
        let title =
            if unit.is_empty() { quantity.title.to_owned() } else { format!("{} ({unit})", quantity.title) };
        let scale = Scale::between(low / factor, high / factor);
        let marks = scale.ticks(4).into_iter().map(|tick| (scale.part(tick.value), tick.label)).collect();
        Self::Values { title, map, marks, beyond }
    }

    pub fn names(title: &str, entries: Vec<Entry>) -> Self {
        Self::Names { title: title.to_owned(), entries }
    }
}

/// The size of a unit with the prefix that suits a value, and its name: (1e-6, "µm").
fn prefixed(value: f64, unit: &str) -> (f64, String) {
    const PREFIXES: [(i32, &str); 11] = [
        (-15, "f"),
        (-12, "p"),
        (-9, "n"),
        (-6, "µ"),
        (-3, "m"),
        (0, ""),
        (3, "k"),
        (6, "M"),
        (9, "G"),
        (12, "T"),
        (15, "P"),
    ];
    let takes_prefix = matches!(unit, "m" | "m/s" | "s" | "W" | "C");
    let decade = value.log10().floor();
    // Metres above kilometers are read as powers of ten, seconds above one as seconds.
    let largest = if unit == "s" { 0 } else { 15 };
    let wanted = if decade.is_finite() && takes_prefix { (decade as i32).div_euclid(3) * 3 } else { 0 };
    let wanted = wanted.min(largest);
    let prefix = PREFIXES.iter().find(|(power, _)| *power == wanted);
    prefix.map_or((1.0, unit.to_owned()), |&(power, prefix)| (10_f64.powi(power), format!("{prefix}{unit}")))
}

/// A round length that is about `target` pixels long, in meters, with its label.
fn round_length(pixel: f64, target: f64) -> (f64, String) {
    let longest = pixel * target;
    let power = 10_f64.powf(longest.log10().floor());
    let fits = |mantissa: &&f64| *mantissa * power <= longest * 1.000_001;
    let mantissa = [5.0, 2.0, 1.0].iter().find(fits).copied().unwrap_or(1.0);
    let (factor, unit) = prefixed(mantissa * power * 1.000_001, "m");
    // Both are decimal numbers of few digits; the quotient is one too, but for its rounding.
    (mantissa * power, format!("{} {unit}", (mantissa * power / factor).round()))
}

/// Time in the unit of the last one: "t = 0.350 ms".
fn time_label(time: f64, last: f64) -> String {
    let (factor, unit) = prefixed(last.max(time), "s");
    let size = (last.max(time) / factor).max(1.0);
    let decimals = (3 - size.log10().floor() as i32).clamp(0, 3) as usize;
    format!("t = {:.decimals$} {unit}", time / factor)
}

/// All words over a picture.
#[derive(Clone, Debug)]
pub(super) struct Overlay {
    pub legend: Legend,
    /// Length of a pixel [m] in the middle of what is looked at.
    pub pixel: f64,
    /// Time [s].
    pub time: f64,
    /// The last time of all pictures [s].
    pub last_time: f64,
    pub is_dark: bool,
}

/// Where things stand, in pixels; all lengths go with the picture's size.
struct Layout {
    width: f64,
    height: f64,
    /// Height of a line of text.
    text: f64,
    margin: f64,
    ink: u32,
}

impl Overlay {
    /// Draws them.
    pub fn draw(&self, image: &mut Image) {
        let [width, height] = image.size().map(f64::from);
        let text = (height.min(0.7 * width) / 33.0).max(9.0);
        let ink = if self.is_dark { 0xe8_e8e8 } else { 0x1e_1e1e };
        let layout = Layout { width, height, text, margin: 1.2 * text, ink };
        let writer = Writer::new();
        self.draw_time(image, &writer, &layout);
        self.draw_scale(image, &writer, &layout);
        match &self.legend {
            Legend::Values { title, map, marks, beyond } => {
                draw_map(image, &writer, &layout, title, *map, marks, *beyond);
            }
            Legend::Names { title, entries } => draw_names(image, &writer, &layout, title, entries),
        }
    }

    fn draw_time(&self, image: &mut Image, writer: &Writer, layout: &Layout) {
        let label = time_label(self.time, self.last_time);
        let at = [layout.margin, layout.margin + 0.8 * layout.text];
        writer.write(image, &label, at, Align::Left, (1.15 * layout.text, layout.ink));
    }

    fn draw_scale(&self, image: &mut Image, writer: &Writer, layout: &Layout) {
        let Bar { left, bottom, length, thickness, label } = self.bar(layout);
        image.fill([left, bottom - thickness], [length, thickness], layout.ink);
        let at = [left + 0.5 * length, bottom - thickness - 0.35 * layout.text];
        writer.write(image, &label, at, Align::Middle, (layout.text, layout.ink));
    }

    fn bar(&self, layout: &Layout) -> Bar {
        let (length, label) = round_length(self.pixel, 0.2 * layout.width);
        Bar {
            left: layout.margin.round(),
            bottom: (layout.height - layout.margin).round(),
            length: length / self.pixel,
            thickness: (0.16 * layout.text).round().max(2.0),
            label,
        }
    }
}

/// The scale: where it is and how long it is, in pixels.
struct Bar {
    left: f64,
    bottom: f64,
    length: f64,
    thickness: f64,
    label: String,
}

fn draw_map(
    image: &mut Image,
    writer: &Writer,
    layout: &Layout,
    title: &str,
    map: Map,
    marks: &[(f64, String)],
    beyond: [bool; 2],
) {
    let style = (layout.text, layout.ink);
    let labels = marks.iter().map(|(_, label)| writer.length(label, layout.text)).fold(0.0, f64::max);
    let (wide, high) = ((0.8 * layout.text).round(), (0.42 * layout.height).round());
    let left = (layout.width - layout.margin - labels - 0.6 * layout.text - wide).round();
    let top = (0.5 * (layout.height - high)).round();
    for row in 0..high as i64 {
        let part = 1.0 - (row as f64 + 0.5) / high;
        image.fill([left, top + row as f64], [wide, 1.0], map.color(part));
    }
    // A point at an end says that values go on beyond it.
    for (is_beyond, end, up) in [(beyond[1], top, -1.0), (beyond[0], top + high, 1.0)] {
        let rows = if is_beyond { (0.5 * wide).round() as i64 } else { 0 };
        let color = map.color(if up < 0.0 { 1.0 } else { 0.0 });
        for row in 0..rows {
            let (inset, row) = (row as f64 + 1.0, row as f64);
            let y = if up < 0.0 { end - row - 1.0 } else { end + row };
            image.fill([left + inset, y], [(wide - 2.0 * inset).max(0.0), 1.0], color);
        }
    }
    for (part, label) in marks {
        let y = top + (1.0 - part) * high;
        image.fill([left + wide, y - 0.75], [0.25 * layout.text, 1.5], layout.ink);
        let at = [left + wide + 0.5 * layout.text, y + 0.32 * layout.text];
        writer.write(image, label, at, Align::Left, style);
    }
    let at = [layout.width - layout.margin, top - 1.1 * layout.text];
    writer.write(image, title, at, Align::Right, style);
}

fn draw_names(image: &mut Image, writer: &Writer, layout: &Layout, title: &str, entries: &[Entry]) {
    let style = (layout.text, layout.ink);
    let (line, dot) = (1.5 * layout.text, (0.75 * layout.text).round());
    let top = (0.5 * (layout.height - line * (entries.len() as f64 + 1.0))).round();
    let right = layout.width - layout.margin;
    writer.write(image, title, [right, top], Align::Right, style);
    for (number, entry) in entries.iter().enumerate() {
        let y = (top + line * (number as f64 + 1.0)).round();
        writer.write(image, &entry.label, [right, y], Align::Right, style);
        let mut x = (right - writer.length(&entry.label, layout.text) - 0.5 * layout.text).round();
        for &color in entry.colors.iter().rev() {
            x -= dot;
            image.fill([x, y - 0.85 * dot], [dot, dot], color);
            x -= 2.0;
        }
    }
}

#[cfg(test)]
#[path = "overlay_tests.rs"]
mod tests;
