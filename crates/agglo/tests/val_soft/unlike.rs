//! Two grains that differ in all that they can.

use agglo::engine::soft::Simulation;
use agglo::particles::Particles;

use crate::common::{as_read, start};

/// Two grains that differ in all that they can: grain 0 at the origin, grain 1 along x. Bounds on motion are wide.
#[derive(Clone)]
pub struct Unlike {
    /// Tables of the two materials.
    pub materials: [&'static str; 2],
    /// Radii [m].
    pub radii: [f64; 2],
    /// Temperatures [K].
    pub temperatures: [f64; 2],
    /// Distance of the centers [m].
    pub distance: f64,
    /// End of the run [s].
    pub end: f64,
    /// Table of the engine.
    pub engine: String,
    /// Bounds on motion; wide ones if left empty.
    pub limits: String,
    /// Further tables.
    pub more: String,
}

impl Unlike {
    /// The scenario's text.
    pub fn text(&self) -> String {
        let group = |k: usize, at: f64| {
            format!(
                "[materials.m{k}]\n{}\n[[grains]]\nmaterial = \"m{k}\"\ntemperature = \"{} K\"\n\
                 size.constant.radius = \"{:e} m\"\nplacement.list.positions = [[\"{at:e} m\", \"0 m\", \"0 m\"]]\n",
                as_read(self.materials[k], &self.more),
                self.temperatures[k],
                self.radii[k]
            )
        };
        let limits = if self.limits.is_empty() { "strain = 0.5" } else { &self.limits };
        format!(
            "version = 1\ntime.end = \"{:e} s\"\n{}\n[limits]\ndisplacement = 1e3\n{limits}\n{}{}{}\n",
            self.end,
            self.engine,
            group(0, 0.0),
            group(1, self.distance),
            self.more
        )
    }

    /// A simulation with its grains changed as wanted.
    pub fn start(&self, change: impl FnOnce(&mut Particles)) -> Simulation {
        start(&self.text(), change)
    }
}
