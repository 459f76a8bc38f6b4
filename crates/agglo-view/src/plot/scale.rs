//! From values to parts of an axis, and the values at which an axis has marks.

use crate::chart::Axis;

/// A marked value of an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    pub value: f64,
    pub label: String,
}

/// Which values an axis shows.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Scale {
    pub low: f64,
    pub high: f64,
    is_log: bool,
    labels: Vec<String>,
}

/// Room beyond the outermost values, as a part of the axis.
const MARGIN: f64 = 0.04;

impl Scale {
    /// What an axis shows that has room for the values.
    pub fn of(axis: &Axis, values: impl IntoIterator<Item = f64>) -> Self {
        if axis.labels.is_empty() { Self::over(values, axis.is_log) } else { Self::choices(&axis.labels) }
    }

    /// From a little below the smallest to a little above the largest of the values that can be shown.
    pub fn over(values: impl IntoIterator<Item = f64>, is_log: bool) -> Self {
        let shown = values.into_iter().filter(|v| v.is_finite() && (!is_log || *v > 0.0));
        let (low, high) =
            shown.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let (low, high) = match (low <= high, is_log) {
            (false, true) => (1.0, 10.0),
            (false, false) => (0.0, 1.0),
            (true, true) => {
                let (low, high) = padded(low.ln(), high.ln(), 0.1);
                (low.exp(), high.exp())
            }
            (true, false) => padded(low, high, if low == 0.0 { 1.0 } else { 0.05 * low.abs() }),
        };
        Self { low, high, is_log, labels: Vec::new() }
    }

    /// From one value to the other, without a margin.
    pub fn between(low: f64, high: f64) -> Self {
        Self { low, high, is_log: false, labels: Vec::new() }
    }

    /// One place for each word.
    pub fn choices(labels: &[String]) -> Self {
        Self { low: -0.5, high: labels.len() as f64 - 0.5, is_log: false, labels: labels.to_vec() }
    }

    /// The same with `value` at or inside its ends.
    pub fn with(mut self, value: f64) -> Self {
        self.low = self.low.min(value);
        self.high = self.high.max(value);
        self
    }

    /// Where a value is: 0 at the lower end, 1 at the upper; not a number where it cannot be shown.
    pub fn part(&self, value: f64) -> f64 {
        if self.is_log {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }

    /// About `target` marks, labeled.
    pub fn ticks(&self, target: usize) -> Vec<Tick> {
        if !self.labels.is_empty() {
            let label =
                |(number, label): (usize, &String)| Tick { value: number as f64, label: label.clone() };
            return self.labels.iter().enumerate().map(label).collect();
        }
        let logarithmic = if self.is_log { self.log_ticks(target) } else { Vec::new() };
        if logarithmic.len() < 2 { self.linear_ticks(target) } else { logarithmic }
    }

    fn linear_ticks(&self, target: usize) -> Vec<Tick> {
        let mut step = nice((self.high - self.low) / target.max(1) as f64);
        // Two marks tell the scale; one does not.
        while (self.high / step).floor() - (self.low / step).ceil() < 1.0 && step.is_normal() {
            step = nice(0.4 * step);
        }
        let (first, last) = ((self.low / step).ceil(), (self.high / step).floor());
        let count = (last - first + 1.0).clamp(0.0, 50.0) as usize;
        let values: Vec<f64> = (0..count).map(|k| (first + k as f64) * step).collect();
        let largest = values.iter().fold(0.0_f64, |largest, v| largest.max(v.abs()));
        let finest = (step.log10() + 1e-9).floor() as i32;
        values.iter().map(|&value| Tick { value, label: label(value, finest, largest) }).collect()
    }

    /// Powers of ten, with 3 or with 2 and 5 times them where there is room.
    fn log_ticks(&self, target: usize) -> Vec<Tick> {
        let room = target.max(2) + 1;
        let decades = (self.high / self.low).log10();
        let stride = (decades / room as f64).ceil().max(1.0) as i32;
        for mantissas in [&[1.0, 2.0, 5.0][..], &[1.0, 3.0], &[1.0]] {
            let ticks = self.powers(mantissas, if mantissas.len() == 1 { stride } else { 1 });
            if ticks.len() <= room || mantissas.len() == 1 {
                return ticks;
            }
        }
        Vec::new()
    }

    fn powers(&self, mantissas: &[f64], stride: i32) -> Vec<Tick> {
        let (first, last) = (self.low.log10().floor() as i32, self.high.log10().ceil() as i32);
        let powers = (first..=last).filter(|power| power.rem_euclid(stride) == 0);
        let all = powers.flat_map(|power| mantissas.iter().map(move |&m| (m, power)));
        let ticks = all.map(|(m, power)| (m * 10.0_f64.powi(power), m, power));
        let inside = ticks.filter(|(value, ..)| (self.low..=self.high).contains(value));
        inside.map(|(value, m, power)| Tick { value, label: log_label(value, m, power) }).collect()
    }
}

fn padded(low: f64, high: f64, least: f64) -> (f64, f64) {
    let span = high - low;
    let margin = if span > 1e-12 * low.abs().max(high.abs()) { MARGIN * span } else { least };
    (low - margin, high + margin)
}

/// The smallest of 1, 2 and 5 times a power of ten that is not below `step`.
fn nice(step: f64) -> f64 {
    let power = 10.0_f64.powf(step.log10().floor());
    let mantissas = [1.0, 2.0, 5.0, 10.0];
    mantissas.into_iter().map(|m| m * power).find(|nice| *nice >= 0.999_999 * step).unwrap_or(10.0 * power)
}

/// A number whose last digit stands at `10^finest`, on an axis whose largest number is `largest`.
fn label(value: f64, finest: i32, largest: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let power = largest.log10().floor() as i32;
    if (-3..5).contains(&power) && finest >= -6 {
        return minus(format!("{value:.0$}", (-finest).max(0) as usize));
    }
    let digits = (power - finest).clamp(0, 9) as usize;
    minus(format!("{:.digits$}×10{}", value / 10.0_f64.powi(power), superscript(power)))
}

fn log_label(value: f64, mantissa: f64, power: i32) -> String {
    match power {
        0..=3 => format!("{value}"),
        -3..=-1 => format!("{value:.0$}", (-power) as usize),
        _ if mantissa == 1.0 => format!("10{}", superscript(power)),
        _ => format!("{mantissa}×10{}", superscript(power)),
    }
}

/// The sign that is as wide as a digit.
fn minus(text: String) -> String {
    if text.starts_with('-') { text.replacen('-', "\u{2212}", 1) } else { text }
}

fn superscript(power: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |letter: char| letter.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    power.to_string().chars().map(raise).collect()
}

/// A number and its error, to two digits of the error.
pub(super) fn with_error(value: f64, error: f64) -> String {
    let text = agglo::text::with_error(value, error);
    text.split(" +- ").map(typeset).collect::<Vec<_>>().join(" ± ")
}

/// "1.5e-9" as it is printed: 1.5×10⁻⁹.
fn typeset(number: &str) -> String {
    let power = number.split_once('e').and_then(|(mantissa, power)| Some((mantissa, power.parse().ok()?)));
    minus(power.map_or_else(
        || number.to_owned(),
        |(mantissa, power)| format!("{mantissa}×10{}", superscript(power)),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: &Scale, target: usize) -> Vec<String> {
        scale.ticks(target).into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn linear_marks_are_round_numbers() {
        assert_eq!(labels(&Scale::between(-0.1, 1.05), 3), ["0", "0.5", "1.0"]);
        assert_eq!(labels(&Scale::between(20.0, 200.0), 5), ["50", "100", "150", "200"]);
        let large = ["0.2×10⁶", "0.4×10⁶", "0.6×10⁶", "0.8×10⁶", "1.0×10⁶"];
        assert_eq!(labels(&Scale::between(1e5, 1e6), 5), large);
        assert_eq!(labels(&Scale::between(-2.2e-5, 1.0e-6), 3), ["\u{2212}2×10⁻⁵", "\u{2212}1×10⁻⁵", "0"]);
    }

    #[test]
    fn logarithmic_marks_are_powers() {
        assert_eq!(
            labels(&Scale { is_log: true, ..Scale::between(0.9e-6, 1.1e3) }, 5),
            ["10⁻⁶", "10⁻⁴", "0.01", "1", "100"]
        );
    }

    #[test]
    fn values_at_the_ends_and_equal_values_have_room() {
        let scale = Scale::over([1.0, 3.0, f64::NAN], false);
        assert_above!(scale.part(1.0), 0.0);
        assert_below!(scale.part(3.0), 1.0);
        assert_near!(scale.part(2.0), 0.5, 1e-12);
        let flat = Scale::over([7.0, 7.0], false);
        assert_near!(flat.part(7.0), 0.5, 1e-12);
        let log = Scale::over([1.0, 100.0, -5.0], true);
        // The middle of a logarithmic axis is the geometric mean.
        assert_near!(log.part(10.0), 0.5, 1e-12);
    }
}
