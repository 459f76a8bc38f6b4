//! How fast the event-driven engine is, and how much memory it takes: an elastic gas in a periodic cube.
//!
//! `cargo run --release -p agglo --example gas -- 100000 0.25 2` asks for 100,000 spheres that fill a quarter of the
//! volume, and 2 impacts for each of them, after one for warming up.

#![allow(clippy::print_stdout, reason = "it is a program")]

#[path = "../benches/gas/mod.rs"]
mod gas;

use std::error::Error;
use std::time::Instant;

/// Most memory in use so far [bytes]; unknown where the system does not say.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kilobytes)
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let argument = |at: usize, default: &str| arguments.get(at).map_or(default.to_owned(), Clone::clone);
    let spheres: u32 = argument(0, "10000").parse()?;
    let solid_fraction: f64 = argument(1, "0.25").parse()?;
    let collisions: f64 = argument(2, "10").parse()?;

    let before = peak_memory();
    let clock = Instant::now();
    let mut simulation = gas::start(spheres, solid_fraction);
    println!(
        "{spheres} spheres, solid fraction {solid_fraction}: placed in {:.3} s",
        clock.elapsed().as_secs_f64()
    );
    // An impact has two partners.
    gas::collide(&mut simulation, u64::from(spheres / 2));

    let (impacts, events, time) =
        (gas::impacts(&simulation), simulation.clock().step, simulation.clock().time);
    let clock = Instant::now();
    gas::collide(&mut simulation, (0.5 * collisions * f64::from(spheres)) as u64);
    let seconds = clock.elapsed().as_secs_f64();
    let impacts = (gas::impacts(&simulation) - impacts) as f64;
    let events = (simulation.clock().step - events) as f64;
    let rate = 2.0 * impacts / (f64::from(spheres) * (simulation.clock().time - time));
    println!("{impacts} impacts in {seconds:.3} s: {:.4} million impacts/s", 1e-6 * impacts / seconds);
    println!("{:.3} events/impact, {rate:.4} impacts/s of simulated time for each sphere", events / impacts);
    if let (Some(before), Some(peak)) = (before, peak_memory()) {
        let each = (peak - before) / f64::from(spheres);
        println!("{:.1} MB at the most, {each:.0} bytes a sphere", 1e-6 * peak);
    }
    Ok(())
}
