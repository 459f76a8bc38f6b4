//! Rays of sound on given spheres: no scenario, no clock. Which of two spheres, one in the shadow of the other, is pushed how
//! hard, and how much of the sound gets past them?
//!
//! `cargo run --release -p agglo --example rays`

#![allow(clippy::print_stdout, reason = "it is a program")]

use agglo::acoustics::fresnel::Interface;
use agglo::acoustics::{Beam, Ends, Flight, Medium, Pattern, Profile, Pulses, Strength, Targets, Tracer};
use agglo::math::Vec3;
use agglo::units::Quantity;

/// Centers [m] and radii [m].
const SPHERES: [(Vec3, f64); 2] = [(Vec3::new(0.0, 0.0, 0.0), 1e-3), (Vec3::new(4e-3, 1e-3, 0.0), 1e-3)];

fn main() {
    let water = Medium::default();
    let glass = Interface::new(&water, 2500.0, 5600.0, 3400.0);
    let beam = Beam {
        start: [-5e-3, 0.0, 0.0].map(Quantity),
        direction: [1.0, 0.0, 0.0],
        radius: Quantity(3e-3),
        rays: 100_000,
        strength: Strength::Power(Quantity(1.0)),
        pattern: Pattern::Random,
        profile: Profile::Uniform,
        pulses: Pulses::default(),
        frequency: None,
    };
    let (positions, radii) =
        SPHERES.map(|(center, radius)| (center, radius)).into_iter().unzip::<_, _, Vec<_>, Vec<_>>();
    let targets = Targets { positions: &positions, radii: &radii, material: &[0, 0], mach: 0.0 };
    let mut flight = Flight::default();
    flight.launch(&beam, &water, 1, 0, 0);
    let mut tracer = Tracer::new(Ends::default(), vec![glass]);

    // What a ray of power P brings along a direction d is P d/c; what it takes away is reflected.
    let mut pushes = [Vec3::ZERO; 2];
    for hit in tracer.trace(&mut flight, &targets) {
        let change = hit.direction_in - hit.direction_out * hit.reflectance;
        pushes[hit.grain as usize] += change * (hit.power_in / water.sound_speed.si());
    }
    for ((center, radius), push) in SPHERES.iter().zip(pushes) {
        println!(
            "sphere of {:.1} mm at x = {:.0} mm, y = {:.0} mm: pushed by ({:+.2}, {:+.2}, {:+.2}) uN a watt",
            1e3 * radius,
            1e3 * center.x,
            1e3 * center.y,
            1e6 * push.x,
            1e6 * push.y,
            1e6 * push.z
        );
    }
    let pulse = &flight.pulses()[0];
    println!(
        "{} reflections; {:.1} % of the power is taken by the spheres, {:.1} % leaves",
        pulse.reflections,
        100.0 * pulse.power_absorbed / pulse.power_in,
        100.0 * pulse.power_escaped / pulse.power_in
    );
}
