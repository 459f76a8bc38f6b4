//! The language of formulas, which is the same in the fields of a scenario and in searches and studies.
//!
//! It knows `+ - * / ^`, parentheses, numbers such as `1e3`, the functions of [`FUNCTIONS`] and the constant `pi`; -x^2 is
//! -(x²). Which other names there are is said where a formula is bound to them; none of them may be a function or a
//! constant, so that a word means one thing everywhere.

use exmex::{Express, FlatEx};

/// Functions that a formula may call; `atan2`, `min` and `max` take two arguments.
pub const FUNCTIONS: [&str; 28] = [
    "abs", "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "ceil", "cos", "cosh", "exp",
    "floor", "fract", "ln", "log10", "log2", "max", "min", "round", "signum", "sin", "sinh", "sqrt", "tan",
    "tanh", "trunc",
];

/// The one constant.
pub const PI: &str = "pi";

/// A formula whose names have not been looked up.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// The expression.
    pub expression: FlatEx<f64>,
    /// The name of each of its variables, in the order of its arguments.
    pub names: Vec<String>,
}

/// Whether a word means something in every formula; parameters cannot have such a name. Its meaning in words.
pub fn meaning(word: &str) -> Option<&'static str> {
    if FUNCTIONS.contains(&word) {
        Some("a function of formulas")
    } else if word.eq_ignore_ascii_case(PI) {
        Some("the constant 3.14159... of formulas")
    } else {
        None
    }
}

/// What to write for a name that other programs know as a constant.
pub fn advice(name: &str) -> Option<&'static str> {
    match name {
        "PI" | "Pi" | "π" => Some("write pi"),
        "e" | "E" => Some("write exp(1) for Euler's number"),
        "tau" | "TAU" | "τ" => Some("write 2*pi"),
        _ => None,
    }
}

/// Reads a formula.
///
/// # Errors
/// Says what is wrong with the text.
pub fn parse(text: &str) -> Result<Parsed, String> {
    let (numbered, named) = with_numbers_for_names(text)?;
    let plain = as_mathematicians_read(&numbered)
        .map_err(|()| format!("\"{text}\" has two operators in a row; put the second into parentheses"))?;
    let broken = |why: &str| format!("\"{text}\" is not a formula: {why}");
    let expression = FlatEx::<f64>::parse(&plain).map_err(|error| broken(error.msg()))?;
    let mut names = Vec::new();
    for placeholder in expression.var_names() {
        let number = placeholder.strip_prefix(PLACEHOLDER).and_then(|number| number.parse::<usize>().ok());
        let name = number.and_then(|number| named.get(number));
        names.push(name.ok_or_else(|| broken(&format!("\"{placeholder}\" cannot be read")))?.clone());
    }
    Ok(Parsed { expression, names })
}

/// A name that no unit, function or constant of the parser has.
const PLACEHOLDER: &str = "name_";

/// The formula with `name_0`, `name_1` ... for its names, and the names; the parser would not take their dots, and
/// would take some of them for constants.
fn with_numbers_for_names(text: &str) -> Result<(String, Vec<String>), String> {
    let mut read = String::with_capacity(text.len());
    let mut names: Vec<String> = Vec::new();
    let mut rest = text;
    while let Some(next) = rest.chars().next() {
        if next.is_ascii_digit() || next == '.' {
            let (number, length) = leading_number(rest);
            read += &number;
            rest = &rest[length..];
        } else if next.is_alphabetic() || next == '_' {
            let stop = |c: char| !(c.is_alphanumeric() || c == '_' || c == '.');
            let (word, after) = rest.split_at(rest.find(stop).unwrap_or(rest.len()));
            rest = after;
            if after.trim_start().starts_with('(') {
                if !FUNCTIONS.contains(&word) {
                    let known = FUNCTIONS.join(", ");
                    return Err(format!("\"{text}\" calls \"{word}\"; functions are {known}"));
                }
                read += word;
            } else {
                let number = names.iter().position(|name| name == word).unwrap_or_else(|| {
                    names.push(word.to_owned());
                    names.len() - 1
                });
                read += PLACEHOLDER;
                read += &number.to_string();
            }
        } else if next.is_whitespace() || "+-*/^(),".contains(next) {
            read.push(next);
            rest = &rest[next.len_utf8()..];
        } else {
            return Err(format!("\"{text}\" is not a formula: \"{next}\" has no meaning in one"));
        }
    }
    Ok((read, names))
}

/// The formula with its signs as mathematicians read them; an error where one stands behind an operator.
///
/// The parser takes a sign before anything else, so that -x^2 would be (-x)^2. A sign at the start of a term becomes a
/// subtraction from zero.
fn as_mathematicians_read(text: &str) -> Result<String, ()> {
    let mut read = String::with_capacity(text.len() + 8);
    for next in text.chars() {
        if matches!(next, '-' | '+') {
            match read.trim_end().chars().last() {
                None | Some('(' | ',') => read.push('0'),
                Some('*' | '/' | '^' | '+' | '-') => return Err(()),
                Some(_) => {}
            }
        }
        read.push(next);
    }
    Ok(read)
}

/// The number at the start of a text without an exponent, which the parser does not know, and its length in the text.
fn leading_number(text: &str) -> (String, usize) {
    let digits = |from: usize| {
        let stop = text[from..].find(|c: char| !(c.is_ascii_digit() || c == '.'));
        stop.map_or(text.len(), |at| from + at)
    };
    let mantissa = digits(0);
    let mut end = mantissa;
    if text[mantissa..].starts_with(['e', 'E']) {
        let sign = usize::from(text[mantissa + 1..].starts_with(['+', '-']));
        let exponent = digits(mantissa + 1 + sign);
        if exponent > mantissa + 1 + sign {
            end = exponent;
        }
    }
    // Display never writes an exponent.
    let plain = text[..end].parse::<f64>().map_or_else(|_| text[..end].to_owned(), |value| value.to_string());
    (plain, end)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every function is known to the parser, and no word of it is known to the parser alone.
    #[test]
    fn functions_are_those_of_the_parser() {
        for function in FUNCTIONS {
            let second = if matches!(function, "atan2" | "max" | "min") { ", 0.5" } else { "" };
            let value = parse(&format!("{function}(0.5{second})")).unwrap().expression.eval(&[]);
            assert!(value.is_ok(), "{function}");
        }
        for word in ["log", "LN", "sine", "name_0"] {
            assert!(parse(&format!("{word}(x)")).unwrap_err().contains("functions are"), "{word}");
        }
    }

    /// The parser's own constants are names like any others, so that whoever binds them can refuse them.
    #[test]
    fn constants_of_the_parser_are_names() {
        for word in ["pi", "PI", "π", "e", "E", "tau", "TAU", "τ"] {
            assert_eq!(parse(&format!("2*{word}*x")).unwrap().names, [word, "x"]);
            assert!(word == "pi" || advice(word).is_some(), "no advice on {word}");
        }
        assert_some!(meaning("Pi"));
        assert_some!(meaning("sin"));
        assert_none!(meaning("e"));
    }
}
