//! The laws that a scenario has chosen: the one place that knows where in a scenario laws stand.

use super::types::Scenario;
use crate::contact::{Bonds, ContactLaws};
use crate::engine::Engine;
use crate::impact::Impact;
use crate::law::{Chosen, Context};

impl Scenario {
    /// All of them, in the order of the file.
    pub fn laws(&self) -> impl Iterator<Item = Chosen<'_>> {
        let contact = self.contact.iter().flat_map(ContactLaws::chosen);
        let bonds = self.bonds.iter().map(Bonds::chosen);
        let rays = self.acoustics.iter().map(|acoustics| acoustics.force.chosen());
        let impact = self.impact.iter().flat_map(Impact::chosen);
        contact.chain(bonds).chain(self.fields.chosen()).chain(impact).chain(rays)
    }

    /// What there is besides them.
    pub fn context(&self) -> Context<'_> {
        Context {
            medium: &self.medium,
            groups: self.grains.len(),
            largest_radius: self.grains.iter().map(|group| group.size.largest()).fold(0.0, f64::max),
            is_charged: self.grains.iter().any(|group| group.charge.si() != 0.0),
            is_stepped: !matches!(self.engine, Engine::EventDriven(_)),
        }
    }
}
