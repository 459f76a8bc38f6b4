//! Numbers as people read them: few digits, with the prefix that fits.

/// A value in an SI unit with a decimal prefix: "150 MPa", "40 um", "7.06e+13 W".
pub fn readable(value: f64, unit: &str) -> String {
    const PREFIXES: [(i32, &str); 9] =
        [(-15, "f"), (-12, "p"), (-9, "n"), (-6, "u"), (-3, "m"), (0, ""), (3, "k"), (6, "M"), (9, "G")];
    let takes_prefix =
        matches!(unit, "m" | "s" | "Pa" | "W" | "J" | "N" | "Hz" | "m/s" | "N/m" | "B" | "Pa s");
    if value == 0.0 || !value.is_finite() || !takes_prefix {
        return format!("{} {unit}", digits(value)).trim_end().to_owned();
    }
    // Rounded first: 0.9999999 mm is 1 mm and not 1000 um.
    let value: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    let decade = value.abs().log10().floor() as i32;
    let wanted = decade.div_euclid(3) * 3;
    match PREFIXES.iter().find(|(power, _)| *power == wanted) {
        Some((power, prefix)) => {
            let scaled = value / 10_f64.powi(*power);
            format!("{} {prefix}{unit}", digits(scaled))
        }
        None => format!("{} {unit}", digits(value)),
    }
}

/// Four significant digits, without needless zeros: "0.382", "1e-12", "70000".
pub(super) fn digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    let size = rounded.abs();
    if (1e-3..1e6).contains(&size) { format!("{rounded}") } else { format!("{rounded:e}") }
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
}
