//! The dashboard of `agglo watch` and `agglo run --watch`: a run seen in the terminal, from its folder alone.

mod cells;
mod portrait;
mod screen;
mod session;
#[cfg(test)]
mod tests;

pub(crate) use session::{Guest, watch};
