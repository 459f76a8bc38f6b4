//! Walls as sound meets them: where its rays come upon them next.
//!
//! Walls stand still while rays fly through a step, where they are at its start. A plate is thin: one that moves may have passed over a ray
//! that it should have thrown back, so it is remembered where plates were in the step before.

use super::course::Pose;
use super::shape::{Line, Struck};
use super::wall::Walls;
use crate::math::Vec3;

/// Part of the largest coordinate by which a point may be behind a face and still count as on it.
const ON_FACE: f64 = 1e-12;

/// The walls of a run where they stand while rays fly.
#[derive(Clone, Debug)]
pub struct Mirrors {
    walls: Walls,
    poses: Vec<Pose>,
    /// Where they stood when rays flew last.
    before: Vec<Pose>,
}

/// A ray comes upon a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtWall {
    /// Distance [m] along the ray.
    pub at: f64,
    /// Number of the wall.
    pub wall: u32,
    /// Number of the face, counted through all walls.
    pub face: u32,
    /// Number of the wall's material.
    pub material: u32,
    /// Unit vector away from the wall.
    pub normal: Vec3,
}

/// Where a ray is, and what of it is known.
#[derive(Clone, Copy, Debug)]
pub struct RayAtWalls {
    /// The ray from where it is now.
    pub line: Line,
    /// Number of the face that it left last.
    pub left: Option<u32>,
    /// Whether it came here while walls were moving, rather than by a bounce off what stands still.
    pub was_here: bool,
}

impl Mirrors {
    /// Walls at time zero.
    pub fn new(walls: Walls) -> Self {
        let mut mirrors = Self { walls, poses: Vec::new(), before: Vec::new() };
        mirrors.stand([0.0; 2]);
        mirrors
    }

    /// Puts the walls where they are at a time [s]; the first of the two times is when rays flew last.
    pub fn stand(&mut self, times: [f64; 2]) {
        let Self { walls, poses, before } = self;
        for (poses, time) in [before, poses].into_iter().zip(times) {
            poses.clear();
            poses.extend((0..walls.len()).map(|wall| walls.pose(wall, time)));
        }
    }

    /// How many walls there are.
    pub fn len(&self) -> usize {
        self.walls.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.walls.is_empty()
    }

    /// The face that a ray comes upon first; of several at the same distance that with the lowest number.
    pub fn first(&self, ray: &RayAtWalls) -> Option<AtWall> {
        let mut first: Option<AtWall> = None;
        for (number, &[wall, face]) in (0..).zip(&self.walls.faces) {
            let body = &self.walls.bodies[wall as usize];
            if ray.left == Some(number) && !body.shape.curves_around(face) {
                continue;
            }
            let struck = self.struck([wall, face], ray);
            if let Some(Struck { at, normal }) =
                struck.filter(|met| first.is_none_or(|first| met.at < first.at))
            {
                first = Some(AtWall { at, wall, face: number, material: body.material, normal });
            }
        }
        first
    }

    fn struck(&self, [wall, face]: [u32; 2], ray: &RayAtWalls) -> Option<Struck> {
        let struck = self.upon([wall, face], &ray.line);
        if struck.is_none() && ray.was_here { self.swept([wall, face], ray) } else { struck }
    }

    /// Where a line first comes upon a face where that is now.
    fn upon(&self, [wall, face]: [u32; 2], line: &Line) -> Option<Struck> {
        let (shape, pose) = (&self.walls.bodies[wall as usize].shape, &self.poses[wall as usize]);
        let seen = Line {
            origin: pose.as_at_start(line.origin),
            direction: pose.direction_as_at_start(line.direction),
            from: line.from,
        };
        let struck = shape.struck(face, &seen)?;
        Some(Struck { normal: pose.direction(struck.normal), ..struck })
    }

    /// Where a plate has passed over a ray that flies toward where it came from: there the ray is thrown back now.
    fn swept(&self, [wall, face]: [u32; 2], ray: &RayAtWalls) -> Option<Struck> {
        let shape = &self.walls.bodies[wall as usize].shape;
        let here = ray.line.at(ray.line.from);
        let side = |poses: &[Pose]| shape.side(poses[wall as usize].as_at_start(here));
        if side(&self.poses)? * side(&self.before)? >= 0.0 {
            return None;
        }
        // Its line comes upon the plate behind it, and so it should have been thrown back there.
        let earlier = Line { origin: here, direction: ray.line.direction, from: f64::NEG_INFINITY };
        let struck = self.upon([wall, face], &earlier)?;
        (struck.at <= 0.0).then_some(Struck { at: ray.line.from, ..struck })
    }

    /// The wall that a point [m] lies in, that with the lowest number if there are several; a point on a face, to twelve digits, is
    /// outside.
    pub fn holding(&self, point: Vec3) -> Option<u32> {
        let most = -ON_FACE * point.norm();
        let behind = |&&[wall, face]: &&[u32; 2]| {
            self.walls.nearest([wall, face], &self.poses[wall as usize], point).gap < most
        };
        self.walls.faces.iter().find(behind).map(|[wall, _]| *wall)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::units::Quantity;
    use crate::walls::{Constant, Motion, Opening, Plane, Shape, Wall};

    /// A plate with an opening of radius 0.1 m about the origin that moves along z at 1 m/s.
    fn plate() -> Mirrors {
        let opening = Some(Opening { center: [Quantity(0.0); 3], radius: Quantity(0.1) });
        let shape = Shape::Plane(Plane { point: [Quantity(0.0); 3], normal: [0.0, 0.0, 1.0], opening });
        let velocity = [0.0, 0.0, 1.0].map(Quantity);
        let motion =
            Motion::Constant(Constant { velocity, angular_velocity: [Quantity(0.0); 3], about: None });
        let (name, material, temperature) = ("plate".to_owned(), "steel".to_owned(), Quantity(300.0));
        let wall = Wall { name, shape, material, temperature, motion };
        Mirrors::new(Walls::new(&[wall], &BTreeMap::new(), 1.0))
    }

    fn down(x: f64, was_here: bool, left: Option<u32>) -> RayAtWalls {
        let line = Line { origin: Vec3::new(x, 0.0, 1.02), direction: -Vec3::AXES[2], from: 0.5 };
        RayAtWalls { line, left, was_here }
    }

    /// A ray at z = 0.52 that flies down, with the plate at z = 0.5 first and then at 0.53: it passed over the ray, which is thrown
    /// back where it is, but not in the opening, not if it has just bounced there, and not if it left the plate.
    #[test]
    fn a_plate_that_passes_over_a_ray_throws_it_back() {
        let mut plate = plate();
        plate.stand([0.5, 0.5]);
        assert_near!(plate.first(&down(0.2, true, None)).unwrap().at, 0.52, 1e-15, "m: ahead");
        plate.stand([0.5, 0.53]);
        let met = plate.first(&down(0.2, true, None)).unwrap();
        assert_eq!((met.at, met.normal), (0.5, Vec3::AXES[2]), "m, and the side that it came from");
        assert_none!(plate.first(&down(0.05, true, None)));
        assert_none!(plate.first(&down(0.2, false, None)));
        assert_none!(plate.first(&down(0.2, true, Some(0))));
        // One that flies away from where the plate was is behind it for good.
        let line = Line { origin: Vec3::new(0.2, 0.0, 0.02), direction: Vec3::AXES[2], from: 0.5 };
        let met = plate.first(&RayAtWalls { line, left: None, was_here: true }).unwrap();
        assert_near!(met.at, 0.51, 1e-15, "m: it comes upon it from below");
    }
}
