//! Assertions of agglo's tests: a failure says what was looked at, what was found, what was wanted and by how much they differ.
//!
//! A test program takes them all with `#[macro_use] extern crate agglo_testing;`. Each takes words at its end, as `format!` does,
//! that say what the value is and in which unit: `assert_close!(force.x, by_hand, 1e-12, "force on the second grain, N")`.
//!
//! | for                          | macro                                                                                   |
//! |------------------------------|-----------------------------------------------------------------------------------------|
//! | numbers                      | `assert_close!` (to a part), `assert_near!` (to a distance), `assert_finite!`, `assert_nan!` |
//! | vectors                      | `assert_close_vector!`, `assert_near_vector!`                                           |
//! | anything with an order       | `assert_below!`, `assert_at_most!`, `assert_above!`, `assert_at_least!`, `assert_between!` |
//! | text                         | `assert_contains!`, `assert_lacks!`, `assert_starts!`, `assert_ends!`                   |
//! | lists                        | `assert_has!`, `assert_has_not!`, `assert_empty!`, `assert_filled!`, `assert_all!`, `assert_any!`, `assert_no!` |
//! | options, results, variants   | `assert_none!`, `assert_some!`, `assert_ok!`, `assert_err!`, `assert_matches!`          |
//! | files                        | `assert_there!`, `assert_gone!`                                                         |
//! | yes or no                    | `assert_true!`, `assert_false!`, which ask for words                                    |
//!
//! [`Turns`] ends loops that wait for something, and [`AWKWARD`] are numbers for writers of numbers. `assert!` with words of its own is as good; `tests/no_bare_asserts.rs` finds one
//! without.

mod awkward;
mod numbers;
mod texts;
mod turns;
mod values;

pub use awkward::AWKWARD;
pub use turns::Turns;

#[doc(hidden)]
pub use {numbers::*, texts::*, values::*};

use std::fmt::{Arguments, Debug};

/// Longest text that a message shows, in characters.
const MOST_SHOWN: usize = 4000;

/// What an assertion looks at: its source text, and the words of its author.
#[doc(hidden)]
#[derive(Clone, Copy)]
pub struct Told<'a> {
    pub source: &'a str,
    pub words: Option<Arguments<'a>>,
}

impl Told<'_> {
    /// Fails with a first line that says what was looked at, and what is known of it.
    #[cold]
    #[track_caller]
    fn fail(self, rest: &str) -> ! {
        let source = self.source;
        match self.words {
            Some(words) => panic!("`{source}`, {words}\n{rest}"),
            None => panic!("`{source}`\n{rest}"),
        }
    }
}

/// A text that is cut where it is long.
fn cut(text: &str) -> String {
    match text.char_indices().nth(MOST_SHOWN) {
        Some((end, _)) => format!("{}... ({} bytes in all)", &text[..end], text.len()),
        None => text.to_owned(),
    }
}

/// A value as text.
fn shown(value: &(impl Debug + ?Sized)) -> String {
    cut(&format!("{value:?}"))
}

/// Source text and words of an assertion.
#[doc(hidden)]
#[macro_export]
macro_rules! told {
    ($source:expr) => {
        $crate::Told { source: stringify!($source), words: None }
    };
    ($source:expr, $($words:tt)+) => {
        $crate::Told { source: stringify!($source), words: Some(format_args!($($words)+)) }
    };
}
