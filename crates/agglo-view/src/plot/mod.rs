//! Charts as SVG text: what is in them is given, nothing is computed but the layout. And what grains can be colored by, for
//! pictures and pages.
//!
//! Colors are told apart by readers with any kind of color vision: the map for values is perceptually uniform, the colors
//! for names come with dashes. Each chart has a title and a text for readers who cannot see it. The same chart is the
//! same text, byte by byte. Fonts are the reader's; room for text is estimated from the number of letters.

mod bars;
mod color;
mod front;
mod histogram;
mod lines;
mod map;
mod pairs;
mod panel;
mod parallel;
mod quantity;
mod refinement;
pub(crate) mod scale;
mod scatter;
mod svg;
#[cfg(test)]
mod tests;

pub use agglo::search::analysis::Axis;
pub use bars::{Bars, Series};
pub use color::{Color, LINES, viridis};
pub use front::{Front, FrontPoint};
pub use histogram::{Histogram, Histograms};
pub use lines::{Line, LinePanel, Lines};
pub use map::{Map, NAMED, PLAIN, name_color};
pub use pairs::Pairs;
pub use parallel::Parallel;
pub use quantity::{Coloring, Quantity};
pub use refinement::{Level, Settled, Staircase};
pub use scatter::Scatter;
