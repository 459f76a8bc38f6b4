//! Forces and torques on grains: the laws, what they load grains with, and how they answer to velocity.

pub(super) mod gather;
pub(super) mod laws;
pub(super) mod loads;
pub(super) mod response;
pub(super) mod truncation;
