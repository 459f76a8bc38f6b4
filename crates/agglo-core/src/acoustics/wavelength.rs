//! Where rays hold: the wave must be short against a grain.
//!
//! k a = 2 π f R/c is the circumference of a grain of radius R over the wavelength. Below 10 the sound goes around the grain; up
//! to 60 the push of rays is a per cent and more off that of a wave, on hard grains too.

use std::f64::consts::TAU;

use super::{Beam, Medium};
use crate::text::{digits, readable};

/// Below this k a sound goes around a grain instead of being reflected as rays.
const SMALLEST_KA: f64 = 10.0;
/// Up to this one the push of rays is a per cent and more off that of a wave.
const CLOSE_KA: f64 = 60.0;

impl Beam {
    /// What is to be said before a run of the beam of this number and the smallest grain, of radius `smallest` [m].
    pub fn note(&self, number: usize, medium: &Medium, smallest: f64) -> Option<String> {
        let needed = readable(SMALLEST_KA * medium.sound_speed.si() / (TAU * smallest), "Hz");
        let Some(frequency) = self.frequency else {
            return Some(format!(
                "beam {number} has no frequency: rays hold where the wavelength is far below a grain, here from about {needed} (k a = 10)"
            ));
        };
        let ka = medium.wavenumber_radius(frequency.si(), smallest);
        if ka < SMALLEST_KA {
            return Some(format!(
                "beam {number}: k a = {} at {}: rays do not hold below 10, here {needed}; the sound would go around the grains",
                digits(ka),
                readable(frequency.si(), "Hz")
            ));
        }
        (ka < CLOSE_KA).then(|| {
            format!(
                "beam {number}: k a = {}: a wave pushes less than rays do, at 10 to 20 by 3 % on a rigid grain to some 30 % on polystyrene (docs/validity.md)",
                digits(ka)
            )
        })
    }

    /// The warning of a run where the sound would go around the smallest grain, of radius `smallest` [m].
    pub fn warning(&self, number: usize, medium: &Medium, smallest: f64) -> Option<String> {
        let ka = medium.wavenumber_radius(self.frequency?.si(), smallest);
        (ka < SMALLEST_KA).then(|| {
            format!(
                "acoustics.beams.{number}: k a is {ka:.3e} at the smallest grain; rays do not hold below 10, where sound \
                 goes around grains"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Scenario;
    use crate::units::Frequency;

    /// k a = 2 π f R/c = 10 at 2.387 MHz for 1 mm in water at 1500 m/s, and 60 at 14.32 MHz: half a per cent below and above.
    #[test]
    fn a_beam_speaks_up_below_its_frequency() {
        let text = include_str!("../../../../scenarios/acoustic-dispersal-published.toml");
        let beam = Scenario::from_toml(text).unwrap().acoustics().unwrap().beams[0].clone();
        let hertz = |ka: f64| ka * 1500.0 / (TAU * 1e-3);
        let quantity = |number: f64| serde_json::from_str::<Frequency>(&format!("\"{number} Hz\"")).unwrap();
        let with = |ka: f64| Beam { frequency: Some(quantity(hertz(ka))), ..beam.clone() };
        let medium = Medium::default();
        let said = |ka: f64| (with(ka).note(1, &medium, 1e-3), with(ka).warning(1, &medium, 1e-3));
        let (note, warning) = said(0.995 * SMALLEST_KA);
        assert_contains!(note.unwrap(), "rays do not hold below 10, here 2.387 MHz");
        assert_contains!(warning.unwrap(), "acoustics.beams.1: k a is 9.950e0");
        for ka in [1.005 * 10.0, 0.995 * 60.0] {
            let (note, warning) = said(ka);
            assert_contains!(note.unwrap(), "a wave pushes less than rays do");
            assert_eq!(warning, None);
        }
        assert_eq!(said(1.005 * 60.0), (None, None));
        let unknown = Beam { frequency: None, ..beam.clone() };
        assert_contains!(unknown.note(0, &medium, 1e-3).unwrap(), "from about 2.387 MHz");
        assert_eq!(unknown.warning(0, &medium, 1e-3), None);
    }
}
