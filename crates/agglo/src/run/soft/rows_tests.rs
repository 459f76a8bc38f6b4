//! Tables over time of soft spheres: from a state of distinct quantities into files, and back by the names of the columns.

use super::distinct::*;
use super::*;
use crate::acoustics::PulseCount;
use crate::contact::bond::Break;
use crate::contact::network::BondEvent;
use crate::math::Vec3;
use crate::run::distinct::{assert_table, tables};

/// Round-off: sums of 7 grains and differences of a few energies.
const ROUND_OFF: f64 = 1e-12;

fn folder_of_rows() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut tables = tables(Soft::TABLES, folder.path());
    distinct().record_rows(&mut tables).unwrap();
    tables.flush().unwrap();
    folder
}

fn assert_row(table: &str, rest: &[(&str, f64)], part: f64) {
    let wanted: Vec<(&str, f64)> =
        std::iter::once(("time_s", TIMES[0])).chain(rest.iter().copied()).collect();
    assert_table(folder_of_rows().path(), table, &wanted, part);
}

/// Coulomb's constant above has 11 digits, which the near field and the drift take part in.
#[test]
fn energies_of_soft_spheres_stand_under_their_names() {
    assert_row("series/energy.csv", &energies(), 1e-9);
}

#[test]
fn momenta_of_soft_spheres_stand_under_their_names() {
    let ByHand { momentum: [p, l], drift: [dp, dl], .. } = by_hand();
    let wanted = [
        ("px_kg_m_s", p.x),
        ("py_kg_m_s", p.y),
        ("pz_kg_m_s", p.z),
        ("lx_kg_m2_s", l.x),
        ("ly_kg_m2_s", l.y),
        ("lz_kg_m2_s", l.z),
        ("drift_px_kg_m_s", dp.x),
        ("drift_py_kg_m_s", dp.y),
        ("drift_pz_kg_m_s", dp.z),
        ("drift_lx_kg_m2_s", dl.x),
        ("drift_ly_kg_m2_s", dl.y),
        ("drift_lz_kg_m2_s", dl.z),
    ];
    assert_row("series/momentum.csv", &wanted, ROUND_OFF);
}

/// Radius of gyration [m] of some grains: solid spheres about their common center of mass.
fn gyration(members: &[usize]) -> f64 {
    let mass: f64 = members.iter().map(|&id| MASSES[id]).sum();
    let center: Vec3 = members.iter().map(|&id| Vec3::from(PLACES[id]) * (MASSES[id] / mass)).sum();
    let about = |&id: &usize| {
        MASSES[id] * ((Vec3::from(PLACES[id]) - center).norm_squared() + 3.0 / 5.0 * RADII[id] * RADII[id])
    };
    (members.iter().map(about).sum::<f64>() / mass).sqrt()
}

#[test]
fn clusters_of_soft_spheres_stand_under_their_names() {
    let nearest = |id: usize| {
        let to = |other: usize| (Vec3::from(PLACES[id]) - Vec3::from(PLACES[other])).norm();
        (0..7).filter(|other| *other != id).map(to).fold(f64::INFINITY, f64::min)
    };
    // Grains 0, 1 and 2 have 1.125 kg of 1.875 kg.
    let largest = 0.6;
    let wanted = [
        ("clusters", 4.0),
        ("largest_fraction", largest),
        ("largest_grains", 3.0),
        ("dispersion_degree", 1.0 - largest),
        ("radius_of_gyration_m", gyration(&[0, 1, 2, 3, 4, 5, 6])),
        ("largest_radius_of_gyration_m", gyration(&[0, 1, 2])),
        ("fractal_dimension", f64::NAN),
        ("contacts", 1.0),
        ("bonds", 2.0),
        ("mean_nearest_distance_m", (0..7).map(nearest).sum::<f64>() / 7.0),
        ("dispersion_degree_relative", 1.0 - largest / CLUSTERS_START.largest_fraction),
        ("grains", 7.0),
        ("absorbed", 19.0),
        ("absorbed_kg", 0.375),
    ];
    assert_row("series/clusters.csv", &wanted, ROUND_OFF);
}

/// A row of 41 grains that touch and, apart from it, a ball of 33: the dimension in the table is that of the row, which has the
/// more mass, with the masses of its grains.
#[test]
fn the_fractal_dimension_is_that_of_the_heaviest_cluster() {
    let row = (-20..=20).map(|k| [f64::from(k) * 2e-3, 0.0, 0.0]);
    let block = (0..125).map(|k| [k % 5 - 2, k / 5 % 5 - 2, k / 25 - 2].map(f64::from));
    let ball = block.filter(|at| at.iter().map(|along| along * along).sum::<f64>() < 4.5);
    let ball = ball.map(|[x, y, z]| [x * 2e-3, y * 2e-3 + 0.03, z * 2e-3]);
    let places: Vec<[f64; 3]> = row.chain(ball).collect();
    let list: Vec<String> =
        places.iter().map(|[x, y, z]| format!("[\"{x:e} m\", \"{y:e} m\", \"{z:e} m\"]")).collect();
    let text = format!(
        "version = 1\ntime.end = \"1 s\"\nengine.verlet.step = \"1 us\"\n[materials.glass]\ndensity = \"2500 kg/m3\"\n\
         youngs_modulus = \"1 MPa\"\npoisson_ratio = 0.2\n[[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"1 mm\"\n\
         placement.list.positions = [{}]\n[contact.normal.hertz]\n[measures]\ncluster_gap = 0.5\n",
        list.join(", ")
    );
    let scenario = Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"));
    let mut grains = crate::packing::place(&scenario, std::path::Path::new("")).unwrap();
    // Ever heavier along the row: with equal masses it would be another dimension.
    let heavy = |x: f64| 1e-5 * (1.0 + (x / 0.02).powi(2));
    for (mass, place) in grains.mass.iter_mut().zip(&grains.position) {
        *mass = if place.y == 0.0 { heavy(place.x) } else { 1e-6 };
    }
    let members = |is_row: bool| -> Vec<u32> {
        (0..grains.len()).filter(|at| (grains.position[*at].y == 0.0) == is_row).map(|at| at as u32).collect()
    };
    let of = |masses: &[f64], members: &[u32]| {
        crate::measure::fractal_dimension(&grains.position, &grains.radius, masses, members).unwrap()
    };
    let (wanted, others) = (of(&grains.mass, &members(true)), of(&vec![1.0; grains.len()], &members(true)));
    assert_between!(wanted, 0.8..1.2, "of a row, whose masses grow outwards");
    assert_above!((wanted - others).abs(), 0.01, "equal masses give {others}");
    let mut job =
        Soft::start(&scenario, grains.into(), &mut |_| std::ops::ControlFlow::Continue(())).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let mut tables = tables(Soft::TABLES, folder.path());
    job.record_rows(&mut tables).unwrap();
    tables.flush().unwrap();
    let (names, cells) = crate::run::distinct::only_row(folder.path(), "series/clusters.csv");
    let cell = |column: &str| -> f64 {
        cells[names.iter().position(|name| name == column).unwrap()].parse().unwrap()
    };
    assert_eq!([cell("clusters"), cell("largest_grains")], [2.0, 41.0], "clusters, grains of the row");
    // Sums of 41 grains in another order.
    assert_close!(cell("fractal_dimension"), wanted, 1e-12, "series/clusters.csv: fractal_dimension");
}

/// Mean, deviation, skewness and kurtosis by mass ([A] 40).
fn moments_by_mass(values: [f64; 7]) -> [f64; 4] {
    let mass: f64 = MASSES.iter().sum();
    let mean = values.iter().zip(MASSES).map(|(value, m)| m * value).sum::<f64>() / mass;
    let about = |p: i32| values.iter().zip(MASSES).map(|(q, m)| m * (q - mean).powi(p)).sum::<f64>() / mass;
    let deviation = about(2).sqrt();
    [mean, deviation, about(3) / deviation.powi(3), about(4) / deviation.powi(4)]
}

#[test]
fn moments_of_soft_spheres_stand_under_their_names() {
    let [x, y, z] = [0, 1, 2].map(|axis| moments_by_mass(PLACES.map(|place| place[axis])));
    let speeds = VELOCITIES.map(|velocity| Vec3::from(velocity).norm());
    let speed = moments_by_mass(speeds);
    let wanted = [
        ("mean_x_m", x[0]),
        ("mean_y_m", y[0]),
        ("mean_z_m", z[0]),
        ("deviation_x_m", x[1]),
        ("deviation_y_m", y[1]),
        ("deviation_z_m", z[1]),
        ("mean_speed_m_s", speed[0]),
        ("deviation_speed_m_s", speed[1]),
        ("skewness_speed", speed[2]),
        ("kurtosis_speed", speed[3]),
        ("largest_speed_m_s", speeds.into_iter().fold(0.0, f64::max)),
    ];
    // The skewness is a difference of terms ten times as large.
    assert_row("series/moments.csv", &wanted, 100.0 * ROUND_OFF);
}

/// Sums over all pulses; `beam` over the latest pulse of each beam, with the rays that ended; `flying` over all rays in flight
/// alone: [A] 39.
#[test]
fn rays_of_soft_spheres_stand_under_their_names() {
    let pulses = pulses();
    let sum = |of: fn(&PulseCount) -> f64| pulses.iter().map(of).sum::<f64>();
    let power_in = pulses[1].power_in + pulses[2].power_in;
    let flying = |at: &[usize]| {
        let rays = RAYS.iter().filter(|ray| at.contains(&ray.0));
        rays.fold((Vec3::ZERO, 0.0, 0.0), |(flow, power, square), &(_, _, direction, _, watt)| {
            (flow + Vec3::from(direction) * watt, power + watt, square + watt * watt)
        })
    };
    let (latest, all) = (flying(&[1, 2]), flying(&[0, 1, 2]));
    let mut beam = (latest.0, latest.1, latest.2);
    for ended in &pulses[1..] {
        beam.0 += ended.flow_ended;
        beam.1 += ended.power_escaped + ended.power_truncated + ended.power_cut_off;
        beam.2 += ended.squares_ended;
    }
    let wanted = [
        ("pulses", 3.0),
        ("in_flight", 7.0),
        ("reflections", sum(|pulse| pulse.reflections as f64)),
        ("reflections_at_walls", sum(|pulse| pulse.reflections_at_walls as f64)),
        ("segments", sum(|pulse| pulse.segments as f64)),
        ("power_in_W", sum(|pulse| pulse.power_in)),
        ("power_absorbed_W", sum(|pulse| pulse.power_absorbed)),
        ("power_into_walls_W", sum(|pulse| pulse.power_into_walls)),
        ("power_escaped_W", sum(|pulse| pulse.power_escaped)),
        ("power_truncated_W", sum(|pulse| pulse.power_truncated)),
        ("power_cut_off_W", sum(|pulse| pulse.power_cut_off)),
        ("beam_x", beam.0.x / power_in),
        ("beam_y", beam.0.y / power_in),
        ("beam_z", beam.0.z / power_in),
        ("beam_magnitude", beam.1 / power_in),
        ("beam_root_of_squares", beam.2.sqrt() / power_in),
        ("flying_x", all.0.x / power_in),
        ("flying_y", all.0.y / power_in),
        ("flying_z", all.0.z / power_in),
        ("flying_magnitude", all.1 / power_in),
    ];
    assert_row("series/rays.csv", &wanted, ROUND_OFF);
}

#[test]
fn steps_of_soft_spheres_stand_under_their_names() {
    let wanted = [
        ("step", 71.0),
        ("step_size_s", TIMES[1]),
        ("iterations", 311.0),
        ("rejected", 13.0),
        ("largest_strain", 0.0175),
    ];
    assert_row("series/steps.csv", &wanted, 0.0);
}

/// Names and not places of the grains, each kind in its words, the energy with its sign.
#[test]
fn events_of_bonds_stand_under_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let mut tables = tables(Soft::TABLES, folder.path());
    let mut job = distinct();
    let event = |time: f64, ids: [u32; 2], broke, energy| BondEvent { time, ids, broke, energy };
    job.simulation.events = vec![
        event(0.125, [4, 9], Some(Break::Tension), 2.5),
        event(0.25, [3, 6], Some(Break::Shear), 1.75),
        event(0.375, [2, 8], None, -0.5),
    ];
    job.record_events(&mut tables).unwrap();
    assert!(job.simulation.events.is_empty(), "events are written once");
    tables.flush().unwrap();
    let text = std::fs::read_to_string(folder.path().join("events.csv")).unwrap();
    let wanted = "time_s,grain_i,grain_j,event,energy_J\n0.125,4,9,broken_in_tension,2.5\n\
                  0.25,3,6,broken_in_shear,1.75\n0.375,2,8,made,-0.5\n";
    assert_eq!(text, wanted, "events.csv: found on the left, due on the right");
}
