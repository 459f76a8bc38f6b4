//! A sphere.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::surface::{
    Line, Near, PIECES, Side, Struck, Surface, Triangle, Within, circle, strip, turned_over, upon_hollow,
};
use crate::law::Faults;
use crate::math::Vec3;
use crate::units::{Length, Triple, vector};

/// A sphere around grains, or among them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    /// Its center.
    pub center: Triple<Length>,
    /// Its radius.
    pub radius: Length,
    /// Where grains are.
    #[serde(default)]
    pub side: Side,
}

impl Surface for Sphere {
    fn faults(&self, faults: &mut Faults) {
        faults.positive("radius", self.radius);
    }

    fn faces(&self) -> u32 {
        1
    }

    #[inline]
    fn nearest(&self, _: u32, point: Vec3) -> Near {
        let offset = point - vector(self.center);
        let distance = offset.norm();
        let outward = if distance > 0.0 { offset / distance } else { Vec3::AXES[0] };
        match self.side {
            Side::Inside => Near { normal: outward, gap: self.radius.si() - distance },
            Side::Outside => Near { normal: -outward, gap: distance - self.radius.si() },
        }
    }

    fn struck(&self, _: u32, line: &Line) -> Option<Struck> {
        let (offset, radius) = (line.origin - vector(self.center), self.radius.si());
        match self.side {
            Side::Inside => upon_hollow(line, offset, line.direction, radius),
            Side::Outside => Within::round(offset, line.direction, radius)?
                .struck(line, |place| -self.nearest(0, place).normal),
        }
    }

    fn curves_around(&self, _: u32) -> bool {
        self.side == Side::Inside
    }

    fn middle(&self) -> Vec3 {
        vector(self.center)
    }

    fn curvature_radius(&self) -> f64 {
        self.radius.si()
    }

    fn triangles(&self, _: Vec3, _: f64) -> Vec<Triangle> {
        let [x, y, z] = Vec3::AXES;
        let ring = |number: u32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(number) / f64::from(PIECES)).sin_cos();
            let center = vector(self.center) - z * (cos * self.radius.si());
            circle(center, sin * self.radius.si(), (x, y))
        };
        let rings: Vec<Vec<Vec3>> = (0..=PIECES / 2).map(ring).collect();
        let seen_from_outside = rings.windows(2).flat_map(|rings| strip(&rings[0], &rings[1])).collect();
        match self.side {
            Side::Inside => turned_over(seen_from_outside),
            Side::Outside => seen_from_outside,
        }
    }
}
