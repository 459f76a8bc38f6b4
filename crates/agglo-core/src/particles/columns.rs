//! The state of the grains as columns, declared once.
//!
//! Everything that handles "all columns" (frames, checkpoints, reordering) is derived from the one
//! declaration below.

use serde::{Deserialize, Serialize};

use super::Motion;
use crate::math::Vec3;

/// What is known of a column besides its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name in files and in Python.
    pub name: &'static str,
    /// SI unit; empty for numbers and ids.
    pub unit: &'static str,
}

/// The values of one column.
#[derive(Clone, Copy, Debug)]
pub enum ColumnValues<'a> {
    /// Names and counts.
    Integers(&'a [u32]),
    /// Scalars.
    Scalars(&'a [f64]),
    /// Vectors.
    Vectors(&'a [Vec3]),
}

impl ColumnValues<'_> {
    /// Whether all are finite.
    fn are_finite(self) -> bool {
        match self {
            Self::Integers(_) => true,
            Self::Scalars(values) => values.iter().all(|value| value.is_finite()),
            Self::Vectors(values) => values.iter().all(|value| value.is_finite()),
        }
    }
}

impl<'a> From<&'a [u32]> for ColumnValues<'a> {
    fn from(values: &'a [u32]) -> Self {
        Self::Integers(values)
    }
}
impl<'a> From<&'a [f64]> for ColumnValues<'a> {
    fn from(values: &'a [f64]) -> Self {
        Self::Scalars(values)
    }
}
impl<'a> From<&'a [Vec3]> for ColumnValues<'a> {
    fn from(values: &'a [Vec3]) -> Self {
        Self::Vectors(values)
    }
}

macro_rules! columns {
    ($($(#[$doc:meta])* $field:ident: $type:ty, $unit:literal;)*) => {
        /// The grains, one vector per quantity, all of the same length.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct Particles {
            $($(#[$doc])* pub $field: Vec<$type>,)*
        }

        /// One grain, as it is put in or taken out.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct Row {
            $($(#[$doc])* pub $field: $type,)*
        }

        /// Every column, in the order of declaration.
        pub const COLUMNS: &[Column] = &[
            $(Column { name: stringify!($field), unit: $unit },)*
        ];

        impl Particles {
            /// Whether all columns have one length and all their numbers are finite.
            ///
            /// # Errors
            /// The column that is wrong.
            pub(crate) fn validate(&self) -> Result<(), String> {
                $(if self.$field.len() != self.id.len() {
                    return Err(format!("grains: {} has {} values", stringify!($field), self.$field.len()));
                }
                if !ColumnValues::from(self.$field.as_slice()).are_finite() {
                    return Err(format!("grains: {} is not finite", stringify!($field)));
                })*
                for (what, values) in [("radius", &self.radius), ("mass", &self.mass)] {
                    if !values.iter().all(|value| *value > 0.0) {
                        return Err(format!("grains: {what} is not above 0"));
                    }
                }
                Ok(())
            }

            /// Adds a grain at the end.
            pub fn push(&mut self, row: Row) {
                $(self.$field.push(row.$field);)*
            }

            /// The grain at a place.
            pub fn row(&self, at: usize) -> Row {
                Row { $($field: self.$field[at],)* }
            }

            /// Puts the grains into another order: the one at `order[k]` comes to place k.
            pub fn reorder(&mut self, order: &[u32]) {
                $(self.$field = order.iter().map(|&at| self.$field[at as usize]).collect();)*
            }

            /// All columns with what is known of them.
            pub fn columns(&self) -> Vec<(Column, ColumnValues<'_>)> {
                let values = [$(ColumnValues::from(self.$field.as_slice()),)*];
                COLUMNS.iter().copied().zip(values).collect()
            }
        }
    };
}

columns! {
    /// Id of the grain, which never changes [n].
    id: u32, "";
    /// Center [n, 3] [m].
    position: Vec3, "m";
    /// Velocity of the center [n, 3] [m/s].
    velocity: Vec3, "m/s";
    /// Angular velocity [n, 3] [rad/s].
    angular_velocity: Vec3, "rad/s";
    /// Radius [n] [m].
    radius: f64, "m";
    /// Mass [n] [kg].
    mass: f64, "kg";
    /// Number of the material [n].
    material: u32, "";
    /// Temperature [n] [K].
    temperature: f64, "K";
    /// Electric charge [n] [C].
    charge: f64, "C";
    /// Sign χ_i of the near field [n]: +1 or -1.
    polarity: f64, "";
    /// Contact stiffness at the grain's temperature [n] [Pa].
    contact_stiffness: f64, "Pa";
    /// Power taken from rays, summed over all hits since the start [n] [W].
    absorbed_power: f64, "W";
}

impl Particles {
    /// How many grains.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Where all grains are and how they move.
    pub fn motion(&self) -> Motion<'_> {
        let Self { position, velocity, angular_velocity, .. } = self;
        Motion { position, velocity, angular_velocity }
    }

    /// Center [m], velocity [m/s] and angular velocity [rad/s] of one.
    #[inline]
    pub fn motion_of(&self, at: usize) -> (Vec3, Vec3, Vec3) {
        (self.position[at], self.velocity[at], self.angular_velocity[at])
    }

    /// Moment of inertia [kg m²] of a solid sphere.
    #[inline]
    pub fn inertia(&self, at: usize) -> f64 {
        0.4 * self.mass[at] * self.radius[at] * self.radius[at]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reorder_moves_every_column() {
        let mut grains = Particles::default();
        for k in 0..3_u32 {
            let value = f64::from(k);
            grains.push(Row { id: k, position: Vec3::new(value, 0.0, 0.0), mass: value, ..Row::default() });
        }
        let before = grains.clone();
        grains.reorder(&[2, 0, 1]);
        assert_eq!([0, 1, 2].map(|k| grains.row(k)), [2, 0, 1].map(|k| before.row(k)));
        assert_eq!(grains.columns().len(), COLUMNS.len());
    }
}
