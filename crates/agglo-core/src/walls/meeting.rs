//! What the laws of contact make of one grain at one face of a wall.

use super::course::Pose;
use super::shape::Near;
use crate::contact::bond::StrainBond;
use crate::contact::friction::{Sliding, TangentialSpring};
use crate::contact::pass::Record;
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
