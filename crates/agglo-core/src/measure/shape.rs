//! Size and shape of clusters.
//!
//! # Equation
//! ```text
//! R_g² = sum(m (|r - r_cm|² + 3/5 R²))/sum(m)
//! M(r) ~ r^d_f
//! ```
//! M(r) is the mass within r of a grain, averaged over the grains nearest to the center of mass; a grain that lies
//! partly within r counts with the part of its volume that does (two spheres' lens). d_f is the slope of ln M over
//! ln r, by least squares over radii in equal ratios from twice the mean grain radius to R_g.
//!
//! # Source
//! S. R. Forrest and T. A. Witten, J. Phys. A 12, L109 (1979) for the mass-radius relation; the volume common to two
//! spheres is elementary geometry.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning                              |
//! |--------|--------------|------|--------------------------------------|
//! | r      | `positions`  | m    | centers [n]                          |
//! | R      | `radii`      | m    | radii [n]                            |
//! | m      | `masses`     | kg   | masses [n]                           |
//! | r_cm   |              | m    | center of mass                       |
//! | R_g    |              | m    | radius of gyration                   |
//! | d_f    |              | 1    | fractal dimension                    |
//!
//! # Valid when
//! d_f needs at least 20 grains and R_g above four mean radii, else there is none; it is an estimate over less than a
//! decade for most agglomerates, and grains that end within R_g of an origin lower it.
//!
//! # Compared with others
//! R_g has the grains' own 3/5 R², so that a single grain has that of a solid sphere; codes that leave it out find 0.
//! Box counting finds other values for clusters this small.
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::{math::Vec3, measure::radius_of_gyration};
//! let pair = [Vec3::ZERO, Vec3::new(2.0, 0.0, 0.0)];
//! let found = radius_of_gyration(&pair, &[1.0; 2], &[5.0; 2], &[0, 1]);
//! assert!((found - 1.6_f64.sqrt()).abs() < 1e-15);
//! ```

use serde::{Deserialize, Serialize};

use super::Clusters;
use crate::math::Vec3;

/// Grains from which M(r) is taken.
const ORIGINS: usize = 16;
/// Radii at which M(r) is taken.
const RADII: u32 = 16;
/// Fewest grains of a cluster that has a fractal dimension.
const FEWEST: usize = 20;
/// Least radius of gyration, in mean radii, of a cluster that has a fractal dimension.
const WIDEST: f64 = 4.0;

/// How dispersed the grains are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ClusterSummary {
    /// Clusters, single grains included.
    pub count: usize,
    /// Grains in the heaviest cluster.
    pub largest_size: u32,
    /// Mass of the heaviest cluster over that of all.
    pub largest_mass_fraction: f64,
    /// 1 - `largest_mass_fraction`.
    pub dispersion_degree: f64,
    /// Radius of gyration of all grains [m].
    pub radius_of_gyration: f64,
    /// Radius of gyration of the heaviest cluster [m].
    pub largest_radius_of_gyration: f64,
    /// Fractal dimension of the heaviest cluster, if it is large enough to have one.
    pub largest_fractal_dimension: Option<f64>,
}

/// The quantities of `clusters` of grains with `positions` [n] [m], `radii` [n] [m] and `masses` [n] [kg]; faces across which space
/// repeats itself must not cut the heaviest cluster in two (see [`super::whole`]).
pub fn summarize(clusters: &Clusters, positions: &[Vec3], radii: &[f64], masses: &[f64]) -> ClusterSummary {
    let all: Vec<u32> = (0..positions.len() as u32).collect();
    let largest = clusters.members(0);
    ClusterSummary {
        count: clusters.count(),
        largest_size: largest.len() as u32,
        largest_mass_fraction: clusters.largest_mass_fraction(),
        dispersion_degree: clusters.dispersion_degree(),
        radius_of_gyration: radius_of_gyration(positions, radii, masses, &all),
        largest_radius_of_gyration: radius_of_gyration(positions, radii, masses, &largest),
        largest_fractal_dimension: fractal_dimension(positions, radii, masses, &largest),
    }
}

/// Center of mass [m] of the grains `members` [index]; the origin where they have no mass.
pub fn center_of_mass(positions: &[Vec3], masses: &[f64], members: &[u32]) -> Vec3 {
    let (mut moment, mut total) = (Vec3::ZERO, 0.0);
    for &grain in members {
        moment += positions[grain as usize] * masses[grain as usize];
        total += masses[grain as usize];
    }
    if total > 0.0 { moment / total } else { Vec3::ZERO }
}

/// Radius of gyration [m] of the grains `members` [index] about their center of mass; 0 where they have no mass.
pub fn radius_of_gyration(positions: &[Vec3], radii: &[f64], masses: &[f64], members: &[u32]) -> f64 {
    let center = center_of_mass(positions, masses, members);
    let (mut moment, mut total) = (0.0, 0.0);
    for &grain in members {
        let (at, mass) = (grain as usize, masses[grain as usize]);
        moment += mass * ((positions[at] - center).norm_squared() + 0.6 * radii[at] * radii[at]);
        total += mass;
    }
    if total > 0.0 { (moment / total).sqrt() } else { 0.0 }
}

/// Fractal dimension of the cluster of the grains `members` [index]; nothing where it is too small to have one.
pub fn fractal_dimension(positions: &[Vec3], radii: &[f64], masses: &[f64], members: &[u32]) -> Option<f64> {
    let mean_radius = members.iter().map(|&grain| radii[grain as usize]).sum::<f64>() / members.len() as f64;
    let widest = radius_of_gyration(positions, radii, masses, members);
    let large_enough = members.len() >= FEWEST && widest > WIDEST * mean_radius;
    if !large_enough {
        return None;
    }
    let center = center_of_mass(positions, masses, members);
    let from_center = |grain: u32| (positions[grain as usize] - center).norm_squared();
    let mut origins = members.to_vec();
    origins.sort_by(|&a, &b| from_center(a).total_cmp(&from_center(b)).then(a.cmp(&b)));
    origins.truncate(ORIGINS);
    let narrowest = 2.0 * mean_radius;
    let points = (0..RADII).map(|k| {
        let reach = narrowest * (widest / narrowest).powf(f64::from(k) / f64::from(RADII - 1));
        let within = |&origin: &u32| -> f64 {
            let part = |&grain: &u32| {
                let distance = (positions[grain as usize] - positions[origin as usize]).norm();
                masses[grain as usize] * part_within(distance, radii[grain as usize], reach)
            };
            members.iter().map(part).sum()
        };
        (reach.ln(), origins.iter().map(within).sum::<f64>().ln())
    });
    Some(slope(&points.collect::<Vec<_>>()))
}

/// Part of the volume of a sphere of `radius` that lies within `reach` of a point `distance` away from its center.
fn part_within(distance: f64, radius: f64, reach: f64) -> f64 {
    if distance + radius <= reach {
        1.0
    } else if distance >= reach + radius {
        0.0
    } else if distance + reach <= radius {
        (reach / radius).powi(3)
    } else {
        let depth = reach + radius - distance;
        let (a, b, d) = (reach, radius, distance);
        let lens = depth * depth * (d * d + 2.0 * d * (a + b) - 3.0 * (a - b) * (a - b)) / (12.0 * d);
        lens / (4.0 / 3.0 * b * b * b)
    }
}

/// Slope of the straight line of least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let x_mean = points.iter().map(|point| point.0).sum::<f64>() / count;
    let rise: f64 = points.iter().map(|point| (point.0 - x_mean) * point.1).sum();
    let run: f64 = points.iter().map(|point| (point.0 - x_mean) * (point.0 - x_mean)).sum();
    rise / run
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equal touching grains of diameter 1 on the points of a cubic grid that pass.
    fn grid(half: i32, passes: impl Fn(Vec3) -> bool) -> Vec<Vec3> {
        let range = move || -half..=half;
        let all = range().flat_map(|x| range().flat_map(move |y| range().map(move |z| (x, y, z))));
        all.map(|(x, y, z)| Vec3::new(f64::from(x), f64::from(y), f64::from(z)))
            .filter(|&at| passes(at))
            .collect()
    }

    fn measured(positions: &[Vec3]) -> (f64, Option<f64>) {
        let (radii, masses) = (vec![0.5; positions.len()], vec![2.0; positions.len()]);
        let members: Vec<u32> = (0..positions.len() as u32).collect();
        (
            radius_of_gyration(positions, &radii, &masses, &members),
            fractal_dimension(positions, &radii, &masses, &members),
        )
    }

    /// A row of n grains of diameter d: R_g² = d² (n² - 1)/12 + 3/5 R².
    #[test]
    fn radius_of_gyration_of_a_row_and_of_one_grain() {
        let row = grid(20, |at| at.y == 0.0 && at.z == 0.0);
        assert_near!(measured(&row).0.powi(2), (41.0_f64.powi(2) - 1.0) / 12.0 + 0.15, 1e-12);
        assert_near!(measured(&[Vec3::AXES[0]]).0, 0.15_f64.sqrt(), 1e-15);
    }

    /// Unequal masses: 3 kg at 0 and 1 kg at 4 have their center at 1 and spread (3 1 + 1 9)/4 = 3.
    #[test]
    fn unequal_masses() {
        let positions = [Vec3::ZERO, Vec3::new(4.0, 0.0, 0.0)];
        assert_eq!(center_of_mass(&positions, &[3.0, 1.0], &[0, 1]), Vec3::AXES[0]);
        let found = radius_of_gyration(&positions, &[0.0; 2], &[3.0, 1.0], &[0, 1]);
        assert_near!(found, 3.0_f64.sqrt(), 1e-15);
    }

    /// A row has dimension 1, a sheet 2, a ball 3. Grains are lumpy and origins lie off the middle: 4 %.
    #[test]
    fn dimensions_of_compact_bodies() {
        let row = measured(&grid(100, |at| at.y == 0.0 && at.z == 0.0)).1;
        let sheet = measured(&grid(30, |at| at.z == 0.0 && at.norm() <= 30.0)).1;
        let ball = measured(&grid(16, |at| at.norm() <= 16.0)).1;
        for (found, expected) in [(row, 1.0), (sheet, 2.0), (ball, 3.0)] {
            let found = found.unwrap();
            assert!((found / expected - 1.0).abs() < 0.04, "{found} {expected}");
        }
    }

    /// Vicsek's cross in three dimensions (a cube of 27 cells of which the middle and its 6 neighbors are kept, again
    /// and again) has dimension ln 7/ln 3 = 1.771; it repeats only by factors of 3, and M(r) ripples: 6 %.
    #[test]
    fn dimension_of_a_fractal() {
        let mut cross = vec![Vec3::ZERO];
        for level in 0..4 {
            let step = 3.0_f64.powi(level);
            let arms: Vec<Vec3> = Vec3::AXES.iter().flat_map(|&axis| [axis * step, axis * -step]).collect();
            let moved = cross.iter().flat_map(|&at| arms.iter().map(move |&arm| at + arm));
            let moved: Vec<Vec3> = moved.collect();
            cross.extend(moved);
        }
        assert_eq!(cross.len(), 7_usize.pow(4));
        let found = measured(&cross).1.unwrap();
        assert!((found / (7.0_f64.ln() / 3.0_f64.ln()) - 1.0).abs() < 0.06, "{found}");
    }

    /// A power law has its exponent for a slope, wherever the points lie: round-off only.
    #[test]
    fn slope_of_a_power_law() {
        let points = [1.0_f64, 1.5, 4.0, 7.0].map(|r| (r.ln(), (5.0 * r.powf(1.78)).ln()));
        assert_near!(slope(&points), 1.78, 1e-13);
    }

    #[test]
    fn too_small_for_a_dimension() {
        assert_eq!(measured(&grid(1, |_| true)).1, None);
        assert_eq!(measured(&[]), (0.0, None));
    }

    /// Half-way cases of the lens: equal spheres one radius apart share 5/16, a far larger one cuts a sphere in half.
    #[test]
    fn parts_of_spheres() {
        assert_near!(part_within(1.0, 1.0, 1.0), 5.0 / 16.0, 1e-15);
        // A sphere of radius 1e4 is nearly flat: the error is about 1/1e4.
        assert_near!(part_within(1e4, 1.0, 1e4), 0.5, 1e-4);
        assert_eq!(
            [part_within(0.0, 1.0, 0.5), part_within(0.2, 1.0, 2.0), part_within(3.0, 1.0, 2.0)],
            [0.125, 1.0, 0.0]
        );
    }

    #[test]
    fn the_summary_of_a_row_and_a_grain() {
        let mut positions = grid(10, |at| at.y == 0.0 && at.z == 0.0);
        positions.push(Vec3::new(0.0, 50.0, 0.0));
        let (radii, masses) = (vec![0.5; 22], vec![3.0; 22]);
        let mut edges = Vec::new();
        crate::measure::close_pairs(&crate::domain::Space::OPEN, &positions, &radii, 0.01, &mut |i, j| {
            edges.push((i, j));
        });
        let clusters = Clusters::new(&masses, edges);
        let found = summarize(&clusters, &positions, &radii, &masses);
        assert_eq!((found.count, found.largest_size), (2, 21));
        assert_near!(found.dispersion_degree, 1.0 / 22.0, 1e-15);
        assert_near!(found.largest_radius_of_gyration.powi(2), 440.0 / 12.0 + 0.15, 1e-12);
        assert_near!(found.largest_fractal_dimension.unwrap(), 1.0, 0.1);
    }
}
