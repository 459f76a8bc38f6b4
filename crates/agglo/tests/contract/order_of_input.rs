//! The order in which a scenario lists its grains is not physics.

use agglo::math::Vec3;

use crate::common::{self, Listed};

/// Grains on a jittered lattice that move toward its middle, listed in this order; velocities by lattice place.
fn after(order: &[usize], engine: &str) -> Vec<Vec3> {
    let place = |k: usize| {
        let along = |n: usize| 2.2e-3 * n as f64;
        let jitter = 0.1e-3 * (k as f64 * 2.4).sin();
        [along(k % 3) + jitter, along(k / 3 % 3) - jitter, along(k / 9) + 0.5 * jitter]
    };
    let listed = Listed {
        material: "density = \"2500 kg/m3\"\nyoungs_modulus = \"50 MPa\"\npoisson_ratio = 0.25",
        radius: 1e-3,
        positions: order.iter().map(|k| place(*k)).collect(),
        end: 0.6e-3,
        engine: engine.to_owned(),
        more: "[contact.normal.hertz]\n[contact.damping.restitution]\nrestitution = 0.7\n\
               [contact.friction.mindlin]\nstatic_friction = 0.4\n[bonds.beam]\nyoungs_modulus = \"5 MPa\"\n\
               tensile_strength = \"0.1 MPa\"\nshear_strength = \"0.1 MPa\"\ngap = 0.15\nradius_ratio = 0.5"
            .to_owned(),
    };
    let mut simulation = listed.start(|grains| {
        let middle = Vec3::new(2.2e-3, 2.2e-3, 2.2e-3);
        for (at, k) in order.iter().enumerate() {
            grains.velocity[at] = (middle - grains.position[at]) * 400.0;
            grains.angular_velocity[at] = Vec3::AXES[k % 3] * 200.0;
        }
    });
    let mut touched = 0;
    common::watch(&mut simulation, |now| touched += u32::from(now.system.trial.contact.worst_strain > 0.0));
    assert_above!(touched, 100);
    assert_any!(simulation.events.iter(), |event| event.broke.is_some());
    let id_of = |k: usize| order.iter().position(|listed| *listed == k).unwrap() as u32;
    (0..order.len()).map(|k| common::grain(&simulation, id_of(k)).position).collect()
}

/// Sums are rounded in another order and collisions amplify that, over so short a time by less than 1e-9 of a radius.
#[test]
fn grains_in_any_order_move_alike() {
    let forth: Vec<usize> = (0..27).collect();
    let shuffled: Vec<usize> = (0..27).map(|k| k * 10 % 27).collect();
    for engine in [common::verlet(0.2e-6), common::staggered(0.2e-6, 1e-12, 0.5)] {
        let (a, b) = (after(&forth, &engine), after(&shuffled, &engine));
        for (a, b) in a.iter().zip(&b) {
            assert!((*a - *b).norm() < 1e-12, "{a:?} and {b:?}: {engine}");
        }
    }
}
