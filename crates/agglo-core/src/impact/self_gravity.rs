//! Size from which the gravity between two equal spheres presses them together as hard as sticking does.
//!
//! # Equation
//! ```text
//! G m²/(2b)² = 2 H π b²,   m = (4/3) π ρ b³   =>   b = (3/ρ) √(H/(2 π G))               [B] 4.16
//! ```
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), remark 4.2.
//!
//! # Symbols
//! | symbol | name in code    | unit       | meaning                                             |
//! |--------|-----------------|------------|-----------------------------------------------------|
//! | b      | `critical_radius`| m         |                                                     |
//! | ρ      | `density`       | kg/m³      |                                                     |
//! | H      | `hardness`      | Pa         |                                                     |
//! | G      | `GRAVITATIONAL` | m³/(kg s²) | [B] calls it a gas constant; its value is that of G |
//!
//! # Valid when
//! An order of magnitude, with all of the cross-section in contact. Runs have no gravity between spheres: the quantity says
//! how far from mattering it is.
//!
//! # Compared with others
//! For ρ = 2000 kg/m³ and H = 1 MPa it is 73 km.
//!
//! # In a scenario
//! ```toml
//! # It is no law to choose: `agglo check` tells the size where restitution follows from hardness.
//! [materials.grain]
//! hardness = "1 MPa"
//!
//! [impact.restitution.hardness]
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::self_gravity::critical_radius;
//! assert!((critical_radius(2000.0, 1e6) / 73.25e3 - 1.0).abs() < 1e-3);
//! ```

use std::f64::consts::PI;

use crate::constants::GRAVITATIONAL;

/// Radius [m] at which self-gravity matters, for a density [kg/m³] and a hardness [Pa].
pub fn critical_radius(density: f64, hardness: f64) -> f64 {
    3.0 / density * (hardness / (2.0 * PI * GRAVITATIONAL)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The two sides of [B] 4.16, written out, agree at the radius.
    #[test]
    fn attraction_equals_hardness_over_the_cross_section() {
        let (density, hardness) = (3300.0, 4e5);
        let b = critical_radius(density, hardness);
        let mass = 4.0 / 3.0 * PI * density * b.powi(3);
        let attraction = 6.674_30e-11 * mass * mass / (4.0 * b * b);
        assert_close!(attraction, 2.0 * hardness * PI * b * b, 1e-14);
    }
}
