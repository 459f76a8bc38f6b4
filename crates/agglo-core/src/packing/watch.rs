//! Who is asked for tables, and whether to go on, while grains are placed.

use std::ops::ControlFlow;

use super::error::PackingError;
use super::placement::{Table, TableGrain};

/// Whoever reads the tables of grains.
pub type ReadTable<'a> = dyn FnMut(&Table) -> Result<Vec<TableGrain>, PackingError> + 'a;

/// Asked now and then while grains are placed whether to go on.
pub type PlaceWatch<'a> = dyn FnMut() -> ControlFlow<()> + 'a;
