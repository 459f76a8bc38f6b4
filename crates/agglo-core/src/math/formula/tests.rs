//! Tests of the language of formulas.

use super::parse::DEEPEST;
use super::*;

const AT: [(&str, f64); 3] = [("x", 0.3), ("y", -1.7), ("energy.heat_J", 1e3)];

fn read(text: &str) -> Result<Formula<usize>, String> {
    Formula::new(text, |name| {
        AT.iter().position(|(known, _)| *known == name).ok_or_else(|| format!("who is {name}?"))
    })
}

fn value(text: &str) -> f64 {
    read(text).unwrap().at(|name| AT[name].1)
}

/// The same arithmetic in Rust, in the same order: the same bits.
#[test]
fn formulas_mean_what_they_say() {
    let (x, y) = (0.3_f64, -1.7_f64);
    let rows = [
        ("x", x),
        ("-x^2", -(x.powf(2.0))),
        ("2*(-y^2) + 1e3*x", 2.0 * -(y.powf(2.0)) + 1e3 * x),
        ("x - y - x", x - y - x),
        ("x*y/3*x", x * y / 3.0 * x),
        ("2^3^2", 64.0),
        ("2 - 3 + 4", 3.0),
        ("+x + .5e+1", x + 5.0),
        ("2.5E-1*energy.heat_J", 250.0),
        ("2^(-x)", 2.0_f64.powf(-x)),
        ("max(x, y) - min (x, 1E1)", x - x),
        ("atan2(y, x)", y.atan2(x)),
        ("sin(2*pi*x)", (2.0 * std::f64::consts::PI * x).sin()),
        ("((x))", x),
        ("-(x - y)", -(x - y)),
    ];
    for (text, wanted) in rows {
        assert_eq!(value(text), wanted, "{text}");
    }
    assert_nan!(value("ln(y)"));
    assert_eq!(value("1/(x - x)"), f64::INFINITY);
}

#[test]
fn what_is_wrong_is_said() {
    let rows = [
        ("", "ends too early"),
        ("x +", "ends too early"),
        ("(x", "a ) is missing"),
        ("sin(x", "a ) is missing"),
        ("x)", "nothing opens a )"),
        ("x, y", "a comma stands outside"),
        ("x y", "an operator is missing before \"y\""),
        ("2 x", "an operator is missing before \"x\""),
        ("(x)(y)", "an operator is missing"),
        ("*x", "something is missing before \"*\""),
        ("sin()", "something is missing before \")\""),
        ("sin(x, y)", "sin takes one argument"),
        ("min(x)", "min takes two arguments"),
        ("min(x, y, x)", "a ) is missing"),
        ("1.2.3", "\"1.2.3\" is no number"),
        ("1e999", "\"1e999\" is no number"),
        ("x*-y", "two operators in a row"),
        ("x^-2", "two operators in a row"),
        ("x % 2", "\"%\" has no meaning"),
        ("log(x)", "calls \"log\"; functions are abs"),
        ("sin", "who is sin?"),
        ("w", "who is w?"),
    ];
    for (text, words) in rows {
        let message = read(text).unwrap_err();
        assert!(message.contains(words), "{text}: {message}");
    }
}

/// A text of any depth is refused, and none takes more room than there is.
#[test]
fn depth_has_an_end() {
    let nested = |depth: usize, inner: &str| format!("{}x{}", inner.repeat(depth), ")".repeat(depth));
    for inner in ["(", "sin(", "-(", "x+(", "x*(", "min(x,"] {
        let deep = read(&nested(100_000, inner)).unwrap_err();
        assert!(deep.contains("nested too deeply"), "{inner}: {}", &deep[deep.len() - 50..]);
        let most = read(&nested(DEEPEST - 1, inner)).unwrap();
        assert!(most.at(|name| AT[name].1).is_finite(), "{inner}");
    }
}

/// Every function is known, and its slope is that of its value. The central difference over 1e-6 errs by 1e-12 of its third
/// derivative and by rounding of 1e-10.
#[test]
fn slopes_are_those_of_the_values() {
    let calls = FUNCTIONS.map(|name| match name {
        "acosh" => "acosh(2 + x)".to_owned(),
        "atan2" | "max" | "min" => format!("{name}(x, 2*x - 0.4)"),
        _ => format!("{name}(x)"),
    });
    let others = ["x^3", "x^1.5", "2^x", "x^x", "x*y/(1 + x^2)", "exp(-x)*x - 3/x", "y^2"].map(str::to_owned);
    for text in calls.iter().chain(&others) {
        let formula = read(text).unwrap();
        let at = |x: f64| formula.at(|name| if name == 0 { x } else { AT[name].1 });
        let difference = (at(0.3 + 1e-6) - at(0.3 - 1e-6)) / 2e-6;
        let along = |name: usize| [f64::from(u8::from(name == 0)), 0.0];
        let (value, [slope, none]) = formula.with_slopes(|name| AT[name].1, along);
        assert_eq!((value, none), (at(0.3), 0.0), "{text}");
        assert!((slope - difference).abs() < 1e-8, "{text}: {slope} {difference}");
    }
}

/// What does not change has no slope, even where the function is infinitely steep; what does has that of its side.
#[test]
fn slopes_at_the_edge() {
    let slope = |text: &str| {
        let formula = read(text).unwrap();
        formula.with_slopes(|_| 0.0, |name| [f64::from(u8::from(name == 0))]).1[0]
    };
    assert_eq!(
        [slope("sqrt(y) + x"), slope("y^0.5*x"), slope("x^1.5"), slope("x^2*y")],
        [1.0, 0.0, 0.0, 0.0]
    );
    assert_eq!([slope("abs(x)"), slope("sqrt(x)")], [0.0, f64::INFINITY]);
}

/// Other programs' constants are names like any others, so that whoever binds them can refuse them.
#[test]
fn constants_of_others_are_names() {
    for word in ["PI", "π", "e", "E", "tau", "TAU", "τ"] {
        let formula = Formula::new(&format!("2*{word}*x"), |name| Ok(name == word)).unwrap();
        assert_eq!((formula.names(), formula.names_pi()), (&[true, false][..], false));
        assert!(advice(word).is_some(), "no advice on {word}");
    }
    assert!(read("2*pi*x").unwrap().names_pi(), "pi is the constant");
    assert_some!(meaning("Pi"));
    assert_some!(meaning("sin"));
    assert_none!(meaning("e"));
}
