//! How forces on single grains answer to velocity, and the velocity for which they are solved.
//!
//! # Equation
//! ```text
//! v' = v0 + Δv + h (-c u + u × b),   u = v' - v_K                                          (R1)
//! (1 + h c) u - h u × b = v0 + Δv - v_K
//! ```
//! Drag, rotation about a magnetic field and resistance to rotation are linear in the velocity, or nearly so. What an
//! iterate v_K gave is corrected by its slope, so that the end of a step is solved for and not guessed: no step is too
//! long for them, and a rotation keeps the speed.
//!
//! # Source
//! The trapezoidal rule; for the rotation J. P. Boris, *Proc. 4th Conf. Num. Sim. Plasmas* (1970), p. 3.
//!
//! # Symbols
//! | symbol | name in code | unit    | meaning |
//! |--------|--------------|---------|---------|
//! | c      | `drag`       | N s/m   | drag over slip |
//! | b      | `turning`    | kg/s    | q B |
//! | g      | `rotational_drag` | N m s   | torque over angular velocity |
//! | h      |              | s/kg    | φ Δt/m |

use crate::ledger::Correction;
use crate::math::Vec3;

/// Slopes of the forces on one grain over its velocity and angular velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Response {
    /// c.
    pub drag: f64,
    /// b.
    pub turning: Vec3,
    /// g.
    pub rotational_drag: f64,
}

impl Response {
    /// The velocity [m/s] and angular velocity [rad/s] at the end of a step, from those that the loads at `guess` alone
    /// give and the h of both.
    #[inline]
    pub fn solved(&self, explicit: (Vec3, Vec3), guess: (Vec3, Vec3), h: (f64, f64)) -> Solved {
        let change = self.solve(explicit.0 - guess.0, h.0);
        let turn = (explicit.1 - guess.1) * (1.0 / (1.0 + h.1 * self.rotational_drag));
        Solved {
            velocity: guess.0 + change,
            angular_velocity: guess.1 + turn,
            drag: change * -self.drag,
            magnetic: change.cross(self.turning),
            torque: turn * -self.rotational_drag,
        }
    }

    /// How much the drag changes over how the motion does [W], -ΔF · Δv - ΔM · Δw, where velocity [m/s] and angular
    /// velocity [rad/s] change by `change` within a step and the flow's velocity by `flow` [m/s].
    #[inline]
    pub fn bend(&self, change: (Vec3, Vec3), flow: Vec3) -> f64 {
        self.drag * (change.0 - flow).dot(change.0) + self.rotational_drag * change.1.norm_squared()
    }

    /// u [m/s] for which (1 + h c) u - h u × b is `rest` [m/s].
    #[inline]
    fn solve(&self, rest: Vec3, h: f64) -> Vec3 {
        let (straight, turn) = (1.0 + h * self.drag, self.turning * h);
        let square = straight * straight;
        let along = rest * square + rest.cross(turn) * straight + turn * turn.dot(rest);
        along * (1.0 / (straight * (square + turn.norm_squared())))
    }
}

/// A velocity and an angular velocity that were solved for, and what their change makes of the loads.
#[derive(Clone, Copy, Debug)]
pub struct Solved {
    /// Velocity [m/s].
    pub velocity: Vec3,
    /// Angular velocity [rad/s].
    pub angular_velocity: Vec3,
    /// Change of the drag [N].
    drag: Vec3,
    /// Change of the magnetic force [N].
    magnetic: Vec3,
    /// Change of the torque [N m].
    torque: Vec3,
}

impl Solved {
    /// Brings force [N] and torque [N m] of the grain at this position [m] along.
    #[inline]
    pub fn correct(&self, loads: &mut (Vec3, Vec3), position: Vec3, ledger: &mut Correction) {
        loads.0 += self.drag + self.magnetic;
        loads.1 += self.torque;
        ledger.supplies.note_correction(position, self.drag, self.magnetic, self.torque);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_solves() {
        let response = Response { drag: 3.0, turning: Vec3::new(1.0, -2.0, 0.5), rotational_drag: 4.0 };
        let (explicit, guess) = (Vec3::new(0.3, 0.7, -0.2), Vec3::new(0.1, -0.5, 0.4));
        let solved = response.solved((explicit, explicit), (guess, guess), (0.8, 0.6));
        let back = explicit + (solved.drag + solved.magnetic) * 0.8;
        assert!((back - solved.velocity).norm() < 1e-15, "{back:?}");
        assert_near_vector!(explicit + solved.torque * 0.6, solved.angular_velocity, 1e-15);
    }

    /// A rotation keeps the speed, whatever the step.
    #[test]
    fn turning_keeps_the_speed() {
        let response = Response { turning: Vec3::new(0.0, 3.0, -4.0), ..Response::default() };
        let velocity = Vec3::new(1.0, 0.2, -0.7);
        for h in [1e-3, 1.0, 100.0] {
            let explicit = velocity + velocity.cross(response.turning) * (2.0 * h);
            let after = response.solved((explicit, Vec3::ZERO), (velocity, Vec3::ZERO), (h, h)).velocity;
            assert!((after.norm() / velocity.norm() - 1.0).abs() < 1e-14, "{h}");
        }
    }

    /// c (Δv - Δu) · Δv + g Δw².
    #[test]
    fn bend_by_hand() {
        let response = Response { drag: 3.0, turning: Vec3::AXES[0], rotational_drag: 4.0 };
        let (velocity, angular_velocity) = (Vec3::new(2.0, -1.0, 0.0), Vec3::new(0.0, 0.5, 1.0));
        // (2 - 0.5) 2 + (-1 - 3)(-1) = 7, and 0.25 + 1.
        assert_close!(
            response.bend((velocity, angular_velocity), Vec3::new(0.5, 3.0, 7.0)),
            21.0 + 5.0,
            1e-15,
            "in W"
        );
    }
}
