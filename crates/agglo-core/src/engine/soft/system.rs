//! The grains with all that acts on them: forces are evaluated here, steps are tried and committed.

use std::ops::Range;

use crate::contact::ContactLaws;
use crate::contact::network::{BondEvent, Network};
use crate::contact::pass::{
    Centers, ContactRates, ContactWorld, Contacts, Passage, Record, Remembered, Snapshot,
};
use crate::domain::{Image, Space, SpaceInTime, Stretch};
use crate::ledger::Rates;
use crate::link::Domain;
use crate::math::parallel::{self, BLOCK};
use crate::math::{Pace, Vec3};
use crate::neighbors::{PairList, morton_order};
use crate::particles::{Motion, Particles};
use crate::walls::WallContacts;

use super::forces::gather::{Gather, Gathered};
use super::forces::laws::Laws;
use super::forces::loads::{LoadViews, Loads};
use super::hook::{Attached, Hook, Scene};
use super::saved_contacts::SavedContacts;
use super::skin::Skin;
use super::step::change::Afloat;

/// A motion that is tried before it is committed.
#[derive(Clone, Debug, Default)]
pub struct Trial {
    /// Centers [m]; these columns are filled from the records when someone looks.
    pub position: Vec<Vec3>,
    /// Velocities [m/s].
    pub velocity: Vec<Vec3>,
    /// Angular velocities [rad/s].
    pub angular_velocity: Vec<Vec3>,
    is_looked_at: bool,
    /// Loads at this motion.
    pub loads: Loads,
    /// Rates at this motion.
    pub rates: Rates,
    /// Contacts at this motion.
    pub contact: ContactRates,
}

/// Grains, laws, neighbors, and loads.
#[derive(Debug)]
pub struct System {
    /// The grains, at the last committed step.
    pub grains: Particles,
    /// Space, which may repeat itself, at the end of the step that is tried, or as it was tried last.
    pub space: Space,
    /// The same at the start of the step.
    pub(super) space_before: Space,
    pub(super) space_in_time: SpaceInTime,
    /// In which of its images each grain would be by now, if it had not come back in; empty where space is open.
    pub images: Vec<Image>,
    /// The laws.
    pub laws: Laws,
    /// Bonds.
    pub network: Network,
    /// Loads at the last committed step, without those of rays.
    pub loads: Loads,
    /// Rates at the last committed step.
    pub rates: Rates,
    /// Loads of rays, constant over one step: impulses [N s, N m s], or forces where `rays_are_impulses` is false; empty until a
    /// ray flies.
    pub ray_loads: Loads,
    /// Whether there is any load of rays in this step.
    pub has_ray_loads: bool,
    /// Whether the loads of rays are impulses.
    pub rays_are_impulses: bool,
    /// The motion that is tried.
    pub trial: Trial,
    /// Masses that resist acceleration [kg].
    pub inertial_mass: Vec<f64>,
    /// The grains on their way through the step that is tried.
    pub(super) records: Vec<Record>,
    /// Where the state of the grains is in the records, and their columns were left behind: the step that was begun.
    pub(super) afloat: Option<Afloat>,
    pub(super) hook: Option<Attached>,
    pub(super) contacts: Contacts,
    pub(super) walls: WallContacts,
    /// Which blocks are worked out here.
    pub(super) domain: Domain,
    list: PairList,
    pub(super) near: PairList,
    pub(super) skin: Skin,
}

impl Trial {
    /// The columns of the motion, which must have been filled.
    pub(super) fn motion(&self) -> Motion<'_> {
        let Self { position, velocity, angular_velocity, .. } = self;
        Motion { position, velocity, angular_velocity }
    }
}

impl System {
    /// Grains under laws at a time [s] in a space; forces are not yet known.
    pub fn new(
        mut grains: Particles,
        laws: Laws,
        network: Network,
        (space_in_time, time): (SpaceInTime, f64),
    ) -> Self {
        let (n, space) = (grains.len(), space_in_time.at(time));
        for place in &mut grains.position {
            *place = space.home(*place).0;
        }
        let inertial_mass: Vec<f64> = (0..n).map(|at| laws.inertial_mass(&grains, at)).collect();
        let mut system = Self {
            skin: Skin::new(&grains.radius),
            loads: Loads::none(n),
            ray_loads: Loads::default(),
            has_ray_loads: false,
            rays_are_impulses: true,
            rates: Rates::default(),
            images: vec![[0; 3]; if space.repeats() { n } else { 0 }],
            space,
            space_before: space,
            space_in_time,
            hook: None,
            contacts: Contacts::default(),
            walls: WallContacts::new(laws.walls.len()),
            domain: Domain::default(),
            list: PairList::default(),
            near: PairList::default(),
            laws,
            network,
            trial: Trial::default(),
            records: Vec::new(),
            afloat: None,
            grains,
            inertial_mass,
        };
        system.renew_records();
        system
    }

    /// Space moves on from one time [s] to another; how places follow it.
    pub(super) fn move_space(&mut self, from: f64, to: f64) -> Option<Stretch> {
        if self.space_in_time.changes() {
            (self.space_before, self.space) = (self.space_in_time.at(from), self.space_in_time.at(to));
        }
        self.space_in_time.stretch(from, to)
    }

    /// Puts the records of all grains at the start of a step.
    fn renew_records(&mut self) {
        let Self { records, grains, inertial_mass, .. } = self;
        records.clear();
        records.extend(inertial_mass.iter().zip(0..).map(|(mass, at)| Record::at_start(grains, at, *mass)));
    }

    /// Puts the grains under other laws, in space that starts anew; bonds stay, and count as made at the start.
    pub fn change_laws(&mut self, laws: Laws, space_in_time: SpaceInTime) {
        self.space_in_time = space_in_time;
        self.move_space(0.0, 0.0);
        self.inertial_mass = (0..self.grains.len()).map(|at| laws.inertial_mass(&self.grains, at)).collect();
        self.renew_records();
        self.laws = laws;
        self.walls.count_from_here();
        self.network.count_from_here();
    }

    /// The fastest of all grains, at what `pace` gives for each.
    pub(super) fn over_grains(&self, pace: impl Fn(usize) -> Pace + Sync) -> Pace {
        let [fastest] = self.over_grains_each(|at| [pace(at)]);
        fastest
    }

    /// The fastest of all grains in each of several respects.
    pub(super) fn over_grains_each<const N: usize>(
        &self,
        paces: impl Fn(usize) -> [Pace; N] + Sync,
    ) -> [Pace; N] {
        let faster = |a: [Pace; N], b: [Pace; N]| std::array::from_fn(|each| a[each].max(b[each]));
        let leaf = |range: Range<usize>, ()| range.map(&paces).fold([Pace::NONE; N], faster);
        parallel::over(0..self.grains.len(), BLOCK, (), &leaf, &faster)
    }

    /// Evaluates all loads and rates at the trial motion, at the end of a step of `dt` [s] that ends at `time` [s].
    pub fn evaluate(&mut self, time: f64, dt: f64) {
        self.meet(dt, time, dt);
        self.gather(time);
    }

    /// Lets grains meet at the trial motion, at the end of a step of `dt` [s] that ends at `time` [s]: all loads but those of
    /// single grains, with memory that is carried on by `elapsed` [s].
    pub(super) fn meet(&mut self, elapsed: f64, time: f64, dt: f64) {
        self.bring_lists_up_to_date();
        if self.network.is_active() || self.hook.is_some() || self.laws.fields.near_field.is_some() {
            self.look_at_trial();
        }
        let Self {
            grains,
            laws,
            network,
            contacts,
            walls,
            list,
            trial,
            hook,
            records,
            space,
            space_before,
            domain,
            ..
        } = self;
        let world = ContactWorld {
            space,
            laws: laws.contact.as_ref(),
            bonds: laws.bonds.as_ref(),
            pairs: &laws.pairs,
            list,
        };
        trial.contact = contacts.compute(domain, &world, &Passage { records, elapsed, dt });
        walls.compute(&laws.wall_step(grains, records, [time, elapsed, dt]), &mut trial.contact);
        network.compute(grains, [space_before, space], [&grains.motion(), &trial.motion()], elapsed);
        if let Some(hook) = hook {
            hook.look(&Scene { time, grains, motion: trial.motion() });
        }
    }

    /// Gathers the loads at the trial motion, at a time [s].
    fn gather(&mut self, time: f64) {
        let Self {
            grains, laws, network, contacts, walls, near, trial, hook, records, space, domain, ..
        } = self;
        let hook = hook.as_ref().map(|hook| &hook.loads);
        let positions = &trial.position[..];
        let gather = Gather { grains, laws, network, contacts, walls, near, positions, space, time, hook };
        let leaf = |range: Range<usize>, loads: LoadViews<'_>| {
            let mut sums = Gathered::default();
            for (slot, grain) in range.enumerate() {
                let now = records[grain].now();
                (loads.force[slot], loads.torque[slot]) = gather.on(grain, now, &mut sums);
            }
            sums
        };
        trial.loads.fit(grains.len());
        let n = grains.len();
        let sums = domain.over(0..n, BLOCK, trial.loads.views(), &leaf, &|a, b| a + b);
        domain.share_grains(&mut trial.loads.force);
        domain.share_grains(&mut trial.loads.torque);
        trial.rates = Rates::new(&trial.contact, sums.bonds, sums.supplies.with_walls(walls.supply()));
    }

    /// Fills the columns of the trial motion, if they are not.
    pub(super) fn look_at_trial(&mut self) {
        let Self { trial, records, .. } = self;
        if trial.is_looked_at {
            return;
        }
        trial.is_looked_at = true;
        let columns = [&mut trial.position, &mut trial.velocity, &mut trial.angular_velocity];
        for column in columns {
            column.resize(records.len(), Vec3::ZERO);
        }
        show_now(records, (&mut trial.position, &mut trial.velocity, &mut trial.angular_velocity));
    }

    /// Takes note that no grain is farther than this [m] from where it was tried last.
    pub(super) fn note_way(&mut self, longest: f64) {
        self.trial.is_looked_at = false;
        self.list.note_way(longest);
        self.near.note_way(longest);
        self.walls.note_way(longest);
    }

    /// What a hook sees of the committed motion at a time [s].
    fn scene(&self, time: f64) -> Scene<'_> {
        Scene { time, grains: &self.grains, motion: self.grains.motion() }
    }

    /// Attaches a hook at a time [s]; unless `is_in_loads` its forces are added to those of the committed motion.
    pub(super) fn attach(&mut self, hook: Box<dyn Hook>, time: f64, is_in_loads: bool) {
        let mut attached = Attached { hook, loads: Loads::none(self.grains.len()) };
        attached.look(&self.scene(time));
        if !is_in_loads {
            for at in 0..self.grains.len() {
                let supply = Attached::supply(&attached.loads, self.grains.motion_of(at), at);
                self.rates.supplies.hook = self.rates.supplies.hook + supply;
                self.loads.force[at] += attached.loads.force[at];
                self.loads.torque[at] += attached.loads.torque[at];
            }
        }
        self.hook = Some(attached);
    }

    /// Tells the hook where a step led.
    pub(super) fn tell_hook(&mut self, time: f64) {
        if let Some(mut attached) = self.hook.take() {
            attached.hook.after_step(&self.scene(time));
            self.hook = Some(attached);
        }
    }

    /// How fast the hook is, as far as it says.
    pub(super) fn hook_pace(&self, time: f64) -> Option<Pace> {
        self.hook.as_ref().and_then(|attached| attached.hook.pace(&self.scene(time)))
    }

    /// Makes the trial motion, as it was tried last, that of the grains.
    pub(super) fn settle(&mut self) {
        let Self { grains, records, loads, trial, space, images, .. } = self;
        show_now(records, (&mut grains.position, &mut grains.velocity, &mut grains.angular_velocity));
        for (place, image) in grains.position.iter_mut().zip(images) {
            bring_home(space, place, image);
        }
        std::mem::swap(loads, &mut trial.loads);
    }

    /// Makes rates and memory of the trial those of the state.
    pub fn commit(&mut self) {
        self.rates = self.trial.rates;
        self.network.commit();
        self.contacts.commit();
        self.walls.commit();
    }

    /// Evaluates the loads at the committed motion, before the first step; `dt` [s] is the length of that. No time
    /// has passed for springs of contacts and bonds, which begin without load unless they bring one along.
    pub fn evaluate_start(&mut self, dt: f64) {
        self.evaluate_again(0.0, dt);
    }

    /// The same at a time [s], where velocities were changed from outside.
    pub fn evaluate_again(&mut self, time: f64, dt: f64) {
        self.list_neighbors();
        self.meet(0.0, time, dt);
        // Those that there are go, and few schemes try others: one pair of columns is enough.
        self.trial.loads = std::mem::take(&mut self.loads);
        self.gather(time);
        self.loads = std::mem::take(&mut self.trial.loads);
        self.rates = self.trial.rates;
        self.network.commit();
        self.contacts.commit_unmoved();
        self.walls.commit_unmoved();
    }

    /// Lists the neighbors at the committed motion, so that pairs can be looked at before the first step.
    pub fn list_neighbors(&mut self) {
        self.renew_records();
        // Where grains were before is not known.
        self.note_way(f64::INFINITY);
        self.bring_lists_up_to_date();
    }

    /// Factor from the loads of rays to forces in a step of `dt` [s].
    #[inline]
    pub fn ray_load_scale(&self, dt: f64) -> f64 {
        if self.rays_are_impulses { 1.0 / dt } else { 1.0 }
    }

    /// Shows what the contact laws see at the committed motion.
    pub fn with_contacts<R>(&self, look: impl FnOnce(&Snapshot<'_>) -> R) -> R {
        self.with_contacts_at(self.grains.motion(), look)
    }

    /// The same at the trial motion.
    pub fn with_trial_contacts<R>(&mut self, look: impl FnOnce(&Snapshot<'_>) -> R) -> R {
        self.look_at_trial();
        self.with_contacts_at(self.trial.motion(), look)
    }

    fn with_contacts_at<R>(&self, now: Motion<'_>, look: impl FnOnce(&Snapshot<'_>) -> R) -> R {
        let Self { grains, laws, list, space, .. } = self;
        let (contact, bonds) = (laws.contact.as_ref(), laws.bonds.as_ref());
        let world = ContactWorld { laws: contact, bonds, pairs: &laws.pairs, list, space };
        look(&Snapshot { world, grains, now })
    }

    /// Takes out the bonds that bear more than their strength, with their loads: a load that went on to act in the
    /// next step would do work that no ledger knows of.
    pub fn break_bonds(&mut self, time: f64) -> Vec<BondEvent> {
        let Self { grains, network, loads, rates, space, .. } = self;
        network.break_overloaded(grains, space, time, |ends, load| {
            let [i, j] = ends.map(|grain| grain as usize);
            loads.force[i] -= load.force;
            loads.force[j] += load.force;
            loads.torque[i] -= load.torque_i;
            loads.torque[j] -= load.torque_j;
            rates.bond_damping -= load.damping_power;
            let apart = space.shortest(grains.position[j] - grains.position[i]);
            rates.strained -= load.force.dot(space.flow(apart));
        })
    }

    /// Takes all grains but these, which are in their order, out with their bonds; the new place of each, and the bonds that ended.
    pub(super) fn keep(&mut self, staying: &[u32], time: f64) -> (Vec<Option<u32>>, Vec<BondEvent>) {
        let stays = |grain: u32| staying.binary_search(&grain).is_ok();
        let ended = self.network.ending(|grain| !stays(grain), &self.grains, &self.space, time);
        let place = self.reorder(staying);
        if let Some(hook) = &mut self.hook {
            hook.loads.fit(staying.len());
        }
        (place, ended)
    }

    /// Bonds grains that were pressed together hard enough; tells which.
    pub fn bond_pressed(&mut self, time: f64) -> Vec<BondEvent> {
        self.network.bond_pressed(&self.grains, &self.space, &self.list, time)
    }

    /// Energy [J] of the tangential springs of contacts.
    pub fn spring_energy(&self) -> f64 {
        self.contacts.spring_energy(&self.list) + self.walls.spring_energy()
    }

    /// The contacts' memory, by the grains' places.
    pub fn remembered(&self) -> Vec<Remembered> {
        self.contacts.remembered(&self.list).collect()
    }

    /// The same by their ids, without a list of its own.
    pub(super) fn saved_contacts(&self) -> SavedContacts<'_> {
        SavedContacts::Kept { contacts: &self.contacts, list: &self.list, ids: &self.grains.id }
    }

    /// Puts back the contacts' memory, at the committed motion.
    pub fn remember(&mut self, remembered: &[Remembered]) {
        self.contacts.set_aside_these(remembered);
        self.rebuild();
        self.list_near();
    }

    fn bring_lists_up_to_date(&mut self) {
        self.skin.age();
        if self.list.holds() && (self.near_list().is_none() || self.near.holds()) {
            return;
        }
        if !self.list.holds_for(&&self.records[..]) {
            self.contacts.set_aside(&self.list, Some);
            self.skin.adapt(self.list.len(), self.grains.len());
            self.rebuild();
        }
        if !self.near.holds_for(&Centers(&self.records)) {
            self.list_near();
        }
    }

    /// Lists the pairs anew where the records have the grains, with the contacts that were set aside.
    fn rebuild(&mut self) {
        let reach = self.laws.contact.as_ref().map_or(0.0, ContactLaws::reach);
        self.list.build(&self.space, &&self.records[..], reach, self.skin.thickness());
        self.contacts.relist(&self.list, self.grains.len(), self.laws.contact.as_ref());
    }

    /// Sorts the grains along a space-filling curve; returns the order, or nothing if it is that already.
    pub fn sort_in_space(&mut self) -> Option<Vec<Option<u32>>> {
        let order = morton_order(&self.grains.position);
        if order.iter().zip(0..).all(|(a, b)| *a == b) {
            return None;
        }
        Some(self.reorder(&order))
    }

    /// Puts the grains into another order: the one at `order[k]` comes to place k, and those that it does not name are gone. Returns
    /// the new place of each.
    pub(super) fn reorder(&mut self, order: &[u32]) -> Vec<Option<u32>> {
        let mut place = vec![None; self.grains.len()];
        for (new, &old) in order.iter().enumerate() {
            place[old as usize] = Some(new as u32);
        }
        self.contacts.set_aside(&self.list, |grain| place[grain as usize]);
        let at_walls = self.walls_remembered_at(|grain| place[grain as usize]);
        self.grains.reorder(order);
        if self.space.repeats() {
            self.images = order.iter().map(|&at| self.images[at as usize]).collect();
        }
        self.loads.reorder(order);
        self.ray_loads.reorder(order);
        self.inertial_mass = order.iter().map(|&at| self.inertial_mass[at as usize]).collect();
        self.renew_records();
        self.network.reindex(&place, order.len());
        self.rebuild();
        self.list_near();
        self.remember_walls(&at_walls, None);
        place
    }
}

/// Brings a grain back in from where a step has led it [m], and takes note of the image that it would be in.
#[inline(always)]
pub(super) fn bring_home(space: &Space, place: &mut Vec3, image: &mut Image) {
    let (home, out) = space.home(*place);
    *place = home;
    image.iter_mut().zip(out).for_each(|(sum, more)| *sum = sum.saturating_add(more));
}

/// Writes positions [m], velocities [m/s] and angular velocities [rad/s] at the end of the step into columns.
fn show_now(records: &[Record], (position, velocity, spin): (&mut [Vec3], &mut [Vec3], &mut [Vec3])) {
    let leaf = |range: Range<usize>, (r, v, w): (&mut [Vec3], &mut [Vec3], &mut [Vec3])| {
        for (slot, grain) in range.enumerate() {
            (r[slot], v[slot], w[slot]) = records[grain].now();
        }
    };
    parallel::over(0..records.len(), BLOCK, (position, velocity, spin), &leaf, &|(), ()| ());
}
