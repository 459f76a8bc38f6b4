//! A scene and how it becomes a picture.

use std::sync::OnceLock;

use rayon::prelude::*;

use super::bvh::{Bvh, Ray};
use super::camera::Camera;
use super::image::{Image, Ink};
use super::light::{self, Probes, Sky};
use super::sheet::Sheet;
use super::solid::{Light, Line, Sphere};
use agglo::math::Vec3;

/// What is behind everything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Background {
    /// White, with dark words.
    #[default]
    Light,
    /// Nearly black, with light words.
    Dark,
    /// Nothing, with dark words.
    Transparent,
}

impl Background {
    /// Its color and opacity.
    fn ink(self) -> Ink {
        match self {
            Self::Light => Ink { light: [1.0; 3], cover: 1.0 },
            Self::Dark => Ink { light: [0.007, 0.008, 0.010], cover: 1.0 },
            Self::Transparent => Ink { light: [0.0; 3], cover: 0.0 },
        }
    }
}

/// What is drawn.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Grains.
    pub spheres: Vec<Sphere>,
    /// Bonds, rays, edges.
    pub lines: Vec<Line>,
    /// Walls: what lies behind them is seen through them.
    pub sheets: Vec<Sheet>,
    /// A level floor at this height [m] about this place.
    pub ground: Option<Ground>,
    /// What is behind everything.
    pub background: Background,
}

/// A level floor that fades away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Its middle [m].
    pub center: Vec3,
    /// Where it is gone [m].
    pub radius: f64,
}

/// What a ray met first.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Met {
    Nothing,
    Sphere(u32),
    Line(u32),
    Ground,
}

/// Rays through a pixel where an edge crosses it: no two share a row or a column, so that edges near either look smooth.
const SAMPLES: [[f64; 2]; 8] = [
    [0.0625, 0.5625],
    [0.1875, 0.1875],
    [0.3125, 0.8125],
    [0.4375, 0.4375],
    [0.5625, 0.9375],
    [0.6875, 0.0625],
    [0.8125, 0.6875],
    [0.9375, 0.3125],
];
/// Grains that look smaller than this radius in pixels may lie between the rays through the middles of pixels.
const SMALL: f64 = 1.2;
/// How much of the light is the sky's, and how much the sun's.
const SKY: f64 = 0.62;
const SUN: f64 = 0.52;
/// Part of the light that a shiny surface mirrors at most, and how small the highlight is.
const SHINE: f64 = 0.10;
const GLOSS: i32 = 40;

/// How much a wall covers of what is behind it, its color as light, and how bright it is where no sun comes.
const SHEET_COVERS: f32 = 0.3;
const SHEET: Light = [0.36, 0.45, 0.56];
const IN_THE_SHADE: f64 = 0.45;

/// A scene prepared for rays.
struct Stage<'a> {
    camera: &'a Camera,
    spheres: Vec<Sphere>,
    tree: Bvh,
    lines: Vec<Line>,
    line_tree: Bvh,
    sheets: Vec<Sheet>,
    sheet_tree: Bvh,
    ground: Option<Ground>,
    background: Ink,
    probes: Probes,
    /// Worked out when a grain is first seen; the same whoever does it.
    skies: Vec<OnceLock<Sky>>,
    to_sun: Vec3,
}

impl Scene {
    /// The picture that the camera takes. It has the same bits for any number of threads.
    pub fn draw(&self, camera: &Camera) -> Image {
        let stage = Stage::new(self, camera);
        let [width, height] = camera.size().map(|length| length as usize);
        let mut met = vec![(Met::Nothing, 0.0); width * height];
        met.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for (x, met) in row.iter_mut().enumerate() {
                *met = stage.first(&camera.ray(x as f64 + 0.5, y as f64 + 0.5));
            }
        });
        let edges = stage.edges(&met, [width, height]);
        let mut image = Image::new(camera.size());
        image.rows_mut().enumerate().for_each(|(y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                let at = y * width + x;
                let ink = match met[at] {
                    _ if edges[at] => stage.mixed(x, y),
                    (Met::Nothing, _) if stage.sheets.is_empty() => stage.background,
                    (met, distance) => {
                        stage.shade(&camera.ray(x as f64 + 0.5, y as f64 + 0.5), met, distance)
                    }
                };
                *pixel = ink.bytes();
            }
        });
        image
    }
}

impl<'a> Stage<'a> {
    fn new(scene: &Scene, camera: &'a Camera) -> Self {
        let tree = Bvh::new(&scene.spheres.iter().map(Sphere::bounds).collect::<Vec<_>>());
        let line_tree = Bvh::new(&scene.lines.iter().map(Line::bounds).collect::<Vec<_>>());
        let sheet_tree = Bvh::new(&scene.sheets.iter().map(Sheet::bounds).collect::<Vec<_>>());
        let spheres: Vec<Sphere> = tree.order().iter().map(|&k| scene.spheres[k as usize]).collect();
        let [right, up, forward] = *camera.axes();
        Self {
            camera,
            skies: spheres.iter().map(|_| OnceLock::new()).collect(),
            spheres,
            tree,
            lines: line_tree.order().iter().map(|&k| scene.lines[k as usize]).collect(),
            line_tree,
            sheets: sheet_tree.order().iter().map(|&k| scene.sheets[k as usize]).collect(),
            sheet_tree,
            ground: scene.ground,
            background: scene.background.ink(),
            probes: Probes::new(),
            // Over the photographer's left shoulder.
            to_sun: (up * 0.75 - right * 0.55 - forward * 0.65).normalized(),
        }
    }

    /// What a ray meets first, and how far away.
    fn first(&self, ray: &Ray) -> (Met, f64) {
        let sphere = self.tree.nearest(ray, f64::INFINITY, |slot| self.spheres[slot].hit(ray));
        let (mut met, mut limit) = match sphere {
            Some((slot, distance)) => (Met::Sphere(slot as u32), distance),
            None => (Met::Nothing, f64::INFINITY),
        };
        if let Some((slot, distance)) = self.line_tree.nearest(ray, limit, |slot| self.lines[slot].hit(ray)) {
            (met, limit) = (Met::Line(slot as u32), distance);
        }
        if let Some(distance) = self.ground.and_then(|ground| ground.hit(ray)).filter(|at| *at < limit) {
            (met, limit) = (Met::Ground, distance);
        }
        (met, limit)
    }

    /// Pixels in which more than one thing may be seen.
    fn edges(&self, met: &[(Met, f64)], [width, height]: [usize; 2]) -> Vec<bool> {
        let mut edges = vec![false; met.len()];
        edges.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
            for (x, edge) in row.iter_mut().enumerate() {
                let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
                let here = met[y * width + x].0;
                *edge =
                    rows.clone().any(|row| columns.clone().any(|column| met[row * width + column].0 != here));
            }
        });
        for sphere in &self.spheres {
            let Some(([x, y], depth)) = self.camera.project(sphere.center) else { continue };
            let radius = sphere.radius / self.camera.pixel_at(depth);
            if radius > SMALL {
                continue;
            }
            // A number below zero becomes zero, so ends beyond the picture give its edge or nothing.
            let reach = |at: f64, length: usize| {
                let is_in = at + radius >= 0.0;
                (at - radius) as usize..if is_in { ((at + radius) as usize + 1).min(length) } else { 0 }
            };
            for y in reach(y, height) {
                for x in reach(x, width) {
                    edges[y * width + x] = true;
                }
            }
        }
        edges
    }

    /// The mean over a pixel: each thing counts by how many rays meet it, and is shaded once.
    fn mixed(&self, x: usize, y: usize) -> Ink {
        let mut seen: [(Met, u32, Ink); SAMPLES.len()] = [(Met::Nothing, 0, Ink::default()); SAMPLES.len()];
        let mut kinds = 0;
        for [dx, dy] in SAMPLES {
            let ray = self.camera.ray(x as f64 + dx, y as f64 + dy);
            let (met, distance) = self.first(&ray);
            if let Some(known) = seen[..kinds].iter_mut().find(|known| known.0 == met) {
                known.1 += 1;
            } else {
                seen[kinds] = (met, 1, self.shade(&ray, met, distance));
                kinds += 1;
            }
        }
        Ink::mean(seen[..kinds].iter().map(|&(_, count, ink)| (count as f32 / SAMPLES.len() as f32, ink)))
    }

    fn shade(&self, ray: &Ray, met: Met, distance: f64) -> Ink {
        let solid = |light: Light| Ink { light, cover: 1.0 };
        let ink = match met {
            Met::Nothing => self.background,
            Met::Line(slot) => solid(self.lines[slot as usize].color),
            Met::Sphere(slot) => solid(self.on_sphere(ray.at(distance), ray.direction, slot as usize)),
            Met::Ground => self.on_ground(ray.at(distance)),
        };
        self.behind_sheets(ray, distance, ink)
    }

    /// What is left of an ink so far away [m] behind the sheets before it.
    fn behind_sheets(&self, ray: &Ray, distance: f64, ink: Ink) -> Ink {
        let (mut through, mut sheets, mut light) = (1.0, 0.0, [0.0; 3]);
        self.sheet_tree.meets(ray, |slot| {
            if let Some((at, normal)) = self.sheets[slot].hit(ray).filter(|hit| hit.0 < distance) {
                let (place, facing) = (ray.at(at), normal.dot(self.to_sun).max(0.0));
                let sun = light::sun(&self.tree, &self.spheres, (place, None), self.to_sun);
                let lit = (IN_THE_SHADE + (1.0 - IN_THE_SHADE) * sun * facing) as f32;
                through *= 1.0 - SHEET_COVERS;
                sheets += 1.0;
                light = [0, 1, 2].map(|k| light[k] + SHEET[k] * lit);
            }
            false
        });
        if sheets == 0.0 {
            return ink;
        }
        // One after the other would ask for their order; they are of one color, so that it hardly matters.
        let sheets = Ink { light: light.map(|part| part / sheets), cover: 1.0 };
        Ink::mean([(through, ink), (1.0 - through, sheets)])
    }

    fn on_sphere(&self, place: Vec3, direction: Vec3, slot: usize) -> Light {
        let sphere = &self.spheres[slot];
        let normal = (place - sphere.center) / sphere.radius;
        let sky = self.skies[slot].get_or_init(|| self.sky_of(slot)).light(normal);
        let facing = normal.dot(self.to_sun);
        let sun = if facing > 0.0 {
            light::sun(&self.tree, &self.spheres, (place, Some(slot)), self.to_sun)
        } else {
            0.0
        };
        let halfway = (self.to_sun - direction).normalized();
        let shine = SHINE * sun * normal.dot(halfway).max(0.0).powi(GLOSS);
        let diffuse = SKY * sky + SUN * sun * facing.max(0.0);
        sphere.color.map(|part| (f64::from(part) * diffuse + shine).min(1.0) as f32)
    }

    /// The sky as seen from a grain's surface: open where nothing stands before the surface's point that looks there.
    fn sky_of(&self, slot: usize) -> Sky {
        let sphere = &self.spheres[slot];
        self.probes.sky(|direction| {
            let ray = Ray::new(sphere.center + direction * sphere.radius, direction);
            !self.tree.meets(&ray, |other| other != slot && self.spheres[other].hit(&ray).is_some())
        })
    }

    /// The floor is white in the light, so that only shadows show; it is seen from above only.
    fn on_ground(&self, place: Vec3) -> Ink {
        let Some(ground) = self.ground else { return self.background };
        let far = ((place - ground.center).norm() / ground.radius).min(1.0);
        let strength = (1.0 - far * far).powi(2);
        let free =
            |direction, slope| light::free_part(&self.tree, &self.spheres, (place, None), direction, slope);
        let sun = light::sun(&self.tree, &self.spheres, (place, None), self.to_sun);
        let lit = (0.55 * free(Vec3::AXES[2], 0.8) + 0.45 * sun) as f32;
        let floor = Ink { light: [0.86 * lit; 3], cover: 1.0 };
        Ink::mean([(strength as f32, floor), (1.0 - strength as f32, self.background)])
    }
}

impl Ground {
    fn hit(&self, ray: &Ray) -> Option<f64> {
        let distance = (self.center.z - ray.origin.z) / ray.direction.z;
        let is_met = ray.direction.z < 0.0 && distance > 0.0;
        (is_met && (ray.at(distance) - self.center).norm() < self.radius).then_some(distance)
    }
}

#[cfg(test)]
#[path = "scene_tests.rs"]
mod tests;
