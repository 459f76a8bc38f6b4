//! What simulations of soft and of hard spheres have in common.

use std::borrow::Cow;

use serde::Serialize;

use super::{SimError, Start};
use crate::math::Vec3;
use crate::particles::Particles;

/// A simulation of either kind of spheres, for loops that do not care which they drive.
///
/// # Example
/// The energy that is left of the motion of grains, whatever they are:
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::engine::{SimError, Simulation};
///
/// fn motion_left(mut simulation: impl Simulation, until: f64) -> Result<f64, SimError> {
///     let before = simulation.measures().kinetic_energy;
///     simulation.run_until(until)?;
///     Ok(simulation.measures().kinetic_energy / before)
/// }
/// ```
pub trait Simulation: Sized {
    /// All that it follows from, but for its grains; a scenario of its kind of spheres can be turned into it.
    type Settings;

    /// All that it needs to go on with the same bits; borrowed where it is written, owned where it is read.
    type State<'a>: Serialize
    where
        Self: 'a;

    /// Starts with grains as placed, or with what came out of another simulation.
    ///
    /// # Errors
    /// [`SimError`] where settings and grains do not fit together.
    fn start(settings: Self::Settings, start: Start) -> Result<Self, SimError>;

    /// Goes on from a saved state.
    ///
    /// # Errors
    /// [`SimError::Forged`] where the state is none that a simulation under these settings can have come to.
    fn resume(settings: Self::Settings, state: Self::State<'_>) -> Result<Self, SimError>;

    /// Simulated time [s].
    fn time(&self) -> f64;

    /// Simulated time at the end [s].
    fn end(&self) -> f64;

    /// Steps so far, or events.
    fn steps(&self) -> u64;

    /// Whether the end is reached.
    fn is_finished(&self) -> bool {
        self.time() >= self.end()
    }

    /// Goes on for as little as one can look at: one step, or some thousand events.
    ///
    /// # Errors
    /// [`SimError`] where it cannot go on.
    fn step(&mut self) -> Result<(), SimError>;

    /// Goes on for a little while: some steps, at least one, or some thousand events, but none from `until` [s] on.
    ///
    /// # Errors
    /// [`SimError`] where it cannot go on.
    fn advance(&mut self, until: f64) -> Result<(), SimError>;

    /// Goes on until `time` [s], or the end if that is sooner. Where time goes in steps, the last one may lead past it.
    ///
    /// # Errors
    /// [`SimError`] where it cannot go on.
    fn run_until(&mut self, time: f64) -> Result<(), SimError> {
        while self.time() < time && !self.is_finished() {
            self.advance(time)?;
        }
        Ok(())
    }

    /// The grains now. Those of hard spheres stand in the order of their ids.
    fn grains(&self) -> Cow<'_, Particles>;

    /// What the grains come to together.
    fn measures(&self) -> Measures;

    /// All that is needed to go on with the same bits, for a file: see [`Simulation::resume`].
    fn save(&self) -> Self::State<'_>;

    /// What another simulation can start from, of either kind.
    fn into_start(self) -> Start;
}

/// What the grains of a simulation come to together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measures {
    /// How many.
    pub grains: usize,
    /// Their mass [kg].
    pub mass: f64,
    /// Their momentum [kg m/s]; of soft spheres with that of the fluid that they drag along, the added mass.
    pub momentum: Vec3,
    /// Energy of their motion [J], turning included; of soft spheres with that of the added mass.
    pub kinetic_energy: f64,
    /// Energy that the ledger does not explain, over the most energy so far; without sign.
    pub unexplained: f64,
}
