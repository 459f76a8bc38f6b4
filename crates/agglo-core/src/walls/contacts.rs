//! The pass over grains near walls, and what their contacts remember.
//!
//! Each contact is worked out by itself; then they are added up by rising grain and face, block by block, leaving out those that do
//! not touch. So sums depend neither on threads nor on when the list was made, and a resumed run has the same bits. Memory is
//! committed when a step is accepted, as that of contacts between grains.

use std::borrow::Cow;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::course::Pose;
use super::listed::{Candidate, Listed};
use super::meeting::{Lasted, Met, Partners, meet};
use super::wall::Walls;
use crate::contact::bond::StrainBond;
use crate::contact::friction::TangentialSpring;
use crate::contact::pass::{ContactRates, Record};
use crate::contact::{ContactLaws, PairTable};
use crate::ledger::Supply;
use crate::math::Vec3;
use crate::math::parallel::{self, BLOCK};
use crate::particles::Particles;

/// Contacts that one thread works out at a time.
const LEAF: usize = 256;

/// A contact that is remembered: place of the grain, wall, face, spring.
pub type RememberedAtWall = (u32, u32, u32, TangentialSpring);

/// The step at whose end grains meet walls, with laws and grains.
#[derive(Clone, Copy)]
pub struct WallStep<'a> {
    /// The walls.
    pub walls: &'a Walls,
    /// Laws of contact, if any.
    pub laws: Option<&'a ContactLaws>,
    /// The bond that acts in contact, if any.
    pub bond: Option<&'a StrainBond>,
    /// Constants of pairs of materials.
    pub pairs: &'a PairTable,
    /// The grains' constant columns.
    pub grains: &'a Particles,
    /// The grains on their way.
    pub records: &'a [Record],
    /// When it ends [s].
    pub time: f64,
    /// Time between its start and its end [s]: its length, or zero before the first.
    pub elapsed: f64,
    /// Its length [s], for laws that carry it.
    pub dt: f64,
}

impl<'a> WallStep<'a> {
    fn reach(&self) -> f64 {
        self.laws.map_or(0.0, ContactLaws::reach)
    }

    fn partners(&self, candidate: &Candidate) -> Partners<'a> {
        let (grain, body) = (candidate.grain as usize, &self.walls.bodies[candidate.face[0] as usize]);
        Partners {
            laws: self.laws,
            bond: self.bond,
            constants: self.pairs.of(self.grains.material[grain], body.material),
            mass: self.grains.mass[grain],
            stiffness: [self.grains.contact_stiffness[grain], body.stiffness],
        }
    }
}

fn block_of(candidate: &Candidate) -> usize {
    candidate.grain as usize / BLOCK
}

/// What a wall does to all grains together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WallRates {
    /// Power [W], force [N] and torque about the origin [N m] on the grains.
    pub supply: Supply,
    /// Contacts.
    pub contacts: u32,
}

impl WallRates {
    fn add(&mut self, met: &Met) {
        let supply = Supply { power: met.power, force: met.force, torque: met.place.cross(met.force) };
        self.supply = self.supply + supply;
        self.contacts += u32::from(met.spring.is_some());
    }
}

/// Grains near walls, their contacts and what comes of them.
#[derive(Debug, Default)]
pub struct WallContacts {
    listed: Listed,
    /// Poses of the walls at the start and at the end of the step, and when that is [s].
    poses: [Vec<Pose>; 2],
    time: f64,
    met: Vec<Met>,
    /// What contacts remember, by candidate; nothing where grain and wall do not touch.
    committed: Vec<Option<TangentialSpring>>,
    /// Committed contacts that the list left out because a try, not yet accepted, has parted them.
    parted: Vec<RememberedAtWall>,
    /// Force [N] and torque [N m] on each grain, and the grains that have any.
    loads: Vec<(Vec3, Vec3)>,
    loaded: Vec<u32>,
    /// What walls do at the motion that is tried, at the committed one, and have done since the start.
    trial: Vec<WallRates>,
    /// What they do to the grains of one block.
    in_block: Vec<WallRates>,
    rates: Vec<WallRates>,
    flows: Vec<Supply>,
    /// The deepest contact of the motion that is tried: overlap over radius, grain, wall.
    deepest: Option<(f64, u32, u32)>,
}

impl WallContacts {
    /// Room for a number of walls.
    pub fn new(walls: usize) -> Self {
        Self {
            trial: vec![WallRates::default(); walls],
            rates: vec![WallRates::default(); walls],
            flows: vec![Supply::default(); walls],
            ..Self::default()
        }
    }

    /// Goes on with what walls did when a state was saved.
    pub fn resume(&mut self, rates: Vec<WallRates>, flows: Vec<Supply>) {
        (self.rates, self.flows) = (rates, flows);
    }

    /// When grains met walls last [s].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Takes note that no grain is farther than this [m] from where it was tried last.
    pub fn note_way(&mut self, longest: f64) {
        self.listed.note_way(longest);
    }

    /// Works out all contacts at the end of a step; what they feed or drain comes on top of `contact`.
    pub fn compute(&mut self, step: &WallStep<'_>, contact: &mut ContactRates) {
        if step.walls.is_empty() {
            return;
        }
        self.move_walls(step);
        if !self.listed.holds(&self.poses[1]) {
            let remembered = self.remembered();
            self.relist(step, &remembered);
        }
        self.meet(step);
        self.add_up(contact);
    }

    fn move_walls(&mut self, step: &WallStep<'_>) {
        self.time = step.time;
        for (poses, time) in self.poses.iter_mut().zip([step.time - step.elapsed, step.time]) {
            poses.clear();
            poses.extend(step.walls.bodies.iter().map(|body| body.course.at(time)));
        }
    }

    /// Lists grains and walls anew where they are at the end of a step, and puts the remembered contacts in their new places.
    pub fn list(&mut self, step: &WallStep<'_>, remembered: &[RememberedAtWall]) {
        if !step.walls.is_empty() {
            self.move_walls(step);
            self.relist(step, remembered);
        }
    }

    fn relist(&mut self, step: &WallStep<'_>, remembered: &[RememberedAtWall]) {
        self.listed.build(step.walls, &self.poses[1], step.records, step.reach());
        let candidates = &self.listed.candidates;
        self.committed.clear();
        self.committed.resize(candidates.len(), None);
        self.met.clear();
        self.met.resize(candidates.len(), Met::default());
        self.parted.clear();
        for &(grain, wall, face, spring) in remembered {
            let key = (grain, [wall, face]);
            match candidates.binary_search_by_key(&key, |known| (known.grain, known.face)) {
                Ok(at) => self.committed[at] = Some(spring),
                Err(_) => self.parted.push((grain, wall, face, spring)),
            }
        }
        self.loads.clear();
        self.loads.resize(step.records.len(), (Vec3::ZERO, Vec3::ZERO));
        self.loaded.clear();
    }

    fn meet(&mut self, step: &WallStep<'_>) {
        let Self { listed, poses: [before, now], met, committed, .. } = self;
        let (candidates, reach) = (&listed.candidates, step.reach());
        let lasted = Lasted { elapsed: step.elapsed, dt: step.dt };
        let leaf = |range: Range<usize>, met: &mut [Met]| {
            for (met, at) in met.iter_mut().zip(range) {
                let candidate = &candidates[at];
                let record = &step.records[candidate.grain as usize];
                let wall = candidate.face[0] as usize;
                let near = step.walls.nearest(candidate.face, &now[wall], record.now().0);
                *met = if near.gap < record.radius() + reach {
                    let (partners, poses) = (step.partners(candidate), [&before[wall], &now[wall]]);
                    meet(&partners, record, &near, poses, lasted, committed[at].as_ref())
                } else {
                    Met::default()
                };
            }
        };
        parallel::over(0..candidates.len(), LEAF, &mut met[..], &leaf, &|(), ()| ());
    }

    /// Adds up within blocks of grains, then block by block, so that sums do not depend on who has which of them.
    fn add_up(&mut self, contact: &mut ContactRates) {
        let Self { listed, met, loads, loaded, trial, in_block, deepest, .. } = self;
        for &grain in &*loaded {
            loads[grain as usize] = (Vec3::ZERO, Vec3::ZERO);
        }
        loaded.clear();
        trial.fill(WallRates::default());
        *deepest = None;
        let mut met = &met[..];
        for candidates in listed.candidates.chunk_by(|a, b| block_of(a) == block_of(b)) {
            let (here, others) = met.split_at(candidates.len());
            met = others;
            let mut sums = ContactRates::default();
            in_block.clear();
            in_block.resize(trial.len(), WallRates::default());
            for (candidate, met) in candidates.iter().zip(here).filter(|(_, met)| met.acts) {
                let load = &mut loads[candidate.grain as usize];
                load.0 += met.force;
                load.1 += met.torque;
                loaded.push(candidate.grain);
                in_block[candidate.face[0] as usize].add(met);
                sums = sums.join(met.rates());
                if met.strain > deepest.map_or(0.0, |(strain, ..)| strain) {
                    *deepest = Some((met.strain, candidate.grain, candidate.face[0]));
                }
            }
            *contact = contact.join(sums);
            for (wall, part) in trial.iter_mut().zip(&*in_block) {
                wall.supply = wall.supply + part.supply;
                wall.contacts += part.contacts;
            }
        }
    }

    /// Force [N] and torque [N m] of all walls on a grain in the last pass; nothing where there are no walls.
    #[inline(always)]
    pub fn load_on(&self, grain: usize) -> Option<&(Vec3, Vec3)> {
        self.loads.get(grain)
    }

    /// What all walls do together at the motion that is tried.
    pub fn supply(&self) -> Supply {
        self.trial.iter().fold(Supply::default(), |sum, wall| sum + wall.supply)
    }

    /// The deepest contact of the last pass: overlap over radius, grain, wall.
    pub fn deepest(&self) -> Option<(f64, usize, usize)> {
        self.deepest.map(|(strain, grain, wall)| (strain, grain as usize, wall as usize))
    }

    /// Adds what walls did in a step of `dt` [s], `phi` being the weight of its end; before it is committed.
    pub fn book(&mut self, phi: f64, dt: f64) {
        for (flow, (before, after)) in self.flows.iter_mut().zip(self.rates.iter().zip(&self.trial)) {
            *flow = flow.plus(before.supply, (1.0 - phi) * dt).plus(after.supply, phi * dt);
        }
    }

    /// Forgets what walls have done so far.
    pub fn count_from_here(&mut self) {
        self.flows.fill(Supply::default());
    }

    /// Keeps the memory and the rates of the last pass.
    pub fn commit(&mut self) {
        for (kept, met) in self.committed.iter_mut().zip(&self.met) {
            *kept = met.spring;
        }
        self.parted.clear();
        self.rates.copy_from_slice(&self.trial);
    }

    /// The same of a pass over which no time went by: contacts that slid before still slide, though nothing moved.
    pub fn commit_unmoved(&mut self) {
        for (met, before) in self.met.iter_mut().zip(&self.committed) {
            if let (Some(spring), Some(before)) = (&mut met.spring, before) {
                spring.sliding |= before.sliding;
            }
        }
        self.commit();
    }

    /// The committed contacts with their memory.
    pub fn remembered(&self) -> Vec<RememberedAtWall> {
        let kept = self.listed.candidates.iter().zip(&self.committed).filter_map(|(candidate, spring)| {
            let Candidate { grain, face: [wall, face] } = *candidate;
            spring.map(|spring| (grain, wall, face, spring))
        });
        kept.chain(self.parted.iter().copied()).collect()
    }

    /// Energy [J] of the committed tangential springs.
    pub fn spring_energy(&self) -> f64 {
        let (mut sum, mut in_block, mut block) = (0.0, 0.0, 0);
        for (candidate, spring) in self.listed.candidates.iter().zip(&self.committed) {
            if block_of(candidate) != block {
                sum += std::mem::take(&mut in_block);
                block = block_of(candidate);
            }
            in_block += spring.as_ref().map_or(0.0, TangentialSpring::energy);
        }
        let parted = self.parted.iter().map(|(.., spring)| spring.energy());
        parted.fold(sum + in_block, |a, b| a + b)
    }

    /// What each wall does at the committed motion.
    pub fn rates(&self) -> &[WallRates] {
        &self.rates
    }

    /// Energy [J], impulse [N s] and angular impulse [N m s] that each wall has put in since the start.
    pub fn flows(&self) -> &[Supply] {
        &self.flows
    }

    /// Where walls are at a time [s]: known if grains met them then.
    pub(super) fn poses_at(&self, walls: &Walls, time: f64) -> Cow<'_, [Pose]> {
        let known = &self.poses[1];
        if self.time == time && known.len() == walls.len() {
            Cow::Borrowed(known)
        } else {
            Cow::Owned((0..walls.len()).map(|wall| walls.pose(wall, time)).collect())
        }
    }

    pub(super) fn candidates(&self) -> &[Candidate] {
        &self.listed.candidates
    }
}
