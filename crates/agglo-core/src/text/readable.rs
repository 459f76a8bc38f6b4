//! Numbers as people read them: few digits, with the prefix that fits. The one home of that; files that programs read
//! have [`super::number`].

/// Significant digits of a number that stands alone.
const DIGITS: usize = 4;
/// From so many digits on, two different doubles never look the same.
const MOST_DIGITS: usize = 17;

/// A value in an SI unit with a decimal prefix: "150 MPa", "40 um", "7.06e13 W".
pub fn readable(value: f64, unit: &str) -> String {
    rounded(value, unit, DIGITS)
}

/// Four significant digits, without needless zeros: "0.382", "1e-12", "70000".
pub fn digits(value: f64) -> String {
    significant(value, DIGITS)
}

/// A value to two significant digits: what is only reckoned is known no better.
pub fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

/// Values that stand side by side, each with as many digits (four at least) as tell those apart that differ:
/// "1.00004 mm" and "1.00001 mm".
pub fn told_apart<const N: usize>(values: [f64; N], unit: &str) -> [String; N] {
    let needed = enough(&values, MOST_DIGITS);
    values.map(|value| rounded(value, unit, needed))
}

/// The entries of a column, with as many digits as tell those apart that differ, from four to eight.
pub fn column(values: &[f64]) -> Vec<String> {
    let needed = enough(values, 8);
    values.iter().map(|value| significant(*value, needed)).collect()
}

/// A value and its standard error, both to two digits of the error: "1234.5678 +- 0.0022".
pub fn with_error(value: f64, error: f64) -> String {
    if !(value.is_finite() && error.is_finite() && error > 0.0) {
        return format!("{} +- {}", digits(value), digits(error));
    }
    let last = error.log10().floor() as i32 - 1;
    let largest = value.abs().max(error).log10().floor() as i32;
    if (-4..6).contains(&largest) && (-8..=0).contains(&last) {
        let decimals = last.unsigned_abs() as usize;
        return format!("{value:.decimals$} +- {error:.decimals$}");
    }
    // Of digits that nobody can trust none is shown, but one of the value is.
    let figures = |size: f64| (size.abs().log10().floor() as i32 - last + 1).clamp(1, 17) as usize;
    format!("{} +- {}", significant(value, figures(value.abs().max(error))), significant(error, 2))
}

/// How many significant digits tell those values apart that differ.
fn enough(values: &[f64], most: usize) -> usize {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    let differ = |count: &usize| {
        sorted.windows(2).all(|pair| significant(pair[0], *count) != significant(pair[1], *count))
    };
    (DIGITS..most).find(differ).unwrap_or(most)
}

/// With so many significant digits and a prefix.
fn rounded(value: f64, unit: &str, count: usize) -> String {
    const PREFIXES: [(i32, &str); 9] =
        [(-15, "f"), (-12, "p"), (-9, "n"), (-6, "u"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G")];
    let takes_prefix =
        matches!(unit, "m" | "s" | "Pa" | "W" | "J" | "N" | "Hz" | "m/s" | "N/m" | "B" | "Pa s");
    if value == 0.0 || !value.is_finite() || !takes_prefix {
        return format!("{} {unit}", significant(value, count)).trim_end().to_owned();
    }
    // Rounded first: 0.9999999 mm is 1 mm and not 1000 um.
    let text = format!("{value:.*e}", count - 1);
    let wanted = parts(&text).1.div_euclid(3) * 3;
    match PREFIXES.iter().find(|(power, _)| *power == wanted) {
        Some((power, prefix)) => format!("{} {prefix}{unit}", placed(&text, *power)),
        None => format!("{} {unit}", placed(&text, 0)),
    }
}

/// With so many significant digits, without needless zeros.
fn significant(value: f64, count: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        format!("{value}")
    } else {
        placed(&format!("{value:.*e}", count - 1), 0)
    }
}

/// Mantissa and power of ten of a text in scientific form.
fn parts(text: &str) -> (&str, i32) {
    let (mantissa, power) = text.split_once('e').unwrap_or((text, "0"));
    (mantissa, power.parse().unwrap_or(0))
}

/// A text in scientific form over 10^shift, without needless zeros. The point is shifted in the text: no digit is lost.
fn placed(text: &str, shift: i32) -> String {
    let (mantissa, power) = parts(text);
    let power = power - shift;
    let (sign, mantissa) = mantissa.strip_prefix('-').map_or(("", mantissa), |rest| ("-", rest));
    let all = mantissa.replace('.', "");
    let figures = all.trim_end_matches('0');
    let with_point = |whole: &str, part: &str| {
        if part.is_empty() { whole.to_owned() } else { format!("{whole}.{part}") }
    };
    let before = power.unsigned_abs() as usize;
    let number = match power {
        -3..=-1 => format!("0.{}{figures}", "0".repeat(before - 1)),
        0..=5 if figures.len() <= before + 1 => {
            format!("{figures}{}", "0".repeat(before + 1 - figures.len()))
        }
        0..=5 => with_point(&figures[..=before], &figures[before + 1..]),
        _ => format!("{}e{power}", with_point(&figures[..1], &figures[1..])),
    };
    format!("{sign}{number}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_fit() {
        assert_eq!(readable(1.5e8, "Pa"), "150 MPa");
        assert_eq!(readable(4e-5, "m"), "40 um");
        assert_eq!(readable(0.0, "s"), "0 s");
        assert_eq!(readable(-0.02, "m/s"), "-20 mm/s");
        assert_eq!(readable(7.06e13, "W"), "7.06e13 W");
        assert_eq!(readable(6000.0, "kg/m^3"), "6000 kg/m^3");
        assert_eq!(readable(0.000_999_999_9, "m"), "1 mm");
        assert_eq!(digits(0.381_99), "0.382");
    }

    #[test]
    fn values_that_differ_look_different() {
        assert_eq!(told_apart([1.000_04e-3, 1.000_01e-3], "m"), ["1.00004 mm", "1.00001 mm"]);
        assert_eq!(told_apart([1e-3, 2e-3], "m"), ["1 mm", "2 mm"]);
        assert_eq!(told_apart([0.5, 0.5], ""), ["0.5", "0.5"]);
        // Neighbors among doubles, the hardest case.
        for value in [0.1, 1.0, 1e-28, 3e22, 123_456.789] {
            let next = f64::from_bits(f64::to_bits(value) + 1);
            let [a, b] = told_apart([value, next], "J");
            assert_ne!(a, b);
        }
        assert_eq!(column(&[100.0, 100.001, 2e-9]), ["100", "100.001", "2e-9"]);
    }

    #[test]
    fn errors_say_how_many_digits_count() {
        assert_eq!(with_error(0.658_3, 0.002_2), "0.6583 +- 0.0022");
        assert_eq!(with_error(1_234.567_8, 0.002_2), "1234.5678 +- 0.0022");
        assert_eq!(with_error(1_234.567_8, 35.0), "1235 +- 35");
        assert_eq!(with_error(-3.456_7e-9, 2.1e-11), "-3.457e-9 +- 2.1e-11");
        assert_eq!(with_error(4.4e7, 1.3e6), "4.4e7 +- 1.3e6");
        assert_eq!(with_error(2.5, 0.0), "2.5 +- 0");
        assert_eq!(with_error(2.5, f64::NAN), "2.5 +- NaN");
    }
}
