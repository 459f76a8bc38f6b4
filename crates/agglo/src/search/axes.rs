//! From what a campaign file says of a parameter to an axis and a key that it sets.

use serde_json::Value as Json;

use super::base::BaseScenario;
use super::file::{Bounds, Parameter, Range, Scalar};
use super::setter::Setter;
use super::space::{Axis, Choice, Scale, unit_of};
use crate::scenario::{Fault, KeyKind, nearest};
use crate::units::{Dimension, kind_of, parse_any, parse_quantity};

/// An axis, and what it sets.
#[derive(Clone, Debug)]
pub struct Knob {
    /// The axis.
    pub axis: Axis,
    /// The key that it sets, if it sets one.
    pub setter: Option<Setter>,
    /// What the entries of a list of choices set it to.
    choices: Vec<Json>,
}

impl Knob {
    /// The tree's value for a value of the axis.
    pub fn json(&self, setter: &Setter, value: f64) -> Json {
        self.choices.get(value as usize).cloned().unwrap_or_else(|| setter.number(value))
    }
}

/// Reads parameter number `at` of a campaign.
///
/// # Errors
/// Everything that is wrong with it.
pub fn knob(parameter: &Parameter, at: usize, base: &BaseScenario) -> Result<Knob, Vec<Fault>> {
    let path = format!("parameters.{at}");
    let setter = match &parameter.key {
        None => None,
        Some(key) => Some(setter(key, &format!("{path}.key"), base).map_err(|fault| vec![*fault])?),
    };
    let wanted = Wanted { kind: setter.as_ref().map(|setter| &setter.kind) };
    let (word, scale) = match &parameter.range {
        Range::Linear(bounds) => ("linear", two(&wanted, bounds, Scale::Linear)),
        Range::Log(bounds) => ("log", two(&wanted, bounds, Scale::Log)),
        Range::Whole(bounds) => ("whole", whole(&wanted, bounds)),
        Range::Choices(entries) => ("choices", choices(&wanted, entries)),
    };
    let Read { scale, dimension, choices } = scale.map_err(|faults| {
        let place = |(inner, message, help): Complaint| {
            let key = format!("{path}.range.{word}{inner}");
            Fault { help, ..Fault::new(key, message) }
        };
        faults.into_iter().map(place).collect::<Vec<_>>()
    })?;
    let unit = unit_as_written(&parameter.range).unwrap_or_else(|| unit_of(dimension));
    let axis = Axis { name: parameter.name.clone(), unit, scale };
    Ok(Knob { axis, setter, choices })
}

/// Looks up a key of the base; `place` is where the campaign names it.
///
/// # Errors
/// Why it leads nowhere.
pub fn setter(key: &str, place: &str, base: &BaseScenario) -> Result<Setter, Box<Fault>> {
    let kind = base.keys.kind(key, &base.tree).map_err(|(message, help)| {
        Box::new(Fault { help, ..Fault::new(place, format!("\"{key}\": {message}")) })
    })?;
    Ok(Setter { key: key.to_owned(), kind })
}

/// What follows the key of the range, the message, the advice.
type Complaint = (String, String, Option<String>);

/// What a range was read as.
struct Read {
    scale: Scale,
    dimension: Dimension,
    choices: Vec<Json>,
}

/// What values must be; anything with a number where no key says more.
struct Wanted<'a> {
    kind: Option<&'a KeyKind>,
}

impl Wanted<'_> {
    /// The value as a number in SI units.
    fn number(&self, scalar: &Scalar) -> Result<(f64, Dimension), String> {
        let found = shown(scalar);
        match (self.kind, scalar) {
            (Some(KeyKind::Quantity(dimension) | KeyKind::Field(dimension)), Scalar::Text(text)) => {
                let value = parse_quantity(text, *dimension).map_err(|error| error.to_string())?;
                Ok((value, *dimension))
            }
            (Some(KeyKind::Quantity(dimension) | KeyKind::Field(dimension)), _) => {
                let kind = kind_of(*dimension);
                Err(format!("{found} has no unit; {} is wanted, such as \"{}\"", kind.name, kind.example))
            }
            (Some(KeyKind::Whole), Scalar::Whole(number)) => Ok((*number as f64, Dimension::default())),
            (Some(KeyKind::Whole), _) => Err(format!("found {found}; a whole number is wanted")),
            (Some(KeyKind::Number) | None, Scalar::Whole(number)) => {
                Ok((*number as f64, Dimension::default()))
            }
            (Some(KeyKind::Number) | None, Scalar::Number(number)) => Ok((*number, Dimension::default())),
            (None, Scalar::Text(text)) => parse_any(text).map_err(|error| error.to_string()),
            (Some(KeyKind::Number) | None, _) => {
                Err(format!("found {found}; a number without unit is wanted"))
            }
            (Some(KeyKind::Flag | KeyKind::Word(_) | KeyKind::Text), _) => {
                Err("the key has no numbers between bounds".to_owned())
            }
        }
    }

    /// What an entry of a list sets the key to, and its number if it is one.
    fn choice(&self, scalar: &Scalar) -> Result<(Json, Option<f64>, Dimension), Complaint> {
        let found = shown(scalar);
        let plain = Dimension::default();
        let refused = |message: String| (String::new(), message, None);
        match (self.kind, scalar) {
            (Some(KeyKind::Word(words)), Scalar::Text(word)) if !words.contains(word) => {
                let near = nearest(word, words.iter().map(String::as_str));
                let message = format!("unknown word {found}; allowed are {}", words.join(", "));
                Err((String::new(), message, near.map(|near| format!("did you mean \"{near}\"?"))))
            }
            (Some(KeyKind::Word(_) | KeyKind::Text), Scalar::Text(text)) => {
                Ok((Json::from(text.as_str()), None, plain))
            }
            (Some(KeyKind::Word(words)), _) => {
                Err(refused(format!("found {found}; one of {} is wanted", words.join(", "))))
            }
            (Some(KeyKind::Text), _) => Err(refused(format!("found {found}; a text is wanted"))),
            (Some(KeyKind::Flag), Scalar::Flag(flag)) => Ok((Json::from(*flag), None, plain)),
            (Some(KeyKind::Flag), _) => Err(refused(format!("found {found}; true or false is wanted"))),
            (kind, _) => {
                let (value, dimension) = self.number(scalar).map_err(refused)?;
                let json = kind.map_or(Json::Null, |kind| {
                    Setter { key: String::new(), kind: kind.clone() }.number(value)
                });
                Ok((json, Some(value), dimension))
            }
        }
    }
}

fn two(
    wanted: &Wanted<'_>,
    bounds: &Bounds,
    scale: impl Fn([f64; 2]) -> Scale,
) -> Result<Read, Vec<Complaint>> {
    let by_words = match wanted.kind {
        Some(KeyKind::Whole) => {
            Some("the key is a whole number; write range.whole = { lower = ..., upper = ... }")
        }
        Some(KeyKind::Flag | KeyKind::Word(_) | KeyKind::Text) => {
            Some("the key has no numbers between bounds; write range.choices = [...]")
        }
        _ => None,
    };
    if let Some(message) = by_words {
        return Err(vec![(String::new(), message.to_owned(), None)]);
    }
    let ([lower, upper], dimension) = read_bounds(wanted, bounds)?;
    let scale = scale([lower, upper]);
    if matches!(scale, Scale::Log(_)) && lower <= 0.0 {
        let message = format!("found {}; a logarithmic range begins above 0", bounds.lower);
        return Err(vec![(".lower".to_owned(), message, None)]);
    }
    Ok(Read { scale, dimension, choices: Vec::new() })
}

fn whole(wanted: &Wanted<'_>, bounds: &Bounds) -> Result<Read, Vec<Complaint>> {
    if !matches!(wanted.kind, Some(KeyKind::Whole | KeyKind::Number) | None) {
        let message = "the key is no whole number; write range.linear, range.log or range.choices";
        return Err(vec![(String::new(), message.to_owned(), None)]);
    }
    read_bounds(&Wanted { kind: Some(&KeyKind::Whole) }, bounds)?;
    let (Scalar::Whole(lower), Scalar::Whole(upper)) = (&bounds.lower, &bounds.upper) else {
        return Err(Vec::new());
    };
    Ok(Read { scale: Scale::Whole([*lower, *upper]), dimension: Dimension::default(), choices: Vec::new() })
}

fn read_bounds(wanted: &Wanted<'_>, bounds: &Bounds) -> Result<([f64; 2], Dimension), Vec<Complaint>> {
    let sides = [(".lower", &bounds.lower), (".upper", &bounds.upper)];
    let [lower, upper] =
        sides.map(|(side, scalar)| wanted.number(scalar).map_err(|message| (side.to_owned(), message, None)));
    let (lower, upper) = match (lower, upper) {
        (Ok(lower), Ok(upper)) => (lower, upper),
        (lower, upper) => return Err([lower.err(), upper.err()].into_iter().flatten().collect()),
    };
    if lower.1 != upper.1 {
        let message = format!("{} and {} are different kinds of quantity", bounds.lower, bounds.upper);
        return Err(vec![(".upper".to_owned(), message, None)]);
    }
    if lower.0 >= upper.0 {
        let message =
            format!("the upper bound {} is not above the lower one, {}", bounds.upper, bounds.lower);
        return Err(vec![(".upper".to_owned(), message, None)]);
    }
    Ok(([lower.0, upper.0], lower.1))
}

fn choices(wanted: &Wanted<'_>, entries: &[Scalar]) -> Result<Read, Vec<Complaint>> {
    let mut faults = Vec::new();
    let mut list = Vec::new();
    let mut set_to = Vec::new();
    let mut dimension = None;
    for (index, scalar) in entries.iter().enumerate() {
        let mut complain = |message: String| faults.push((format!(".{index}"), message, None));
        match wanted.choice(scalar) {
            Ok((_, _, other)) if dimension.is_some_and(|first| first != other) => {
                complain(format!("{scalar} is another kind of quantity than the entries before"));
            }
            Ok((json, number, found)) => {
                dimension = Some(found);
                if entries[..index].contains(scalar) {
                    complain(format!("{scalar} stands in the list twice"));
                }
                list.push(Choice { label: scalar.to_string(), number });
                set_to.push(json);
            }
            Err((_, message, help)) => faults.push((format!(".{index}"), message, help)),
        }
    }
    if entries.is_empty() {
        faults.push((String::new(), "is empty; at least one value is wanted".to_owned(), None));
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    Ok(Read { scale: Scale::Choices(list), dimension: dimension.unwrap_or_default(), choices: set_to })
}

/// The unit in which the file writes a range, where it is an SI unit: J/m2 says more than N/m, and J/mol than J.
fn unit_as_written(range: &Range) -> Option<String> {
    let first = match range {
        Range::Linear(bounds) | Range::Log(bounds) | Range::Whole(bounds) => &bounds.lower,
        Range::Choices(entries) => entries.first()?,
    };
    let Scalar::Text(text) = first else { return None };
    let number = text.trim().find(|c: char| c.is_whitespace())?;
    let unit = text.trim()[number..].trim();
    let (one, dimension) = parse_any(&format!("1 {unit}")).ok()?;
    (one == 1.0 && dimension != Dimension::default()).then(|| unit.to_owned())
}

/// A value as a message shows it: texts in quotes.
fn shown(scalar: &Scalar) -> String {
    match scalar {
        Scalar::Text(text) => format!("\"{text}\""),
        other => other.to_string(),
    }
}
