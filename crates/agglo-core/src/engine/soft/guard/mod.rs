//! What a run is looked at for: energy, the length of the step, the range of its models.

mod breach;
mod look;
pub(super) mod space;
pub(super) mod validity;
