//! The flow of a medium whose velocity is given by formulas: its acceleration and its vorticity where a grain is.
//!
//! Slopes are those of the formulas themselves. Where one has no value (that of sqrt(x) at 0), a central difference stands in.

use super::FieldVector;
use super::expression::evaluate;
use crate::math::Vec3;

/// Velocity of a medium [m/s] as the scenario gives it.
pub type FlowField = FieldVector<0, 1, -1, 0, 0>;

/// Part of a length or of the run over which differences are taken where a slope has no value.
const DIFFERENCE: f64 = 1e-6;

/// What a grain feels of the flow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlowAt {
    /// u [m/s].
    pub velocity: Vec3,
    /// Du/Dt = ∂u/∂t + (u·∇) u [m/s²].
    pub acceleration: Vec3,
    /// ∇ × u [rad/s].
    pub vorticity: Vec3,
    /// Size of the gradient of u [1/s], by which a grain that is carried along meets other velocities.
    pub gradient: f64,
}

/// A flow with its derivatives.
#[derive(Clone, Debug)]
pub struct Flow {
    field: FlowField,
    /// Whether it is uniform and steady.
    is_constant: bool,
    /// Lengths of differences along x, y, z [m] and t [s].
    differences: [f64; 4],
}

impl Flow {
    /// The flow of a field for grains of this radius [m] in a run of this length [s].
    pub fn new(field: &FlowField, radius: f64, end: f64) -> Self {
        let length = radius * DIFFERENCE.sqrt();
        Self {
            field: field.clone(),
            is_constant: field.iter().all(|component| component.constant().is_some()),
            differences: [length, length, length, end * DIFFERENCE],
        }
    }

    /// u [m/s] at a point [m] and time [s].
    #[inline]
    pub fn velocity_at(&self, position: Vec3, time: f64) -> Vec3 {
        evaluate(&self.field, position, time)
    }

    /// The flow at a point [m] and time [s].
    #[inline]
    pub fn at(&self, position: Vec3, time: f64) -> FlowAt {
        let velocity = evaluate(&self.field, position, time);
        if self.is_constant {
            return FlowAt { velocity, ..FlowAt::default() };
        }
        let slopes = self.field.each_ref().map(|component| component.slopes_at(position, time));
        let along = |axis: usize| {
            let of = |component: usize| {
                let slope = slopes[component][axis];
                if slope.is_finite() { slope } else { self.difference(component, axis, position, time) }
            };
            Vec3::new(of(0), of(1), of(2))
        };
        let [x, y, z, t] = [0, 1, 2, 3].map(along);
        let gradient = (x.norm_squared() + y.norm_squared() + z.norm_squared()).sqrt();
        FlowAt {
            velocity,
            acceleration: t + x * velocity.x + y * velocity.y + z * velocity.z,
            vorticity: Vec3::new(y.z - z.y, z.x - x.z, x.y - y.x),
            gradient,
        }
    }

    fn difference(&self, component: usize, axis: usize, position: Vec3, time: f64) -> f64 {
        let step = self.differences[axis];
        let value = |sign: f64| match axis {
            3 => self.field[component].at(position, time + sign * step),
            _ => self.field[component].at(position + Vec3::AXES[axis] * (sign * step), time),
        };
        (value(1.0) - value(-1.0)) / (2.0 * step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::Expression;

    fn flow(text: [&str; 3]) -> Flow {
        Flow::new(&text.map(|text| Expression::new(text).unwrap()), 1e-3, 1.0)
    }

    /// Solid rotation about z: Du/Dt = -Ω² r, ∇ × u = 2 Ω.
    #[test]
    fn a_turning_liquid_accelerates_inwards() {
        let found = flow(["-3*y", "3*x", "0 m/s"]).at(Vec3::new(0.25, -0.125, 5.0), 0.0);
        assert_eq!(found.velocity, Vec3::new(0.375, 0.75, 0.0));
        assert!((found.acceleration - Vec3::new(-2.25, 1.125, 0.0)).norm() < 1e-14, "{found:?}");
        assert_eq!(found.vorticity, Vec3::new(0.0, 0.0, 6.0));
        assert_near!(found.gradient, 18.0_f64.sqrt(), 1e-14);
    }

    /// By hand: u = (sin(5 t) x², 0, z/t), signs of negative places included.
    #[test]
    fn formulas_are_differentiated() {
        let (at, time) = (Vec3::new(-0.4, 0.0, 0.3), 0.7);
        let found = flow(["sin(5*t)*x^2", "0 m/s", "z/t"]).at(at, time);
        let (s, c) = (3.5_f64.sin(), 3.5_f64.cos());
        let by_hand = Vec3::new(5.0 * c * 0.16 + 2.0 * s * s * -0.064, 0.0, 0.3 / 0.49 * (1.0 - 1.0));
        assert!((found.acceleration - by_hand).norm() < 1e-14, "{found:?} {by_hand:?}");
        assert_eq!(found.vorticity, Vec3::ZERO);
    }

    /// Away from its kinks a formula with kinks is as any other.
    #[test]
    fn formulas_with_kinks_have_slopes() {
        let found = flow(["abs(y)", "floor(t) + 2*t", "0 m/s"]).at(Vec3::new(0.0, -0.5, 0.0), 0.5);
        assert_eq!(found.vorticity.z, 1.0);
        assert_eq!(found.acceleration, Vec3::new(-1.0, 2.0, 0.0));
    }

    /// The slope of the cube root has no value at 0: the difference over h = 1e-6 m is h^(-2/3).
    #[test]
    fn where_a_slope_has_no_value_a_difference_does() {
        let found = flow(["cbrt(y)", "0 m/s", "0 m/s"]).at(Vec3::ZERO, 0.5);
        assert_close!(found.vorticity.z, -1e4, 1e-9, "in rad/s");
    }

    #[test]
    fn a_uniform_steady_flow_neither_accelerates_nor_turns() {
        let found = flow(["1 m/s", "2 m/s", "0 m/s"]).at(Vec3::new(1.0, 2.0, 3.0), 4.0);
        assert_eq!(found, FlowAt { velocity: Vec3::new(1.0, 2.0, 0.0), ..FlowAt::default() });
    }
}
