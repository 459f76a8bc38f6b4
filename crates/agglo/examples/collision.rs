//! The outcome of one collision, for a range of speeds: how two hot grains rebound, warm up, and from which speed on they stick.
//!
//! `cargo run --release -p agglo --example collision`

#![allow(clippy::print_stdout, reason = "it is a program")]

use agglo::impact::{Body, Impact, ImpactLaws};
use agglo::math::Vec3;
use agglo::scenario::{Scenario, template};

fn main() -> Result<(), agglo::Error> {
    // The laws and the material of the shipped cloud that reacts; any scenario of hard spheres will do.
    let text = template("reacting").map_or("", |template| template.text);
    let scenario = Scenario::from_toml(text)?;
    let Some(impact): Option<&Impact> = scenario.impact() else { return Ok(()) };
    let laws = ImpactLaws::new(impact, &scenario.materials, &scenario.mixtures);
    let Some(material) = scenario.materials.values().next() else { return Ok(()) };

    let radius = 0.8e-3;
    let mass = material.mass_of_sphere(radius);
    let heat_capacity = mass * material.specific_heat();
    let grain = |velocity| Body {
        velocity,
        mass,
        radius,
        temperature: 502.0,
        heat_capacity,
        material: 0,
        primaries: 1,
    };
    println!("{:>10} {:>12} {:>14}  outcome", "speed m/s", "restitution", "kinetic J");
    for speed in [0.1, 0.3, 1.0, 3.0, 10.0, 15.0, 20.0, 50.0] {
        let bodies = [grain(Vec3::new(0.5 * speed, 0.0, 0.0)), grain(Vec3::new(-0.5 * speed, 0.0, 0.0))];
        let outcome = laws.impact([&bodies[0], &bodies[1]], Vec3::new(1.0, 0.0, 0.0));
        let kinetic: f64 =
            outcome.velocities.iter().map(|velocity| 0.5 * mass * velocity.norm_squared()).sum();
        let words = if outcome.sticks {
            "they become one sphere".to_owned()
        } else if outcome.fragments == [1; 2] {
            "they rebound".to_owned()
        } else {
            format!("they break into {} and {}", outcome.fragments[0], outcome.fragments[1])
        };
        println!("{speed:>10} {:>12.4} {kinetic:>14.3e}  {words}", outcome.restitution);
    }
    Ok(())
}
