//! A vector in space: three numbers, nothing hidden.

use std::ops::{Add, AddAssign, Div, Index, Mul, MulAssign, Neg, Sub, SubAssign};

use serde::{Deserialize, Serialize};

use super::Real;

/// A vector or point in three dimensions; its unit is that of its components.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[repr(C)]
pub struct Vector<F> {
    /// First component.
    pub x: F,
    /// Second component.
    pub y: F,
    /// Third component.
    pub z: F,
}

/// A vector of `f64`.
pub type Vec3 = Vector<f64>;

impl<F> Vector<F> {
    /// Puts three components together.
    #[inline(always)]
    pub const fn new(x: F, y: F, z: F) -> Self {
        Self { x, y, z }
    }
}

impl<F: Real> Vector<F> {
    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> F {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Vector product.
    #[inline(always)]
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// Length.
    #[inline(always)]
    pub fn norm(self) -> F {
        self.norm_squared().sqrt()
    }

    /// Square of the length.
    #[inline(always)]
    pub fn norm_squared(self) -> F {
        self.dot(self)
    }

    /// The part at right angles to the unit vector `axis`.
    #[inline(always)]
    #[must_use]
    pub fn rejected_from(self, axis: Self) -> Self {
        self - axis * self.dot(axis)
    }

    /// `yes` where the mask holds, `no` elsewhere.
    #[inline(always)]
    #[must_use]
    pub fn select(mask: F::Mask, yes: Self, no: Self) -> Self {
        Self::new(F::select(mask, yes.x, no.x), F::select(mask, yes.y, no.y), F::select(mask, yes.z, no.z))
    }
}

impl Vec3 {
    /// The vector of length zero.
    pub const ZERO: Self = Self::new(0.0, 0.0, 0.0);
    /// The unit vectors of the three axes.
    pub const AXES: [Self; 3] =
        [Self::new(1.0, 0.0, 0.0), Self::new(0.0, 1.0, 0.0), Self::new(0.0, 0.0, 1.0)];

    /// The order of points by x, then y, then z; a total order of all bits.
    #[inline]
    pub fn total_cmp(&self, other: &Self) -> std::cmp::Ordering {
        let by_y = || self.y.total_cmp(&other.y);
        let by_z = || self.z.total_cmp(&other.z);
        self.x.total_cmp(&other.x).then_with(by_y).then_with(by_z)
    }

    /// The same direction with length one; zero stays zero.
    #[inline]
    #[must_use]
    pub fn normalized(self) -> Self {
        let norm = self.norm();
        if norm > 0.0 { self / norm } else { Self::ZERO }
    }

    /// Whether all components are finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }

    /// Component-wise smaller value.
    #[inline]
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self::new(self.x.min(other.x), self.y.min(other.y), self.z.min(other.z))
    }

    /// Component-wise larger value.
    #[inline]
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self::new(self.x.max(other.x), self.y.max(other.y), self.z.max(other.z))
    }

    /// Sum of the components' sizes; not finite where one is not.
    #[inline]
    pub fn sum_of_sizes(self) -> f64 {
        self.x.abs() + self.y.abs() + self.z.abs()
    }

    /// Two unit vectors that make a right-handed frame with the unit vector `self`: (e1, e2, self).
    pub fn frame(self) -> (Self, Self) {
        let [a, b, c] = self.to_array().map(f64::abs);
        let helper = if a <= b && a <= c {
            Self::AXES[0]
        } else if b <= c {
            Self::AXES[1]
        } else {
            Self::AXES[2]
        };
        let first = helper.cross(self).normalized();
        (first, self.cross(first))
    }

    /// Turned by `angle` [rad] about the unit vector `axis` (right-hand rule).
    #[must_use]
    pub fn rotated_about(self, axis: Self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        self * cos + axis.cross(self) * sin + axis * (axis.dot(self) * (1.0 - cos))
    }

    /// The components as an array.
    #[inline]
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }
}

impl From<[f64; 3]> for Vec3 {
    #[inline]
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self::new(x, y, z)
    }
}

impl Index<usize> for Vec3 {
    type Output = f64;
    #[inline]
    fn index(&self, axis: usize) -> &f64 {
        match axis {
            0 => &self.x,
            1 => &self.y,
            _ => &self.z,
        }
    }
}

impl<F: Real> Add for Vector<F> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<F: Real> Sub for Vector<F> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<F: Real> Neg for Vector<F> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<F: Real> Mul<F> for Vector<F> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: F) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl Mul<Vec3> for f64 {
    type Output = Vec3;
    #[inline]
    fn mul(self, vector: Vec3) -> Vec3 {
        vector * self
    }
}

impl<F: Real> Div<F> for Vector<F> {
    type Output = Self;
    #[inline(always)]
    fn div(self, divisor: F) -> Self {
        self * (F::of(1.0) / divisor)
    }
}

impl<F: Real> AddAssign for Vector<F> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<F: Real> SubAssign for Vector<F> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<F: Real> MulAssign<F> for Vector<F> {
    #[inline(always)]
    fn mul_assign(&mut self, factor: F) {
        *self = *self * factor;
    }
}

impl std::iter::Sum for Vec3 {
    fn sum<I: Iterator<Item = Self>>(vectors: I) -> Self {
        vectors.fold(Self::ZERO, Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_is_right_handed_and_orthonormal() {
        for axis in [Vec3::new(0.0, 0.0, 1.0), Vec3::new(1.0, -2.0, 0.5).normalized(), -Vec3::AXES[0]] {
            let (e1, e2) = axis.frame();
            assert_near!(e1.norm(), 1.0, 1e-15);
            assert_near!(e2.norm(), 1.0, 1e-15);
            assert_near_vector!(e1.cross(e2), axis, 1e-15);
        }
    }

    #[test]
    fn rotation_by_a_right_angle() {
        let turned = Vec3::AXES[0].rotated_about(Vec3::AXES[2], std::f64::consts::FRAC_PI_2);
        assert_near_vector!(turned, Vec3::AXES[1], 1e-15);
    }

    #[test]
    fn one_component_that_is_not_finite_is_enough() {
        assert_true!(Vec3::new(1.0, -2.0, 3.0).is_finite(), "three numbers");
        for axis in 0..3 {
            for value in [f64::NAN, f64::INFINITY] {
                let mut components = [1.0, -2.0, 3.0];
                components[axis] = value;
                assert_false!(Vec3::from(components).is_finite(), "{components:?}");
            }
        }
    }
}
