//! The control volume: a block, and what its faces do.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::deformation::Deformation;
use super::space::Space;
use crate::math::Vec3;
use crate::units::{Length, Triple, vector};

/// The control volume: a block with faces along the axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Volume {
    /// Corner with the smallest coordinates.
    pub lower: Triple<Length>,
    /// Corner with the largest coordinates, above `lower` along each axis.
    pub upper: Triple<Length>,
    /// What its faces do.
    #[serde(default)]
    pub boundary: Boundary,
    /// What faces do where they differ from `boundary`; soft spheres only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub faces: Option<Faces>,
    /// How it is drawn out or pressed together; soft spheres only. It stays as it is if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub deformation: Option<Deformation>,
}

/// What the two faces across an axis do, where they differ from the others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Faces {
    /// Those across the x axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<Boundary>,
    /// Those across the y axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<Boundary>,
    /// Those across the z axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z: Option<Boundary>,
}

/// What the faces of the control volume do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Boundary {
    /// The volume repeats itself: what leaves enters on the opposite side, and grains collide across the faces.
    #[default]
    Periodic,
    /// What leaves enters on the opposite side, but grains do not collide across the faces ([B], section 7): r -> -r from
    /// the middle of the volume, so that a grain that a step has taken beyond a face comes out as far before the opposite one.
    Antipodal,
    /// Smooth hard walls: the component across the face changes its sign.
    Reflecting,
    /// The faces do nothing: grains fly on.
    Open,
    /// Who comes out with its center is taken out of the run, with all that it holds; soft spheres only.
    Absorbing,
}

impl Boundary {
    /// Whether what leaves enters on the opposite side.
    pub fn wraps(self) -> bool {
        matches!(self, Self::Periodic | Self::Antipodal)
    }
}

impl Volume {
    /// Corner with the smallest coordinates [m].
    pub fn lower(&self) -> Vec3 {
        vector(self.lower)
    }

    /// Corner with the largest coordinates [m].
    pub fn upper(&self) -> Vec3 {
        vector(self.upper)
    }

    /// Lengths of the edges [m].
    pub fn edges(&self) -> Vec3 {
        self.upper() - self.lower()
    }

    /// Volume [m³].
    pub fn volume(&self) -> f64 {
        let edges = self.edges();
        edges.x * edges.y * edges.z
    }

    /// What the faces across each axis do.
    pub fn boundaries(&self) -> [Boundary; 3] {
        let Faces { x, y, z } = self.faces.unwrap_or_default();
        [x, y, z].map(|across| across.unwrap_or(self.boundary))
    }

    /// Whether space repeats itself along each axis.
    pub fn repeats(&self) -> [bool; 3] {
        self.boundaries().map(|boundary| boundary == Boundary::Periodic)
    }

    /// Space as its faces make it.
    pub fn space(&self) -> Space {
        Space::repeating([self.lower(), self.upper()], self.repeats())
    }

    /// Whether a point [m] lies inside. The lower faces belong to the volume, the upper ones do not, so that of the
    /// images of a point exactly one is inside.
    #[inline]
    pub fn contains(&self, position: Vec3) -> bool {
        let (lower, upper) = (self.lower(), self.upper());
        (0..3).all(|axis| lower[axis] <= position[axis] && position[axis] < upper[axis])
    }

    /// The image of a point [m] that lies inside, where faces are periodic or antipodal; else the point as it is.
    ///
    /// Coordinates that are inside keep their bits.
    ///
    /// ```
    /// # extern crate agglo_core as agglo;
    /// use agglo::domain::Volume;
    /// use agglo::math::Vec3;
    /// let text = r#"{"lower": ["-1 m", "-1 m", "-1 m"], "upper": ["1 m", "1 m", "1 m"], "boundary": "periodic"}"#;
    /// let volume: Volume = serde_json::from_str(text).unwrap();
    /// assert_eq!(volume.wrap(Vec3::new(0.1, 1.25, -4.5)), Vec3::new(0.1, -0.75, -0.5));
    /// ```
    #[inline]
    #[must_use]
    pub fn wrap(&self, position: Vec3) -> Vec3 {
        let wraps = self.boundaries().map(Boundary::wraps);
        if wraps == [false; 3] || self.contains(position) {
            return position;
        }
        Space::repeating([self.lower(), self.upper()], wraps).home(position).0
    }

    /// Where a grain that a step has taken out of an antipodal volume goes on ([B], section 7: r_x -> -r_x, its velocity
    /// kept): each coordinate that is beyond a face and moves outwards is mirrored in the middle of the volume.
    ///
    /// From e beyond one face it comes to e before the opposite one, outside, and moves in. One that moves inwards is left
    /// alone: it would be thrown to and fro for ever.
    #[inline]
    #[must_use]
    pub fn mirrored(&self, position: Vec3, velocity: Vec3) -> Vec3 {
        let (lower, upper) = (self.lower(), self.upper());
        let along = |axis: usize| {
            let (at, speed) = (position[axis], velocity[axis]);
            let leaves = (at >= upper[axis] && speed > 0.0) || (at < lower[axis] && speed < 0.0);
            if leaves { lower[axis] + (upper[axis] - at) } else { at }
        };
        Vec3::new(along(0), along(1), along(2))
    }

    /// The shortest of the vectors [m] that lead from one point to the images of another, given one of them; where
    /// faces are not periodic there is only that one.
    #[inline]
    #[must_use]
    pub fn shortest(&self, displacement: Vec3) -> Vec3 {
        self.space().shortest(displacement)
    }

    /// The image of `place` that is nearest to `from`, where images meet [m].
    #[must_use]
    pub fn nearest_image(&self, place: Vec3, from: Vec3) -> Vec3 {
        from + self.shortest(place - from)
    }

    /// Whether a sphere may be here: anywhere but in a face that reflects it.
    pub fn holds(&self, center: Vec3, radius: f64) -> bool {
        let (lower, upper) = (self.lower(), self.upper());
        let is_clear =
            |axis: usize| lower[axis] + radius <= center[axis] && center[axis] <= upper[axis] - radius;
        let boundaries = self.boundaries();
        (0..3).all(|axis| boundaries[axis] != Boundary::Reflecting || is_clear(axis))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};
    use crate::units::Quantity;

    fn volume(boundary: Boundary) -> Volume {
        let (lower, upper) = ([-0.3, 1.0, -7.0], [0.7, 1.1, -2.5]);
        Volume {
            lower: lower.map(Quantity),
            upper: upper.map(Quantity),
            boundary,
            faces: None,
            deformation: None,
        }
    }

    #[test]
    fn edges_and_volume() {
        let volume = volume(Boundary::Open);
        // 0.7 + 0.3, 1.1 - 1 and 7 - 2.5, each rounded once.
        assert_near_vector!(volume.edges(), Vec3::new(1.0, 0.1, 4.5), 1e-15);
        assert_near!(volume.volume(), 0.45, 1e-15);
        assert_eq!(volume.upper(), Vec3::new(0.7, 1.1, -2.5));
    }

    /// Whole periods away from a point inside, the same point comes back to the rounding of the largest coordinate
    /// on the way (a few hundred meters, so 1e-13 m), and it lies inside.
    #[test]
    fn images_come_back_to_their_point() {
        let mut stream = Stream::new(4, Purpose::Sampling, 0);
        for boundary in [Boundary::Periodic, Boundary::Antipodal] {
            let volume = volume(boundary);
            let edges = volume.edges();
            for k in 0..10_000 {
                let point = volume.lower()
                    + Vec3::AXES
                        .into_iter()
                        .zip(edges.to_array())
                        .fold(Vec3::ZERO, |sum, (axis, edge)| sum + axis * (edge * stream.uniform()));
                assert_true!(volume.contains(point), "{point:?} in {volume:?}");
                assert_eq!(
                    volume.wrap(point).to_array().map(f64::to_bits),
                    point.to_array().map(f64::to_bits)
                );
                let periods = [k % 7 - 3, k % 11 - 5, k % 101 - 50].map(f64::from);
                let image =
                    point + Vec3::new(periods[0] * edges.x, periods[1] * edges.y, periods[2] * edges.z);
                let back = volume.wrap(image);
                assert_true!(volume.contains(back), "{back:?} in {volume:?}");
                let apart = (back - point).to_array();
                for (axis, apart) in apart.into_iter().enumerate() {
                    // A point a hair from a face may come back at the opposite one.
                    assert!(
                        apart.abs() < 2e-13 || (apart.abs() - edges[axis]).abs() < 2e-13,
                        "{apart:e} m along axis {axis} is neither 0 nor the edge"
                    );
                }
            }
        }
    }

    #[test]
    fn faces_have_one_side() {
        let volume = volume(Boundary::Periodic);
        assert_true!(volume.contains(volume.lower()), "a corner of {volume:?}");
        assert_false!(volume.contains(volume.upper()), "a corner of {volume:?}");
        assert_eq!(volume.wrap(volume.upper()), volume.lower());
        let below = Vec3::new(-0.3, 1.0_f64.next_down(), -7.0);
        assert_true!(volume.contains(volume.wrap(below)), "a corner of {volume:?}");
        // Only the coordinate that is outside changes.
        let across = volume.wrap(Vec3::new(0.1, 1.04, -8.0));
        assert_eq!((across.x, across.y), (0.1, 1.04));
        assert_near!(across.z, -3.5, 1e-15);
        assert_nan!(volume.wrap(Vec3::new(f64::NAN, 1.04, -3.0)).x);
    }

    /// D + e comes to -D - e, along each axis by itself and only outwards; the faces are at -0.3, 0.7 and so on.
    #[test]
    fn antipodal_volumes_mirror_who_leaves() {
        let volume = volume(Boundary::Antipodal);
        let found = volume.mirrored(Vec3::new(0.95, 1.05, -7.25), Vec3::new(3.0, -1.0, -2.0));
        // One rounding of each sum.
        assert!((found - Vec3::new(-0.55, 1.05, -2.25)).norm() < 1e-15, "{found:?}");
        let inwards = Vec3::new(-0.55, 1.05, -2.25);
        assert_eq!(volume.mirrored(inwards, Vec3::new(3.0, -1.0, -2.0)), inwards);
        // At the faces themselves it is what an edge does.
        assert_eq!(volume.mirrored(volume.upper(), Vec3::new(1.0, 1.0, 1.0)), volume.lower());
    }

    #[test]
    fn walls_and_open_faces_leave_points_alone() {
        let far = Vec3::new(9.0, -9.0, 0.0);
        for boundary in [Boundary::Reflecting, Boundary::Open] {
            assert_eq!(volume(boundary).wrap(far), far);
            assert_eq!(volume(boundary).shortest(far), far);
        }
        assert_eq!(volume(Boundary::Antipodal).shortest(far), far);
    }

    /// Against the shortest of all images within four periods.
    #[test]
    fn shortest_of_many_images() {
        let volume = volume(Boundary::Periodic);
        let edges = volume.edges();
        let mut stream = Stream::new(5, Purpose::Sampling, 0);
        for _ in 0..200 {
            let between = stream.direction() * 1.2 * stream.uniform();
            let mut least = f64::INFINITY;
            for k in 0..9 * 35 * 9 {
                let [i, j, k] = [k % 9 - 4, k / 9 % 35 - 17, k / 9 / 35 - 4].map(f64::from);
                least = least.min((between + Vec3::new(i * edges.x, j * edges.y, k * edges.z)).norm());
            }
            assert_near!(volume.shortest(between).norm(), least, 1e-14);
        }
    }
}
