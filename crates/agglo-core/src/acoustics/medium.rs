//! The medium between the grains.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::{Density, Velocity, Viscosity};

/// The fluid around the grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Medium {
    /// Density; 0 is allowed where there is no sound and no buoyancy.
    #[serde(default = "water_density")]
    pub density: Density,
    /// Speed of sound.
    #[serde(default = "water_sound_speed")]
    pub sound_speed: Velocity,
    /// Dynamic viscosity; drag needs it above 0.
    #[serde(default = "water_viscosity")]
    pub viscosity: Viscosity,
}

fn water_density() -> Density {
    crate::units::Quantity(1000.0)
}
fn water_sound_speed() -> Velocity {
    crate::units::Quantity(1500.0)
}
fn water_viscosity() -> Viscosity {
    crate::units::Quantity(1e-3)
}

impl Default for Medium {
    fn default() -> Self {
        Self { density: water_density(), sound_speed: water_sound_speed(), viscosity: water_viscosity() }
    }
}

impl Medium {
    /// Acoustic impedance rho c [Pa s/m].
    pub fn impedance(&self) -> f64 {
        self.density.si() * self.sound_speed.si()
    }

    /// Re = 2 R rho v/eta of a sphere of `radius` [m] at `speed` [m/s] relative to the medium; nothing where that has no
    /// viscosity. The flow about it is Stokes's below 1 (R. Clift, J. R. Grace and M. E. Weber, *Bubbles, Drops, and
    /// Particles* (1978), chapter 5).
    #[inline]
    pub fn reynolds_number(&self, radius: f64, speed: f64) -> Option<f64> {
        let viscosity = self.viscosity.si();
        (viscosity > 0.0).then(|| 2.0 * radius * self.density.si() * speed / viscosity)
    }

    /// k a = 2 pi f R/c of sound of a `frequency` [Hz] at a grain of `radius` [m]: rays hold where it is large.
    ///
    /// Below about 10 diffraction matters; far below 1 rays mean nothing and the grain moves with the wave. In
    /// water, 10 asks for 48 MHz at grains of 100 µm across and for 4.8 GHz at 1 µm, the paper's own wavelength
    /// of a tenth of a diameter for three times as much.
    ///
    /// ```
    /// # extern crate agglo_core as agglo;
    /// use agglo::acoustics::Medium;
    /// let ka = Medium::default().wavenumber_radius(20e3, 20e-6);
    /// assert!((ka - std::f64::consts::TAU * 20e3 * 20e-6 / 1500.0).abs() < 1e-18); // 0.0017: no rays here
    /// ```
    pub fn wavenumber_radius(&self, frequency: f64, radius: f64) -> f64 {
        std::f64::consts::TAU * frequency * radius / self.sound_speed.si()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Quantity;

    /// 1 mm of radius at 0.5 m/s in water: 2e-3 m * 1000 kg/m³ * 0.5 m/s/1e-3 Pa s = 1000. To the rounding of four
    /// products.
    #[test]
    fn reynolds_by_hand() {
        let found = Medium::default().reynolds_number(1e-3, 0.5).unwrap();
        assert!((found - 1000.0).abs() < 1e-11, "{found}");
        let inviscid = Medium { viscosity: Quantity(0.0), ..Medium::default() };
        assert_eq!(inviscid.reynolds_number(1e-3, 0.5), None);
    }
}
