//! An optimizer with a cost of one's own: which push of the sound disperses a small agglomerate best for the energy that it takes?
//!
//! `cargo run --release -p agglo --example own_cost`
//!
//! `agglo search` does this with formulas, replicates, a journal and a report. Where the cost is no formula of a run's quantities, ask
//! the optimizer yourself: it hands out points of the unit cube and wants to know what they cost.

#![allow(clippy::print_stdout, reason = "it is a program")]

use std::path::Path;
use std::sync::atomic::AtomicBool;

use agglo::run::{Ending, Summary, quiet};
use agglo::scenario::{Scenario, template};
use agglo::search::Fitness;
use agglo::search::functions::minimize;
use agglo::search::optimizer::CmaEs;

/// The scenario at a point of the unit square: pressure and radius of the beam, each on a scale of equal ratios.
fn scenario(point: &[f64]) -> Result<Scenario, agglo::Error> {
    let pressure = 5e6 * 40_f64.powf(point[0]);
    let radius = 0.1 * 10_f64.powf(point[1]);
    let text = template("acoustic").map_or("", |template| template.text);
    let settings = [
        "grains.0.placement.random.count=100".to_owned(),
        "acoustics.beams.0.rays=1000".to_owned(),
        "acoustics.beams.0.pulses.count=1".to_owned(),
        "time.end=20 ms".to_owned(),
        format!("acoustics.beams.0.strength.pressure={pressure} Pa"),
        format!("acoustics.beams.0.radius={radius} m"),
    ];
    Ok(Scenario::with_overrides(text, &settings)?)
}

/// Megajoules for each part of the bonds that breaks; a failure where none does.
fn cost(point: &[f64]) -> Result<Fitness, agglo::Error> {
    let ending = quiet(&scenario(point)?, Path::new(""), &AtomicBool::new(false))?;
    let Ending::Finished(Summary::Soft(summary)) = ending else { return Ok(Fitness::failed()) };
    let broken = summary.bonds_broken_fraction.unwrap_or(0.0);
    Ok(if broken > 0.0 {
        Fitness::new(vec![1e-6 * summary.acoustic_energy / broken])
    } else {
        Fitness::failed()
    })
}

fn main() -> Result<(), agglo::Error> {
    let mut search = CmaEs { evaluations: 60, ..CmaEs::default() }.start(2, 1);
    let best = minimize(&mut search, 60, |point, number| {
        let fitness = cost(point).unwrap_or_else(|error| {
            println!("evaluation {number} failed: {error}");
            Fitness::failed()
        });
        println!("{number:>3}: {:.3} {:.3} costs {:.4}", point[0], point[1], fitness.cost());
        fitness
    });
    if let Some(point) = best {
        let found = scenario(&point)?;
        let beam = found.acoustics().map(|acoustics| &acoustics.beams[0]);
        println!("best: {beam:#?}");
    }
    Ok(())
}
