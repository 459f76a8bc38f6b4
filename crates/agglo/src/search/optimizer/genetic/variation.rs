//! Crossover and mutation of coordinates in [0, 1].

use crate::math::rng::Stream;

/// Parents nearer than this are not crossed: their children would differ by rounding only.
const SAME: f64 = 1e-14;

/// Simulated binary crossover of the coordinates of two points, each with probability 1/2.
pub(super) fn cross(points: &mut [Vec<f64>; 2], index: f64, stream: &mut Stream) {
    let [first, second] = points;
    for (a, b) in first.iter_mut().zip(second) {
        if stream.uniform() < 0.5 && (*a - *b).abs() > SAME {
            (*a, *b) = crossed(*a, *b, index, stream);
        }
    }
}

/// Children of two coordinates, in random order; both as far from the parents' mean.
fn crossed(a: f64, b: f64, index: f64, stream: &mut Stream) -> (f64, f64) {
    let (low, high) = (a.min(b), a.max(b));
    // The spread at which the first child touches a bound; probabilities beyond it are left out.
    let most = 1.0 + 2.0 * low.min(1.0 - high) / (high - low);
    let u = stream.uniform() * (2.0 - most.powf(-(index + 1.0)));
    let power = 1.0 / (index + 1.0);
    let spread = if u <= 1.0 { u.powf(power) } else { (2.0 - u).powf(-power) };
    let (mean, half) = (0.5 * (low + high), 0.5 * spread * (high - low));
    let children = [(mean - half).clamp(0.0, 1.0), (mean + half).clamp(0.0, 1.0)];
    if stream.uniform() < 0.5 { (children[0], children[1]) } else { (children[1], children[0]) }
}

/// Polynomial mutation of each coordinate with probability 1/d.
pub(super) fn mutate(point: &mut [f64], index: f64, stream: &mut Stream) {
    let probability = 1.0 / point.len() as f64;
    for x in point {
        if stream.uniform() < probability {
            mutate_coordinate(x, index, stream);
        }
    }
}

/// Polynomial mutation: never beyond a bound.
pub(super) fn mutate_coordinate(x: &mut f64, index: f64, stream: &mut Stream) {
    let (u, power) = (stream.uniform(), index + 1.0);
    let change = if u < 0.5 {
        (2.0 * u + (1.0 - 2.0 * u) * (1.0 - *x).powf(power)).powf(1.0 / power) - 1.0
    } else {
        1.0 - (2.0 * (1.0 - u) + (2.0 * u - 1.0) * x.powf(power)).powf(1.0 / power)
    };
    *x = (*x + change).clamp(0.0, 1.0);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::Purpose;

    const DRAWS: usize = 600_000;

    fn stream() -> Stream {
        Stream::new(1, Purpose::Sampling, 0)
    }

    /// Mean spread of children over that of parents: ∫ β p(β) = (η + 1)/2 (1/(η + 2) + 1/η).
    #[test]
    fn crossover_keeps_the_mean_and_has_its_spread() {
        let mut stream = stream();
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..DRAWS {
            // Far from the bounds: the part of probability cut off is 10^-16.
            let (c, d) = crossed(0.55, 0.45, 15.0, &mut stream);
            assert_near!(c + d, 1.0, 1e-15);
            let spread = (c - d).abs() / 0.1;
            sum += spread;
            squares += spread * spread;
        }
        let mean = sum / DRAWS as f64;
        let error = ((squares / DRAWS as f64 - mean * mean) / DRAWS as f64).sqrt();
        let expected = 8.0 * (1.0 / 17.0 + 1.0 / 15.0);
        assert!(
            (mean - expected).abs() < 5.0 * error && error < 1e-3 * expected,
            "{mean} {expected} {error}"
        );
        // Var β shows an index that is 1 % wrong: ∫ β² p = (η + 1)/2 (1/(η + 3) + 1/(η - 1)).
        let second = 8.0 * (1.0 / 18.0 + 1.0 / 14.0);
        assert_near!(squares / DRAWS as f64, second, 5e-4);
    }

    /// ∫ |δ| p(δ) = 1/(η + 2), ∫ δ p(δ) = 0, ∫ δ² p(δ) = 2/((η + 2)(η + 3)).
    #[test]
    fn mutation_has_its_moments() {
        let mut stream = stream();
        let (mut sum, mut length, mut squares) = (0.0, 0.0, 0.0);
        for _ in 0..DRAWS {
            let mut x = 0.5;
            mutate_coordinate(&mut x, 20.0, &mut stream);
            sum += x - 0.5;
            length += (x - 0.5).abs();
            squares += (x - 0.5) * (x - 0.5);
        }
        let count = DRAWS as f64;
        let (variance, mean_length) = (2.0 / (22.0 * 23.0), 1.0 / 22.0);
        let error = (variance / count).sqrt();
        assert_below!((sum / count).abs(), 5.0 * error);
        assert_near!(length / count, mean_length, 5.0 * error);
        assert_below!(error, 0.01 / 5.0 * mean_length);
        // Standard error of δ² is below 2.5 times its mean over the root of the count.
        assert_close!(squares / count, variance, 5.0 * 2.5 / count.sqrt());
    }

    #[test]
    fn bounds_are_kept() {
        let mut stream = stream();
        for _ in 0..10_000 {
            let (a, b) = (stream.uniform().powi(9), 1.0 - stream.uniform().powi(9));
            let (mut c, mut d) = crossed(a, b, 2.0, &mut stream);
            mutate_coordinate(&mut c, 1.0, &mut stream);
            mutate_coordinate(&mut d, 1.0, &mut stream);
            assert_between!(c, 0.0..=1.0);
            assert_between!(d, 0.0..=1.0);
        }
    }
}
