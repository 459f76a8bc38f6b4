//! The files of a hand-over: the scenario, the tables of its grains, the table of agglomerates, the record.

use std::path::{Path, PathBuf};

use super::{HandOver, HandOverError};
use crate::folder::names;
use crate::math::Vec3;
use crate::packing::{ConstantSize, GrainGroup, Placement, QUANTITIES, Size, Table};
use crate::particles::Particles;
use crate::record::{Cell, RecordError, Rows, atomic, json};
use crate::scenario::Scenario;
use crate::units::Quantity;

/// The name of a file beside the scenario: soft.toml has soft-grains.csv.
fn beside(to: &Path, name: &str) -> PathBuf {
    let stem = to.file_stem().unwrap_or_default().to_string_lossy();
    to.with_file_name(format!("{stem}-{name}"))
}

/// Where the table of agglomerates and the record go.
pub(super) fn places(to: &Path) -> [PathBuf; 2] {
    [names::HANDED_CLUSTERS, names::HANDED_RECORD].map(|name| beside(to, name))
}

/// Refuses a name that no scenario can have, and to write over what is there.
pub(super) fn refuse_existing(to: &Path) -> Result<(), HandOverError> {
    if to.extension().is_none_or(|end| end != "toml") {
        return Err(HandOverError::Name { path: to.to_owned() });
    }
    let all = [to.to_owned()].into_iter().chain(places(to)).chain([beside(to, names::PLACED)]);
    match all.into_iter().find(|path| path.symlink_metadata().is_ok()) {
        Some(path) => Err(HandOverError::Exists { path }),
        None => Ok(()),
    }
}

/// What a grain of a table has besides its row of the columns.
pub(super) struct Told {
    /// The agglomerate that it belongs to, or is, by its id or number.
    pub cluster: u32,
    /// How many primaries it is made of; none for soft spheres.
    pub primaries: Option<u32>,
}

/// The group of one material, with the table of its grains.
pub(super) struct Group {
    grains: GrainGroup,
    file: PathBuf,
    text: String,
}

/// A group and a table for each material of the scenario, in the order of their names. What tables do not say is that of the
/// scenario's first group.
pub(super) fn groups(
    to: &Path,
    scenario: &Scenario,
    grains: &Particles,
    told: &[Told],
) -> Result<Vec<Group>, RecordError> {
    let mut found = Vec::new();
    let is_single = scenario.materials.len() == 1;
    for (number, name) in scenario.materials.keys().enumerate() {
        let own: Vec<usize> =
            (0..grains.len()).filter(|&at| grains.material[at] as usize == number).collect();
        let Some(&first) = own.first() else { continue };
        let file = beside(
            to,
            &if is_single { names::PLACED.to_owned() } else { format!("{}-{}", number + 1, names::PLACED) },
        );
        let text = table(grains, told, &own).map_err(RecordError::file("write", &file))?;
        let pattern = scenario.grains.first();
        let group = GrainGroup {
            material: name.clone(),
            size: Size::Constant(ConstantSize { radius: Quantity(grains.radius[first]) }),
            placement: Placement::Table(Table { file: file.file_name().unwrap_or_default().into() }),
            velocity: [Quantity(0.0); 3],
            velocity_spread: None,
            angular_velocity: [Quantity(0.0); 3],
            temperature: Quantity(grains.temperature[first]),
            charge: pattern.map_or(Quantity(0.0), |group| group.charge),
            polarity: pattern.map_or(1.0, |group| group.polarity),
        };
        found.push(Group { grains: group, file, text });
    }
    Ok(found)
}

fn table(grains: &Particles, told: &[Told], own: &[usize]) -> std::io::Result<String> {
    let mut rows = Rows::in_memory();
    let has_primaries = told.iter().any(|told| told.primaries.is_some());
    let last = if has_primaries { &["cluster", "primaries"][..] } else { &["cluster"] };
    rows.row(QUANTITIES.iter().chain(last).map(|name| Cell::Word(name)))?;
    for &at in own {
        let vector = |v: Vec3| v.to_array().map(Cell::Number);
        let told = &told[at];
        let cells = [
            &vector(grains.position[at])[..],
            &[Cell::Number(grains.radius[at])],
            &vector(grains.velocity[at]),
            &vector(grains.angular_velocity[at]),
            &[Cell::Number(grains.temperature[at]), Cell::Count(u64::from(told.cluster))],
        ];
        let primaries = told.primaries.map(|count| Cell::Count(u64::from(count)));
        rows.row(cells.concat().into_iter().chain(primaries))?;
    }
    Ok(rows.into_text())
}

/// One agglomerate, as its table tells of it.
pub(super) struct Cluster {
    /// Its id or number.
    pub id: u32,
    /// How many primaries.
    pub primaries: usize,
    /// Mass [kg].
    pub mass: f64,
    /// Radius [m] of a sphere of all its solid.
    pub radius: f64,
    /// Radius [m] of the least sphere about its center of mass that holds it.
    pub envelope: f64,
    /// Center of mass [m], in the run and in the scenario.
    pub places: [Vec3; 2],
    /// Velocity [m/s] of the center of mass.
    pub velocity: Vec3,
    /// Angular momentum [kg m²/s] about it.
    pub spin: Vec3,
    /// Energy of its motion [J], in the run and in the scenario.
    pub kinetic: [f64; 2],
}

impl Cluster {
    /// Volume of the pores over that of the envelope.
    pub fn porosity(&self) -> f64 {
        1.0 - (self.radius / self.envelope).powi(3)
    }
}

fn clusters_table(clusters: &[Cluster]) -> std::io::Result<String> {
    let columns = [
        "cluster",
        "primaries",
        "mass_kg",
        "solid_radius_m",
        "envelope_radius_m",
        "porosity",
        "x_m",
        "y_m",
        "z_m",
        "x_before_m",
        "y_before_m",
        "z_before_m",
        "vx_m_s",
        "vy_m_s",
        "vz_m_s",
        "spin_x_kg_m2_s",
        "spin_y_kg_m2_s",
        "spin_z_kg_m2_s",
        "kinetic_before_J",
        "kinetic_J",
    ];
    let mut rows = Rows::in_memory();
    rows.row(columns.map(Cell::Word))?;
    for cluster in clusters {
        let [before, after] = cluster.places;
        let counts = [Cell::Count(u64::from(cluster.id)), Cell::Count(cluster.primaries as u64)];
        let sizes = [cluster.mass, cluster.radius, cluster.envelope, cluster.porosity()];
        let vectors = [after, before, cluster.velocity, cluster.spin].map(Vec3::to_array).concat();
        let numbers = [&sizes[..], &vectors, &cluster.kinetic].concat();
        rows.row(counts.into_iter().chain(numbers.into_iter().map(Cell::Number)))?;
    }
    Ok(rows.into_text())
}

/// Writes all files, the scenario last: where it is, the others are.
///
/// # Errors
/// [`HandOverError::Faults`] where the scenario breaks a rule, [`HandOverError::Record`] where a file cannot be written.
pub(super) fn write(
    scenario: &mut Scenario,
    groups: Vec<Group>,
    clusters: &[Cluster],
    record: &HandOver,
) -> Result<(), HandOverError> {
    scenario.grains = groups.iter().map(|group| group.grains.clone()).collect();
    scenario.check().map_err(HandOverError::Faults)?;
    let text = scenario.to_toml().map_err(HandOverError::Faults)?;
    if let Some(group) = groups.iter().find(|group| group.file.symlink_metadata().is_ok()) {
        return Err(HandOverError::Exists { path: group.file.clone() });
    }
    for group in groups {
        atomic::write(&group.file, group.text.as_bytes())?;
    }
    let table = clusters_table(clusters).map_err(RecordError::file("write", &record.clusters_table))?;
    atomic::write(&record.clusters_table, table.as_bytes())?;
    let encode = |error: serde_json::Error| RecordError::Encode {
        path: record.record.clone(),
        reason: error.to_string(),
    };
    atomic::write(&record.record, json(record).map_err(encode)?.as_bytes())?;
    let told = record.to_string();
    let lines = told.lines().flat_map(|line| ["# ", line.trim_end(), "\n"]);
    let heading: String = ["# Handed over from another run by agglo hand-over.\n#\n"]
        .into_iter()
        .chain(lines)
        .chain(["\n"])
        .collect();
    atomic::write(&record.scenario, [heading, text].concat().as_bytes())?;
    Ok(())
}

/// Where the tables of groups are.
pub(super) fn tables_of(groups: &[Group]) -> Vec<PathBuf> {
    groups.iter().map(|group| group.file.clone()).collect()
}
