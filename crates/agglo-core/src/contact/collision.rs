//! Collisions of two grains, integrated for the tests of the laws of contact.

use super::elastic::damped_part;
use super::friction::{FrictionLaw, Mindlin, Sliding, TangentialSpring};
use super::{ContactGeometry, Damping, Elastic, Normal, PairConstants};
use crate::math::Vec3;

/// Two grains that meet along the line of centers.
pub struct HeadOn<'a> {
    pub pair: PairConstants,
    /// The pair at touching.
    pub geometry: ContactGeometry,
    pub normal: &'a Normal,
    pub damping: Option<&'a Damping>,
    /// Speed of approach.
    pub speed: f64,
}

/// What came of it.
pub struct Rebound {
    pub restitution: f64,
    pub duration: f64,
    pub largest_overlap: f64,
    pub largest_force: f64,
}

fn elastic(law: &Normal, pair: &PairConstants, geometry: &ContactGeometry) -> Elastic {
    Elastic {
        force: law.force(pair, geometry),
        stiffness: law.tangent_stiffness(pair, geometry),
        damped_part: damped_part(law.exponent()),
    }
}

impl HeadOn<'_> {
    fn force(&self, overlap: f64, speed: f64) -> f64 {
        let geometry = ContactGeometry { overlap: overlap.max(0.0), ..self.geometry };
        let elastic = elastic(self.normal, &self.pair, &geometry);
        let dashpot = self.damping.map_or(0.0, |law| law.coefficient(&self.pair, &geometry, &elastic));
        elastic.force + dashpot * speed
    }

    /// Classical Runge-Kutta of fourth order until the overlap is back at zero.
    pub fn integrate(&self, dt: f64) -> Rebound {
        let slope =
            |overlap: f64, speed: f64| (speed, -self.force(overlap, speed) / self.geometry.effective_mass);
        let (mut overlap, mut speed, mut time) = (0.0_f64, self.speed, 0.0);
        let (mut largest_overlap, mut largest_force) = (0.0_f64, 0.0_f64);
        loop {
            let a = slope(overlap, speed);
            let b = slope(overlap + 0.5 * dt * a.0, speed + 0.5 * dt * a.1);
            let c = slope(overlap + 0.5 * dt * b.0, speed + 0.5 * dt * b.1);
            let d = slope(overlap + dt * c.0, speed + dt * c.1);
            let next = overlap + dt / 6.0 * (a.0 + 2.0 * b.0 + 2.0 * c.0 + d.0);
            let next_speed = speed + dt / 6.0 * (a.1 + 2.0 * b.1 + 2.0 * c.1 + d.1);
            if next <= 0.0 {
                let part = overlap / (overlap - next);
                return Rebound {
                    restitution: -(speed + part * (next_speed - speed)) / self.speed,
                    duration: time + part * dt,
                    largest_overlap,
                    largest_force,
                };
            }
            (overlap, speed) = (next, next_speed);
            time += dt;
            largest_overlap = largest_overlap.max(overlap);
            largest_force = largest_force.max(self.force(overlap, speed));
        }
    }
}

/// Two equal grains that meet at an angle in a plane, with rotation.
pub struct Oblique<'a> {
    pub pair: PairConstants,
    pub radius: f64,
    pub mass: f64,
    pub normal: &'a Normal,
    pub damping: Option<&'a Damping>,
    pub friction: &'a Mindlin,
}

/// State of the two grains of [`Oblique`].
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    pub positions: [Vec3; 2],
    pub velocities: [Vec3; 2],
    pub angular_velocities: [Vec3; 2],
    pub spring: TangentialSpring,
}

struct Load {
    on_i: Vec3,
    torque: Vec3,
    elastic: f64,
    spring: TangentialSpring,
}

impl Oblique<'_> {
    /// With the constants of the pair as the laws have them.
    pub fn settled(mut self) -> Self {
        if let Some(law) = self.damping {
            law.settle(&mut self.pair, None);
        }
        self.friction.settle(&mut self.pair, None);
        self
    }

    /// Two grains at touching along x; the second comes with `velocity` relative to the first.
    pub fn approach(&self, velocity: Vec3) -> Pair {
        let at = Vec3::new(self.radius, 0.0, 0.0);
        let velocities = [velocity * -0.5, velocity * 0.5];
        Pair {
            positions: [-at, at],
            velocities,
            angular_velocities: [Vec3::ZERO; 2],
            spring: TangentialSpring::default(),
        }
    }

    pub fn kinetic(&self, state: &Pair) -> f64 {
        let inertia = 0.4 * self.mass * self.radius * self.radius;
        let linear: f64 = state.velocities.iter().map(|v| v.norm_squared()).sum();
        let angular: f64 = state.angular_velocities.iter().map(|w| w.norm_squared()).sum();
        0.5 * (self.mass * linear + inertia * angular)
    }

    fn load(&self, state: &Pair, dt: f64) -> Option<Load> {
        let across = state.positions[1] - state.positions[0];
        let distance = across.norm();
        let geometry = ContactGeometry::new([self.radius; 2], [self.mass; 2], [1e9; 2], distance);
        if geometry.overlap <= 0.0 {
            return None;
        }
        let normal = across / distance;
        let relative = state.velocities[1]
            - state.velocities[0]
            - (state.angular_velocities[0] + state.angular_velocities[1]).cross(normal) * (0.5 * distance);
        let velocity = relative.rejected_from(normal);
        let elastic = elastic(self.normal, &self.pair, &geometry);
        let normal_dashpot = self.damping.map_or(0.0, |law| law.coefficient(&self.pair, &geometry, &elastic));
        let normal_force = elastic.force - normal_dashpot * relative.dot(normal);
        let sliding = Sliding {
            normal,
            displacement: velocity * dt,
            velocity,
            turn_about_normal: 0.5
                * dt
                * (state.angular_velocities[0] + state.angular_velocities[1]).dot(normal),
            elastic,
            normal_dashpot,
            normal_force,
            dt,
        };
        let (friction, spring) = self.friction.force(&self.pair, &geometry, &sliding, &state.spring);
        Some(Load {
            on_i: friction - normal * normal_force,
            torque: normal.cross(friction) * (0.5 * distance),
            elastic: self.normal.energy(&self.pair, &geometry) + spring.energy(),
            spring,
        })
    }

    /// Leapfrog until the grains part; `watch` sees (kinetic, stored) energy after every step.
    pub fn integrate(&self, mut state: Pair, dt: f64, mut watch: impl FnMut(f64, f64)) -> Pair {
        let inertia = 0.4 * self.mass * self.radius * self.radius;
        let mut load =
            Load { on_i: Vec3::ZERO, torque: Vec3::ZERO, elastic: 0.0, spring: TangentialSpring::default() };
        let kick = |state: &mut Pair, load: &Load| {
            state.velocities[0] += load.on_i * (0.5 * dt / self.mass);
            state.velocities[1] -= load.on_i * (0.5 * dt / self.mass);
            for angular_velocity in &mut state.angular_velocities {
                *angular_velocity += load.torque * (0.5 * dt / inertia);
            }
        };
        loop {
            kick(&mut state, &load);
            for k in 0..2 {
                state.positions[k] += state.velocities[k] * dt;
            }
            let Some(next) = self.load(&state, dt) else { return state };
            load = next;
            state.spring = load.spring;
            kick(&mut state, &load);
            watch(self.kinetic(&state), load.elastic);
        }
    }
}
