//! What each assertion says where it fails.

#[macro_use]
extern crate agglo_testing;

use std::panic::catch_unwind;

/// A vector with what the assertions ask of one.
#[derive(Debug, Clone, Copy)]
struct Pair(f64, f64);

impl Pair {
    fn norm(self) -> f64 {
        self.0.hypot(self.1)
    }
}

impl std::ops::Sub for Pair {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

/// The message of a failure.
fn said(fails: fn()) -> String {
    let payload = catch_unwind(fails).expect_err("the assertion fails");
    payload.downcast_ref::<String>().expect("a message").clone()
}

#[test]
fn numbers_are_told_with_their_difference_and_unit() {
    let message = said(|| {
        let force = 1.001;
        assert_close!(force, 0.5 + 0.5, 1e-6, "force on grain {}, N", 2);
    });
    assert_eq!(
        message,
        "`force`, force on grain 2, N\n  found  1.001e0\n  wanted 1e0 = 0.5 + 0.5\n  off by 1.000e-3 of it, allowed 1e-6"
    );
    let message = said(|| assert_near!(2.0, 1.5, 0.25));
    assert_eq!(message, "`2.0`\n  found  2e0\n  wanted 1.5e0 = 1.5\n  off by 5.000e-1, allowed 2.5e-1");
    let message = said(|| assert_close_vector!(Pair(3.0, 4.0), Pair(3.0, 4.5), 0.01, "in m"));
    assert_contains!(
        message,
        "found  Pair(3.0, 4.0)\n  wanted Pair(3.0, 4.5) = Pair(3.0, 4.5)\n  off by 9.245e-2"
    );
}

/// A value that is not a number agrees with nothing, nor does anything with it.
#[test]
fn nan_fails_every_comparison() {
    let cases: [fn(); 8] = [
        || assert_close!(f64::NAN, 1.0, 1e9),
        || assert_close!(1.0, 0.0, 1e9),
        || assert_near!(f64::NAN, 1.0, 1e9),
        || assert_near!(f64::INFINITY, f64::INFINITY, 1.0),
        || assert_near_vector!(Pair(f64::NAN, 0.0), Pair(0.0, 0.0), 1.0),
        || assert_close_vector!(Pair(1.0, 0.0), Pair(f64::NAN, 0.0), 1.0),
        || assert_below!(f64::NAN, 1.0),
        || assert_between!(f64::NAN, 0.0..1.0),
    ];
    for fails in cases {
        assert_filled!(said(fails));
    }
}

#[test]
fn what_agrees_passes() {
    assert_close!(1.0 + 1e-9, 1.0, 1e-8);
    assert_near!(1e-9, 0.0, 1e-8);
    assert_close_vector!(Pair(0.0, 1e-9), Pair(0.0, 0.0), 1e-8);
    assert_near_vector!(Pair(3.0, 4.0), Pair(3.0, 4.0), 0.0);
    assert_between!(2, 1..=2);
    assert_has!([1, 2], &2);
    assert_no!([1, 2], |number| number > 2);
    assert_any!([1, 2], |number| number > 1);
    assert_matches!(Some(3), Some(number) if *number == 3);
    assert_finite!(1.0);
    assert_nan!(f64::NAN);
    assert_ok!("3".parse::<u8>());
    assert_err!("three".parse::<u8>());
    assert_there!(env!("CARGO_MANIFEST_DIR"));
    assert_gone!(concat!(env!("CARGO_MANIFEST_DIR"), "/nothing"));
}

#[test]
fn orders_lists_and_variants_show_what_they_found() {
    assert_contains!(said(|| assert_below!(3, 1 + 1)), "`3`\n  found  3\n  wanted less than 2 = 1 + 1");
    assert_contains!(said(|| assert_at_most!(3, 2)), "at most 2");
    assert_contains!(said(|| assert_above!(1, 2, "grains")), "`1`, grains\n  found  1\n  wanted more than 2");
    assert_contains!(said(|| assert_at_least!(1, 2)), "at least 2");
    assert_contains!(said(|| assert_between!(5, 0..=4)), "found  5\n  wanted 0..=4");
    assert_contains!(said(|| assert_has!([1, 2], &3)), "found  [1, 2]\n  wanted one that has 3");
    assert_contains!(said(|| assert_has_not!([1, 2], &2)), "wanted one without 2");
    assert_contains!(said(|| assert_empty!([7])), "found  [7]\n  wanted nothing");
    assert_contains!(
        said(|| assert_all!([1, 2], |number| number < 2)),
        "entry 1 is 2\n  wanted of each: |number| number < 2"
    );
    assert_contains!(said(|| assert_any!([1, 2], |number| number > 2)), "found  [1, 2]");
    assert_contains!(said(|| assert_no!([1, 2], |number| number > 1)), "entry 1 is 2");
    assert_contains!(said(|| assert_none!(Some(4))), "found  4\n  wanted None");
    assert_contains!(said(|| assert_some!(None::<u8>)), "wanted Some");
    assert_contains!(said(|| assert_ok!("x".parse::<u8>())), "InvalidDigit");
    assert_contains!(said(|| assert_err!("3".parse::<u8>())), "found  3\n  wanted an error");
    assert_contains!(said(|| assert_matches!(Some(4), None)), "found  Some(4)\n  wanted None");
}

#[test]
fn texts_show_what_they_found_and_lack() {
    assert_contains!(
        said(|| assert_contains!("a long word", "short")),
        "found: a long word\n  wanted, anywhere: short"
    );
    assert_contains!(said(|| assert_lacks!("a long word", "long")), "wanted, without: long");
    assert_contains!(said(|| assert_starts!("a long word", "long")), "wanted, at the beginning: long");
    assert_contains!(said(|| assert_ends!("a long word", "long")), "wanted, at the end: long");
    assert_contains!(said(|| assert_contains!("x".repeat(5000), "y")), "... (5000 bytes in all)");
    assert_contains!(said(|| assert_gone!(env!("CARGO_MANIFEST_DIR"))), "is there, and should not be");
}

#[test]
fn a_loop_without_an_end_fails() {
    let message = said(|| {
        let mut turns = agglo_testing::Turns::at_most(3, "rain");
        loop {
            turns.take();
        }
    });
    assert_eq!(message, "after 3 turns still waiting for rain");
}
