//! A plane, or with an opening a thin plate.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::surface::{
    ASKEW, Line, Near, Struck, Surface, Triangle, circle, direction, fan, strip, toward, upon_plane,
};
use crate::law::Faults;
use crate::math::Vec3;
use crate::text::readable;
use crate::units::{Length, Triple, vector};

/// Part of an opening's radius that its center may lie off the plane.
const OFF: f64 = 1e-6;

/// A plane without an end. Without an opening all behind it is solid; with one it is a plate without thickness, which grains touch
/// from either side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// A point of it.
    pub point: Triple<Length>,
    /// Its normal, toward the side where grains are.
    pub normal: [f64; 3],
    /// A hole in it; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub opening: Option<Opening>,
}

/// A circular hole in a plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Opening {
    /// Its center, a point of the plane.
    pub center: Triple<Length>,
    /// Its radius.
    pub radius: Length,
}

impl Plane {
    fn normal(&self) -> Vec3 {
        Vec3::from(self.normal).normalized()
    }

    /// How far a point [m] is before it, on the side of its normal [m]; below 0 beyond it.
    #[inline]
    pub(in crate::walls) fn height(&self, point: Vec3) -> f64 {
        (point - vector(self.point)).dot(self.normal())
    }
}

impl Surface for Plane {
    fn faults(&self, faults: &mut Faults) {
        direction(faults, "normal", self.normal, "[0, 0, 1]");
        let Some(opening) = &self.opening else { return };
        faults.positive("opening.radius", opening.radius);
        let off = (vector(opening.center) - vector(self.point)).dot(self.normal()).abs();
        if off > OFF * opening.radius.si() {
            let message = format!("lies {} off the plane", readable(off, "m"));
            faults.fail_with("opening.center", message, "the center of an opening is a point of its plane");
        }
    }

    fn faces(&self) -> u32 {
        1
    }

    #[inline]
    fn nearest(&self, _: u32, point: Vec3) -> Near {
        let normal = self.normal();
        let height = self.height(point);
        let Some(opening) = &self.opening else { return Near { normal: -normal, gap: height } };
        let (center, radius) = (vector(opening.center), opening.radius.si());
        let aside = (point - center).rejected_from(normal);
        let distance = aside.norm();
        if distance >= radius {
            return toward(normal * -height, -normal);
        }
        let outward = if distance > 0.0 { aside / distance } else { normal.frame().0 };
        toward(outward * (radius - distance) - normal * height, outward)
    }

    #[inline]
    fn struck(&self, _: u32, line: &Line) -> Option<Struck> {
        let (normal, height) = (self.normal(), self.height(line.origin));
        let Some(opening) = &self.opening else { return upon_plane(line, height, normal) };
        let speed = line.direction.dot(normal);
        let at = -height / speed;
        let meets = at >= line.from && at.is_finite();
        let aside = || (line.at(at) - vector(opening.center)).rejected_from(normal).norm();
        (meets && aside() >= opening.radius.si()).then(|| Struck { at, normal: normal * -speed.signum() })
    }

    fn side(&self, point: Vec3) -> Option<f64> {
        self.opening.as_ref().map(|_| self.height(point))
    }

    fn middle(&self) -> Vec3 {
        self.opening.as_ref().map_or(vector(self.point), |opening| vector(opening.center))
    }

    fn goes_on_along(&self, direction: Vec3) -> bool {
        self.opening.is_none() && self.normal().dot(direction).abs() <= ASKEW
    }

    fn endless_part(&self, offset: Vec3) -> Option<f64> {
        Some(offset.rejected_from(self.normal()).norm())
    }

    fn triangles(&self, about: Vec3, within: f64) -> Vec<Triangle> {
        let normal = self.normal();
        let foot = about - normal * (about - vector(self.point)).dot(normal);
        let frame = normal.frame();
        let edge = circle(foot, within, frame);
        match &self.opening {
            None => fan(foot, &edge),
            Some(opening) => {
                let (center, radius) = (vector(opening.center), opening.radius.si());
                let far = within.max(2.0 * radius) + (foot - center).norm();
                strip(&circle(center, far, frame), &circle(center, radius, frame))
            }
        }
    }
}
