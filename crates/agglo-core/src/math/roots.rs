//! Roots of functions of one variable that change sign in a bracket.
//!
//! Source: T. R. Chandrupatla, Adv. Eng. Softw. 28, 145 (1997): inverse quadratic interpolation where it can be trusted,
//! bisection elsewhere. It never leaves the bracket.

/// A root and what it cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// Where the function is zero, or changes sign.
    pub at: f64,
    /// How often the function was asked, the ends not counted.
    pub evaluations: u32,
}

/// Most evaluations; bisection alone needs 62 from a bracket of length 1 to round-off.
const MOST: u32 = 200;

/// The root between two `ends` where `function` has `values` of opposite sign, to `tolerance` in the variable.
///
/// If one value is zero, its end is the root; if the signs agree, the end with the smaller value is returned.
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::math::roots::root_between;
/// let root = root_between(|x| x * x - 2.0, [0.0, 2.0], [-2.0, 2.0], 1e-15);
/// assert!((root.at - 2.0_f64.sqrt()).abs() < 1e-15);
/// ```
pub fn root_between(
    mut function: impl FnMut(f64) -> f64,
    ends: [f64; 2],
    values: [f64; 2],
    tolerance: f64,
) -> Root {
    let [mut b, mut a] = ends;
    let [mut fb, mut fa] = values;
    let nearer = if fa.abs() < fb.abs() { a } else { b };
    if fa == 0.0 || fb == 0.0 || (fa > 0.0) == (fb > 0.0) {
        return Root { at: nearer, evaluations: 0 };
    }
    let mut part = 0.5;
    for evaluations in 1..=MOST {
        let x = a + part * (b - a);
        let fx = function(x);
        let (c, fc);
        if (fx > 0.0) == (fa > 0.0) {
            (c, fc) = (a, fa);
        } else {
            (c, fc) = (b, fb);
            (b, fb) = (a, fa);
        }
        (a, fa) = (x, fx);
        let best = if fa.abs() < fb.abs() { a } else { b };
        let least = (2.0 * f64::EPSILON * best.abs() + 0.5 * tolerance) / (b - a).abs();
        if fx == 0.0 || least >= 0.5 {
            return Root { at: if fx == 0.0 { x } else { best }, evaluations };
        }
        part = next_part([a, b, c], [fa, fb, fc]).clamp(least, 1.0 - least);
    }
    Root { at: if fa.abs() < fb.abs() { a } else { b }, evaluations: MOST }
}

/// How far from `a` toward `b` to look next: inverse quadratic interpolation through three points if it is monotone.
fn next_part([a, b, c]: [f64; 3], [fa, fb, fc]: [f64; 3]) -> f64 {
    let (xi, phi) = ((a - b) / (c - b), (fa - fb) / (fc - fb));
    if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
        fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
    } else {
        0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed forms, among them a root of order 9 and a jump; the bound is the tolerance asked for, or round-off.
    #[test]
    fn roots_in_closed_form() {
        let cubic = root_between(|x| x * x * x - 2.0 * x - 5.0, [2.0, 3.0], [-1.0, 16.0], 1e-15);
        assert!((cubic.at - 2.094_551_481_542_326_5).abs() < 1e-15 && cubic.evaluations < 12, "{cubic:?}");
        let steep = root_between(|x: f64| (50.0 * x).exp() - 1e6, [0.0, 1.0], [1.0 - 1e6, 1e20], 1e-15);
        assert!((steep.at - 1e6_f64.ln() / 50.0).abs() < 1e-15 && steep.evaluations < 40, "{steep:?}");
        let flat = root_between(
            |x: f64| (x - 0.3).powi(9),
            [0.0, 1.0],
            [-(0.3_f64.powi(9)), 0.7_f64.powi(9)],
            1e-12,
        );
        assert!((flat.at - 0.3).abs() < 1e-12, "{flat:?}");
        let jump = root_between(|x| if x < 0.7 { -1.0 } else { 2.0 }, [0.0, 1.0], [-1.0, 2.0], 1e-14);
        assert!((jump.at - 0.7).abs() < 1e-14 && jump.evaluations < 60, "{jump:?}");
    }

    #[test]
    fn ends_that_are_roots_and_brackets_without_one() {
        let asked = |_: f64| panic!("nothing to ask");
        assert_eq!(root_between(asked, [0.0, 1.0], [0.0, 1.0], 1e-12).at, 0.0);
        assert_eq!(root_between(asked, [0.0, 1.0], [-1.0, 0.0], 1e-12).at, 1.0);
        assert_eq!(root_between(asked, [0.0, 1.0], [3.0, 1.0], 1e-12).at, 1.0);
    }
}
