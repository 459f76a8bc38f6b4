use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use crate::constants::GAS_CONSTANT;
use crate::testing::Scenario;

/// Laws of two materials, "a" (number 0) and "b" (number 1), with more lines for the file and for materials.
pub(super) fn laws(impact: &str, [a, b]: [&str; 2]) -> ImpactLaws {
    let text = format!(
        "version = 1\ngrains = []\n[time]\nend = \"1 s\"\n[engine.event_driven]\n[volume]\n\
         lower = [\"0 m\", \"0 m\", \"0 m\"]\nupper = [\"1 m\", \"1 m\", \"1 m\"]\n{impact}\n\
         [materials.a]\ndensity = \"2000 kg/m3\"\n{a}\n[materials.b]\ndensity = \"3000 kg/m3\"\n{b}\n"
    );
    let scenario: Scenario = toml::from_str(&text).unwrap();
    ImpactLaws::new(&scenario.hard().unwrap().impact, &scenario.materials, &scenario.mixtures)
}

pub(super) const REACTIVE: &str =
    "hardness = \"0.3 MPa\"\nactivation_energy = \"600 J\"\nreaction_heat = \"400 J/m2\"";
pub(super) const TOUGH: &str =
    "hardness = \"0.5 MPa\"\nactivation_energy = \"200 J\"\nsurface_energy = \"30 J/m2\"";
pub(super) const HARDNESS: &str = "[impact.restitution.hardness]";

pub(super) fn sphere(material: u32, radius: f64, velocity: [f64; 3]) -> Body {
    let mass = [2000.0, 3000.0][material as usize] * 4.0 / 3.0 * PI * radius * radius * radius;
    Body {
        velocity: velocity.into(),
        mass,
        radius,
        temperature: 300.0,
        heat_capacity: 800.0 * mass,
        material,
        primaries: 12,
    }
}

fn kinetic(bodies: [&Body; 2], velocities: [Vec3; 2]) -> f64 {
    (0..2).map(|side| 0.5 * bodies[side].mass * velocities[side].norm_squared()).sum()
}

fn before(bodies: [&Body; 2]) -> [Vec3; 2] {
    bodies.map(|body| body.velocity)
}

/// By hand: masses 2 and 3, 6 m/s and -4 m/s, e = 0.5, μ = 0.25, slip 1 m/s: m* = 1.2, J_n = 18, J_t = 1.2 (no slip).
#[test]
fn an_impact_by_hand() {
    let rule = "[impact.restitution.constant]\nrestitution = 0.5\n[impact.tangential]\nfriction = 0.25\n";
    let one = Body { mass: 2.0, radius: 1.0, velocity: Vec3::new(6.0, 1.0, 0.0), ..Body::default() };
    let two = Body { mass: 3.0, radius: 1.0, velocity: Vec3::new(-4.0, 0.0, 0.0), ..Body::default() };
    let outcome = laws(rule, [""; 2]).impact([&one, &two], Vec3::AXES[0]);
    assert_near_vector!(outcome.velocities[0], Vec3::new(-3.0, 0.4, 0.0), 1e-14);
    assert_near_vector!(outcome.velocities[1], Vec3::new(2.0, 0.4, 0.0), 1e-14);
    assert_near!(outcome.energy.normal, 45.0, 1e-13);
    assert_near!(outcome.energy.tangential, 0.6, 1e-14);
    assert_near!(outcome.energy.heat, 45.6, 1e-13, "in J");
    assert_eq!(outcome.temperatures, [0.0; 2]);
    assert_true!(outcome.converged, "the law has found its solution");
    assert_false!(outcome.sticks, "the pair sticks");
    assert_eq!(outcome.fragments, [1, 1]);
    assert_eq!(outcome.iterations, 0);
    let slippery = laws(&rule.replace("0.25", "0.05"), [""; 2]).impact([&one, &two], Vec3::AXES[0]);
    // J_t = 0.05·18 = 0.9 < 1.2.
    assert_near!(slippery.velocities[0].y, 0.55, 1e-14);
    assert_near!(slippery.velocities[1].y, 0.3, 1e-14);
}

#[test]
fn pairs_that_part_or_are_elastic() {
    let laws = laws("[impact.restitution.constant]\nrestitution = 0.0", [""; 2]);
    let (one, two) = (sphere(0, 1e-3, [1.0, 2.0, 0.0]), sphere(1, 2e-3, [-1.0, 0.0, 0.5]));
    let apart = laws.impact([&one, &two], -Vec3::AXES[0]);
    assert_eq!((apart.velocities, apart.restitution), (before([&one, &two]), 1.0));
    assert_eq!((apart.temperatures, apart.energy), ([300.0; 2], ImpactEnergy::default()));
    let elastic = laws.elastic([&one, &two], Vec3::AXES[0]);
    let (old, new) = (kinetic([&one, &two], before([&one, &two])), kinetic([&one, &two], elastic.velocities));
    assert_close!(new, old, 1e-14);
    assert_eq!(elastic.energy, ImpactEnergy::default());
    assert_near!((elastic.velocities[1] - elastic.velocities[0]).x, 2.0, 1e-14);
}

#[test]
fn sticking_pairs_have_one_velocity_or_only_no_rebound() {
    let rule = "[impact.restitution.constant]\nrestitution = 0.0\n[impact.tangential]\nfriction = 0.1\n";
    let (one, two) = (sphere(0, 1e-3, [3.0, 2.0, 0.0]), sphere(1, 2e-3, [-1.0, 0.0, 0.5]));
    let bodies = [&one, &two];
    let stuck = laws(rule, [""; 2]).impact(bodies, Vec3::AXES[0]);
    assert_true!(stuck.sticks, "the pair sticks");
    assert_eq!(stuck.velocities, [common_velocity(bodies); 2]);
    // All energy of relative motion: m* (4² + 2² + 0.5²)/2.
    let reduced = one.mass * two.mass / (one.mass + two.mass);
    let lost = stuck.energy.normal + stuck.energy.tangential;
    assert_close!(lost, 0.5 * reduced * 20.25, 1e-14);
    let never =
        laws(&format!("[impact]\nsticking = \"never\"\n{rule}"), [""; 2]).impact(bodies, Vec3::AXES[0]);
    let relative = never.velocities[0] - never.velocities[1];
    assert_false!(never.sticks, "the pair sticks");
    assert_eq!(never.restitution, 0.0);
    assert_below!(relative.x.abs(), 1e-15);
    // Friction took 0.1·4 m/s of the slip of √4.25 m/s.
    assert_near!(relative.norm(), 4.25_f64.sqrt() - 0.4, 1e-14);
}

/// A pair that sticks also turns all of its slip into heat: 1 km/s of it is 156 K, which lowers H from 3.8e5 to 3.5e5 Pa;
/// x = 1 needs ρ v²/6 = 3.65e5 Pa here.
#[test]
fn the_heat_of_the_slip_decides_on_sticking() {
    let (merge, never) = (
        laws(HARDNESS, [REACTIVE; 2]),
        laws(&format!("[impact]\nsticking = \"never\"\n{HARDNESS}"), [REACTIVE; 2]),
    );
    let v = (6.0 * 3.65e5 / 2000.0_f64).sqrt();
    let target = sphere(0, 1e-3, [0.0; 3]);
    let (oblique, straight) = (sphere(0, 1e-3, [v, 1000.0, 0.0]), sphere(0, 1e-3, [v, 0.0, 0.0]));
    assert_true!(merge.impact([&oblique, &target], Vec3::AXES[0]).sticks, "the pair sticks");
    assert_above!(merge.impact([&straight, &target], Vec3::AXES[0]).restitution, 0.01);
    assert_above!(never.impact([&oblique, &target], Vec3::AXES[0]).restitution, 0.01);
}

/// Mixtures override the restitution, also that of `hardness`, and the friction.
#[test]
fn mixtures_have_the_last_word() {
    let own = "[[mixtures]]\nbetween = [\"b\", \"a\"]\nrestitution = 0.3\ndynamic_friction = 0.2\n";
    let laws = laws(&format!("{own}{HARDNESS}"), [REACTIVE, TOUGH]);
    let (one, two) = (sphere(0, 1e-3, [3.0, 2.0, 0.0]), sphere(1, 2e-3, [-1.0, 0.0, 0.5]));
    let mixed = laws.impact([&one, &two], Vec3::AXES[0]);
    let alike = laws.impact([&one, &one], Vec3::AXES[0]);
    assert_eq!((mixed.restitution, alike.restitution), (0.3, 1.0));
    assert_above!(mixed.energy.tangential, 0.0);
    assert_eq!(laws.impact([&one, &Body { material: 0, ..two }], Vec3::AXES[0]).energy.tangential, 0.0);
}

/// A hard sphere and a soft one, either named first: H is the softer's, so that e is what it is between two soft ones of the
/// same masses; 1 - e = √(m* v²/(4 π b³ H)), b the smaller radius. Heat changes no hardness here.
#[test]
fn the_softer_partner_decides() {
    let [hard, soft] = ["hardness = \"6 MPa\"", "hardness = \"0.3 MPa\""];
    for solver in ["", "solver.fixed_point = { most_iterations = 1 }\n"] {
        let rule = format!("{HARDNESS}\n{solver}");
        let (one, two) = (sphere(0, 1e-3, [2.0, 0.0, 0.0]), sphere(1, 2e-3, [-1.0, 0.0, 0.0]));
        let of =
            |materials: [&str; 2]| laws(&rule, materials).impact([&one, &two], Vec3::AXES[0]).restitution;
        let wanted = of([soft, soft]);
        for materials in [[hard, soft], [soft, hard]] {
            let found = of(materials);
            assert!(found == wanted, "{materials:?} {solver}: e = {found}, expected {wanted}");
        }
        assert!(of([hard, hard]) > wanted, "the case is made for a hardness that matters");
        if solver.is_empty() {
            let reduced = one.mass * two.mass / (one.mass + two.mass);
            let by_hand = 1.0 - (reduced * 9.0 / (4.0 * PI * 1e-9 * 3e5)).sqrt();
            assert!((wanted - by_hand).abs() < 1e-14, "e = {wanted}, expected {by_hand}");
        }
    }
}

/// The same where partners differ in temperature, heat capacity, material and size, and only one of them softens: e against
/// the hardness of each at its own temperature after, with half of the reaction's heat by mass.
#[test]
fn each_partner_has_its_own_temperature() {
    let firm = "hardness = \"0.28 MPa\"\nreaction_heat = \"100 J/m2\"";
    for (a, b) in [(REACTIVE, firm), (firm, REACTIVE), (REACTIVE, TOUGH), (TOUGH, REACTIVE)] {
        let laws = laws(HARDNESS, [a, b]);
        let hot = |body: Body, temperature: f64, capacity: f64| Body {
            temperature,
            heat_capacity: capacity * body.mass,
            ..body
        };
        let one = hot(sphere(0, 1e-3, [6.0, 0.0, 0.0]), 280.0, 900.0);
        let two = hot(sphere(1, 2e-3, [-2.0, 0.0, 0.0]), 520.0, 400.0);
        let outcome = laws.impact([&one, &two], Vec3::AXES[0]);
        let hardness = |material: &str, temperature: f64| match material {
            REACTIVE => 3e5 * (600.0 / (GAS_CONSTANT * temperature)).exp(),
            TOUGH => 5e5 * (200.0 / (GAS_CONSTANT * temperature)).exp(),
            _ => 2.8e5,
        };
        let softer = hardness(a, outcome.temperatures[0]).min(hardness(b, outcome.temperatures[1]));
        let reduced = one.mass * two.mass / (one.mass + two.mass);
        let wanted = 1.0 - (reduced * 64.0 / (4.0 * PI * 1e-9 * softer)).sqrt();
        let e = outcome.restitution;
        assert!((e - wanted).abs() < 1e-13 && e > 0.1, "{a} on {b}: e = {e}, expected {wanted}");
        let per_area = [a, b].map(|material| match material {
            REACTIVE => 400.0,
            TOUGH => 0.0,
            _ => 100.0,
        });
        let reaction = 0.5 * (per_area[0] + per_area[1]) * (1.0 - e) * PI * 1e-6;
        let heat = 0.5 * (1.0 - e * e) * reduced * 64.0 + reaction;
        for (side, body) in [&one, &two].into_iter().enumerate() {
            let warmer = heat * body.mass / (one.mass + two.mass) / body.heat_capacity;
            let found = outcome.temperatures[side] - body.temperature;
            assert!(
                (found / warmer - 1.0).abs() < 1e-9,
                "{a} on {b}: side {side} warms by {found} K, expected {warmer} K"
            );
        }
    }
}

/// [B] 6.10 with 6.9 and the work of 4.4-4.9, by hand for e = 0.5: each partner's own loss, the work, and all of α a_c.
#[test]
fn val_zohdi_2004_published_heat() {
    let rule = "[impact.restitution.constant]\nrestitution = 0.5\n[impact.heat]\nbalance = \"published\"\n";
    let laws = laws(rule, ["reaction_heat = \"3 J/m2\"", "reaction_heat = \"1 J/m2\""]);
    let one = Body { mass: 2.0, radius: 0.5, heat_capacity: 4.0, ..sphere(0, 1.0, [6.0, 0.0, 0.0]) };
    let two = Body { mass: 3.0, radius: 0.7, heat_capacity: 5.0, ..sphere(1, 1.0, [-4.0, 0.0, 0.0]) };
    let outcome = laws.impact([&one, &two], Vec3::AXES[0]);
    // Velocities -3 and 2; m* v² = 120; a_c = π/8.
    let (own, both) = ([36.0 - 9.0, 24.0 - 6.0], 0.75 * 120.0 / 3.0 + 2.0 * PI / 8.0);
    assert_near!(outcome.temperatures[0] - 300.0, (own[0] + both) / 4.0, 1e-12);
    assert_near!(outcome.temperatures[1] - 300.0, (own[1] + both) / 5.0, 1e-12);
    assert_near!(outcome.energy.heat, 45.0 + 2.0 * both, 1e-12, "in J");
    assert_near!(outcome.energy.reaction, PI / 2.0, 1e-14);
    // In a fast cloud the partner that is pushed along gains energy and cools; below zero it keeps its temperature.
    let fly = |body: Body| Body { velocity: body.velocity + Vec3::new(1e4, 0.0, 0.0), ..body };
    let (fast_one, fast_two) = (fly(one), fly(two));
    let refused = laws.impact([&fast_one, &fast_two], Vec3::AXES[0]);
    assert_false!(refused.converged, "the law has found its solution");
    assert_eq!(refused.temperatures[1], 300.0);
    assert_above!(refused.temperatures[0], 300.0, "in K");
    assert_near!(refused.energy.heat, 4.0 * (refused.temperatures[0] - 300.0), 1e-6, "in J");
}

/// A tough partner breaks with the other's share of the loss, and its surface is taken from the heat.
#[test]
fn breaking_takes_its_surface_from_the_heat() {
    let rule = "[impact.restitution.constant]\nrestitution = 0.0\n[impact.fragmentation]\n";
    let laws = laws(rule, ["", TOUGH]);
    let two = sphere(1, 1e-3, [0.0; 3]);
    let of_speed = |v: f64| sphere(0, 2e-3, [v, 0.0, 0.0]);
    let (heavy, light) = (of_speed(1.0).mass, two.mass);
    // Five fragments need (5^(1/3) - 1) γ 4 π b0²; of what the pair loses, m* v²/2, this partner has m_i/(m_i + m_j).
    let needed = (5.0_f64.cbrt() - 1.0) * 30.0 * 4.0 * PI * 1e-6;
    let reduced = heavy * light / (heavy + light);
    let v = (2.0 * needed * (heavy + light) / heavy / reduced).sqrt();
    let slower = of_speed(v * (1.0 - 1e-9));
    assert_eq!(laws.impact([&slower, &two], Vec3::AXES[0]).fragments, [1, 4]);
    let one = of_speed(v * (1.0 + 1e-9));
    let outcome = laws.impact([&one, &two], Vec3::AXES[0]);
    assert_eq!(outcome.fragments, [1, 5]);
    let lost = 0.5 * reduced * one.velocity.norm_squared();
    assert_false!(outcome.sticks, "the pair sticks");
    assert_eq!(outcome.restitution, 0.0);
    assert_eq!(outcome.velocities[0], outcome.velocities[1]);
    let surface = super::super::fragmentation::surface(outcome.fragments[1], 30.0, 1e-3, 12);
    assert_close!(outcome.energy.surface, surface, 1e-15, "in J");
    assert_close!(outcome.energy.heat, lost - surface, 1e-13, "in J");
    assert_eq!(laws.share_primaries(&two, 5, Draws::new(0, 0).of(1)), [3, 3, 2, 2, 2]);
    let single = laws.impact([&one, &Body { primaries: 1, ..two }], Vec3::AXES[0]);
    assert_true!(single.sticks, "the pair sticks");
    assert_eq!(single.energy.surface, 0.0);
}

#[test]
fn heat_without_capacity_is_booked() {
    let laws =
        laws("[impact.restitution.constant]\nrestitution = 0.5\n[impact.heat]\nshare = \"equal\"", [""; 2]);
    let (one, two) = (sphere(0, 1e-3, [3.0, 0.0, 0.0]), sphere(1, 1e-3, [0.0; 3]));
    let bare = Body { heat_capacity: 0.0, ..two };
    let outcome = laws.impact([&one, &bare], Vec3::AXES[0]);
    assert_eq!(outcome.temperatures[1], 300.0);
    assert_close!(outcome.energy.heat, outcome.energy.normal, 1e-15, "in J");
    let half = 0.5 * outcome.energy.normal / one.heat_capacity;
    assert_close!(outcome.temperatures[0] - 300.0, half, 1e-9);
}

/// Cooling by the material's emissivity, the body's surface and its heat capacity; none without one of them.
#[test]
fn bodies_cool_by_their_own_surface_and_capacity() {
    let rule = format!("{HARDNESS}\n[impact.cooling]\nsurroundings = \"280 K\"");
    let laws = laws(&rule, ["emissivity = 0.5", ""]);
    let hot = Body { temperature: 900.0, ..sphere(0, 1e-3, [0.0; 3]) };
    let rate = 0.5 * 5.670_374_419e-8 * 4.0 * PI * 1e-6 / hot.heat_capacity
        * (900.0_f64.powi(4) - 280.0_f64.powi(4));
    let after = laws.cooled(&hot, 1e-4);
    assert!(laws.cools() && ((900.0 - after) / (1e-4 * rate) - 1.0).abs() < 1e-4, "{after} {rate}");
    assert_eq!(laws.cooled(&Body { material: 1, ..hot }, 1.0), 900.0);
    assert_eq!(laws.cooled(&Body { heat_capacity: 0.0, ..hot }, 1.0), 900.0);
    assert_false!(laws.cooling_overshoots(&hot, 1e9), "heat lost in a step of 1e9 s");
}

#[test]
fn names_and_warnings() {
    let rule = "[impact.tangential]\nfriction = 0.1\nlimit = \"published\"\n[impact.heat]\nbalance = \"published\"\n\
                [impact.cooling]\nintegration = \"published\"\n[impact.fragmentation]\nenergy = \"published\"\n\
                [impact.restitution.hardness]\nforce_over = \"compression\"\nsolver.fixed_point = {}\n";
    let published = laws(rule, [REACTIVE, TOUGH]);
    assert_eq!(published.standing_warnings().len(), 6);
    assert_eq!(published.names().len(), 6);
    let consistent = laws(HARDNESS, [REACTIVE, TOUGH]);
    assert_empty!(consistent.standing_warnings());
    assert_false!(consistent.cools(), "the laws cool");
    assert_eq!(consistent.names(), ["impact.restitution.hardness", "impact.sticking.merge", "impact.heat"]);
}

const CONSISTENT: [&str; 4] = [
    "[impact.restitution.hardness]\n[impact.tangential]\nfriction = 0.3\n[impact.fragmentation]\n",
    "[impact.restitution.hardness]\nelastic_area = 0.3\nsticking_area = 0.8\nforce_over = \"compression\"\n\
     [impact.heat]\nshare = \"equal\"\n",
    "[impact.restitution.constant]\nrestitution = 0.8\n[impact.tangential]\nfriction = 0.05\n[impact.fragmentation]\n",
    "[impact.restitution.constant]\nrestitution = 0.0\n",
];
const PUBLISHED: [&str; 2] = [
    "[impact.restitution.hardness]\nsolver.fixed_point = { most_iterations = 9 }\nforce_over = \"compression\"\n\
     [impact.tangential]\nfriction = 0.3\nlimit = \"published\"\n[impact.heat]\nbalance = \"published\"\n\
     [impact.fragmentation]\nenergy = \"published\"\n",
    "[impact.restitution.hardness]\n[impact.tangential]\nfriction = 0.3\n[impact.heat]\nbalance = \"published\"\n",
];

fn all_laws() -> Vec<ImpactLaws> {
    CONSISTENT.iter().chain(&PUBLISHED).map(|rule| laws(rule, [REACTIVE, TOUGH])).collect()
}

fn any_body() -> impl Strategy<Value = Body> {
    let speed = -50.0..50.0_f64;
    let velocity = (speed.clone(), speed.clone(), speed).prop_map(|(x, y, z)| [x, y, z]);
    let body = (0..2_u32, -5.0..-2.0_f64, velocity, 10.0..3e3_f64, 1..500_u32);
    body.prop_map(|(material, size, velocity, temperature, primaries)| Body {
        temperature,
        primaries,
        ..sphere(material, 10.0_f64.powf(size), velocity)
    })
}

fn any_direction() -> impl Strategy<Value = Vec3> {
    (-1.0..1.0_f64, 0.0..std::f64::consts::TAU).prop_map(|(z, angle)| {
        let rho = (1.0 - z * z).sqrt();
        Vec3::new(rho * angle.cos(), rho * angle.sin(), z).normalized()
    })
}

/// Partners turned so that they approach along the normal.
fn facing(one: &Body, two: &Body, normal: Vec3) -> Vec3 {
    if (one.velocity - two.velocity).dot(normal) < 0.0 { -normal } else { normal }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// Mass, momentum and energy; the scale is what there is of each, and 1e-12 is thousands of roundings.
    #[test]
    fn what_is_kept_is_kept(one in any_body(), two in any_body(), normal in any_direction()) {
        let normal = facing(&one, &two, normal);
        let bodies = [&one, &two];
        for (number, laws) in all_laws().iter().enumerate() {
            let outcome = laws.impact(bodies, normal);
            let [v, w] = outcome.velocities;
            let change = (v - one.velocity) * one.mass + (w - two.velocity) * two.mass;
            let scale = one.velocity.norm() * one.mass + two.velocity.norm() * two.mass;
            prop_assert!(change.norm() <= 1e-12 * scale, "momentum {number}");
            let energy = outcome.energy;
            let old = kinetic(bodies, before(bodies));
            let gone = old - kinetic(bodies, outcome.velocities);
            prop_assert!((gone - energy.normal - energy.tangential).abs() <= 1e-12 * old, "energy {number}");
            prop_assert!(outcome.temperatures.iter().all(|t| *t > 0.0 && t.is_finite()));
            prop_assert!((0.0..=1.0).contains(&outcome.restitution));
            for (side, body) in bodies.iter().enumerate() {
                prop_assert!((1..=body.primaries).contains(&outcome.fragments[side]));
            }
            if number < CONSISTENT.len() {
                let put_in = energy.normal + energy.tangential + energy.reaction;
                prop_assert!(outcome.converged && energy.surface <= energy.normal + energy.tangential);
                prop_assert!((energy.heat - (put_in - energy.surface)).abs() <= 1e-15 * put_in, "heat {number}");
                let stored: f64 =
                    (0..2).map(|k| bodies[k].heat_capacity * (outcome.temperatures[k] - bodies[k].temperature)).sum();
                let warmth: f64 = bodies.iter().map(|body| body.heat_capacity * body.temperature).sum();
                prop_assert!((stored - energy.heat).abs() <= 1e-12 * (warmth + energy.heat), "stored {number}");
            }
        }
    }

    #[test]
    fn swapped_partners_give_swapped_bits(one in any_body(), two in any_body(), normal in any_direction()) {
        let normal = facing(&one, &two, normal);
        for laws in all_laws() {
            let there = laws.impact([&one, &two], normal);
            let mut back = laws.impact([&two, &one], -normal);
            back.velocities.swap(0, 1);
            back.temperatures.swap(0, 1);
            back.fragments.swap(0, 1);
            prop_assert_eq!(there, back);
            let mut elastic = laws.elastic([&two, &one], -normal);
            elastic.velocities.swap(0, 1);
            elastic.temperatures.swap(0, 1);
            prop_assert_eq!(laws.elastic([&one, &two], normal), elastic);
        }
    }

    /// A turned impact is the impact turned; one in a moving frame the same there. Rounding of 1 km/s is 1e-13 of the speeds.
    #[test]
    fn no_direction_and_no_frame_is_special(
        one in any_body(), two in any_body(), normal in any_direction(),
        axis in any_direction(), angle in 0.0..6.0_f64, drift in any_direction(),
    ) {
        let normal = facing(&one, &two, normal);
        let turned = |v: Vec3| v.rotated_about(axis, angle);
        let moved = |v: Vec3| v + drift * 1e3;
        let with = |body: &Body, f: &dyn Fn(Vec3) -> Vec3| Body { velocity: f(body.velocity), ..*body };
        for rule in CONSISTENT {
            let laws = laws(rule, [REACTIVE, TOUGH]);
            let plain = laws.impact([&one, &two], normal);
            let there = laws.impact([&with(&one, &turned), &with(&two, &turned)], turned(normal));
            let drifting = laws.impact([&with(&one, &moved), &with(&two, &moved)], normal);
            for side in [0, 1] {
                prop_assert!((there.velocities[side] - turned(plain.velocities[side])).norm() < 1e-10);
                prop_assert!((drifting.velocities[side] - moved(plain.velocities[side])).norm() < 1e-10);
                prop_assert!((there.temperatures[side] / plain.temperatures[side] - 1.0).abs() < 1e-10);
                prop_assert!((drifting.temperatures[side] / plain.temperatures[side] - 1.0).abs() < 1e-10);
            }
            prop_assert_eq!((there.fragments, there.sticks), (plain.fragments, plain.sticks));
            prop_assert_eq!((drifting.fragments, drifting.sticks), (plain.fragments, plain.sticks));
        }
    }
}
