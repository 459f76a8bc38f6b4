//! Where a moving wall is at a time, and how fast its points are.

use super::motion::{Constant, Motion, OfTime, Oscillating, Traveling};
use crate::math::quadrature::integral;
use crate::math::{Pace, Vec3};
use crate::units::vector;

/// Pieces of a run over which a velocity that is a formula is integrated one by one.
const PIECES: usize = 1024;

/// A motion, ready to be asked where the wall is: a function of time alone.
#[derive(Clone, Debug)]
pub struct Course {
    motion: Motion,
    /// Where the point that the wall turns about is at time zero [m].
    about: Vec3,
    /// Ways [m] at the ends of the pieces of the run, where a formula has to be integrated, and the length of a piece [s].
    ways: Vec<Vec3>,
    piece: f64,
}

/// A wall at a moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// The point that it turns about, at time zero and now [m].
    about: [Vec3; 2],
    /// Unit vector along which it has turned since time zero, and the angle's sine and cosine; nothing where it does not turn.
    turn: Option<(Vec3, [f64; 2])>,
    /// Velocity of that point [m/s].
    velocity: Vec3,
    /// Angular velocity [rad/s].
    spin: Vec3,
}

impl Course {
    /// A motion in a run of a length [s], about a point [m] if no other is given.
    pub fn new(motion: &Motion, middle: Vec3, end: f64) -> Self {
        let about = match motion {
            Motion::Constant(Constant { about: Some(about), .. }) => vector(*about),
            _ => middle,
        };
        let piece = end / PIECES as f64;
        let ways = if let Motion::Formula(law) = motion { ways(law, piece) } else { Vec::new() };
        Self { motion: motion.clone(), about, ways, piece }
    }

    /// The wall at a time [s].
    pub fn at(&self, time: f64) -> Pose {
        let (way, velocity) = self.way(time);
        let pose = Pose { about: [self.about, self.about + way], velocity, ..Pose::default() };
        let Motion::Constant(law) = &self.motion else { return pose };
        let spin = vector(law.angular_velocity);
        let rate = spin.norm();
        if rate == 0.0 {
            return pose;
        }
        let (sin, cos) = (rate * time).sin_cos();
        Pose { turn: Some((spin / rate, [sin, cos])), spin, ..pose }
    }

    /// Way [m] since time zero of the point that it turns about, and its velocity [m/s].
    fn way(&self, time: f64) -> (Vec3, Vec3) {
        match &self.motion {
            Motion::Fixed => (Vec3::ZERO, Vec3::ZERO),
            Motion::Constant(law) => (vector(law.velocity) * time, vector(law.velocity)),
            Motion::Oscillating(law) => {
                let (rate, amplitude) = (turning_rate(law), vector(law.amplitude));
                let (sin, cos) = (rate * time + law.phase).sin_cos();
                (amplitude * (sin - law.phase.sin()), amplitude * (rate * cos))
            }
            Motion::Formula(law) => {
                let whole = ((time / self.piece) as usize).min(PIECES);
                let way = self.ways[whole] + traveled(law, whole as f64 * self.piece, time);
                (way, velocity(law, time))
            }
        }
    }

    /// How fast it changes its motion.
    pub fn pace(&self) -> Pace {
        match &self.motion {
            Motion::Fixed | Motion::Formula(_) => Pace::NONE,
            Motion::Constant(law) => Pace { square: vector(law.angular_velocity).norm_squared(), rate: 0.0 },
            Motion::Oscillating(law) => Pace { square: turning_rate(law).powi(2), rate: 0.0 },
        }
    }
}

/// 2π f [rad/s].
fn turning_rate(law: &Oscillating) -> f64 {
    std::f64::consts::TAU * law.frequency.si()
}

fn velocity(law: &Traveling, time: f64) -> Vec3 {
    law.velocity.each_ref().map(|formula| formula.at(|OfTime| time)).into()
}

/// Way [m] from one time [s] to another.
fn traveled(law: &Traveling, from: f64, to: f64) -> Vec3 {
    law.velocity.each_ref().map(|formula| integral(|time| formula.at(|OfTime| time), from, to)).into()
}

/// Ways [m] at the ends of the pieces of a run, beginning with that of no length.
fn ways(law: &Traveling, piece: f64) -> Vec<Vec3> {
    let mut ways = vec![Vec3::ZERO];
    for number in 0..PIECES {
        let way = traveled(law, number as f64 * piece, (number + 1) as f64 * piece);
        ways.push(ways[number] + way);
    }
    ways
}

impl Pose {
    /// The point that it turns about, now [m].
    pub fn center(&self) -> Vec3 {
        self.about[1]
    }

    /// Angular velocity [rad/s].
    #[inline]
    pub fn spin(&self) -> Vec3 {
        self.spin
    }

    /// A point [m] as the wall sees it: where it would be if the wall were where it was at time zero.
    #[inline]
    pub fn as_at_start(&self, point: Vec3) -> Vec3 {
        let offset = point - self.about[1];
        self.about[0]
            + match &self.turn {
                None => offset,
                Some((axis, [sin, cos])) => turned(offset, *axis, [-sin, *cos]),
            }
    }

    /// A direction as the wall sees it: what it would be if the wall were as it was at time zero.
    #[inline]
    pub fn direction_as_at_start(&self, now: Vec3) -> Vec3 {
        self.turn.map_or(now, |(axis, [sin, cos])| turned(now, axis, [-sin, cos]))
    }

    /// A direction of the wall at time zero, turned with it.
    #[inline]
    pub fn direction(&self, at_start: Vec3) -> Vec3 {
        self.turn.map_or(at_start, |(axis, angle)| turned(at_start, axis, angle))
    }

    /// A point of the wall at time zero [m], moved with it.
    pub fn point(&self, at_start: Vec3) -> Vec3 {
        self.about[1] + self.direction(at_start - self.about[0])
    }

    /// Velocity [m/s] of the wall's point at a place [m].
    #[inline]
    pub fn velocity_at(&self, place: Vec3) -> Vec3 {
        self.velocity + self.spin.cross(place - self.about[1])
    }

    /// Way [m] that no point of the wall within a distance [m] from its center is beyond, from another moment to this one.
    pub fn way_since(&self, before: &Self, within: f64) -> f64 {
        let turned = |pose: &Self, axis: Vec3| pose.direction(axis);
        // |R x - R' x| is no more than the sum over the axes of |R e - R' e| |x_e|.
        let parts = Vec3::AXES.map(|axis| (turned(self, axis) - turned(before, axis)).norm());
        let turn = if self.turn.is_some() { parts.into_iter().sum::<f64>() } else { 0.0 };
        (self.about[1] - before.about[1]).norm() + turn * within
    }
}

/// Turned about a unit vector by the angle of this sine and cosine.
#[inline]
fn turned(vector: Vec3, axis: Vec3, [sin, cos]: [f64; 2]) -> Vec3 {
    vector * cos + axis.cross(vector) * sin + axis * (axis.dot(vector) * (1.0 - cos))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::formula::Written;
    use crate::units::Quantity;

    const TIMES: [f64; 5] = [0.0, 1e-3, 0.37, 1.0, 2.9];

    fn courses() -> Vec<Course> {
        let constant = |about: Option<[f64; 3]>| {
            Motion::Constant(Constant {
                velocity: [0.3, -0.1, 0.2].map(Quantity),
                angular_velocity: [1.0, 2.0, -0.5].map(Quantity),
                about: about.map(|about| about.map(Quantity)),
            })
        };
        let oscillating = Motion::Oscillating(Oscillating {
            amplitude: [0.1, 0.0, -0.2].map(Quantity),
            frequency: Quantity(1.3),
            phase: 0.4,
        });
        let formula = Motion::Formula(Traveling { velocity: ["3*t^2", "cos(5*t)", "0.5"].map(Written::new) });
        let motions = [Motion::Fixed, constant(None), constant(Some([0.0, 3.0, 0.0])), oscillating, formula];
        motions.iter().map(|motion| Course::new(motion, Vec3::new(1.0, -2.0, 0.5), 3.0)).collect()
    }

    /// Velocities of points are the slopes of their places: a central difference over 1e-5 s errs by 1e-10 of third derivatives up to
    /// some hundred, and by rounding over it.
    #[test]
    fn points_move_as_fast_as_is_said() {
        let point = Vec3::new(0.4, 1.7, -0.6);
        for (number, course) in courses().iter().enumerate() {
            for time in TIMES {
                let at = |time: f64| course.at(time).point(point);
                let slope = (at(time + 1e-5) - at(time - 1e-5)) / 2e-5;
                let pose = course.at(time);
                assert_near_vector!(
                    pose.velocity_at(at(time)),
                    slope,
                    1e-7,
                    "in m/s, motion {number}, {time} s"
                );
                assert_near_vector!(pose.as_at_start(at(time)), point, 1e-14, "in m, motion {number}");
            }
            assert_near_vector!(course.at(0.0).point(point), point, 1e-15, "in m, motion {number}");
        }
    }

    /// By hand: t³, sin(5 t)/5 and t/2, also beyond the end of the run; the quadrature is good to 1e-12.
    #[test]
    fn formulas_are_integrated() {
        let course = &courses()[4];
        for time in [0.0_f64, 1e-4, 0.01, 1.234, 2.999, 3.0, 3.5] {
            let wanted = Vec3::new(time.powi(3), (5.0 * time).sin() / 5.0, 0.5 * time);
            assert_near_vector!(course.at(time).center() - course.about, wanted, 1e-10, "in m, {time} s");
        }
    }

    /// No point strays farther than the bound says, but for rounding, and it is no more than thrice the way.
    #[test]
    fn ways_are_bounded() {
        for (number, course) in courses().iter().enumerate() {
            let (before, now) = (course.at(0.3), course.at(0.31));
            let mut longest = 0.0_f64;
            for along in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.0, 0.8], [0.0, 0.6, -0.8]] {
                let point = course.about + Vec3::from(along) * 2.0;
                longest = longest.max((now.point(point) - before.point(point)).norm());
            }
            let bound = now.way_since(&before, 2.0);
            assert_between!(bound, longest * (1.0 - 1e-9)..=3.0 * longest, "in m, motion {number}");
        }
    }
}
