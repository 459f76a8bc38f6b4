//! Heat of the reaction that an impact sets off, in proportion to the contact area.
//!
//! # Equation
//! ```text
//! δH = α a_c,   α = (α_i + α_j)/2                                                       [B] 6.9
//! ```
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 6 a.
//!
//! # Symbols
//! | symbol | name in code    | unit | meaning                                                     |
//! |--------|-----------------|------|-------------------------------------------------------------|
//! | δH     | `reaction_heat` | J    | put into the pair                                           |
//! | α      | `per_area`      | J/m² | `reaction_heat` of a material; 0 if it has none             |
//! | a_c    | `area`          | m²   | contact area, see `contact_area`                            |
//!
//! # Valid when
//! The reacting gas is adsorbed on the surfaces and all of it in the contact reacts, at every impact anew: it is never used up.
//!
//! # Compared with others
//! [B] has one material; the mean of two is ours, so that a pair of one material has its own α. In the consistent balance
//! the pair shares δH; [B] 6.8 gives all of it to each partner. Its α of 1e13 J/m² and more heats grains to 1e9 K.
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! heat_capacity = "1000 J/(kg K)"
//! reaction_heat = "1e5 J/m^2"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::reaction_heat::{of_pair, reaction_heat};
//! assert_eq!(reaction_heat(of_pair([1e3, 3e3]), 1e-6), 2e-3);
//! ```

/// α [J/m²] of a pair from those of its partners.
#[inline]
pub fn of_pair(per_area: [f64; 2]) -> f64 {
    0.5 * (per_area[0] + per_area[1])
}

/// Heat [J] of a contact of an area [m²].
#[inline]
pub fn reaction_heat(per_area: f64, area: f64) -> f64 {
    per_area * area
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_of_one_material_has_its_own() {
        assert_eq!(of_pair([7e12, 7e12]), 7e12);
        assert_eq!(reaction_heat(of_pair([0.0, 7e12]), 2e-12), 7.0);
    }
}
