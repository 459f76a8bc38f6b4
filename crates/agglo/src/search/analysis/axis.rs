//! What an axis stands for.

use serde::Serialize;

use crate::text::number;

/// What an axis stands for: a quantity with its unit, or a choice from a list.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Axis {
    /// Name of the quantity.
    pub name: String,
    /// Its unit; empty where it has none.
    pub unit: String,
    /// Whether equal ratios are equal lengths; values that are not positive are then left out.
    pub is_log: bool,
    /// The words of a choice: the value 0 is the first. Empty for a quantity.
    pub labels: Vec<String>,
}

impl Axis {
    /// A quantity; `unit` is empty where it has none.
    pub fn new(name: &str, unit: &str) -> Self {
        Self { name: name.to_owned(), unit: unit.to_owned(), ..Self::default() }
    }

    /// The same on a logarithmic scale.
    #[must_use]
    pub fn log(self) -> Self {
        Self { is_log: true, ..self }
    }

    /// A choice from a list.
    pub fn choice(name: &str, labels: &[&str]) -> Self {
        Self {
            name: name.to_owned(),
            labels: labels.iter().map(|&l| l.to_owned()).collect(),
            ..Self::default()
        }
    }

    /// Name and unit: `v [m/s]`.
    /// ```
    /// use agglo::search::analysis::Axis;
    /// assert_eq!(Axis::new("speed", "m/s").title(), "speed [m/s]");
    /// ```
    pub fn title(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} [{}]", self.name, self.unit) }
    }

    /// Name of its column in tables: `v_m_s`.
    /// ```
    /// use agglo::search::analysis::Axis;
    /// assert_eq!(Axis::new("v", "m/s").column(), "v_m_s");
    /// assert_eq!(Axis::new("temperature_mean_K", "K").column(), "temperature_mean_K");
    /// ```
    pub fn column(&self) -> String {
        let unit = self.unit.replace('^', "");
        let words: Vec<&str> =
            unit.split(|c: char| !c.is_alphanumeric()).filter(|part| !part.is_empty()).collect();
        let suffix = format!("_{}", words.join("_"));
        if words.is_empty() || self.name.ends_with(&suffix) {
            self.name.clone()
        } else {
            self.name.clone() + &suffix
        }
    }

    /// A value in a table: a number that reads back with the same bits, or a word.
    pub fn cell(&self, value: f64) -> String {
        self.labels.get(value as usize).cloned().unwrap_or_else(|| number(value))
    }
}
