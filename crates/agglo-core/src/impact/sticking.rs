//! What becomes of a pair that sticks, and the sphere that two merged spheres are.
//!
//! # Equation
//! ```text
//! m = m_i + m_j,   m v = m_i v_i + m_j v_j,   m r = m_i r_i + m_j r_j
//! C = C_i + C_j,   C T = C_i T_i + C_j T_j,   b³ = b_i³ + b_j³,   n = n_i + n_j          B6
//! ```
//! A pair sticks where its restitution is 0: where P ≥ 2H with `hardness`, always with `constant` at 0.
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), remarks 2.1 and section 3.
//!
//! # Symbols
//! | symbol | name in code    | unit | meaning                                        |
//! |--------|-----------------|------|------------------------------------------------|
//! | m      | `mass`          | kg   |                                                |
//! | v      | `velocity`      | m/s  |                                                |
//! | r      | `position`      | m    | center; the merged sphere's is the center of mass |
//! | C      | `heat_capacity` | J/K  | of the whole body                              |
//! | T      | `temperature`   | K    |                                                |
//! | b      | `radius`        | m    |                                                |
//! | n      | `primaries`     | -    | grains that it is made of                      |
//!
//! # Valid when
//! The merged sphere has no pores, so it is smaller than the pair was; it keeps no rotation, so angular momentum about
//! the common center is lost. Its material is that of the heavier partner (of equal ones, the one named first in the
//! alphabet): with two materials a sphere is a mixture that has the laws of its larger part.
//!
//! # Compared with others
//! `merge` is the paper's. `never` leaves two spheres which do not part along the normal, as in gases of sticky hard
//! spheres. A pair that breaks does not merge.
//!
//! # In a scenario
//! ```toml
//! [impact]
//! sticking = "merge"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::{Body, sticking::merged};
//! use agglo::math::Vec3;
//! let one = Body { mass: 1.0, radius: 1.0, temperature: 300.0, primaries: 1, ..Body::default() };
//! let (both, place) = merged([&one, &one], [Vec3::ZERO, Vec3::new(2.0, 0.0, 0.0)]);
//! assert_eq!((both.mass, both.primaries, place.x), (2.0, 2, 1.0));
//! assert!((both.radius - 2.0_f64.cbrt()).abs() < 1e-15);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Body;
use crate::law::{Chosen, Law};
use crate::math::Vec3;

/// What becomes of a pair with restitution 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sticking {
    /// It becomes one sphere ([B], remarks 2.1).
    #[default]
    Merge,
    /// It goes on as two spheres without relative velocity along the normal.
    Never,
}

impl Law for Sticking {}

impl Sticking {
    /// The law that is chosen.
    pub fn chosen(&self) -> Chosen<'_> {
        let key = match self {
            Self::Merge => "impact.sticking.merge",
            Self::Never => "impact.sticking.never",
        };
        Chosen::new(key, self)
    }
}

/// The sphere that two become, and the place [m] of its center. Swapping the two gives the same bits.
///
/// Both places must be of the same image, if space is periodic.
pub fn merged(bodies: [&Body; 2], positions: [Vec3; 2]) -> (Body, Vec3) {
    let [a, b] = bodies;
    let mass = a.mass + b.mass;
    let heat_capacity = a.heat_capacity + b.heat_capacity;
    let temperature = if heat_capacity > 0.0 {
        (a.heat_capacity * a.temperature + b.heat_capacity * b.temperature) / heat_capacity
    } else {
        (a.mass * a.temperature + b.mass * b.temperature) / mass
    };
    let heavier = if a.mass == b.mass {
        a.material.min(b.material)
    } else if a.mass > b.mass {
        a.material
    } else {
        b.material
    };
    let body = Body {
        velocity: common_velocity(bodies),
        mass,
        radius: (a.radius * a.radius * a.radius + b.radius * b.radius * b.radius).cbrt(),
        temperature,
        heat_capacity,
        material: heavier,
        primaries: a.primaries.saturating_add(b.primaries),
    };
    (body, positions[0] * (a.mass / mass) + positions[1] * (b.mass / mass))
}

/// Velocity [m/s] of the center of mass of two bodies.
#[inline]
pub fn common_velocity([a, b]: [&Body; 2]) -> Vec3 {
    (a.velocity * a.mass + b.velocity * b.mass) * (1.0 / (a.mass + b.mass))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair() -> [Body; 2] {
        let light = Body {
            velocity: Vec3::new(1.0, -2.0, 3.0),
            mass: 0.3,
            radius: 0.7,
            temperature: 1000.0,
            heat_capacity: 60.0,
            material: 1,
            primaries: 2,
        };
        let heavy = Body {
            velocity: Vec3::new(-4.0, 0.5, 0.0),
            mass: 1.1,
            radius: 1.3,
            temperature: 400.0,
            heat_capacity: 140.0,
            material: 3,
            primaries: 9,
        };
        [light, heavy]
    }

    /// Sums of what is kept; round-off of three operations each.
    #[test]
    fn what_is_kept() {
        let [a, b] = pair();
        let (one, place) = merged([&a, &b], [Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO]);
        let momentum = a.velocity * a.mass + b.velocity * b.mass;
        assert_near_vector!(one.velocity * 1.4, momentum, 1e-15);
        assert_near!(one.mass, 1.4, 1e-15, "in kg");
        assert_near!(one.heat_capacity, 200.0, 1e-13);
        assert_near!(one.temperature * 200.0, 6e4 + 5.6e4, 1e-10);
        assert_near!(one.radius.powi(3), 0.343 + 2.197, 1e-14);
        assert_near_vector!(place, Vec3::new(1.0, 2.0, 3.0) * (0.3 / 1.4), 1e-15, "in m");
        assert_eq!((one.primaries, one.material), (11, 3));
    }

    #[test]
    fn order_does_not_matter_to_the_bit() {
        let [a, b] = pair();
        let places = [Vec3::new(1e-3, 0.1, 7.0), Vec3::new(0.3, -0.2, 0.1)];
        assert_eq!(merged([&a, &b], places), merged([&b, &a], [places[1], places[0]]));
        let twin = Body { mass: a.mass, ..b };
        assert_eq!(merged([&a, &twin], places).0.material, 1);
        assert_eq!(merged([&twin, &a], places).0.material, 1);
    }

    /// Without heat capacities the temperature is the mean by mass; with one, that of the body that has it.
    #[test]
    fn temperatures_without_heat_capacity() {
        let [a, b] = pair().map(|body| Body { heat_capacity: 0.0, ..body });
        let (one, _) = merged([&a, &b], [Vec3::ZERO; 2]);
        assert_near!(one.temperature, (300.0 + 440.0) / 1.4, 1e-12, "in K");
        let warm = Body { heat_capacity: 2.0, ..b };
        assert_eq!(merged([&a, &warm], [Vec3::ZERO; 2]).0.temperature, 400.0);
    }
}
