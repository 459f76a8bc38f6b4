//! Axes of the space of a search as axes of pictures.

use super::Axis;
use crate::search::space;

/// The axis of a parameter in tables and pictures. Choices between numbers are quantities there, so that they stand where
/// they belong; choices between words keep their words.
pub fn parameter_axis(axis: &space::Axis) -> Axis {
    let labels = match &axis.scale {
        space::Scale::Choices(choices) if !axis.is_numeric() => {
            choices.iter().map(|choice| choice.label.clone()).collect()
        }
        _ => Vec::new(),
    };
    let is_log = matches!(axis.scale, space::Scale::Log(_));
    Axis { name: axis.name.clone(), unit: axis.unit.clone(), is_log, labels }
}

/// What a candidate's value is on that axis.
pub fn parameter_value(axis: &space::Axis, value: f64) -> f64 {
    if axis.is_numeric() { axis.number(value) } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::{Choice, Scale};

    #[test]
    fn numbers_stand_where_they_belong_and_words_stay_words() {
        let choice = |label: &str, number| Choice { label: label.to_owned(), number };
        let of = |choices| space::Axis {
            name: "a".to_owned(),
            unit: String::new(),
            scale: Scale::Choices(choices),
        };
        let rays = of(vec![choice("1000", Some(1e3)), choice("20000", Some(2e4))]);
        assert_empty!(parameter_axis(&rays).labels);
        assert_eq!(parameter_value(&rays, 1.0), 2e4);
        let laws = of(vec![choice("published", None), choice("consistent", None)]);
        assert_eq!(parameter_axis(&laws).labels, ["published", "consistent"]);
        assert_eq!(parameter_value(&laws, 1.0), 1.0);
    }
}
