//! The laws that a scenario has chosen: the one place that knows where in a scenario laws stand.

use std::collections::BTreeMap;

use super::file::{EngineTable, ScenarioFile};
use super::types::{Engine, Scenario};
use crate::acoustics::{Acoustics, Medium};
use crate::contact::{Bonds, ContactLaws};
use crate::fields::Fields;
use crate::impact::Impact;
use crate::law::{Chosen, Context, Sample};
use crate::packing::GrainGroup;
use crate::particles::Material;

/// The tables that hold laws.
#[derive(Clone, Copy, Default)]
struct Tables<'a> {
    contact: Option<&'a ContactLaws>,
    bonds: Option<&'a Bonds>,
    fields: Option<&'a Fields>,
    impact: Option<&'a Impact>,
    acoustics: Option<&'a Acoustics>,
}

impl<'a> Tables<'a> {
    /// All laws, in the order of the file.
    fn laws(self) -> impl Iterator<Item = Chosen<'a>> {
        let contact = self.contact.into_iter().flat_map(ContactLaws::chosen);
        let bonds = self.bonds.into_iter().map(Bonds::chosen);
        let fields = self.fields.into_iter().flat_map(Fields::chosen);
        let impact = self.impact.into_iter().flat_map(Impact::chosen);
        let rays = self.acoustics.into_iter().map(|acoustics| acoustics.force.chosen());
        contact.chain(bonds).chain(fields).chain(impact).chain(rays)
    }
}

fn context<'a>(
    medium: &'a Medium,
    materials: &'a BTreeMap<String, Material>,
    grains: &[GrainGroup],
    is_stepped: bool,
) -> Context<'a> {
    Context {
        medium,
        groups: grains.len(),
        largest_radius: grains.iter().map(|group| group.size.largest()).fold(0.0, f64::max),
        is_charged: grains.iter().any(|group| group.charge.si() != 0.0),
        is_stepped,
        samples: samples(materials, grains),
    }
}

/// The smallest and the largest grain of each group.
fn samples<'a>(materials: &'a BTreeMap<String, Material>, grains: &[GrainGroup]) -> Vec<Sample<'a>> {
    let mut samples = Vec::new();
    for group in grains {
        let Some(material) = materials.get(&group.material) else { continue };
        let [least, most] = [group.size.smallest(), group.size.largest()];
        for radius in [least, most].into_iter().take(if least < most { 2 } else { 1 }) {
            let is_size = radius > 0.0 && radius.is_finite() && material.density.si() > 0.0;
            let (mass, charge) = (material.mass_of_sphere(radius), group.charge.si());
            samples.extend(is_size.then_some(Sample { radius, mass, charge, material }));
        }
    }
    samples
}

impl Scenario {
    /// All of them, in the order of the file.
    pub fn laws(&self) -> impl Iterator<Item = Chosen<'_>> {
        let tables = match &self.engine {
            Engine::Soft(soft) => Tables {
                contact: soft.contact.as_ref(),
                bonds: soft.bonds.as_ref(),
                fields: Some(&soft.fields),
                acoustics: soft.acoustics.as_ref(),
                ..Tables::default()
            },
            Engine::Hard(hard) => Tables { impact: Some(&hard.impact), ..Tables::default() },
        };
        tables.laws()
    }

    /// What there is besides them.
    pub fn context(&self) -> Context<'_> {
        context(&self.medium, &self.materials, &self.grains, self.is_stepped())
    }
}

impl ScenarioFile {
    /// As [`Scenario::laws`], of both kinds of spheres.
    pub fn laws(&self) -> impl Iterator<Item = Chosen<'_>> {
        let tables = Tables {
            contact: self.contact.as_ref(),
            bonds: self.bonds.as_ref(),
            fields: self.fields.as_ref(),
            impact: self.impact.as_ref(),
            acoustics: self.acoustics.as_ref(),
        };
        tables.laws()
    }

    /// As [`Scenario::context`].
    pub fn context(&self) -> Context<'_> {
        context(
            &self.medium,
            &self.materials,
            &self.grains,
            !matches!(self.engine, EngineTable::EventDriven(_)),
        )
    }
}
