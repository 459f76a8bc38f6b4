//! One run by several domains, which have the same bits as one.
//!
//! Each domain holds all grains and works out its own blocks of them: their contacts, their loads and their motion. What it
//! finds it tells the others through a [`Link`], and all go on from the same state. Sums are taken over the tree of all blocks,
//! whoever has which of them, so their bits depend neither on how many domains there are nor on where they are cut. What costs
//! little beside contacts (lists of pairs, bonds, rays, output) is done by every domain alike.
//!
//! Domains of this program are threads that pass messages; whoever has another way to pass them implements [`Link`].

mod domain;
mod row;
mod threads;
mod way;

pub use domain::Domain;
pub use row::Row;
pub use threads::threads;
pub use way::Link;

pub(crate) use row::row_of_fields;
