//! A dashpot that gives a chosen coefficient of restitution.
//!
//! # Equation
//! ```text
//! F = k δ^n + c v,   c = 2 β √( (n+1)/(2n) · (dF_el/dδ) · m* ),   β = -ln e / √(π² + ln² e)  A5
//! ```
//! For n = 1 this is the linear dashpot 2 β √(k m*), for n = 3/2 Tsuji's with α = √5 β. The substitution
//! y ~ δ^((n+1)/2) turns the impact into a linear oscillator with damping ratio β, so e is exact for every
//! power n and every speed, as long as the contact ends where the overlap is back at zero.
//!
//! # Source
//! Y. Tsuji, T. Tanaka and T. Ishida, Powder Technol. 71, 239 (1992); D. Antypov and J. A. Elliott, EPL 94,
//! 50004 (2011).
//!
//! # Symbols
//! | symbol   | name in code                | unit  | meaning                                        |
//! |----------|-----------------------------|-------|------------------------------------------------|
//! | e        | `restitution`               | -     | speed after over speed before, 0 <= e <= 1     |
//! | β        | `damping_ratio`             | -     | part of critical damping                       |
//! | n        | `normal.exponent()`         | -     | power of the overlap in the elastic force      |
//! | dF_el/dδ | `normal.tangent_stiffness()`| N/m   | slope of the elastic force                     |
//! | m*       | `effective_mass`            | kg    | m_i m_j / (m_i + m_j)                          |
//! | c        | `coefficient`               | N s/m | dashpot                                        |
//!
//! # Critical step
//! Γ = c/m* at the largest overlap that the limits allow; looked at every 100 steps.
//!
//! # Valid when
//! e does not depend on speed. e = 0 is critical damping: grains do not rebound, nor do they part by
//! themselves. With `strain_power` the elastic force is a power of δ for δ ≪ R only; e follows to that order.
//!
//! # Compared with others
//! The force may pull near the end of the contact. Codes that clamp it at zero get a higher restitution: 0.55
//! for a wanted 0.5.
//!
//! # In a scenario
//! ```toml
//! [contact.damping.restitution]
//! restitution = 0.9
//!
//! [[mixtures]]
//! between = ["grain", "grain"]
//! restitution = 0.8
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::contact::{Elastic, PairConstants, ContactGeometry, damping::{DampingLaw, Restitution}};
//! let spring = Elastic { stiffness: 400.0, damped_part: 1.0, ..Default::default() };
//! let geometry = ContactGeometry { effective_mass: 1.0, ..Default::default() };
//! let (law, mut pair) = (Restitution { restitution: 0.0 }, PairConstants::default());
//! law.settle(&mut pair, None);
//! let dashpot = law.coefficient(&pair, &geometry, &spring);
//! assert_eq!(dashpot, 2.0 * 20.0);
//! ```

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::DampingLaw;
use crate::contact::{ContactGeometry, Elastic, PairConstants};
use crate::law::{Context, Faults, Law};
use crate::math::Real;
use crate::particles::Mixture;

/// Damping from a restitution coefficient.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Restitution {
    /// Normal restitution e in [0, 1]; a pair of materials may have its own.
    pub restitution: f64,
}

impl Law for Restitution {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        faults.within("restitution", self.restitution, 0.0, 1.0);
    }
}

impl DampingLaw for Restitution {
    const TAKES_STIFFNESS: bool = true;

    /// 0 where the elastic force does not grow with the overlap.
    #[inline(always)]
    fn coefficient<F: Real>(
        &self,
        pair: &PairConstants<F>,
        geometry: &ContactGeometry<F>,
        elastic: &Elastic<F>,
    ) -> F {
        let stiffness = elastic.stiffness.max(F::of(0.0));
        let critical = (elastic.damped_part * stiffness * geometry.effective_mass).sqrt();
        F::of(2.0) * pair.damping_ratio * critical
    }

    fn settle(&self, pair: &mut PairConstants, own: Option<&Mixture>) {
        let own = own.and_then(|own| own.restitution);
        pair.damping_ratio = damping_ratio(own.unwrap_or(self.restitution));
    }

    fn reads_restitution(&self) -> bool {
        true
    }
}

/// Part of critical damping [-] that gives this restitution: -ln e / √(π² + ln² e); 1 for e = 0.
#[inline]
pub fn damping_ratio(restitution: f64) -> f64 {
    if restitution <= 0.0 {
        return 1.0;
    }
    if restitution >= 1.0 {
        return 0.0;
    }
    let log = restitution.ln();
    -log / (PI * PI + log * log).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Damping;
    use crate::contact::collision::HeadOn;
    use crate::contact::normal::{Hertz, Hooke, Normal, StrainPower};
    use crate::units::Quantity;

    fn rebound_speed(normal: &Normal, wanted: f64, mut pair: PairConstants, speed: f64, dt: f64) -> f64 {
        let law = Damping::Restitution(Restitution { restitution: wanted });
        law.settle(&mut pair, None);
        let geometry = ContactGeometry::new([2.5e-3, 4e-3], [2.6e-4, 1.1e-3], [1e7; 2], 6.5e-3);
        HeadOn { pair, geometry, normal, damping: Some(&law), speed }.integrate(dt).restitution
    }

    /// Chung and Ooi (2011), test 3, with no clamp of the tensile end. What is left is the step's error.
    #[test]
    fn restitution_comes_back() {
        let hertz = Normal::Hertz(Hertz {});
        let hooke = Normal::Hooke(Hooke { stiffness: Quantity(1e6) });
        let stiff = PairConstants { effective_modulus: 2e11, ..Default::default() };
        for wanted in [0.2, 0.4, 0.6, 0.8, 0.9, 1.0] {
            let linear = rebound_speed(&hooke, wanted, PairConstants::default(), 3.9, 1e-8);
            assert!((linear - wanted).abs() < 1e-6, "hooke {wanted}: {linear}");
            for speed in [0.01, 3.9] {
                let found = rebound_speed(&hertz, wanted, stiff, speed, 2e-9 / speed.powf(0.2));
                assert!((found - wanted).abs() < 1e-4, "hertz {wanted}: {found}");
            }
        }
    }

    /// The area's departure from 2 π R* δ is of order δ/R: 1e-3 here.
    #[test]
    fn restitution_of_a_strain_power() {
        let law = Normal::StrainPower(StrainPower { exponent: 2.0 });
        for wanted in [0.3, 0.7] {
            let found = rebound_speed(&law, wanted, PairConstants::default(), 1e-5, 1e-5);
            assert!((found - wanted).abs() < 2e-3, "{wanted}: {found}");
        }
    }

    #[test]
    fn edges_and_overrides() {
        assert_eq!([damping_ratio(1.0), damping_ratio(0.0), damping_ratio(-1.0)], [0.0, 1.0, 1.0]);
        // By hand: ln 2 / √(π² + ln² 2).
        assert_near!(damping_ratio(0.5), 0.215_453_761_966, 1e-12);
        let geometry = ContactGeometry { effective_mass: 1.0, ..Default::default() };
        let elastic = Elastic { stiffness: 1.0, damped_part: 1.0, ..Default::default() };
        let own = Mixture {
            between: ["a".to_owned(), "b".to_owned()],
            restitution: Some(1.0),
            static_friction: None,
            dynamic_friction: None,
        };
        let law = Restitution { restitution: 0.1 };
        let mut pair = PairConstants::default();
        law.settle(&mut pair, None);
        assert_eq!(law.coefficient(&pair, &geometry, &elastic), 2.0 * damping_ratio(0.1));
        law.settle(&mut pair, Some(&own));
        assert_eq!(law.coefficient(&pair, &geometry, &elastic), 0.0);
    }
}
