//! What grains can be colored by.

use super::map::Map;
use agglo::record::frames::{FieldValues, Frame};

/// How values become colors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coloring {
    /// By a map over a range of values.
    Values(Map),
    /// A color for each cluster; the heaviest has the first, single grains are gray.
    Clusters,
    /// A color for each material.
    Materials,
}

/// Something that grains can be colored by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Its word in the terminal.
    pub word: &'static str,
    /// Its name in the legend.
    pub title: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The field in frames.
    pub field: &'static str,
    /// How its values become colors.
    pub coloring: Coloring,
    /// Whether a few grains have values far beyond the others', so that the range leaves the uppermost hundredth out.
    pub has_outliers: bool,
}

const fn values(
    word: &'static str,
    title: &'static str,
    unit: &'static str,
    field: &'static str,
    map: Map,
) -> Quantity {
    Quantity { word, title, unit, field, coloring: Coloring::Values(map), has_outliers: false }
}

impl Quantity {
    /// All of them, the most telling first.
    pub const ALL: [Self; 12] = [
        Quantity { has_outliers: true, ..values("speed", "Speed", "m/s", "velocity_m_s", Map::Viridis) },
        values("temperature", "Temperature", "K", "temperature_K", Map::Inferno),
        Quantity {
            coloring: Coloring::Clusters,
            ..values("cluster", "Cluster", "", "cluster", Map::Viridis)
        },
        Quantity {
            has_outliers: true,
            ..values("absorbed_power", "Absorbed power", "W", "absorbed_power_W", Map::Inferno)
        },
        values("size", "Radius", "m", "radius_m", Map::Cividis),
        values("id", "Grain", "", "id", Map::Viridis),
        Quantity {
            coloring: Coloring::Materials,
            ..values("material", "Material", "", "material", Map::Viridis)
        },
        values("primaries", "Primaries", "", "primaries", Map::Viridis),
        Quantity { has_outliers: true, ..values("mass", "Mass", "kg", "mass_kg", Map::Cividis) },
        values("charge", "Charge", "C", "charge_C", Map::Viridis),
        Quantity {
            has_outliers: true,
            ..values("angular_velocity", "Angular velocity", "rad/s", "angular_velocity_rad_s", Map::Viridis)
        },
        values("polarity", "Polarity", "", "polarity", Map::Viridis),
    ];

    /// The quantities that a frame holds, the most telling first.
    pub fn all_in(frame: &Frame) -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|quantity| frame.field(quantity.field).is_some())
    }

    /// A value for each grain [n] in SI units, of a vector its length; nothing where the frame does not have it.
    pub fn of(&self, frame: &Frame) -> Option<Vec<f64>> {
        Some(match frame.field(self.field)? {
            FieldValues::Integers(values) => values.iter().copied().map(f64::from).collect(),
            FieldValues::Scalars(values) => values.clone(),
            FieldValues::Vectors(values) => {
                values.iter().map(|[x, y, z]| (x * x + y * y + z * z).sqrt()).collect()
            }
        })
    }
}
