//! Tables over time of soft spheres: from a state of distinct figures into files, and back by the names of the columns.

use super::distinct::*;
use super::*;
use crate::acoustics::PulseCount;
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
    ];
    assert_row("series/clusters.csv", &wanted, ROUND_OFF);
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
        beam.1 += ended.power_escaped + ended.power_truncated;
        beam.2 += ended.squares_ended;
    }
    let wanted = [
        ("pulses", 3.0),
        ("in_flight", 7.0),
        ("reflections", sum(|pulse| pulse.reflections as f64)),
        ("segments", sum(|pulse| pulse.segments as f64)),
        ("power_in_W", sum(|pulse| pulse.power_in)),
        ("power_absorbed_W", sum(|pulse| pulse.power_absorbed)),
        ("power_escaped_W", sum(|pulse| pulse.power_escaped)),
        ("power_truncated_W", sum(|pulse| pulse.power_truncated)),
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
