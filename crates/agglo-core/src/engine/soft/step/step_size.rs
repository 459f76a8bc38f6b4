//! How long a step may be: every law that acts says how fast it is, in its own file; here they are asked and added up.
//!
//! # Equation
//! $$ \Delta t = s \, \Delta t_c, \qquad \Delta t_c = \frac{2}{\Gamma + \sqrt{\Gamma^2 + \omega^2}} $$          (S1)
//! with the sums of Γ and ω² over the laws. A law gives what it can reach: a contact at the largest overlap that the
//! limits allow (and a wave through a grain, where the law has one), all bonds of a grain together, the near field at the closest
//! approach, drag and fields where the grains are. Laws without such a bound (dashpots and friction by contact area,
//! a near field without contact) are looked at in every step.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning |
//! |--------|--------------|------|---------|
//! | s      | `safety`     | -    | part of the critical step; 0.03 is 50 steps for a contact, and energy to 1e-3 |
//!
//! # Valid when
//! Formulas that change in time are looked at again, but a field that oscillates faster than all of the laws is not
//! foreseen.

use serde::{Deserialize, Serialize};

use crate::contact::pass::contact_pace;
use crate::contact::{Bonds, ContactGeometry, ContactLaws};
use crate::fields::Fields;
use crate::math::Pace;

use crate::engine::soft::forces::laws::source;
use crate::engine::soft::settings::Settings;
use crate::engine::soft::system::System;
use crate::engine::soft::types::Scheme;

/// Deepest overlap strain that is reckoned with, whatever the limits allow.
const DEEPEST: f64 = 0.5;

/// The first step [s].
pub fn first(settings: &Settings, system: &System) -> f64 {
    match &settings.scheme {
        Scheme::Staggered(scheme) => scheme.initial_step.si().min(scheme.largest_step.si()),
        Scheme::Verlet(scheme) => match scheme.step {
            Some(step) => step.si(),
            None => (scheme.safety * critical(settings, system)).min(settings.longest_step()),
        },
    }
}

/// The critical step [s] of explicit integration from the start on; infinite where nothing is fast.
pub fn critical(settings: &Settings, system: &System) -> f64 {
    let allowed = Some(settings.limits.strain);
    Paces::new(system, allowed, 0.0).total().critical_step()
}

/// How fast the laws are, one by one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Paces {
    /// Contact laws and the bond that acts in contact, between grains and at walls.
    pub contact: Pace,
    /// Bonds between grains.
    pub bonds: Pace,
    /// Drag and the flow of the medium.
    pub drag: Pace,
    /// Each of the fields, in the order of `Fields::SINGLE`.
    pub fields: [Pace; Fields::SINGLE.len()],
    /// The near field.
    pub near_field: Pace,
    /// A hook, as far as it says.
    pub hook: Pace,
}

impl Paces {
    /// At a time [s]; contacts reach the strain that is `allowed`, or only what they have reached already.
    pub fn new(system: &System, allowed: Option<f64>, time: f64) -> Self {
        let extremes = extremes(system);
        let reached = system.trial.contact.worst_strain;
        let strain = allowed.map_or(reached, |strain| strain.max(reached)).min(DEEPEST);
        let contact = contact(system, &extremes, strain, allowed.is_some());
        let at_walls = system.wall_pace(strain).max(system.at_walls(time).pace());
        Self {
            contact: contact.max(system.with_contacts(contact_pace)).max(at_walls),
            bonds: system.network.pace(&system.grains),
            near_field: near_field(system, &extremes, strain).max(system.near_pace_now()),
            hook: system.hook_pace(time).unwrap_or(Pace::NONE),
            ..singles(system, time)
        }
    }

    /// With what laws without a bound make of the trial motion.
    #[must_use]
    pub fn with_fast(self, fast: Fast) -> Self {
        let Fast { contact, near_field } = fast;
        Self { contact: self.contact.max(contact), near_field: self.near_field.max(near_field), ..self }
    }

    /// All together.
    pub fn total(&self) -> Pace {
        self.named().fold(Pace::NONE, |sum, (_, pace)| sum + pace)
    }

    /// The scenario's word for the law that is fastest.
    pub fn fastest(&self) -> &'static str {
        let critical = |pace: &Pace| pace.critical_step();
        let fastest = self.named().min_by(|a, b| critical(&a.1).total_cmp(&critical(&b.1)));
        fastest.map_or("", |(name, _)| name)
    }

    fn named(&self) -> impl Iterator<Item = (&'static str, Pace)> {
        let fields = Fields::SINGLE.iter().copied().zip(self.fields);
        let before = [("contact", self.contact), ("bonds", self.bonds), ("fields.drag", self.drag)];
        let after = [("fields.near_field", self.near_field), ("the hook", self.hook)];
        before.into_iter().chain(fields).chain(after)
    }
}

/// Paces that only the motion of the moment tells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fast {
    contact: Pace,
    near_field: Pace,
}

impl Fast {
    /// At the trial motion; the strain is what the limits allow.
    pub fn at_trial(system: &mut System, strain: f64) -> Self {
        let laws = &system.laws;
        let by_area = laws.contact.as_ref().is_some_and(ContactLaws::outgrow_contact)
            || laws.bonds.as_ref().and_then(Bonds::in_contact).is_some()
            || system.trial.contact.worst_strain > strain;
        Self {
            contact: if by_area {
                system.with_trial_contacts(contact_pace).max(system.pace_at_walls_at_trial())
            } else {
                Pace::NONE
            },
            near_field: system.near_pace_at_trial(),
        }
    }
}

/// Places of the grains that make a partner's contact fastest: the smallest and largest of each material, and the
/// most charged.
fn extremes(system: &System) -> Vec<usize> {
    let grains = &system.grains;
    let radius = |at: &usize| grains.radius[*at];
    let mut places = Vec::new();
    for material in 0..system.laws.materials.len() {
        let of_material = || (0..grains.len()).filter(move |at| grains.material[*at] as usize == material);
        places.extend(of_material().min_by(|a, b| radius(a).total_cmp(&radius(b))));
        places.extend(of_material().max_by(|a, b| radius(a).total_cmp(&radius(b))));
    }
    let charge = |at: &usize| grains.charge[*at].abs();
    places.extend((0..grains.len()).max_by(|a, b| charge(a).total_cmp(&charge(b))));
    places
}

/// Contacts at a strain, of each grain with each of `partners`.
fn contact(system: &System, partners: &[usize], strain: f64, with_waves: bool) -> Pace {
    let Some(laws) = system.laws.contact.as_ref().map(ContactLaws::bounded) else { return Pace::NONE };
    let grains = &system.grains;
    system.over_grains(|at| {
        let material = &system.laws.materials[grains.material[at] as usize];
        let alone = if with_waves { laws.wave_pace(material, grains.radius[at]) } else { Pace::NONE };
        let with = |&partner: &usize| {
            let ends = [at, partner];
            let radii = ends.map(|k| grains.radius[k]);
            let geometry = ContactGeometry::new(
                radii,
                ends.map(|k| grains.mass[k]),
                ends.map(|k| grains.contact_stiffness[k]),
                (radii[0] + radii[1]) * (1.0 - strain),
            );
            laws.pace(system.laws.pairs.of(grains.material[at], grains.material[partner]), &geometry)
        };
        partners.iter().map(with).fold(alone, Pace::max)
    })
}

/// The near field where grains are as close as contact lets them, or its cap.
fn near_field(system: &System, partners: &[usize], strain: f64) -> Pace {
    let Some(law) = &system.laws.fields.near_field else { return Pace::NONE };
    if system.laws.contact.is_none() && !law.law.is_capped() {
        return Pace::NONE;
    }
    let grains = &system.grains;
    system.over_grains(|at| {
        let with = |&partner: &usize| {
            let distance = (grains.radius[at] + grains.radius[partner]) * (1.0 - strain);
            law.pace(&source(grains, at), &source(grains, partner), distance)
        };
        partners.iter().map(with).fold(Pace::NONE, Pace::max)
    })
}

/// Forces on single grains, where and how fast these are.
fn singles(system: &System, time: f64) -> Paces {
    let (laws, grains) = (&system.laws, &system.grains);
    let fields = &laws.fields;
    let mass = |at: usize| system.inertial_mass[at];
    let drag = |at: usize| {
        fields.drag.as_ref().map_or(Pace::NONE, |law| {
            let flow = laws.flow_at(grains.position[at], time);
            let slip = flow.velocity - grains.velocity[at];
            law.pace(&laws.medium, grains.radius[at], [mass(at), grains.inertia(at)], slip, &flow)
        })
    };
    let of_fields = |at: usize| {
        let motion = (grains.position[at], grains.velocity[at]);
        fields.paces(&laws.grain(grains, at, motion, time), mass(at))
    };
    Paces { drag: system.over_grains(drag), fields: system.over_grains_each(of_fields), ..Paces::default() }
}
