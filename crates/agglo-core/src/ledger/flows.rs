//! What flowed in or out since the start, channel by channel.

use serde::{Deserialize, Serialize};

use super::{Momentum, Rates, Supplies, Supply};
use crate::impact::ImpactEnergy;
use crate::math::{Sum, Vec3};

/// What flowed in or out since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Flows {
    /// Rays: energy put in [J], impulse [N s] and angular impulse [N m s].
    pub rays: Supply,
    /// Drag, gravity, fields, hooks and kicks, walls of soft spheres: energy put in [J], impulse [N s] and angular impulse [N m s].
    pub supplies: Supplies,
    /// Lost in contact dashpots [J].
    pub damping: f64,
    /// Put in by a formula of contact where it drives grains [J].
    pub driven: f64,
    /// Taken from the motion by friction and tangential springs [J].
    pub tangential: f64,
    /// Lost in the dashpots of bonds [J].
    pub bond_damping: f64,
    /// Put in by space as it was pressed together [J].
    pub strained: f64,
    /// Carried off by grains that left through absorbing faces [J].
    pub absorbed: f64,
    /// Momentum that they carried off.
    pub carried_off: Momentum,
    /// Released by bonds that broke [J], put in by bonds that were made counting negative.
    pub broken_bonds: f64,
    /// Of all collisions of hard spheres.
    pub collisions: CollisionFlows,
    /// Heat of collisions that bodies without heat capacity could not keep [J].
    pub unkept: Sum,
    /// Heat given to gas and surroundings [J].
    pub cooled: f64,
    /// Kinetic energy that bounces would have lost that were made elastic, each counted by itself [J].
    pub kept: f64,
    /// Momentum from the walls of hard spheres [kg m/s].
    pub walls: Vec3,
}

/// Energies of all collisions [J]. The sums are compensated: in a gas that has cooled, millions of collisions each lose less
/// than the last digit of the sum. A step's flow of soft spheres is never so small a part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CollisionFlows {
    /// Kinetic energy lost along the normals.
    pub normal: Sum,
    /// Kinetic energy lost across them.
    pub tangential: Sum,
    /// Heat of reactions, put in.
    pub reaction: Sum,
    /// Energy of new surfaces, taken out.
    pub surface: Sum,
    /// Heat that warmed the pairs.
    pub heat: Sum,
}

impl CollisionFlows {
    /// Adds the energies of a collision.
    pub fn add(&mut self, energy: &ImpactEnergy) {
        self.normal.add(energy.normal);
        self.tangential.add(energy.tangential);
        self.reaction.add(energy.reaction);
        self.surface.add(energy.surface);
        self.heat.add(energy.heat);
    }

    /// The sums [J].
    pub fn total(&self) -> ImpactEnergy {
        ImpactEnergy {
            normal: self.normal.value(),
            tangential: self.tangential.value(),
            reaction: self.reaction.value(),
            surface: self.surface.value(),
            heat: self.heat.value(),
        }
    }
}

impl Flows {
    /// Adds the flow of a step of `dt` [s] with rates at both ends, `phi` being the weight of its end.
    ///
    /// Drag is solved for and may change much within a step. It is entered as its mean force on the mean velocity, as the
    /// step works with it: the mean of the powers less phi (1 - phi) ΔF · Δv.
    pub fn add_step(&mut self, before: &Rates, after: &Rates, phi: f64, dt: f64) {
        let (early, late) = ((1.0 - phi) * dt, phi * dt);
        let sum = |a: f64, b: f64| early * a + late * b;
        self.damping += sum(before.damping, after.damping);
        self.driven += sum(before.driven, after.driven);
        self.tangential += sum(before.tangential, after.tangential);
        self.bond_damping += sum(before.bond_damping, after.bond_damping);
        self.strained += sum(before.strained, after.strained);
        let (old, new, own) = (&before.supplies, &after.supplies, &mut self.supplies);
        own.drag = own.drag.plus(old.drag, early).plus(new.drag, late);
        own.drag.power += early * phi * after.bend;
        own.gravity = own.gravity.plus(old.gravity, early).plus(new.gravity, late);
        own.field = own.field.plus(old.field, early).plus(new.field, late);
        own.hook = own.hook.plus(old.hook, early).plus(new.hook, late);
        own.walls = own.walls.plus(old.walls, early).plus(new.walls, late);
    }

    /// Impulse [N s] and angular impulse [N m s] of all that acts from outside, less what grains carried off.
    pub(super) fn impulse(&self) -> Momentum {
        let Supplies { drag, gravity, field, hook, walls, .. } = self.supplies;
        let all = self.rays + drag + gravity + field + hook + walls;
        Momentum { linear: all.force + self.walls, angular: all.torque } - self.carried_off
    }
}
