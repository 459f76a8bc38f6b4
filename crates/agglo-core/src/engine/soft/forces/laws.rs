//! The laws of a scenario, ready for use: what every evaluation of forces reads and none changes.

use crate::acoustics::Medium;
use crate::contact::pass::Record;
use crate::contact::{Bonds, ContactLaws, PairTable};
use crate::domain::Space;
use crate::fields::near_field::{NearField, Source};
use crate::fields::{Channel, Drag, Fields, Flow, FlowAt, Grain, Part, rotational_drag};
use crate::law::Chosen;
use crate::ledger::{Supplies, Supply};
use crate::math::Vec3;
use crate::particles::{Material, Particles};
use crate::walls::{WallStep, Walls};

use super::response::Response;
use crate::engine::soft::settings::Settings;

/// The laws of a scenario.
#[derive(Clone, Debug)]
pub struct Laws {
    /// Contact.
    pub contact: Option<ContactLaws>,
    /// Bonds.
    pub bonds: Option<Bonds>,
    /// Fields.
    pub fields: Fields,
    /// The fluid around the grains.
    pub medium: Medium,
    /// Constants of pairs of materials.
    pub pairs: PairTable,
    /// The materials, by number.
    pub materials: Vec<Material>,
    /// The walls.
    pub walls: Walls,
    /// Density of the medium over that of each material.
    density_ratios: Vec<f64>,
    /// The flow of the medium, where it has one.
    flow: Option<Flow>,
}

/// What the forces on one grain amount to.
#[derive(Clone, Copy, Debug, Default)]
pub struct SingleLoad {
    /// Force [N].
    pub force: Vec3,
    /// Moment about the center [N m].
    pub torque: Vec3,
}

impl Laws {
    /// The laws for these grains.
    pub fn new(settings: &Settings, grains: &Particles) -> Self {
        let density_ratio = |material: &Material| settings.medium.density.si() / material.density.si();
        Self {
            contact: settings.contact.clone(),
            bonds: settings.bonds.clone(),
            fields: settings.fields.clone(),
            medium: settings.medium.clone(),
            pairs: PairTable::new(&settings.materials, &settings.mixtures, settings.contact.as_ref()),
            materials: settings.materials.values().cloned().collect(),
            walls: Walls::new(&settings.walls, &settings.materials, settings.end),
            density_ratios: settings.materials.values().map(density_ratio).collect(),
            flow: flow_of(settings, grains),
        }
    }

    /// What grains meet walls by at the end of a step: its time, the time that went by and its length [s].
    pub fn wall_step<'a>(
        &'a self,
        grains: &'a Particles,
        records: &'a [Record],
        [time, elapsed, dt]: [f64; 3],
    ) -> WallStep<'a> {
        WallStep {
            walls: &self.walls,
            laws: self.contact.as_ref(),
            bond: self.bonds.as_ref().and_then(Bonds::in_contact),
            pairs: &self.pairs,
            grains,
            records,
            time,
            elapsed,
            dt,
        }
    }

    /// The flow of the medium at a point [m] and time [s].
    #[inline]
    pub fn flow_at(&self, position: Vec3, time: f64) -> FlowAt {
        self.flow.as_ref().map_or_else(FlowAt::default, |flow| flow.at(position, time))
    }

    /// What the forces on one grain answer to its velocity, at a velocity [m/s], a point [m] and time [s].
    #[inline]
    pub fn response(&self, grains: &Particles, at: usize, motion: (Vec3, Vec3), time: f64) -> Response {
        let ((position, velocity), radius, fields) = (motion, grains.radius[at], &self.fields);
        let (drag, rotational_drag) = fields.drag.as_ref().map_or((0.0, 0.0), |law| {
            let slip = self.flow_velocity_at(position, time) - velocity;
            (law.coefficient(&self.medium, radius, slip), rotational_drag(&self.medium, radius))
        });
        let turning =
            if fields.turn() { fields.turning(&self.grain(grains, at, motion, time)) } else { Vec3::ZERO };
        Response { drag, turning, rotational_drag }
    }

    /// Whether forces on single grains answer to their velocities.
    pub fn has_response(&self) -> bool {
        self.fields.drag.is_some() || self.fields.turn()
    }

    /// How much the medium's velocity [m/s] changes from one place [m] and time [s] to another.
    #[inline]
    pub fn flow_change(&self, ends: [(Vec3, f64); 2]) -> Vec3 {
        let at = |end: usize| self.flow_velocity_at(ends[end].0, ends[end].1);
        if self.flow.is_some() { at(1) - at(0) } else { Vec3::ZERO }
    }

    #[inline]
    fn flow_velocity_at(&self, position: Vec3, time: f64) -> Vec3 {
        self.flow.as_ref().map_or(Vec3::ZERO, |flow| flow.velocity_at(position, time))
    }

    /// A grain at a point [m] with a velocity [m/s] and at a time [s], as the fields see it.
    #[inline]
    pub fn grain(
        &self,
        grains: &Particles,
        at: usize,
        (position, velocity): (Vec3, Vec3),
        time: f64,
    ) -> Grain {
        Grain {
            position,
            velocity,
            mass: grains.mass[at],
            radius: grains.radius[at],
            charge: grains.charge[at],
            density_ratio: self.density_ratios[grains.material[at] as usize],
            time,
        }
    }

    /// Mass that resists acceleration [kg]: the grain's and, if wanted, that of the fluid it moves.
    pub fn inertial_mass(&self, grains: &Particles, at: usize) -> f64 {
        let added =
            self.fields.drag.as_ref().map_or(0.0, |drag| drag.added_mass(&self.medium, grains.radius[at]));
        grains.mass[at] + added
    }

    /// Force and torque of gravity, drag and fields on one grain at a position [m] with a velocity [m/s] and an angular velocity
    /// [rad/s]; what each supplies is added to `supplies`.
    #[inline]
    pub fn on_single(
        &self,
        grains: &Particles,
        at: usize,
        (position, velocity, angular_velocity): (Vec3, Vec3, Vec3),
        time: f64,
        supplies: &mut Supplies,
    ) -> SingleLoad {
        let radius = grains.radius[at];
        let mut total = SingleLoad::default();
        let mut book = |channel: &mut Supply, force: Vec3, power: f64| {
            *channel = *channel + Supply { power, force, torque: position.cross(force) };
            total.force += force;
        };
        let grain = self.grain(grains, at, (position, velocity), time);
        self.fields.each_part(&grain, |Part { channel, force, power }| match channel {
            Channel::Gravity => book(&mut supplies.gravity, force, power),
            Channel::Field => book(&mut supplies.field, force, power),
            Channel::Drag => book(&mut supplies.drag, force, power),
        });
        if let Some(drag) = &self.fields.drag {
            let flow = self.flow_at(position, time);
            let force = drag.force(&self.medium, radius, velocity, &flow);
            book(&mut supplies.drag, force, force.dot(velocity));
            total.torque = Drag::torque(&self.medium, radius, angular_velocity, &flow);
            supplies.drag.power += total.torque.dot(angular_velocity);
            supplies.drag.torque += total.torque;
        }
        total
    }

    /// Whether any force acts on single grains.
    pub fn has_single(&self) -> bool {
        self.fields.has_single()
    }

    /// The laws that act.
    pub fn chosen(&self) -> impl Iterator<Item = Chosen<'_>> {
        let contact = self.contact.iter().flat_map(ContactLaws::chosen);
        let bonds = self.bonds.iter().map(Bonds::chosen);
        contact.chain(bonds).chain(self.fields.chosen())
    }

    /// The scenario's words for the laws that act.
    pub fn names(&self) -> Vec<&'static str> {
        self.chosen().map(Chosen::key).collect()
    }

    /// Warnings that hold for the whole run: published laws that do not do what their names say.
    pub fn standing_warnings(&self) -> Vec<&'static str> {
        self.chosen().flat_map(Chosen::warnings).copied().collect()
    }
}

fn flow_of(settings: &Settings, grains: &Particles) -> Option<Flow> {
    let field = settings.fields.drag.as_ref()?.medium_velocity.as_ref()?;
    let found = || grains.radius.iter().copied().fold(f64::INFINITY, f64::min);
    Some(Flow::new(field, settings.smallest_radius.unwrap_or_else(found), settings.end))
}

/// What the near field sees of a grain.
#[inline]
pub fn source(grains: &Particles, at: usize) -> Source {
    Source {
        mass: grains.mass[at],
        radius: grains.radius[at],
        charge: grains.charge[at],
        polarity: grains.polarity[at],
    }
}

/// Near-field force [N] of grain `b` on grain `a`.
#[inline]
pub fn near_force(
    law: &NearField,
    grains: &Particles,
    space: &Space,
    positions: &[Vec3],
    [a, b]: [usize; 2],
) -> Vec3 {
    let apart = space.shortest(positions[b] - positions[a]);
    let squared = apart.norm_squared();
    let within = law.cutoff.is_none_or(|cutoff| squared < cutoff.si() * cutoff.si());
    if !within || squared == 0.0 {
        return Vec3::ZERO;
    }
    let distance = squared.sqrt();
    apart * (-law.force(&source(grains, a), &source(grains, b), distance) / distance)
}
