//! Explicit velocity Verlet.
//!
//! # Equation
//! ```text
//! r' = r + v Δt + (Δt²/(2 m)) F,   v' = v + (Δt/(2 m))(F + F')                                V1
//! ```
//! with F' = F(r', v + Δt F/m): velocity-dependent forces see a full-step velocity, not that of the half step.
//!
//! # Source
//! W. C. Swope et al., *J. Chem. Phys.* 76, 637 (1982). Full-step velocities in the contact law: arXiv 2410.14798.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning |
//! |--------|--------------|------|---------|
//! | Δt | `step` | s | chosen by the program unless given |
//! | - | `safety` | - | part of the critical step that the automatic step takes |
//!
//! # Valid when
//! Δt is well below the critical step 2/ω of the stiffest spring; the automatic step is `safety` times that.
//!
//! # Compared with others
//! LAMMPS and LIGGGHTS evaluate friction and dashpots with the half-step velocity, which errs at large size ratios.
//!
//! # In a scenario
//! ```toml
//! [engine.verlet]
//! safety = 0.03
//! ```

use super::advance::Ahead;
use super::change::Change;
use crate::engine::soft::system::System;

/// Makes the trial the motion after `dt` [s] from `time` [s], where grains meet; it may have been begun with the step before.
pub fn step(system: &mut System, time: f64, dt: f64) -> Change {
    let begun = system.afloat.map(|afloat| afloat.change);
    let change = begun.unwrap_or_else(|| system.move_trial(time, dt, 0.5, Ahead::AsAtStart));
    system.meet(dt, time + dt, dt);
    change
}

/// The same after a shorter time than the `tried` [s] that was too long.
pub fn again(system: &mut System, time: f64, tried: f64, dt: f64) -> Change {
    let change = if system.flies_freely() {
        system.shorten(time, tried, dt)
    } else {
        system.move_trial(time, dt, 0.5, Ahead::AsAtStart)
    };
    if let Some(afloat) = &mut system.afloat {
        afloat.dt = dt;
    }
    system.meet(dt, time + dt, dt);
    change
}
