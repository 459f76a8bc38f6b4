//! A crowd of grains in which everything happens at once: contacts with history, bonds that break, rays in flight.

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;
use agglo::math::rng::{Purpose, Stream};
use agglo::particles::Particles;

use crate::common;

/// Explicit steps of automatic length.
pub const VERLET: &str = "[engine.verlet]\nsafety = 0.2\n";

/// Iterated steps of changing length.
pub const ADAPTIVE: &str = "[engine.staggered]\ninitial_step = \"20 ns\"\nlargest_step = \"80 ns\"\n\
                            tolerance = 1e-4\ntarget_iterations = 6\n";

/// A scenario of `count` grains, bonded and hit by rays.
pub fn text(engine: &str, count: u32) -> String {
    let reach = 22e-6 * (f64::from(count) / 0.25).cbrt();
    format!(
        r#"
version = 1
seed = 7
[time]
end = "1 s"
{engine}
[limits]
strain = 0.4
[medium]
density = "1000 kg/m3"
sound_speed = "1500 m/s"
viscosity = "1 mPa s"
[materials.pigment]
density = "4000 kg/m3"
sound_speed = "5000 m/s"
youngs_modulus = "1 GPa"
poisson_ratio = 0.25
[[grains]]
material = "pigment"
charge = "1e-12 C"
[grains.size.lognormal]
median = "20 um"
geometric_deviation = 1.3
smallest = "10 um"
largest = "40 um"
[grains.placement.random]
count = {count}
region.sphere = {{ radius = "{reach:e} m" }}
[contact.normal.hertz]
[contact.damping.restitution]
restitution = 0.5
[contact.friction.mindlin]
static_friction = 0.4
dynamic_friction = 0.3
[bonds.beam]
youngs_modulus = "100 MPa"
tensile_strength = "1 MPa"
shear_strength = "1 MPa"
radius_ratio = 0.5
gap = 0.3
forming_strain = 0.01
damping_ratio = 0.05
[fields.drag]
law = "schiller_naumann"
added_mass = 0.5
# A trap, so that grains keep colliding.
[fields.lorentz]
electric_field = ["-3*(10^12)*x", "-3*(10^12)*y", "-3*(10^12)*z"]
[fields.near_field]
cutoff = "100 um"
truncation = 10.0
law.coulomb.relative_permittivity = 80.0
[acoustics]
[acoustics.force.impulse]
duration = "50 ns"
[[acoustics.beams]]
start = ["-{start:e} m", "0 m", "0 m"]
direction = [1.0, 0.0, 0.0]
radius = "0.15 mm"
rays = 600
strength.pressure = "2 MPa"
[acoustics.beams.pulses]
period = "0.4 us"
count = 1000
"#,
        start = 1.1 * reach
    )
}

/// Grains that fall in on one another and spin.
pub fn falling_in(grains: &mut Particles) {
    let mut stream = Stream::new(11, Purpose::Sampling, 0);
    for at in 0..grains.len() {
        grains.velocity[at] = grains.position[at] * -5e3 + stream.direction() * 1.0;
        grains.angular_velocity[at] = Vec3::new(stream.normal(), stream.normal(), stream.normal()) * 1e4;
    }
}

/// A crowd at its start.
pub fn start(engine: &str, count: u32) -> Simulation {
    common::start(&text(engine, count), falling_in)
}

/// Asserts that a crowd has all that a contract is to be tested with.
pub fn assert_busy(simulation: &Simulation) {
    let touching = simulation.system.remembered();
    let sheared = touching.iter().filter(|(_, _, spring)| spring.force.norm() > 0.0).count();
    assert!(sheared > 0, "no contact with history among {}", touching.len());
    assert!(!simulation.system.network.bonds().is_empty(), "no bond is left");
    assert!(!simulation.pulses.flight().rays().is_empty(), "no rays in flight");
    assert!(simulation.events.iter().any(|event| event.broke.is_some()), "no bond broke");
    assert!(simulation.events.iter().any(|event| event.broke.is_none()), "no bond was made");
}
