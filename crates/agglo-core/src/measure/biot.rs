//! The number that says whether a sphere is as uniform as the laws take it to be.
//!
//! # Equation
//! ```text
//! Bi = h_eff (r/3)/k,   h_eff = h + 4 σ ε T³
//! ```
//! r/3 is the sphere's volume over its surface; 4 σ ε T³ is the slope of the radiated flux σ ε T⁴.
//!
//! # Source
//! F. P. Incropera and D. P. DeWitt, *Fundamentals of Heat and Mass Transfer*, chapter 5 (lumped heat capacity).
//!
//! # Symbols
//! | symbol | name in code   | unit      | meaning                                                    |
//! |--------|----------------|-----------|------------------------------------------------------------|
//! | h      | `convection`   | W/(m² K)  | heat transfer coefficient                                  |
//! | ε      | `emissivity`   | 1         |                                                            |
//! | T      | `temperature`  | K         | of the surface                                             |
//! | k      | `conductivity` | W/(m K)   | of the sphere                                              |
//! | r      | `radius`       | m         |                                                            |
//!
//! # Valid when
//! One temperature for a sphere holds for Bi < 0.1.
//!
//! # Compared with others
//! Radiation to colder surroundings is here taken at its slope, which is up to four times its mean coefficient: the Biot
//! number is then too large, on the side of caution.
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::measure::biot_number;
//! // A steel ball of 1 mm in still air, cold: h r/(3 k) = 10 * 1e-3/(3 * 40).
//! assert_eq!(biot_number(1e-3, 40.0, 10.0, 0.0, 300.0), Some(10.0 * 1e-3 / 120.0));
//! ```

use crate::constants::STEFAN_BOLTZMANN;

/// Bi of a sphere of `radius` [m] and `conductivity` [W/(m K)] with the heat transfer coefficient `convection`
/// [W/(m² K)], the `emissivity` and the `temperature` [K] of its surface; nothing where it does not conduct.
pub fn biot_number(
    radius: f64,
    conductivity: f64,
    convection: f64,
    emissivity: f64,
    temperature: f64,
) -> Option<f64> {
    let coefficient = convection + 4.0 * STEFAN_BOLTZMANN * emissivity * temperature.powi(3);
    (conductivity > 0.0).then(|| coefficient * radius / (3.0 * conductivity))
}

/// Whether a sphere of this Biot number has one temperature.
pub fn is_uniform(biot: f64) -> bool {
    biot < 0.1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// T = 1000 K, ε = 0.5, h = 20 W/(m² K): 4 * 5.670374419e-8 * 0.5 * 1e9 = 113.40748838; with r = 6 mm and
    /// k = 2 W/(m K) Bi = 133.40748838 * 6e-3/6 = 0.13340748838. To the rounding of four products.
    #[test]
    fn biot_by_hand() {
        let found = biot_number(6e-3, 2.0, 20.0, 0.5, 1000.0).unwrap();
        assert!((found - 0.133_407_488_38).abs() < 1e-15, "{found}");
        // Twice as hot radiates eight times as steeply.
        let [once, twice] = [500.0, 1000.0].map(|hot| biot_number(1.0, 1.0, 0.0, 1.0, hot).unwrap());
        assert_near!(twice / once, 8.0, 1e-14);
        assert_eq!(biot_number(1.0, 0.0, 1.0, 1.0, 300.0), None);
    }
}
