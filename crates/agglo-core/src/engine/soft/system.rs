//! The grains with all that acts on them: forces are evaluated here, steps are tried and committed.

use std::ops::Range;

use crate::contact::ContactLaws;
use crate::contact::network::{BondEvent, Network};
use crate::contact::pass::{ContactRates, ContactWorld, Contacts, Remembered};
use crate::ledger::{Rates, Supplies, Supply};
use crate::math::{Pace, Vec3, parallel};
use crate::neighbors::{PairList, morton_order};
use crate::particles::{Motion, Particles};

use super::forces::laws::{Laws, near_force, source};
use super::forces::loads::{LoadViews, Loads};
use super::hook::{Attached, Hook, Scene};
use super::skin::Skin;

/// Grains per leaf of the parallel loops.
pub(super) const LEAF: usize = 1024;

/// A motion that is tried before it is committed.
#[derive(Clone, Debug, Default)]
pub struct Trial {
    /// Centers [m].
    pub position: Vec<Vec3>,
    /// Velocities [m/s].
    pub velocity: Vec<Vec3>,
    /// Angular velocities [rad/s].
    pub angular_velocity: Vec<Vec3>,
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
    /// The laws.
    pub laws: Laws,
    /// Bonds.
    pub network: Network,
    /// Loads at the last committed step, without those of rays.
    pub loads: Loads,
    /// Rates at the last committed step.
    pub rates: Rates,
    /// Loads of rays, constant over one step: impulses [N s, N m s], or forces where `rays_are_impulses` is false.
    pub ray_loads: Loads,
    /// Whether there is any load of rays in this step.
    pub has_ray_loads: bool,
    /// Whether the loads of rays are impulses.
    pub rays_are_impulses: bool,
    /// The motion that is tried.
    pub trial: Trial,
    /// Masses that resist acceleration [kg].
    pub inertial_mass: Vec<f64>,
    pub(super) hook: Option<Attached>,
    pub(super) contacts: Contacts,
    list: PairList,
    near: PairList,
    pub(super) skin: Skin,
}

impl System {
    /// Grains under laws; forces are not yet known.
    pub fn new(grains: Particles, laws: Laws, network: Network) -> Self {
        let n = grains.len();
        let inertial_mass = (0..n).map(|at| laws.inertial_mass(&grains, at)).collect();
        let trial = Trial {
            position: grains.position.clone(),
            velocity: grains.velocity.clone(),
            angular_velocity: grains.angular_velocity.clone(),
            loads: Loads::none(n),
            ..Trial::default()
        };
        Self {
            skin: Skin::new(&grains.radius),
            loads: Loads::none(n),
            ray_loads: Loads::none(n),
            has_ray_loads: false,
            rays_are_impulses: true,
            rates: Rates::default(),
            hook: None,
            contacts: Contacts::default(),
            list: PairList::default(),
            near: PairList::default(),
            grains,
            laws,
            network,
            trial,
            inertial_mass,
        }
    }

    /// Puts the grains under other laws; bonds stay, and count as made at the start.
    pub fn change_laws(&mut self, laws: Laws) {
        self.inertial_mass = (0..self.grains.len()).map(|at| laws.inertial_mass(&self.grains, at)).collect();
        self.laws = laws;
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
        parallel::over(0..self.grains.len(), LEAF, (), &leaf, &faster)
    }

    /// The committed motion.
    pub fn motion(&self) -> Motion<'_> {
        let grains = &self.grains;
        Motion {
            position: &grains.position,
            velocity: &grains.velocity,
            angular_velocity: &grains.angular_velocity,
        }
    }

    /// Evaluates all loads and rates at the trial motion, at the end of a step of `dt` [s] that ends at `time` [s].
    pub fn evaluate(&mut self, time: f64, dt: f64) {
        self.evaluate_after(dt, time, dt);
    }

    /// As `evaluate`, with memory that is carried on by `elapsed` [s].
    fn evaluate_after(&mut self, elapsed: f64, time: f64, dt: f64) {
        self.bring_lists_up_to_date();
        let Self { grains, laws, network, contacts, list, near, trial, hook, .. } = self;
        let now = Motion {
            position: &trial.position,
            velocity: &trial.velocity,
            angular_velocity: &trial.angular_velocity,
        };
        let before = Motion {
            position: &grains.position,
            velocity: &grains.velocity,
            angular_velocity: &grains.angular_velocity,
        };
        let world = ContactWorld {
            grains,
            laws: laws.contact.as_ref(),
            bonds: laws.bonds.as_ref(),
            pairs: &laws.pairs,
            list,
            before,
            now,
            elapsed,
            dt,
        };
        trial.contact = contacts.compute(&world);
        let bond_damping = network.compute(grains, &before, &now, elapsed);
        if let Some(hook) = hook {
            hook.look(&Scene { time, grains, motion: now });
        }
        let hook = hook.as_ref().map(|hook| &hook.loads);
        let gather = Gather { grains, laws, network, contacts, near, now, time, hook };
        let supplies = parallel::over(
            0..grains.len(),
            LEAF,
            trial.loads.views(),
            &|range, mut views| gather.leaf(range, &mut views),
            &|a, b| a + b,
        );
        trial.rates = Rates::new(&trial.contact, bond_damping, supplies);
    }

    /// What a hook sees of the committed motion at a time [s].
    fn scene(&self, time: f64) -> Scene<'_> {
        Scene { time, grains: &self.grains, motion: self.motion() }
    }

    /// Attaches a hook at a time [s]; unless `is_in_loads` its forces are added to those of the committed motion.
    pub(super) fn attach(&mut self, hook: Box<dyn Hook>, time: f64, is_in_loads: bool) {
        let mut attached = Attached { hook, loads: Loads::none(self.grains.len()) };
        attached.look(&self.scene(time));
        if !is_in_loads {
            for at in 0..self.grains.len() {
                let supply = Attached::supply(&attached.loads, &self.motion(), at);
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

    /// Makes the trial the state.
    pub fn commit(&mut self) {
        self.commit_motion();
        self.contacts.commit();
    }

    fn commit_motion(&mut self) {
        let Self { grains, trial, .. } = self;
        std::mem::swap(&mut grains.position, &mut trial.position);
        std::mem::swap(&mut grains.velocity, &mut trial.velocity);
        std::mem::swap(&mut grains.angular_velocity, &mut trial.angular_velocity);
        std::mem::swap(&mut self.loads, &mut trial.loads);
        self.rates = trial.rates;
        self.network.commit();
    }

    /// Evaluates the loads at the committed motion, before the first step; `dt` [s] is the length of that. No time
    /// has passed for springs of contacts and bonds, which begin without load unless they bring one along.
    pub fn evaluate_start(&mut self, dt: f64) {
        self.evaluate_again(0.0, dt);
    }

    /// The same at a time [s], where velocities were changed from outside.
    pub fn evaluate_again(&mut self, time: f64, dt: f64) {
        self.list_neighbors();
        self.evaluate_after(0.0, time, dt);
        self.commit_motion();
        self.contacts.commit_unmoved();
    }

    /// Lists the neighbors at the committed motion, so that pairs can be looked at before the first step.
    pub fn list_neighbors(&mut self) {
        self.trial.position.clone_from(&self.grains.position);
        self.trial.velocity.clone_from(&self.grains.velocity);
        self.trial.angular_velocity.clone_from(&self.grains.angular_velocity);
        self.bring_lists_up_to_date();
    }

    /// Factor from the loads of rays to forces in a step of `dt` [s].
    #[inline]
    pub fn ray_load_scale(&self, dt: f64) -> f64 {
        if self.rays_are_impulses { 1.0 / dt } else { 1.0 }
    }

    /// Shows what the contact laws see at the committed motion.
    pub fn with_contacts<R>(&self, look: impl FnOnce(&ContactWorld<'_>) -> R) -> R {
        self.with_contacts_at(self.motion(), look)
    }

    /// The same at the trial motion.
    pub fn with_trial_contacts<R>(&self, look: impl FnOnce(&ContactWorld<'_>) -> R) -> R {
        let Trial { position, velocity, angular_velocity, .. } = &self.trial;
        self.with_contacts_at(Motion { position, velocity, angular_velocity }, look)
    }

    fn with_contacts_at<R>(&self, motion: Motion<'_>, look: impl FnOnce(&ContactWorld<'_>) -> R) -> R {
        let laws = &self.laws;
        look(&ContactWorld {
            grains: &self.grains,
            laws: laws.contact.as_ref(),
            bonds: laws.bonds.as_ref(),
            pairs: &laws.pairs,
            list: &self.list,
            before: motion,
            now: motion,
            elapsed: 0.0,
            dt: 0.0,
        })
    }

    /// Takes out the bonds that bear more than their strength, with their loads: a load that went on to act in the
    /// next step would do work that no ledger knows of.
    pub fn break_bonds(&mut self, time: f64) -> Vec<BondEvent> {
        let Self { grains, network, loads, rates, .. } = self;
        network.break_overloaded(grains, time, |ends, load| {
            let [i, j] = ends.map(|grain| grain as usize);
            loads.force[i] -= load.force;
            loads.force[j] += load.force;
            loads.torque[i] -= load.torque_i;
            loads.torque[j] -= load.torque_j;
            rates.bond_damping -= load.damping_power;
        })
    }

    /// Bonds grains that were pressed together hard enough; tells which.
    pub fn bond_pressed(&mut self, time: f64) -> Vec<BondEvent> {
        self.network.bond_pressed(&self.grains, &self.list, time)
    }

    /// Pairs within the near field's cut-off and a little more; nothing where all pairs count.
    pub fn near_list(&self) -> Option<&PairList> {
        self.laws.fields.near_field.as_ref().and_then(|law| law.cutoff).map(|_| &self.near)
    }

    /// How fast the fastest pair of the near field is where grains are.
    pub fn near_pace_now(&self) -> Pace {
        self.near_pace(&self.grains.position)
    }

    /// The same at the trial motion, where neither a contact nor the law's own cap keeps grains apart; else nothing.
    pub fn near_pace_at_trial(&self) -> Pace {
        let is_capped = self.laws.fields.near_field.as_ref().is_none_or(|law| law.law.is_capped());
        if is_capped || self.laws.contact.is_some() {
            return Pace::NONE;
        }
        self.near_pace(&self.trial.position)
    }

    fn near_pace(&self, positions: &[Vec3]) -> Pace {
        let Some(law) = &self.laws.fields.near_field else { return Pace::NONE };
        let pace = |a: usize, b: usize| {
            let distance = (positions[b] - positions[a]).norm();
            law.pace(&source(&self.grains, a), &source(&self.grains, b), distance)
        };
        self.over_grains(|a| match self.near_list() {
            Some(list) => {
                list.owned(a).map(|pair| pace(a, list.partners()[pair] as usize)).fold(Pace::NONE, Pace::max)
            }
            None => (a + 1..self.grains.len()).map(|b| pace(a, b)).fold(Pace::NONE, Pace::max),
        })
    }

    /// Energy [J] of the tangential springs of contacts.
    pub fn spring_energy(&self) -> f64 {
        self.contacts.spring_energy()
    }

    /// The contacts' memory, by the grains' places.
    pub fn remembered(&self) -> Vec<Remembered> {
        self.contacts.remembered(&self.list)
    }

    /// Puts back the contacts' memory.
    pub fn remember(&mut self, remembered: &[Remembered]) {
        self.rebuild(false, remembered);
        self.list_near(false);
    }

    fn bring_lists_up_to_date(&mut self) {
        self.skin.age();
        if !self.list.holds_for(&self.trial.position) {
            let remembered = self.contacts.remembered(&self.list);
            self.skin.adapt(self.list.len(), self.grains.len());
            self.rebuild(true, &remembered);
        }
        if !self.near.holds_for(&self.trial.position) {
            self.list_near(true);
        }
    }

    /// Lists the pairs of the near field anew, if it has a cut-off, at the trial or the committed positions.
    fn list_near(&mut self, at_trial: bool) {
        let Some(cutoff) = self.laws.fields.near_field.as_ref().and_then(|law| law.cutoff) else { return };
        let positions = if at_trial { &self.trial.position } else { &self.grains.position };
        let skin = self.skin.of_near_field(cutoff.si());
        self.near.build(positions, &vec![0.0; self.grains.len()], cutoff.si(), skin);
    }

    /// Lists the pairs anew, at the trial or the committed positions.
    fn rebuild(&mut self, at_trial: bool, remembered: &[Remembered]) {
        let positions = if at_trial { &self.trial.position } else { &self.grains.position };
        let reach = self.laws.contact.as_ref().map_or(0.0, ContactLaws::reach);
        self.list.build(positions, &self.grains.radius, reach, self.skin.thickness());
        self.contacts.relist(&self.list, self.grains.len(), remembered, self.laws.contact.as_ref());
    }

    /// Sorts the grains along a space-filling curve; returns the order, or nothing if it is that already.
    pub fn sort_in_space(&mut self) -> Option<Vec<u32>> {
        let order = morton_order(&self.grains.position);
        if order.iter().zip(0..).all(|(a, b)| *a == b) {
            return None;
        }
        Some(self.reorder(&order))
    }

    /// Puts the grains into another order: the one at `order[k]` comes to place k. Returns the new place of each.
    pub(super) fn reorder(&mut self, order: &[u32]) -> Vec<u32> {
        let mut place = vec![0_u32; order.len()];
        for (new, &old) in order.iter().enumerate() {
            place[old as usize] = new as u32;
        }
        let mut remembered = self.contacts.remembered(&self.list);
        for (a, b, _) in &mut remembered {
            (*a, *b) = (place[*a as usize], place[*b as usize]);
        }
        self.grains.reorder(order);
        self.loads.reorder(order);
        self.ray_loads.reorder(order);
        self.inertial_mass = order.iter().map(|&at| self.inertial_mass[at as usize]).collect();
        self.network.reindex(&place);
        self.rebuild(false, &remembered);
        self.list_near(false);
        place
    }
}

/// What the grains read while they gather their loads.
struct Gather<'a> {
    grains: &'a Particles,
    laws: &'a Laws,
    network: &'a Network,
    contacts: &'a Contacts,
    near: &'a PairList,
    now: Motion<'a>,
    time: f64,
    /// What a hook adds.
    hook: Option<&'a Loads>,
}

impl Gather<'_> {
    fn leaf(&self, range: Range<usize>, views: &mut LoadViews<'_>) -> Supplies {
        let (mut supplies, mut hooked) = (Supplies::default(), Supply::default());
        let has_single = self.laws.has_single();
        for (slot, grain) in range.enumerate() {
            let (mut force, mut torque) = self.contacts.load_on(grain);
            self.network.gather(grain, &mut force, &mut torque);
            if let Some(law) = &self.laws.fields.near_field {
                let push = |other: usize| near_force(law, self.grains, self.now.position, grain, other);
                if law.cutoff.is_some() {
                    let owners = self.near.owners();
                    force += self
                        .near
                        .joined(grain)
                        .iter()
                        .map(|pair| push(owners[*pair as usize] as usize))
                        .sum();
                    force +=
                        self.near.owned(grain).map(|pair| push(self.near.partners()[pair] as usize)).sum();
                } else {
                    force += (0..self.grains.len()).filter(|other| *other != grain).map(push).sum();
                }
            }
            if has_single {
                let single = self.laws.on_single(self.grains, &self.now, grain, self.time, &mut supplies);
                force += single.force;
                torque += single.torque;
            }
            if let Some(loads) = self.hook {
                hooked = hooked + Attached::supply(loads, &self.now, grain);
                force += loads.force[grain];
                torque += loads.torque[grain];
            }
            views.force[slot] = force;
            views.torque[slot] = torque;
        }
        supplies.hook = hooked;
        supplies
    }
}
