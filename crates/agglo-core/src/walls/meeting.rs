//! What the laws of contact make of one grain at one face of a wall.

use super::course::Pose;
use super::shape::Near;
use crate::contact::bond::StrainBond;
use crate::contact::friction::{Sliding, TangentialSpring};
use crate::contact::pass::{ContactRates, Record};
use crate::contact::{ContactGeometry, ContactLaws, PairConstants};
use crate::math::Vec3;

/// Laws, and what grain and wall have in common.
#[derive(Clone, Copy)]
pub(super) struct Partners<'a> {
    pub laws: Option<&'a ContactLaws>,
    pub bond: Option<&'a StrainBond>,
    pub constants: &'a PairConstants,
    /// Mass of the grain [kg].
    pub mass: f64,
    /// Contact stiffness [Pa] of the grain and of the wall.
    pub stiffness: [f64; 2],
}

impl Partners<'_> {
    /// The geometry of a grain of a radius [m].
    #[inline]
    pub fn geometry(&self, radius: f64, near: &Near) -> ContactGeometry {
        ContactGeometry::at_wall(radius, self.mass, self.stiffness, near.gap)
    }
}

/// Lengths of the step at whose end grain and wall meet [s]: the time that went by, and the step's own for laws that carry it.
#[derive(Clone, Copy)]
pub(super) struct Lasted {
    pub elapsed: f64,
    pub dt: f64,
}

/// What came of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Met {
    /// Force [N] and torque about the center [N m] on the grain.
    pub force: Vec3,
    pub torque: Vec3,
    /// Where it acts [m].
    pub place: Vec3,
    /// Power that the wall puts in [W].
    pub power: f64,
    /// Powers lost in the dashpot, put in by a formula that drives, and taken by tangential forces [W].
    pub damping: f64,
    pub driven: f64,
    pub tangential: f64,
    /// Overlap over the grain's radius.
    pub strain: f64,
    /// Whether a law acts at all.
    pub acts: bool,
    /// What the contact remembers; nothing where grain and wall do not touch.
    pub spring: Option<TangentialSpring>,
}

impl Met {
    /// What it feeds or drains.
    pub fn rates(&self) -> ContactRates {
        let Self { damping, driven, tangential, strain, .. } = *self;
        ContactRates { damping, driven, tangential, strained: 0.0, worst_strain: strain }
    }
}

/// Velocity of the wall's surface relative to the grain's [m/s], from the wall's at the point of contact and the grain's.
#[inline]
fn relative(wall: Vec3, velocity: Vec3, spin: Vec3, near: &Near) -> Vec3 {
    wall - velocity - spin.cross(near.normal) * near.gap
}

/// A grain meets a wall, which was and is in these poses, in its nearest point; before the step the contact remembered a spring.
pub(super) fn meet(
    partners: &Partners<'_>,
    record: &Record,
    near: &Near,
    [before, now]: [&Pose; 2],
    lasted: Lasted,
    remembered: Option<&TangentialSpring>,
) -> Met {
    let (center, velocity, spin) = record.now();
    let (_, velocity_before, spin_before) = record.before();
    let geometry = partners.geometry(record.radius(), near);
    let (normal, touches) = (near.normal, geometry.overlap > 0.0);
    let place = center + normal * near.gap;
    let surface = now.velocity_at(place);
    let motion = relative(surface, velocity, spin, near);
    let separation = motion.dot(normal);
    let slip = motion - normal * separation;
    let mut met = Met { place, strain: geometry.strain(), acts: true, ..Met::default() };
    let (mut repulsion, mut tangential) = (0.0, Vec3::ZERO);
    if let Some(laws) = partners.laws {
        let along = laws.along(partners.constants, &geometry, separation);
        repulsion = along.repulsion;
        (met.damping, met.driven) = (along.dissipation, along.driven);
        met.spring = touches.then(TangentialSpring::default);
        if let Some(law) = laws.friction.as_ref().filter(|_| touches) {
            // Sums over both ends of the step.
            let (way, turn) = (velocity_before + velocity, spin_before + spin);
            let wall = before.velocity_at(place) + surface;
            let path = relative(wall, way, turn, near).rejected_from(normal);
            let turning = turn + before.spin() + now.spin();
            let sliding = Sliding {
                normal,
                displacement: path * (0.5 * lasted.elapsed),
                velocity: slip,
                turn_about_normal: turning.dot(normal) * (0.25 * lasted.elapsed),
                elastic: along.elastic,
                normal_dashpot: along.dashpot,
                normal_force: along.repulsion,
                dt: lasted.dt,
            };
            let loaded = remembered.copied().unwrap_or_default();
            let (force, spring) = law.force(partners.constants, &geometry, &sliding, &loaded);
            (tangential, met.spring) = (force, Some(spring));
        }
    }
    if let Some(bond) = partners.bond {
        repulsion -= bond.attraction(&geometry);
        let speed = slip.norm();
        if speed > 0.0 {
            tangential += slip * (bond.tangential(&geometry, speed, lasted.dt) / speed);
        }
    }
    met.force = tangential - normal * repulsion;
    met.torque = normal.cross(tangential) * near.gap;
    met.tangential = tangential.dot(slip);
    met.power = met.force.dot(surface);
    met
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::friction::{Friction, Mindlin};
    use crate::contact::normal::{Hooke, Normal};
    use crate::math::formula::Written;
    use crate::particles::{Particles, Row};
    use crate::units::Quantity;
    use crate::walls::course::Course;
    use crate::walls::motion::{Constant, Motion, Traveling};

    const DT: f64 = 1e-6;
    const RADIUS: f64 = 1e-3;
    const GAP: f64 = 0.99e-3;

    /// A grain 10 um deep in a floor at z = 0 that moves so, with velocities [m/s] and spins [rad/s] at both ends of the step.
    fn met(
        motion: &Motion,
        velocities: [Vec3; 2],
        spins: [Vec3; 2],
        before: Option<TangentialSpring>,
    ) -> Met {
        let friction = Mindlin {
            static_friction: 1e6,
            dynamic_friction: None,
            stiffness_ratio: Some(0.5),
            dashpot: 0.0,
        };
        let laws = ContactLaws {
            normal: Some(Normal::Hooke(Hooke { stiffness: Quantity(20.0) })),
            custom: None,
            damping: None,
            friction: Some(Friction::Mindlin(friction)),
        };
        let mut constants = PairConstants::default();
        laws.settle(&mut constants, None);
        let place = Vec3::AXES[2] * GAP;
        let mut grains = Particles::default();
        grains.push(Row { radius: RADIUS, mass: 1e-5, position: place, ..Row::default() });
        let mut record = Record::at_start(&grains, 0, 1e-5);
        record.begin(place, velocities[0], spins[0]);
        record.end(place, velocities[1] - velocities[0], spins[1] - spins[0]);
        let course = Course::new(motion, Vec3::ZERO, 1.0);
        let partners = Partners {
            laws: Some(&laws),
            bond: None,
            constants: &constants,
            mass: 1e-5,
            stiffness: [0.0; 2],
        };
        let near = Near { normal: -Vec3::AXES[2], gap: GAP };
        let lasted = Lasted { elapsed: DT, dt: DT };
        meet(&partners, &record, &near, [&course.at(0.0), &course.at(DT)], lasted, before.as_ref())
    }

    /// By hand: the stiffness of 10 N/m times the mean slip over the step, of the floor 0.4 m/s and of the grain 0.2 m/s, times its
    /// length; it pulls the grain along, and turns it about its center by the gap.
    #[test]
    fn springs_follow_the_mean_motion_of_grain_and_wall() {
        let motion = Motion::Formula(Traveling { velocity: ["0", "0.8e6*t", "0"].map(Written::new) });
        let [slow, fast] = [0.1, 0.3].map(|speed| Vec3::AXES[1] * speed);
        let found = met(&motion, [slow, fast], [Vec3::ZERO; 2], None);
        let size = 10.0 * 0.2 * DT;
        let repulsion = Vec3::AXES[2] * (20.0 * (RADIUS - GAP));
        assert_near_vector!(found.force, Vec3::AXES[1] * size + repulsion, 1e-12 * repulsion.z, "in N");
        assert_close_vector!(found.torque, Vec3::AXES[0] * (GAP * size), 1e-9, "in N m");
        assert_close_vector!(found.spring.unwrap().force, Vec3::AXES[1] * size, 1e-9, "in N");
        // At the end of the step the floor has 0.8 m/s, and slips by 0.5 m/s.
        assert_close!(found.power, 0.8 * size, 1e-9, "in W");
        assert_close!(found.tangential, 0.5 * size, 1e-9, "in W");
    }

    /// By hand: about the normal a spring turns by half of what grain and wall do, (2e4 + 4e4)/2 rad/s for a microsecond.
    #[test]
    fn springs_turn_with_grain_and_wall() {
        let angular_velocity = [0.0, 0.0, 4e4].map(Quantity);
        let motion =
            Motion::Constant(Constant { velocity: [Quantity(0.0); 3], angular_velocity, about: None });
        let spins = [1e4, 3e4].map(|rate| Vec3::AXES[2] * rate);
        let loaded = TangentialSpring { force: Vec3::AXES[1] * 1e-4, stiffness: 10.0, sliding: false };
        let found = met(&motion, [Vec3::ZERO; 2], spins, Some(loaded)).spring.unwrap().force;
        assert_close!(found.norm(), 1e-4, 1e-12, "in N");
        assert_close!(found.x / found.y, -0.03, 1e-9);
    }
}
