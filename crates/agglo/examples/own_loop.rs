//! A loop of one's own over the steps: an agglomerate is tapped on one side every tenth of a millisecond, until a bond breaks.
//!
//! `cargo run --release -p agglo --example own_loop`

#![allow(clippy::print_stdout, reason = "it is a program")]

use std::path::Path;

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;
use agglo::scenario::{Scenario, template};

/// The shipped agglomerate, small and without sound.
fn scenario() -> Result<Scenario, agglo::Error> {
    let text = template("acoustic").map_or("", |template| template.text);
    let small = [
        "grains.0.placement.random.count=100",
        "acoustics.beams.0.rays=1",
        "acoustics.beams.0.pulses.count=1",
    ];
    let mut scenario = Scenario::with_overrides(text, &small)?;
    if let Some(soft) = scenario.soft_mut() {
        soft.acoustics = None;
    }
    Ok(scenario)
}

fn main() -> Result<(), agglo::Error> {
    let scenario = scenario()?;
    let grains = agglo::packing::place(&scenario, Path::new(""))?;
    let mut simulation = Simulation::start(&scenario, grains)?;
    let bonds = simulation.system.network.bonds().len();
    let mut taps = 0_u32;
    while simulation.system.network.bonds().len() == bonds && !simulation.is_finished() {
        if simulation.clock().time >= 1e-4 * f64::from(taps) {
            let grains = &simulation.system.grains;
            let leftmost =
                (0..grains.len()).min_by(|&a, &b| grains.position[a].x.total_cmp(&grains.position[b].x));
            let Some(leftmost) = leftmost else { break };
            // 1 m/s more for a grain of 3 kg; the ledger has the work of it.
            simulation.kick(leftmost, Vec3::new(3.0, 0.0, 0.0));
            taps += 1;
        }
        simulation.step()?;
    }
    let balance = simulation.balance();
    println!("{taps} taps in {:.3e} s put in {:.3e} J", simulation.clock().time, balance.custom);
    for event in &simulation.events {
        println!("{event:?}");
    }
    println!("the ledger leaves {:.1e} of the energy unexplained", balance.drift_relative.abs());
    Ok(())
}
