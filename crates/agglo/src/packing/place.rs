//! The grains of a scenario, with the rows of its tables.

use std::ops::ControlFlow;
use std::path::Path;

use super::{Groups, PackingError, PlaceWatch, Placed, Table, TableGrain, table};
use crate::particles::Particles;

/// Places all groups in their order; tables are looked for below `base`. As [`agglo_core::packing::place`].
///
/// # Example
/// A simulation starts from them, and another one from what it leaves: here grains that a field draws together, and that then
/// go on without it.
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
/// second.soft_mut().ok_or("of soft spheres")?.fields.near_field = None;
/// let next = Simulation::start(&second, simulation.into_start())?;
/// assert_eq!((next.clock().time, next.system.grains.len()), (0.0, 50));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`PackingError`]; a table that cannot be read is a [`super::TableError`] in it.
pub fn place<'a>(groups: impl Into<Groups<'a>>, base: &Path) -> Result<Particles, PackingError> {
    place_groups(groups, base).map(|(grains, _)| grains)
}

/// As [`place`], with the number of grains of each group; those of a group follow one another.
///
/// # Errors
/// As for [`place`].
pub fn place_groups<'a>(
    groups: impl Into<Groups<'a>>,
    base: &Path,
) -> Result<(Particles, Vec<u64>), PackingError> {
    place_all(groups, base, &mut || ControlFlow::Continue(())).map(|placed| (placed.grains, placed.counts))
}

/// As [`place`], with all that is known of the grains; `watch` may stop it.
///
/// # Errors
/// As for [`place`], and [`PackingError::Stopped`].
pub fn place_all<'a>(
    groups: impl Into<Groups<'a>>,
    base: &Path,
    watch: &mut PlaceWatch<'_>,
) -> Result<Placed, PackingError> {
    let mut read = |asked: &Table| -> Result<Vec<TableGrain>, PackingError> {
        table::read(&base.join(&asked.file)).map_err(|error| PackingError::Table(Box::new(error)))
    };
    agglo_core::packing::place_all(groups, &mut read, watch)
}
