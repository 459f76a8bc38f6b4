//! Cooling between impacts, by convection to the gas and radiation to the surroundings.
//!
//! # Equation
//! ```text
//! C dT/dt = -h a_s (T - T0) - σ ε a_s (T⁴ - Ts⁴),   a_s = 4 π b²                          [B] 6.19-6.20
//! convection alone:  T = T0 + (T(0) - T0) exp(-h a_s t/C)
//! radiation alone:   t = (C/(σ ε a_s Ts³)) [S(T/Ts)],   S(y) = (artanh(1/y) - arctan(1/y))/2 for y > 1      B9
//! published:         T + Δt dT/dt                                                         [B] 6.21
//! ```
//! With both, t(T) is again a sum of logarithms and an arc tangent; it is inverted to round-off.
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 6 c.
//!
//! # Symbols
//! | symbol | name in code            | unit       | meaning                                            |
//! |--------|-------------------------|------------|----------------------------------------------------|
//! | C      | `heat_capacity`         | J/K        | of the whole body; without it T stays              |
//! | h      | `convection`            | W/(m² K)   |                                                    |
//! | T0     | `gas_temperature`       | K          |                                                    |
//! | σ      | `STEFAN_BOLTZMANN`      | W/(m² K⁴)  |                                                    |
//! | ε      | `emissivity`            | -          | of the material; 0 if it has none                  |
//! | Ts     | `surroundings`          | K          | far away                                           |
//! | b      | `radius`                | m          |                                                    |
//!
//! # Valid when
//! Temperature is uniform in a grain (Biot number h b/(3 k) ≪ 1); bodies do not see one another's radiation; the gas is not
//! heated. Exact means exact for this equation: any step gives the same temperature at its end.
//!
//! # Compared with others
//! [B] 6.21 is one explicit Euler step. From the 1e9 K that the paper's reactions give it lands below zero for any step longer
//! than C/(σ ε a_s T³), far below its shortest step. Then the temperature is held at the colder of surroundings and gas.
//!
//! # In a scenario
//! ```toml
//! [materials.grain]
//! heat_capacity = "1000 J/(kg K)"
//! emissivity = 0.8
//!
//! [impact.cooling]
//! convection = "100 W/(m^2 K)"
//! gas_temperature = "300 K"
//! surroundings = "300 K"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::{Cooling, cooling::Cooler};
//! let law: Cooling = serde_json::from_str(r#"{"convection": "10 W/m2/K", "gas_temperature": "300 K"}"#).unwrap();
//! // Without emissivity: exponential, with C/(h a_s) = 2 s.
//! let after = Cooler::new(&law, 0.0).cooled(400.0, 1.0 / 20.0, 2.0);
//! assert!((after - (300.0 + 100.0 * (-1.0_f64).exp())).abs() < 1e-12);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::decay::Decay;
use crate::constants::STEFAN_BOLTZMANN;
use crate::law::{Context, Faults, Law, note_if};
use crate::math::roots::root_between;
use crate::particles::Property;
use crate::particles::property::{EMISSIVITY, HEAT_CAPACITY, THERMAL_CONDUCTIVITY};
use crate::units::{HeatTransfer, Quantity, Temperature};

/// Convection to the gas and radiation to the surroundings, [B] 6.19-6.21.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cooling {
    /// h: heat transfer coefficient.
    #[serde(default)]
    pub convection: HeatTransfer,
    /// T0: temperature of the gas, for convection.
    #[serde(default = "room_temperature")]
    pub gas_temperature: Temperature,
    /// Ts: temperature of the surroundings, far away, for radiation.
    #[serde(default = "room_temperature")]
    pub surroundings: Temperature,
    /// How it is integrated.
    #[serde(default)]
    pub integration: Integration,
}

lone_law!(Cooling at "impact", cooling);

impl Law for Cooling {
    const READS: &'static [Property] = &[HEAT_CAPACITY, EMISSIVITY, THERMAL_CONDUCTIVITY];

    fn faults(&self, faults: &mut Faults, context: &Context<'_>) {
        if self.integration == Integration::Published && !context.is_stepped {
            // It would be one step from a grain's impact to its next.
            let message = "found \"published\", which takes the engine's steps; engine.event_driven has none"
                .to_owned();
            faults.fail_with("integration", message, "choose \"exact\", or [engine.time_stepped]");
        }
        faults.not_negative("convection", self.convection);
        faults.positive("gas_temperature", self.gas_temperature);
        faults.positive("surroundings", self.surroundings);
    }

    fn notes(&self, _: &Context<'_>) -> Vec<String> {
        let note = "impact.cooling.integration = published: one Euler step overshoots below zero where grains are hot and is then cut; exact does not";
        note_if(self.integration == Integration::Published, note)
    }

    fn warnings(&self) -> &'static [&'static str] {
        match self.integration {
            Integration::Exact => &[],
            Integration::Published => &[
                "impact.cooling.integration = \"published\" overshoots where grains are hot: the answer depends on the step",
            ],
        }
    }
}

fn room_temperature() -> Temperature {
    Quantity(300.0)
}

/// How temperatures are integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Integration {
    /// The solution of the equation: temperatures stay above zero for any step.
    #[default]
    Exact,
    /// One explicit Euler step, [B] 6.21, which overshoots below zero where grains are hot. Then a warning is counted
    /// and the temperature held at the coldest of surroundings and gas.
    Published,
}

/// Cooling of bodies of one material.
#[derive(Clone, Debug)]
pub struct Cooler {
    /// h [W/(m² K)].
    convection: f64,
    /// σ ε [W/(m² K⁴)].
    radiation: f64,
    gas: f64,
    surroundings: f64,
    way: Way,
}

/// How the temperature after a while is worked out.
#[derive(Clone, Debug)]
enum Way {
    /// Nothing changes.
    None,
    /// Exponential.
    Convection,
    /// Toward absolute zero, with both terms.
    ToZero,
    /// Toward an `equilibrium` [K] above zero.
    Radiation { equilibrium: f64, decay: Decay },
    /// One Euler step.
    Euler,
}

impl Cooler {
    /// For a material of an emissivity.
    pub fn new(law: &Cooling, emissivity: f64) -> Self {
        let (convection, radiation) = (law.convection.si(), STEFAN_BOLTZMANN * emissivity);
        let (gas, surroundings) = (law.gas_temperature.si(), law.surroundings.si());
        let way = if convection <= 0.0 && radiation <= 0.0 {
            Way::None
        } else if law.integration == Integration::Published {
            Way::Euler
        } else {
            exact_way(convection, radiation, gas, surroundings)
        };
        Self { convection, radiation, gas, surroundings, way }
    }

    /// Whether anything changes with time.
    pub fn acts(&self) -> bool {
        !matches!(self.way, Way::None)
    }

    /// Temperature [K] after `duration` [s], of a body with `area` over heat capacity [m² K/J].
    pub fn cooled(&self, temperature: f64, area: f64, duration: f64) -> f64 {
        let after = match &self.way {
            Way::None => return temperature,
            Way::Convection => {
                self.gas + (temperature - self.gas) * (-self.convection * area * duration).exp()
            }
            Way::ToZero => self.towards_zero(temperature, area * duration),
            Way::Radiation { equilibrium, decay } => {
                let clock = self.radiation * area * equilibrium.powi(3) * duration;
                let (start, excess) = (temperature / equilibrium, (temperature - equilibrium) / equilibrium);
                equilibrium * decay.after(start, excess, clock)
            }
            Way::Euler => return self.euler(temperature, area, duration).unwrap_or(self.coldest()),
        };
        // Only where the surroundings have 0 K can it get so low.
        after.max(f64::MIN_POSITIVE)
    }

    /// Whether the published step would fall to zero or below, so that the temperature is held.
    pub fn overshoots(&self, temperature: f64, area: f64, duration: f64) -> bool {
        matches!(self.way, Way::Euler) && self.euler(temperature, area, duration).is_none()
    }

    fn euler(&self, temperature: f64, area: f64, duration: f64) -> Option<f64> {
        let flux = self.convection * (temperature - self.gas)
            + self.radiation * (temperature.powi(4) - self.surroundings.powi(4));
        let after = temperature - duration * area * flux;
        (after > 0.0).then_some(after)
    }

    fn coldest(&self) -> f64 {
        self.gas.min(self.surroundings).max(f64::MIN_POSITIVE)
    }

    /// dT/dτ = -h T - σε T⁴ is linear in T^-3; τ is `area` over heat capacity times time.
    fn towards_zero(&self, temperature: f64, duration: f64) -> f64 {
        let fall = 3.0 * self.convection * duration;
        let growth = if fall > 0.0 { fall.exp_m1() / fall } else { 1.0 };
        let radiated = 3.0 * self.radiation * temperature.powi(3) * duration * growth;
        temperature / (fall.exp() + radiated).cbrt()
    }
}

/// Without the published step: by which of the terms there are.
fn exact_way(convection: f64, radiation: f64, gas: f64, surroundings: f64) -> Way {
    if radiation <= 0.0 {
        return Way::Convection;
    }
    let equilibrium = equilibrium(convection / radiation, gas, surroundings);
    let asymmetry = convection / (radiation * equilibrium.powi(3));
    if equilibrium <= 0.0 {
        Way::ToZero
    } else if asymmetry.is_finite() {
        Way::Radiation { equilibrium, decay: Decay::new(asymmetry) }
    } else {
        Way::Convection
    }
}

/// T with (h/σε)(T - T0) + T⁴ - Ts⁴ = 0; it lies between T0 and Ts.
fn equilibrium(ratio: f64, gas: f64, surroundings: f64) -> f64 {
    if ratio <= 0.0 || gas == surroundings {
        return surroundings;
    }
    let gain = |t: f64| {
        ratio * (t - gas) + (t - surroundings) * (t + surroundings) * (t * t + surroundings * surroundings)
    };
    let ends = [gas.min(surroundings), gas.max(surroundings)];
    root_between(gain, ends, ends.map(gain), 0.0).at
}

#[cfg(test)]
#[path = "cooling_tests.rs"]
mod tests;
