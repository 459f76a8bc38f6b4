//! Ways to put grains somewhere.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::domain::Region;
use crate::math::Vec3;
use crate::units::{Length, Triple, Velocity};

/// The closed set of ways to place grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Placement {
    /// Random sequential addition (Widom 1966).
    Random(RandomAddition),
    /// The same in the control volume of hard spheres, across its faces where they are periodic.
    Fill(Fill),
    /// A lattice.
    Lattice(Lattice),
    /// Rows of a CSV file.
    Table(Table),
    /// Positions written in the scenario.
    List(GrainList),
}

/// Random sequential addition in a region, without overlap.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RandomAddition {
    /// How many grains; or give `solid_fraction`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// Volume of the grains over that of the region; or give `count`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid_fraction: Option<f64>,
    /// Where; grains lie wholly inside.
    pub region: Region,
    /// Least distance between surfaces.
    #[serde(default)]
    pub gap: Length,
}

/// Random sequential addition in the control volume, without overlap.
///
/// With periodic or antipodal faces centers lie anywhere in the volume and images are kept clear of; with reflecting or
/// open ones grains lie wholly inside.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fill {
    /// How many grains; or give `solid_fraction`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// Volume of the grains over that of the volume; or give `count`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid_fraction: Option<f64>,
    /// Least distance between surfaces.
    #[serde(default)]
    pub gap: Length,
}

/// The points of a lattice that lie in a region.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lattice {
    /// Which lattice.
    pub kind: LatticeKind,
    /// Distance of nearest neighbors.
    pub spacing: Length,
    /// Where; grains lie wholly inside.
    pub region: Region,
    /// How many at the most, those nearest to the region's middle; all if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
}

/// The closed set of lattices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LatticeKind {
    /// Simple cubic.
    Cubic,
    /// Face-centered cubic.
    Fcc,
    /// Body-centered cubic.
    Bcc,
    /// Hexagonal close-packed.
    Hcp,
}

/// A CSV file with the columns x_m, y_m, z_m and optionally radius_m, temperature_K, velocities, angular velocities and
/// primaries.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// The file, relative to the scenario's folder.
    pub file: PathBuf,
}

/// Grains written out one by one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainList {
    /// Centers.
    pub positions: Vec<Triple<Length>>,
    /// Velocities, one per position; the group's if left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub velocities: Vec<Triple<Velocity>>,
}

/// A row of a table: what it does not say is `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TableGrain {
    /// Its id.
    pub id: Option<u32>,
    /// Center [m].
    pub position: Vec3,
    /// Radius [m].
    pub radius: Option<f64>,
    /// Velocity [m/s].
    pub velocity: Option<Vec3>,
    /// Angular velocity [rad/s].
    pub angular_velocity: Option<Vec3>,
    /// Temperature [K].
    pub temperature: Option<f64>,
    /// How many primary grains it is made of.
    pub primaries: Option<u32>,
}
