//! Energies and paces of grains at walls, for records and for the choice of a step.

use super::contacts::WallContacts;
use super::listed::Candidate;
use super::wall::Walls;
use crate::contact::bond::StrainBond;
use crate::contact::{ContactGeometry, ContactLaws, PairConstants, PairTable};
use crate::math::{Pace, Vec3};
use crate::particles::{Motion, Particles};

/// Grains and walls at one moment, to be looked at.
#[derive(Clone, Copy)]
pub struct WallSnapshot<'a> {
    /// The walls.
    pub walls: &'a Walls,
    /// Who is near them.
    pub contacts: &'a WallContacts,
    /// Laws of contact, if any.
    pub laws: Option<&'a ContactLaws>,
    /// The bond that acts in contact, if any.
    pub bond: Option<&'a StrainBond>,
    /// Constants of pairs of materials.
    pub pairs: &'a PairTable,
    /// The grains' constant columns.
    pub grains: &'a Particles,
    /// Where they are and how they move.
    pub now: Motion<'a>,
    /// Time [s].
    pub time: f64,
}

/// Energies of all contacts with walls.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WallEnergy {
    /// Elastic energy along the normals [J].
    pub normal: f64,
    /// Energy of bonds that act in contact [J], negative where they attract.
    pub bond: f64,
}

/// A grain that a wall presses on.
#[derive(Clone, Copy, Debug)]
struct Pressed<'a> {
    geometry: ContactGeometry,
    /// What grain and wall have in common.
    constants: &'a PairConstants,
    /// Rate at which the overlap grows [m/s].
    approach: f64,
}

impl<'a> WallSnapshot<'a> {
    /// All contacts on which laws act.
    fn pressed(&self) -> impl Iterator<Item = Pressed<'a>> + use<'a> {
        let own = *self;
        let reach = self.laws.map_or(0.0, ContactLaws::reach);
        let poses = self.contacts.poses_at(self.walls, self.time);
        self.contacts.candidates().iter().filter_map(move |candidate: &Candidate| {
            let (grain, wall) = (candidate.grain as usize, candidate.face[0] as usize);
            let center = own.now.position[grain];
            let near = own.walls.nearest(candidate.face, &poses[wall], center);
            let body = &own.walls.bodies[wall];
            let stiffness = [own.grains.contact_stiffness[grain], body.stiffness];
            let (radius, mass) = (own.grains.radius[grain], own.grains.mass[grain]);
            let surface: Vec3 = poses[wall].velocity_at(center + near.normal * near.gap);
            (near.gap < radius + reach).then(|| Pressed {
                geometry: ContactGeometry::at_wall(radius, mass, stiffness, near.gap),
                constants: own.pairs.of(own.grains.material[grain], body.material),
                approach: (own.now.velocity[grain] - surface).dot(near.normal),
            })
        })
    }

    /// Adds up the energies.
    pub fn energy(&self) -> WallEnergy {
        self.pressed().fold(WallEnergy::default(), |sum, pressed| {
            let normal = |laws: &ContactLaws| laws.energy(pressed.constants, &pressed.geometry);
            WallEnergy {
                normal: sum.normal + self.laws.map_or(0.0, normal),
                bond: sum.bond + self.bond.map_or(0.0, |bond| bond.energy(&pressed.geometry)),
            }
        })
    }

    /// How fast the fastest contact is.
    pub fn pace(&self) -> Pace {
        let pace = |pressed: Pressed<'_>| {
            let of =
                |laws: &ContactLaws| laws.pace_at(pressed.constants, &pressed.geometry, pressed.approach);
            let laws = self.laws.map_or(Pace::NONE, of);
            match self.bond.filter(|_| pressed.geometry.overlap > 0.0) {
                Some(bond) => laws + bond.pace(&pressed.geometry),
                None => laws,
            }
        };
        self.pressed().map(pace).fold(Pace::NONE, Pace::max)
    }
}
