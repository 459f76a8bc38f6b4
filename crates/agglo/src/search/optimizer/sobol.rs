//! Sobol' points: they fill the space more evenly than random ones, whatever their number.
//!
//! # Equation
//! ```text
//! x_(n+1) = x_n ⊕ v_c,  c = lowest zero bit of n,  v_k = m_k / 2^k                              OP5
//! m_k = 2 a_1 m_(k-1) ⊕ 4 a_2 m_(k-2) ⊕ ... ⊕ 2^s m_(k-s) ⊕ m_(k-s)
//! ```
//! with a polynomial of degree s and first m_1 ... m_s of its own for each dimension; ⊕ adds bits without carry. A random
//! word is added to each coordinate in the same way (digital shift), which keeps the evenness and makes seeds differ.
//!
//! # Source
//! I. M. Sobol', USSR Comput. Math. Math. Phys. 7, 86 (1967); S. Joe and F. Y. Kuo, *Constructing Sobol sequences with
//! better two-dimensional projections*, SIAM J. Sci. Comput. 30, 2635 (2008): table `new-joe-kuo-6.21201`; order of
//! I. A. Antonov and V. M. Saleev, USSR Comput. Math. Math. Phys. 19, 252 (1979).
//!
//! # Symbols
//! | symbol | name in code | unit | meaning                                                    |
//! |--------|--------------|------|------------------------------------------------------------|
//! | x_n    | `Point`      | 1    | point number n, as parts of the ranges                     |
//! | v_k    | `directions` | 1    | direction numbers, of the table of Joe and Kuo             |
//! | a_k    |              | 1    | coefficients of the polynomial, 0 or 1                     |
//!
//! # Valid when
//! Up to 32 parameters. Evenness is best for a number of points that is a power of 2.
//!
//! # Compared with others
//! `scipy.stats.qmc.Sobol` multiplies directions by a random matrix before it shifts; the shift alone keeps the evenness, and is all that
//! seeds need to differ.
//!
//! # In a campaign
//! ```toml
//! [method.sobol]
//! points = 1024
//! ```
//!
//! # Example
//! ```
//! use agglo::search::optimizer::{Optimizer, Sobol};
//! let mut search = Sobol { points: 32 }.start(3, 1);
//! // Each of 32 equal slices of each axis holds one point.
//! let mut slices: Vec<u32> = search.ask().iter().map(|point| (32.0 * point[2]) as u32).collect();
//! slices.sort();
//! assert!(slices.into_iter().eq(0..32));
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::samples::Samples;
use super::{Fault, Optimizer, Part, Point, stream};

/// Degree, inner coefficients a_1 ... a_(s-1) as bits, and m_1 ... m_s of dimensions 2, 3 ...
const TABLE: [(usize, u64, &[u64]); 31] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
    (5, 11, &[1, 1, 5, 1, 1]),
    (5, 13, &[1, 1, 1, 3, 11]),
    (5, 14, &[1, 3, 5, 5, 31]),
    (6, 1, &[1, 3, 3, 9, 7, 49]),
    (6, 13, &[1, 1, 1, 15, 21, 21]),
    (6, 16, &[1, 3, 1, 13, 27, 49]),
    (6, 19, &[1, 1, 1, 15, 7, 5]),
    (6, 22, &[1, 3, 1, 15, 13, 25]),
    (6, 25, &[1, 1, 5, 5, 19, 61]),
    (7, 1, &[1, 3, 7, 11, 23, 15, 103]),
    (7, 4, &[1, 3, 7, 13, 13, 15, 69]),
    (7, 7, &[1, 1, 3, 13, 7, 35, 63]),
    (7, 8, &[1, 3, 5, 9, 1, 25, 53]),
    (7, 14, &[1, 3, 1, 13, 9, 35, 107]),
    (7, 19, &[1, 3, 1, 5, 27, 61, 31]),
    (7, 21, &[1, 1, 5, 11, 19, 41, 61]),
    (7, 28, &[1, 3, 5, 3, 3, 13, 69]),
    (7, 31, &[1, 1, 7, 13, 1, 19, 1]),
    (7, 32, &[1, 3, 7, 5, 13, 19, 59]),
    (7, 37, &[1, 1, 3, 9, 25, 29, 41]),
    (7, 41, &[1, 3, 5, 13, 23, 1, 55]),
    (7, 42, &[1, 3, 7, 3, 13, 59, 17]),
];

/// Bits of the numbers of points.
const BITS: usize = 32;

/// Points that fill the space evenly.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Sobol {
    /// How many points, 1 to 2^32 - 1; best a power of 2.
    pub points: usize,
}

impl Default for Sobol {
    fn default() -> Self {
        Self { points: 1024 }
    }
}

impl Sobol {
    /// Begins a search over so many parameters.
    pub fn start(&self, dimensions: usize, seed: u64) -> impl Optimizer + use<> {
        let mut shifts = stream(seed, Part::Points);
        let shift = (0..dimensions).map(|_| (shifts.uniform() * 2.0_f64.powi(53)) as u64).collect();
        let mut sequence = Sequence::new(dimensions, shift);
        Samples::new(self.points, move || sequence.next_point())
    }

    pub(in crate::search) fn faults(&self, dimensions: usize) -> Vec<Fault> {
        let mut faults = Vec::new();
        if self.points == 0 || self.points as u64 >= 1 << BITS {
            faults.push(("points", format!("{} is not from 1 to 2^{BITS} - 1", self.points)));
        }
        if dimensions > TABLE.len() + 1 {
            faults.push(("parameters", format!("at most {} can be varied in this way", TABLE.len() + 1)));
        }
        faults
    }
}

/// The points, one after another, as integers of 53 bits.
struct Sequence {
    number: u64,
    state: Vec<u64>,
    /// Direction numbers `[d, 32]`.
    directions: Vec<[u64; BITS]>,
}

impl Sequence {
    fn new(dimensions: usize, shift: Vec<u64>) -> Self {
        let directions = (0..dimensions).map(directions).collect();
        Self { number: 0, state: shift, directions }
    }

    fn next_point(&mut self) -> Point {
        let point = self.state.iter().map(|word| *word as f64 / 2.0_f64.powi(53)).collect();
        let bit = (self.number.trailing_ones() as usize).min(BITS - 1);
        self.state.iter_mut().zip(&self.directions).for_each(|(word, directions)| *word ^= directions[bit]);
        self.number += 1;
        point
    }
}

fn directions(dimension: usize) -> [u64; BITS] {
    let mut m = [1; BITS];
    if let Some((degree, coefficients, first)) = dimension.checked_sub(1).and_then(|row| TABLE.get(row)) {
        m[..*degree].copy_from_slice(first);
        for k in *degree..BITS {
            m[k] = m[k - degree] ^ (m[k - degree] << degree);
            for i in 1..*degree {
                m[k] ^= ((coefficients >> (degree - 1 - i)) & 1) * (m[k - i] << i);
            }
        }
    }
    std::array::from_fn(|k| m[k] << (52 - k))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unshifted(dimensions: usize) -> Sequence {
        Sequence::new(dimensions, vec![0; dimensions])
    }

    /// The first points that Joe and Kuo print beside their table.
    #[test]
    fn first_points_are_known() {
        let mut sequence = unshifted(3);
        let expected = [
            [0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5],
            [0.75, 0.25, 0.25],
            [0.25, 0.75, 0.75],
            [0.375, 0.375, 0.625],
            [0.875, 0.875, 0.125],
            [0.625, 0.125, 0.875],
            [0.125, 0.625, 0.375],
        ];
        for point in expected {
            assert_eq!(sequence.next_point(), point);
        }
    }

    /// Point 1000 of 32 dimensions as scipy 1.17.1 gives it (`qmc.Sobol(32, scramble=False)`), times 1024.
    #[test]
    fn point_1000_is_known() {
        let expected = [
            225, 99, 531, 693, 287, 929, 47, 921, 513, 71, 87, 261, 165, 393, 147, 379, 737, 353, 1015, 743,
            535, 563, 973, 553, 597, 929, 41, 1003, 61, 349, 151, 149,
        ];
        let mut sequence = unshifted(32);
        let point = (0..=1000).map(|_| sequence.next_point()).last().unwrap();
        assert_eq!(point, expected.map(|k| f64::from(k) / 1024.0));
    }

    /// Every interval [k/256, (k + 1)/256) of every axis holds one of the first 256 points, shifted or not.
    #[test]
    fn every_axis_is_stratified() {
        let shift = (0..32).map(|d| 0x0012_3456_789a_bcde_u64.rotate_left(d) & ((1 << 53) - 1)).collect();
        for mut sequence in [unshifted(32), Sequence::new(32, shift)] {
            let points: Vec<Point> = (0..256).map(|_| sequence.next_point()).collect();
            for axis in 0..32 {
                let mut seen = [false; 256];
                for point in &points {
                    seen[(256.0 * point[axis]) as usize] = true;
                }
                assert_all!(seen.iter(), |seen| *seen);
            }
        }
    }

    /// Squared L2 star discrepancy, T. T. Warnock (1972).
    fn discrepancy(points: &[Point]) -> f64 {
        let (n, d) = (points.len() as f64, points[0].len());
        let single: f64 = points.iter().map(|p| p.iter().map(|x| 0.5 * (1.0 - x * x)).product::<f64>()).sum();
        let corner = |p: &Point, q: &Point| p.iter().zip(q).map(|(x, y)| 1.0 - x.max(*y)).product::<f64>();
        let pairs: f64 = points.iter().map(|p| points.iter().map(|q| corner(p, q)).sum::<f64>()).sum();
        3.0_f64.powf(-(d as f64)) - 2.0 * single / n + pairs / (n * n)
    }

    /// As scipy 1.17.1 gives it (`qmc.discrepancy`, method L2-star), an eighth of what random points have on average.
    #[test]
    fn discrepancy_is_low() {
        let mut sequence = unshifted(5);
        let points: Vec<Point> = (0..512).map(|_| sequence.next_point()).collect();
        // Round-off of sums of 512² terms up to 1 over 512².
        assert!((discrepancy(&points) - 6.850_419_136_950_06e-6).abs() < 1e-14, "{}", discrepancy(&points));
        let random = (2.0_f64.powi(-5) - 3.0_f64.powi(-5)) / 512.0;
        assert_below!(discrepancy(&points), random / 7.0);
    }
}
