//! Work of an impact, by straight lines of compression and recovery; used by the published balance of heat alone.
//!
//! # Equation
//! ```text
//! |I| = I* τ/δτ1,                  v_rel = v (1 - τ/δτ1)                 while compressed, 0 < τ < δτ1
//! |I| = I* (1 - (τ - δτ1)/δτ2),    v_rel = -e v (τ - δτ1)/δτ2            while recovering
//! δW  = |∫ |I| v_rel dτ| = (1 - e²) I* v δτ1/6,   I* = 2 Ī               [B] 4.4-4.9
//! Ī   = m* (1 + e) v/(δτ1 + δτ2):   δW = (1 - e²) m* v²/3
//! force_over = "compression":   Ī = m* (1 + e) v/δτ1:   δW = (1 + e)(1 - e²) m* v²/3
//! ```
//! with δτ2 = e δτ1; the durations drop out. The mean force Ī is that which the restitution is worked out with.
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 4.
//!
//! # Symbols
//! | symbol | name in code     | unit | meaning                                          |
//! |--------|------------------|------|--------------------------------------------------|
//! | δW     | `work`           | J    |                                                  |
//! | m*     | `reduced_mass`   | kg   | m_i m_j/(m_i + m_j)                              |
//! | v      | `approach`       | m/s  | along the normal                                 |
//! | e      | `restitution`    | -    |                                                  |
//! | I      |                  | N    | force between the partners; I* its peak, Ī its mean |
//! |        | `force_over`     | -    | over which time the mean is taken                |
//!
//! # Valid when
//! Never strictly: a force that rises in a straight line does not give a speed that falls in one. So δW is two
//! thirds of the kinetic energy lost along the normal, (1 - e²) m* v²/2, which is the same work done once more; with the mean
//! over compression up to four thirds.
//!
//! # Compared with others
//! [B] 6.8 adds δW to the lost kinetic energy of each partner and so makes heat of nothing (`heat.balance = "published"`).
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! heat_capacity = "1000 J/(kg K)"
//! reaction_heat = "1e5 J/m^2"
//!
//! [impact.heat]
//! balance = "published"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::restitution::hardness::ForceTime;
//! use agglo::impact::work::work;
//! assert!((work(ForceTime::Impact, 3.0, 2.0, 0.0) - 4.0).abs() < 1e-14); // m* v²/3
//! assert!((work(ForceTime::Impact, 3.0, 2.0, 0.5) - 3.0).abs() < 1e-14);
//! assert!((work(ForceTime::Compression, 3.0, 2.0, 0.5) - 4.5).abs() < 1e-14);
//! assert_eq!(work(ForceTime::Impact, 3.0, 2.0, 1.0), 0.0);
//! ```

use super::restitution::hardness::ForceTime;

/// Work [J] of an impact whose mean force is taken over a time.
#[inline]
pub fn work(force_over: ForceTime, reduced_mass: f64, approach: f64, restitution: f64) -> f64 {
    let whole = (1.0 - restitution) * (1.0 + restitution) * reduced_mass * approach * approach / 3.0;
    match force_over {
        ForceTime::Impact => whole,
        ForceTime::Compression => (1.0 + restitution) * whole,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::contact_time::durations;

    /// The integrals of [B] 4.7 by Simpson's rule, which is exact for the products of two straight lines.
    #[test]
    fn equals_the_integrals_of_4_7() {
        let simpson =
            |f: &dyn Fn(f64) -> f64, length: f64| length / 6.0 * (f(0.0) + 4.0 * f(0.5 * length) + f(length));
        let cases = [0.0, 0.3, 0.9].into_iter();
        for (restitution, force_over) in
            cases.flat_map(|e| [(e, ForceTime::Impact), (e, ForceTime::Compression)])
        {
            let (mass, v) = (0.02, 35.0);
            let time = durations(0.7, 1e-3, v, restitution);
            let mean_over = match force_over {
                ForceTime::Impact => time.compression + time.recovery,
                ForceTime::Compression => time.compression,
            };
            let peak = 2.0 * mass * (1.0 + restitution) * v / mean_over;
            let pressed = simpson(
                &|t| peak * t / time.compression * v * (1.0 - t / time.compression),
                time.compression,
            );
            let freed = if restitution > 0.0 {
                simpson(
                    &|t| peak * (1.0 - t / time.recovery) * -restitution * v * t / time.recovery,
                    time.recovery,
                )
            } else {
                0.0
            };
            // Round-off of a dozen operations.
            assert_close!(work(force_over, mass, v, restitution), (pressed + freed).abs(), 1e-14, "in J");
        }
    }
}
