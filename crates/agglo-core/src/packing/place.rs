//! From the groups of a scenario to grains.

use std::ops::ControlFlow;

use super::error::PackingError;
use super::overlap::{first_outside, first_overlap};
use super::random::{self, Request};
use super::room::Room;
use super::watch::{PlaceWatch, ReadTable};
use super::{GrainGroup, GrainList, Groups, Placement, SphereKind, TableGrain, lattice};
use crate::domain::{Boundary, Volume, resolution};
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::particles::{ById, Material, Particles, Row};
use crate::units::vector;

/// Places all groups in their order; grains get the ids 0, 1, 2 ... in the order in which they are
/// placed, or those of their tables, and a material's number is its index in the map of materials. Random grains keep clear of the grains of
/// earlier groups; lattices, tables and lists are taken as they are. `read` gives the rows of a table.
///
/// Hard spheres that overlap, or that lie outside a control volume with faces, are refused.
///
/// # Errors
/// [`PackingError`] where there is no room, a table cannot be read, a value cannot be, two grains would be at exactly
/// the same place or too far from the origin, or hard spheres could not start.
pub fn place<'a>(groups: impl Into<Groups<'a>>, read: &mut ReadTable<'_>) -> Result<Particles, PackingError> {
    place_groups(groups, read).map(|(grains, _)| grains)
}

/// As [`place`], with the number of grains of each group; those of a group follow one another.
///
/// # Errors
/// As for [`place`].
pub fn place_groups<'a>(
    groups: impl Into<Groups<'a>>,
    read: &mut ReadTable<'_>,
) -> Result<(Particles, Vec<u64>), PackingError> {
    place_all(groups, read, &mut || ControlFlow::Continue(())).map(|placed| (placed.grains, placed.counts))
}

/// Grains as they were placed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Placed {
    /// The grains.
    pub grains: Particles,
    /// How many each group has [groups]; those of a group follow one another.
    pub counts: Vec<u64>,
    /// How many primary grains each is made of [n]: 1, but for hard spheres of a table that says otherwise.
    pub primaries: Vec<u32>,
}

/// As [`place`], with all that is known of the grains; `watch` may stop it.
///
/// # Errors
/// As for [`place`], and [`PackingError::Stopped`].
pub fn place_all<'a>(
    groups: impl Into<Groups<'a>>,
    read: &mut ReadTable<'_>,
    watch: &mut PlaceWatch<'_>,
) -> Result<Placed, PackingError> {
    let asked = &groups.into();
    let (mut placed, mut all_have_ids) = (Placed::default(), None);
    for (group, request) in asked.groups.iter().enumerate() {
        if watch().is_break() {
            return Err(PackingError::Stopped);
        }
        let found = asked.materials.iter().enumerate().find(|(_, (name, _))| **name == request.material);
        let Some((material, (_, properties))) = found else {
            let reason = format!("there is no material `{}`", request.material);
            return Err(PackingError::Value { group, key: "material", reason });
        };
        if let Some(reason) = request.size.fault() {
            return Err(PackingError::Value { group, key: "size", reason });
        }
        let group_of = Group { request, seed: asked.seed, number: group, volume: asked.volume() };
        let mut spots = group_of.spots(&placed.grains, read, watch)?;
        if matches!(asked.kind, SphereKind::Soft { .. }) && spots.iter().any(|spot| spot.primaries > 1) {
            let reason = "its column `primaries` has grains made of several, which only hard spheres can be; \
                          `agglo hand-over` takes them apart";
            return Err(PackingError::Value { group, key: "placement.table", reason: reason.to_owned() });
        }
        let has_ids = spots.iter().any(|spot| spot.id.is_some());
        if *all_have_ids.get_or_insert(has_ids) != has_ids {
            let reason = "either all grains have ids of a table's column `id`, or none";
            return Err(PackingError::Value { group, key: "placement", reason: reason.to_owned() });
        }
        scatter(request, asked.seed, group, &mut spots);
        placed.counts.push(spots.len() as u64);
        for spot in spots {
            let row = grain(request, properties, spot);
            placed.primaries.push(spot.primaries);
            // Either all have ids of their own, or none.
            let id = spot.id.unwrap_or(placed.grains.len() as u32);
            placed.grains.push(Row { id, material: material as u32, ..row });
        }
    }
    if let Some(id) = ById::of(&placed.grains.id).twice() {
        return Err(PackingError::SameId { id });
    }
    make_ready(asked, &mut placed.grains, false)?;
    Ok(placed)
}

/// Refuses grains that could not start where they are; of images in a volume that wraps, the one inside counts. Hard
/// spheres may overlap, and reach into walls, only if they are said to.
///
/// # Errors
/// [`PackingError`] where grains are too far out, at one place, overlap as hard spheres or are out of their volume.
pub fn make_ready(asked: &Groups<'_>, grains: &mut Particles, may_overlap: bool) -> Result<(), PackingError> {
    refuse_far(grains)?;
    match asked.kind {
        SphereKind::Soft { volume } => {
            if let Some(volume) = volume {
                bring_inside(volume, grains, false, true)?;
            }
            refuse_coincident(grains)
        }
        SphereKind::Hard { volume, may_leave } => {
            refuse_coincident(grains)?;
            bring_inside(volume, grains, may_overlap && may_leave, may_overlap)?;
            if may_overlap { Ok(()) } else { refuse_overlapping(grains, volume) }
        }
    }
}

/// Where a grain is, how large, and what its row of a table or list says of it.
#[derive(Clone, Copy)]
struct Spot {
    position: Vec3,
    radius: f64,
    velocity: Vec3,
    /// Whether the velocity is the grain's own and does not scatter.
    has_own_velocity: bool,
    angular_velocity: Vec3,
    temperature: f64,
    primaries: u32,
    /// The id that a table gives it.
    id: Option<u32>,
}

/// A group with what it takes to place it.
struct Group<'a> {
    request: &'a GrainGroup,
    seed: u64,
    number: usize,
    volume: Option<&'a Volume>,
}

impl Group<'_> {
    fn spots(
        &self,
        earlier: &Particles,
        read: &mut ReadTable<'_>,
        watch: &mut PlaceWatch<'_>,
    ) -> Result<Vec<Spot>, PackingError> {
        let &Self { request, seed, number: group, volume } = self;
        let velocity = vector(request.velocity);
        let angular_velocity = vector(request.angular_velocity);
        let temperature = request.temperature.si();
        let spot = |(position, radius)| Spot {
            position,
            radius,
            velocity,
            has_own_velocity: false,
            angular_velocity,
            temperature,
            primaries: 1,
            id: None,
        };
        let mut stream = Stream::new(seed, Purpose::Size, group as u32);
        let mut sized = |position| spot((position, request.size.sample(&mut stream)));
        match &request.placement {
            Placement::Random(_) | Placement::Fill(_) => {
                let placed = random::add(&self.random_request()?, earlier, volume, watch)?;
                Ok(placed.into_iter().map(spot).collect())
            }
            Placement::Lattice(lattice) => {
                let points = lattice::points(lattice, request.size.largest(), group)?;
                Ok(points.into_iter().map(sized).collect())
            }
            Placement::Table(table) => {
                let rows = read(table)?;
                let spot = |row: TableGrain| {
                    let drawn = sized(row.position);
                    Spot {
                        position: row.position,
                        radius: row.radius.unwrap_or(drawn.radius),
                        velocity: row.velocity.unwrap_or(velocity),
                        has_own_velocity: row.velocity.is_some(),
                        angular_velocity: row.angular_velocity.unwrap_or(angular_velocity),
                        temperature: row.temperature.unwrap_or(temperature),
                        primaries: row.primaries.unwrap_or(1),
                        id: row.id,
                    }
                };
                Ok(rows.into_iter().map(spot).collect())
            }
            Placement::List(list) => {
                let velocities = velocities_of(list, velocity, group)?;
                let has_own_velocity = !list.velocities.is_empty();
                let positions = list.positions.iter().map(|&position| vector(position));
                let spot = |(at, velocity)| Spot { velocity, has_own_velocity, ..sized(at) };
                Ok(positions.zip(velocities).map(spot).collect())
            }
        }
    }

    /// What a random placement asks for.
    fn random_request(&self) -> Result<Request<'_>, PackingError> {
        let &Self { request: GrainGroup { size, placement, .. }, seed, number: group, volume, .. } = self;
        match (placement, volume) {
            (Placement::Random(addition), _) => {
                let (room, wanted) = (Room::inside(&addition.region), addition.wanted(size));
                let gap = addition.gap.si();
                Ok(Request { seed, group, room, gap, wanted, size, key: "placement.random" })
            }
            (Placement::Fill(fill), Some(volume)) => {
                let (room, wanted) = (Room::of_volume(volume), fill.wanted(size, volume));
                Ok(Request { seed, group, room, gap: fill.gap.si(), wanted, size, key: "placement.fill" })
            }
            _ => {
                let reason = "`fill` needs the control volume [volume]; in a region of its own take `random`";
                Err(PackingError::Value { group, key: "placement", reason: reason.to_owned() })
            }
        }
    }
}

/// Adds random velocities where the group has them and a grain none of its own.
fn scatter(request: &GrainGroup, seed: u64, group: usize, spots: &mut [Spot]) {
    let Some(spread) = &request.velocity_spread else { return };
    let free = spots.iter().enumerate().filter(|(_, spot)| !spot.has_own_velocity);
    // The grains of a group have one density: cubes of radii are as good as masses.
    let grains: Vec<(usize, f64)> = free.map(|(number, spot)| (number, spot.radius.powi(3))).collect();
    let draws = spread.draw(seed, group, &grains);
    for ((number, _), draw) in grains.into_iter().zip(draws) {
        spots[number].velocity += draw;
    }
}

/// Grains start within the faces that bring them back; of the images of a grain, the one inside counts.
fn bring_inside(
    volume: &Volume,
    grains: &mut Particles,
    may_leave: bool,
    may_reach_in: bool,
) -> Result<(), PackingError> {
    if may_leave && volume.boundary == Boundary::Antipodal {
        // A step leaves grains outside, on their way in; from event to event none are.
        return Ok(());
    }
    if let Some(at) = first_outside(grains, volume, may_reach_in) {
        let Vec3 { x, y, z } = grains.position[at];
        let walls = volume.contains(grains.position[at]);
        return Err(PackingError::Outside { grain: grains.id[at], walls, x, y, z });
    }
    grains.position.iter_mut().for_each(|position| *position = volume.wrap(*position));
    Ok(())
}

/// Hard spheres start apart from one another.
fn refuse_overlapping(grains: &Particles, volume: &Volume) -> Result<(), PackingError> {
    match first_overlap(grains, Some(volume)) {
        None => Ok(()),
        Some(found) => {
            let [first, second] = found.ids;
            Err(PackingError::Overlapping { first, second, overlap: found.overlap })
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
    let temperature = spot.temperature;
    Row {
        position: spot.position,
        velocity: spot.velocity,
        angular_velocity: spot.angular_velocity,
        radius: spot.radius,
        mass: properties.mass_of_sphere(spot.radius),
        temperature,
        charge: request.charge.si(),
        polarity: request.polarity,
        contact_stiffness: properties.stiffness_at(temperature),
        ..Row::default()
    }
}

/// Far from the origin places are too coarse for grains to touch or to move.
fn refuse_far(grains: &Particles) -> Result<(), PackingError> {
    let is_far = |at: &usize| resolution::is_too_far(grains.position[*at], grains.radius[*at]);
    match (0..grains.len()).find(is_far) {
        None => Ok(()),
        Some(at) => {
            let (position, radius) = (grains.position[at], grains.radius[at]);
            let away = position.to_array().into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let spacing = resolution::spacing(position);
            Err(PackingError::TooFar { grain: grains.id[at], away, spacing, radius })
        }
    }
}

/// Grains at one place have no direction to be pushed apart in.
fn refuse_coincident(grains: &Particles) -> Result<(), PackingError> {
    let mut order: Vec<u32> = (0..grains.len() as u32).collect();
    let at = |grain: u32| grains.position[grain as usize];
    // Adding zero turns -0 into +0, which are one place.
    let key = |grain: u32| at(grain) + Vec3::ZERO;
    order.sort_by(|&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
    match order.windows(2).find(|pair| at(pair[0]) == at(pair[1])) {
        None => Ok(()),
        Some(pair) => {
            let Vec3 { x, y, z } = at(pair[0]);
            Err(PackingError::Coincident { first: pair[0], second: pair[1], x, y, z })
        }
    }
}
