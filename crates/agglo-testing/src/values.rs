//! Values of any type: orders, lists, options, results, variants.

use std::fmt::Debug;
use std::ops::RangeBounds;

use crate::{Told, cut, shown};

/// Fails with the value that was found and what was wanted in its place.
#[doc(hidden)]
#[cold]
#[track_caller]
pub fn fail(found: &dyn Debug, wanted: &str, told: Told<'_>) -> ! {
    told.fail(&format!("  found  {}\n  wanted {wanted}", shown(found)))
}

/// Fails where a value and its bound do not stand to each other as wanted.
#[doc(hidden)]
#[track_caller]
pub fn order(
    holds: bool,
    found: &dyn Debug,
    bound: &dyn Debug,
    relation: &str,
    source: &str,
    told: Told<'_>,
) {
    if !holds {
        told.fail(&format!("  found  {}\n  wanted {relation} {} = {source}", shown(found), shown(bound)));
    }
}

#[doc(hidden)]
#[track_caller]
pub fn between<T: PartialOrd + Debug>(found: &T, range: &(impl RangeBounds<T> + Debug), told: Told<'_>) {
    if !range.contains(found) {
        told.fail(&format!("  found  {found:?}\n  wanted {range:?}"));
    }
}

/// Fails at the first entry of which the condition is not as due: true of each, or of none.
#[doc(hidden)]
#[track_caller]
pub fn each<I>(items: I, mut holds: impl FnMut(I::Item) -> bool, due: bool, condition: &str, told: Told<'_>)
where
    I: IntoIterator,
    I::Item: Debug,
{
    for (at, item) in items.into_iter().enumerate() {
        let text = shown(&item);
        if holds(item) != due {
            let wanted = if due { "of each:" } else { "none with" };
            told.fail(&format!("  entry {at} is {text}\n  wanted {wanted} {condition}"));
        }
    }
}

#[doc(hidden)]
#[track_caller]
pub fn any<I>(items: I, mut holds: impl FnMut(I::Item) -> bool, condition: &str, told: Told<'_>)
where
    I: IntoIterator,
    I::Item: Debug,
{
    let mut texts = Vec::new();
    for item in items {
        texts.push(shown(&item));
        if holds(item) {
            return;
        }
    }
    let texts = cut(&texts.join(", "));
    told.fail(&format!("  found  [{texts}]\n  wanted one with {condition}"));
}

/// A value and its bound stand to each other as an operator says.
#[doc(hidden)]
#[macro_export]
macro_rules! assert_order {
    ($found:expr, $operator:tt, $bound:expr, $relation:literal $(, $($words:tt)+)?) => {
        match (&$found, &$bound) {
            (found, bound) => {
                let holds = found $operator bound;
                $crate::order(holds, &found, &bound, $relation, stringify!($bound), $crate::told!($found $(, $($words)+)?));
            }
        }
    };
}

/// A value lies below a bound: found, bound, words.
#[macro_export]
macro_rules! assert_below {
    ($found:expr, $bound:expr $(, $($words:tt)+)?) => {
        $crate::assert_order!($found, <, $bound, "less than" $(, $($words)+)?)
    };
}

/// A value is not above a bound: found, bound, words.
#[macro_export]
macro_rules! assert_at_most {
    ($found:expr, $bound:expr $(, $($words:tt)+)?) => {
        $crate::assert_order!($found, <=, $bound, "at most" $(, $($words)+)?)
    };
}

/// A value lies above a bound: found, bound, words.
#[macro_export]
macro_rules! assert_above {
    ($found:expr, $bound:expr $(, $($words:tt)+)?) => {
        $crate::assert_order!($found, >, $bound, "more than" $(, $($words)+)?)
    };
}

/// A value is not below a bound: found, bound, words.
#[macro_export]
macro_rules! assert_at_least {
    ($found:expr, $bound:expr $(, $($words:tt)+)?) => {
        $crate::assert_order!($found, >=, $bound, "at least" $(, $($words)+)?)
    };
}

/// A value lies in a range: found, range, words.
#[macro_export]
macro_rules! assert_between {
    ($found:expr, $range:expr $(, $($words:tt)+)?) => {
        $crate::between(&$found, &$range, $crate::told!($found $(, $($words)+)?))
    };
}

/// A list or set has an item: list, item, words.
#[macro_export]
macro_rules! assert_has {
    ($found:expr, $item:expr $(, $($words:tt)+)?) => {
        match (&$found, $item) {
            (found, item) => {
                $crate::order(found.contains(item), &found, &item, "one that has", stringify!($item), $crate::told!($found $(, $($words)+)?));
            }
        }
    };
}

/// A list or set lacks an item: list, item, words.
#[macro_export]
macro_rules! assert_has_not {
    ($found:expr, $item:expr $(, $($words:tt)+)?) => {
        match (&$found, $item) {
            (found, item) => {
                $crate::order(!found.contains(item), &found, &item, "one without", stringify!($item), $crate::told!($found $(, $($words)+)?));
            }
        }
    };
}

/// A list or text is empty.
#[macro_export]
macro_rules! assert_empty {
    ($found:expr $(, $($words:tt)+)?) => {
        match &$found {
            found => {
                if !found.is_empty() {
                    $crate::fail(&found, "nothing", $crate::told!($found $(, $($words)+)?));
                }
            }
        }
    };
}

/// A list or text is not empty.
#[macro_export]
macro_rules! assert_filled {
    ($found:expr $(, $($words:tt)+)?) => {
        match &$found {
            found => {
                if found.is_empty() {
                    $crate::fail(&found, "at least one entry", $crate::told!($found $(, $($words)+)?));
                }
            }
        }
    };
}

/// Each entry holds to a condition: entries, closure, words.
#[macro_export]
macro_rules! assert_all {
    ($found:expr, $holds:expr $(, $($words:tt)+)?) => {
        $crate::each($found, $holds, true, stringify!($holds), $crate::told!($found $(, $($words)+)?))
    };
}

/// At least one entry holds to a condition: entries, closure, words.
#[macro_export]
macro_rules! assert_any {
    ($found:expr, $holds:expr $(, $($words:tt)+)?) => {
        $crate::any($found, $holds, stringify!($holds), $crate::told!($found $(, $($words)+)?))
    };
}

/// No entry holds to a condition: entries, closure, words.
#[macro_export]
macro_rules! assert_no {
    ($found:expr, $holds:expr $(, $($words:tt)+)?) => {
        $crate::each($found, $holds, false, stringify!($holds), $crate::told!($found $(, $($words)+)?))
    };
}

/// An option is empty.
#[macro_export]
macro_rules! assert_none {
    ($found:expr $(, $($words:tt)+)?) => {
        if let Some(found) = &$found {
            $crate::fail(&found, "None", $crate::told!($found $(, $($words)+)?));
        }
    };
}

/// An option holds a value.
#[macro_export]
macro_rules! assert_some {
    ($found:expr $(, $($words:tt)+)?) => {
        if $found.is_none() {
            $crate::fail(&None::<()>, "Some", $crate::told!($found $(, $($words)+)?));
        }
    };
}

/// A result is a success.
#[macro_export]
macro_rules! assert_ok {
    ($found:expr $(, $($words:tt)+)?) => {
        if let Err(error) = &$found {
            $crate::fail(&error, "success", $crate::told!($found $(, $($words)+)?));
        }
    };
}

/// A result is an error.
#[macro_export]
macro_rules! assert_err {
    ($found:expr $(, $($words:tt)+)?) => {
        if let Ok(found) = &$found {
            $crate::fail(&found, "an error", $crate::told!($found $(, $($words)+)?));
        }
    };
}

/// A value is of a form: value, pattern with or without `if`, words.
#[macro_export]
macro_rules! assert_matches {
    ($found:expr, $pattern:pat $(if $guard:expr)? $(, $($words:tt)+)?) => {
        match &$found {
            found => {
                // By reference, so that the value can be shown.
                #[allow(clippy::redundant_pattern_matching, reason = "what was found is shown")]
                let holds = matches!(found, $pattern $(if $guard)?);
                if !holds {
                    $crate::fail(&found, stringify!($pattern $(if $guard)?), $crate::told!($found $(, $($words)+)?));
                }
            }
        }
    };
}

/// A condition holds that no other macro shows: condition, words (which must be given).
#[macro_export]
macro_rules! assert_true {
    ($holds:expr, $($words:tt)+) => {
        if !$holds {
            $crate::fail(&false, "true", $crate::told!($holds, $($words)+));
        }
    };
}

/// A condition fails that no other macro shows: condition, words (which must be given).
#[macro_export]
macro_rules! assert_false {
    ($holds:expr, $($words:tt)+) => {
        if $holds {
            $crate::fail(&true, "false", $crate::told!($holds, $($words)+));
        }
    };
}
