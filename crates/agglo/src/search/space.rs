//! The space of a search: from the unit cube to values of parameters and back.

use crate::text::{number, readable};
use crate::units::Dimension;

/// One parameter as an axis of the unit cube.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Its short name.
    pub name: String,
    /// Its unit, such as `m/s`; empty for pure numbers and words.
    pub unit: String,
    /// How coordinates in [0, 1] and values belong together.
    pub scale: Scale,
}

/// How coordinates in [0, 1] and values belong together.
#[derive(Clone, Debug, PartialEq)]
pub enum Scale {
    /// Even between two bounds (SI units).
    Linear([f64; 2]),
    /// Even in the logarithm between two positive bounds (SI units).
    Log([f64; 2]),
    /// Whole numbers from one bound to the other, each with an equal part of the axis.
    Whole([i64; 2]),
    /// A list, each entry with an equal part of the axis; values are numbers of entries, from 0.
    Choices(Vec<Choice>),
}

/// An entry of a list of choices.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// As the file writes it.
    pub label: String,
    /// Its number in SI units, if it is one.
    pub number: Option<f64>,
}

impl Axis {
    /// The name of its column in tables: the name with its unit, such as `v_m_s`.
    pub fn column(&self) -> String {
        let unit = self.unit.replace('^', "");
        let parts = unit.split(|c: char| !c.is_alphanumeric()).filter(|part| !part.is_empty());
        parts.fold(self.name.clone(), |column, part| column + "_" + part)
    }

    /// A value as a number: the value itself, or the number that a choice stands for.
    pub fn number(&self, value: f64) -> f64 {
        match &self.scale {
            Scale::Choices(choices) => {
                choices.get(value as usize).and_then(|choice| choice.number).unwrap_or(value)
            }
            _ => value,
        }
    }

    /// A value in words, without its unit: digits that read back as the same number, or a choice's label.
    pub fn label(&self, value: f64) -> String {
        match &self.scale {
            Scale::Choices(choices) => {
                choices.get(value as usize).map_or_else(String::new, |choice| choice.label.clone())
            }
            _ => number(value),
        }
    }

    /// A value as people read it: "150 MPa", a choice's label.
    pub fn readable(&self, value: f64) -> String {
        match &self.scale {
            Scale::Choices(_) => self.label(value),
            _ => readable(value, &self.unit),
        }
    }

    /// Whether its values have numbers that formulas can use.
    pub fn is_numeric(&self) -> bool {
        match &self.scale {
            Scale::Choices(choices) => choices.iter().all(|choice| choice.number.is_some()),
            _ => true,
        }
    }
}

impl Scale {
    /// How many different values there are; none where they are continuous.
    pub fn levels(&self) -> Option<usize> {
        match self {
            Self::Linear(_) | Self::Log(_) => None,
            Self::Whole([lower, upper]) => usize::try_from(i128::from(*upper) - i128::from(*lower) + 1).ok(),
            Self::Choices(choices) => Some(choices.len()),
        }
    }

    /// The value at a coordinate; coordinates outside [0, 1] are taken for its ends.
    pub fn value(&self, coordinate: f64) -> f64 {
        let u = coordinate.clamp(0.0, 1.0);
        match self {
            Self::Linear([lower, upper]) => (lower + u * (upper - lower)).clamp(*lower, *upper),
            Self::Log([lower, upper]) => (lower * (u * (upper / lower).ln()).exp()).clamp(*lower, *upper),
            Self::Whole([lower, _]) => *lower as f64 + self.bin(u),
            Self::Choices(_) => self.bin(u),
        }
    }

    fn bin(&self, u: f64) -> f64 {
        let levels = self.levels().unwrap_or(1) as f64;
        (u * levels).floor().min(levels - 1.0)
    }
}

/// Values of all axes at a point of the unit cube.
pub fn values(axes: &[Axis], point: &[f64]) -> Vec<f64> {
    axes.iter().zip(point).map(|(axis, coordinate)| axis.scale.value(*coordinate)).collect()
}

/// The unit of a dimension as an axis shows it.
pub fn unit_of(dimension: Dimension) -> String {
    if dimension == Dimension::default() { String::new() } else { dimension.symbol() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};

    fn choices(labels: &[&str]) -> Scale {
        let choice = |label: &&str| Choice { label: (*label).to_owned(), number: label.parse().ok() };
        Scale::Choices(labels.iter().map(choice).collect())
    }

    #[test]
    fn ends_are_the_bounds() {
        let scales = [Scale::Linear([0.1, 0.7]), Scale::Log([1e-3, 7.3]), Scale::Linear([-3e5, 1e-7])];
        for scale in scales {
            let (Scale::Linear(bounds) | Scale::Log(bounds)) = scale.clone() else { continue };
            assert_eq!([scale.value(0.0), scale.value(1.0)], bounds);
            assert_eq!([scale.value(-0.5), scale.value(1.5)], bounds);
        }
        assert_eq!([0.0, 1.0].map(|u| Scale::Whole([-2, 3]).value(u)), [-2.0, 3.0]);
        assert_eq!([0.0, 0.34, 1.0].map(|u| choices(&["a", "b", "c"]).value(u)), [0.0, 1.0, 2.0]);
    }

    /// The middle of a logarithmic axis is the geometric mean: sqrt(1e-2 · 1e4) = 10.
    #[test]
    fn logarithmic_axes_have_geometric_means() {
        assert_near!(Scale::Log([1e-2, 1e4]).value(0.5), 10.0, 1e-13);
        assert_eq!(Scale::Linear([1.0, 4.0]).value(0.5), 2.5);
    }

    /// 60,000 draws on six values: each count is 10,000 ± 91 (one standard deviation); five of them are allowed.
    #[test]
    fn whole_numbers_and_choices_have_equal_parts() {
        for scale in [Scale::Whole([-2, 3]), choices(&["a", "b", "c", "d", "e", "f"])] {
            let first = scale.value(0.0);
            let mut stream = Stream::new(7, Purpose::Sampling, 1);
            let mut counts = [0_i32; 6];
            for _ in 0..60_000 {
                counts[(scale.value(stream.uniform()) - first) as usize] += 1;
            }
            assert!(counts.iter().all(|count| (count - 10_000).abs() < 456), "{counts:?}");
        }
    }

    #[test]
    fn columns_carry_units() {
        let column = |unit: &str| {
            Axis { name: "x".into(), unit: unit.into(), scale: Scale::Linear([0.0, 1.0]) }.column()
        };
        let rows =
            [("", "x"), ("m/s", "x_m_s"), ("kg/m^3", "x_kg_m3"), ("Pa", "x_Pa"), ("J/(kg K)", "x_J_kg_K")];
        for (unit, wanted) in rows {
            assert_eq!(column(unit), wanted);
        }
    }
}
