//! What the cut-off of the near field leaves out, measured where grains are.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::domain::Space;
use crate::engine::SimError;
use crate::fields::NearField;
use crate::math::Vec3;
use crate::particles::Particles;

use super::laws::{near_force, source};

/// Pairs that are looked at, about.
const PAIRS: usize = 20_000_000;
/// Fewest and most grains that are looked at.
const SAMPLE: (usize, usize) = (16, 400);

/// What a cut-off makes of the near field.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Truncation {
    /// Force that it takes from grains over the force of all pairs, root mean squares.
    pub forces: f64,
    /// Energy of the pairs within it, zero at the cut-off, over that of all pairs, zero at infinity: 1 where nothing is left
    /// out, below 0 where the sign has turned. Nothing where all pairs have none.
    pub energy: Option<f64>,
}

/// The truncation over an evenly spaced sample of grains; nothing without a cut-off.
pub fn truncation(law: &NearField, grains: &Particles, space: &Space) -> Option<Truncation> {
    law.cutoff?;
    let n = grains.len();
    let whole = NearField { cutoff: None, ..law.clone() };
    let sample = (PAIRS / n.max(1)).clamp(SAMPLE.0, SAMPLE.1).min(n);
    let sums: Vec<[f64; 4]> = (0..sample)
        .into_par_iter()
        .map(|number| {
            let grain = number * n / sample;
            let others = || (0..n).filter(move |other| *other != grain);
            let force = |law: &NearField| -> Vec3 {
                others().map(|other| near_force(law, grains, space, &grains.position, [grain, other])).sum()
            };
            let energy = |law: &NearField| -> f64 {
                let of = |other: usize| {
                    let apart = space.shortest(grains.position[grain] - grains.position[other]);
                    let distance = apart.norm();
                    law.energy(&source(grains, grain), &source(grains, other), distance)
                };
                others().map(of).sum()
            };
            let all = force(&whole);
            [(all - force(law)).norm_squared(), all.norm_squared(), energy(law), energy(&whole)]
        })
        .collect();
    let sum = |part: usize| -> f64 { sums.iter().map(|one| one[part]).sum() };
    let [left_out, all, within, total] = [0, 1, 2, 3].map(sum);
    let energy = (total != 0.0).then(|| within / total).filter(|energy| energy.is_finite());
    Some(Truncation { forces: if all > 0.0 { (left_out / all).sqrt() } else { 0.0 }, energy })
}

/// Holds a cut-off to what the scenario allows.
///
/// # Errors
/// [`SimError::Truncated`] where it leaves out more.
pub fn hold(
    law: Option<&NearField>,
    grains: &Particles,
    space: &Space,
) -> Result<Option<Truncation>, SimError> {
    let Some(law) = law else { return Ok(None) };
    match truncation(law, grains, space) {
        Some(Truncation { forces: part, .. }) if part > law.truncation => {
            Err(SimError::Truncated { part, limit: law.truncation })
        }
        found => Ok(found),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::near_field::{Coulomb, NearFieldLaw};
    use crate::particles::Row;
    use crate::units::Quantity;

    /// Four equal charges in a row, 1 m apart, cut off at 1.5 m: forces of all pairs are -49/36, -1/4, 1/4, 49/36 and
    /// what is left out -13/36, -1/4, 1/4, 13/36 of q²/(4 π ε).
    #[test]
    fn four_charges_by_hand() {
        let mut grains = Particles::default();
        for k in 0..4_u32 {
            let position = Vec3::new(f64::from(k), 0.0, 0.0);
            grains.push(Row {
                id: k,
                position,
                mass: 1.0,
                radius: 0.1,
                charge: 1e-9,
                polarity: 1.0,
                ..Row::default()
            });
        }
        let law = NearFieldLaw::Coulomb(Coulomb { relative_permittivity: 1.0 });
        let near = NearField { law, cutoff: Some(Quantity(1.5)), truncation: 0.05 };
        let by_hand = ((169.0 + 81.0) / (2401.0 + 81.0_f64)).sqrt();
        let found = truncation(&near, &grains, &Space::OPEN).unwrap();
        assert!((found.forces / by_hand - 1.0).abs() < 1e-14, "{found:?}");
        // Three pairs at 1 m have 1 - 1/1.5 each; all have 3 + 2/2 + 1/3.
        assert!((found.energy.unwrap() - 3.0 / 13.0).abs() < 1e-14, "{found:?}");
        let refused = hold(Some(&near), &grains, &Space::OPEN).unwrap_err();
        assert!(matches!(refused, SimError::Truncated { limit: 0.05, .. }), "{refused}");
        let allowed = NearField { truncation: 0.4, ..near.clone() };
        assert_eq!(hold(Some(&allowed), &grains, &Space::OPEN).unwrap(), Some(found));
        assert_eq!(truncation(&NearField { cutoff: None, ..near }, &grains, &Space::OPEN), None);
    }
}
