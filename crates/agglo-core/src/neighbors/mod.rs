//! Who is near whom: cell grid, pair list, the order in memory, and the grid that rays walk through.

mod cell_grid;
mod order;
mod pair_list;
pub mod ray_grid;

pub use cell_grid::CellGrid;
pub use order::{morton_code, morton_order};
pub use pair_list::PairList;
