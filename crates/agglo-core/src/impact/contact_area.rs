//! Contact area of an impact: the more of the smaller cross-section the more plastic the impact.
//!
//! # Equation
//! ```text
//! a_c = (a0 + (af - a0)(1 - e)) π b²,   b = min(b_i, b_j)                               [B] 4.12
//! ```
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 4.
//!
//! # Symbols
//! | symbol | name in code     | unit | meaning                                                      |
//! |--------|------------------|------|--------------------------------------------------------------|
//! | a_c    | `ContactArea::of`| m²   | area over which the force of the impact acts                 |
//! | a0     | `elastic`        | -    | `elastic_area` of a scenario: a_c/(π b²) at e = 1            |
//! | af     | `sticking`       | -    | `sticking_area` of a scenario: a_c/(π b²) at e = 0           |
//! | e      | `restitution`    | -    |                                                              |
//! | b      | `smaller_radius` | m    |                                                              |
//!
//! # Valid when
//! A linear guess between two ends, without elastic or plastic theory behind it. With a0 = 0 the area goes to zero as e
//! goes to 1; the pressure stays finite, because 1 - e goes to zero with it.
//!
//! # Compared with others
//! Hertz's area goes with the overlap and so with v^(4/5); here it depends on the speed through e alone. Laws of
//! restitution without areas, `constant` and those of pairs of materials, use a0 = 0 and af = 1.
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! hardness = "1 MPa"
//!
//! [impact.restitution.hardness]
//! elastic_area = 0.1
//! sticking_area = 1.0
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::contact_area::ContactArea;
//! let area = ContactArea { elastic: 0.2, sticking: 1.0 };
//! let by_hand = 0.6 * std::f64::consts::PI * 1e-6; // halfway between 0.2 and 1, b = 1 mm
//! assert!((area.of(0.5, 1e-3) / by_hand - 1.0).abs() < 1e-14);
//! ```

use std::f64::consts::PI;

/// How the contact area depends on the restitution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactArea {
    /// a0: area over the smaller cross-section of an elastic impact.
    pub elastic: f64,
    /// af: the same of a sticking impact.
    pub sticking: f64,
}

impl Default for ContactArea {
    fn default() -> Self {
        Self { elastic: 0.0, sticking: 1.0 }
    }
}

impl ContactArea {
    /// Area over the smaller cross-section.
    #[inline]
    pub fn fraction(&self, restitution: f64) -> f64 {
        self.elastic + (self.sticking - self.elastic) * (1.0 - restitution)
    }

    /// Area [m²] for the smaller radius [m].
    #[inline]
    pub fn of(&self, restitution: f64, smaller_radius: f64) -> f64 {
        self.fraction(restitution) * PI * smaller_radius * smaller_radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 0.1 + 0.6·(1 - e) of π·4 at b = 2.
    #[test]
    fn ends_and_middle() {
        let area = ContactArea { elastic: 0.1, sticking: 0.7 };
        for (restitution, part) in [(1.0, 0.1), (0.0, 0.7), (0.25, 0.55)] {
            assert_near!(area.fraction(restitution), part, 1e-15);
            assert_near!(area.of(restitution, 2.0), part * 12.566_370_614_359_172, 1e-14);
        }
        assert_eq!(ContactArea::default().fraction(1.0), 0.0);
        assert_eq!(ContactArea::default().fraction(0.0), 1.0);
    }
}
