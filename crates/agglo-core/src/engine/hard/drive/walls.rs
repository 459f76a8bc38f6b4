//! Smooth hard walls around hard spheres that move step by step.

use crate::domain::Volume;
use crate::engine::hard::collide::HardSystem;
use crate::engine::hard::spheres::Spheres;

/// Time until the first sphere's surface gets to a wall [s].
pub(super) fn time_left(spheres: &Spheres, volume: &Volume) -> f64 {
    let (lower, upper) = (volume.lower(), volume.lower() + volume.edges());
    let mut shortest = f64::INFINITY;
    for at in spheres.living() {
        let sphere = &spheres.motion[at as usize];
        for axis in 0..3 {
            let (along, speed) = (sphere.position[axis], sphere.velocity[axis]);
            let way = if speed > 0.0 { upper[axis] - along } else { along - lower[axis] } - sphere.radius;
            if speed != 0.0 {
                shortest = shortest.min(way.max(0.0) / speed.abs());
            }
        }
    }
    shortest
}

/// Turns a sphere round that got to a wall within the last `dt` [s], at most once along each axis.
pub(super) fn reflect(system: &mut HardSystem, at: usize, dt: f64, time: f64) {
    let (lower, upper) = (system.volume.lower(), system.volume.lower() + system.volume.edges());
    for axis in 0..3 {
        let motion = &mut system.state.spheres.motion[at];
        let (along, speed) = (motion.position[axis], motion.velocity[axis]);
        let beyond = if speed > 0.0 {
            along + motion.radius - upper[axis]
        } else {
            lower[axis] + motion.radius - along
        };
        if beyond >= 0.0 && speed != 0.0 {
            // It flies back what it flew too far. One that had grown into the wall only turns round.
            let mut position = motion.position.to_array();
            position[axis] -= 2.0 * beyond.min(speed.abs() * dt).copysign(speed);
            motion.position = position.into();
            system.bounce_off_wall(at as u32, axis, time);
        }
    }
}
