//! Numbers and words as text: for files, for people, for messages.

mod not_finite;
mod number;
mod readable;
mod visible;

pub use not_finite::not_finite;
pub use number::{Number, fractional, number};
pub use readable::{column, digits, readable, told_apart, two_digits, with_error};
pub use visible::{cell, visible};
