//! Forces of the caller's own, for what a formula cannot say: a trait object or a closure that acts in every step.
//!
//! A hook is asked for forces and torques wherever the laws are: once a step under `verlet`, once an iteration under `staggered`,
//! and again where a step is tried again. So what it gives is a function of what it sees and of what it remembers, and what it
//! remembers changes in [`Hook::after_step`] alone, which is called once a step. Then its forces are as accurate as those of laws,
//! the ledger books their work and impulse under `flows.supplies.hook` (`work_custom_J` of the balance), and the run has the same
//! bits for any number of threads, as long as the hook's own sums do not depend on them. Grains change places in memory now and then:
//! know them by `grains.id`.
//!
//! A checkpoint has the hook's forces at its moment, and knows that there was one; it does not have the hook. To resume, build
//! the simulation from the state, restore what the hook remembers, and attach it again: the bits are those of the run that went on.
//!
//! # Example
//! A breath of wind for a millisecond:
//! ```
//! # extern crate agglo_core as agglo;
//! use std::collections::BTreeMap;
//!
//! use agglo::acoustics::Medium;
//! use agglo::engine::soft::{Limits, LoadViews, Scene, Scheme, Settings, Simulation, Verlet};
//! use agglo::fields::Fields;
//! use agglo::math::Vec3;
//! use agglo::particles::{Material, Particles, Row};
//! use agglo::units::Quantity;
//!
//! let stone = Material { density: Quantity(2500.0), ..Material::default() };
//! let settings = Settings {
//!     seed: 1,
//!     end: 2e-3,
//!     scheme: Scheme::Verlet(Verlet { step: Some(Quantity(1e-5)), safety: 0.03 }),
//!     limits: Limits::default(),
//!     medium: Medium::default(),
//!     materials: BTreeMap::from([("stone".to_owned(), stone)]),
//!     mixtures: Vec::new(),
//!     smallest_radius: None,
//!     relax: None,
//!     volume: None,
//!     walls: Vec::new(),
//!     contact: None,
//!     bonds: None,
//!     fields: Fields::default(),
//!     acoustics: None,
//! };
//! let mut grains = Particles::default();
//! grains.push(Row { radius: 1e-3, mass: 1e-5, ..Row::default() });
//! let mut simulation = Simulation::start(settings, grains)?;
//! simulation.attach(Box::new(|now: &Scene<'_>, loads: &mut LoadViews<'_>| {
//!     for (force, radius) in loads.force.iter_mut().zip(&now.grains.radius) {
//!         *force += Vec3::new(if now.time < 1e-3 { 0.02 * radius } else { 0.0 }, 0.0, 0.0);
//!     }
//! }));
//! while !simulation.is_finished() {
//!     simulation.step()?;
//! }
//! let impulse = simulation.ledger.flows.supplies.hook.force.x;
//! assert!((impulse / 2e-8 - 1.0).abs() < 0.01);
//! // The ledger closes but for the step in which the wind dies: (dt/T)²/4 of the energy.
//! assert!(simulation.balance().drift_relative.abs() < 3e-5);
//! # Ok::<(), agglo::engine::SimError>(())
//! ```

use std::sync::{Mutex, PoisonError};

use crate::ledger::Supply;
use crate::math::{Pace, Vec3};
use crate::particles::{Motion, Particles};

use super::forces::loads::{LoadViews, Loads};

/// What a hook sees.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// Time [s].
    pub time: f64,
    /// What grains are: ids, radii, masses, charges. Their places are in `motion`.
    pub grains: &'a Particles,
    /// Where grains are and how they move, in the order of `grains`.
    pub motion: Motion<'a>,
}

/// Forces of the caller's own.
pub trait Hook: Send + Sync {
    /// What errors and warnings call it.
    fn name(&self) -> &str;

    /// Adds its forces [N] and torques about the centers [N m], which are 0 before, in the order of the grains.
    fn load(&self, now: &Scene<'_>, loads: &mut LoadViews<'_>);

    /// A step was made, and this is where it led: the one place to change what is remembered.
    fn after_step(&mut self, _: &Scene<'_>) {}

    /// How fast it is: ω² is the largest stiffness over the mass, Γ the largest dashpot over it. Without an answer the
    /// automatic step does not know of it, and the run warns.
    fn pace(&self, _: &Scene<'_>) -> Option<Pace> {
        None
    }

    /// What kept it from giving its forces, in words, if something did: the step that asked for them is not taken, and fails.
    fn fault(&self) -> Option<String> {
        None
    }
}

impl<F: Fn(&Scene<'_>, &mut LoadViews<'_>) + Send + Sync> Hook for F {
    fn name(&self) -> &'static str {
        "a closure"
    }

    fn load(&self, now: &Scene<'_>, loads: &mut LoadViews<'_>) {
        self(now, loads);
    }
}

/// Several hooks as one, whose forces add up.
pub struct Hooks {
    all: Vec<Box<dyn Hook>>,
    name: String,
    /// The loads of one of them: each begins with none.
    own: Mutex<Loads>,
}

impl Hooks {
    /// All of these, in their order.
    pub fn new(all: Vec<Box<dyn Hook>>) -> Self {
        let name = all.iter().map(|hook| hook.name()).collect::<Vec<_>>().join(", ");
        Self { all, name, own: Mutex::default() }
    }
}

impl Hook for Hooks {
    fn name(&self) -> &str {
        &self.name
    }

    fn load(&self, now: &Scene<'_>, loads: &mut LoadViews<'_>) {
        let mut own = self.own.lock().unwrap_or_else(PoisonError::into_inner);
        if own.force.len() != loads.force.len() {
            *own = Loads::none(loads.force.len());
        }
        for hook in &self.all {
            own.clear();
            hook.load(now, &mut own.views());
            loads.force.iter_mut().zip(&own.force).for_each(|(sum, part)| *sum += *part);
            loads.torque.iter_mut().zip(&own.torque).for_each(|(sum, part)| *sum += *part);
        }
    }

    fn after_step(&mut self, now: &Scene<'_>) {
        self.all.iter_mut().for_each(|hook| hook.after_step(now));
    }

    /// All together, if each one says.
    fn pace(&self, now: &Scene<'_>) -> Option<Pace> {
        self.all.iter().try_fold(Pace::NONE, |sum, hook| Some(sum + hook.pace(now)?))
    }

    fn fault(&self) -> Option<String> {
        self.all.iter().find_map(|hook| hook.fault())
    }
}

/// A hook at work, with its loads at the motion that was looked at last.
pub(super) struct Attached {
    pub hook: Box<dyn Hook>,
    pub loads: Loads,
}

impl std::fmt::Debug for Attached {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "hook {}", self.hook.name())
    }
}

impl Attached {
    /// Works out its loads.
    pub fn look(&mut self, now: &Scene<'_>) {
        self.loads.clear();
        self.hook.load(now, &mut self.loads.views());
    }

    /// What it does to a grain with this position [m], velocity [m/s] and angular velocity [rad/s], per second.
    #[inline]
    pub fn supply(
        loads: &Loads,
        (position, velocity, angular_velocity): (Vec3, Vec3, Vec3),
        at: usize,
    ) -> Supply {
        let (force, torque) = (loads.force[at], loads.torque[at]);
        Supply {
            power: force.dot(velocity) + torque.dot(angular_velocity),
            force,
            torque: position.cross(force) + torque,
        }
    }
}
