//! The one loop over pairs: which touch, or are within the reach of a law, and what the contact laws make of it.
//!
//! Each touching pair is computed once. Its load stands at the pair's number until the grains gather theirs, in a
//! fixed order. Memory of contacts (tangential springs) is committed only when a step is accepted, so a step can
//! be tried again.

use std::ops::Range;

use super::bond::{Bonds, StrainBond};
use super::friction::{Sliding, TangentialSpring};
use super::{ContactGeometry, ContactLaws, PairConstants, PairTable, lever_arms};
use crate::math::{Pace, Vec3, parallel};
use crate::neighbors::PairList;
use crate::particles::{Motion, Particles};

/// Owners per leaf of the parallel loop.
const LEAF: usize = 1024;

/// Force and torques of one contact.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContactLoad {
    /// Force on the owner [N]; on the partner the opposite.
    pub force: Vec3,
    /// Moment per arm [N]: n x F_t, the same for both grains.
    pub couple: Vec3,
    /// Distances from the two centers to the contact [m]: owner's and partner's.
    pub lever_arms: [f64; 2],
}

/// What one pass over the contacts adds up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactRates {
    /// Power lost in normal dashpots [W].
    pub damping: f64,
    /// Power that a formula of contact puts in where it drives grains [W].
    pub driven: f64,
    /// Power that tangential forces take from the motion [W].
    pub tangential: f64,
    /// Largest overlap over the sum of radii, with the pair's grains.
    pub worst_strain: f64,
    /// The grains of that pair.
    pub worst_pair: [u32; 2],
}

impl ContactRates {
    fn join(a: Self, b: Self) -> Self {
        let worst = if b.worst_strain > a.worst_strain { b } else { a };
        Self {
            damping: a.damping + b.damping,
            driven: a.driven + b.driven,
            tangential: a.tangential + b.tangential,
            ..worst
        }
    }
}

/// Loads and memory of all candidate pairs.
#[derive(Debug, Default)]
pub struct Contacts {
    loads: Vec<ContactLoad>,
    committed: Memory,
    trial: Memory,
    /// Committed contacts of pairs that the list left out because a try, not yet accepted, has parted them.
    parted: Vec<Remembered>,
}

/// What contacts remember, by the pair's number.
#[derive(Debug, Default)]
struct Memory {
    touching: Vec<bool>,
    springs: Vec<TangentialSpring>,
}

impl Memory {
    fn resize(&mut self, pairs: usize, with_springs: bool) {
        self.touching.clear();
        self.touching.resize(pairs, false);
        self.springs.clear();
        self.springs.resize(if with_springs { pairs } else { 0 }, TangentialSpring::default());
    }
}

/// One remembered contact, named by its grains: for checkpoints and for lists that are built anew.
pub type Remembered = (u32, u32, TangentialSpring);

/// What a pass needs to know besides the pairs.
pub struct ContactWorld<'a> {
    /// The grains' constant columns.
    pub grains: &'a Particles,
    /// Laws of contact, if any.
    pub laws: Option<&'a ContactLaws>,
    /// Bond law, of which only the one that acts in contact concerns this pass.
    pub bonds: Option<&'a Bonds>,
    /// Constants of pairs of materials.
    pub pairs: &'a PairTable,
    /// Candidate pairs.
    pub list: &'a PairList,
    /// Motion at the start of the step.
    pub before: Motion<'a>,
    /// Motion at which forces are wanted.
    pub now: Motion<'a>,
    /// Time between the two [s]: the step, or zero before the first.
    pub elapsed: f64,
    /// Length of the step [s], for laws that carry it.
    pub dt: f64,
}

impl ContactWorld<'_> {
    /// How far beyond touching the laws act [m].
    fn beyond(&self) -> f64 {
        self.laws.map_or(0.0, ContactLaws::reach)
    }
}

struct Slot<'a> {
    loads: &'a mut [ContactLoad],
    touching: &'a mut [bool],
    springs: &'a mut [TangentialSpring],
    starts: &'a [u32],
}

impl parallel::Split for Slot<'_> {
    fn split(self, range: &Range<usize>, at: usize) -> (Self, Self) {
        let cut = (self.starts[at] - self.starts[range.start]) as usize;
        let (loads, loads_after) = self.loads.split_at_mut(cut);
        let (touching, touching_after) = self.touching.split_at_mut(cut);
        let (springs, springs_after) = self.springs.split_at_mut(cut.min(self.springs.len()));
        (
            Self { loads, touching, springs, starts: self.starts },
            Self {
                loads: loads_after,
                touching: touching_after,
                springs: springs_after,
                starts: self.starts,
            },
        )
    }
}

impl Contacts {
    /// Makes room for the pairs of a new list and puts the remembered contacts in their new places.
    pub fn relist(&mut self, list: &PairList, remembered: &[Remembered], laws: Option<&ContactLaws>) {
        let with_springs = laws.is_some_and(ContactLaws::has_memory);
        self.loads.clear();
        self.loads.resize(list.len(), ContactLoad::default());
        self.committed.resize(list.len(), with_springs);
        self.trial.resize(list.len(), with_springs);
        self.parted.clear();
        for (a, b, spring) in remembered {
            let mirrored = TangentialSpring { force: -spring.force, ..*spring };
            let place = list.find(*a, *b).map(|pair| (pair, *spring));
            if let Some((pair, spring)) = place.or_else(|| list.find(*b, *a).map(|pair| (pair, mirrored))) {
                self.committed.touching[pair] = true;
                if with_springs {
                    self.committed.springs[pair] = spring;
                }
            } else {
                self.parted.push((*a, *b, *spring));
            }
        }
    }

    /// The committed contacts with their memory.
    pub fn remembered(&self, list: &PairList) -> Vec<Remembered> {
        let spring = |pair: usize| self.committed.springs.get(pair).copied().unwrap_or_default();
        let touching =
            list.pairs().zip(&self.committed.touching).enumerate().filter(|(_, (_, touching))| **touching);
        let listed = touching.map(|(pair, ((a, b), _))| (a, b, spring(pair)));
        listed.chain(self.parted.iter().copied()).collect()
    }

    /// Keeps the memory of the last pass.
    pub fn commit(&mut self) {
        std::mem::swap(&mut self.committed, &mut self.trial);
        self.parted.clear();
    }

    /// Keeps the memory of a pass over which no time went by: contacts that slid before still slide, though nothing moved.
    pub fn commit_unmoved(&mut self) {
        for (pair, spring) in self.trial.springs.iter_mut().enumerate() {
            spring.sliding |= self.committed.touching[pair] && self.committed.springs[pair].sliding;
        }
        self.commit();
    }

    /// Whether a pair touched in the last pass, and its load.
    #[inline]
    pub fn load(&self, pair: usize) -> Option<&ContactLoad> {
        if self.trial.touching[pair] { Some(&self.loads[pair]) } else { None }
    }

    /// Energy [J] of the committed tangential springs.
    pub fn spring_energy(&self) -> f64 {
        let springs = self.committed.springs.iter().zip(&self.committed.touching);
        springs.filter(|(_, touching)| **touching).map(|(spring, _)| spring.energy()).fold(0.0, |a, b| a + b)
    }

    /// Computes the loads of all touching pairs.
    pub fn compute(&mut self, world: &ContactWorld<'_>) -> ContactRates {
        let owners = world.now.position.len();
        let slot = Slot {
            loads: &mut self.loads,
            touching: &mut self.trial.touching,
            springs: &mut self.trial.springs,
            starts: world.list.starts(),
        };
        let committed = &self.committed;
        parallel::over(
            0..owners,
            LEAF,
            slot,
            &|range, mut slot| compute_owners(world, committed, range, &mut slot),
            &ContactRates::join,
        )
    }
}

fn compute_owners(
    world: &ContactWorld<'_>,
    committed: &Memory,
    range: Range<usize>,
    slot: &mut Slot<'_>,
) -> ContactRates {
    let mut rates = ContactRates::default();
    let grains = world.grains;
    let base = world.list.starts()[range.start] as usize;
    let beyond = world.beyond();
    for owner in range {
        let (at, radius) = (world.now.position[owner], grains.radius[owner]);
        for pair in world.list.owned(owner) {
            let partner = world.list.partners()[pair] as usize;
            let apart = world.now.position[partner] - at;
            let reach = radius + grains.radius[partner] + beyond;
            let squared = apart.norm_squared();
            let touching = squared < reach * reach;
            let here = pair - base;
            slot.touching[here] = touching;
            if touching {
                let contact = Contact::new(world, [owner, partner], apart, squared.sqrt());
                let was = committed.touching[pair].then(|| committed.springs.get(pair)).flatten();
                let (load, spring) = contact.load(world, was, &mut rates);
                slot.loads[here] = load;
                if let Some(place) = slot.springs.get_mut(here) {
                    *place = spring;
                }
            }
        }
    }
    rates
}

/// One touching pair.
struct Contact<'a> {
    grains: [usize; 2],
    constants: &'a PairConstants,
    geometry: ContactGeometry,
    normal: Vec3,
    lever_arms: [f64; 2],
}

impl<'a> Contact<'a> {
    #[inline]
    fn new(world: &'a ContactWorld<'_>, grains: [usize; 2], apart: Vec3, distance: f64) -> Self {
        let [i, j] = grains;
        let columns = world.grains;
        let radii = grains.map(|k| columns.radius[k]);
        let geometry = ContactGeometry::new(
            radii,
            grains.map(|k| columns.mass[k]),
            grains.map(|k| columns.contact_stiffness[k]),
            distance,
        );
        // Two centers in one point have no normal; any will do, since the next step parts them.
        let normal = if distance > 0.0 { apart * (1.0 / distance) } else { Vec3::AXES[0] };

        Self {
            grains,
            constants: world.pairs.of(columns.material[i], columns.material[j]),
            geometry,
            normal,
            lever_arms: if distance > 0.0 { lever_arms(radii, distance) } else { [0.0; 2] },
        }
    }

    /// The bond that acts in contact.
    #[inline]
    fn bond<'b>(&self, world: &'b ContactWorld<'_>) -> Option<&'b StrainBond> {
        world.bonds.and_then(Bonds::in_contact).filter(|_| self.geometry.overlap > 0.0)
    }

    /// Velocity [m/s] of the partner's surface relative to the owner's at the contact.
    #[inline]
    fn relative_velocity(&self, motion: &Motion<'_>) -> Vec3 {
        let [i, j] = self.grains;
        let rolling =
            motion.angular_velocity[i] * self.lever_arms[0] + motion.angular_velocity[j] * self.lever_arms[1];
        motion.velocity[j] - motion.velocity[i] - rolling.cross(self.normal)
    }

    /// Angle [rad] by which the pair turned about its normal over the step.
    #[inline]
    fn turn_about_normal(&self, world: &ContactWorld<'_>) -> f64 {
        let [i, j] = self.grains;
        let angular_velocities = world.before.angular_velocity[i]
            + world.before.angular_velocity[j]
            + world.now.angular_velocity[i]
            + world.now.angular_velocity[j];
        angular_velocities.dot(self.normal) * (0.25 * world.elapsed)
    }

    #[inline]
    fn load(
        &self,
        world: &ContactWorld<'_>,
        before: Option<&TangentialSpring>,
        rates: &mut ContactRates,
    ) -> (ContactLoad, TangentialSpring) {
        let Self { constants, geometry, normal, .. } = self;
        let velocity = self.relative_velocity(&world.now);
        let separation = velocity.dot(*normal);
        let slip = velocity - *normal * separation;
        let (mut repulsion, mut tangential, mut spring) = (0.0, Vec3::ZERO, TangentialSpring::default());
        let is_touching = geometry.overlap > 0.0;
        if let Some(laws) = world.laws {
            let along = laws.along(constants, geometry, separation);
            repulsion = along.repulsion;
            rates.damping += along.dissipation;
            rates.driven += along.driven;
            if let Some(law) = laws.friction.as_ref().filter(|_| is_touching) {
                let way = if law.has_memory() { self.way(world, slip) } else { Sliding::default() };
                let sliding = Sliding {
                    normal: *normal,
                    velocity: slip,
                    elastic: along.elastic,
                    normal_dashpot: along.dashpot,
                    normal_force: repulsion,
                    dt: world.dt,
                    ..way
                };
                let nothing = TangentialSpring::default();
                (tangential, spring) = law.force(constants, geometry, &sliding, before.unwrap_or(&nothing));
            }
        }
        if let Some(bond) = self.bond(world) {
            repulsion -= bond.attraction(geometry);
            tangential += self.strain_bond_slip(bond, slip, world.dt);
        }
        rates.tangential += tangential.dot(slip);
        let strain = geometry.strain();
        if strain > rates.worst_strain {
            rates.worst_strain = strain;
            rates.worst_pair = self.grains.map(|k| k as u32);
        }
        let load = ContactLoad {
            force: tangential - *normal * repulsion,
            couple: normal.cross(tangential),
            lever_arms: self.lever_arms,
        };
        (load, spring)
    }

    /// How the surfaces have moved over the step, for laws with a memory.
    #[inline]
    fn way(&self, world: &ContactWorld<'_>, slip: Vec3) -> Sliding {
        let slip_before = self.relative_velocity(&world.before).rejected_from(self.normal);
        let displacement = (slip_before + slip) * (0.5 * world.elapsed);
        Sliding { displacement, turn_about_normal: self.turn_about_normal(world), ..Sliding::default() }
    }

    #[inline]
    fn strain_bond_slip(&self, bond: &StrainBond, slip: Vec3, dt: f64) -> Vec3 {
        let speed = slip.norm();
        if speed > 0.0 { slip * (bond.tangential(&self.geometry, speed, dt) / speed) } else { Vec3::ZERO }
    }
}

/// Energies of all touching pairs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactEnergy {
    /// Elastic energy of normal contact [J].
    pub normal: f64,
    /// Energy of bonds that act in contact [J], negative where they attract.
    pub bond: f64,
}

/// Goes through all pairs on which laws act at the present positions and joins what `look` makes of each.
fn over_contacts<R: Send + Sync + Copy>(
    world: &ContactWorld<'_>,
    nothing: R,
    look: impl Fn(&Contact<'_>) -> R + Sync,
    join: impl Fn(R, R) -> R + Sync,
) -> R {
    let owners = world.now.position.len();
    let beyond = world.beyond();
    let leaf = |range: Range<usize>, ()| {
        let mut found = nothing;
        for owner in range {
            for pair in world.list.owned(owner) {
                let partner = world.list.partners()[pair] as usize;
                let apart = world.now.position[partner] - world.now.position[owner];
                let reach = world.grains.radius[owner] + world.grains.radius[partner] + beyond;
                if apart.norm_squared() < reach * reach {
                    found = join(found, look(&Contact::new(world, [owner, partner], apart, apart.norm())));
                }
            }
        }
        found
    };
    parallel::over(0..owners, LEAF, (), &leaf, &join)
}

/// Adds up the normal energies at the present positions; for records, not for steps.
pub fn contact_energy(world: &ContactWorld<'_>) -> ContactEnergy {
    let energy = |contact: &Contact<'_>| ContactEnergy {
        normal: world.laws.map_or(0.0, |laws| laws.energy(contact.constants, &contact.geometry)),
        bond: contact.bond(world).map_or(0.0, |bond| bond.energy(&contact.geometry)),
    };
    let sum = |a: ContactEnergy, b: ContactEnergy| ContactEnergy {
        normal: a.normal + b.normal,
        bond: a.bond + b.bond,
    };
    over_contacts(world, ContactEnergy::default(), energy, sum)
}

/// How fast the fastest of all touching pairs is at the present positions.
pub fn contact_pace(world: &ContactWorld<'_>) -> Pace {
    let pace = |contact: &Contact<'_>| {
        let speed = -contact.relative_velocity(&world.now).dot(contact.normal);
        let pace = |laws: &ContactLaws| laws.pace_at(contact.constants, &contact.geometry, speed);
        let laws = world.laws.map_or(Pace::NONE, pace);
        match contact.bond(world) {
            Some(bond) => laws + bond.pace(&contact.geometry),
            None => laws,
        }
    };
    over_contacts(world, Pace::NONE, pace, Pace::max)
}
