//! Hard spheres in memory: what the search for collisions reads often, and what only a collision needs.
//!
//! A sphere's motion is one cache line. Slots of the arrays are reused once a sphere has merged away; ids
//! are never used twice.

use serde::{Deserialize, Serialize};

use crate::domain::resolution;
use crate::engine::validate::{Fault, ensure, length};
use crate::math::Vec3;
use crate::neighbors::Places;
use crate::particles::{Particles, Row};

/// No sphere, no cell, no list.
pub const NONE: u32 = u32::MAX;

/// The motion of a sphere: where it was at its own time, and how fast it flies since.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[repr(C, align(64))]
pub struct Sphere {
    /// Center at `time` [m].
    pub position: Vec3,
    /// Velocity [m/s].
    pub velocity: Vec3,
    /// Time that `position` is about [s].
    pub time: f64,
    /// Radius [m].
    pub radius: f64,
}

impl Sphere {
    /// Center [m] at a time [s].
    #[inline]
    pub fn at(&self, time: f64) -> Vec3 {
        self.position + self.velocity * (time - self.time)
    }

    /// What its position at a time [s] is rounded to [m]: coordinates and the clock have 53 binary digits.
    #[inline]
    pub fn rounding(&self, time: f64) -> f64 {
        resolution::spacing(self.at(time)) + f64::EPSILON * self.velocity.norm() * time
    }
}

/// What else a sphere is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bulk {
    /// Mass [kg].
    pub mass: f64,
    /// Heat capacity of the whole sphere [J/K].
    pub heat_capacity: f64,
    /// Temperature [K] at `heated_at`.
    pub temperature: f64,
    /// Time that `temperature` is about [s].
    pub heated_at: f64,
    /// Time of the last bounce [s]; minus infinity before the first.
    pub bounced_at: f64,
    /// Its id, which no other sphere ever has.
    pub id: u32,
    /// Number of the material.
    pub material: u32,
    /// How many primary grains it is made of; 0 where the slot is empty.
    pub primaries: u32,
}

impl Bulk {
    const EMPTY: Self = Self {
        mass: 0.0,
        heat_capacity: 0.0,
        temperature: 0.0,
        heated_at: 0.0,
        bounced_at: f64::NEG_INFINITY,
        id: u32::MAX,
        material: 0,
        primaries: 0,
    };

    /// Whether there is a sphere at all.
    #[inline]
    pub fn lives(&self) -> bool {
        self.primaries > 0
    }
}

/// All spheres, by their index in memory.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spheres {
    /// Motions [slots].
    pub motion: Vec<Sphere>,
    /// The rest [slots].
    pub bulk: Vec<Bulk>,
    free: Vec<u32>,
    next_id: u32,
}

impl Places for Spheres {
    fn slots(&self) -> usize {
        self.slots()
    }

    fn indices(&self) -> impl Iterator<Item = u32> + '_ {
        self.living()
    }

    #[inline]
    fn position(&self, at: u32) -> Vec3 {
        self.motion[at as usize].position
    }

    #[inline]
    fn radius(&self, at: u32) -> f64 {
        self.motion[at as usize].radius
    }
}

impl Spheres {
    /// Whether they are ones that a run with so many materials can have come to by `time` [s].
    ///
    /// # Errors
    /// What is wrong with them.
    pub(super) fn validate(&self, materials: usize, time: f64) -> Result<(), Fault> {
        length("spheres", self.bulk.len(), self.motion.len())?;
        ensure(!self.motion.is_empty() && self.motion.len() < NONE as usize, || {
            "there are no spheres".to_owned()
        })?;
        let mut names = Vec::new();
        for (motion, bulk) in self.motion.iter().zip(&self.bulk).filter(|(_, bulk)| bulk.lives()) {
            let vectors = motion.position.is_finite() && motion.velocity.is_finite();
            let sizes = [motion.radius, bulk.mass].iter().all(|value| value.is_finite() && *value > 0.0);
            let heat =
                [bulk.heat_capacity, bulk.temperature].iter().all(|value| value.is_finite() && *value >= 0.0);
            let past = [motion.time, bulk.heated_at].iter().all(|at| (0.0..=time).contains(at));
            let bounced = bulk.bounced_at <= time;
            let known = (bulk.material as usize) < materials && bulk.id < self.next_id;
            ensure(vectors && sizes && heat && past && bounced && known, || {
                format!("grain {} is none", bulk.id)
            })?;
            names.push(bulk.id);
        }
        names.sort_unstable();
        ensure(!names.is_empty(), || "no grain is left".to_owned())?;
        ensure(names.windows(2).all(|pair| pair[0] != pair[1]), || "a grain is there twice".to_owned())?;
        ensure(self.next_id < NONE - (1 << 24), || "the names are used up".to_owned())?;
        let mut free = self.free.clone();
        free.sort_unstable();
        let empty = (0_u32..).zip(&self.bulk).filter(|(_, bulk)| !bulk.lives()).map(|(at, _)| at);
        ensure(empty.eq(free), || "the list of free slots is another".to_owned())
    }

    /// Takes grains at time zero; `heat_capacity` gives that of a material [J/(kg K)] by its number.
    pub fn new(grains: &Particles, heat_capacity: impl Fn(u32) -> f64) -> Self {
        let mut spheres = Self {
            motion: Vec::with_capacity(grains.len()),
            bulk: Vec::with_capacity(grains.len()),
            free: Vec::new(),
            next_id: grains.id.iter().max().map_or(0, |last| last + 1),
        };
        for at in 0..grains.len() {
            let (mass, material) = (grains.mass[at], grains.material[at]);
            spheres.motion.push(Sphere {
                position: grains.position[at],
                velocity: grains.velocity[at],
                time: 0.0,
                radius: grains.radius[at],
            });
            spheres.bulk.push(Bulk {
                mass,
                heat_capacity: mass * heat_capacity(material),
                temperature: grains.temperature[at],
                id: grains.id[at],
                material,
                primaries: 1,
                ..Bulk::EMPTY
            });
        }
        spheres
    }

    /// Slots in memory, empty ones included.
    pub fn slots(&self) -> usize {
        self.motion.len()
    }

    /// How many spheres there are.
    pub fn len(&self) -> usize {
        self.motion.len() - self.free.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Indices of the spheres, in the order of memory.
    pub fn living(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.slots() as u32).filter(|&at| self.bulk[at as usize].lives())
    }

    /// An id that was never used.
    pub fn new_id(&mut self) -> u32 {
        self.next_id += 1;
        self.next_id - 1
    }

    /// Takes a sphere away.
    pub fn remove(&mut self, at: u32) {
        self.bulk[at as usize] = Bulk::EMPTY;
        self.free.push(at);
    }

    /// Puts a sphere into an empty slot and gives its index.
    pub fn insert(&mut self, motion: Sphere, bulk: Bulk) -> u32 {
        if let Some(at) = self.free.pop() {
            self.motion[at as usize] = motion;
            self.bulk[at as usize] = bulk;
            return at;
        }
        self.motion.push(motion);
        self.bulk.push(bulk);
        (self.motion.len() - 1) as u32
    }

    /// Puts the spheres into another order and drops empty slots: the one at `order[k]` comes to index k.
    pub fn reorder(&mut self, order: &[u32]) {
        self.motion = order.iter().map(|&at| self.motion[at as usize]).collect();
        self.bulk = order.iter().map(|&at| self.bulk[at as usize]).collect();
        self.free.clear();
    }

    /// A sphere as a row of the columns, at a time [s]; its temperature is the one at its last heating.
    pub fn row(&self, at: u32, time: f64) -> Row {
        let (motion, bulk) = (&self.motion[at as usize], &self.bulk[at as usize]);
        Row {
            id: bulk.id,
            position: motion.at(time),
            velocity: motion.velocity,
            radius: motion.radius,
            mass: bulk.mass,
            material: bulk.material,
            temperature: bulk.temperature,
            polarity: 1.0,
            ..Row::default()
        }
    }

    /// Indices in the order of ids.
    pub fn by_id(&self) -> Vec<u32> {
        // Id and index in one number: sorting then looks nowhere else.
        let key = |at: u32| u64::from(self.bulk[at as usize].id) << 32 | u64::from(at);
        let mut keys: Vec<u64> = self.living().map(key).collect();
        keys.sort_unstable();
        keys.into_iter().map(|key| key as u32).collect()
    }
}
