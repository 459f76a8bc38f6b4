//! Shapes of walls: where the points of a wall are that a grain is nearest to.

mod cuboid;
mod cylinder;
mod plane;
mod sphere;
mod surface;

pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use plane::{Opening, Plane};
pub use sphere::Sphere;
pub use surface::{Line, Near, Side, Struck, Surface, Triangle};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::law::Faults;
use crate::math::Vec3;

/// Makes the enum that a scenario fills, and hands every question on to whichever shape there is.
macro_rules! shapes {
    ($($(#[$meta:meta])* $Word:ident($Shape:ident) = $word:literal;)+) => {
        /// The shape of a wall at time zero.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "snake_case")]
        pub enum Shape {
            $($(#[$meta])* $Word($Shape),)+
        }

        impl Shape {
            /// Its word in a scenario.
            pub fn word(&self) -> &'static str {
                match self {
                    $(Self::$Word(_) => $word,)+
                }
            }

            /// What is wrong with it; keys are relative to the table of the wall.
            pub fn faults(&self, faults: &mut Faults) {
                faults.under(&format!("shape.{}", self.word()), |faults| match self {
                    $(Self::$Word(shape) => shape.faults(faults),)+
                });
            }

            fn surface(&self) -> &dyn Surface {
                match self {
                    $(Self::$Word(shape) => shape,)+
                }
            }

            /// The point of a face that is nearest to a point [m].
            #[inline]
            pub fn nearest(&self, face: u32, point: Vec3) -> Near {
                match self {
                    $(Self::$Word(shape) => shape.nearest(face, point),)+
                }
            }
        }
    };
}

shapes! {
    /// A plane, or with an opening a thin plate.
    Plane(Plane) = "plane";
    /// A box with faces along the axes.
    Box(Cuboid) = "box";
    /// A straight circular cylinder.
    Cylinder(Cylinder) = "cylinder";
    /// A sphere.
    Sphere(Sphere) = "sphere";
}

impl Shape {
    /// How many contacts a grain can have with it at once.
    pub fn faces(&self) -> u32 {
        self.surface().faces()
    }

    /// Where a line first comes upon one of its faces, counted by the distance along the line.
    #[inline]
    pub fn struck(&self, face: u32, line: &Line) -> Option<Struck> {
        self.surface().struck(face, line)
    }

    /// Whether a line that leaves a face can come upon the same face next.
    pub fn curves_around(&self, face: u32) -> bool {
        self.surface().curves_around(face)
    }

    /// On which side of it a point [m] is, where it is thin.
    pub fn side(&self, point: Vec3) -> Option<f64> {
        self.surface().side(point)
    }

    /// The point [m] that it turns about where none is given.
    pub fn middle(&self) -> Vec3 {
        self.surface().middle()
    }

    /// Its smallest radius of curvature [m]; infinite where it is flat or has edges alone.
    pub fn curvature_radius(&self) -> f64 {
        self.surface().curvature_radius()
    }

    /// Whether it is the same all along a direction.
    pub fn goes_on_along(&self, direction: Vec3) -> bool {
        self.surface().goes_on_along(direction)
    }

    /// Whether it has an end in every direction.
    pub fn is_bounded(&self) -> bool {
        self.endless_part(Vec3::ZERO).is_none()
    }

    /// How far an offset [m] reaches in the directions in which it has no end [m]; nothing where it has an end in all.
    pub(super) fn endless_part(&self, offset: Vec3) -> Option<f64> {
        self.surface().endless_part(offset)
    }

    /// Triangles that show it; where it has no end as far as it reaches this length [m] from a point [m].
    pub fn triangles(&self, about: Vec3, within: f64) -> Vec<Triangle> {
        self.surface().triangles(about, within)
    }
}

#[cfg(test)]
mod tests;
