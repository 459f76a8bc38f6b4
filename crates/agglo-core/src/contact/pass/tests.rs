use std::collections::BTreeMap;

use super::*;
use crate::contact::bond::{Bonds, StrainBond};
use crate::contact::damping::{Damping, Restitution, ViscousArea};
use crate::contact::friction::{Friction, Mindlin, Regularized, Sliding};
use crate::contact::normal::{Hertz, Hooke, Normal, StrainPower};
use crate::contact::{ContactGeometry, Custom, PairTable, lever_arms};
use crate::domain::Space;
use crate::math::rng::{Purpose, Stream};
use crate::particles::{Material, Particles, Row};
use crate::units::Quantity;

/// Grains of two materials and sizes from 1 to 3, so crowded that each touches some others; more than two blocks of them.
fn crowd() -> Particles {
    let mut stream = Stream::new(5, Purpose::Sampling, 0);
    let mut grains = Particles::default();
    let side = 30e-6;
    for id in 0..2500 {
        let radius = 1e-6 * (1.0 + 2.0 * stream.uniform() * stream.uniform());
        let mut vector = |size: f64| Vec3::new(stream.normal(), stream.normal(), stream.normal()) * size;
        let (velocity, angular_velocity) = (vector(0.1), vector(1e5));
        grains.push(Row {
            id,
            radius,
            mass: 2500.0 * 4.18879 * radius.powi(3),
            position: Vec3::new(stream.uniform(), stream.uniform(), stream.uniform()) * side,
            velocity,
            angular_velocity,
            material: id % 2,
            contact_stiffness: 1e7 * f64::from(1 + id % 2),
            ..Row::default()
        });
    }
    grains
}

fn materials() -> BTreeMap<String, Material> {
    let of = |modulus: f64| Material {
        density: Quantity(2500.0),
        youngs_modulus: Some(Quantity(modulus)),
        poisson_ratio: Some(0.3),
        ..Material::default()
    };
    BTreeMap::from([("clay".to_owned(), of(1e7)), ("sand".to_owned(), of(7e7))])
}

/// Every law with each of another kind, and none.
fn choices() -> Vec<(ContactLaws, Option<Bonds>)> {
    let normals = [
        Normal::Hertz(Hertz {}),
        Normal::Hooke(Hooke { stiffness: Quantity(20.0) }),
        Normal::StrainPower(StrainPower { exponent: 1.7 }),
    ];
    let dampings = [
        None,
        Some(Damping::Restitution(Restitution { restitution: 0.4 })),
        Some(Damping::ViscousArea(ViscousArea { coefficient: Quantity(1e4) })),
    ];
    let mindlin =
        Mindlin { static_friction: 0.3, dynamic_friction: Some(0.2), stiffness_ratio: None, dashpot: 0.3 };
    let regularized = Regularized { stiffness: Quantity(1e16), static_friction: 0.5, dynamic_friction: 0.3 };
    let frictions = [None, Some(Friction::Mindlin(mindlin)), Some(Friction::Regularized(regularized))];
    let bond = Bonds::StrainBond(StrainBond {
        stiffness: Quantity(1e5),
        exponent: 1.5,
        tangential_stiffness: Quantity(1e12),
        threshold_strain: 0.1,
    });
    let mut all = Vec::new();
    for normal in &normals {
        for damping in &dampings {
            for friction in &frictions {
                let laws = ContactLaws {
                    normal: Some(normal.clone()),
                    custom: None,
                    damping: damping.clone(),
                    friction: friction.clone(),
                };
                all.push((laws, friction.is_none().then(|| bond.clone())));
            }
        }
    }
    let custom = Some(Custom::new("20*overlap + 1e-6*speed"));
    all.push((ContactLaws { custom, ..all[4].0.clone() }, None));
    all
}

/// Length of a step [s].
const DT: f64 = 1e-9;

/// Every bit of what some steps of a pass gave: loads, rates and memory.
fn bits_of_steps(laws: &ContactLaws, bonds: Option<&Bonds>, skin: f64, is_one_by_one: bool) -> Vec<u64> {
    let grains = crowd();
    let pairs = PairTable::new(&materials(), &[], Some(laws));
    let mut list = PairList::default();
    list.build(&Space::OPEN, &(&grains.position[..], &grains.radius[..]), laws.reach(), skin);
    let mut contacts = Contacts::default();
    contacts.relist(&list, grains.len(), Some(laws));
    let mut found = Vec::new();
    let mut before = (grains.position.clone(), grains.velocity.clone(), grains.angular_velocity.clone());
    let dt = DT;
    for _ in 0..4 {
        let position: Vec<Vec3> = before.0.iter().zip(&before.1).map(|(r, v)| *r + *v * dt).collect();
        let velocity: Vec<Vec3> = before.1.iter().map(|v| *v * 0.99 + Vec3::AXES[1] * 1e-3).collect();
        let spin: Vec<Vec3> = before.2.iter().map(|w| *w * 1.01).collect();
        let record = |at: usize| {
            let mut record = Record::at_start(&grains, at, grains.mass[at]);
            record.begin(before.0[at], before.1[at], before.2[at]);
            record.end(position[at], velocity[at] - before.1[at], spin[at] - before.2[at]);
            record
        };
        let records: Vec<Record> = (0..grains.len()).map(record).collect();
        let world = ContactWorld { laws: Some(laws), bonds, pairs: &pairs, list: &list, space: &Space::OPEN };
        let passage = Passage { records: &records, elapsed: dt, dt };
        let rates = contacts.compute_as(&Domain::default(), &world, &passage, is_one_by_one);
        contacts.commit();
        for grain in 0..grains.len() {
            let (force, torque) = contacts.load_on(grain);
            found.extend([force, torque].iter().flat_map(|of| of.to_array()).map(f64::to_bits));
        }
        found.extend([rates.damping, rates.driven, rates.tangential, rates.worst_strain].map(f64::to_bits));
        for (a, b, spring) in contacts.remembered(&list) {
            found.extend([u64::from(a), u64::from(b), u64::from(spring.sliding)]);
            found.extend(spring.force.to_array().map(f64::to_bits));
            found.push(spring.stiffness.to_bits());
        }
        before = (position, velocity, spin);
    }
    found
}

/// Lanes, threads and skins change no bit, and what they would change is there.
#[test]
fn every_law_gives_the_same_bits_in_lanes_on_threads_and_with_any_skin() {
    for (laws, bonds) in choices() {
        let of = |threads: usize, skin: f64, is_one_by_one: bool| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| bits_of_steps(&laws, bonds.as_ref(), skin, is_one_by_one))
        };
        let single = of(1, 1e-7, true);
        assert_all!(single.iter().map(|bits| f64::from_bits(*bits)), |value| !value.is_nan());
        assert_true!(single.len() > 4 * 2500 * 8, "grains touch");
        for (threads, skin) in [(1, 1e-7), (2, 1e-7), (3, 4e-7)] {
            assert_true!(of(threads, skin, false) == single, "{laws:?}, {threads} threads, skin {skin}");
        }
    }
}

/// Force on i [N], torques on both [N m], and powers lost to damping and friction [W] of one pair, from the columns.
fn by_hand(
    grains: &Particles,
    world: &ContactWorld<'_>,
    [i, j]: [usize; 2],
) -> Option<(Vec3, [Vec3; 2], [f64; 2])> {
    let laws = world.laws?;
    let apart = grains.position[j] - grains.position[i];
    let distance = apart.norm();
    if distance >= grains.radius[i] + grains.radius[j] {
        return None;
    }
    let of = |column: &[f64]| [column[i], column[j]];
    let (radii, masses) = (of(&grains.radius), of(&grains.mass));
    let geometry = ContactGeometry::new(radii, masses, of(&grains.contact_stiffness), distance);
    let (arms, normal) = (lever_arms(radii, distance), apart / distance);
    let surface = |k: usize, way: Vec3| grains.velocity[k] + grains.angular_velocity[k].cross(way);
    let velocity = surface(j, normal * -arms[1]) - surface(i, normal * arms[0]);
    let constants = world.pairs.of(grains.material[i], grains.material[j]);
    let along = laws.along(constants, &geometry, velocity.dot(normal));
    let slip = velocity.rejected_from(normal);
    let sliding = Sliding {
        normal,
        velocity: slip,
        elastic: along.elastic,
        normal_force: along.repulsion,
        dt: DT,
        ..Sliding::default()
    };
    let nothing = TangentialSpring::default();
    let friction = |law: &Friction| law.force(constants, &geometry, &sliding, &nothing).0;
    let across = laws.friction.as_ref().map_or(Vec3::ZERO, friction);
    let torques = arms.map(|arm| (normal * arm).cross(across));
    Some((across - normal * along.repulsion, torques, [along.dissipation, across.dot(slip)]))
}

/// Loads and rates by a sum over all pairs, one by one.
#[test]
fn loads_are_those_of_all_pairs() {
    let grains = crowd();
    for (laws, _) in choices().into_iter().filter(|(laws, _)| !laws.has_memory()) {
        let pairs = PairTable::new(&materials(), &[], Some(&laws));
        let mut list = PairList::default();
        list.build(&Space::OPEN, &(&grains.position[..], &grains.radius[..]), laws.reach(), 1e-7);
        let mut contacts = Contacts::default();
        contacts.relist(&list, grains.len(), Some(&laws));
        let record = |at: usize| Record::at_start(&grains, at, grains.mass[at]);
        let records: Vec<Record> = (0..grains.len()).map(record).collect();
        let world =
            ContactWorld { laws: Some(&laws), bonds: None, pairs: &pairs, list: &list, space: &Space::OPEN };
        let rates = contacts.compute(
            &Domain::default(),
            &world,
            &Passage { records: &records, elapsed: 0.0, dt: DT },
        );
        let (mut sums, mut lost) = (vec![(Vec3::ZERO, Vec3::ZERO); grains.len()], [0.0; 2]);
        for i in 0..grains.len() {
            for j in i + 1..grains.len() {
                let Some((force, torques, powers)) = by_hand(&grains, &world, [i, j]) else { continue };
                sums[i].0 += force;
                sums[j].0 -= force;
                sums[i].1 += torques[0];
                sums[j].1 += torques[1];
                lost = [lost[0] + powers[0], lost[1] + powers[1]];
            }
        }
        // What is left is the round-off of sums in another order.
        let largest = sums
            .iter()
            .fold([0.0_f64; 2], |[force, torque], of| [force.max(of.0.norm()), torque.max(of.1.norm())]);
        assert_above!(largest[0], 0.0, "in N");
        for (grain, (force, torque)) in sums.iter().enumerate() {
            let (found, turned) = contacts.load_on(grain);
            assert_near_vector!(found, *force, 1e-12 * largest[0], "in N, {laws:?}, grain {grain}");
            assert_near_vector!(turned, *torque, 1e-12 * largest[1], "in N m, {laws:?}, grain {grain}");
        }
        assert_near!(rates.damping, lost[0], 1e-12 * lost[0].abs(), "in W");
        assert_near!(rates.tangential, lost[1], 1e-11 * lost[1].abs(), "in W");
    }
}

/// A try may part the only contact that there is, so that the new list has none; a shorter one brings it back, with its spring.
#[test]
fn a_spring_outlives_a_list_without_pairs() {
    let (laws, _) = choices().into_iter().find(|(laws, _)| laws.has_memory()).unwrap();
    let list_at = |apart: f64| {
        let places = [Vec3::ZERO, Vec3::AXES[0] * apart];
        let mut list = PairList::default();
        list.build(&Space::OPEN, &(&places[..], &[1e-6; 2][..]), 0.0, 1e-7);
        list
    };
    let (near, far) = (list_at(1.9e-6), list_at(9e-6));
    let spring = TangentialSpring { force: Vec3::AXES[1] * 2e-9, stiffness: 10.0, sliding: true };
    let mut contacts = Contacts::default();
    contacts.set_aside_these(&[(0, 1, spring)]);
    contacts.relist(&near, 2, Some(&laws));
    let mut list = &near;
    for next in [&far, &far, &near] {
        contacts.set_aside(list, Some);
        contacts.relist(next, 2, Some(&laws));
        list = next;
        assert_eq!(contacts.remembered(list).collect::<Vec<_>>(), [(0, 1, spring)], "{} pairs", list.len());
    }
    assert_eq!(contacts.spring_energy(list), spring.energy());
}

/// By hand: a spring is loaded by the stiffness times the mean slip over the step, (v + v')/2 dt, and where both grains spin about
/// the normal at w it turns with them by w dt.
#[test]
fn springs_follow_the_mean_motion_of_the_step() {
    let mindlin =
        Mindlin { static_friction: 1e6, dynamic_friction: None, stiffness_ratio: Some(0.5), dashpot: 0.0 };
    let laws = ContactLaws {
        normal: Some(Normal::Hooke(Hooke { stiffness: Quantity(20.0) })),
        custom: None,
        damping: None,
        friction: Some(Friction::Mindlin(mindlin)),
    };
    let mut grains = Particles::default();
    for id in 0..2 {
        let position = Vec3::AXES[0] * (1.9e-6 * f64::from(id));
        grains.push(Row { id, radius: 1e-6, mass: 1e-14, position, ..Row::default() });
    }
    let pairs = PairTable::new(&materials(), &[], Some(&laws));
    let mut list = PairList::default();
    list.build(&Space::OPEN, &(&grains.position[..], &grains.radius[..]), 0.0, 1e-7);
    let mut contacts = Contacts::default();
    contacts.relist(&list, 2, Some(&laws));
    let mut pass = |velocities: [f64; 2], spins: [f64; 2]| {
        let record = |at: usize| {
            let mut record = Record::at_start(&grains, at, grains.mass[at]);
            let slip = Vec3::AXES[1] * at as f64;
            record.begin(grains.position[at], slip * velocities[0], Vec3::AXES[0] * spins[0]);
            let kick = slip * (velocities[1] - velocities[0]);
            record.end(grains.position[at], kick, Vec3::AXES[0] * (spins[1] - spins[0]));
            record
        };
        let records = [record(0), record(1)];
        let world =
            ContactWorld { laws: Some(&laws), bonds: None, pairs: &pairs, list: &list, space: &Space::OPEN };
        contacts.compute(&Domain::default(), &world, &Passage { records: &records, elapsed: DT, dt: DT });
        contacts.commit();
        contacts.remembered(&list).next().unwrap().2.force
    };
    let loaded = pass([0.1, 0.3], [0.0; 2]);
    let size = 0.5 * 20.0 * 0.2 * DT;
    assert_near_vector!(loaded, Vec3::AXES[1] * size, 1e-12 * size, "in N");
    let turned = pass([0.0; 2], [1e6, 3e6]);
    assert_close!(turned.norm(), size, 1e-12, "in N");
    assert_close!(turned.z / turned.y, 2e6 * DT, 1e-12);
}
