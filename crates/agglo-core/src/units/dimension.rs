//! Dimensions as powers of kilogram, meter, second, kelvin and ampere.

use std::fmt;

/// Powers of kg, m, s, K, A.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Dimension(pub [i8; 5]);

/// What users call a dimension, the SI symbol it is written with, and an example.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Powers of kg, m, s, K, A.
    pub dimension: Dimension,
    /// "a length", as it stands in a message.
    pub name: &'static str,
    /// The SI unit's symbol, readable by the parser.
    pub symbol: &'static str,
    /// A value as a scenario would write it.
    pub example: &'static str,
    /// The least size above 0 [SI units] of what must not be 0, such as a radius: its powers would vanish.
    pub smallest: f64,
    /// The largest size [SI units]: powers and products of larger ones overflow.
    pub largest: f64,
}

macro_rules! kinds {
    ($($dims:expr, $name:literal, $symbol:literal, $example:literal, $smallest:literal, $largest:literal;)*) => {
        /// The kinds of quantity that scenarios know, each with the one range of all keys of that kind.
        ///
        /// The ranges are far wider than physics, and so narrow that cubes, fourth powers and products of several
        /// quantities stay finite and above 0.
        pub const KINDS: &[Kind] = &[$(Kind {
            dimension: Dimension($dims), name: $name, symbol: $symbol, example: $example,
            smallest: $smallest, largest: $largest,
        }),*];
    };
}

kinds! {
    [0, 0, 0, 0, 0], "a pure number", "1", "0.5", 1e-30, 1e30;
    [0, 1, 0, 0, 0], "a length", "m", "40 um", 1e-15, 1e9;
    [0, 2, 0, 0, 0], "an area", "m^2", "1 mm^2", 1e-30, 1e18;
    [0, 3, 0, 0, 0], "a volume", "m^3", "1 mm^3", 1e-45, 1e27;
    [0, 0, 1, 0, 0], "a time", "s", "0.25 ms", 1e-21, 1e15;
    [1, 0, 0, 0, 0], "a mass", "kg", "3 mg", 1e-50, 1e30;
    [0, 0, 0, 1, 0], "a temperature", "K", "300 K", 1e-6, 1e9;
    [0, 0, 0, 0, 1], "a current", "A", "1 A", 1e-21, 1e12;
    [0, 1, -1, 0, 0], "a velocity", "m/s", "1500 m/s", 1e-18, 1e9;
    [0, 1, -2, 0, 0], "an acceleration", "m/s^2", "9.81 m/s^2", 1e-18, 1e18;
    [0, 0, -1, 0, 0], "a frequency", "1/s", "20 kHz", 1e-15, 1e18;
    [1, -3, 0, 0, 0], "a density", "kg/m^3", "1000 kg/m^3", 1e-12, 1e30;
    [1, -1, -2, 0, 0], "a pressure", "Pa", "150 MPa", 1e-12, 1e20;
    [1, -1, -1, 0, 0], "a viscosity", "Pa s", "1 mPa s", 1e-15, 1e15;
    [1, 0, -2, 0, 0], "a stiffness", "N/m", "100 N/m", 1e-15, 1e18;
    [1, -2, -1, 0, 0], "a damping per area", "Pa s/m", "1e5 Pa s/m", 1e-12, 1e24;
    [1, -2, -2, 0, 0], "a stiffness per area", "Pa/m", "1e7 Pa/m", 1e-12, 1e30;
    [1, 1, -2, 0, 0], "a force", "N", "3 nN", 1e-30, 1e20;
    [1, 2, -2, 0, 0], "an energy", "J", "2 nJ", 1e-40, 1e20;
    [1, 2, -3, 0, 0], "a power", "W", "150 W", 1e-24, 1e24;
    [0, 2, -2, -1, 0], "a specific heat", "J/(kg K)", "1000 J/(kg K)", 1e-6, 1e12;
    [1, 0, -3, -1, 0], "a heat transfer coefficient", "W/(m^2 K)", "10 W/(m2 K)", 1e-12, 1e12;
    [1, 1, -3, -1, 0], "a thermal conductivity", "W/(m K)", "0.5 W/(m K)", 1e-12, 1e12;
    [0, 0, 1, 0, 1], "a charge", "C", "1 pC", 1e-25, 1e9;
    [-1, 2, 2, 0, 2], "an energy per squared flux density", "J/T^2", "1e-9 J/T^2", 1e-60, 1e12;
    [1, 0, -2, 0, -1], "a magnetic flux density", "T", "0.1 T", 1e-18, 1e9;
    [1, 1, -3, 0, -1], "an electric field", "V/m", "1 kV/m", 1e-15, 1e15;
}

/// The kind with this dimension; an unnamed one is called "a quantity".
pub fn kind_of(dimension: Dimension) -> Kind {
    let (smallest, largest) = (1e-60, 1e60);
    let unnamed = Kind { dimension, name: "a quantity", symbol: "", example: "", smallest, largest };
    KINDS.iter().copied().find(|kind| kind.dimension == dimension).unwrap_or(unnamed)
}

impl Kind {
    /// Whether one can compute with a value [SI units]: finite, and no larger than the kind allows.
    pub fn holds(&self, value: f64) -> bool {
        value.abs() <= self.largest
    }
}

impl Dimension {
    /// The SI symbol, such as `Pa s`, or a product of base units.
    pub fn symbol(self) -> String {
        let named = kind_of(self).symbol;
        if named.is_empty() { self.to_string() } else { named.to_owned() }
    }

    /// The dimension of a product with `other` to the power `power`, or nothing where a power overflows.
    pub(super) fn times(self, other: Self, power: i8) -> Option<Self> {
        let mut product = self;
        for (mine, theirs) in product.0.iter_mut().zip(other.0) {
            *mine = mine.checked_add(theirs.checked_mul(power)?)?;
        }
        Some(product)
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let factors = ["kg", "m", "s", "K", "A"].iter().zip(self.0).filter(|(_, power)| *power != 0);
        let words: Vec<String> = factors
            .map(|(unit, power)| match power {
                1 => (*unit).to_owned(),
                _ => format!("{unit}^{power}"),
            })
            .collect();
        if words.is_empty() { write!(f, "1") } else { write!(f, "{}", words.join(" ")) }
    }
}
