//! What any collision of two grains keeps, under any combination of laws.

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::common;

const NORMAL: [&str; 3] = [
    "[contact.normal.hertz]",
    "[contact.normal.hooke]\nstiffness = \"5 kN/m\"",
    "[contact.normal.strain_power]\nexponent = 1.5",
];
const DAMPING: [&str; 3] = [
    "",
    "[contact.damping.restitution]\nrestitution = 0.5",
    "[contact.damping.viscous_area]\ncoefficient = \"1e6 Pa s/m\"",
];
const FRICTION: [&str; 3] = [
    "",
    "[contact.friction.mindlin]\nstatic_friction = 0.5\ndynamic_friction = 0.3\nstiffness_ratio = 0.8\ndashpot = 0.5",
    "[contact.friction.regularized]\nstiffness = \"1e12 Pa/m\"\nstatic_friction = 0.5\ndynamic_friction = 0.5",
];
const BOND: [&str; 3] = [
    "",
    "[bonds.strain_bond]\nstiffness = \"1 MPa\"\nexponent = 2.0\ntangential_stiffness = \"1e3 Pa/m\"\n\
     threshold_strain = 0.001",
    "[bonds.beam]\nyoungs_modulus = \"10 MPa\"\ntensile_strength = \"0.1 MPa\"\nshear_strength = \"0.1 MPa\"\n\
     forming_strain = 0.001\nradius_ratio = 0.5\ndamping_ratio = 0.1",
];

#[derive(Clone, Debug)]
struct CollidingPair {
    laws: String,
    engine: String,
    /// Second radius over the first.
    ratio: f64,
    /// Directions and speeds, in a frame that may be turned.
    normal: Vec3,
    velocity: Vec3,
    angular_velocities: [Vec3; 2],
}

impl CollidingPair {
    fn turned(&self, axis: Vec3, angle: f64) -> Self {
        let turn = |vector: Vec3| vector.rotated_about(axis, angle);
        let Self { laws, engine, ratio, normal, velocity, angular_velocities } = self.clone();
        Self {
            laws,
            engine,
            ratio,
            normal: turn(normal),
            velocity: turn(velocity),
            angular_velocities: angular_velocities.map(turn),
        }
    }

    /// What the laws read of the material.
    fn constants(&self) -> &'static str {
        if self.laws.contains("normal.hertz") {
            "youngs_modulus = \"50 MPa\"\npoisson_ratio = 0.25\n"
        } else if self.laws.contains("strain_power") {
            "contact_stiffness = \"10 MPa\"\n"
        } else {
            ""
        }
    }

    /// Two grains, a hundredth of a radius apart, and the first 600 steps.
    fn run(&self) -> (Simulation, Simulation) {
        let group = |radius: f64, at: f64| {
            format!(
                "[[grains]]\nmaterial = \"only\"\n[grains.size.constant]\nradius = \"{radius:e} m\"\n\
                 [grains.placement.list]\npositions = [[\"{at:e} m\", \"0 m\", \"0 m\"]]\n"
            )
        };
        let text = format!(
            "version = 1\n[time]\nend = \"1 s\"\n{}\n[limits]\nstrain = 0.5\n[materials.only]\n\
             density = \"2500 kg/m3\"\n{}{}{}{}",
            self.engine,
            self.constants(),
            group(1e-3, 0.0),
            group(self.ratio * 1e-3, 1.0),
            self.laws
        );
        let set = || {
            common::start(&text, |grains| {
                let reach = grains.radius[0] + grains.radius[1];
                grains.position = vec![Vec3::ZERO, self.normal * (reach + 1e-5)];
                grains.velocity = vec![self.velocity * 0.5, self.velocity * -0.5];
                grains.angular_velocity = self.angular_velocities.to_vec();
            })
        };
        let (start, mut end) = (set(), set());
        common::steps(&mut end, 600);
        (start, end)
    }
}

fn unit() -> impl Strategy<Value = Vec3> {
    (-1.0..1.0_f64, 0.0..std::f64::consts::TAU).prop_map(|(z, angle)| {
        let flat = (1.0 - z * z).sqrt();
        Vec3::new(flat * angle.cos(), flat * angle.sin(), z)
    })
}

fn pair() -> impl Strategy<Value = CollidingPair> {
    let laws = (0..3_usize, 0..3_usize, 0..3_usize, 0..3_usize, any::<bool>());
    let motion = (unit(), unit(), unit(), unit(), 0.5..2.0_f64, 0.0..0.9_f64);
    (laws, motion, 0.25..4.0_f64).prop_map(|((n, d, f, b, implicit), motion, ratio)| {
        let (normal, sideways, angular_velocity, other, speed, slant) = motion;
        let laws = [NORMAL[n], DAMPING[d], FRICTION[f], BOND[b]].join("\n");
        let engine = if implicit { common::staggered(1e-6, 1e-9, 0.5) } else { common::verlet(1e-6) };
        let velocity = (normal * (1.0 - slant) + sideways.rejected_from(normal) * slant) * speed;
        CollidingPair {
            laws,
            engine,
            ratio,
            normal,
            velocity,
            angular_velocities: [angular_velocity * 300.0, other * 300.0],
        }
    })
}

fn config() -> ProptestConfig {
    let default = ProptestConfig { failure_persistence: None, ..ProptestConfig::default() };
    let rng_seed = match default.rng_seed {
        RngSeed::Random => RngSeed::Fixed(1),
        fixed @ RngSeed::Fixed(_) => fixed,
    };
    ProptestConfig { rng_seed, ..default }
}

proptest! {
    // The same cases every time; more of them and others with PROPTEST_CASES and PROPTEST_RNG_SEED.
    #![proptest_config(config())]

    /// Linear momentum to round-off. Angular momentum too, but for what the scheme's finite step turns the normal
    /// by: second order, 1e-4 of the angular momentum that the pair has.
    #[test]
    fn momentum_is_kept(pair in pair()) {
        let (start, end) = pair.run();
        let (before, after, size) = (start.momentum(), end.momentum(), start.momentum_size());
        prop_assert!((after.linear - before.linear).norm() < 1e-13 * size);
        let lever = (1.0 + pair.ratio) * 1e-3;
        let turned = (after.angular - before.angular).norm() / (size * lever);
        prop_assert!(turned < 1e-4, "angular momentum off by {turned:e}");
        if pair.laws.contains("friction") || pair.laws.contains("damping") {
            let (a, b) = (start.stored_energy().mechanical(), end.stored_energy().mechanical());
            prop_assert!(b < a * (1.0 + 1e-3), "energy rose from {a:e} to {b:e}");
        }
    }

    /// A collision seen from a turned frame is the turned collision; rounding grows with the hundreds of steps.
    /// Steps are explicit: rounding would decide here and there which step the iterated scheme rejects.
    #[test]
    fn no_direction_is_special(pair in pair(), axis in unit(), angle in 0.1..3.0_f64) {
        let pair = CollidingPair { engine: common::verlet(1e-6), ..pair };
        let (_, plain) = pair.run();
        let (_, turned) = pair.turned(axis, angle).run();
        for id in [0, 1] {
            let (a, b) = (common::grain(&plain, id), common::grain(&turned, id));
            let apart = (a.position.rotated_about(axis, angle) - b.position).norm();
            prop_assert!(apart < 1e-12, "positions differ by {apart:e}");
            let apart = (a.velocity.rotated_about(axis, angle) - b.velocity).norm();
            prop_assert!(apart < 1e-8, "velocities differ by {apart:e}");
            let apart = (a.angular_velocity.rotated_about(axis, angle) - b.angular_velocity).norm();
            prop_assert!(apart < 1e-5, "angular velocities differ by {apart:e}");
        }
    }
}
