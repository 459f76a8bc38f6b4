//! The spheres near a point, by the cells of events.

use crate::engine::hard::spheres::Spheres;
use crate::math::Vec3;

use super::contact::Surroundings;
use super::grid::Grid;

/// What is near a point, by the cells.
pub struct Around<'a> {
    /// The cells.
    pub grid: &'a Grid,
}

impl Surroundings for Around<'_> {
    fn visit_near(
        &self,
        spheres: &Spheres,
        center: Vec3,
        reach: f64,
        time: f64,
        visit: &mut dyn FnMut(u32, Vec3),
    ) {
        for (number, level) in self.grid.levels().iter().enumerate() {
            if level.population > 0 {
                // Cells are about where spheres were when they last moved into one: rounding apart, where they are.
                let farthest = (reach + 0.5 * level.widest()) * (1.0 + 1e-9);
                let corner = Vec3::new(farthest, farthest, farthest);
                let middle = center - self.grid.frame.flown(time);
                self.grid.visit_within(number, [middle - corner, middle + corner], |at, image| {
                    let sphere = &spheres.motion[at as usize];
                    let position = sphere.at(time) + self.grid.shift(image);
                    if (position - center).norm() <= reach + sphere.radius {
                        visit(at, position);
                    }
                });
            }
        }
    }
}
