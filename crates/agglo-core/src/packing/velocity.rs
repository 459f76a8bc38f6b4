//! How velocities scatter about their mean.
//!
//! A grain's draw belongs to the seed, the group and the grain's number in it: it does not change with other groups,
//! nor with the number of grains. Only the mean that `centered` takes off depends on all grains of the group.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::units::{Triple, Velocity, vector};

/// The closed set of velocity distributions about the mean velocity of a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum VelocitySpread {
    /// Each component uniform, [B] section 7.
    Uniform(UniformSpread),
    /// Each component normal: a gas in equilibrium.
    Maxwell(Maxwell),
}

/// Components uniform between plus and minus their bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UniformSpread {
    /// Bounds along x, y and z.
    pub bounds: Triple<Velocity>,
}

/// Components normal with one standard deviation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Maxwell {
    /// Standard deviation of each component.
    pub deviation: Velocity,
    /// Whether the group's mean velocity is exact: the mean of the draws is taken off.
    #[serde(default)]
    pub centered: bool,
}

/// Blocks of random numbers set aside for a grain; a draw uses three at the most.
const BLOCKS_PER_GRAIN: u64 = 4;

impl VelocitySpread {
    /// Velocities [m/s] about zero for grains number `grains` of a group, with their masses in any unit.
    pub(super) fn draw(&self, seed: u64, group: usize, grains: &[(usize, f64)]) -> Vec<Vec3> {
        let mut stream = Stream::new(seed, Purpose::Velocity, group as u32);
        let mut draws: Vec<Vec3> = grains
            .iter()
            .map(|&(number, _)| {
                stream.jump_to(BLOCKS_PER_GRAIN * number as u64);
                self.sample(&mut stream)
            })
            .collect();
        if let Self::Maxwell(Maxwell { centered: true, .. }) = self {
            let (mut momentum, mut mass) = (Vec3::ZERO, 0.0);
            for (&draw, &(_, of_grain)) in draws.iter().zip(grains) {
                momentum += draw * of_grain;
                mass += of_grain;
            }
            let mean = momentum / mass;
            for draw in &mut draws {
                *draw -= mean;
            }
        }
        draws
    }

    fn sample(&self, stream: &mut Stream) -> Vec3 {
        match self {
            Self::Uniform(spread) => {
                let bounds = vector(spread.bounds);
                let mut signed = || 2.0 * stream.uniform() - 1.0;
                let [x, y, z] = [signed(), signed(), signed()];
                Vec3::new(x * bounds.x, y * bounds.y, z * bounds.z)
            }
            Self::Maxwell(spread) => {
                let [x, y, z] = [stream.normal(), stream.normal(), stream.normal()];
                Vec3::new(x, y, z) * spread.deviation.si()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Quantity;

    const N: usize = 400_000;

    fn equal_masses() -> Vec<(usize, f64)> {
        (0..N).map(|number| (number, 1.0)).collect()
    }

    fn maxwell(deviation: f64, centered: bool) -> VelocitySpread {
        VelocitySpread::Maxwell(Maxwell { deviation: Quantity(deviation), centered })
    }

    /// Means of the powers 1, 2 and 4 of each component and of the product of every two, each within five standard
    /// errors: a uniform one has 0, b²/3, b⁴/5, a normal one 0, s², 3 s⁴; components do not depend on one another.
    #[test]
    fn moments() {
        let bounds = [100.0, 10.0, 0.5];
        let uniform = VelocitySpread::Uniform(UniformSpread { bounds: bounds.map(Quantity) });
        // Moments 2, 4 and 8 of a distribution whose bound or deviation is 1.
        let cases = [
            (uniform, bounds, [1.0 / 3.0, 0.2, 1.0 / 9.0]),
            (maxwell(3.0, false), [3.0; 3], [1.0, 3.0, 105.0]),
        ];
        for (spread, scale, moments) in cases {
            let [second, fourth, eighth]: [f64; 3] = moments;
            let draws = spread.draw(7, 2, &equal_masses());
            let n = N as f64;
            let mean = |power: &dyn Fn(&Vec3) -> f64| draws.iter().map(power).sum::<f64>() / n;
            for axis in 0..3 {
                let of = |draw: &Vec3| draw[axis] / scale[axis];
                let next = (axis + 1) % 3;
                let root = n.sqrt();
                assert_below!(mean(&|draw| of(draw)).abs(), 5.0 * second.sqrt() / root);
                let variance = mean(&|draw| of(draw).powi(2));
                assert_near!(variance, second, 5.0 * (fourth - second * second).sqrt() / root);
                assert_close!(variance, second, 0.015);
                let kurtosis = mean(&|draw| of(draw).powi(4));
                assert_near!(kurtosis, fourth, 5.0 * (eighth - fourth * fourth).sqrt() / root);
                let product = mean(&|draw| of(draw) * draw[next] / scale[next]);
                assert_below!(product.abs(), 5.0 * second / root);
            }
        }
    }

    #[test]
    fn uniform_draws_reach_their_bounds_and_do_not_pass_them() {
        let bounds = [1.0, 2.0, 0.0].map(Quantity);
        let draws = VelocitySpread::Uniform(UniformSpread { bounds }).draw(1, 0, &equal_masses());
        let most = draws.iter().fold(Vec3::ZERO, |most, draw| most.max(*draw));
        let least = draws.iter().fold(Vec3::ZERO, |least, draw| least.min(*draw));
        // Of 400,000 draws the largest misses the bound by 1e-4 of it with probability e^-20.
        assert_between!(most.x, 0.9999..=1.0);
        assert_between!(most.y, 1.9998..=2.0);
        assert_eq!(most.z, 0.0);
        assert_between!(least.x, -1.0..=-0.9999);
        assert_between!(least.y, -2.0..=-1.9998);
    }

    /// The mass-weighted mean is nothing but round-off: 4e5 roundings of 1e-16 of some m/s, divided by their number.
    #[test]
    fn centered_draws_have_no_momentum() {
        let grains: Vec<(usize, f64)> = (0..N).map(|number| (number, 1.0 + (number % 10) as f64)).collect();
        let weighted = |draws: &[Vec3]| {
            let sum = draws.iter().zip(&grains).fold(Vec3::ZERO, |sum, (draw, grain)| sum + *draw * grain.1);
            sum.norm() / grains.iter().map(|grain| grain.1).sum::<f64>()
        };
        let (about, centered) =
            (maxwell(3.0, false).draw(7, 0, &grains), maxwell(3.0, true).draw(7, 0, &grains));
        assert_above!(weighted(&about), 1e-4);
        assert_below!(weighted(&centered), 1e-14);
        let taken_off = about[0] - centered[0];
        assert_all!(about.iter().zip(&centered), |(a, b)| (*a - *b - taken_off).norm() < 1e-14);
        assert_eq!(maxwell(3.0, true).draw(7, 0, &[(3, 2.0)]), [Vec3::ZERO]);
    }

    #[test]
    fn a_draw_belongs_to_seed_group_and_number() {
        let spread = maxwell(1.0, false);
        let all = spread.draw(1, 5, &[(0, 1.0), (1, 1.0), (2, 1.0)]);
        assert_eq!(spread.draw(1, 5, &[(2, 9.0)]), [all[2]]);
        assert_ne!(spread.draw(1, 4, &[(2, 1.0)]), [all[2]]);
        assert_ne!(spread.draw(2, 5, &[(2, 1.0)]), [all[2]]);
    }
}
