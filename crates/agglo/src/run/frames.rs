//! Frames for ParaView: grains, bonds and rays, each with its list of files and times.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::acoustics::{Flight, Ray};
use crate::contact::network::Bond;
use crate::math::Vec3;
use crate::particles::{ColumnValues, Particles};
use crate::record::RecordError;
use crate::record::frames::{Collection, Field, write_bonds, write_grains, write_rays};

/// The lists of frames; a checkpoint holds them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameLists {
    grains: Collection,
    bonds: Collection,
    rays: Collection,
    last_time: Option<f64>,
}

/// Writes frames into a folder.
#[derive(Debug)]
pub struct Frames {
    folder: PathBuf,
    lists: FrameLists,
}

impl Frames {
    /// Frames in `folder`, going on after those of `lists`.
    pub fn new(folder: &Path, lists: FrameLists) -> Self {
        Self { folder: folder.to_owned(), lists }
    }

    /// The lists so far.
    pub fn lists(&self) -> &FrameLists {
        &self.lists
    }

    /// Time [s] of the last frame.
    pub fn last_time(&self) -> Option<f64> {
        self.lists.last_time
    }

    /// Writes the grains at `time` [s] with an integer field [n] of this name.
    pub fn grains(
        &mut self,
        time: f64,
        grains: &Particles,
        (field, values): (&str, &[u32]),
    ) -> Result<(), RecordError> {
        self.lists.last_time = Some(time);
        let name = next_name("grains", &self.lists.grains);
        let extra = Field::new(field, ColumnValues::Integers(values));
        write_grains(&self.folder.join(&name), time, grains, &[extra])?;
        self.lists.grains.add(time, &name);
        self.lists.grains.write(&self.folder.join("grains.pvd"))
    }

    /// Writes the bonds at `time` [s] as lines between centres, in the order of the names that they join.
    pub fn bonds(&mut self, time: f64, grains: &Particles, bonds: &[Bond]) -> Result<(), RecordError> {
        let name = next_name("bonds", &self.lists.bonds);
        let mut bonds: Vec<&Bond> = bonds.iter().collect();
        bonds.sort_by_key(|bond| {
            let [a, b] = bond.grains.map(|grain| grains.id[grain as usize]);
            [a.min(b), a.max(b)]
        });
        let pairs: Vec<[u32; 2]> = bonds.iter().map(|bond| bond.grains).collect();
        let stretch: Vec<f64> = bonds
            .iter()
            .map(|bond| {
                let [a, b] = bond.grains.map(|grain| grains.position[grain as usize]);
                (b - a).norm() / bond.state.length - 1.0
            })
            .collect();
        let fields = [Field::new("stretch", ColumnValues::Scalars(&stretch))];
        write_bonds(&self.folder.join(&name), time, grains, &pairs, &fields)?;
        self.lists.bonds.add(time, &name);
        self.lists.bonds.write(&self.folder.join("bonds.pvd"))
    }

    /// Writes the rays in flight at `time` [s].
    pub fn rays(&mut self, time: f64, flight: &Flight) -> Result<(), RecordError> {
        let name = next_name("rays", &self.lists.rays);
        let rays = flight.rays();
        let positions: Vec<Vec3> = rays.iter().map(Ray::position).collect();
        let directions: Vec<Vec3> = rays.iter().map(|ray| ray.direction).collect();
        let powers: Vec<f64> = rays.iter().map(|ray| ray.power).collect();
        write_rays(&self.folder.join(&name), time, &positions, &directions, &powers)?;
        self.lists.rays.add(time, &name);
        self.lists.rays.write(&self.folder.join("rays.pvd"))
    }
}

fn next_name(kind: &str, list: &Collection) -> String {
    format!("{kind}_{:06}.vtp", list.len())
}
