//! What is wrong with settings: the bounds of single values, and how a message says them.

use crate::text::readable;
use crate::units::{Dimension, KINDS, Kind, Quantity, kind_of};

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Path of the key, such as `acoustics.beams.0.rays`.
    pub key: String,
    /// What was found and what is allowed.
    pub message: String,
    /// What to do.
    pub help: Option<String>,
}

/// What was found so far.
#[derive(Clone, Debug, Default)]
pub struct Faults {
    found: Vec<Fault>,
    /// Path of the table that keys are relative to; empty for the whole scenario.
    table: String,
}

/// Powers higher than this of lengths and strains are beyond numbers.
pub const HIGHEST_EXPONENT: f64 = 64.0;

/// Numbers without a unit.
const PURE: Kind = KINDS[0];

impl Faults {
    /// All of them.
    pub fn found(&self) -> &[Fault] {
        &self.found
    }

    /// Whether a key has one; its path is that in the scenario.
    pub fn names(&self, key: &str) -> bool {
        self.found.iter().any(|fault| fault.key == key)
    }

    /// Looks at a table, whose path keys are then relative to.
    pub fn under(&mut self, table: &str, look: impl FnOnce(&mut Self)) {
        let path = self.path_of(table);
        let outer = std::mem::replace(&mut self.table, path);
        look(self);
        self.table = outer;
    }

    /// The key `""` is the table itself.
    fn path_of(&self, key: &str) -> String {
        match (self.table.as_str(), key) {
            ("", key) => key.to_owned(),
            (table, "") => table.to_owned(),
            (table, key) => format!("{table}.{key}"),
        }
    }

    /// Something is wrong with a key.
    pub fn fail(&mut self, key: &str, message: String) {
        let key = self.path_of(key);
        self.found.push(Fault { key, message, help: None });
    }

    /// Something is wrong with a key, and this is what to do.
    pub fn fail_with(&mut self, key: &str, message: String, help: impl Into<String>) {
        let (key, help) = (self.path_of(key), Some(help.into()));
        self.found.push(Fault { key, message, help });
    }

    /// A quantity above zero, and not so near to it that its powers vanish.
    pub fn positive<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8>(
        &mut self,
        key: &str,
        value: Quantity<KG, M, S, K, A>,
    ) {
        self.size(key, value.si(), &kind_of(Quantity::<KG, M, S, K, A>::DIMENSION), false);
    }

    /// A quantity not below zero.
    pub fn not_negative<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8>(
        &mut self,
        key: &str,
        value: Quantity<KG, M, S, K, A>,
    ) {
        self.size(key, value.si(), &kind_of(Quantity::<KG, M, S, K, A>::DIMENSION), true);
    }

    /// A pure number above zero.
    pub fn above_zero(&mut self, key: &str, value: f64) {
        self.size(key, value, &PURE, false);
    }

    /// A pure number not below zero.
    pub fn zero_or_more(&mut self, key: &str, value: f64) {
        self.size(key, value, &PURE, true);
    }

    /// The exponent of a power law: above zero, and no higher than powers of lengths can be computed.
    pub fn exponent(&mut self, key: &str, value: f64) {
        if value > HIGHEST_EXPONENT {
            let found = readable(value, "");
            self.fail(key, format!("found {found}; more than 0 and at most {HIGHEST_EXPONENT} is wanted"));
        } else {
            self.above_zero(key, value);
        }
    }

    /// A size within the range of its kind; `or_zero` where it may be 0.
    pub fn size(&mut self, key: &str, value: f64, kind: &Kind, or_zero: bool) {
        let symbol = if kind.dimension == Dimension::default() { "" } else { kind.symbol };
        let found = readable(value, symbol);
        if value < 0.0 && or_zero {
            self.fail(key, format!("found {found}; 0 or more is wanted"));
        } else if value <= 0.0 && !or_zero {
            self.fail(key, format!("found {found}; more than 0 is wanted"));
        } else if value != 0.0 && !(kind.smallest..=kind.largest).contains(&value) {
            let [least, most] = [kind.smallest, kind.largest].map(|bound| format!("{bound:e} {symbol}"));
            let zero = if or_zero { "0, or " } else { "" };
            let message = format!(
                "found {found}, with which one cannot compute; {zero}{} to {} is allowed",
                least.trim_end(),
                most.trim_end()
            );
            self.fail(key, message);
        }
    }

    /// A count above zero.
    pub fn at_least_one(&mut self, key: &str, count: u32) {
        if count == 0 {
            self.fail(key, "found 0; 1 or more is wanted".to_owned());
        }
    }

    /// A pure number between two bounds, both allowed.
    pub fn within(&mut self, key: &str, value: f64, least: f64, most: f64) {
        if !(least..=most).contains(&value) {
            self.fail(key, format!("found {value}; a number from {least} to {most} is wanted"));
        }
    }
}
