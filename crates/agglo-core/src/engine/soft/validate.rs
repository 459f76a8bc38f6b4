//! Whether a saved state is one that a run of soft spheres can have come to.

use super::faces::Absorbed;
use super::saved::SimulationState;
use super::settings::Settings;
use crate::contact::network::Bond;
use crate::engine::validate::{Fault, MOST_COUNTED, ensure, finite, finite_vectors, length};
use crate::particles::{ById, Particles};

impl SimulationState<'_> {
    /// # Errors
    /// What is wrong with it.
    pub(super) fn validate(&self, settings: &Settings, places: &ById) -> Result<(), Fault> {
        let clock = &self.clock;
        finite("clock", clock)?;
        let steps = [clock.step, clock.iterations, clock.rejected];
        ensure(steps.iter().all(|count| *count < MOST_COUNTED), || "clock: a count is too large".to_owned())?;
        let times = [clock.time, clock.next_step, clock.last_step];
        ensure(times.iter().all(|time| *time >= 0.0), || "clock: a time is below 0".to_owned())?;
        let grains = &*self.grains;
        let n = grains.len();
        validate_grains(grains, places, settings)?;
        let images = if settings.space().repeats() { n } else { 0 };
        length("images", self.images.len(), images)?;
        for (what, loads) in [("forces", &self.loads.force), ("torques", &self.loads.torque)] {
            length(what, loads.len(), n)?;
            finite_vectors(what, loads)?;
        }
        finite("rates", &self.rates)?;
        finite("ledger", &self.ledger)?;
        finite("paces", &self.paces)?;
        let Absorbed { grains: absorbed, mass } = self.absorbed;
        ensure(absorbed < MOST_COUNTED && mass.is_finite() && mass >= 0.0, || "absorbed grains".to_owned())?;
        if let Some(truncation) = &self.truncation {
            finite("truncation", truncation)?;
        }
        if let Some(tempo) = &self.tempo {
            tempo.validate()?;
        }
        for (a, b, spring) in &*self.contacts.by_ids() {
            ensure(a != b && are_there([*a, *b], places), || format!("contact of {a} and {b}"))?;
            finite("contact", spring)?;
        }
        self.walls.validate(&settings.walls, places)?;
        validate_bonds(&self.bonds, places)?;
        ensure(self.bonds_made_at_start < MOST_COUNTED as usize, || "too many bonds".to_owned())?;
        self.pulses.validate(settings, n)
    }
}

/// Whether there are grains with these ids.
fn are_there(ids: [u32; 2], places: &ById) -> bool {
    ids.iter().all(|id| places.find(*id).is_some())
}

fn validate_grains(grains: &Particles, places: &ById, settings: &Settings) -> Result<(), Fault> {
    let n = grains.len();
    ensure(n > 0, || "there are no grains".to_owned())?;
    grains.validate()?;
    if let Some(id) = places.twice() {
        return Err(format!("grains: two have the id {id}"));
    }
    let materials = settings.materials.len();
    let holds = grains.material.iter().all(|number| (*number as usize) < materials);
    ensure(holds, || format!("grains: there are {materials} materials"))
}

/// Bonds stand in the order of the ids that they join, the lower id first.
fn validate_bonds(bonds: &[Bond], places: &ById) -> Result<(), Fault> {
    for bond in bonds {
        let [a, b] = bond.ids;
        ensure(a < b && are_there(bond.ids, places), || format!("bond of {a} and {b}"))?;
        finite("bond", bond)?;
        ensure(bond.state.length > 0.0 && bond.state.radius > 0.0, || {
            format!("bond of {a} and {b}: its size")
        })?;
    }
    ensure(bonds.windows(2).all(|pair| pair[0].ids < pair[1].ids), || "bonds are out of order".to_owned())
}
