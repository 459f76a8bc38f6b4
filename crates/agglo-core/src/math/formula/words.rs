//! The words of formulas: functions, the constant, and what other programs call constants.

/// Functions that a formula may call; `atan2`, `min` and `max` take two arguments.
pub const FUNCTIONS: [&str; 28] = [
    "abs", "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "ceil", "cos", "cosh", "exp",
    "floor", "fract", "ln", "log10", "log2", "max", "min", "round", "signum", "sin", "sinh", "sqrt", "tan",
    "tanh", "trunc",
];

/// The one constant.
pub const PI: &str = "pi";

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
