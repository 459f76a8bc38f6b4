//! One oblique impact of two spheres that differ in all that they can, through each engine, against a calculation by hand.
//!
//! Clay meets lead: two densities, radii, heat capacities, heats of reaction, surface energies, emissivities, temperatures and
//! numbers of primaries; the sphere of lead is the smaller and the heavier one. They meet at a tenth of a millisecond, once inside
//! an open volume and once across the face of a periodic one, named in either order.

use std::f64::consts::PI;

use agglo::constants::STEFAN_BOLTZMANN;
use agglo::engine::Start;
use agglo::engine::hard::{EventKind, Grown, Simulation};
use agglo::math::Vec3;
use agglo::particles::{Particles, Row};
use agglo::scenario::Scenario;

/// From impact to impact: round-off of some ten operations on places of 1e-2 m in a way of 1e-4 m.
const EVENTS: (&str, f64) = ("[engine.event_driven]", 1e-10);
/// Steps that see the impact up to 1 ps late: 5e-12 m of 1.3e-3 m, and the normal turned by as much.
const STEPS: (&str, f64) = ("[engine.time_stepped]\nshortest_step = \"1 ps\"", 2e-8);

const MEETING: f64 = 1e-4;
const END: f64 = 2e-4;
const EDGE: f64 = 0.02;
const FRICTION: f64 = 0.2;
/// Clay, then lead.
const DENSITY: [f64; 2] = [2000.0, 11000.0];
const HEAT_CAPACITY: [f64; 2] = [900.0, 130.0];
const REACTION: [f64; 2] = [2.0, 5.0];
const EMISSIVITY: [f64; 2] = [0.3, 0.8];
const RADIUS: [f64; 2] = [0.8e-3, 0.5e-3];
const TEMPERATURE: [f64; 2] = [310.0, 420.0];
const PRIMARIES: [u32; 2] = [12, 6];
/// m/s.
const VELOCITY: [Vec3; 2] = [Vec3::new(3.0, 1.0, 2.0), Vec3::new(-2.0, -1.5, 0.5)];
/// From clay to lead where they meet.
const NORMAL: Vec3 = Vec3::new(2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0);

fn mass(k: usize) -> f64 {
    DENSITY[k] * 4.0 / 3.0 * PI * RADIUS[k].powi(3)
}

fn capacity(k: usize) -> f64 {
    mass(k) * HEAT_CAPACITY[k]
}

/// What is known of the pair after the impact.
struct After {
    velocities: [Vec3; 2],
    temperatures: [f64; 2],
    /// Lost along the normal, to friction, from the reaction, to surfaces, heat [J].
    energies: [f64; 5],
}

/// The impact by hand at the usual friction, which the slip outlasts.
fn by_hand(restitution: f64, is_one: bool, surfaces: [f64; 2]) -> After {
    by_hand_with(FRICTION, restitution, is_one, surfaces)
}

/// The impact by hand, from momentum and energy: each partner's own impulse and each one's share of the heat by mass.
fn by_hand_with(friction: f64, restitution: f64, is_one: bool, surfaces: [f64; 2]) -> After {
    let [m, n] = [mass(0), mass(1)];
    let relative = VELOCITY[0] - VELOCITY[1];
    let approach = relative.dot(NORMAL);
    let slip = relative - NORMAL * approach;
    let [first, second] = if is_one {
        [(VELOCITY[0] * m + VELOCITY[1] * n) / (m + n); 2]
    } else {
        // What the pair's slip and approach become; the rest is the center of mass's.
        let kept = 1.0 - friction * (1.0 + restitution) * approach / slip.norm();
        assert_true!((kept > 0.0) == (friction == FRICTION), "{kept} of the slip would be kept");
        let left = slip * kept.max(0.0) - NORMAL * (restitution * approach);
        let center = (VELOCITY[0] * m + VELOCITY[1] * n) / (m + n);
        [center + left * (n / (m + n)), center - left * (m / (m + n))]
    };
    let kinetic = |v: Vec3, w: Vec3| 0.5 * (m * v.norm_squared() + n * w.norm_squared());
    let lost = kinetic(VELOCITY[0], VELOCITY[1]) - kinetic(first, second);
    let rest = if is_one { 0.0 } else { restitution };
    let normal = 0.5 * m * n / (m + n) * (1.0 - rest * rest) * approach * approach;
    // Without areas of a law: all of the smaller cross-section at e = 0, nothing at e = 1.
    let area = (1.0 - restitution) * PI * RADIUS[1] * RADIUS[1];
    let reaction = 0.5 * (REACTION[0] + REACTION[1]) * area;
    let surface = surfaces[0] + surfaces[1];
    let heat = lost + reaction - surface;
    let warm = |k: usize| TEMPERATURE[k] + heat * mass(k) / (m + n) / capacity(k);
    After {
        velocities: [first, second],
        temperatures: [warm(0), warm(1)],
        energies: [normal, lost - normal, reaction, surface, heat],
    }
}

/// Where the center of clay is at the collision: inside, or with lead across the upper faces of x and z.
fn hit_place(boundary: &str) -> Vec3 {
    if boundary == "open" { Vec3::new(1e-3, -0.5e-3, 0.3e-3) } else { Vec3::new(9.7e-3, -0.5e-3, 9.4e-3) }
}

fn wrapped(place: Vec3) -> Vec3 {
    Vec3::from(place.to_array().map(|along| along - EDGE * (along / EDGE).round()))
}

/// The two before they meet, at their temperatures.
fn start(engine: &str, boundary: &str, impact: &str, gammas: [f64; 2], names: [usize; 2]) -> Simulation {
    start_at(engine, boundary, impact, gammas, (names, TEMPERATURE))
}

/// The two before they meet, at these temperatures [K]. `names` has the places of clay and lead in the list, which are their names as well.
fn start_at(
    engine: &str,
    boundary: &str,
    impact: &str,
    gammas: [f64; 2],
    (names, temperatures): ([usize; 2], [f64; 2]),
) -> Simulation {
    let material = |k: usize, name: &str| {
        format!(
            "[materials.{name}]\ndensity = \"{} kg/m3\"\nheat_capacity = \"{} J/kg/K\"\nreaction_heat = \"{} J/m^2\"\n\
             surface_energy = \"{:e} J/m^2\"\nemissivity = {}\n",
            DENSITY[k], HEAT_CAPACITY[k], REACTION[k], gammas[k], EMISSIVITY[k]
        )
    };
    let text = format!(
        "version = 1\ntime.end = \"{END:e} s\"\n{engine}\n{}{}[[grains]]\nmaterial = \"clay\"\n\
         size.constant.radius = \"1 mm\"\nplacement.table.file = \"none\"\n[[grains]]\nmaterial = \"lead\"\n\
         size.constant.radius = \"1 mm\"\nplacement.table.file = \"none\"\n[volume]\nlower = [\"-1 cm\", \"-1 cm\", \"-1 cm\"]\n\
         upper = [\"1 cm\", \"1 cm\", \"1 cm\"]\nboundary = \"{boundary}\"\n{impact}\n",
        material(0, "clay"),
        material(1, "lead"),
    );
    let scenario: Scenario = toml::from_str(&text).unwrap();
    let place = hit_place(boundary);
    let centers = [place, place + NORMAL * (RADIUS[0] + RADIUS[1])];
    let (mut grains, mut grown) = (Particles::default(), Vec::new());
    for at in [0, 1] {
        let k = names.iter().position(|name| *name == at).unwrap();
        grains.push(Row {
            id: at as u32,
            position: wrapped(centers[k] - VELOCITY[k] * MEETING),
            velocity: VELOCITY[k],
            radius: RADIUS[k],
            mass: mass(k),
            temperature: temperatures[k],
            material: k as u32,
            polarity: 1.0,
            ..Row::default()
        });
        grown.push(Grown { primaries: PRIMARIES[k], heat_capacity: capacity(k) });
    }
    let mut simulation = Simulation::start(&scenario, Start { grown, ..Start::from(grains) }).unwrap();
    simulation.system_mut().keeps_events = true;
    simulation
}

/// Goes on to a time [s] or beyond, which takes some dozen steps.
fn advance_to(simulation: &mut Simulation, until: f64) {
    for _ in 0..10_000 {
        if simulation.clock().time >= until {
            return;
        }
        simulation.advance(until).unwrap_or_else(|error| panic!("{error}"));
    }
    panic!("after 10000 steps the time is {} s of {until} s", simulation.clock().time);
}

/// All engines, faces and orders of names.
fn each_way(run: impl Fn(&str, f64, &str, [usize; 2])) {
    for (engine, tolerance) in [EVENTS, STEPS] {
        for boundary in ["open", "periodic"] {
            for names in [[0, 1], [1, 0]] {
                run(engine, tolerance, boundary, names);
            }
        }
    }
}

/// The ledger's channels, each by its name, and both drifts.
fn assert_ledger(simulation: &Simulation, wanted: [f64; 5], tolerance: f64, what: &str) {
    let balance = simulation.balance();
    let found = [balance.normal, balance.friction, balance.reaction, balance.surface, balance.heat];
    let names = ["lost along the normal", "lost to friction", "reaction", "surface", "heat"];
    let whole = wanted[4].abs();
    for ((name, found), wanted) in names.iter().zip(found).zip(wanted) {
        assert_near!(found, wanted, tolerance * whole, "{what}: {name}, J");
    }
    // Kinetic energy is some 1e-5 J, heat of the grains some 0.3 J.
    assert_near!(balance.kinetic_drift_relative, 0.0, 1e-13, "{what}: of the kinetic energy");
    assert_near!(balance.drift_relative, 0.0, 1e-13, "{what}: of all energy");
    assert_near!(simulation.momentum_drift_relative(), 0.0, 1e-13, "{what}: of the momentum");
}

fn constant(restitution: f64, more: &str) -> String {
    constant_with(FRICTION, restitution, more)
}

fn constant_with(friction: f64, restitution: f64, more: &str) -> String {
    format!(
        "[impact]\n{more}\ntangential.friction = {friction}\nrestitution.constant.restitution = {restitution}\n"
    )
}

fn assert_bounce(friction: f64, restitution: f64, more: &str) {
    let hand = by_hand_with(friction, restitution, false, [0.0; 2]);
    each_way(|engine, tolerance, boundary, names| {
        let what = format!("{engine} {boundary} {names:?} e = {restitution}");
        let mut simulation =
            start(engine, boundary, &constant_with(friction, restitution, more), [1.0, 1.0], names);
        advance_to(&mut simulation, END);
        let now = simulation.snapshot();
        assert_eq!(now.grains.id, [0, 1], "{what}: names");
        let place = hit_place(boundary);
        let centers = [place, place + NORMAL * (RADIUS[0] + RADIUS[1])];
        for k in [0, 1] {
            let at = names[k];
            assert_close_vector!(
                now.grains.velocity[at],
                hand.velocities[k],
                tolerance,
                "{what}: velocity, m/s"
            );
            assert_close!(
                now.grains.temperature[at],
                hand.temperatures[k],
                tolerance,
                "{what}: temperature, K"
            );
            let wanted = centers[k] + hand.velocities[k] * (END - MEETING);
            let off = wrapped(now.grains.position[at] - wanted);
            assert_near!(off.norm(), 0.0, tolerance * 1e-3, "{what}: off its place, m");
            assert_eq!((now.grains.material[at], now.primaries[at]), (k as u32, PRIMARIES[k]), "{what}");
            assert_close!(now.grains.radius[at], RADIUS[k], 1e-15, "{what}: radius, m");
        }
        assert_ledger(&simulation, hand.energies, 10.0 * tolerance, &what);
        assert_eq!(simulation.system().state.counts.bounces, 1, "{what}: bounces");
    });
}

/// e = 0.6 with friction that the slip outlasts.
#[test]
fn an_oblique_bounce_of_clay_and_lead() {
    assert_bounce(FRICTION, 0.6, "");
}

/// Friction of 5 would turn the slip round; it ends it.
#[test]
fn friction_ends_the_slip_of_clay_and_lead() {
    assert_bounce(5.0, 0.6, "");
}

/// A pair of sticky spheres that stay two: nothing is left of the approach, and the slip goes on.
#[test]
fn clay_and_lead_that_stay_two_at_no_restitution() {
    assert_bounce(FRICTION, 0.0, "sticking = \"never\"");
}

/// Heat in halves: each its own temperature.
#[test]
fn heat_in_halves_of_clay_and_lead() {
    let hand = by_hand(0.6, false, [0.0; 2]);
    each_way(|engine, tolerance, boundary, names| {
        let mut simulation =
            start(engine, boundary, &constant(0.6, "heat.share = \"equal\""), [1.0, 1.0], names);
        advance_to(&mut simulation, END);
        let now = simulation.snapshot().grains;
        for k in [0, 1] {
            let wanted = 0.5 * hand.energies[4] / capacity(k);
            let found = now.temperature[names[k]] - TEMPERATURE[k];
            // The difference has lost five digits.
            assert_close!(found, wanted, 1e5 * tolerance.max(1e-12), "{engine} {boundary}: rise of {k}, K");
        }
    });
}

/// The merged sphere: its mass, place, velocity, size, heat and material, its name and its line in the table of events.
#[test]
fn clay_and_lead_that_merge() {
    let hand = by_hand(0.0, true, [0.0; 2]);
    let [m, n] = [mass(0), mass(1)];
    assert_above!(n, m, "lead is the heavier one, kg");
    let heat_capacity = capacity(0) + capacity(1);
    let heat = capacity(0) * TEMPERATURE[0] + capacity(1) * TEMPERATURE[1] + hand.energies[4];
    each_way(|engine, tolerance, boundary, names| {
        let what = format!("{engine} {boundary} {names:?}");
        let mut simulation = start(engine, boundary, &constant(0.0, ""), [1.0, 1.0], names);
        advance_to(&mut simulation, END);
        let now = simulation.snapshot();
        assert_eq!(now.grains.len(), 1, "{what}: spheres");
        let grains = &now.grains;
        assert_close!(grains.mass[0], m + n, 1e-14, "{what}: mass, kg");
        assert_close!(
            grains.radius[0],
            (RADIUS[0].powi(3) + RADIUS[1].powi(3)).cbrt(),
            1e-14,
            "{what}: radius, m"
        );
        assert_close_vector!(grains.velocity[0], hand.velocities[0], 1e-13, "{what}: velocity, m/s");
        assert_close!(grains.temperature[0], heat / heat_capacity, tolerance, "{what}: temperature, K");
        let center = hit_place(boundary) + NORMAL * ((RADIUS[0] + RADIUS[1]) * n / (m + n));
        let off = wrapped(grains.position[0] - center - hand.velocities[0] * (END - MEETING));
        assert_near!(off.norm(), 0.0, tolerance * 1e-3, "{what}: off its place, m");
        assert_eq!(
            (grains.material[0], now.primaries[0]),
            (1, 18),
            "{what}: material of lead, and primaries"
        );
        assert_eq!(grains.id[0] as usize, names[1], "{what}: the name of the heavier one");
        let bulk = &simulation.system().state.spheres.bulk;
        let kept = bulk.iter().find(|bulk| bulk.primaries == 18).unwrap();
        assert_close!(kept.heat_capacity, heat_capacity, 1e-14, "{what}: heat capacity, J/K");
        assert_ledger(&simulation, hand.energies, 10.0 * tolerance, &what);
        assert_story(&simulation, EventKind::Merge, 0.0, &hand, names, (tolerance, &what));
        let told: Vec<_> = simulation
            .system()
            .descents
            .iter()
            .map(|line| (line.parent, line.child, line.primaries))
            .collect();
        let [clay, lead] = names.map(|name| name as u32);
        assert_eq!(told, [(lead, lead, 6), (clay, lead, 12)], "{what}: parent, child, primaries");
    });
}

/// The table of events: time, partners in the order of their names with their masses, speed of approach, energies.
fn assert_story(
    simulation: &Simulation,
    kind: EventKind,
    restitution: f64,
    hand: &After,
    names: [usize; 2],
    (tolerance, what): (f64, &str),
) {
    let [event] = &simulation.system().events[..] else { panic!("{what}: {:?}", simulation.system().events) };
    assert_eq!((event.number, event.kind, event.grains), (1, kind, [0, 1]), "{what}");
    for k in [0, 1] {
        assert_close!(event.masses[names[k]], mass(k), 1e-15, "{what}: mass of {k}, kg");
    }
    assert_near!(event.time, MEETING, 1e3 * tolerance * MEETING, "{what}: time, s");
    assert_close!(event.speed, (VELOCITY[0] - VELOCITY[1]).dot(NORMAL), tolerance, "{what}: approach, m/s");
    assert_near!(event.restitution, restitution, 1e-15, "{what}: restitution");
    let energy = event.energy;
    let found = [energy.normal, energy.tangential, energy.reaction, energy.surface, energy.heat];
    for (k, (found, wanted)) in found.into_iter().zip(hand.energies).enumerate() {
        assert_near!(
            found,
            wanted,
            10.0 * tolerance * hand.energies[4],
            "{what}: energy {k} of the event, J"
        );
    }
}

/// Clay of twelve primaries breaks into three, lead of six into two: surface energies are such that each could take 1.5 and 1.3
/// times its surface, (1.5)³ = 3.4 and (1.3)³ = 2.2 fragments. With the other's mass or radius it would be other numbers.
#[test]
fn clay_and_lead_that_break() {
    let [m, n] = [mass(0), mass(1)];
    let whole = by_hand(0.3, false, [0.0; 2]);
    let lost = whole.energies[0] + whole.energies[1];
    let sphere = |k: usize| 4.0 * PI * RADIUS[k] * RADIUS[k];
    let gammas = [n / (m + n) * lost / (0.5 * sphere(0)), m / (m + n) * lost / (0.3 * sphere(1))];
    // n fragments of equal size have n^(1/3) times the surface.
    let fragments = [3, 2];
    let surfaces = [0, 1].map(|k| gammas[k] * sphere(k) * (f64::from(fragments[k]).cbrt() - 1.0));
    let hand = by_hand(0.3, false, surfaces);
    each_way(|engine, tolerance, boundary, names| {
        let what = format!("{engine} {boundary} {names:?}");
        let mut simulation = start(engine, boundary, &constant(0.3, "fragmentation = {}"), gammas, names);
        advance_to(&mut simulation, MEETING * (1.0 + 1e-6));
        let now = simulation.snapshot();
        let grains = &now.grains;
        for k in [0, 1] {
            let own: Vec<usize> = (0..grains.len()).filter(|at| grains.material[*at] == k as u32).collect();
            assert_eq!(own.len(), fragments[k] as usize, "{what}: fragments of {k}");
            let part = 1.0 / f64::from(fragments[k]);
            // How far the fragments are in the mean from where each of the two was.
            let mut off = [Vec3::ZERO; 2];
            for at in own {
                assert_eq!(
                    now.primaries[at],
                    PRIMARIES[k] / fragments[k],
                    "{what}: primaries of a fragment of {k}"
                );
                assert_close!(
                    grains.mass[at],
                    mass(k) * part,
                    1e-14,
                    "{what}: mass of a fragment of {k}, kg"
                );
                assert_close!(
                    grains.radius[at],
                    RADIUS[k] * part.cbrt(),
                    1e-14,
                    "{what}: radius of a fragment of {k}, m"
                );
                let (velocity, wanted) = (grains.velocity[at], hand.velocities[k]);
                assert_close_vector!(
                    velocity,
                    wanted,
                    tolerance,
                    "{what}: velocity of a fragment of {k}, m/s"
                );
                let (warm, wanted) = (grains.temperature[at], hand.temperatures[k]);
                assert_close!(warm, wanted, tolerance, "{what}: temperature of a fragment of {k}, K");
                let moved = velocity * (simulation.clock().time - MEETING);
                for (other, mean) in off.iter_mut().enumerate() {
                    let center = hit_place(boundary) + NORMAL * ((RADIUS[0] + RADIUS[1]) * other as f64);
                    *mean += wrapped(grains.position[at] - center - moved) * part;
                }
            }
            assert_below!(
                off[k].norm(),
                off[1 - k].norm(),
                "{what}: fragments of {k} from its place and the other's, m"
            );
        }
        assert_ledger(&simulation, hand.energies, 10.0 * tolerance, &what);
        assert_story(&simulation, EventKind::Break, 0.3, &hand, names, (tolerance, &what));
        let counts = &simulation.system().state.counts;
        assert_eq!(
            (counts.fragmentations, counts.no_room),
            (2, 0),
            "{what}: those that broke, those without room"
        );
        let mut told = [[0; 2]; 2];
        for line in &simulation.system().descents {
            let k = usize::from(line.parent as usize == names[1]);
            told[k][0] += 1;
            told[k][1] += line.primaries;
            assert_close!(
                line.mass,
                mass(k) / f64::from(fragments[k]),
                1e-14,
                "{what}: mass in a line of {k}, kg"
            );
        }
        assert_eq!(told, [[3, 12], [2, 6]], "{what}: lines of descent and their primaries");
    });
}

/// Radiation into cold space before and after an elastic impact: T⁻³ grows by 3 ε σ a_s t/C, each with its own ε, a_s and C.
#[test]
fn clay_and_lead_that_cool() {
    let law = "cooling.surroundings = \"1e-3 K\"";
    each_way(|engine, _, boundary, names| {
        // Hot enough to lose some thousandths, clay, and some hundredths, lead.
        let hot = TEMPERATURE.map(|temperature| 30.0 * temperature);
        let impact = constant(1.0, law);
        let mut simulation = start_at(engine, boundary, &impact, [1.0, 1.0], (names, hot));
        advance_to(&mut simulation, END);
        let (now, mut given_off) = (simulation.snapshot().grains, 0.0);
        for k in [0, 1] {
            let rate =
                3.0 * EMISSIVITY[k] * STEFAN_BOLTZMANN * 4.0 * PI * RADIUS[k] * RADIUS[k] / capacity(k);
            let friction =
                by_hand(1.0, false, [0.0; 2]).energies[4] * mass(k) / (mass(0) + mass(1)) / capacity(k);
            let after = |start: f64, time: f64| (start.powi(-3) + rate * time).cbrt().recip();
            let wanted = after(after(hot[k], MEETING) + friction, END - MEETING);
            // Late by 1 ps, and each part of the cooling solved to 1e-13.
            assert_close!(
                now.temperature[names[k]],
                wanted,
                1e-10,
                "{engine} {boundary}: temperature of {k}, K"
            );
            given_off += capacity(k) * (hot[k] + friction - wanted);
        }
        let cooled = simulation.balance().cooled;
        assert_close!(cooled, given_off, 1e-9, "{engine} {boundary}: heat given off, J");
    });
}
