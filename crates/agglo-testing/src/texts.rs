//! Texts and files.

use std::path::Path;

use crate::{Told, cut};

#[doc(hidden)]
#[derive(Clone, Copy)]
pub enum Part {
    Inside,
    Nowhere,
    First,
    Last,
}

#[doc(hidden)]
#[track_caller]
pub fn text(text: &str, part: &str, place: Part, told: Told<'_>) {
    let (holds, wanted) = match place {
        Part::Inside => (text.contains(part), "wanted, anywhere"),
        Part::Nowhere => (!text.contains(part), "wanted, without"),
        Part::First => (text.starts_with(part), "wanted, at the beginning"),
        Part::Last => (text.ends_with(part), "wanted, at the end"),
    };
    if !holds {
        told.fail(&format!("  found: {}\n  {wanted}: {part}", cut(text)));
    }
}

#[doc(hidden)]
#[track_caller]
pub fn there(path: &Path, wanted: bool, told: Told<'_>) {
    if path.exists() != wanted {
        let beside: Vec<_> =
            path.parent().and_then(|folder| folder.read_dir().ok()).into_iter().flatten().flatten().collect();
        let names: Vec<_> = beside.iter().map(std::fs::DirEntry::file_name).collect();
        let is = if wanted { "is not there" } else { "is there, and should not be" };
        told.fail(&format!("  {} {is}; its folder holds {names:?}", path.display()));
    }
}

/// A text has a part: text, part, words.
#[macro_export]
macro_rules! assert_contains {
    ($found:expr, $part:expr $(, $($words:tt)+)?) => {
        $crate::text(AsRef::<str>::as_ref(&$found), $part, $crate::Part::Inside, $crate::told!($found $(, $($words)+)?))
    };
}

/// A text lacks a part: text, part, words.
#[macro_export]
macro_rules! assert_lacks {
    ($found:expr, $part:expr $(, $($words:tt)+)?) => {
        $crate::text(AsRef::<str>::as_ref(&$found), $part, $crate::Part::Nowhere, $crate::told!($found $(, $($words)+)?))
    };
}

/// A text begins with a part: text, part, words.
#[macro_export]
macro_rules! assert_starts {
    ($found:expr, $part:expr $(, $($words:tt)+)?) => {
        $crate::text(AsRef::<str>::as_ref(&$found), $part, $crate::Part::First, $crate::told!($found $(, $($words)+)?))
    };
}

/// A text ends with a part: text, part, words.
#[macro_export]
macro_rules! assert_ends {
    ($found:expr, $part:expr $(, $($words:tt)+)?) => {
        $crate::text(AsRef::<str>::as_ref(&$found), $part, $crate::Part::Last, $crate::told!($found $(, $($words)+)?))
    };
}

/// A file or folder is there: path, words.
#[macro_export]
macro_rules! assert_there {
    ($path:expr $(, $($words:tt)+)?) => {
        $crate::there(AsRef::<std::path::Path>::as_ref(&$path), true, $crate::told!($path $(, $($words)+)?))
    };
}

/// No file and no folder is there: path, words.
#[macro_export]
macro_rules! assert_gone {
    ($path:expr $(, $($words:tt)+)?) => {
        $crate::there(AsRef::<std::path::Path>::as_ref(&$path), false, $crate::told!($path $(, $($words)+)?))
    };
}
