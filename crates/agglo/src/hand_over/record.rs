//! What a hand-over kept, and what it did not.

use std::fmt;
use std::path::PathBuf;

use serde::Serialize;

use crate::math::Vec3;
use crate::measure::{RigidMotion, center_of_mass};
use crate::packing::{least_spread, move_apart};
use crate::particles::Particles;
use crate::text::readable;

/// What all grains come to together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[expect(non_snake_case, reason = "units are written as they are")]
pub struct Motion {
    /// Grains.
    pub grains: usize,
    /// Mass [kg].
    pub mass_kg: f64,
    /// Momentum [kg m/s].
    pub momentum_kg_m_s: [f64; 3],
    /// Angular momentum about the center of mass [kg m²/s].
    pub angular_momentum_kg_m2_s: [f64; 3],
    /// Energy of their motion [J], turning included.
    pub kinetic_J: f64,
    /// Heat that they hold [J], m C T.
    pub thermal_J: f64,
}

impl Motion {
    /// Of grains that hold so much heat [J].
    pub(super) fn of(grains: &Particles, heat: f64) -> Self {
        let all: Vec<u32> = (0..grains.len() as u32).collect();
        let body = RigidMotion::of(grains, &all);
        Self {
            grains: grains.len(),
            mass_kg: body.mass,
            momentum_kg_m_s: body.momentum.to_array(),
            angular_momentum_kg_m2_s: body.angular_momentum.to_array(),
            kinetic_J: body.kinetic_energy,
            thermal_J: heat,
        }
    }
}

/// How agglomerates were packed.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Packing {
    /// Porosity that was asked for.
    pub porosity: f64,
    /// Least and greatest porosity of the agglomerates of two primaries and more; none where there is no such.
    pub porosities: Option<[f64; 2]>,
    /// Agglomerates whose envelope is wider than asked for, since so few or such spheres cannot be packed so closely.
    pub wider: usize,
    /// Agglomerates of equal primaries, since their own radii are not known.
    pub equal_primaries: usize,
    /// Pairs of primaries that the scenario's law bonds at the start; none where it has no such law.
    pub bonds: Option<usize>,
    /// Seed of the packing.
    pub seed: u64,
}

/// What a hand-over kept, and what it did not.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HandOver {
    /// The kind of spheres that came out: "soft", "hard".
    pub to: &'static str,
    /// The run, as it was named.
    pub from: String,
    /// Its simulated time [s].
    pub time_s: f64,
    /// The scenario whose laws were taken, as it was named.
    pub with: String,
    /// The scenario that was written.
    pub scenario: PathBuf,
    /// The tables of its grains.
    pub tables: Vec<PathBuf>,
    /// The table of agglomerates.
    pub clusters_table: PathBuf,
    /// This record.
    pub record: PathBuf,
    /// Agglomerates, single grains included.
    pub clusters: usize,
    /// Those of one primary.
    pub single: usize,
    /// Primaries of the largest.
    pub largest: usize,
    /// How they were packed; none where they became hard spheres.
    pub packing: Option<Packing>,
    /// Agglomerates that were moved away from neighbors, since they would have overlapped.
    pub moved: usize,
    /// How far [m] at most.
    pub farthest_m: f64,
    /// Factor by which all places were spread about the center of mass besides, where that was not enough; else 1.
    pub spread: f64,
    /// The control volume [2, 3] [m] where it had to be changed: lower and upper corner.
    pub volume_m: Option<[[f64; 3]; 2]>,
    /// Center [3] [m] of the least sphere about the center of mass that holds all grains.
    pub center_m: [f64; 3],
    /// Its radius [m].
    pub radius_m: f64,
    /// What the run's grains came to.
    pub before: Motion,
    /// What the grains that came out come to.
    pub after: Motion,
    /// Sum of the sizes of the angular momenta of agglomerates about their own centers that were not carried on [kg m²/s].
    pub spin_dropped_kg_m2_s: f64,
    /// What else there is to be said.
    pub notes: Vec<String>,
}

/// Center of mass [m], and the radius [m] of the least sphere about it that holds all grains.
pub(super) fn ball(grains: &Particles) -> (Vec3, f64) {
    let all: Vec<u32> = (0..grains.len() as u32).collect();
    let center = center_of_mass(&grains.position, &grains.mass, &all);
    let ends =
        grains.position.iter().zip(&grains.radius).map(|(place, radius)| (*place - center).norm() + radius);
    (center, ends.fold(0.0, f64::max))
}

impl HandOver {
    /// Kinetic energy [J] of the run's grains that the others do not have; below 0 where they have more.
    pub fn kinetic_lost(&self) -> f64 {
        self.before.kinetic_J - self.after.kinetic_J
    }

    fn places(&self) -> String {
        let moved = match self.moved {
            0 => "as they were".to_owned(),
            moved => {
                format!("{moved} moved away from neighbors, by {} at most", readable(self.farthest_m, "m"))
            }
        };
        if self.spread <= 1.0 {
            return moved;
        }
        format!("{moved}; that was not enough: all spread by {:.4} about the center of mass", self.spread)
    }

    /// Words and what is to be said of them, line by line.
    fn lines(&self) -> Vec<(&'static str, String)> {
        let Self { before, after, .. } = self;
        let at = readable(self.time_s, "s");
        let count = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
        let clusters = format!(
            "{} ({} of one primary), the largest of {}",
            self.clusters,
            self.single,
            count(self.largest, "primary").replace("primarys", "primaries")
        );
        let mut lines = vec![
            ("from", format!("{} at t = {at}: {}", self.from, count(before.grains, "grain"))),
            ("agglomerates", clusters),
            (
                "to",
                format!(
                    "{} of {} spheres, the rest from {}",
                    count(after.grains, "grain"),
                    self.to,
                    self.with
                ),
            ),
        ];
        if let Some(packing) = &self.packing {
            lines.extend(packing.lines());
        }
        lines.push(("places", self.places()));
        let [x, y, z] = self.center_m.map(|along| readable(along, "m"));
        lines.push(("all within", format!("{} of ({x}, {y}, {z})", readable(self.radius_m, "m"))));
        if let Some([lower, upper]) = self.volume_m {
            let words = |corner: [f64; 3]| corner.map(|along| readable(along, "m")).join(", ");
            lines.push(("control volume", format!("({}) to ({})", words(lower), words(upper))));
        }
        let size = |parts: [f64; 3]| Vec3::from(parts).norm();
        lines.push(("mass", pair([before.mass_kg, after.mass_kg], "kg", 0.0)));
        // Where grains fly every way their momenta cancel, but for round-off of each.
        let most = (2.0 * before.mass_kg * before.kinetic_J).sqrt();
        let momenta = [before, after].map(|all| size(all.momentum_kg_m_s));
        lines.push(("momentum", pair(momenta, "kg m/s", most)));
        let angular = [before, after].map(|all| size(all.angular_momentum_kg_m2_s));
        lines.push(("angular momentum", pair(angular, "kg m2/s", 0.0)));
        lines.push(("kinetic energy", pair([before.kinetic_J, after.kinetic_J], "J", 0.0)));
        if before.thermal_J > 0.0 {
            lines.push(("heat", pair([before.thermal_J, after.thermal_J], "J", 0.0)));
        }
        lines.extend(self.notes.iter().map(|note| ("note", note.clone())));
        lines
    }
}

impl Packing {
    fn lines(&self) -> Vec<(&'static str, String)> {
        let found = match self.porosities {
            None => "no agglomerate to be packed".to_owned(),
            Some([least, most]) => {
                format!(
                    "{} asked for; {least:.3} to {most:.3}, {} of them with a wider envelope",
                    self.porosity, self.wider
                )
            }
        };
        let bonds = match self.bonds {
            Some(bonds) => format!("{bonds}; each agglomerate is one piece, and none hangs on another"),
            None => {
                "none: the scenario has no [bonds.beam]; each agglomerate is one piece by contacts".to_owned()
            }
        };
        let mut lines = vec![("porosity", found), ("bonds", bonds)];
        if self.equal_primaries > 0 {
            let words = format!(
                "equal ones in {} of the agglomerates, whose own are not known",
                self.equal_primaries
            );
            lines.push(("primaries", words));
        }
        lines
    }
}

/// A quantity before and after; once where it was kept to round-off, of itself or of what adds up to it.
fn pair([before, after]: [f64; 2], unit: &str, parts: f64) -> String {
    let most = before.abs().max(after.abs()).max(parts);
    if (after - before).abs() <= 1e-9 * most {
        format!("{}, kept", readable(before, unit))
    } else {
        format!("{} before, {} after", readable(before, unit), readable(after, unit))
    }
}

impl fmt::Display for HandOver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, words) in self.lines() {
            writeln!(f, "  {name:<17}{words}")?;
        }
        let tables: Vec<String> = self.tables.iter().map(|table| table.display().to_string()).collect();
        let (scenario, clusters, record) =
            (self.scenario.display(), self.clusters_table.display(), self.record.display());
        write!(f, "{scenario}, with {}, {clusters}, {record}", tables.join(", "))
    }
}

/// Places [n, 3] [m] of agglomerates clear of one another.
pub(super) struct Cleared {
    pub places: Vec<Vec3>,
    pub moved: usize,
    pub farthest: f64,
    pub spread: f64,
}

impl Cleared {
    /// Moves spheres of these masses [n] [kg] and radii [n] [m] apart; the center of mass stays.
    pub fn of(before: &[Vec3], masses: &[f64], radii: &[f64]) -> Self {
        let mut places = before.to_vec();
        move_apart(&mut places, radii, masses);
        let steps = places.iter().zip(before).map(|(now, before)| (*now - *before).norm());
        let (moved, farthest) = (steps.clone().filter(|step| *step > 0.0).count(), steps.fold(0.0, f64::max));
        let spread = least_spread(&places, radii);
        if spread > 1.0 {
            let all: Vec<u32> = (0..places.len() as u32).collect();
            let middle = center_of_mass(&places, masses, &all);
            for place in &mut places {
                *place = middle + (*place - middle) * spread;
            }
        }
        Self { places, moved, farthest, spread }
    }
}
