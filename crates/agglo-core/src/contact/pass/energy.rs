//! Energies and paces of all touching pairs, for records and for the choice of a step.

use std::ops::Range;

use super::touch::Touch;
use super::world::Snapshot;
use crate::contact::{ContactLaws, PairConstants};
use crate::math::parallel::{self, BLOCK};
use crate::math::{Pace, Vec3};

/// Energies of all touching pairs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactEnergy {
    /// Elastic energy of normal contact [J].
    pub normal: f64,
    /// Energy of bonds that act in contact [J], negative where they attract.
    pub bond: f64,
}

/// One touching pair.
struct Contact<'a> {
    grains: [usize; 2],
    touch: Touch<f64>,
    constants: &'a PairConstants,
    /// Rate at which the overlap grows [m/s].
    approach: f64,
}

impl<'a> Contact<'a> {
    fn new(snapshot: &'a Snapshot<'_>, [i, j]: [usize; 2], apart: Vec3) -> Self {
        let (grains, now) = (snapshot.grains, &snapshot.now);
        let of = |column: &[f64]| [column[i], column[j]];
        let touch = Touch::new(of(&grains.radius), of(&grains.mass), of(&grains.contact_stiffness), apart);
        let vectors = |column: &[Vec3]| [column[i], column[j]];
        let own = touch.relative_velocity(vectors(now.velocity), vectors(now.angular_velocity));
        let velocity = own + snapshot.world.space.flow(apart);
        Self {
            grains: [i, j],
            constants: snapshot.world.pairs.of(grains.material[i], grains.material[j]),
            approach: -velocity.dot(touch.normal),
            touch,
        }
    }
}

/// Goes through all pairs on which laws act at the present positions and joins what `look` makes of each.
fn over_contacts<R: Send + Sync + Copy>(
    snapshot: &Snapshot<'_>,
    nothing: R,
    look: impl Fn(&Contact<'_>) -> R + Sync,
    join: impl Fn(R, R) -> R + Sync,
) -> R {
    let Snapshot { world, grains, now } = snapshot;
    let beyond = world.beyond();
    let leaf = |range: Range<usize>, ()| {
        let mut found = nothing;
        for owner in range {
            for pair in world.list.owned(owner) {
                let partner = world.list.partners()[pair] as usize;
                let apart = world.space.shortest(now.position[partner] - now.position[owner]);
                let reach = grains.radius[owner] + grains.radius[partner] + beyond;
                if apart.norm_squared() < reach * reach {
                    found = join(found, look(&Contact::new(snapshot, [owner, partner], apart)));
                }
            }
        }
        found
    };
    parallel::over(0..now.position.len(), BLOCK, (), &leaf, &join)
}

/// Adds up the normal energies at the present positions; for records, not for steps.
pub fn contact_energy(snapshot: &Snapshot<'_>) -> ContactEnergy {
    let world = &snapshot.world;
    let energy = |contact: &Contact<'_>| {
        let geometry = &contact.touch.geometry;
        ContactEnergy {
            normal: world.laws.map_or(0.0, |laws| laws.energy(contact.constants, geometry)),
            bond: world.bond().map_or(0.0, |bond| bond.energy(geometry)),
        }
    };
    let sum = |a: ContactEnergy, b: ContactEnergy| ContactEnergy {
        normal: a.normal + b.normal,
        bond: a.bond + b.bond,
    };
    over_contacts(snapshot, ContactEnergy::default(), energy, sum)
}

/// How fast the fastest of all touching pairs is at the present positions.
pub fn contact_pace(snapshot: &Snapshot<'_>) -> Pace {
    let world = &snapshot.world;
    let pace = |contact: &Contact<'_>| {
        let geometry = &contact.touch.geometry;
        let pace = |laws: &ContactLaws| laws.pace_at(contact.constants, geometry, contact.approach);
        let laws = world.laws.map_or(Pace::NONE, pace);
        match world.bond().filter(|_| geometry.overlap > 0.0) {
            Some(bond) => laws + bond.pace(geometry),
            None => laws,
        }
    };
    over_contacts(snapshot, Pace::NONE, pace, Pace::max)
}

/// The grains of the pair with the largest overlap over the sum of radii; none where nothing touches.
pub fn deepest_pair(snapshot: &Snapshot<'_>) -> Option<[usize; 2]> {
    let strained = |contact: &Contact<'_>| Some((contact.touch.strain, contact.grains));
    let deeper = |a: Option<(f64, [usize; 2])>, b: Option<(f64, [usize; 2])>| match (a, b) {
        (Some(a), Some(b)) => Some(if b.0 > a.0 { b } else { a }),
        (a, b) => a.or(b),
    };
    over_contacts(snapshot, None, strained, deeper).map(|(_, grains)| grains)
}
