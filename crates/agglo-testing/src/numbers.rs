//! Numbers and vectors: close, near, finite.

use std::fmt::{Arguments, Debug};

use crate::Told;

/// Fails where `off` is more than allowed, or not a number; `of` says of what it is a part.
#[track_caller]
fn within(
    [off, allowed]: [f64; 2],
    of: &str,
    [found, wanted]: [Arguments<'_>; 2],
    wanted_source: &str,
    told: Told<'_>,
) {
    let agrees = off <= allowed;
    if !agrees {
        told.fail(&format!(
            "  found  {found}\n  wanted {wanted} = {wanted_source}\n  off by {off:.3e}{of}, allowed {allowed:e}"
        ));
    }
}

#[doc(hidden)]
#[track_caller]
pub fn close(found: f64, wanted: f64, part: f64, wanted_source: &str, told: Told<'_>) {
    let off = (found / wanted - 1.0).abs();
    within(
        [off, part],
        " of it",
        [format_args!("{found:e}"), format_args!("{wanted:e}")],
        wanted_source,
        told,
    );
}

#[doc(hidden)]
#[track_caller]
pub fn near(found: f64, wanted: f64, tolerance: f64, wanted_source: &str, told: Told<'_>) {
    let off = (found - wanted).abs();
    within(
        [off, tolerance],
        "",
        [format_args!("{found:e}"), format_args!("{wanted:e}")],
        wanted_source,
        told,
    );
}

/// The same for what has a distance `off` worked out by its own operations.
#[doc(hidden)]
#[track_caller]
pub fn apart(
    found: &dyn Debug,
    wanted: &dyn Debug,
    off: f64,
    allowed: f64,
    wanted_source: &str,
    told: Told<'_>,
) {
    within([off, allowed], "", [format_args!("{found:?}"), format_args!("{wanted:?}")], wanted_source, told);
}

#[doc(hidden)]
#[track_caller]
pub fn finite(found: f64, told: Told<'_>) {
    if !found.is_finite() {
        told.fail(&format!("  found  {found}\n  wanted a finite number"));
    }
}

#[doc(hidden)]
#[track_caller]
pub fn nan(found: f64, told: Told<'_>) {
    if !found.is_nan() {
        told.fail(&format!("  found  {found:e}\n  wanted NaN, which stands for a value that is not there"));
    }
}

/// A number is what is wanted, to a part of it: found, wanted (not 0), part, words.
#[macro_export]
macro_rules! assert_close {
    ($found:expr, $wanted:expr, $part:expr $(, $($words:tt)+)?) => {
        $crate::close($found, $wanted, $part, stringify!($wanted), $crate::told!($found $(, $($words)+)?))
    };
}

/// A number lies within a distance of what is wanted: found, wanted, distance, words.
#[macro_export]
macro_rules! assert_near {
    ($found:expr, $wanted:expr, $tolerance:expr $(, $($words:tt)+)?) => {
        $crate::near($found, $wanted, $tolerance, stringify!($wanted), $crate::told!($found $(, $($words)+)?))
    };
}

/// A vector is what is wanted, to a part of its length, or in full where that is 0: found, wanted, part, words.
#[macro_export]
macro_rules! assert_close_vector {
    ($found:expr, $wanted:expr, $part:expr $(, $($words:tt)+)?) => {{
        let (found, wanted) = ($found, $wanted);
        let size = wanted.norm();
        let off = (found - wanted).norm() / if size > 0.0 { size } else { 1.0 };
        $crate::apart(&found, &wanted, off, $part, stringify!($wanted), $crate::told!($found $(, $($words)+)?));
    }};
}

/// A vector lies within a distance of what is wanted: found, wanted, distance, words.
#[macro_export]
macro_rules! assert_near_vector {
    ($found:expr, $wanted:expr, $tolerance:expr $(, $($words:tt)+)?) => {{
        let (found, wanted) = ($found, $wanted);
        let off = (found - wanted).norm();
        $crate::apart(&found, &wanted, off, $tolerance, stringify!($wanted), $crate::told!($found $(, $($words)+)?));
    }};
}

/// A number is finite.
#[macro_export]
macro_rules! assert_finite {
    ($found:expr $(, $($words:tt)+)?) => {
        $crate::finite($found, $crate::told!($found $(, $($words)+)?))
    };
}

/// A number is NaN.
#[macro_export]
macro_rules! assert_nan {
    ($found:expr $(, $($words:tt)+)?) => {
        $crate::nan($found, $crate::told!($found $(, $($words)+)?))
    };
}
