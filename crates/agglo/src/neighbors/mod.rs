//! Who is near whom: cell grid, pair list, and the grid that rays walk through.

pub mod ray_grid;
