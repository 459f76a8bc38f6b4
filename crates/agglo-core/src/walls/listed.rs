//! Which grains are so near to which faces of walls that they may touch.

use rayon::prelude::*;

use super::course::Pose;
use super::wall::Walls;
use crate::contact::pass::Record;
use crate::math::Vec3;

/// Thickness of the skin over the mean radius: what is farther away than this and the reach of the laws is not listed.
const SKIN: f64 = 0.5;

/// A grain and a face of a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Candidate {
    /// Place of the grain in memory.
    pub grain: u32,
    /// Numbers of the wall, and of the face in it.
    pub face: [u32; 2],
}

/// Grains near walls, by rising grain and face. It holds as long as grains and walls have not come nearer by more than the skin.
#[derive(Debug, Default)]
pub(super) struct Listed {
    pub candidates: Vec<Candidate>,
    /// Where walls were when it was made, and how far from the point that it turns about the farthest grain was [m].
    poses: Vec<(Pose, f64)>,
    skin: f64,
    /// Way [m] that grains may have made since.
    strayed: f64,
}

impl Listed {
    /// Takes note that no grain is farther than this [m] from where it was last.
    pub fn note_way(&mut self, longest: f64) {
        self.strayed += longest;
    }

    /// Whether it has all that may touch, the walls being in these poses.
    pub fn holds(&self, poses: &[Pose]) -> bool {
        let walls = self
            .poses
            .iter()
            .zip(poses)
            .map(|((then, within), now)| now.way_since(then, *within + self.skin));
        self.poses.len() == poses.len() && self.strayed + walls.fold(0.0, f64::max) <= self.skin
    }

    /// Lists grains where they are on their way, for laws that reach beyond touching by a length [m].
    pub fn build(&mut self, walls: &Walls, poses: &[Pose], records: &[Record], reach: f64) {
        let n = records.len();
        let radii: f64 = records.iter().map(Record::radius).sum();
        self.skin = SKIN * radii / n.max(1) as f64;
        self.strayed = 0.0;
        let far = |pose: &Pose| {
            let away = |record: &Record| (record.now().0 - pose.center()).norm();
            records.iter().map(away).fold(0.0, f64::max)
        };
        self.poses = poses.iter().map(|pose| (*pose, far(pose))).collect();
        let within = reach + self.skin;
        let of_grain = |(grain, record): (usize, &Record)| {
            let (center, radius): (Vec3, f64) = (record.now().0, record.radius());
            walls.faces.iter().filter_map(move |&face| {
                let gap = walls.nearest(face, &poses[face[0] as usize], center).gap;
                (gap < radius + within).then_some(Candidate { grain: grain as u32, face })
            })
        };
        self.candidates = records.par_iter().enumerate().flat_map_iter(of_grain).collect();
    }
}
