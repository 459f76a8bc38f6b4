//! What a grain is to the near field.

/// What a grain is to the near field.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Source {
    /// Mass [kg].
    pub mass: f64,
    /// Radius [m].
    pub radius: f64,
    /// Charge [C].
    pub charge: f64,
    /// Sign c of [A] 28: 1 or -1.
    pub polarity: f64,
}
