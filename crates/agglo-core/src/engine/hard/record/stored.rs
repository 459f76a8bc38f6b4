//! Energy and momentum of hard spheres, for the ledger.

use crate::engine::hard::spheres::Spheres;
use crate::ledger::{Momentum, Opening, Stored};
use crate::math::Vec3;

/// What spheres have at the start.
pub fn opening(spheres: &Spheres) -> Opening {
    let momentum_size = |at: u32| {
        let (motion, bulk) = (&spheres.motion[at as usize], &spheres.bulk[at as usize]);
        bulk.mass * motion.velocity.norm()
    };
    let order = spheres.by_id();
    Opening {
        stored: stored(spheres, &order, |at| spheres.bulk[at as usize].temperature),
        momentum: Momentum { linear: momentum(spheres, &order), angular: Vec3::ZERO },
        momentum_size: order.iter().map(|&at| momentum_size(at)).sum(),
        mass: order.iter().map(|&at| spheres.bulk[at as usize].mass).sum(),
    }
}

/// Energies of spheres [J], summed in `order`; `temperature` gives that of the sphere of an index.
pub fn stored(spheres: &Spheres, order: &[u32], mut temperature: impl FnMut(u32) -> f64) -> Stored {
    let mut stored = Stored::default();
    for &at in order {
        let (motion, bulk) = (&spheres.motion[at as usize], &spheres.bulk[at as usize]);
        stored.kinetic += 0.5 * bulk.mass * motion.velocity.norm_squared();
        stored.thermal += bulk.heat_capacity * temperature(at);
    }
    stored
}

/// Momentum of spheres [kg m/s], summed in `order`.
pub fn momentum(spheres: &Spheres, order: &[u32]) -> Vec3 {
    let of = |at: u32| spheres.motion[at as usize].velocity * spheres.bulk[at as usize].mass;
    order.iter().fold(Vec3::ZERO, |sum, &at| sum + of(at))
}
