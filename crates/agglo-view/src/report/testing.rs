//! Columns made up for tests.

use agglo::record::About;

/// A column of numbers.
pub const fn about(name: &'static str, unit: &'static str, label: &'static str) -> About {
    About {
        name,
        unit,
        label,
        meaning: "",
        may_be_empty: false,
        is_word: false,
        is_part: false,
        panel: None,
        glance: None,
    }
}
