//! A box with faces along the axes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::surface::{
    Line, Near, Side, Struck, Surface, Triangle, Within, fan, toward, turned_over, upon_plane,
};
use crate::law::Faults;
use crate::math::Vec3;
use crate::text::told_apart;
use crate::units::{Length, Triple, vector};

/// A box with faces along the axes. From inside a grain touches each of its faces by itself; from outside it touches the one
/// nearest point, on a face, an edge or a corner.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cuboid {
    /// Corner with the smallest coordinates.
    pub lower: Triple<Length>,
    /// Corner with the largest coordinates.
    pub upper: Triple<Length>,
    /// Where grains are.
    #[serde(default)]
    pub side: Side,
}

impl Cuboid {
    /// The nearest point of the face that is left by the shortest way, from inside the solid.
    fn way_out(lower: Vec3, upper: Vec3, point: Vec3) -> Near {
        let mut out = Near { normal: Vec3::AXES[0], gap: f64::NEG_INFINITY };
        for (axis, along) in Vec3::AXES.into_iter().enumerate() {
            let (below, above) = (point[axis] - lower[axis], upper[axis] - point[axis]);
            // A normal toward the wall points into the solid.
            for (depth, normal) in [(below, along), (above, -along)] {
                if -depth > out.gap {
                    out = Near { normal, gap: -depth };
                }
            }
        }
        out
    }
}

impl Surface for Cuboid {
    fn faults(&self, faults: &mut Faults) {
        for (axis, name) in ["x", "y", "z"].iter().enumerate() {
            let (low, high) = (self.lower[axis].si(), self.upper[axis].si());
            if high <= low {
                let [low, high] = told_apart([low, high], "m");
                let message = format!("upper {name} = {high} is not above lower {name} = {low}");
                faults.fail(&format!("upper.{axis}"), message);
            }
        }
    }

    fn faces(&self) -> u32 {
        match self.side {
            Side::Inside => 6,
            Side::Outside => 1,
        }
    }

    #[inline]
    fn nearest(&self, face: u32, point: Vec3) -> Near {
        let (lower, upper) = (vector(self.lower), vector(self.upper));
        match self.side {
            Side::Inside => {
                let axis = (face / 2) as usize;
                if face.is_multiple_of(2) {
                    Near { normal: -Vec3::AXES[axis], gap: point[axis] - lower[axis] }
                } else {
                    Near { normal: Vec3::AXES[axis], gap: upper[axis] - point[axis] }
                }
            }
            Side::Outside => {
                let offset = point.max(lower).min(upper) - point;
                if offset == Vec3::ZERO {
                    Self::way_out(lower, upper, point)
                } else {
                    toward(offset, Vec3::AXES[0])
                }
            }
        }
    }

    fn struck(&self, face: u32, line: &Line) -> Option<Struck> {
        if self.side == Side::Inside {
            let near = self.nearest(face, line.origin);
            return upon_plane(line, near.gap, -near.normal);
        }
        let mut within = Within::ALL;
        for (axis, along) in Vec3::AXES.into_iter().enumerate() {
            let ends = [self.lower[axis].si(), self.upper[axis].si()];
            within = within.and(Within::slab(line, along, ends, line.origin[axis])?);
        }
        within.struck(line, |place| -self.nearest(0, place).normal)
    }

    fn middle(&self) -> Vec3 {
        (vector(self.lower) + vector(self.upper)) * 0.5
    }

    fn triangles(&self, _: Vec3, _: f64) -> Vec<Triangle> {
        let half = (vector(self.upper) - vector(self.lower)) * 0.5;
        let mut seen_from_outside = Vec::new();
        for axis in 0..3 {
            let [along, first, second] =
                [0, 1, 2].map(|turn| Vec3::AXES[(axis + turn) % 3] * half[(axis + turn) % 3]);
            for sign in [1.0, -1.0] {
                let center = self.middle() + along * sign;
                let turn = second * sign;
                let corners = [first + turn, turn - first, -(first + turn), first - turn];
                let rim = corners.map(|corner| center + corner);
                seen_from_outside.extend(fan(rim[0], &rim[1..]));
            }
        }
        match self.side {
            Side::Inside => turned_over(seen_from_outside),
            Side::Outside => seen_from_outside,
        }
    }
}
