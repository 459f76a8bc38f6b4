//! A straight circular cylinder.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::surface::{
    ASKEW, Line, Near, Side, Struck, Surface, Triangle, Within, circle, direction, fan, radial, strip,
    turned_over, upon_hollow, upon_plane,
};
use crate::law::Faults;
use crate::math::Vec3;
use crate::units::{Length, Triple, vector};

/// A straight circular cylinder, without an end or with flat ends. From inside a grain touches its round face and each end by itself;
/// from outside it touches the one nearest point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// A point of its axis: the center of the first end, where it has ends.
    pub point: Triple<Length>,
    /// Direction of its axis, from the first end to the second.
    pub axis: [f64; 3],
    /// Its radius.
    pub radius: Length,
    /// Its length along the axis, between two flat ends; without an end if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<Length>,
    /// Where grains are.
    #[serde(default)]
    pub side: Side,
}

impl Cylinder {
    fn axis(&self) -> Vec3 {
        Vec3::from(self.axis).normalized()
    }

    /// The nearest point of a solid cylinder.
    fn nearest_outside(&self, point: Vec3) -> Near {
        let axis = self.axis();
        let offset = point - vector(self.point);
        let along = offset.dot(axis);
        let (outward, distance) = radial(offset.rejected_from(axis), axis);
        let beside = distance - self.radius.si();
        let Some(length) = self.length.map(Length::si) else {
            return Near { normal: -outward, gap: beside };
        };
        let (beyond, end) = if along < 0.5 * length { (-along, -axis) } else { (along - length, axis) };
        if beside <= 0.0 && beyond <= 0.0 {
            let is_beside = beside > beyond;
            return if is_beside {
                Near { normal: -outward, gap: beside }
            } else {
                Near { normal: -end, gap: beyond }
            };
        }
        let away = outward * beside.max(0.0) + end * beyond.max(0.0);
        let gap = away.norm();
        Near { normal: away * (-1.0 / gap), gap }
    }
}

impl Surface for Cylinder {
    fn faults(&self, faults: &mut Faults) {
        direction(faults, "axis", self.axis, "[0, 0, 1]");
        faults.positive("radius", self.radius);
        if let Some(length) = self.length {
            faults.positive("length", length);
        }
    }

    fn faces(&self) -> u32 {
        match (self.side, self.length) {
            (Side::Inside, Some(_)) => 3,
            _ => 1,
        }
    }

    #[inline]
    fn nearest(&self, face: u32, point: Vec3) -> Near {
        if self.side == Side::Outside {
            return self.nearest_outside(point);
        }
        let axis = self.axis();
        let offset = point - vector(self.point);
        let along = offset.dot(axis);
        match face {
            0 => {
                let (outward, distance) = radial(offset.rejected_from(axis), axis);
                Near { normal: outward, gap: self.radius.si() - distance }
            }
            1 => Near { normal: -axis, gap: along },
            _ => Near { normal: axis, gap: self.length.map_or(f64::INFINITY, Length::si) - along },
        }
    }

    fn struck(&self, face: u32, line: &Line) -> Option<Struck> {
        let (axis, offset) = (self.axis(), line.origin - vector(self.point));
        let across = [offset, line.direction].map(|vector| vector.rejected_from(axis));
        if self.side == Side::Inside {
            if face == 0 {
                return upon_hollow(line, across[0], across[1], self.radius.si());
            }
            let near = self.nearest(face, line.origin);
            return upon_plane(line, near.gap, -near.normal);
        }
        let mut within = Within::round(across[0], across[1], self.radius.si())?;
        if let Some(length) = self.length {
            within = within.and(Within::slab(line, axis, [0.0, length.si()], offset.dot(axis))?);
        }
        within.struck(line, |place| -self.nearest(0, place).normal)
    }

    fn curves_around(&self, face: u32) -> bool {
        self.side == Side::Inside && face == 0
    }

    fn middle(&self) -> Vec3 {
        vector(self.point) + self.axis() * (0.5 * self.length.map_or(0.0, Length::si))
    }

    fn curvature_radius(&self) -> f64 {
        self.radius.si()
    }

    fn goes_on_along(&self, direction: Vec3) -> bool {
        self.length.is_none() && self.axis().cross(direction).norm() <= ASKEW
    }

    fn endless_part(&self, offset: Vec3) -> Option<f64> {
        self.length.is_none().then(|| offset.dot(self.axis()).abs())
    }

    fn triangles(&self, about: Vec3, within: f64) -> Vec<Triangle> {
        let axis = self.axis();
        let first = vector(self.point);
        let ends = if let Some(length) = self.length.map(Length::si) {
            [first, first + axis * length]
        } else {
            let foot = first + axis * (about - first).dot(axis);
            [foot - axis * within, foot + axis * within]
        };
        let [low, high] = ends.map(|end| circle(end, self.radius.si(), axis.frame()));
        let mut seen_from_outside = strip(&low, &high);
        if self.length.is_some() {
            seen_from_outside.extend(fan(ends[1], &high));
            seen_from_outside.extend(turned_over(fan(ends[0], &low)));
        }
        match self.side {
            Side::Inside => turned_over(seen_from_outside),
            Side::Outside => seen_from_outside,
        }
    }
}
