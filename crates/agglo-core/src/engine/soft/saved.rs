//! The whole state of a simulation, as checkpoints have it.
//!
//! Contacts and bonds know their grains by ids, not by places: what is read can be given out anew, by whatever order.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::contact::network::{Bond, Network};
use crate::domain::Image;
use crate::engine::{SimError, Warnings};
use crate::ledger::{Ledger, Rates};
use crate::particles::{ById, Particles};

use super::crew::Crew;
use super::faces::{Absorbed, EndFaces};
use super::forces::laws::Laws;
use super::forces::loads::Loads;
use super::forces::truncation::Truncation;
use super::rays::{PulseState, Pulses};
use super::saved_contacts::SavedContacts;
use super::settings::Settings;
use super::simulation::{Clock, SORT_EVERY, Simulation};
use super::step::step_size::Paces;
use super::step::tempo::Tempo;
use super::system::System;
use super::walls::WallMemory;

/// All that a simulation needs to go on with the same bits; borrowed where it is written, owned where it is read.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SimulationState<'a> {
    pub(super) clock: Clock,
    pub(super) grains: Cow<'a, Particles>,
    pub(super) images: Cow<'a, [Image]>,
    pub(super) loads: Cow<'a, Loads>,
    pub(super) rates: Rates,
    pub(super) contacts: SavedContacts<'a>,
    pub(super) walls: WallMemory,
    pub(super) bonds: Cow<'a, [Bond]>,
    pub(super) bonds_made_at_start: usize,
    pub(super) pulses: PulseState,
    pub(super) ledger: Ledger,
    pub(super) warnings: Warnings,
    pub(super) tempo: Option<Tempo>,
    pub(super) paces: Paces,
    pub(super) truncation: Option<Truncation>,
    pub(super) absorbed: Absorbed,
    pub(super) is_hooked: bool,
}

impl SimulationState<'_> {
    /// Where the simulation stands in time.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }
}

impl Simulation {
    /// Goes on from a saved state.
    ///
    /// # Errors
    /// [`SimError::Forged`] where the state is none that a run under these settings can have come to; others as
    /// [`Simulation::start`].
    pub fn resume<S>(settings: S, state: SimulationState<'_>) -> Result<Self, SimError>
    where
        S: TryInto<Settings>,
        SimError: From<S::Error>,
    {
        Self::restored(&settings.try_into()?, state)
    }

    pub(super) fn restored(settings: &Settings, state: SimulationState<'_>) -> Result<Self, SimError> {
        let places = ById::of(&state.grains.id);
        state.validate(settings, &places).map_err(|reason| SimError::Forged { reason })?;
        let n = state.grains.len();
        let bonds = Network::at_places(state.bonds.into_owned(), &places);
        let network = Network::restored(settings.beam(), bonds, state.bonds_made_at_start, n);
        let pulses = Pulses::resume(settings, state.pulses);
        let grains = state.grains.into_owned();
        let laws = Laws::new(settings, &grains);
        let space = (settings.space_in_time(&grains), state.clock.time);
        let mut system = System::new(grains, laws, network, space);
        system.images = state.images.into_owned();
        system.rays_are_impulses = pulses.are_impulses();
        system.loads = state.loads.into_owned();
        system.rates = state.rates;
        system.remember(&state.contacts.by_places(&places));
        system.resume_walls(state.walls, &places, state.clock.time);
        Ok(Self {
            tempo: state.tempo.map(|tempo| tempo.up_to(settings.longest_step())),
            truncation: state.truncation,
            paces: state.paces,
            system,
            pulses,
            ledger: state.ledger,
            warnings: state.warnings,
            events: Vec::new(),
            clock: state.clock,
            scheme: settings.scheme.clone(),
            limits: settings.limits.clone(),
            sort_every: SORT_EVERY,
            end: settings.end,
            faces: EndFaces::of(settings.volume.as_ref()),
            absorbed: state.absorbed,
            is_hooked: state.is_hooked,
            crew: Crew::default(),
        })
    }

    /// All that is needed to go on with the same bits.
    pub fn state(&self) -> SimulationState<'_> {
        let system = &self.system;
        SimulationState {
            clock: self.clock,
            grains: Cow::Borrowed(&system.grains),
            images: Cow::Borrowed(&system.images),
            loads: Cow::Borrowed(&system.loads),
            rates: system.rates,
            contacts: system.saved_contacts(),
            walls: system.wall_memory(),
            bonds: Cow::Borrowed(system.network.bonds()),
            bonds_made_at_start: system.network.made_at_start(),
            pulses: self.pulses.state(),
            ledger: self.ledger.clone(),
            warnings: self.warnings.clone(),
            tempo: self.tempo,
            truncation: self.truncation,
            paces: self.paces,
            absorbed: self.absorbed,
            is_hooked: self.is_hooked,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::testing::Scenario;

    /// Three in a row that press on one another and slide, bonded, on a floor.
    const ROW: &str = r#"
        version = 1
        time.end = "1 ms"
        engine.verlet.step = "1 us"
        [limits]
        drift_error = 1e30
        [materials.a]
        density = "1000 kg/m3"
        [[grains]]
        material = "a"
        size.constant.radius = "1 mm"
        placement.list.positions = [["0 m", "0 m", "0 m"], ["1.99 mm", "0 m", "0 m"], ["3.98 mm", "0 m", "0 m"]]
        [[walls]]
        name = "floor"
        material = "a"
        shape.plane = { point = ["0 m", "0 m", "-0.995 mm"], normal = [0.0, 0.0, 1.0] }
        [contact.normal.hooke]
        stiffness = "1 kN/m"
        [contact.friction.mindlin]
        static_friction = 0.3
        stiffness_ratio = 0.8
        [bonds.beam]
        youngs_modulus = "1 MPa"
        tensile_strength = "1 GPa"
        shear_strength = "1 GPa"
        gap = 0.1
    "#;

    fn saved(simulation: &Simulation) -> SimulationState<'static> {
        postcard::from_bytes(&postcard::to_stdvec(&simulation.state()).unwrap()).unwrap()
    }

    #[test]
    fn contacts_and_bonds_are_known_by_the_ids_of_grains() {
        let scenario = Scenario::from_toml(ROW).unwrap_or_else(|faults| panic!("{faults}"));
        let mut grains = crate::testing::place(&scenario).unwrap();
        grains.id = vec![30, 7, 900];
        grains.velocity[1] = Vec3::AXES[1] * 0.1;
        let mut simulation = Simulation::start(&scenario, grains).unwrap_or_else(|error| panic!("{error}"));
        for _ in 0..10 {
            simulation.step().unwrap_or_else(|error| panic!("{error}"));
        }
        let state = saved(&simulation);
        let named: Vec<[u32; 2]> = state.contacts.by_ids().iter().map(|(a, b, _)| [*a, *b]).collect();
        assert_eq!(named.len(), 2, "{named:?}: the outer two do not touch");
        assert_all!(named.iter(), |ids| ids.contains(&7));
        assert_eq!(state.contacts.by_ids(), simulation.state().contacts.by_ids());
        let again = Simulation::resume(&scenario, state).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(again.system.remembered(), simulation.system.remembered());
        assert_eq!(again.system.network.bonds(), simulation.system.network.bonds());
        let bytes = |of: &Simulation| postcard::to_stdvec(&of.state()).unwrap();
        assert_eq!(bytes(&again), bytes(&simulation), "nothing is lost, contacts with the floor neither");
    }

    #[test]
    fn contacts_of_unknown_grains_are_refused() {
        let scenario = Scenario::from_toml(ROW).unwrap_or_else(|faults| panic!("{faults}"));
        let grains = crate::testing::place(&scenario).unwrap();
        let simulation = Simulation::start(&scenario, grains).unwrap_or_else(|error| panic!("{error}"));
        let mut state = saved(&simulation);
        let (a, _, spring) = state.contacts.by_ids()[0];
        state.contacts = SavedContacts::AtHand(vec![(a, 8, spring)]);
        let error = Simulation::resume(&scenario, state).unwrap_err().to_string();
        assert_contains!(error, &format!("contact of {a} and 8"));
        let mut state = saved(&simulation);
        state.bonds.to_mut()[0].ids = [1, 8];
        assert_contains!(Simulation::resume(&scenario, state).unwrap_err().to_string(), "bond of 1 and 8");
    }
}
