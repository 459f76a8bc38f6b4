//! How thick the skins of the pair lists are.
//!
//! A thick skin lasts longer but lists more pairs that do not touch. That of contacts adapts to how long the last lists
//! lasted; that of the near field is a part of its cut-off. Results do not depend on them.

use crate::math::parallel;

/// Evaluations that a list should serve.
const WANTED_AGE: u32 = 20;
/// Listed pairs per grain beyond which the skin is not thickened.
const MOST_PAIRS: usize = 10;
/// Skin of the near field's list over the cut-off.
const NEAR_PART: f64 = 0.2;

/// The skin of the pair list.
#[derive(Clone, Debug)]
pub struct Skin {
    thickness: f64,
    thinnest: f64,
    thickest: f64,
    age: u32,
    near_part: f64,
}

impl Skin {
    /// A first guess for grains of these radii [m].
    pub fn new(radii: &[f64]) -> Self {
        let mean = parallel::mean(radii);
        Self {
            thickness: 0.2 * mean,
            thinnest: 0.1 * mean,
            thickest: 4.0 * mean,
            age: 0,
            near_part: NEAR_PART,
        }
    }

    /// One that stays as it is: of this thickness [m], and this part of the near field's cut-off.
    #[cfg(test)]
    pub fn fixed(thickness: f64, near_part: f64) -> Self {
        Self { thickness, thinnest: thickness, thickest: thickness, age: 0, near_part }
    }

    /// Thickness [m].
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Skin [m] of the near field's list with this cut-off [m].
    pub fn of_near_field(&self, cutoff: f64) -> f64 {
        self.near_part * cutoff
    }

    /// One more evaluation was served.
    pub fn age(&mut self) {
        self.age += 1;
    }

    /// Thickens or thins the skin for the next list.
    pub fn adapt(&mut self, pairs: usize, grains: usize) {
        let crowded = pairs > MOST_PAIRS * grains;
        if self.age < WANTED_AGE && !crowded {
            self.thickness = (1.5 * self.thickness).min(self.thickest);
        } else if self.age > 10 * WANTED_AGE || crowded {
            self.thickness = (0.8 * self.thickness).max(self.thinnest);
        }
        self.age = 0;
    }
}
