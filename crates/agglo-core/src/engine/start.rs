//! What a simulation starts from.

use super::hard::Grown;
use crate::contact::network::Bond;
use crate::contact::pass::Remembered;
use crate::particles::Particles;

/// Grains at time zero, with what they bring along where they come out of another simulation.
///
/// Grains as they were placed bring nothing: `Start::from(grains)`.
///
/// # Example
/// Grains that a field draws together, and that then go on without it:
/// ```
/// use agglo::engine::soft::Simulation;
/// use agglo::scenario::{Scenario, template};
/// let text = template("acoustic-published").unwrap().text;
/// let first = Scenario::with_overrides(text, &["grains.0.placement.random.count=50", "acoustics.beams.0.rays=100"])?;
/// let grains = agglo::packing::place(&first, std::path::Path::new(""))?;
/// let mut simulation = Simulation::start(&first, grains)?;
/// for _ in 0..10 {
///     simulation.step()?;
/// }
/// let mut second = first.clone();
/// second.fields.near_field = None;
/// let next = Simulation::start(&second, simulation.into_start())?;
/// assert_eq!((next.clock().time, next.system.grains.len()), (0.0, 50));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// The grains.
    pub grains: Particles,
    /// Soft spheres: springs of contacts, by the grains' indices.
    pub contacts: Vec<Remembered>,
    /// Soft spheres: the bonds that hold, however few. Without them the scenario's law bonds neighbors.
    pub bonds: Option<Vec<Bond>>,
    /// Hard spheres: what grown grains keep of their parts, in the order of the grains; those that it leaves out are primary
    /// grains.
    pub grown: Vec<Grown>,
    /// What the simulation warns of from the start.
    pub warnings: Vec<String>,
}

impl From<Particles> for Start {
    fn from(grains: Particles) -> Self {
        Self { grains, ..Self::default() }
    }
}
