//! What the tests of all elastic laws share.

/// Holds `slope` at `x` to the central difference of `value` over `x`.
///
/// Fourth-order difference over 1 % of x: truncation (1e-2)^4/30 times the fifth derivative's part, removed by
/// one Richardson step to (1e-2)^6; round-off 1e-16/1e-2. Both stay below the 1e-8 asked for.
pub fn assert_slope(x: f64, value: impl Fn(f64) -> f64, slope: impl Fn(f64) -> f64) {
    let difference = |h: f64| (value(x + h) - value(x - h)) / (2.0 * h);
    let h = 0.01 * x;
    let (wide, middle, narrow) = (difference(h), difference(0.5 * h), difference(0.25 * h));
    let (first, second) = ((4.0 * middle - wide) / 3.0, (4.0 * narrow - middle) / 3.0);
    let numeric = (16.0 * second - first) / 15.0;
    let claimed = slope(x);
    // Where the slope nearly vanishes the value's own size over x is the scale of the difference.
    let scale = claimed.abs().max(0.1 * (value(x) / x).abs());
    assert!((numeric - claimed).abs() <= 1e-8 * scale, "at {x}: claimed {claimed}, difference {numeric}");
}
