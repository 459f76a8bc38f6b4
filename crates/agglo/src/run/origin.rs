//! Where the grains of a run come from: placed as its scenario says, or taken out of another run.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use super::hard::Hard;
use super::job::{AnySaved, Job};
use super::soft::Soft;
use crate::contact::network::{Bond, bonds_between};
use crate::contact::{Bonds, Friction};
use crate::engine::hard::Grown;
use crate::engine::{SimError, Start, soft};
use crate::folder::RunFolder;
use crate::packing::{
    ConstantSize, GrainGroup, Groups, PackingError, PlaceWatch, Placed, Placement, Size, StartError, Table,
    UniformSize, make_ready, pairs, place_all,
};
use crate::particles::{ById, Material, Particles};
use crate::record::checkpoint;
use crate::scenario::Scenario;
use crate::text::readable;
use crate::units::Quantity;

/// The grains of a run before its clock starts.
pub(crate) struct Origin {
    /// The grains, with what they bring along.
    pub start: Start,
    /// How many belong to each of the scenario's groups, or of those that another run's grains make up.
    pub counts: Vec<u64>,
    /// Where they come from, if they come from another run.
    pub earlier: Option<Earlier>,
}

/// Another run that grains come from.
pub(crate) struct Earlier {
    /// The checkpoint that was taken.
    pub checkpoint: PathBuf,
    /// One group for each material of the grains, as if the scenario had asked for them.
    pub groups: Vec<GrainGroup>,
    /// What was there, in words.
    pub words: String,
}

impl Origin {
    /// Places the grains of a scenario, or takes them out of the run that it names; `base` is the folder that its paths are
    /// relative to. `watch` may stop it.
    ///
    /// # Errors
    /// [`StartError`].
    pub fn of(scenario: &Scenario, base: &Path, watch: &mut PlaceWatch<'_>) -> Result<Self, StartError> {
        let origin = Self::found(scenario, base, watch)?;
        if let Ok(settings) = soft::Settings::try_from(scenario) {
            soft::refuse_grains_in_walls(&settings, &origin.start.grains).map_err(StartError::InWall)?;
        }
        Ok(origin)
    }

    fn found(scenario: &Scenario, base: &Path, watch: &mut PlaceWatch<'_>) -> Result<Self, StartError> {
        if let Some(from) = &scenario.from {
            let path = base.join(from);
            return taken(scenario, &path).map_err(|error| match error {
                Trouble::Reason(reason) => StartError::Earlier { path, reason },
                Trouble::Grains(error) => error.into(),
            });
        }
        let Placed { grains, counts, primaries } = place_all(scenario, base, watch)?;
        let grown = if scenario.is_hard() { grown(&grains, &primaries, scenario) } else { Vec::new() };
        let bonds = bonded(scenario, &grains, base)?;
        Ok(Self { start: Start { grown, bonds, ..grains.into() }, counts, earlier: None })
    }

    /// The grains group by group, as they were placed; those of another run are brought into that order.
    pub fn by_groups(&self) -> Cow<'_, Particles> {
        let placed = &self.start.grains;
        if self.earlier.is_none() {
            return Cow::Borrowed(placed);
        }
        let mut order: Vec<u32> = (0..placed.len() as u32).collect();
        order.sort_by_key(|&at| placed.material[at as usize]);
        let mut grains = placed.clone();
        grains.reorder(&order);
        Cow::Owned(grains)
    }
}

/// The bonds of the scenario's table, if it names one.
fn bonded(scenario: &Scenario, grains: &Particles, base: &Path) -> Result<Option<Vec<Bond>>, StartError> {
    let soft = scenario.soft();
    let law = soft.and_then(|soft| soft.bonds.as_ref()).and_then(Bonds::lasting);
    let Some((file, law)) = soft.and_then(|soft| soft.bonded.as_ref()).zip(law) else { return Ok(None) };
    let pairs = pairs(&base.join(file), &ById::of(&grains.id)).map_err(StartError::Bonds)?;
    Ok(Some(bonds_between(law, grains, &scenario.space(), &pairs)))
}

/// What grains of a table keep of their parts; nothing where all are primary grains. They are of their material throughout.
fn grown(grains: &Particles, primaries: &[u32], scenario: &Scenario) -> Vec<Grown> {
    if primaries.iter().all(|&count| count == 1) {
        return Vec::new();
    }
    let heats: Vec<f64> = scenario.materials.values().map(Material::specific_heat).collect();
    let heat_capacity = |at: usize| grains.mass[at] * heats[grains.material[at] as usize];
    let of = |(at, &primaries): (usize, &u32)| Grown { primaries, heat_capacity: heat_capacity(at) };
    primaries.iter().enumerate().map(of).collect()
}

/// Why the state of another run is not taken.
enum Trouble {
    Reason(String),
    Grains(PackingError),
}

impl From<String> for Trouble {
    fn from(reason: String) -> Self {
        Self::Reason(reason)
    }
}

/// The state of a run as another one takes it up.
pub(crate) struct State {
    /// The run's scenario, resolved.
    pub past: Scenario,
    /// Simulated time [s].
    pub time: f64,
    /// Its grains, with what they bring along.
    pub start: Start,
    /// The checkpoint that was taken.
    pub checkpoint: PathBuf,
}

/// The newest state of a run's folder, or that of a checkpoint that was named.
///
/// # Errors
/// Why it cannot be taken.
pub(crate) fn state(path: &Path) -> Result<State, String> {
    let (saved, checkpoint) = read(path)?;
    let past = Scenario::from_toml(saved.parts().0).map_err(|faults| faults.to_string())?;
    let time = saved.time();
    let refused = |error: SimError| error.to_string();
    let start = match saved {
        AnySaved::Soft(saved) => Soft::resume(&past, saved.state).map_err(refused)?.into_start(),
        AnySaved::Hard(saved) => Hard::resume(&past, saved.state).map_err(refused)?.into_start(),
    };
    Ok(State { past, time, start, checkpoint })
}

fn taken(scenario: &Scenario, path: &Path) -> Result<Origin, Trouble> {
    let State { past, time, mut start, checkpoint } = state(path)?;
    if past.is_hard() != scenario.is_hard() {
        let kinds = [past.is_hard(), scenario.is_hard()].map(|is_hard| if is_hard { "hard" } else { "soft" });
        let reason = format!(
            "it is a run of {} spheres, and the scenario has an engine of {} ones; take one of its kind, or \
             `agglo hand-over`",
            kinds[0], kinds[1]
        );
        return Err(reason.into());
    }
    hand_over_materials(&mut start.grains, &past, scenario)?;
    hand_over_bonds(&start, scenario)?;
    start.warnings.extend(springs_dropped(&start, scenario));
    refuse_short_cutoff(&start.grains, scenario)?;
    // A run of hard spheres leaves grains that overlap or reach into a wall: after a step, or where two became a larger one.
    // They are about to part, and are dealt with as in the run itself.
    make_ready(&Groups::from(scenario), &mut start.grains, true).map_err(Trouble::Grains)?;
    let (groups, counts) = groups(&start.grains, scenario);
    let words = words(&start, &past, time);
    Ok(Origin { start, counts, earlier: Some(Earlier { checkpoint, groups, words }) })
}

/// The newest whole checkpoint of a run's folder, or one that was named.
fn read(path: &Path) -> Result<(AnySaved<'static>, PathBuf), String> {
    if !path.is_dir() {
        return Ok((checkpoint::load(path)?, path.to_owned()));
    }
    let folder = RunFolder::open(path).map_err(|_| "the folder holds no run".to_owned())?;
    let all = checkpoint::newest_first(&folder.checkpoints()).map_err(|error| error.to_string())?;
    let mut refused = Vec::new();
    for checkpoint in all {
        match checkpoint::load(&checkpoint) {
            Ok(saved) => return Ok((saved, checkpoint)),
            Err(reason) => refused.push(format!("{}: {reason}", checkpoint.display())),
        }
    }
    if refused.is_empty() {
        return Err("it has no checkpoint".to_owned());
    }
    Err(format!("it has no whole checkpoint: {}", refused.join("; ")))
}

/// Numbers of materials by their names in the new scenario. What grains are made of stays what it was.
fn hand_over_materials(grains: &mut Particles, past: &Scenario, scenario: &Scenario) -> Result<(), String> {
    let mut numbers = Vec::new();
    for (number, (name, before)) in past.materials.iter().enumerate() {
        let is_used = grains.material.iter().any(|material| *material as usize == number);
        let found = scenario.materials.iter().enumerate().find(|(_, (other, _))| *other == name);
        match found {
            _ if !is_used => numbers.push(0),
            None => {
                let known: Vec<&str> = scenario.materials.keys().map(String::as_str).collect();
                let known = known.join(", ");
                return Err(format!(
                    "its grains are made of {name}, which is none of the scenario's materials ({known}); add it"
                ));
            }
            Some((number, (_, now))) => {
                same_substance(name, before, now, scenario.is_hard())?;
                numbers.push(number as u32);
            }
        }
    }
    let materials: Vec<&Material> = scenario.materials.values().collect();
    for at in 0..grains.len() {
        let number = numbers[grains.material[at] as usize];
        grains.material[at] = number;
        if !scenario.is_hard() {
            grains.contact_stiffness[at] = materials[number as usize].stiffness_at(grains.temperature[at]);
        }
    }
    Ok(())
}

/// Masses, and the heat that hard spheres hold, are the grains' own.
fn same_substance(name: &str, before: &Material, now: &Material, is_hard: bool) -> Result<(), String> {
    let differs = |key: &str, values: [f64; 2], unit: &str| {
        let [before, now] = values.map(|value| readable(value, unit));
        format!(
            "materials.{name}.{key} was {before} there and is {now} here; grains keep what they are made of"
        )
    };
    let densities = [before, now].map(|material| material.density.si());
    if densities[0] != densities[1] {
        return Err(differs("density", densities, "kg/m3"));
    }
    let heats = [before, now].map(Material::specific_heat);
    if is_hard && heats[0] != heats[1] {
        return Err(differs("heat_capacity", heats, "J/kg/K"));
    }
    Ok(())
}

fn hand_over_bonds(start: &Start, scenario: &Scenario) -> Result<(), String> {
    let has_law = scenario.soft().is_some_and(|soft| matches!(soft.bonds, Some(Bonds::Beam(_))));
    match &start.bonds {
        Some(bonds) if !bonds.is_empty() && !has_law => Err(format!(
            "its grains are held by {} bonds, and the scenario has no law for them; add [bonds.beam]",
            bonds.len()
        )),
        _ => Ok(()),
    }
}

/// That loaded springs find no law that has any.
fn springs_dropped(start: &Start, scenario: &Scenario) -> Option<String> {
    let contact = scenario.soft().and_then(|soft| soft.contact.as_ref());
    let friction = contact.and_then(|laws| laws.friction.as_ref());
    let has_springs = matches!(friction, Some(Friction::Mindlin(_)));
    let loaded = start.contacts.iter().filter(|(.., spring)| spring.force.norm() > 0.0).count();
    (loaded > 0 && !has_springs).then(|| {
        format!("{loaded} loaded springs of the run that this one starts from are dropped: contact.friction is not mindlin")
    })
}

/// As the check does for grains that the scenario places.
fn refuse_short_cutoff(grains: &Particles, scenario: &Scenario) -> Result<(), String> {
    let largest = grains.radius.iter().copied().fold(0.0, f64::max);
    let near_field = scenario.soft().and_then(|soft| soft.fields.near_field.as_ref());
    let fault = near_field.and_then(|law| law.fault_of_cutoff(largest));
    fault.map_or(Ok(()), |fault| Err(format!("fields.near_field.cutoff = {fault}")))
}

/// One group for each material, as far as grains tell; where they are is in no key.
fn groups(grains: &Particles, scenario: &Scenario) -> (Vec<GrainGroup>, Vec<u64>) {
    let (mut groups, mut counts) = (Vec::new(), Vec::new());
    for (number, name) in scenario.materials.keys().enumerate() {
        let own: Vec<usize> =
            (0..grains.len()).filter(|at| grains.material[*at] as usize == number).collect();
        let Some(&first) = own.first() else { continue };
        let radii = own.iter().map(|&at| grains.radius[at]);
        let [smallest, largest] =
            [radii.clone().fold(f64::INFINITY, f64::min), radii.fold(0.0, f64::max)].map(Quantity);
        let heat = own.iter().map(|&at| grains.temperature[at]).sum::<f64>() / own.len() as f64;
        let charge = own.iter().map(|&at| grains.charge[at]).find(|charge| *charge != 0.0).unwrap_or(0.0);
        groups.push(GrainGroup {
            material: name.clone(),
            size: if smallest == largest {
                Size::Constant(ConstantSize { radius: smallest })
            } else {
                Size::Uniform(UniformSize { smallest, largest })
            },
            placement: Placement::Table(Table { file: PathBuf::new() }),
            velocity: [Quantity(0.0); 3],
            velocity_spread: None,
            angular_velocity: [Quantity(0.0); 3],
            temperature: Quantity(heat),
            charge: Quantity(charge),
            polarity: grains.polarity[first],
        });
        counts.push(own.len() as u64);
    }
    (groups, counts)
}

fn words(start: &Start, past: &Scenario, time: f64) -> String {
    let title = if past.title.is_empty() { "another run" } else { past.title.as_str() };
    let bonds = start.bonds.as_ref().map_or(String::new(), |bonds| format!(", {} bonds", bonds.len()));
    format!("{title} at t = {}: {} grains{bonds}", readable(time, "s"), start.grains.len())
}
