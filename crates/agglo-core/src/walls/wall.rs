//! Walls that grains touch: planes, boxes, cylinders and spheres, at rest or in motion.
//!
//! # Equation
//! ```text
//! δ = R - d,   n = (r_w - r)/d,   R* = R,   m* = m                                         W1
//! v_c = V + Ω × (r_w - c_w) - v - w × d n,   F = F_t - F_n n,   M = d n × F_t             W2
//! P_w = F · (V + Ω × (r_w - c_w))                                                         W3
//! ```
//! A wall acts on a grain as another grain of the same laws would whose radius and mass are beyond all bounds: on the nearest
//! point r_w of the wall, at the distance d from the grain's center r. What the laws make of it is what they make of two grains, with
//! the materials of both and what these share. Strains, which would vanish with the sum of the radii, are taken over the radius of
//! the grain, ℰ = δ/R, and the area of contact is the disc that the wall cuts out of it, π δ (2 R - δ): as if the grain met its mirror
//! image. P_w is what a moving wall puts in; the ledger books it as `work_walls_J`.
//!
//! Rays of sound are reflected at walls as at grains ([`fresnel`](crate::acoustics::fresnel)), with the wall's material; the law of the
//! rays' force says how they press on them.
//!
//! # Source
//! The limit of unequal spheres: K. L. Johnson, *Contact Mechanics* (1985), section 4.2. Nearest points as in C. Ericson, *Real-Time
//! Collision Detection* (2005), chapter 5.
//!
//! # Symbols
//! | symbol | name in code       | unit  | meaning                                                        |
//! |--------|--------------------|-------|----------------------------------------------------------------|
//! | d      | `gap`              | m     | distance from the grain's center to the wall, below 0 behind it |
//! | n      | `normal`           | -     | unit vector from the center to the wall                        |
//! | δ      | `overlap`          | m     | > 0 in contact                                                 |
//! | r_w    | `place`            | m     | nearest point of the wall                                      |
//! | R*, m* | `effective_radius`, `effective_mass` | m, kg | those of the grain                           |
//! | V, Ω   | `velocity`, `angular_velocity` | m/s, rad/s | of the wall                                     |
//! | c_w    | `about`            | m     | the point that the wall turns about                            |
//! | v_c    |                    | m/s   | of the wall's surface relative to the grain's                  |
//! | P_w    | `work_J`           | W     | power that the wall puts in                                    |
//!
//! # Critical step
//! That of the laws of contact with R* = R and m* = m, at the largest overlap that `limits.strain` allows, with each wall's material; an
//! oscillation or a rotation of a wall counts with its own frequency.
//!
//! # Valid when
//! A curved wall counts as flat in the contact: its radius of curvature is much larger than the grain's. A face of a box or a cylinder that
//! grains are inside of has a contact of its own, and so up to three press on a grain in a corner. Bonds join grains, not grains and walls;
//! `strain_bond` acts at walls as it does in any contact. A wall's mass is without bounds: it moves as it is told, whatever presses on it.
//! Where a moving wall starts or stops at once, so does its surface. A velocity that is a formula and changes faster than the laws act is
//! not foreseen by the automatic step.
//!
//! # Compared with others
//! LAMMPS' and LIGGGHTS' granular walls are the same limit, R* = R and m* = m; there the overlap over a sum of radii has no meaning at
//! a wall. A plane without an opening is solid behind, so that no grain can be lost through it in a step that is too long.
//!
//! # In a scenario
//! ```toml
//! [[walls]]
//! name = "floor"
//! material = "grain"
//! shape.plane = { point = ["0 m", "0 m", "-1 m"], normal = [0.0, 0.0, 1.0] }
//! motion.oscillating = { amplitude = ["0 m", "0 m", "0.1 um"], frequency = "50 Hz" }
//!
//! [materials.grain]
//! youngs_modulus = "70 GPa"
//! poisson_ratio = 0.22
//!
//! [contact.normal.hertz]
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::math::Vec3;
//! use agglo::units::Quantity;
//! use agglo::walls::{Plane, Shape};
//! let floor = Shape::Plane(Plane { point: [Quantity(0.0); 3], normal: [0.0, 0.0, 2.0], opening: None });
//! let near = floor.nearest(0, Vec3::new(3.0, 4.0, 0.25));
//! assert_eq!((near.gap, near.normal), (0.25, Vec3::new(0.0, 0.0, -1.0)));
//! ```

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::course::{Course, Pose};
use super::motion::Motion;
use super::shape::{Near, Shape, Triangle};
use crate::domain::Space;
use crate::domain::extent_of_places;
use crate::law::Faults;
use crate::math::{Pace, Vec3};
use crate::particles::{Material, Particles};
use crate::units::{Quantity, Temperature, vector};

/// A wall, as a scenario has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wall {
    /// What it is called in tables and messages; each wall has a name of its own.
    pub name: String,
    /// Its shape at time zero.
    pub shape: Shape,
    /// Name of its material.
    pub material: String,
    /// Its temperature, which softens its contact stiffness.
    #[serde(default = "room_temperature")]
    pub temperature: Temperature,
    /// How it moves; not if left out.
    #[serde(default)]
    pub motion: Motion,
}

fn room_temperature() -> Temperature {
    Quantity(300.0)
}

impl Wall {
    /// What is wrong with it by itself in a run of a length [s]; keys are relative to its table.
    pub fn faults(&self, faults: &mut Faults, end: f64) {
        let is_plain = |letter: char| letter.is_ascii_alphanumeric() || letter == '_' || letter == '-';
        if self.name.is_empty() || !self.name.chars().all(is_plain) {
            let message = format!("\"{}\" is no name; letters, digits, _ and - are wanted", self.name);
            faults.fail("name", message);
        }
        faults.positive("temperature", self.temperature);
        self.shape.faults(faults);
        self.motion.faults(faults, end);
    }

    /// An axis on which space repeats itself while the wall does not: it must be the same all along it, and turn about it alone.
    pub fn cut_by(&self, space: &Space) -> Option<usize> {
        let spin = match &self.motion {
            Motion::Constant(law) => vector(law.angular_velocity),
            _ => Vec3::ZERO,
        };
        let goes_on = |axis: usize| {
            let along = Vec3::AXES[axis];
            self.shape.goes_on_along(along) && spin.cross(along) == Vec3::ZERO
        };
        (0..3).find(|axis| space.repeats_along(*axis) && !goes_on(*axis))
    }
}

/// A wall, ready for the laws of contact.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub name: String,
    pub shape: Shape,
    pub course: Course,
    /// Number of its material.
    pub material: u32,
    /// Its contact stiffness [Pa], softened by heat.
    pub stiffness: f64,
}

/// How much of a wall without an end is shown, over what is beside grains.
const SHOWN: f64 = 1.25;

/// The walls of a run: what every evaluation reads and none changes.
#[derive(Clone, Debug, Default)]
pub struct Walls {
    pub(super) bodies: Vec<Body>,
    /// Every face of every wall: numbers of the wall, and of the face in it.
    pub(super) faces: Vec<[u32; 2]>,
}

impl Walls {
    /// Walls in a run of a length [s]; materials are numbered in the order of the map.
    pub fn new(walls: &[Wall], materials: &BTreeMap<String, Material>, end: f64) -> Self {
        let body = |wall: &Wall| {
            let number = materials.keys().position(|name| *name == wall.material).unwrap_or(0);
            let temperature = wall.temperature.si();
            Body {
                name: wall.name.clone(),
                shape: wall.shape.clone(),
                course: Course::new(&wall.motion, wall.shape.middle(), end),
                material: number as u32,
                stiffness: materials.get(&wall.material).map_or(0.0, |of| of.stiffness_at(temperature)),
            }
        };
        let faces = walls.iter().zip(0..).flat_map(|(wall, number)| {
            let own = 0..wall.shape.faces();
            own.map(move |face| [number, face])
        });
        Self { bodies: walls.iter().map(body).collect(), faces: faces.collect() }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// Name of one.
    pub fn name(&self, wall: usize) -> &str {
        &self.bodies[wall].name
    }

    /// Numbers of their materials.
    pub fn materials(&self) -> impl Iterator<Item = u32> + '_ {
        self.bodies.iter().map(|body| body.material)
    }

    /// How many faces one has; none if there is no such wall.
    pub fn faces(&self, wall: u32) -> u32 {
        self.bodies.get(wall as usize).map_or(0, |body| body.shape.faces())
    }

    /// Number of the material and contact stiffness [Pa] of each, without repetition.
    pub fn kinds(&self) -> Vec<(u32, f64)> {
        let mut kinds: Vec<(u32, f64)> = Vec::new();
        for body in &self.bodies {
            let kind = (body.material, body.stiffness);
            if !kinds.contains(&kind) {
                kinds.push(kind);
            }
        }
        kinds
    }

    /// Where one is at a time [s].
    pub fn pose(&self, wall: usize, time: f64) -> Pose {
        self.bodies[wall].course.at(time)
    }

    /// How fast the fastest of them changes its motion.
    pub fn pace(&self) -> Pace {
        self.bodies.iter().map(|body| body.course.pace()).fold(Pace::NONE, Pace::max)
    }

    /// The point of a wall's face that is nearest to a point [m], the wall being in this pose.
    #[inline]
    pub(super) fn nearest(&self, [wall, face]: [u32; 2], pose: &Pose, point: Vec3) -> Near {
        let near = self.bodies[wall as usize].shape.nearest(face, pose.as_at_start(point));
        Near { normal: pose.direction(near.normal), ..near }
    }

    /// Triangles [m] that show a wall at a time [s]: all of it, or where it has no end what is beside grains and a little more.
    pub fn triangles(&self, wall: usize, time: f64, grains: &Particles) -> Vec<Triangle> {
        let (pose, shape) = (self.pose(wall, time), &self.bodies[wall].shape);
        let (lower, upper) = extent_of_places(grains.position.iter().copied()).unwrap_or_default();
        let middle = pose.as_at_start((lower + upper) * 0.5);
        let reach = |(place, radius): (&Vec3, &f64)| {
            shape.endless_part(pose.as_at_start(*place) - middle).map_or(0.0, |part| part + radius)
        };
        let farthest = grains.position.iter().zip(&grains.radius).map(reach).fold(0.0, f64::max);
        let at_start = shape.triangles(middle, SHOWN * farthest);
        at_start.into_iter().map(|corners| corners.map(|corner| pose.point(corner))).collect()
    }

    /// A grain that is deeper in a wall at time zero than a part of its radius: its place in the list, the wall's number and the overlap
    /// [m]. The deepest over its radius, if there are several.
    pub fn holding(&self, positions: &[Vec3], radii: &[f64], part: f64) -> Option<(usize, usize, f64)> {
        let poses: Vec<Pose> = (0..self.len()).map(|wall| self.pose(wall, 0.0)).collect();
        let mut deepest: Option<(usize, usize, f64)> = None;
        for (grain, (&position, &radius)) in positions.iter().zip(radii).enumerate() {
            for &face in &self.faces {
                let wall = face[0] as usize;
                let overlap = radius - self.nearest(face, &poses[wall], position).gap;
                let least = deepest.map_or(part, |(grain, _, overlap)| overlap / radii[grain]);
                if overlap > least * radius {
                    deepest = Some((grain, wall, overlap));
                }
            }
        }
        deepest
    }
}
