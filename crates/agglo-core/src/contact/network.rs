//! The bonds of all grains: their memory, their loads, and which of them break.

use std::ops::Add;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::bond::{Beam, BeamLoad, BeamPair, BeamState, Break};
use super::closeness::are_close;
use super::lever_arms;
use crate::domain::Space;
use crate::link::row_of_fields;
use crate::math::{Groups, Pace, Vec3, parallel};
use crate::neighbors::PairList;
use crate::particles::{ById, Motion, Particles};

/// Fewest bonds that one thread works out at a time.
const FEWEST: usize = 256;

/// A bond between two grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bond {
    /// Stable names of the grains, the lower first.
    pub ids: [u32; 2],
    /// Their places; whoever reads a bond from a file works them out from the ids.
    #[serde(skip)]
    pub grains: [u32; 2],
    /// What the bond remembers.
    pub state: BeamState,
}

/// A bond that broke or was made.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BondEvent {
    /// Simulated time [s].
    pub time: f64,
    /// Stable names of the grains.
    pub ids: [u32; 2],
    /// How it broke; nothing if it was made.
    pub broke: Option<Break>,
    /// Energy [J] that the bond held.
    pub energy: f64,
}

/// Bonds that are made now between pairs of grains, which are named by their places; at rest as they are.
pub fn bonds_between(law: &Beam, grains: &Particles, space: &Space, pairs: &[[u32; 2]]) -> Vec<Bond> {
    pairs.iter().map(|&[a, b]| bond_between(law, grains, space, a, b)).collect()
}

/// What all bonds do per second.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BondRates {
    /// Power lost in their dashpots [W].
    pub damping: f64,
    /// Power that space puts in as it is pressed together [W].
    pub strained: f64,
}

row_of_fields!(BondRates { damping: f64, strained: f64 });

impl Add for BondRates {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { damping: self.damping + other.damping, strained: self.strained + other.strained }
    }
}

/// A bond at the motion that is tried.
#[derive(Clone, Copy, Debug)]
struct Tried {
    state: BeamState,
    load: BeamLoad,
    /// Power [W] that space puts in.
    strained: f64,
}

/// All bonds, sorted by the grains' names.
#[derive(Clone, Debug, Default)]
pub struct Network {
    law: Option<Beam>,
    bonds: Vec<Bond>,
    trial: Vec<Tried>,
    /// Bonds by their grains, as 2 * bond + side.
    entries: Groups,
    made_at_start: usize,
}

impl Network {
    /// Bonds all grains whose surfaces are no farther apart than the law's gap.
    pub fn bond_neighbors(law: Option<&Beam>, grains: &Particles, space: &Space) -> Self {
        let mut network = Self { law: law.cloned(), ..Self::default() };
        if let Some(law) = law {
            let largest = grains.radius.iter().copied().fold(0.0, f64::max);
            let mut list = PairList::default();
            list.build(space, &(&grains.position[..], &grains.radius[..]), 0.0, law.gap * largest);
            for (a, b) in list.pairs() {
                let (i, j) = (a as usize, b as usize);
                let distance_squared = space.shortest(grains.position[i] - grains.position[j]).norm_squared();
                if are_close(distance_squared, grains.radius[i], grains.radius[j], law.gap) {
                    network.bonds.push(bond_between(law, grains, space, a, b));
                }
            }
        }
        network.made_at_start = network.bonds.len();
        network.settle(grains.len());
        network
    }

    /// Takes the bonds that grains bring along; without them bonds neighbors.
    pub fn start(law: Option<&Beam>, bonds: Option<Vec<Bond>>, grains: &Particles, space: &Space) -> Self {
        match bonds {
            Some(bonds) => {
                let held = bonds.len();
                Self::restored(law, bonds, held, grains.len())
            }
            None => Self::bond_neighbors(law, grains, space),
        }
    }

    /// Bonds whose grains have been given places anew; without those of grains that are not there.
    pub fn at_places(bonds: Vec<Bond>, places: &ById) -> Vec<Bond> {
        let placed = bonds.into_iter().filter_map(|bond| {
            let [a, b] = bond.ids.map(|id| places.find(id));
            Some(Bond { grains: [a? as u32, b? as u32], ..bond })
        });
        placed.collect()
    }

    /// Puts saved bonds back.
    pub fn restored(law: Option<&Beam>, bonds: Vec<Bond>, made_at_start: usize, grains: usize) -> Self {
        let mut network = Self { law: law.cloned(), bonds, made_at_start, ..Self::default() };
        network.settle(grains);
        network
    }

    /// The bonds that hold.
    pub fn bonds(&self) -> &[Bond] {
        &self.bonds
    }

    /// Takes the bonds that hold for those of the start.
    pub fn count_from_here(&mut self) {
        self.made_at_start = self.bonds.len();
    }

    /// Whether there is a law by which grains are bonded.
    pub fn is_active(&self) -> bool {
        self.law.is_some()
    }

    /// How many bonds the start had.
    pub fn made_at_start(&self) -> usize {
        self.made_at_start
    }

    /// Sorts the bonds and works out which belong to each grain.
    fn settle(&mut self, grains: usize) {
        self.bonds.sort_unstable_by_key(|bond| bond.ids);
        let at_rest = |bond: &Bond| Tried { state: bond.state, load: BeamLoad::default(), strained: 0.0 };
        self.trial = self.bonds.iter().map(at_rest).collect();
        let ends = self.bonds.iter().zip((0..).step_by(2)).flat_map(|(bond, entry)| {
            let [i, j] = bond.grains;
            [(i, entry), (j, entry + 1)]
        });
        self.entries.fill(grains, ends);
    }

    /// Computes all bonds' loads at the end of a step of `dt` [s], from the motions at both its ends and space as it was there.
    pub fn compute(&mut self, grains: &Particles, spaces: [&Space; 2], motions: [&Motion<'_>; 2], dt: f64) {
        let Some(law) = &self.law else { return };
        let tried = self.trial.par_iter_mut().zip(&self.bonds).with_min_len(FEWEST);
        tried.for_each(|(tried, bond)| {
            let (pair, flow) = pair_of(bond, grains, spaces, motions, dt);
            let (load, state) = law.advance(&bond.state, &pair);
            *tried = Tried { state, load, strained: load.force.dot(flow) };
        });
    }

    /// Adds the bonds' loads on one grain, and what the bonds do that are its own: those that name it first. So sums go by grains, not
    /// by bonds.
    #[inline(always)]
    pub fn gather(&self, grain: usize, force: &mut Vec3, torque: &mut Vec3, rates: &mut BondRates) {
        if self.bonds.is_empty() {
            return;
        }
        for &entry in self.entries.of(grain) {
            let Tried { load, strained, .. } = &self.trial[entry as usize / 2];
            if entry % 2 == 0 {
                *force += load.force;
                *torque += load.torque_i;
                rates.damping += load.damping_power;
                rates.strained += strained;
            } else {
                *force -= load.force;
                *torque += load.torque_j;
            }
        }
    }

    /// Keeps the memory of the last computation.
    pub fn commit(&mut self) {
        for (bond, tried) in self.bonds.iter_mut().zip(&self.trial) {
            bond.state = tried.state;
        }
    }

    /// Takes out the bonds that bear more than their strength; `loads` sees the load of each, which is no more.
    pub fn break_overloaded(
        &mut self,
        grains: &Particles,
        space: &Space,
        time: f64,
        mut loads: impl FnMut([u32; 2], &BeamLoad),
    ) -> Vec<BondEvent> {
        let Some(law) = &self.law else { return Vec::new() };
        if self.trial.iter().all(|tried| tried.load.breaks().is_none()) {
            return Vec::new();
        }
        let mut events = Vec::new();
        let mut kept = Vec::with_capacity(self.bonds.len());
        for (bond, Tried { load, .. }) in self.bonds.iter().zip(&self.trial) {
            let broke = load.breaks();
            if broke.is_some() {
                let energy = law.energy(&bond.state, distance_of(bond, grains, space));
                events.push(BondEvent { time, ids: bond.ids, broke, energy });
                loads(bond.grains, load);
            } else {
                kept.push((*bond, *load));
            }
        }
        let held: Vec<BeamLoad> = kept.iter().map(|(_, load)| *load).collect();
        self.bonds = kept.into_iter().map(|(bond, _)| bond).collect();
        self.settle(grains.len());
        self.trial.iter_mut().zip(held).for_each(|(tried, load)| tried.load = load);
        events
    }

    /// Bonds grains that overlap by more than the law's forming strain and are not bonded yet.
    pub fn bond_pressed(
        &mut self,
        grains: &Particles,
        space: &Space,
        list: &PairList,
        time: f64,
    ) -> Vec<BondEvent> {
        let Some(law) = &self.law else { return Vec::new() };
        let Some(strain) = law.forming_strain else { return Vec::new() };
        let pressed = list.pairs().filter(|(a, b)| {
            let (i, j) = (*a as usize, *b as usize);
            let reach = (grains.radius[i] + grains.radius[j]) * (1.0 - strain);
            space.shortest(grains.position[i] - grains.position[j]).norm_squared() <= reach * reach
        });
        let fresh: Vec<Bond> = pressed
            .map(|(a, b)| bond_between(law, grains, space, a, b))
            .filter(|bond| self.bonds.binary_search_by_key(&bond.ids, |known| known.ids).is_err())
            .collect();
        let events =
            fresh.iter().map(|bond| BondEvent { time, ids: bond.ids, broke: None, energy: 0.0 }).collect();
        if !fresh.is_empty() {
            self.bonds.extend(fresh);
            self.settle(grains.len());
        }
        events
    }

    /// How fast the fastest grain is on its bonds, each taken as often as its grain has bonds.
    pub fn pace(&self, grains: &Particles) -> Pace {
        let Some(law) = &self.law else { return Pace::NONE };
        let count = |grain: u32| self.entries.of(grain as usize).len() as u32;
        let paces = self.bonds.iter().map(|bond| {
            let places = bond.grains.map(|grain| grain as usize);
            let sum = grains.radius[places[0]] + grains.radius[places[1]];
            let pace = law.pace(
                &bond.state,
                places.map(|at| grains.mass[at]),
                places.map(|at| grains.inertia(at)),
                places.map(|at| grains.radius[at] / sum * bond.state.length),
            );
            let most = f64::from(count(bond.grains[0]).max(count(bond.grains[1])));
            Pace { square: pace.square * most, rate: pace.rate * most }
        });
        paces.fold(Pace::NONE, Pace::max)
    }

    /// Energy [J] stored in all bonds.
    pub fn energy(&self, grains: &Particles, space: &Space) -> f64 {
        let Some(law) = &self.law else { return 0.0 };
        let own = |grain: usize| self.entries.of(grain).iter().filter(|entry| *entry % 2 == 0);
        let energy = |entry: &u32| {
            let bond = &self.bonds[*entry as usize / 2];
            law.energy(&bond.state, distance_of(bond, grains, space))
        };
        parallel::sum(grains.len(), |grain| own(grain).map(energy).fold(0.0, |a, b| a + b))
    }

    /// The bonds of grains that are about to leave, as what they end with.
    pub fn ending(
        &self,
        leaves: impl Fn(u32) -> bool,
        grains: &Particles,
        space: &Space,
        time: f64,
    ) -> Vec<BondEvent> {
        let Some(law) = &self.law else { return Vec::new() };
        let ended = self.bonds.iter().filter(|bond| bond.grains.into_iter().any(&leaves));
        let event = |bond: &Bond| {
            let energy = law.energy(&bond.state, distance_of(bond, grains, space));
            BondEvent { time, ids: bond.ids, broke: Some(Break::Left), energy }
        };
        ended.map(event).collect()
    }

    /// The grains, of which `n` are left, came to new places; the bonds of those that are gone go with them.
    pub fn reindex(&mut self, place: &[Option<u32>], n: usize) {
        self.bonds.retain_mut(|bond| {
            let [Some(a), Some(b)] = bond.grains.map(|grain| place[grain as usize]) else { return false };
            bond.grains = [a, b];
            true
        });
        self.settle(n);
    }
}

fn distance_of(bond: &Bond, grains: &Particles, space: &Space) -> f64 {
    let [i, j] = bond.grains.map(|grain| grains.position[grain as usize]);
    space.shortest(j - i).norm()
}

fn bond_between(law: &Beam, grains: &Particles, space: &Space, a: u32, b: u32) -> Bond {
    let (a, b) = if grains.id[a as usize] < grains.id[b as usize] { (a, b) } else { (b, a) };
    let (i, j) = (a as usize, b as usize);
    let apart = space.shortest(grains.position[j] - grains.position[i]);
    let distance = apart.norm();
    let state = law.new_state(grains.radius[i], grains.radius[j], distance, apart / distance);
    Bond { ids: [grains.id[i], grains.id[j]], grains: [a, b], state }
}

/// The motion of a bond's two ends over a step, and how fast they part as they follow space [m/s].
fn pair_of(
    bond: &Bond,
    grains: &Particles,
    spaces: [&Space; 2],
    [before, now]: [&Motion<'_>; 2],
    dt: f64,
) -> (BeamPair, Vec3) {
    let [i, j] = bond.grains.map(|grain| grain as usize);
    let apart = spaces[1].shortest(now.position[j] - now.position[i]);
    let distance = apart.norm();
    let normal = apart * (1.0 / distance);
    // Slip over the step is taken across the normal of its middle, so that a turning pair slips by nothing.
    let apart_before = spaces[0].shortest(before.position[j] - before.position[i]);
    let flow = spaces[1].flow(apart);
    let middle = (apart + apart_before).normalized();
    let lever_arms = lever_arms([grains.radius[i], grains.radius[j]], distance);
    let ends = |motion: &Motion<'_>| {
        let rolling = motion.angular_velocity[i] * lever_arms[0] + motion.angular_velocity[j] * lever_arms[1];
        (
            motion.velocity[j] - motion.velocity[i] + flow,
            rolling,
            motion.angular_velocity[j] - motion.angular_velocity[i],
        )
    };
    let ((parting_before, rolling_before, turn_before), (parting, rolling, turn)) = (ends(before), ends(now));
    let velocity = parting - rolling.cross(normal);
    let mean = (parting_before + parting - (rolling_before + rolling).cross(middle)) * 0.5;
    let angular_velocities = before.angular_velocity[i]
        + before.angular_velocity[j]
        + now.angular_velocity[i]
        + now.angular_velocity[j];
    let (mi, mj) = (grains.mass[i], grains.mass[j]);
    let (ii, ij) = (grains.inertia(i), grains.inertia(j));
    let pair = BeamPair {
        distance,
        normal,
        lever_arms,
        displacement: mean.rejected_from(middle) * dt,
        rotation: (turn_before + turn) * (0.5 * dt),
        turn_about_normal: angular_velocities.dot(normal) * (0.25 * dt),
        separation_speed: velocity.dot(normal),
        slip: velocity.rejected_from(normal),
        angular_velocity_difference: turn,
        effective_mass: mi * mj / (mi + mj),
        effective_inertia: ii * ij / (ii + ij),
    };
    (pair, flow)
}
