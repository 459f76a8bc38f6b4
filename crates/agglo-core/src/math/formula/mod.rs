//! The language of formulas, which is the same wherever a file can have one: in fields, in laws of one's own, in searches and studies.
//!
//! It knows `+ - * / ^`, parentheses, numbers such as `1e3`, the functions of [`FUNCTIONS`] and the constant `pi`. `^` binds before
//! `*` and `/`, these before `+` and `-`, and what binds alike is worked out from the left: `2^3^2` is (2³)². -x^2 is -(x²). Which
//! other names there are is said where a formula is bound to them; none of them may be a function or a constant, so that a word
//! means one thing everywhere.
//!
//! A formula is read once into a list of operations. To work it out takes no memory, and gives slopes as well, exactly, where they
//! are wanted. Where it has no value (1/x at 0) the result is infinite or not a number.
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::math::formula::Formula;
//! let known = |name: &str| if name == "x" { Ok(()) } else { Err(format!("who is {name}?")) };
//! let formula = Formula::new("3*x^2 - sin(pi*x)", known).unwrap();
//! assert!((formula.at(|()| 2.0) - 12.0).abs() < 1e-14);
//! let (_, [slope]) = formula.with_slopes(|()| 2.0, |()| [1.0]);
//! assert!((slope - (12.0 - std::f64::consts::PI)).abs() < 1e-13);
//! ```

mod bound;
mod number;
mod parse;
mod words;
mod written;

pub use bound::Formula;
pub use words::{FUNCTIONS, PI, advice, meaning};
pub use written::{Names, Written};

#[cfg(test)]
mod tests;
