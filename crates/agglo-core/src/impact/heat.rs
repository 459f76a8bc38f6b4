//! Where the energy of an impact goes: what is heat, and who gets it.
//!
//! # Equation
//! ```text
//! energy:     Q = ΔK_n + ΔK_t + α a_c - ΔZ,   Q_k = Q m_k/(m_i + m_j) or Q/2              B5, B8
//! published:  Q_k = ΔK_k + δW + α a_c - ΔZ_k,   ΔK_k = m_k (v_k² - v_k'²)/2                [B] 6.8, 6.10
//! T_k' = T_k + Q_k/C_k
//! ```
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 6 a.
//!
//! # Symbols
//! | symbol | name in code       | unit | meaning                                                             |
//! |--------|--------------------|------|---------------------------------------------------------------------|
//! | Q, Q_k | `heat`             | J    | of the pair, and of each partner                                    |
//! | ΔK_n   | `normal`           | J    | kinetic energy lost along the normal, (1 - e²) m* v²/2              |
//! | ΔK_t   | `tangential`       | J    | and across it                                                       |
//! | ΔK_k   | `own_loss`         | J    | one partner's own, in the frame of the box                          |
//! | α a_c  | `reaction`         | J    | see `reaction_heat`                                                 |
//! | δW     | `work`             | J    | see `work`                                                          |
//! | ΔZ     | `surface`          | J    | energy of new surfaces, see `fragmentation`                         |
//! | C_k    | `heat_capacity`    | J/K  | of the whole body, m_k times that of the material                   |
//!
//! # Valid when
//! Temperature is uniform in a grain (small Biot number). A body without heat capacity keeps its temperature; its
//! heat is booked all the same.
//!
//! # Compared with others
//! The published sum counts the lost kinetic energy and, as δW, two thirds of its normal part again, for each partner;
//! the reaction heat goes to each partner in full; and a partner's own ΔK depends on the velocity of the observer, so that it can
//! even cool. Where it would cool to zero or below, the partner keeps its temperature, nothing is booked for it, and
//! the impact counts as not converged. The consistent balance is the same for every observer and makes no energy.
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! heat_capacity = "1000 J/(kg K)"
//! reaction_heat = "1e5 J/m^2"
//!
//! [impact.heat]
//! balance = "energy"
//! share = "mass"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::heat::{Share, parts};
//! assert_eq!(parts(Share::Mass, [1.0, 3.0]), [0.25, 0.75]);
//! assert_eq!(parts(Share::Equal, [1.0, 3.0]), [0.5, 0.5]);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::law::{Context, Law, note_if};
use crate::particles::Property;
use crate::particles::property::{HEAT_CAPACITY, REACTION_HEAT};

/// Heat of an impact.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeatBalance {
    /// What is added up.
    #[serde(default)]
    pub balance: Balance,
    /// How the partners share it.
    #[serde(default)]
    pub share: Share,
}

lone_law!(HeatBalance at "impact", heat);

impl Law for HeatBalance {
    const READS: &'static [Property] = &[HEAT_CAPACITY, REACTION_HEAT];

    fn notes(&self, _: &Context<'_>) -> Vec<String> {
        let note = "impact.heat.balance = published: a pair gets more heat than the energy it lost, and how much depends on the observer; the run's drift does not show it, its row \"false heat\" does; energy is consistent";
        note_if(self.balance == Balance::Published, note)
    }

    fn warnings(&self) -> &'static [&'static str] {
        match self.balance {
            Balance::Energy => &[],
            Balance::Published => &[
                "impact.heat.balance = \"published\" makes heat out of nothing, and its parts depend on the velocity of the \
                 observer",
            ],
        }
    }
}

/// What the heat of a pair is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Balance {
    /// Lost kinetic energy, and reaction heat, less the energy of new surfaces.
    #[default]
    Energy,
    /// The sum that [B] 6.10 prints: with the work of the impact on top, and with each partner's own kinetic energy.
    Published,
}

/// How two partners share heat.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Share {
    /// In proportion to their masses.
    #[default]
    Mass,
    /// Half each.
    Equal,
}

/// Each partner's part of the heat.
#[inline]
pub fn parts(share: Share, masses: [f64; 2]) -> [f64; 2] {
    match share {
        Share::Mass => masses.map(|mass| mass / (masses[0] + masses[1])),
        Share::Equal => [0.5; 2],
    }
}

/// Temperature [K] after `heat` [J], if it stays above zero.
#[inline]
pub fn warmed(temperature: f64, heat_capacity: f64, heat: f64) -> Option<f64> {
    if heat_capacity <= 0.0 {
        return Some(temperature);
    }
    let after = temperature + heat / heat_capacity;
    (after > 0.0).then_some(after)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_add_up_and_follow_the_masses() {
        for masses in [[1.0, 1.0], [1e-9, 3e-7], [5.0, 2.0]] {
            let [a, b] = parts(Share::Mass, masses);
            assert_near!(a + b, 1.0, 1e-15);
            assert_near!(a * masses[1], b * masses[0], 1e-15 * masses[0]);
        }
    }

    #[test]
    fn temperatures_stay_above_zero() {
        assert_eq!(warmed(300.0, 2.0, 10.0), Some(305.0));
        assert_eq!(warmed(300.0, 2.0, -600.0), None);
        assert_eq!(warmed(300.0, 2.0, f64::NAN), None);
        assert_eq!(warmed(300.0, 0.0, -1e9), Some(300.0));
    }
}
