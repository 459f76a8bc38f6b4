//! Clusters of soft spheres made one hard sphere each.
//!
//! # Equation
//! ```text
//! M = sum(m),   X = sum(m x)/M,   V = sum(m v)/M,   b³ = sum(r³),   C T = sum(C_k T_k)
//! ```
//! Mass, momentum and heat are kept. Hard spheres do not turn and have no parts that move: the energy of turning and of shaking
//! and the angular momentum of a cluster about its own center are dropped, and the record says how much.

use std::path::Path;

use super::came_out::{CameOut, titled};
use super::files::{self, Cluster, Told};
use super::record::Cleared;
use super::{Grown, HandOver, HandOverError, Motion, Options, materials};
use crate::domain::Volume;
use crate::math::Vec3;
use crate::measure::{Clusters, RigidMotion, close_pairs, whole};
use crate::particles::{Material, Particles, Row};
use crate::scenario::Scenario;
use crate::units::{Quantity, vector};

/// Hands soft spheres over to hard ones.
pub(super) fn hand_over(grown: &Grown, options: &Options<'_>, to: &Path) -> Result<HandOver, HandOverError> {
    let used = grown.state.start.grains.material.iter().copied().collect();
    let mut scenario = materials::with_substances(grown, options, &used)?;
    let merged = merge(grown, &scenario)?;
    let volume = fit_volume(&mut scenario, &merged.grains);
    let before = &grown.state.start.grains;
    let [of_before, of_after] = [&grown.state.past.materials, &scenario.materials]
        .map(|names| materials::capacities(names, &scenario.materials));
    let motions = [(before, &of_before), (&merged.grains, &of_after)]
        .map(|(grains, capacities)| Motion::of(grains, materials::heat(grains, capacities)));
    let groups = files::groups(to, &scenario, &merged.grains, &merged.told)?;
    let record = HandOver {
        volume_m: volume,
        spin_dropped_kg_m2_s: merged.clusters.iter().map(|cluster| cluster.spin.norm()).sum(),
        notes: notes(grown),
        ..merged.record((grown, options, to), files::tables_of(&groups), motions)
    };
    scenario.title = format!("{}, each cluster one grain", titled(grown));
    files::write(&mut scenario, groups, &merged.clusters, &record)?;
    Ok(record)
}

fn notes(grown: &Grown) -> Vec<String> {
    let mut notes = vec![
        "hard spheres neither turn nor shake: that energy, and angular momenta of clusters about their own centers, are dropped"
            .to_owned(),
    ];
    let bonds = grown.state.start.bonds.as_ref().map_or(0, Vec::len);
    if bonds > 0 {
        notes.push(format!("{bonds} bonds, and the elastic energy in bonds and contacts, are dropped"));
    }
    notes
}

/// The clusters of a run as grains.
fn merge(grown: &Grown, scenario: &Scenario) -> Result<CameOut, HandOverError> {
    let (start, past) = (&grown.state.start, &grown.state.past);
    let (mut grains, space) = (start.grains.clone(), past.space());
    let mut edges: Vec<(u32, u32)> = start.bonds.iter().flatten().map(|bond| bond.grains.into()).collect();
    let gap = past.measures.cluster_gap;
    close_pairs(&space, &grains.position, &grains.radius, gap, &mut |a, b| edges.push((a, b)));
    grains.position = whole(&space, &grains.position, &edges).into_owned();
    let found = Clusters::new(&grains.mass, edges);
    let mut members = vec![Vec::new(); found.count()];
    for (grain, &label) in (0..).zip(&found.labels) {
        members[label as usize].push(grain);
    }
    let mut rows = Vec::new();
    let mut clusters = Vec::new();
    for (id, members) in (0..).zip(&members) {
        let (row, cluster) = one(grown, &grains, scenario, (id, members))?;
        rows.push(row);
        clusters.push(cluster);
    }
    let places: Vec<Vec3> = rows.iter().map(|row| row.position).collect();
    let (radii, masses): (Vec<f64>, Vec<f64>) = rows.iter().map(|row| (row.radius, row.mass)).unzip();
    let cleared = Cleared::of(&places, &masses, &radii);
    for ((row, cluster), &place) in rows.iter_mut().zip(&mut clusters).zip(&cleared.places) {
        row.position = place;
        cluster.places[1] = place;
    }
    let told = rows
        .iter()
        .zip(&clusters)
        .map(|(row, cluster)| Told { cluster: row.id, primaries: Some(cluster.primaries as u32) });
    let told: Vec<Told> = told.collect();
    Ok(CameOut::new(rows.into_iter().zip(told).collect(), clusters, cleared))
}

/// One cluster as a grain.
fn one(
    grown: &Grown,
    grains: &Particles,
    scenario: &Scenario,
    (id, members): (u32, &[u32]),
) -> Result<(Row, Cluster), HandOverError> {
    let past = &grown.state.past;
    let body = RigidMotion::of(grains, members);
    let first = members[0] as usize;
    let number = grains.material[first];
    if let Some(other) = members.iter().find(|&&member| grains.material[member as usize] != number) {
        let name =
            |at: usize| past.materials.keys().nth(grains.material[at] as usize).map_or("", String::as_str);
        let (one, another) = (name(first), name(*other as usize));
        return Err(HandOverError::Refused(format!(
            "{}: a cluster of {} grains has both {one} and {another}; a table can name one material for a grain, so only \
             clusters of one material each can become hard spheres",
            grown.shown,
            members.len()
        )));
    }
    let material = materials::numbers(grown, scenario)[number as usize];
    let sum = |of: fn(&Particles, usize) -> f64| {
        members.iter().map(|&member| of(grains, member as usize)).sum::<f64>()
    };
    let radius = sum(|grains, at| grains.radius[at].powi(3)).cbrt();
    // One material, so heat capacities are as masses.
    let temperature = sum(|grains, at| grains.mass[at] * grains.temperature[at]) / body.mass;
    let velocity = body.momentum / body.mass;
    let mass = scenario
        .materials
        .values()
        .nth(material as usize)
        .map_or(body.mass, |known: &Material| known.mass_of_sphere(radius));
    let ends = members.iter().map(|&member| {
        (grains.position[member as usize] - body.center).norm() + grains.radius[member as usize]
    });
    let row = Row {
        id,
        position: past.space().home(body.center).0,
        velocity,
        radius,
        mass,
        material,
        temperature,
        polarity: 1.0,
        ..Row::default()
    };
    let cluster = Cluster {
        id,
        primaries: members.len(),
        mass: body.mass,
        radius,
        envelope: ends.fold(0.0, f64::max),
        places: [body.center; 2],
        velocity,
        spin: body.angular_momentum,
        kinetic: [body.kinetic_energy, 0.5 * mass * velocity.norm_squared()],
    };
    Ok((row, cluster))
}

/// Lets the control volume hold all grains: it is put about them and made larger where it has to be. Gives its corners [m]
/// where it is another one.
fn fit_volume(scenario: &mut Scenario, grains: &Particles) -> Option<[[f64; 3]; 2]> {
    let volume: &mut Volume = &mut scenario.hard_mut()?.volume;
    let [mut lower, mut upper] = [Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY), Vec3::ZERO];
    upper -= lower;
    for (place, &radius) in grains.position.iter().zip(&grains.radius) {
        let reach = Vec3::new(radius, radius, radius) * (1.0 + 1e-6);
        lower = lower.min(*place - reach);
        upper = upper.max(*place + reach);
    }
    let [known_lower, known_upper] = [vector(volume.lower), vector(volume.upper)];
    let is_inside = (0..3).all(|axis| lower[axis] >= known_lower[axis] && upper[axis] <= known_upper[axis]);
    if is_inside {
        return None;
    }
    let middle = (lower + upper) * 0.5;
    let half = ((upper - lower) * 0.5).max((known_upper - known_lower) * 0.5);
    let corners = [middle - half, middle + half].map(Vec3::to_array);
    [volume.lower, volume.upper] = corners.map(|corner| corner.map(Quantity));
    Some(corners)
}
