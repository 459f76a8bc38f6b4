//! Hard spheres taken apart into their primaries, for soft spheres.
//!
//! # Equation
//! ```text
//! R = b (1 - φ)^(-1/3),   b³ = sum(r_k³)                the envelope of an agglomerate
//! x_k = X + s_k,   v_k = V + Ω × s_k,   w_k = Ω,   J Ω = L
//! ```
//! X, V and L are the grown grain's place, velocity and angular momentum; s_k are the places of its primaries about their center
//! of mass and J their moments of inertia. So mass, momentum and angular momentum are kept; the energy of turning is not, as J is
//! not that of the grown grain. Hard spheres of agglo do not turn: L and with it Ω are 0 then, and so is what is lost.

use std::path::Path;

use super::came_out::{CameOut, titled};
use super::files::{self, Cluster, Told};
use super::lineage::Lineage;
use super::record::Cleared;
use super::{Grown, HandOver, HandOverError, Motion, Options, Packing, materials};
use crate::contact::Bonds;
use crate::contact::closeness::TOUCHING;
use crate::domain::Space;
use crate::math::Vec3;
use crate::math::rng::{Purpose, Stream};
use crate::measure::{Clusters, RigidMotion, close_pairs};
use crate::packing::pack_cluster;
use crate::particles::{Material, Particles, Row};
use crate::scenario::Scenario;

/// Part of a mass or volume by which primaries may miss that of their grain: sums over thousands of merges.
const ROUND_OFF: f64 = 1e-6;

/// Primaries of a grain, before they are put anywhere.
struct Primaries {
    radii: Vec<f64>,
    masses: Vec<f64>,
    /// Numbers of their materials in the new scenario.
    materials: Vec<u32>,
    are_known: bool,
}

/// What is needed to take grains apart.
struct Taker<'a> {
    grown: &'a Grown,
    lineage: Option<Lineage>,
    scenario: &'a Scenario,
    /// Numbers of the run's materials in the new scenario.
    numbers: Vec<u32>,
}

impl Taker<'_> {
    fn densities(&self) -> Vec<f64> {
        self.scenario.materials.values().map(|material| material.density.si()).collect()
    }

    /// The primaries of a grain: the true ones where they are known, else equal ones.
    fn primaries(&self, at: usize, count: u32) -> Result<Primaries, HandOverError> {
        let grains = &self.grown.state.start.grains;
        let (radius, mass) = (grains.radius[at], grains.mass[at]);
        let densities = self.densities();
        let of = |radii: Vec<f64>, materials: Vec<u32>, are_known| {
            let sphere = |(radius, &material): (&f64, &u32)| {
                densities[material as usize] * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)
            };
            let masses = radii.iter().zip(&materials).map(sphere).collect();
            Primaries { radii, masses, materials, are_known }
        };
        let fits = |found: &Primaries| {
            let cubes: f64 = found.radii.iter().map(|radius| radius.powi(3)).sum();
            let total: f64 = found.masses.iter().sum();
            (cubes / radius.powi(3) - 1.0).abs() < ROUND_OFF && (total / mass - 1.0).abs() < ROUND_OFF
        };
        if let Some((lineage, members)) =
            self.lineage.as_ref().and_then(|lineage| Some((lineage, lineage.of(grains.id[at], count)?)))
        {
            let first = &lineage.first;
            let radii = members.iter().map(|&member| first.radius[member as usize]).collect();
            let numbers =
                members.iter().map(|&member| self.numbers[first.material[member as usize] as usize]);
            let found = of(radii, numbers.collect(), true);
            if fits(&found) {
                return Ok(found);
            }
        }
        let number = self.numbers[grains.material[at] as usize];
        let equal = (radius.powi(3) / f64::from(count)).cbrt();
        let found = of(vec![equal; count as usize], vec![number; count as usize], false);
        if fits(&found) {
            return Ok(found);
        }
        let (from, id) = (&self.grown.shown, grains.id[at]);
        Err(HandOverError::Refused(format!(
            "{from}: grain {id} is a mixture of several materials, and which primaries are in it is not known: it comes from a \
             breakage, or its tables of events are gone; hand over a state from before the breakage, by its checkpoint"
        )))
    }
}

/// Hands hard spheres over to soft ones.
pub(super) fn hand_over(grown: &Grown, options: &Options<'_>, to: &Path) -> Result<HandOver, HandOverError> {
    let porosity = options.porosity;
    if !(0.0..1.0).contains(&porosity) {
        let reason = format!("the porosity is {porosity}; it must be 0 or more and below 1, such as 0.6");
        return Err(HandOverError::Refused(reason));
    }
    let lineage = grown.folder.as_ref().and_then(|folder| Lineage::read(folder, &grown.state));
    let first = lineage.iter().flat_map(|lineage| &lineage.first.material);
    let used = grown.state.start.grains.material.iter().chain(first).copied().collect();
    let mut scenario = materials::with_substances(grown, options, &used)?;
    let seed = options.seed.unwrap_or(scenario.seed);
    let gap =
        scenario.soft().and_then(|soft| soft.bonds.as_ref()).and_then(Bonds::lasting).map(|law| law.gap);
    let numbers = materials::numbers(grown, &scenario);
    let taker = Taker { grown, lineage, scenario: &scenario, numbers };
    let (apart, equal_primaries) = taker.take_apart(porosity, gap, seed)?;
    let bonds = connected(&apart, gap)?;
    let several = || apart.clusters.iter().filter(|cluster| cluster.primaries > 1);
    let porosities = several().map(Cluster::porosity);
    let asked = |cluster: &&Cluster| {
        cluster.envelope > cluster.radius * (1.0 - porosity).cbrt().recip() * (1.0 + 1e-9)
    };
    let packing = Packing {
        porosity,
        porosities: (several().count() > 0)
            .then(|| [porosities.clone().fold(1.0, f64::min), porosities.clone().fold(0.0, f64::max)]),
        wider: several().filter(asked).count(),
        equal_primaries,
        bonds: gap.map(|_| bonds),
        seed,
    };
    let before = &grown.state.start;
    let held = before
        .grains
        .temperature
        .iter()
        .zip(&before.grown)
        .map(|(heat, parts)| parts.heat_capacity * heat)
        .sum();
    let capacities = materials::capacities(&scenario.materials, &grown.state.past.materials);
    let motions = [
        Motion::of(&before.grains, held),
        Motion::of(&apart.grains, materials::heat(&apart.grains, &capacities)),
    ];
    let groups = files::groups(to, &scenario, &apart.grains, &apart.told)?;
    let record = HandOver {
        packing: Some(packing),
        notes: notes(grown, &scenario),
        ..apart.record((grown, options, to), files::tables_of(&groups), motions)
    };
    scenario.title = format!("{}, taken apart into primaries", titled(grown));
    files::write(&mut scenario, groups, &apart.clusters, &record)?;
    Ok(record)
}

fn notes(grown: &Grown, scenario: &Scenario) -> Vec<String> {
    let mut notes = Vec::new();
    if grown.state.past.volume().is_some_and(|volume| volume.boundary.wraps()) {
        let words = "the control volume repeated itself; soft spheres are in open space, each grain where it is inside";
        notes.push(words.to_owned());
    }
    if scenario.acoustics().is_some_and(|acoustics| !acoustics.beams.is_empty()) {
        notes.push(
            "beams are where the scenario has them: see where all grains are, and `agglo check`".to_owned(),
        );
    }
    notes
}

impl Taker<'_> {
    /// Packs all agglomerates, moves them apart so that envelopes lie clear of one another, and puts their primaries there; with
    /// the number of agglomerates whose primaries are equal ones since their own are not known.
    fn take_apart(
        &self,
        porosity: f64,
        gap: Option<f64>,
        seed: u64,
    ) -> Result<(CameOut, usize), HandOverError> {
        let start = &self.grown.state.start;
        let closest = gap.unwrap_or(0.0).max(self.scenario.measures.cluster_gap).max(TOUCHING);
        let (mut packed, mut reaches, mut equal) = (Vec::new(), Vec::new(), 0);
        for (at, parts) in start.grown.iter().enumerate() {
            let primaries = self.primaries(at, parts.primaries)?;
            let wanted = start.grains.radius[at] / (1.0 - porosity).cbrt();
            let mut stream = Stream::new(seed, Purpose::Primaries, start.grains.id[at]);
            let found = pack_cluster(&primaries.radii, &primaries.masses, wanted, &mut stream);
            // Half of what is bonded or counts as one cluster on each side, so that neighbors stay two.
            let largest = primaries.radii.iter().copied().fold(0.0, f64::max);
            reaches.push(found.envelope + 0.5 * closest * largest);
            equal += usize::from(!primaries.are_known && primaries.radii.len() > 1);
            packed.push((primaries, found));
        }
        let cleared = Cleared::of(&start.grains.position, &start.grains.mass, &reaches);
        let (mut rows, mut clusters) = (Vec::new(), Vec::new());
        for (at, (primaries, found)) in packed.iter().enumerate() {
            let before = start.grains.row(at);
            let place = cleared.places[at];
            let placed = placed(&before, place, primaries, &found.positions, self.scenario);
            clusters.push(self.cluster(at, place, found.envelope, &placed));
            let told = |k| (placed.row(k), Told { cluster: before.id, primaries: None });
            rows.extend((0..placed.len()).map(told));
        }
        Ok((CameOut::new(rows, clusters, cleared), equal))
    }

    fn cluster(&self, at: usize, place: Vec3, envelope: f64, placed: &Particles) -> Cluster {
        let grains = &self.grown.state.start.grains;
        let before = grains.row(at);
        let members: Vec<u32> = (0..placed.len() as u32).collect();
        let after = RigidMotion::of(placed, &members);
        Cluster {
            id: before.id,
            primaries: placed.len(),
            mass: before.mass,
            radius: before.radius,
            envelope,
            places: [before.position, place],
            velocity: before.velocity,
            spin: after.angular_momentum,
            kinetic: [RigidMotion::of(grains, &[at as u32]).kinetic_energy, after.kinetic_energy],
        }
    }
}

/// The primaries of one grain where they go, moving as one rigid body.
fn placed(grain: &Row, place: Vec3, primaries: &Primaries, about: &[Vec3], scenario: &Scenario) -> Particles {
    let mut placed = Particles::default();
    let materials: Vec<&Material> = scenario.materials.values().collect();
    for (at, offset) in about.iter().enumerate() {
        let material = primaries.materials[at];
        placed.push(Row {
            position: place + *offset,
            velocity: grain.velocity,
            radius: primaries.radii[at],
            mass: primaries.masses[at],
            material,
            temperature: grain.temperature,
            contact_stiffness: materials[material as usize].stiffness_at(grain.temperature),
            polarity: 1.0,
            ..Row::default()
        });
    }
    let own = grain.angular_velocity * (0.4 * grain.mass * grain.radius * grain.radius);
    let members: Vec<u32> = (0..about.len() as u32).collect();
    let turning = RigidMotion::of(&placed, &members).turning_with(own);
    for (at, offset) in about.iter().enumerate() {
        placed.velocity[at] += turning.cross(*offset);
        placed.angular_velocity[at] = turning;
    }
    placed
}

/// The number of pairs that the scenario bonds, or that touch where it has no law of bonds.
///
/// # Errors
/// [`HandOverError::Refused`] where an agglomerate is not one piece, or two are.
fn connected(apart: &CameOut, gap: Option<f64>) -> Result<usize, HandOverError> {
    let (grains, part) = (&apart.grains, gap.unwrap_or(TOUCHING));
    let mut edges = Vec::new();
    close_pairs(&Space::OPEN, &grains.position, &grains.radius, part, &mut |a, b| edges.push((a, b)));
    let across =
        edges.iter().find(|(a, b)| apart.told[*a as usize].cluster != apart.told[*b as usize].cluster);
    let pieces = Clusters::new(&grains.mass, edges.iter().copied()).count();
    match across {
        Some(&(a, b)) => Err(HandOverError::Refused(format!(
            "primaries {a} and {b} of two agglomerates would be bonded: they are closer than bonds.beam.gap of {part}"
        ))),
        None if pieces != apart.clusters.len() => Err(HandOverError::Refused(format!(
            "{} agglomerates would fall into {pieces} pieces: their primaries touch to round-off, and bonds.beam.gap is {part}; \
             take {TOUCHING} or more",
            apart.clusters.len()
        ))),
        None => Ok(edges.len()),
    }
}
