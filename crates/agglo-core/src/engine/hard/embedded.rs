//! Grains in a point of a flow: a macroscale code hands over what is there, lets it collide for one of its time steps,
//! and takes back what is there then, grain by grain and in means. No file is read or written.
//!
//! # Source
//! T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 9.
//!
//! # Valid when
//! The macroscale step is longer than a collision and the flow is uniform over the control volume. Forces of the fluid are
//! the macroscale code's: it changes velocities and temperatures between steps. A step is a pure function of scenario
//! and state: boxes can be stepped in any order and on any thread. What an engine itself remembers (the time of each
//! grain's last bounce) ends with the step.

use thiserror::Error;

use super::Settings;
use super::grown::Grown;
use super::micro_state::MicroState;
use super::record::{Homogenized, homogenize};
use super::simulation::Simulation;
use crate::domain::Volume;
use crate::engine::SimError;
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::packing::{PackingError, fill_with, first_overlap};
use crate::particles::{ColumnValues, Material, Particles, Row};

/// Why grains of a macroscale code cannot be taken, or a step cannot be made.
#[derive(Debug, Error)]
pub enum EmbeddedError {
    /// The scenario is not one of hard spheres, or breaks a rule.
    #[error("the scenario cannot be embedded: {0}")]
    Scenario(#[source] Box<dyn std::error::Error + Send + Sync>),
    /// A column has not one value for each grain.
    #[error("`{column}` has {found} values for {grains} grains")]
    Length {
        /// Which column.
        column: &'static str,
        /// How many values it has.
        found: usize,
        /// How many grains there are, by their radii.
        grains: usize,
    },
    /// A value that cannot be.
    #[error("`{column}` of grain {grain} is {value}; it must be {allowed}")]
    Value {
        /// Which column.
        column: &'static str,
        /// Index of the grain in the columns, from 0.
        grain: usize,
        /// What was found, in SI units.
        value: String,
        /// What it must be.
        allowed: &'static str,
    },
    /// There are no grains.
    #[error("there are no grains; a macroscale code can leave out the step")]
    Empty,
    /// Two grains overlap, or a grain overlaps its own image.
    #[error("grains {} and {} overlap by {overlap:e} m; hard spheres must start apart", grains[0], grains[1])]
    Overlap {
        /// Their indices in the columns, from 0; twice the same where a grain overlaps its own image.
        grains: [u32; 2],
        /// How far they overlap [m].
        overlap: f64,
    },
    /// There is no room for grains without positions.
    #[error("the grains cannot be placed at random in the volume: {0}")]
    NoRoom(PackingError),
    /// The step is not above zero.
    #[error("the duration of a step must be above zero and finite, not {0} s")]
    Duration(f64),
    /// The simulation cannot go on.
    #[error(transparent)]
    Run(#[from] SimError),
}

/// Grains as a macroscale code knows them: columns of one length. Those that say so can be left empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MicroGrains {
    /// Radii [n] [m].
    pub radii: Vec<f64>,
    /// Velocities [n, 3] [m/s].
    pub velocities: Vec<Vec3>,
    /// Temperatures [n] [K].
    pub temperatures: Vec<f64>,
    /// Centers [n, 3] [m]; if empty, grains are placed at random without overlap, under the scenario's seed.
    pub positions: Vec<Vec3>,
    /// Numbers of materials [n], in the order of their names; if empty, all are of the first one.
    pub materials: Vec<u32>,
    /// Primary grains that each is made of [n]; if empty, one each.
    pub primaries: Vec<u32>,
}

/// Laws and control volume of grains that are embedded in a flow.
#[derive(Clone, Debug)]
pub struct Microscale {
    settings: Settings,
    materials: Vec<Material>,
}

impl Microscale {
    /// Takes driver, laws, materials, volume and seed; the end has no meaning here. Settings out of a scenario are held to
    /// its rules first: `Microscale::try_from(&scenario)`.
    pub fn new(settings: Settings) -> Self {
        let materials = settings.materials.values().cloned().collect();
        Self { settings, materials }
    }

    /// Makes a first state of grains. With periodic or antipodal faces, positions are brought into the volume.
    ///
    /// # Errors
    /// [`EmbeddedError`] where a column is too short or too long, a value cannot be, grains overlap or find no room.
    pub fn state(&self, grains: &MicroGrains) -> Result<MicroState, EmbeddedError> {
        let count = grains.radii.len();
        let lengths = [
            ("velocities", grains.velocities.len(), false),
            ("temperatures", grains.temperatures.len(), false),
            ("positions", grains.positions.len(), true),
            ("materials", grains.materials.len(), true),
            ("primaries", grains.primaries.len(), true),
        ];
        for (column, found, may_be_empty) in lengths {
            if found != count && !(found == 0 && may_be_empty) {
                return Err(EmbeddedError::Length { column, found, grains: count });
            }
        }
        let mut state = self.rows(grains);
        check(&state, self.materials.len())?;
        if grains.positions.is_empty() {
            state.grains.position = fill_with(&grains.radii, &self.settings.volume, self.settings.seed)
                .map_err(EmbeddedError::NoRoom)?;
        }
        check_positions(&state.grains, &self.settings.volume)?;
        Ok(state)
    }

    /// The columns of a first state, not checked.
    fn rows(&self, given: &MicroGrains) -> MicroState {
        let mut grains = Particles::default();
        for (at, &radius) in given.radii.iter().enumerate() {
            let material = given.materials.get(at).copied().unwrap_or(0);
            let position = given.positions.get(at).copied().unwrap_or(self.settings.volume.lower());
            grains.push(Row {
                id: at as u32,
                position: self.settings.volume.wrap(position),
                velocity: given.velocities[at],
                radius,
                // A number that no material has is found by the check.
                mass: self.materials.get(material as usize).map_or(1.0, |found| found.mass_of_sphere(radius)),
                material,
                temperature: given.temperatures[at],
                polarity: 1.0,
                ..Row::default()
            });
        }
        let specific_heat =
            |material: u32| self.materials.get(material as usize).map_or(0.0, Material::specific_heat);
        let grown = |at: usize| Grown {
            primaries: given.primaries.get(at).copied().unwrap_or(1),
            heat_capacity: grains.mass[at] * specific_heat(grains.material[at]),
        };
        let grown = (0..grains.len()).map(grown).collect();
        let reference_radius = grains.radius.iter().sum::<f64>() / grains.len() as f64;
        MicroState { grains, grown, reference_radius, step: 0 }
    }

    /// Lets the grains fly and collide for `duration` [s]; gives the new state, in the order of ids, and its means.
    ///
    /// # Errors
    /// [`EmbeddedError`] where a value of the state cannot be, or the simulation cannot go on.
    pub fn step(
        &self,
        state: &MicroState,
        duration: f64,
    ) -> Result<(MicroState, Homogenized), EmbeddedError> {
        if !(duration.is_finite() && duration > 0.0) {
            return Err(EmbeddedError::Duration(duration));
        }
        check(state, self.materials.len())?;
        let mut settings = self.settings.clone();
        settings.end = duration;
        let mut stream = Stream::new(self.settings.seed, Purpose::Fragment, state.step);
        settings.seed = (stream.uniform() * (1_u64 << 53) as f64) as u64;
        let mut simulation = Simulation::begin(settings, &state.grains, &state.grown)?;
        simulation.system_mut().keeps_events = false;
        while !simulation.is_finished() {
            simulation.advance(duration)?;
        }
        let next = MicroState {
            grains: simulation.snapshot().grains,
            grown: simulation.grown(),
            reference_radius: state.reference_radius,
            step: state.step.wrapping_add(1),
        };
        let means = homogenize(&simulation, &next, duration);
        Ok((next, means))
    }
}

/// What every step needs of a state, with a number of materials.
fn check(state: &MicroState, materials: usize) -> Result<(), EmbeddedError> {
    let count = state.grains.len();
    if count == 0 {
        return Err(EmbeddedError::Empty);
    }
    let columns = state.grains.columns();
    let lengths = columns.iter().map(|(column, values)| match values {
        ColumnValues::Integers(values) => (column.name, values.len()),
        ColumnValues::Scalars(values) => (column.name, values.len()),
        ColumnValues::Vectors(values) => (column.name, values.len()),
    });
    for (column, found) in lengths.chain([("grown", state.grown.len())]) {
        if found != count {
            return Err(EmbeddedError::Length { column, found, grains: count });
        }
    }
    (0..count)
        .try_for_each(|grain| check_grain(grain, &state.grains.row(grain), &state.grown[grain], materials))
}

fn check_grain(grain: usize, row: &Row, grown: &Grown, materials: usize) -> Result<(), EmbeddedError> {
    let fault = |column, value, allowed| Err(EmbeddedError::Value { column, grain, value, allowed });
    for (column, value) in [("radii", row.radius), ("mass", row.mass), ("temperatures", row.temperature)] {
        if !(value.is_finite() && value > 0.0) {
            return fault(column, value.to_string(), "above zero and finite");
        }
    }
    for (column, vector) in [("positions", row.position), ("velocities", row.velocity)] {
        if !vector.is_finite() {
            return fault(column, format!("({}, {}, {})", vector.x, vector.y, vector.z), "finite");
        }
    }
    if row.material as usize >= materials {
        return fault("materials", row.material.to_string(), "the number of a material");
    }
    if grown.primaries == 0 {
        return fault("primaries", "0".to_owned(), "at least 1");
    }
    if !(grown.heat_capacity.is_finite() && grown.heat_capacity >= 0.0) {
        return fault("heat_capacity", grown.heat_capacity.to_string(), "zero or above and finite");
    }
    Ok(())
}

/// What a first state has to keep besides: grains in their volume and apart.
fn check_positions(grains: &Particles, volume: &Volume) -> Result<(), EmbeddedError> {
    for (grain, (&position, &radius)) in grains.position.iter().zip(&grains.radius).enumerate() {
        if !volume.holds(position, radius) {
            let Vec3 { x, y, z } = position;
            let (value, allowed) = (format!("({x}, {y}, {z})"), "within the walls");
            return Err(EmbeddedError::Value { column: "positions", grain, value, allowed });
        }
    }
    match first_overlap(grains, Some(volume)) {
        Some(found) => Err(EmbeddedError::Overlap { grains: found.ids, overlap: found.overlap }),
        None => Ok(()),
    }
}

#[cfg(test)]
#[path = "embedded_tests.rs"]
mod tests;
