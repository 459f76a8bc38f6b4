//! The grains of a scenario, with the rows of its tables.

use std::ops::ControlFlow;
use std::path::Path;

use super::{Groups, PackingError, PlaceWatch, Table, TableGrain, table};
use crate::particles::Particles;

/// Places all groups in their order; tables are looked for below `base`. As [`agglo_core::packing::place`].
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
    place_groups_watched(groups, base, &mut || ControlFlow::Continue(()))
}

/// As [`place_groups`]; `watch` may stop it.
///
/// # Errors
/// As for [`place`], and [`PackingError::Stopped`].
pub fn place_groups_watched<'a>(
    groups: impl Into<Groups<'a>>,
    base: &Path,
    watch: &mut PlaceWatch<'_>,
) -> Result<(Particles, Vec<u64>), PackingError> {
    let mut read = |asked: &Table| -> Result<Vec<TableGrain>, PackingError> {
        table::read(&base.join(&asked.file)).map_err(|error| PackingError::Table(Box::new(error)))
    };
    agglo_core::packing::place_groups_watched(groups, &mut read, watch)
}
