//! What drives time: from event to event, or step by step.

mod cascade;
mod clock;
mod event_driven;
mod fetch;
mod filed;
mod queue;
mod standstill;
mod time_stepped;
mod validate;
mod walls;

pub use clock::Clock;
pub(super) use event_driven::Events;
pub(super) use filed::EventsState;
pub(super) use time_stepped::Steps;
