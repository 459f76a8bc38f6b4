//! Cooling toward the temperature at which a body neither gains nor loses heat, by convection and radiation together.
//!
//! With y the temperature over that of equilibrium, and a clock s in which radiation has the rate 1,
//! ```text
//! dy/ds = -(y⁴ - 1) - A (y - 1) = -(y - 1) g(y),   g = y³ + y² + y + 1 + A
//! ```
//! g has one real root -ρ, so that 1/((y - 1) g) falls into partial fractions: s(y) is a sum of logarithms and an arc
//! tangent. It is inverted by Newton's method in z = ln |y - 1|, in a bracket, because z is what falls in a straight
//! line near equilibrium. Where y ≫ ρ the terms of the sum cancel, and a series in 1/y takes its place.

/// The solution for one A.
#[derive(Clone, Copy, Debug)]
pub(super) struct Decay {
    asymmetry: f64,
    rho: f64,
    p: f64,
    q: f64,
    w: f64,
    /// Weights of ln|y - 1|, ln(y + ρ), ln(y² + p y + q)/2 and the arc tangent.
    weights: [f64; 4],
}

/// Below this ln|y - 1| a body is at equilibrium: 1 + e^-40 rounds to 1.
const AT_REST: f64 = -40.0;

impl Decay {
    /// For A ≥ 0, finite: convection over radiation.
    pub fn new(asymmetry: f64) -> Self {
        let rho = 1.0 + excess_of_rho(asymmetry);
        let (p, q) = (1.0 - rho, rho * rho - rho + 1.0);
        let w = (0.75 * rho * rho - 0.5 * rho + 0.75).sqrt();
        let alpha = 1.0 / (4.0 + asymmetry);
        let beta = -1.0 / ((1.0 + rho) * (3.0 * rho * rho - 2.0 * rho + 1.0));
        let gamma = -alpha - beta;
        let delta = -3.0 * q / ((4.0 + asymmetry) * (1.0 + asymmetry)) - q * beta / rho;
        let weights = [alpha, beta, gamma, (delta - 0.5 * gamma * p) / w];
        Self { asymmetry, rho, p, q, w, weights }
    }

    /// y after a time s, from `start` ≥ 0 with `start - 1` given apart, so that it need not be rounded.
    pub fn after(&self, start: f64, excess: f64, s: f64) -> f64 {
        if excess == 0.0 || s.is_nan() || s <= 0.0 {
            return start;
        }
        if excess > 0.0 {
            let from = excess.ln();
            let end = from - (4.0 + self.asymmetry) * s;
            let wanted = self.time_to_come_down(from) + s;
            let z = invert(end, |z| {
                let time = self.time_to_come_down(z);
                ((time / wanted).ln(), -1.0 / (self.rate(1.0 + z.exp()) * time))
            });
            1.0 + z.exp()
        } else {
            let from = if start < 0.5 { (-start).ln_1p() } else { (-excess).ln() };
            let end = from - (1.0 + self.asymmetry) * s;
            let wanted = self.time_to_come_up(from) + s;
            let z = invert(end, |z| (self.time_to_come_up(z) - wanted, -1.0 / self.rate(-z.exp_m1())));
            -z.exp_m1()
        }
    }

    /// g(y): how fast ln|y - 1| falls.
    fn rate(&self, y: f64) -> f64 {
        ((y + 1.0) * y + 1.0) * y + 1.0 + self.asymmetry
    }

    /// Time to cool to y = 1 + e^z from infinite heat.
    fn time_to_come_down(&self, z: f64) -> f64 {
        let y = 1.0 + z.exp();
        if y > 50.0 * self.rho {
            return self.time_from_afar(y);
        }
        let [alpha, beta, gamma, kappa] = self.weights;
        let first = if z < 0.0 { z - z.exp().ln_1p() } else { -(-z).exp().ln_1p() };
        let second = (self.rho / y).ln_1p();
        let third = ((self.p + self.q / y) / y).ln_1p();
        kappa * self.w.atan2(y + 0.5 * self.p) - alpha * first - beta * second - 0.5 * gamma * third
    }

    /// The same where A/y³ < 1e-5: three terms of the series are exact to round-off.
    fn time_from_afar(&self, y: f64) -> f64 {
        let cube = 1.0 / (y * y * y);
        let (a, b) = (self.asymmetry * cube, (1.0 + self.asymmetry) * cube / y);
        let second = a / 2.0 - 3.0 / 7.0 * b;
        let third = a * a / 3.0 - 0.6 * a * b + 3.0 / 11.0 * b * b;
        cube / 3.0 * (1.0 - second + third)
    }

    /// Time to warm to y = 1 - e^z from zero.
    fn time_to_come_up(&self, z: f64) -> f64 {
        let y = -z.exp_m1();
        let [alpha, beta, gamma, kappa] = self.weights;
        let second = (y / self.rho).ln_1p();
        let third = ((self.p + y) * y / self.q).ln_1p();
        let angle = (y * self.w).atan2(self.q + 0.5 * self.p * y);
        -alpha * z - beta * second - 0.5 * gamma * third - kappa * angle
    }
}

/// The root z ≤ `end` of a falling function, given with its slope, or no deeper than equilibrium; `end` is where it is
/// not above zero.
fn invert(end: f64, function: impl Fn(f64) -> (f64, f64)) -> f64 {
    if end.is_nan() || end <= AT_REST {
        return f64::NEG_INFINITY;
    }
    let (mut low, mut high, mut z) = (f64::NEG_INFINITY, end, end);
    for _ in 0..200 {
        let (value, slope) = function(z);
        if value > 0.0 {
            low = z;
        } else {
            high = z;
        }
        let newton = z - value / slope;
        // Newton's error squares: what a step of this size leaves is below round-off.
        if (newton - z).abs() <= 1e-11 * (1.0 + z.abs()) {
            return newton.min(end);
        }
        z = if newton > low.max(AT_REST) && newton < high {
            newton
        } else if low < AT_REST {
            if function(AT_REST).0 < 0.0 {
                return f64::NEG_INFINITY;
            }
            low = AT_REST;
            0.5 * (low + high)
        } else {
            0.5 * (low + high)
        };
    }
    z
}

/// r of ρ = 1 + r: r³ + 2 r² + 2 r = A, by Newton's method from above.
fn excess_of_rho(asymmetry: f64) -> f64 {
    let mut r = asymmetry.cbrt().min(0.5 * asymmetry);
    for _ in 0..60 {
        let next = r - (((r + 2.0) * r + 2.0) * r - asymmetry) / ((3.0 * r + 4.0) * r + 2.0);
        if (next - r).abs() <= 1e-16 * r {
            break;
        }
        r = next;
    }
    r
}
