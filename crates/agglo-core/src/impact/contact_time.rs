//! Duration of an impact: compression over a length of the smaller radius, and recovery.
//!
//! # Equation
//! ```text
//! δτ1 = 2 β b/v,   δτ2 = e δτ1,   b = min(b_i, b_j)                                      [B] 4.10
//! ```
//! The relative speed falls in a straight line from v to 0 over δτ1, so that the way is v δτ1/2 = β b.
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 4.
//!
//! # Symbols
//! | symbol   | name in code     | unit | meaning                                                    |
//! |----------|------------------|------|------------------------------------------------------------|
//! | δτ1, δτ2 | `Durations`      | s    | compression and recovery                                   |
//! | v        | `approach`       | m/s  | relative speed along the normal, > 0                       |
//! | β        | `deformation`    | -    | length of deformation over the smaller radius              |
//! | b        | `smaller_radius` | m    |                                                            |
//! | e        | `restitution`    | -    |                                                            |
//!
//! # Valid when
//! The time is used for mean forces only: impacts take no time on the clock of a run.
//!
//! # Compared with others
//! Hertz's contact time goes with v^(-1/5). This one is the time to come to rest within β b, whatever the stiffness.
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! hardness = "1 MPa"
//!
//! [impact.restitution.hardness]
//! deformation = 1.0
//! force_over = "impact"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::contact_time::durations;
//! let time = durations(1.0, 1e-3, 10.0, 0.5);
//! assert!((time.compression - 2e-4).abs() < 1e-18 && (time.recovery - 1e-4).abs() < 1e-18);
//! ```

/// How long the two parts of an impact take [s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Durations {
    /// δτ1.
    pub compression: f64,
    /// δτ2.
    pub recovery: f64,
}

/// Durations of an impact at an approach speed [m/s] above zero.
pub fn durations(deformation: f64, smaller_radius: f64, approach: f64, restitution: f64) -> Durations {
    let compression = 2.0 * deformation * smaller_radius / approach;
    Durations { compression, recovery: restitution * compression }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The way of a speed that falls in a straight line from v to 0 is β b, [B] 4.10.
    #[test]
    fn the_way_of_compression() {
        let time = durations(0.3, 2e-6, 150.0, 0.8);
        assert_close!(0.5 * 150.0 * time.compression, 0.3 * 2e-6, 1e-15);
        assert_near!(time.recovery / time.compression, 0.8, 1e-15);
    }
}
