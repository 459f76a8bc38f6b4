//! From the groups of a scenario to grains.

use std::path::Path;

use super::error::PackingError;
use super::{GrainList, Placement, lattice, random, table};
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::particles::{Material, Particles, Row};
use crate::scenario::{GrainGroup, Scenario};
use crate::units::vector;

/// Places all groups in the order of the scenario; grains get the names 0, 1, 2 ... in the order in which they are
/// placed, and a material's number is its place in the map of materials. Random grains keep clear of the grains of
/// earlier groups; lattices, tables and lists are taken as they are. Tables are looked for below `base`.
///
/// # Errors
/// [`PackingError`] where there is no room, a table cannot be read, a value cannot be, or two grains would be at
/// exactly the same place.
pub fn place(scenario: &Scenario, base: &Path) -> Result<Particles, PackingError> {
    let mut grains = Particles::default();
    for (group, request) in scenario.grains.iter().enumerate() {
        let found = scenario.materials.iter().enumerate().find(|(_, (name, _))| **name == request.material);
        let Some((material, (_, properties))) = found else {
            let reason = format!("there is no material `{}`", request.material);
            return Err(PackingError::Value { group, key: "material", reason });
        };
        if let Some(reason) = request.size.fault() {
            return Err(PackingError::Value { group, key: "size", reason });
        }
        for spot in spots(request, scenario.seed, group, base, &grains)? {
            let row = grain(request, properties, spot);
            grains.push(Row { id: grains.len() as u32, material: material as u32, ..row });
        }
    }
    refuse_coincident(&grains)?;
    Ok(grains)
}

/// Where a grain is, how large, and how fast.
#[derive(Clone, Copy)]
struct Spot {
    position: Vec3,
    radius: f64,
    velocity: Vec3,
}

fn spots(
    request: &GrainGroup,
    seed: u64,
    group: usize,
    base: &Path,
    earlier: &Particles,
) -> Result<Vec<Spot>, PackingError> {
    let velocity = vector(request.velocity);
    let mut stream = Stream::new(seed, Purpose::Size, group as u32);
    let mut sized = |position| Spot { position, radius: request.size.sample(&mut stream), velocity };
    match &request.placement {
        Placement::Random(addition) => {
            let taken: Vec<(Vec3, f64)> =
                earlier.position.iter().copied().zip(earlier.radius.iter().copied()).collect();
            let placed = random::add(addition, &request.size, seed, group, &taken)?;
            Ok(placed.into_iter().map(|(position, radius)| Spot { position, radius, velocity }).collect())
        }
        Placement::Lattice(lattice) => {
            let points = lattice::points(lattice, request.size.largest(), group)?;
            Ok(points.into_iter().map(sized).collect())
        }
        Placement::Table(table) => {
            let rows = table::read(&base.join(&table.file))?;
            let spot = |row: table::TableGrain| {
                let drawn = sized(row.position);
                let radius = row.radius.unwrap_or(drawn.radius);
                Spot { radius, velocity: row.velocity.unwrap_or(velocity), ..drawn }
            };
            Ok(rows.into_iter().map(spot).collect())
        }
        Placement::List(list) => {
            let velocities = velocities_of(list, velocity, group)?;
            let positions = list.positions.iter().map(|&position| vector(position));
            Ok(positions.zip(velocities).map(|(at, velocity)| Spot { velocity, ..sized(at) }).collect())
        }
    }
}

fn velocities_of(list: &GrainList, of_all: Vec3, group: usize) -> Result<Vec<Vec3>, PackingError> {
    let fault = |key, reason| Err(PackingError::Value { group, key, reason });
    let count = list.positions.len();
    if list.positions.iter().any(|&position| !vector(position).is_finite()) {
        return fault("placement.list.positions", "must be finite".to_owned());
    }
    match list.velocities.len() {
        0 => Ok(vec![of_all; count]),
        given if given == count => Ok(list.velocities.iter().map(|&velocity| vector(velocity)).collect()),
        given => fault("placement.list.velocities", format!("{given} velocities for {count} positions")),
    }
}

fn grain(request: &GrainGroup, properties: &Material, spot: Spot) -> Row {
    let temperature = request.temperature.si();
    Row {
        position: spot.position,
        velocity: spot.velocity,
        spin: vector(request.spin),
        radius: spot.radius,
        mass: properties.density.si() * 4.0 / 3.0 * std::f64::consts::PI * spot.radius.powi(3),
        temperature,
        charge: request.charge.si(),
        polarity: request.polarity,
        contact_stiffness: properties.stiffness_at(temperature),
        ..Row::default()
    }
}

/// Grains at one place have no direction to be pushed apart in.
fn refuse_coincident(grains: &Particles) -> Result<(), PackingError> {
    let mut order: Vec<u32> = (0..grains.len() as u32).collect();
    let at = |grain: u32| grains.position[grain as usize];
    // Adding zero turns -0 into +0, which are one place.
    let key = |grain: u32| at(grain).to_array().map(|coordinate| coordinate + 0.0);
    order.sort_by(|&a, &b| {
        let ([ax, ay, az], [bx, by, bz]) = (key(a), key(b));
        ax.total_cmp(&bx).then(ay.total_cmp(&by)).then(az.total_cmp(&bz)).then(a.cmp(&b))
    });
    match order.windows(2).find(|pair| at(pair[0]) == at(pair[1])) {
        None => Ok(()),
        Some(pair) => {
            let Vec3 { x, y, z } = at(pair[0]);
            Err(PackingError::Coincident { first: pair[0], second: pair[1], x, y, z })
        }
    }
}
