//! Regions of space: sphere, box, cylinder.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::Vec3;
use crate::units::{Length, Triple, vector};

/// A region of space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Region {
    /// A ball.
    Sphere(Ball),
    /// A block with faces along the axes.
    Box(Block),
    /// A straight circular cylinder.
    Cylinder(Cylinder),
}

/// A ball.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ball {
    /// Its centre; the origin if left out.
    #[serde(default)]
    pub center: Triple<Length>,
    /// Its radius.
    pub radius: Length,
}

/// A block with faces along the axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// Corner with the smallest coordinates.
    pub lower: Triple<Length>,
    /// Corner with the largest coordinates.
    pub upper: Triple<Length>,
}

/// A straight circular cylinder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// Its centre; the origin if left out.
    #[serde(default)]
    pub center: Triple<Length>,
    /// Direction of its axis.
    pub axis: [f64; 3],
    /// Its radius.
    pub radius: Length,
    /// Its length along the axis.
    pub length: Length,
}

impl Region {
    /// Middle of the region [m].
    pub fn center(&self) -> Vec3 {
        match self {
            Self::Sphere(ball) => vector(ball.center),
            Self::Box(block) => (vector(block.lower) + vector(block.upper)) * 0.5,
            Self::Cylinder(cylinder) => vector(cylinder.center),
        }
    }

    /// Radius [m] of the ball about [`Region::center`] that encloses the region.
    pub fn enclosing_radius(&self) -> f64 {
        match self {
            Self::Sphere(ball) => ball.radius.si(),
            Self::Box(block) => 0.5 * (vector(block.upper) - vector(block.lower)).norm(),
            Self::Cylinder(cylinder) => cylinder.radius.si().hypot(0.5 * cylinder.length.si()),
        }
    }

    /// Volume [m³].
    pub fn volume(&self) -> f64 {
        use std::f64::consts::PI;
        match self {
            Self::Sphere(ball) => 4.0 / 3.0 * PI * ball.radius.si().powi(3),
            Self::Box(block) => {
                let edges = vector(block.upper) - vector(block.lower);
                edges.x * edges.y * edges.z
            }
            Self::Cylinder(cylinder) => PI * cylinder.radius.si().powi(2) * cylinder.length.si(),
        }
    }

    /// Whether a sphere lies wholly inside; `radius` 0 asks for a point.
    pub fn contains(&self, center: Vec3, radius: f64) -> bool {
        match self {
            Self::Sphere(ball) => (center - vector(ball.center)).norm() + radius <= ball.radius.si(),
            Self::Box(block) => {
                let low = center - vector(block.lower);
                let high = vector(block.upper) - center;
                low.x.min(low.y).min(low.z).min(high.x).min(high.y).min(high.z) >= radius
            }
            Self::Cylinder(cylinder) => {
                let axis = Vec3::from(cylinder.axis).normalized();
                let from = center - vector(cylinder.center);
                from.rejected_from(axis).norm() + radius <= cylinder.radius.si()
                    && from.dot(axis).abs() + radius <= 0.5 * cylinder.length.si()
            }
        }
    }
}
