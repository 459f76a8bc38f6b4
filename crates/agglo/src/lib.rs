//! How particulate agglomerates grow, break up and disperse.
//!
//! agglo moves two kinds of grains. *Soft spheres* overlap where they touch; fields hold them together or pull them apart, and
//! sound, followed as rays, breaks them up. *Hard spheres* collide in no time, heat up, react, stick and break. Both come from a
//! scenario, a text in TOML that people read and write, and both are simulated to the same bits on any number of threads.
//!
//! # A pulse of sound on an agglomerate
//! ```
//! use agglo::engine::soft::Simulation;
//! use agglo::scenario::{Scenario, template};
//!
//! let text = template("acoustic").ok_or("no such template")?.text;
//! // The shipped scenario, made small: 60 grains, 500 rays, one pulse.
//! let small = [
//!     "grains.0.placement.random.count=60",
//!     "acoustics.beams.0.rays=500",
//!     "acoustics.beams.0.pulses.count=1",
//!     "time.end=2 ms",
//! ];
//! let scenario = Scenario::with_overrides(text, &small)?;
//! let grains = agglo::packing::place(&scenario, "".as_ref())?;
//! let mut simulation = Simulation::start(&scenario, grains)?;
//! while !simulation.is_finished() {
//!     simulation.step()?;
//! }
//! let pulse = &simulation.pulses.flight().pulses()[0];
//! assert!(pulse.reflections > 0);
//! println!("{} reflections, {:.3e} W absorbed", pulse.reflections, pulse.power_absorbed);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A cloud that reacts and grows
//! ```
//! use agglo::engine::hard::Simulation;
//! use agglo::scenario::{Scenario, template};
//!
//! let text = template("reacting").ok_or("no such template")?.text;
//! let small = ["grains.0.size.length_ratio.count=200", "grains.0.placement.fill.count=200", "time.end=2 ms"];
//! let scenario = Scenario::with_overrides(text, &small)?;
//! let grains = agglo::packing::place(&scenario, "".as_ref())?;
//! let mut simulation = Simulation::start(&scenario, &grains)?;
//! while !simulation.is_finished() {
//!     simulation.advance(simulation.end())?;
//! }
//! assert!(simulation.grains() <= 200 && simulation.balance().unexplained() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where things are
//! | to                                          | look into                                                          |
//! |---------------------------------------------|--------------------------------------------------------------------|
//! | read, change and check a scenario           | [`scenario`]                                                       |
//! | know what it would take                     | [`forecast`]                                                       |
//! | run it into a folder, or without one        | [`run`]                                                            |
//! | read what a run has written                 | [`folder`], [`record`]                                             |
//! | search for the best conditions, or study    | [`search`]                                                         |
//! | let agglomerates grow, then disperse them   | [`hand_over`]                                                      |
//! | drive grains step by step                   | [`engine`], [`packing`]                                            |
//! | use a law alone                             | [`contact`], [`fields`], [`impact`], [`acoustics`]                 |
//! | measure clusters, shapes, pairs             | [`measure`]                                                        |
//! | read what a law says of itself              | [`pages`]                                                          |
//! | draw charts, pictures and pages             | the crate `agglo-view`                                             |
//!
//! # To begin with
//! The folder `examples` of this crate has programs to start from: `own_loop` (steps one by one, with kicks that the ledger knows
//! of), `rays` (sound on given spheres), `collision` (the outcome of one), `own_cost` (an optimizer with a cost of one's own) and
//! `read_run` (what stands in a folder). A loop that does not care for the kind of spheres takes an [`engine::Simulation`].
//!
//! Quantities are in SI units. What can go wrong has an error of its own in each part, and becomes [`Error`] by `?`.
//!
//! The modules stand in the order in which data flows. Those of the physics are of the crate `agglo-core`.

#[cfg(test)]
#[macro_use]
extern crate agglo_testing;

#[doc(inline)]
pub use agglo_core::{
    acoustics, catalog, constants, contact, domain, engine, fields, impact, law, ledger, link, math, measure,
    neighbors, particles, text, units, walls,
};

mod error;
pub mod packing;

pub mod record;

pub mod folder;

pub mod forecast;
pub mod hand_over;
pub mod run;
pub mod scenario;

pub mod search;

pub mod pages;

pub use error::Error;
