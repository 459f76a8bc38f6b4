//! The laws of a scenario, ready for use: what every evaluation of forces reads and none changes.

use crate::acoustics::Medium;
use crate::contact::{Bonds, ContactLaws, Damping, Friction, Normal};
use crate::fields::near_field::{NearField, Source};
use crate::fields::{Drag, Fields, Flow, FlowAt, Lorentz, spin_coefficient};
use crate::math::Vec3;
use crate::particles::{Material, Motion, PairTable, Particles};

use super::loads::{Supplies, Supply};
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
        Self {
            contact: settings.contact.clone(),
            bonds: settings.bonds.clone(),
            fields: settings.fields.clone(),
            medium: settings.medium.clone(),
            pairs: PairTable::new(&settings.materials, &settings.mixtures),
            materials: settings.materials.values().cloned().collect(),
            flow: flow_of(settings, grains),
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
        let (drag, spin) = fields.drag.as_ref().map_or((0.0, 0.0), |law| {
            let slip = self.flow_velocity_at(position, time) - velocity;
            (law.coefficient(&self.medium, radius, slip), spin_coefficient(&self.medium, radius))
        });
        let turning = |law: &Lorentz| law.turning(grains.charge[at], position, time);
        Response { drag, spin, turning: fields.lorentz.as_ref().map_or(Vec3::ZERO, turning) }
    }

    /// Whether forces on single grains answer to their velocities.
    pub fn has_response(&self) -> bool {
        let turns = |law: &Lorentz| law.magnetic_flux_density.is_some();
        self.fields.drag.is_some() || self.fields.lorentz.as_ref().is_some_and(turns)
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

    /// Mass that resists acceleration [kg]: the grain's and, if wanted, that of the fluid it moves.
    pub fn inertial_mass(&self, grains: &Particles, at: usize) -> f64 {
        let added =
            self.fields.drag.as_ref().map_or(0.0, |drag| drag.added_mass(&self.medium, grains.radius[at]));
        grains.mass[at] + added
    }

    /// Force and torque of gravity, drag and fields on one grain; what each supplies is added to `supplies`.
    #[inline]
    pub fn on_single(
        &self,
        grains: &Particles,
        motion: &Motion<'_>,
        at: usize,
        time: f64,
        supplies: &mut Supplies,
    ) -> SingleLoad {
        let (position, velocity, radius) = (motion.position[at], motion.velocity[at], grains.radius[at]);
        let mut total = SingleLoad::default();
        let mut book = |channel: &mut Supply, force: Vec3| {
            *channel = *channel + Supply::of(force, position, velocity);
            total.force += force;
        };
        if let Some(gravity) = &self.fields.gravity {
            let ratio = self.medium.density.si() / self.materials[grains.material[at] as usize].density.si();
            book(&mut supplies.gravity, gravity.acceleration_on(ratio) * grains.mass[at]);
        }
        if let Some(lorentz) = &self.fields.lorentz {
            book(&mut supplies.field, lorentz.force(grains.charge[at], velocity, position, time));
        }
        if let Some(magnetic) = &self.fields.magnetic {
            book(&mut supplies.field, magnetic.force(radius, position, time));
        }
        if let Some(drag) = &self.fields.drag {
            let (flow, spin) = (self.flow_at(position, time), motion.spin[at]);
            book(&mut supplies.drag, drag.force(&self.medium, radius, velocity, &flow));
            total.torque = Drag::torque(&self.medium, radius, spin, &flow);
            supplies.drag.power += total.torque.dot(spin);
            supplies.drag.torque += total.torque;
        }
        total
    }

    /// Whether any force acts on single grains.
    pub fn has_single(&self) -> bool {
        let fields = &self.fields;
        fields.gravity.is_some()
            || fields.drag.is_some()
            || fields.lorentz.is_some()
            || fields.magnetic.is_some()
    }

    /// The scenario's words for the laws that act.
    pub fn names(&self) -> Vec<&'static str> {
        let mut names = Vec::new();
        if let Some(laws) = &self.contact {
            names.push(match laws.normal {
                Normal::StrainPower(_) => "contact.normal.strain_power",
                Normal::Hertz(_) => "contact.normal.hertz",
                Normal::Hooke(_) => "contact.normal.hooke",
            });
            names.extend(laws.damping.as_ref().map(|law| match law {
                Damping::ViscousArea(_) => "contact.damping.viscous_area",
                Damping::Restitution(_) => "contact.damping.restitution",
            }));
            names.extend(laws.friction.as_ref().map(|law| match law {
                Friction::Regularized(_) => "contact.friction.regularized",
                Friction::Mindlin(_) => "contact.friction.mindlin",
            }));
        }
        names.extend(self.bonds.as_ref().map(|law| match law {
            Bonds::StrainBond(_) => "bonds.strain_bond",
            Bonds::Beam(_) => "bonds.beam",
        }));
        let fields = &self.fields;
        names.extend(fields.gravity.as_ref().map(|_| "fields.gravity"));
        names.extend(fields.drag.as_ref().map(|_| "fields.drag"));
        names.extend(fields.lorentz.as_ref().map(|_| "fields.lorentz"));
        names.extend(fields.magnetic.as_ref().map(|_| "fields.magnetic"));
        names.extend(fields.near_field.as_ref().map(|_| "fields.near_field"));
        names
    }

    /// Warnings that hold for the whole run: published laws that do not do what their names say.
    pub fn standing_warnings(&self) -> Vec<&'static str> {
        let mut warnings = Vec::new();
        if let Some(ContactLaws { friction: Some(Friction::Regularized(_)), .. }) = &self.contact {
            warnings.push(
                "contact.friction.regularized: the stick force carries the time step (halving the step halves it), so \
                 the answer does not converge",
            );
        }
        if let Some(Bonds::StrainBond(_)) = &self.bonds {
            warnings.push(
                "bonds.strain_bond acts in contact only: it cannot resist tension, and its tangential force carries \
                 the time step",
            );
        }
        warnings
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
pub fn near_force(law: &NearField, grains: &Particles, positions: &[Vec3], a: usize, b: usize) -> Vec3 {
    let apart = positions[b] - positions[a];
    let squared = apart.norm_squared();
    let within = law.cutoff.is_none_or(|cutoff| squared < cutoff.si() * cutoff.si());
    if !within || squared == 0.0 {
        return Vec3::ZERO;
    }
    let distance = squared.sqrt();
    apart * (-law.force(&source(grains, a), &source(grains, b), distance) / distance)
}
