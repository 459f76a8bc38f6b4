//! Oblique impacts: sliding, rotation, energy, and what unequal sizes must keep.

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;
use agglo::particles::Particles;

use crate::common::{self, Listed, relative_velocity};
use crate::impact::before_a_plane;

const RADIUS: f64 = 2.5e-3;

/// Two equal grains that touch along x.
fn pair(more: &str) -> Listed {
    Listed {
        material: "density = \"4000 kg/m3\"\nyoungs_modulus = \"10 GPa\"\npoisson_ratio = 0.23\n\
                   contact_stiffness = \"1 GPa\"",
        radius: RADIUS,
        positions: vec![[-RADIUS, 0.0, 0.0], [RADIUS, 0.0, 0.0]],
        end: 1.0,
        engine: common::verlet(2e-8),
        more: more.to_owned(),
    }
}

/// The second grain comes with `velocity` relative to the first; the center of mass rests.
fn coming(velocity: Vec3) -> impl FnOnce(&mut Particles) {
    move |grains: &mut Particles| {
        grains.velocity[0] = velocity * -0.5;
        grains.velocity[1] = velocity * 0.5;
    }
}

fn is_apart(simulation: &Simulation) -> bool {
    simulation.system.trial.contact.worst_strain <= 0.0
}

/// Steps until the grains part; `look` sees every step.
fn collide(simulation: &mut Simulation, mut look: impl FnMut(&Simulation)) {
    for _ in 0..1_000_000 {
        common::steps(simulation, 1);
        look(simulation);
        if is_apart(simulation) {
            return;
        }
    }
    panic!("the grains do not part");
}

/// Gross sliding of two equal spheres. The impulse J_n = m* (1 + e) v_n brings μ J_n along the contact; with
/// m* = m/2 and I = (2/5) m R² the relative velocity of the centers falls by μ (1 + e) v_n and each angular velocity
/// becomes μ J_n R/I = (5/4) μ (1 + e) v_n/R. Sliding lasts where v_t > (7/2) μ (1 + e) v_n.
///
/// 0.5 %: the normal turns while the grains touch, by some 2e-3 for Hertz; velocities are of the turned contact.
#[test]
fn val_gross_sliding_of_two_spheres() {
    let (friction, restitution) = (0.092, 0.98);
    for laws in ["hertz", "hooke"] {
        let normal = if laws == "hertz" { "" } else { "stiffness = \"3 MN/m\"" };
        let more = format!(
            "[contact.normal.{laws}]\n{normal}\n[contact.damping.restitution]\nrestitution = {restitution}\n\
             [contact.friction.mindlin]\nstatic_friction = {friction}"
        );
        let (v_n, v_t) = (0.01, 0.02);
        let mut simulation = pair(&more).start(coming(Vec3::new(-v_n, v_t, 0.0)));
        collide(&mut simulation, |_| {});
        let slowed = friction * (1.0 + restitution) * v_n;
        let found = v_t - relative_velocity(&simulation).y;
        common::found(&format!("sliding_{laws}"), &[("off", found / slowed - 1.0)]);
        assert!((found / slowed - 1.0).abs() < 0.005, "{laws}: {found} for {slowed}");
        for id in [0, 1] {
            let angular_velocity = common::grain(&simulation, id).angular_velocity;
            // The second grain's surface at the contact moves along +y past the first: both turn about +z.
            let wanted = 1.25 * slowed / RADIUS;
            common::found("sliding_spins", &[("off", angular_velocity.z / wanted - 1.0)]);
            assert!(
                (angular_velocity.z / wanted - 1.0).abs() < 0.002,
                "{laws}: {angular_velocity:?} for {wanted}"
            );
        }
    }
}

/// Chung and Ooi 2011, test 7: equal spheres that spin against each other have surfaces at rest against each
/// other in the contact. Nothing slips, so angular velocities keep their bits and no sideways velocity comes.
#[test]
fn val_chung_ooi_2011_counter_spin() {
    for engine in [common::verlet(2e-8), common::staggered(2e-8, 1e-9, 0.5)] {
        let listed = Listed {
            engine,
            ..pair("[contact.normal.hertz]\n[contact.friction.mindlin]\nstatic_friction = 0.4")
        };
        let mut simulation = listed.start(|grains| {
            coming(Vec3::new(-0.2, 0.0, 0.0))(grains);
            grains.angular_velocity[0].z = 175.0;
            grains.angular_velocity[1].z = -175.0;
        });
        collide(&mut simulation, |_| {});
        let angular_velocities = [0, 1].map(|id| common::grain(&simulation, id).angular_velocity);
        assert_eq!(angular_velocities, [Vec3::new(0.0, 0.0, 175.0), Vec3::new(0.0, 0.0, -175.0)]);
        let apart = relative_velocity(&simulation);
        assert_eq!((apart.y, apart.z), (0.0, 0.0));
    }
}

/// A stiff hit at 76 degrees with μ = 0.5: kinetic energy and that in springs never rise above the start.
///
/// Elastic normal contact gives back what it took to the order of the step squared: 3e-6 at 2500 steps a contact.
#[test]
fn energy_never_rises_at_76_degrees() {
    let angle = 76_f64.to_radians();
    for normal in [
        "[contact.normal.hertz]",
        "[contact.normal.hooke]\nstiffness = \"3 MN/m\"",
        "[contact.normal.strain_power]\nexponent = 1.5",
    ] {
        for damping in ["", "[contact.damping.restitution]\nrestitution = 0.9"] {
            for friction in [
                "[contact.friction.mindlin]\nstatic_friction = 0.5\nstiffness_ratio = 0.8",
                "[contact.friction.mindlin]\nstatic_friction = 0.5\ndynamic_friction = 0.3\nstiffness_ratio = 0.8\ndashpot = 1.0",
                "[contact.friction.regularized]\nstiffness = \"1e18 Pa/m\"\nstatic_friction = 0.5\ndynamic_friction = 0.5",
            ] {
                let more = format!("{normal}\n{damping}\n{friction}");
                let velocity = Vec3::new(-angle.cos(), angle.sin(), 0.0);
                let mut simulation = pair(&more).start(coming(velocity));
                let start = common::kinetic(&simulation);
                collide(&mut simulation, |now| {
                    let energy = now.stored_energy().mechanical();
                    assert!(energy < start * (1.0 + 3e-6), "{energy} of {start}: {more}");
                });
                let end = common::kinetic(&simulation);
                common::found("at_76_degrees", &[("left", end / start)]);
                assert!(end < start * 0.9, "friction took nothing: {more}");
            }
        }
    }
}

/// Sizes 1 to 8, oblique, with rotation: whatever friction does, momentum is kept to round-off, and angular momentum
/// to the order of the step squared (the scheme's force acts along the normal at both ends of a step, not between).
#[test]
fn unequal_sizes_keep_momentum_and_angular_momentum() {
    let text = "version = 1\n[time]\nend = \"1 s\"\n[engine.verlet]\nstep = \"5 ns\"\n[materials.only]\n\
                density = \"4000 kg/m3\"\nyoungs_modulus = \"10 GPa\"\npoisson_ratio = 0.23\n\
                [[grains]]\nmaterial = \"only\"\n[grains.size.constant]\nradius = \"0.5 mm\"\n\
                [grains.placement.list]\npositions = [[\"-0.5 mm\", \"0 m\", \"0 m\"]]\n\
                [[grains]]\nmaterial = \"only\"\n[grains.size.constant]\nradius = \"4 mm\"\n\
                [grains.placement.list]\npositions = [[\"4 mm\", \"0 m\", \"0 m\"]]\n\
                [contact.normal.hertz]\n[contact.damping.restitution]\nrestitution = 0.7\n\
                [contact.friction.mindlin]\nstatic_friction = 0.3\ndashpot = 0.5";
    let mut simulation = common::start(text, |grains| {
        grains.velocity[0] = Vec3::new(1.0, 1.5, -0.5);
        grains.angular_velocity[0] = Vec3::new(100.0, 300.0, -700.0);
        grains.angular_velocity[1] = Vec3::new(50.0, -20.0, 30.0);
    });
    let (start, size) = (simulation.momentum(), simulation.momentum_size());
    let angular_velocities = common::grain(&simulation, 0).angular_velocity;
    collide(&mut simulation, |_| {});
    assert!(
        (common::grain(&simulation, 0).angular_velocity - angular_velocities).norm() > 10.0,
        "no friction"
    );
    let end = simulation.momentum();
    assert_near_vector!(end.linear, start.linear, 1e-14 * size);
    let turned = (end.angular - start.angular).norm();
    let moved = (end.linear - start.linear).norm() / size;
    common::found("unequal_sizes", &[("momentum", moved), ("moment", turned / (size * 0.5e-3))]);
    assert!(turned < 1e-11 * size * 0.5e-3, "{turned:e} of {:e}", size * 0.5e-3);
}

/// Tangential restitution against the measurements of A. H. Kharaz, D. A. Gorham and A. D. Salman, Powder Technol.
/// 120, 281 (2001), as in test 4 of Chung and Ooi: alumina on a thick glass plate, 3.9 m/s.
///
/// 0.5 %: digits of the measurement are 0.1 %, and sliding over the whole contact, 1 - μ (1 + e)/tan θ, is met to 0.3 %.
/// At 5 degrees grains slip over part of the contact only, which a single tangential spring leaves out: 0.845, not 0.948.
#[test]
fn val_kharaz_2001_tangential_restitution() {
    for (degrees, measured, tolerance) in [
        (5.17_f64, 0.948, 0.12),
        (20.06, 0.616, 0.005),
        (40.02, 0.781, 0.005),
        (59.98, 0.893, 0.005),
        (80.02, 0.966, 0.005),
    ] {
        let angle = degrees.to_radians();
        let found = kharaz(angle);
        assert!((found / measured - 1.0).abs() < tolerance, "{found} for {measured} at {degrees}");
        let sliding = 0.092 * 1.98 / angle.tan();
        common::found("kharaz", &[("restitution", found), ("off", found / measured - 1.0)]);
        if sliding < 2.0 / 7.0 {
            assert!((found / (1.0 - sliding) - 1.0).abs() < 0.003, "{found} for {}", 1.0 - sliding);
        }
    }
}

fn kharaz(angle: f64) -> f64 {
    let alumina = "density = \"4000 kg/m3\"\nyoungs_modulus = \"380 GPa\"\npoisson_ratio = 0.23";
    let more = "[contact.normal.hertz]\n[contact.damping.restitution]\nrestitution = 0.98\n\
                [contact.friction.mindlin]\nstatic_friction = 0.092";
    let glass = "youngs_modulus = \"70 GPa\"\npoisson_ratio = 0.25";
    let text = before_a_plane(RADIUS, alumina, glass, &common::verlet(2e-9), more);
    let mut simulation = common::start(&text, |grains| {
        grains.velocity[0] = Vec3::new(-angle.cos(), angle.sin(), 0.0) * 3.9;
    });
    collide(&mut simulation, |_| {});
    common::grain(&simulation, 0).velocity.y / (3.9 * angle.sin())
}
