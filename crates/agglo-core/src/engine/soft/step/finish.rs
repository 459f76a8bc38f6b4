//! The end of a Verlet step: loads at the motion that was foreseen correct its velocities.
//!
//! Where the grains are free to fly on, the same pass over them begins the next step: their state then stays in the records
//! that it is computed from, and its columns are left behind until someone looks.

use std::ops::Range;

use crate::contact::pass::Record;
use crate::domain::{Image, Space};
use crate::engine::soft::forces::gather::{Gather, Gathered};
use crate::engine::soft::forces::loads::{LoadViews, Loads};
use crate::engine::soft::system::{System, bring_home};
use crate::ledger::{Correction, Rates};
use crate::math::Vec3;
use crate::math::parallel::BLOCK;
use crate::particles::Particles;

use super::change::{Afloat, Change};

/// Positions, velocities and angular velocities.
type Columns<'a> = (&'a mut [Vec3], &'a mut [Vec3], &'a mut [Vec3]);

/// Images of the grains, where space repeats itself.
type Images<'a> = Option<&'a mut [Image]>;

/// What the end of a step changes.
type Finished<'a> = (Columns<'a>, LoadViews<'a>, Images<'a>);

fn across<'a>(space: &Space, images: &'a mut [Image]) -> Images<'a> {
    space.repeats().then_some(images)
}

/// The end of a step, for one grain after the other.
struct Ending<'a> {
    gather: Gather<'a>,
    /// Loads of rays, and the factor from them to forces.
    rays: Option<(&'a Loads, f64)>,
    dt: f64,
}

impl Ending<'_> {
    fn with_rays(&self, grain: usize, (force, torque): (Vec3, Vec3)) -> (Vec3, Vec3) {
        match self.rays {
            Some((loads, scale)) => {
                (force + loads.force[grain] * scale, torque + loads.torque[grain] * scale)
            }
            None => (force, torque),
        }
    }

    /// Velocity [m/s] and angular velocity [rad/s] at the end, from those at the start, the changes that the loads there
    /// foresaw, and the loads [N, N m] at the end: the mean of both.
    #[inline(always)]
    fn corrected(&self, grain: usize, record: &Record, loads: (Vec3, Vec3)) -> (Vec3, Vec3) {
        let ((_, velocity, spin), (kick, twist)) = (record.before(), record.changes());
        let (force, torque) = self.with_rays(grain, loads);
        let [per_mass, per_inertia] = record.inverses().map(|inverse| self.dt * inverse);
        (velocity + (kick + force * per_mass) * 0.5, spin + (twist + torque * per_inertia) * 0.5)
    }

    /// The same where loads answer to velocity and are solved for; they are brought along, and `start` has those of the start.
    fn solved(
        &self,
        grain: usize,
        record: &Record,
        start: (Vec3, Vec3),
        end: &mut (Vec3, Vec3),
        correction: &mut Correction,
    ) -> (Vec3, Vec3) {
        let Gather { laws, grains, time, .. } = self.gather;
        let ((place, velocity, spin), now) = (record.before(), record.now());
        let [per_mass, per_inertia] = record.inverses().map(|inverse| self.dt * inverse);
        let (force, torque) = self.with_rays(grain, ((end.0 + start.0) * 0.5, (end.1 + start.1) * 0.5));
        let explicit = (velocity + force * per_mass, spin + torque * per_inertia);
        let response = laws.response(grains, grain, (now.0, now.1), time);
        let solved = response.solved(explicit, (now.1, now.2), (0.5 * per_mass, 0.5 * per_inertia));
        solved.correct(end, now.0, correction);
        let flow = laws.flow_change([(place, time - self.dt), (now.0, time)]);
        let change = (solved.velocity - velocity, solved.angular_velocity - spin);
        correction.bend += response.bend(change, flow);
        (solved.velocity, solved.angular_velocity)
    }
}

impl System {
    /// Ends the step of `dt` [s] that leads to `time` [s]: loads are gathered, velocities corrected, and the columns of the grains
    /// are where it led.
    pub(in crate::engine::soft) fn finish(&mut self, time: f64, dt: f64) {
        let mut moving = self.take_motion();
        let ray_scale = self.ray_scale(dt);
        let Self {
            grains,
            laws,
            network,
            contacts,
            walls,
            near,
            trial,
            hook,
            loads,
            ray_loads,
            records,
            domain,
            ..
        } = self;
        let (space, images) = (&self.space, across(&self.space, &mut self.images));
        let has_response = laws.has_response();
        let rays = ray_scale.map(|scale| (&*ray_loads, scale));
        let hook = hook.as_ref().map(|hook| &hook.loads);
        let positions = &trial.position[..];
        let gather = Gather { grains, laws, network, contacts, walls, near, positions, space, time, hook };
        let ending = Ending { gather, rays, dt };
        let leaf = |range: Range<usize>, ((r, v, w), loads, mut images): Finished<'_>| {
            let (mut sums, mut correction) = (Gathered::default(), Correction::default());
            for (slot, grain) in range.enumerate() {
                let record = &records[grain];
                let now = record.now();
                let mut end = ending.gather.on(grain, now, &mut sums);
                r[slot] = now.0;
                if let Some(images) = &mut images {
                    bring_home(space, &mut r[slot], &mut images[slot]);
                }
                (v[slot], w[slot]) = if has_response {
                    let start = (loads.force[slot], loads.torque[slot]);
                    ending.solved(grain, record, start, &mut end, &mut correction)
                } else {
                    ending.corrected(grain, record, end)
                };
                (loads.force[slot], loads.torque[slot]) = end;
            }
            (sums, correction)
        };
        let columns = (&mut moving.0[..], &mut moving.1[..], &mut moving.2[..]);
        let join = |a: (Gathered, Correction), b: (Gathered, Correction)| (a.0 + b.0, a.1 + b.1);
        let (sums, correction) =
            domain.over(0..records.len(), BLOCK, (columns, loads.views(), images), &leaf, &join);
        for column in [&mut moving.0, &mut moving.1, &mut moving.2, &mut loads.force, &mut loads.torque] {
            domain.share_grains(column);
        }
        domain.share_grains(&mut self.images);
        trial.rates = Rates::new(&trial.contact, sums.bonds, sums.supplies.with_walls(walls.supply()));
        trial.rates.correct(correction);
        self.put_motion(moving);
        self.afloat = None;
    }

    /// Ends the step of `dt` [s] that leads to `time` [s], and begins one of `next` [s] in the same pass; the columns of the grains
    /// stay behind. Only where [`System::flies_freely`].
    pub(in crate::engine::soft) fn fly_on(&mut self, time: f64, dt: f64, next: f64) {
        // Grains come home in space as it is now, and move on to as it will be.
        let space = self.space;
        let stretch = self.move_space(time, time + next);
        let Self { grains, laws, network, contacts, walls, near, trial, records, domain, .. } = self;
        let (space, images) = (&space, across(&space, &mut self.images));
        let (positions, hook) = (&[][..], None);
        let gather = Gather { grains, laws, network, contacts, walls, near, positions, space, time, hook };
        let ending = Ending { gather, rays: None, dt };
        let leaf = |range: Range<usize>, (records, mut images): (&mut [Record], Images<'_>)| {
            let (mut sums, mut change) = (Gathered::default(), Change::default());
            for (slot, (record, grain)) in records.iter_mut().zip(range).enumerate() {
                let mut now = record.now();
                let end = ending.gather.on(grain, now, &mut sums);
                let (velocity, spin) = ending.corrected(grain, record, end);
                if let Some(images) = &mut images {
                    bring_home(space, &mut now.0, &mut images[slot]);
                    record.shift_to(now.0);
                }
                record.begin(now.0, velocity, spin);
                let [per_mass, per_inertia] = record.inverses().map(|inverse| next * inverse);
                let changes = (end.0 * per_mass, end.1 * per_inertia);
                change.note_move(grain, record, (next, 0.5, stretch), changes);
            }
            (sums, change)
        };
        let join = |a: (Gathered, Change), b: (Gathered, Change)| (a.0 + b.0, Change::join(a.1, b.1));
        let n = grains.len();
        let (sums, change) = domain.over(0..n, BLOCK, (&mut records[..], images), &leaf, &join);
        domain.share_grains(records);
        domain.share_grains(&mut self.images);
        trial.rates = Rates::new(&trial.contact, sums.bonds, sums.supplies.with_walls(walls.supply()));
        self.note_way(change.wavering);
        self.afloat = Some(Afloat { dt: next, change });
    }

    /// Whether nothing but contacts and forces on single grains acts, none of which answers to velocity: nobody looks at the columns
    /// of the grains in a step then.
    pub(in crate::engine::soft) fn flies_freely(&self) -> bool {
        self.hook.is_none()
            && !self.network.is_active()
            && !self.has_ray_loads
            && !self.laws.has_response()
            && self.laws.fields.near_field.is_none()
    }

    /// Puts the grains back to the start of a step that is not taken, if their state is in the records.
    pub(in crate::engine::soft) fn fall_back(&mut self) {
        let Some(afloat) = self.afloat.take() else { return };
        let Self { grains, records, loads, .. } = self;
        for (at, record) in records.iter().enumerate() {
            (grains.position[at], grains.velocity[at], grains.angular_velocity[at]) = record.before();
            let ((kick, twist), [per_mass, per_inertia]) = (record.changes(), record.inverses());
            loads.force[at] = kick * (1.0 / (afloat.dt * per_mass));
            loads.torque[at] = twist * (1.0 / (afloat.dt * per_inertia));
        }
    }

    /// The columns that a step changes, out of the way of those that it reads.
    fn take_motion(&mut self) -> Motions {
        let Particles { position, velocity, angular_velocity, .. } = &mut self.grains;
        (std::mem::take(position), std::mem::take(velocity), std::mem::take(angular_velocity))
    }

    fn put_motion(&mut self, moving: Motions) {
        let Particles { position, velocity, angular_velocity, .. } = &mut self.grains;
        (*position, *velocity, *angular_velocity) = moving;
    }
}

/// Positions [m], velocities [m/s] and angular velocities [rad/s].
type Motions = (Vec<Vec3>, Vec<Vec3>, Vec<Vec3>);
