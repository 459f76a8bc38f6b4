//! Tests of the parallel bond: one bond by hand, then bonded grains in motion.

use super::*;
use crate::math::rng::{Purpose, Stream};
use crate::units::Quantity;

const RADIUS: f64 = 1e-3;
const N: Vec3 = Vec3::AXES[0];
const SIDE: Vec3 = Vec3::AXES[1];

fn beam(damping_ratio: f64) -> Beam {
    Beam {
        youngs_modulus: Quantity(2e9),
        shear_ratio: 0.3,
        radius_ratio: 0.8,
        tensile_strength: Quantity(3e6),
        shear_strength: Quantity(2e6),
        gap: 0.0,
        forming_strain: None,
        damping_ratio,
    }
}

/// k_n A, k_s A, k_n I and k_s J of a bond of length 2.5 mm and radius 0.8 mm, by hand.
fn by_hand() -> [f64; 4] {
    let (normal, shear, r) = (2e9 / 2.5e-3, 0.3 * 2e9 / 2.5e-3, 0.8e-3_f64);
    let area = PI * r * r;
    [normal * area, shear * area, normal * PI * r.powi(4) / 4.0, shear * PI * r.powi(4) / 2.0]
}

fn at_rest() -> (BeamState, BeamPair) {
    let state = beam(0.0).new_state(RADIUS, 1.4e-3, 2.5e-3, N);
    (state, BeamPair { distance: 2.5e-3, normal: N, lever_arms: [1.1e-3, 1.4e-3], ..Default::default() })
}

#[test]
fn stiffness_of_the_four_modes() {
    let [normal, shear, bending, twist] = by_hand();
    let (state, rest) = at_rest();
    let law = beam(0.0);
    let (load, after) = law.advance(&state, &BeamPair { distance: 2.5e-3 + 1e-6, ..rest });
    assert_close_vector!(load.force, N * (normal * 1e-6), 1e-9, "in N");
    assert_close!(law.energy(&after, 2.5e-3 + 1e-6), 0.5 * normal * 1e-12, 1e-9, "in J");
    let (load, after) = law.advance(&state, &BeamPair { displacement: SIDE * 1e-6, ..rest });
    assert_close_vector!(load.force, SIDE * (shear * 1e-6), 1e-9, "in N");
    assert_close_vector!(load.torque_i, Vec3::AXES[2] * (shear * 1e-6 * 1.1e-3), 1e-9, "in N m");
    assert_close_vector!(load.torque_j, Vec3::AXES[2] * (shear * 1e-6 * 1.4e-3), 1e-9, "in N m");
    assert_close!(law.energy(&after, 2.5e-3), 0.5 * shear * 1e-12, 1e-9, "in J");
    let (load, after) = law.advance(&state, &BeamPair { rotation: SIDE * 1e-3, ..rest });
    assert_close_vector!(load.torque_i, SIDE * (bending * 1e-3), 1e-9, "in N m");
    assert_close_vector!(load.torque_j, SIDE * (-bending * 1e-3), 1e-9, "in N m");
    assert_close!(law.energy(&after, 2.5e-3), 0.5 * bending * 1e-6, 1e-9, "in J");
    let (load, after) = law.advance(&state, &BeamPair { rotation: N * 1e-3, ..rest });
    assert_close_vector!(load.torque_i, N * (twist * 1e-3), 1e-9, "in N m");
    assert_close_vector!(load.torque_j, N * (-twist * 1e-3), 1e-9, "in N m");
    assert_close!(law.energy(&after, 2.5e-3), 0.5 * twist * 1e-6, 1e-9, "in J");
}

/// The least rotation between two normals far apart, against Rodrigues' formula about their common perpendicular, then 0.7
/// about the new normal: to round-off, over 1 + cos where normals are nearly opposite.
#[test]
fn memory_turns_with_the_bond() {
    for tilt in [1e-9_f64, 0.3, 1.4, 3.0] {
        let after = N * tilt.cos() + SIDE * tilt.sin();
        let (turn, round_off) = (Turn::new(N, after, 0.7), 1e-15 / (1.0 + tilt.cos()));
        let across = N.cross(SIDE);
        // The shear across the plane of the tilt stays; that within it tilts along.
        let [tilted, stays] = [N * -tilt.sin() + SIDE * tilt.cos(), across];
        let spun = |v: Vec3| v * 0.7_f64.cos() + after.cross(v) * 0.7_f64.sin();
        assert_near_vector!(turn.of(SIDE), spun(tilted), round_off, "tilt {tilt}");
        assert_near_vector!(turn.of(across), spun(stays), round_off, "tilt {tilt}");
    }
}

/// Tension and bending: F/A + M r/I; shear and twist: S/A + M r/J; compression takes away from the first.
#[test]
fn strength() {
    let [normal, shear, bending, twist] = by_hand();
    let (state, rest) = at_rest();
    let r = 0.8e-3_f64;
    let area = PI * r * r;
    let pair = BeamPair {
        distance: 2.5e-3 + 2e-6,
        displacement: SIDE * 1e-6,
        rotation: SIDE * 1e-3 + N * -2e-3,
        ..rest
    };
    let (load, _) = beam(0.0).advance(&state, &pair);
    let tensile = normal * 2e-6 / area + bending * 1e-3 * r / (PI * r.powi(4) / 4.0);
    let sheared = shear * 1e-6 / area + twist * 2e-3 * r / (PI * r.powi(4) / 2.0);
    assert_close!(load.tensile_use, tensile / 3e6, 1e-9);
    assert_close!(load.shear_use, sheared / 2e6, 1e-9);
    let (load, _) = beam(0.0).advance(&state, &BeamPair { distance: 2.4e-3, ..rest });
    assert_eq!((load.tensile_use, load.breaks()), (0.0, None));
    let to_break = 3e6 * area / normal;
    for (part, broken) in [(0.999, None), (1.001, Some(Break::Tension))] {
        let pair = BeamPair { distance: 2.5e-3 + part * to_break, ..rest };
        assert_eq!(beam(0.0).advance(&state, &pair).0.breaks(), broken);
    }
    let to_break = 2e6 * area / shear;
    for (part, broken) in [(0.999, None), (1.001, Some(Break::Shear))] {
        let pair = BeamPair { displacement: SIDE * (part * to_break), ..rest };
        assert_eq!(beam(0.0).advance(&state, &pair).0.breaks(), broken);
    }
}

#[derive(Clone, Copy, Debug)]
struct Grain {
    position: Vec3,
    velocity: Vec3,
    angular_velocity: Vec3,
    radius: f64,
    mass: f64,
}

impl Grain {
    fn inertia(&self) -> f64 {
        0.4 * self.mass * self.radius * self.radius
    }

    fn push(&mut self, impulse: Vec3, turn: Vec3) {
        self.velocity += impulse / self.mass;
        self.angular_velocity += turn / self.inertia();
    }
}

/// A row of bonded grains.
struct Chain {
    law: Beam,
    grains: Vec<Grain>,
    bonds: Vec<BeamState>,
}

impl Chain {
    fn new(law: Beam, grains: Vec<Grain>) -> Self {
        let bonds = grains.windows(2).map(|two| {
            let across = two[1].position - two[0].position;
            law.new_state(two[0].radius, two[1].radius, across.norm(), across.normalized())
        });
        let bonds = bonds.collect();
        Self { law, grains, bonds }
    }

    fn energy(&self) -> f64 {
        let kinetic: f64 = self
            .grains
            .iter()
            .map(|g| {
                0.5 * (g.mass * g.velocity.norm_squared() + g.inertia() * g.angular_velocity.norm_squared())
            })
            .sum();
        kinetic + self.stored()
    }

    fn stored(&self) -> f64 {
        let bonds = self.bonds.iter().zip(self.grains.windows(2));
        bonds.map(|(bond, two)| self.law.energy(bond, (two[1].position - two[0].position).norm())).sum()
    }

    fn angular_momentum(&self) -> Vec3 {
        self.grains
            .iter()
            .map(|g| g.position.cross(g.velocity * g.mass) + g.angular_velocity * g.inertia())
            .sum()
    }

    fn drift(&mut self, dt: f64) {
        for grain in &mut self.grains {
            grain.position += grain.velocity * dt;
        }
    }

    /// What the bond between two grains sees; the displacement with the normal of the middle of the step.
    fn pair(&self, k: usize, dt: f64) -> BeamPair {
        let (i, j) = (&self.grains[k], &self.grains[k + 1]);
        let across = j.position - i.position;
        let (distance, normal) = (across.norm(), across.normalized());
        let velocity = j.velocity - i.velocity;
        let middle = (across - velocity * (0.5 * dt)).normalized();
        let lever_arms = crate::contact::lever_arms([i.radius, j.radius], distance);
        let levers = i.angular_velocity * lever_arms[0] + j.angular_velocity * lever_arms[1];
        BeamPair {
            distance,
            normal,
            lever_arms,
            displacement: (velocity - levers.cross(middle)).rejected_from(middle) * dt,
            rotation: (j.angular_velocity - i.angular_velocity) * dt,
            turn_about_normal: 0.5 * dt * (i.angular_velocity + j.angular_velocity).dot(middle),
            separation_speed: velocity.dot(normal),
            slip: (velocity - levers.cross(normal)).rejected_from(normal),
            angular_velocity_difference: j.angular_velocity - i.angular_velocity,
            effective_mass: i.mass * j.mass / (i.mass + j.mass),
            effective_inertia: i.inertia() * j.inertia() / (i.inertia() + j.inertia()),
        }
    }

    /// Leapfrog: half a kick has been done at the start and is left to do at the end of a run.
    fn kick(&mut self, dt: f64, kick: f64) {
        let pairs: Vec<BeamPair> = (0..self.bonds.len()).map(|k| self.pair(k, dt)).collect();
        for (k, (bond, pair)) in self.bonds.iter_mut().zip(pairs).enumerate() {
            let (load, state) = self.law.advance(bond, &pair);
            *bond = state;
            self.grains[k].push(load.force * kick, load.torque_i * kick);
            self.grains[k + 1].push(load.force * -kick, load.torque_j * kick);
        }
    }

    /// From rest of the bonds; ends with positions and velocities of the same time.
    fn run(&mut self, dt: f64, steps: usize) {
        for step in 1..=steps {
            self.drift(dt);
            self.kick(dt, if step == steps { 0.5 * dt } else { dt });
        }
    }
}

fn two_grains(damping_ratio: f64) -> Chain {
    let mut stream = Stream::new(3, Purpose::Sampling, 0);
    let mut random = || stream.direction();
    let first = Grain {
        position: Vec3::ZERO,
        velocity: random() * 0.5,
        angular_velocity: random() * 300.0,
        radius: RADIUS,
        mass: 1e-5,
    };
    let second = Grain {
        position: random() * 2.5e-3,
        velocity: random() * 0.5,
        angular_velocity: random() * 300.0,
        radius: 1.4e-3,
        mass: 3e-5,
    };
    Chain::new(beam(damping_ratio), vec![first, second])
}

/// Energy is kept to the square of the step, momenta to round-off, while the pair turns, bends and twists.
#[test]
fn a_free_pair_keeps_energy_and_momentum() {
    let error = |dt: f64, time: f64| {
        let mut pair = two_grains(0.0);
        let (energy, momentum) = (pair.energy(), pair.angular_momentum());
        pair.run(dt, (time / dt).round() as usize);
        assert_close_vector!(pair.angular_momentum(), momentum, 1e-11);
        (pair.energy() / energy - 1.0).abs()
    };
    // Some ten periods of the fast modes, and then a hundred times as long: no drift on top.
    let (coarse, fine) = (error(2e-8, 2e-5), error(1e-8, 2e-5));
    assert!((coarse / fine - 4.0).abs() < 0.4, "{coarse} {fine}");
    let long = error(4e-8, 2e-3);
    assert!(long < 1e-4, "{long}");
}

/// Power of the dashpots is what the grains lose: load times motion, with and without damping.
#[test]
fn damping_power_is_the_work_of_the_dashpots() {
    let chain = two_grains(0.3);
    let (damped, _) = chain.law.advance(&chain.bonds[0], &chain.pair(0, 0.0));
    let (plain, _) = beam(0.0).advance(&chain.bonds[0], &chain.pair(0, 0.0));
    let [i, j] = [chain.grains[0], chain.grains[1]];
    let power = |load: &BeamLoad| {
        load.force.dot(j.velocity - i.velocity)
            - load.torque_i.dot(i.angular_velocity)
            - load.torque_j.dot(j.angular_velocity)
    };
    let lost = power(&damped) - power(&plain);
    assert_above!(lost, 0.0);
    assert_close!(damped.damping_power, lost, 1e-12, "in W");
    assert_eq!(plain.damping_power, 0.0);
    assert_eq!([damped.tensile_use, damped.shear_use], [plain.tensile_use, plain.shear_use]);
    let across = j.position - i.position;
    let turning = damped.torque_i + damped.torque_j - across.cross(damped.force);
    assert_below!(turning.norm(), 1e-12 * damped.torque_i.norm());
}

/// A pair at ζ = 0.1 rings down as e^(-ζ ω t) in its axial mode.
#[test]
fn axial_ringing() {
    let mut pair = two_grains(0.1);
    let across = pair.bonds[0].normal;
    let mass = pair.grains[0].mass * pair.grains[1].mass / 4e-5;
    let omega = (by_hand()[0] / mass).sqrt();
    for (grain, speed) in pair.grains.iter_mut().zip([-3e-3, 1e-3]) {
        (grain.velocity, grain.angular_velocity) = (across * speed, Vec3::ZERO);
    }
    let damped = omega * 0.99_f64.sqrt();
    let steps = 20_000;
    // After two full periods the pair moves as at first, slower by e^(-2 ζ ω 2 π/ω_d).
    let dt = 4.0 * PI / damped / f64::from(steps);
    let before = pair.grains[1].velocity.dot(across);
    pair.run(dt, steps as usize);
    let ratio = pair.grains[1].velocity.dot(across) / before;
    let expected = (-0.1 * omega * 4.0 * PI / damped).exp();
    // Dashpots lag half a step in this leapfrog: first order, 2 π ζ 2/20000.
    assert!((ratio / expected - 1.0).abs() < 1e-3, "{ratio} {expected}");
}

/// A pair turned as one rigid body stores nothing (to the square of the step), and its loads turn with it.
#[test]
fn rigid_rotation() {
    let turned = |steps: i32| {
        let mut pair = two_grains(0.0);
        let axis = Vec3::new(1.0, 2.0, -0.5).normalized();
        let angle = PI / f64::from(steps);
        let (e1, e2) = pair.bonds[0].normal.frame();
        pair.bonds[0].shear = e1 * 2.0;
        pair.bonds[0].bending = e2 * 3e-3;
        pair.bonds[0].twist = 1e-3;
        let before = pair.bonds[0];
        let start = [pair.grains[0].position, pair.grains[1].position];
        for k in 1..=steps {
            for (grain, from) in pair.grains.iter_mut().zip(start) {
                let to = from.rotated_about(axis, angle * f64::from(k));
                grain.velocity = to - grain.position;
                grain.angular_velocity = axis * angle;
                grain.position = to;
            }
            let seen = pair.pair(0, 1.0);
            pair.bonds[0] = pair.law.advance(&pair.bonds[0], &seen).1;
        }
        let shear = (pair.bonds[0].shear - before.shear.rotated_about(axis, PI)).norm();
        let bending = (pair.bonds[0].bending - before.bending.rotated_about(axis, PI)).norm();
        assert_near!(pair.bonds[0].twist, before.twist, 1e-15);
        (shear, bending)
    };
    let (coarse, fine) = (turned(2000), turned(4000));
    assert_near!(coarse.0 / fine.0, 4.0, 0.1);
    assert_near!(coarse.1 / fine.1, 4.0, 0.1);
    // Chord against arc: k_s A d θ (π/steps)²/24 of shear, 5 N at most.
    assert!(fine.0 < 1e-2 && fine.1 < 1e-8, "{fine:?}");
}

/// A slow path through all modes: the bond stores the work done on it, and gives it back on the way back.
#[test]
fn stored_energy_is_the_work_of_the_path() {
    let mut pair = two_grains(0.0);
    let (e1, e2) = pair.bonds[0].normal.frame();
    let steps = 4000_u32;
    let mut work = 0.0;
    let mut peak = 0.0_f64;
    let mut before = BeamLoad::default();
    for k in 0..steps {
        let way = if k < steps / 2 { 1.0 } else { -1.0 } / f64::from(steps);
        pair.grains[0].velocity = (e1 * 2e-5 + e2 * 1e-5) * way;
        pair.grains[1].velocity = pair.bonds[0].normal * (1e-5 * way);
        pair.grains[0].angular_velocity = (e2 + pair.bonds[0].normal) * (2e-2 * way);
        pair.grains[1].angular_velocity = e1 * (-1e-2 * way);
        pair.drift(1.0);
        let (load, state) = pair.law.advance(&pair.bonds[0], &pair.pair(0, 1.0));
        pair.bonds[0] = state;
        let [i, j] = [pair.grains[0], pair.grains[1]];
        let done = |load: &BeamLoad| {
            load.force.dot(j.velocity - i.velocity)
                - load.torque_i.dot(i.angular_velocity)
                - load.torque_j.dot(j.angular_velocity)
        };
        work += 0.5 * (done(&before) + done(&load));
        before = load;
        peak = peak.max(pair.stored());
        // The load at the start of a step is written with the normal of that time: relative order (step angle).
        assert!((pair.stored() - work).abs() < 1e-4 * peak, "{k}: {} {work}", pair.stored());
    }
    assert!(peak > 1e-8 && pair.stored() < 1e-4 * peak, "{} {peak}", pair.stored());
}

/// Below the critical step a pair with a little of every mode stays bounded; the axial mode alone, whose limit
/// is 2/ω, does so just below and grows without bound just above.
#[test]
fn critical_step_of_a_pair() {
    let growth = |mut pair: Chain, step: f64, steps: usize| {
        let start = pair.energy();
        pair.run(step, steps);
        pair.energy() / start
    };
    for damping in [0.0, 0.2] {
        let mut pair = two_grains(damping);
        for grain in &mut pair.grains {
            grain.velocity *= 1e-7;
            grain.angular_velocity *= 1e-7;
        }
        let [i, j] = [pair.grains[0], pair.grains[1]];
        let (masses, inertias) = ([i.mass, j.mass], [i.inertia(), j.inertia()]);
        let step = pair.law.pace(&pair.bonds[0], masses, inertias, [1.1e-3, 1.4e-3]).critical_step();
        assert_below!(growth(pair, 0.98 * step, 2000), 100.0);
    }
    let thin = Beam { shear_ratio: 1e-6, radius_ratio: 1e-3, ..beam(0.0) };
    let state = thin.new_state(RADIUS, 1.4e-3, 2.5e-3, N);
    let step = thin.pace(&state, [1e-5, 3e-5], [4e-12, 2e-11], [1.1e-3, 1.4e-3]).critical_step();
    let by_hand = 2.0 * (0.75e-5 * 2.5e-3 / (2e9 * PI * 1e-12)).sqrt();
    assert_close!(step, by_hand, 1e-6);
    for (part, grows) in [(0.98, false), (1.02, true)] {
        let grain = |at: f64, speed: f64, mass: f64| Grain {
            position: N * at,
            velocity: N * speed,
            angular_velocity: Vec3::ZERO,
            radius: RADIUS,
            mass,
        };
        let pair = Chain::new(thin.clone(), vec![grain(0.0, -3e-8, 1e-5), grain(2.5e-3, 1e-8, 3e-5)]);
        // At 1.02 of the limit the amplitude grows by 1.49 a step; below it energy swings by 25 at most.
        assert_eq!(growth(pair, part * step, 25) > 100.0, grows, "{part}");
    }
}

/// Shear, with the levers of unequal ends, and bending by hand; stretch and twist are slower. The dashpots' rate goes with
/// the levers.
#[test]
fn pace_of_an_unequal_pair() {
    let [normal, shear, bending, twist] = by_hand();
    let (masses, inertias, lever_arms) = ([1e-5, 3e-5], [4e-12, 2e-11], [1.1e-3, 1.4e-3]);
    let per_mass = 1.0 / 1e-5 + 1.0 / 3e-5;
    let per_inertia = 1.0 / 4e-12 + 1.0 / 2e-11;
    let levers = 1.21e-6 / 4e-12 + 1.96e-6 / 2e-11;
    let square = shear * (per_mass + levers) + bending * per_inertia;
    assert_above!(square, (normal * per_mass).max(twist * per_inertia));
    let pace = beam(0.2).pace(&at_rest().0, masses, inertias, lever_arms);
    assert_close!(pace.square, square, 1e-12, "in 1/s²");
    assert_close!(pace.rate, 0.4 * (1.0 + levers / per_mass).sqrt() * square.sqrt(), 1e-12, "in 1/s");
}

/// Where the end of a clamped row of bonds comes to rest under a force; found by damped motion.
fn tip_under(force: Vec3, bonds: usize) -> Vec3 {
    let law = Beam { radius_ratio: 1.0, ..beam(0.0) };
    let grain = |k: usize| Grain {
        position: N * (2.0 * RADIUS * k as f64),
        velocity: Vec3::ZERO,
        angular_velocity: Vec3::ZERO,
        radius: RADIUS,
        mass: 1e-5,
    };
    let mut row = Chain::new(law, (0..=bonds).map(grain).collect());
    let (length, inertia) = (2.0 * RADIUS * bonds as f64, PI * RADIUS.powi(4) / 4.0);
    // Lowest mode of a clamped beam; damped a little below critical, its rest dies away as e^-30.
    let lowest = 3.516 / length.powi(2) * (2e9 * inertia * 2.0 * RADIUS / 1e-5).sqrt();
    let dt = 0.2 * (1e-5 * 2.0 * RADIUS / (2e9 * PI * RADIUS * RADIUS)).sqrt();
    for _ in 0..(40.0 / (lowest * dt)) as usize {
        row.drift(dt);
        row.kick(dt, dt);
        row.grains[bonds].velocity += force * (dt / 1e-5);
        for grain in &mut row.grains {
            grain.velocity *= 1.0 - 1.6 * lowest * dt;
            grain.angular_velocity *= 1.0 - 1.6 * lowest * dt;
        }
        (row.grains[0].velocity, row.grains[0].angular_velocity) = (Vec3::ZERO, Vec3::ZERO);
    }
    row.grains[bonds].position - N * length
}

/// A clamped row of n bonds under a force P at its end: axially P L/(E A); across, every bond's bending and shear
/// added up, P L³/(3 E I) (1 - 1/(4 n²)) + P L/(κ E A), which is Timoshenko's beam as n grows. Deflections are
/// kept so small that the change of shape does not matter.
#[test]
fn val_timoshenko_1921_cantilever() {
    let bonds = 8_usize;
    let (n, length) = (bonds as f64, 2.0 * RADIUS * bonds as f64);
    let (area, inertia) = (PI * RADIUS * RADIUS, PI * RADIUS.powi(4) / 4.0);
    let bent = 1e-3 * length.powi(3) / (3.0 * 2e9 * inertia) * (1.0 - 0.25 / (n * n));
    let sheared = 1e-3 * length / (0.3 * 2e9 * area);
    let tip = tip_under(SIDE * 1e-3, bonds);
    assert!((tip.y / (bent + sheared) - 1.0).abs() < 1e-4, "{} {}", tip.y, bent + sheared);
    let tip = tip_under(N, bonds);
    assert!((tip.x / (length / (2e9 * area)) - 1.0).abs() < 1e-6, "{}", tip.x);
}
