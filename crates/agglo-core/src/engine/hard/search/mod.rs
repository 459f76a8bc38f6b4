//! What finds collisions: cells that spheres are filed in from event to event, and lists of near pairs from step to step.

mod approach;
mod around;
mod contact;
mod grid;
mod near;
mod nearest;
mod next_event;
mod seeker;

pub(super) use approach::Approach;
pub(super) use around::Around;
pub use contact::{Contact, Surroundings};
pub(super) use grid::{Frame, Grid};
pub(super) use near::Near;
pub(super) use nearest::Nearest;
pub(super) use next_event::NextEvent;
pub(super) use seeker::{Candidate, NextCollision, Seeker};
