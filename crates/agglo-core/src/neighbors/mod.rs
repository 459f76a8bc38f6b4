//! Who is near whom: cell index, pair list, the order in memory, and the grid that rays walk through.

mod cells;
mod order;
mod pair_list;
pub mod ray_grid;

pub use cells::{CellIndex, Chained, Places, Sorted, Span};
pub use order::{morton_code, morton_order};
pub use pair_list::PairList;
