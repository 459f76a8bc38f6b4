//! Holds strings and numbers to their schema: quantities, formulas, whole numbers.

use serde_json::Value as Json;

use super::fault::Fault;
use super::tree::{Node, Value};
use super::walk::Walk;
use crate::fields::Expression;
use crate::units::{Dimension, kind_of, parse_quantity};

/// A string; with `x-dimension` a quantity, with `x-formula` also a formula.
pub(super) fn walk_text(walk: &mut Walk<'_>, node: &Node, schema: &Json, path: &str) {
    let Some(dimension) = dimension_of(schema) else {
        if !matches!(node.value, Value::Text(_)) {
            walk.wrong_kind(node, path, "a string");
        }
        return;
    };
    let kind = kind_of(dimension);
    let text = match &node.value {
        Value::Text(text) => text,
        Value::Integer(_) | Value::Float(_) => {
            let found = node.value.found();
            let message =
                format!("{found} has no unit; {} is wanted, such as \"{}\"", kind.name, kind.example);
            let number = found.trim_start_matches("the number ");
            let help = format!("write the number with its unit in quotes: \"{number} {}\"", kind.symbol);
            return walk.push(&node.place, Fault::new(path, message).with_help(help));
        }
        _ => {
            return walk.wrong_kind(node, path, &format!("{}, such as \"{}\",", kind.name, kind.example));
        }
    };
    let outcome = if schema["x-formula"] == true {
        check_formula(text, dimension)
    } else {
        parse_quantity(text, dimension).map(drop).map_err(|error| error.to_string())
    };
    if let Err(message) = outcome {
        walk.push(&node.place, Fault::new(path, message));
    }
}

/// Whether a text is a constant with a unit or a formula; fields are velocities, electric fields or flux densities.
fn check_formula(text: &str, dimension: Dimension) -> Result<(), String> {
    match dimension.0 {
        [0, 1, -1, 0, 0] => Expression::<0, 1, -1, 0, 0>::new(text).map(drop),
        [1, 1, -3, 0, -1] => Expression::<1, 1, -3, 0, -1>::new(text).map(drop),
        [1, 0, -2, 0, -1] => Expression::<1, 0, -2, 0, -1>::new(text).map(drop),
        _ => Ok(()),
    }
}

pub(super) fn dimension_of(schema: &Json) -> Option<Dimension> {
    let powers = schema["x-dimension"].as_array()?;
    let mut dimension = Dimension::default();
    for (slot, power) in dimension.0.iter_mut().zip(powers) {
        *slot = i8::try_from(power.as_i64()?).ok()?;
    }
    Some(dimension)
}

/// A whole number within the bounds of its format.
pub(super) fn walk_integer(walk: &mut Walk<'_>, node: &Node, schema: &Json, path: &str) {
    let (least, most) = match schema["format"].as_str() {
        Some("uint32") => (0, i128::from(u32::MAX)),
        Some("uint64" | "uint") => (0, i128::from(i64::MAX)),
        _ => (i128::from(i64::MIN), i128::from(i64::MAX)),
    };
    match &node.value {
        Value::Integer(number) if (least..=most).contains(number) => {}
        Value::Integer(number) => {
            let message = format!("found {number}; a whole number from {least} to {most} is wanted");
            walk.push(&node.place, Fault::new(path, message));
        }
        Value::Float(number) if number.fract() == 0.0 && number.abs() < 1e15 => {
            let fault = Fault::new(path, format!("found the number {number:e}; a whole number is wanted"));
            walk.push(&node.place, fault.with_help(format!("write {number:.0} without point or exponent")));
        }
        _ => walk.wrong_kind(node, path, "a whole number"),
    }
}

/// A finite number.
pub(super) fn walk_number(walk: &mut Walk<'_>, node: &Node, path: &str) {
    match &node.value {
        Value::Integer(number) if is_within(*number as f64) => {}
        Value::Float(number) if is_within(*number) => {}
        Value::Integer(_) => too_large(walk, node, path),
        Value::Float(number) if number.is_finite() => too_large(walk, node, path),
        Value::Text(text) if text.trim().parse::<f64>().is_ok() => {
            let fault =
                Fault::new(path, format!("found the string \"{text}\"; a number without unit is wanted"));
            walk.push(&node.place, fault.with_help(format!("leave out the quotes: {}", text.trim())));
        }
        Value::Float(_) => walk.wrong_kind(node, path, "a finite number"),
        _ => walk.wrong_kind(node, path, "a number without unit"),
    }
}

/// Whether one can compute with a number without a unit.
fn is_within(number: f64) -> bool {
    kind_of(Dimension::default()).holds(number)
}

fn too_large(walk: &mut Walk<'_>, node: &Node, path: &str) {
    let most = kind_of(Dimension::default()).largest;
    let message =
        format!("{} is beyond what can be computed; at most {most:e} is allowed", node.value.found());
    walk.push(&node.place, Fault::new(path, message));
}

/// A value whose kind depends on the key that it is for: a finite number, true or false, or a text.
pub(super) fn walk_scalar(walk: &mut Walk<'_>, node: &Node, schema: &Json, path: &str) {
    match &node.value {
        Value::Text(_) | Value::Flag(_) => {}
        Value::Integer(_) | Value::Float(_) => walk_number(walk, node, path),
        _ => {
            let wanted = walk.wanted(schema);
            walk.wrong_kind(node, path, &wanted);
        }
    }
}
