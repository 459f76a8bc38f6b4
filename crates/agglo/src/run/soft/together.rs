//! How grains hang together: clusters, contacts, and how much of it the run has taken apart.

use crate::contact::closeness::{TOUCHING, are_close};
use crate::engine::soft::Simulation;
use crate::measure::{ClusterSummary, Clusters as Partition, close_pairs, summarize, whole};

use super::summary::Clusters;

/// How the grains of a simulation hang together now.
pub struct Together {
    /// The clusters: what bonds, touches or is closer than the scenario's gap.
    pub summary: ClusterSummary,
    /// The cluster of each grain [n].
    pub labels: Vec<u32>,
    /// Pairs of grains that touch.
    pub contacts: u64,
}

impl Together {
    /// Looks at all pairs; grains that are no farther apart than `cluster_gap` of the smaller radius are of one cluster.
    pub fn of(simulation: &Simulation, cluster_gap: f64) -> Self {
        let system = &simulation.system;
        let (grains, space) = (&system.grains, &system.space);
        let mut edges: Vec<(u32, u32)> =
            system.network.bonds().iter().map(|bond| bond.grains.into()).collect();
        let mut contacts = 0;
        close_pairs(space, &grains.position, &grains.radius, cluster_gap.max(TOUCHING), &mut |a, b| {
            let (i, j) = (a as usize, b as usize);
            let distance_squared = space.shortest(grains.position[i] - grains.position[j]).norm_squared();
            let within = |part: f64| are_close(distance_squared, grains.radius[i], grains.radius[j], part);
            contacts += u64::from(within(TOUCHING));
            if within(cluster_gap) {
                edges.push((a, b));
            }
        });
        let places = whole(space, &grains.position, &edges);
        let clusters = Partition::new(&grains.mass, edges);
        let summary = summarize(&clusters, &places, &grains.radius, &grains.mass);
        Self { summary, labels: clusters.labels, contacts }
    }

    /// The quantities of a summary.
    pub fn clusters(&self) -> Clusters {
        Clusters { count: self.summary.count, largest_fraction: self.summary.largest_mass_fraction }
    }
}

/// The dispersion degree relative to the start: 1 - f/f_0 with f the largest cluster's part of the mass now and f_0 that
/// at the start. So a bed of loose grains has 0 at its start, though its dispersion degree 1 - f is nearly 1; below 0
/// grains have come together.
pub fn dispersion_since(start: &Clusters, now: &Clusters) -> f64 {
    if start.largest_fraction > 0.0 { 1.0 - now.largest_fraction / start.largest_fraction } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::math::Vec3;
    use crate::particles::Particles;
    use crate::scenario::Scenario;

    /// A lattice of touching spheres of radius R about a place.
    fn lattice(kind: &str, radius: f64, at: f64, more: &str) -> (Scenario, Particles) {
        let (spacing, lower, upper) = (2.0 * radius, at - 7.3 * radius, at + 7.3 * radius);
        let text = format!(
            "version = 1\ntime.end = \"1 ms\"\n[engine.verlet]\n[materials.glass]\ndensity = \"2500 kg/m3\"\n\
             youngs_modulus = \"1 MPa\"\npoisson_ratio = 0.2\n[contact.normal.hertz]\n{more}\n[[grains]]\n\
             material = \"glass\"\nsize.constant.radius = \"{radius:e} m\"\n[grains.placement.lattice]\n\
             kind = \"{kind}\"\nspacing = \"{spacing:e} m\"\n[grains.placement.lattice.region.box]\n\
             lower = [\"{lower:e} m\", \"{lower:e} m\", \"{lower:e} m\"]\n\
             upper = [\"{upper:e} m\", \"{upper:e} m\", \"{upper:e} m\"]\n"
        );
        let scenario = Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"));
        let grains = crate::packing::place(&scenario, Path::new("")).unwrap();
        (scenario, grains)
    }

    fn together((scenario, grains): (Scenario, Particles)) -> Together {
        let gap = scenario.measures.cluster_gap;
        Together::of(&Simulation::start(&scenario, grains).unwrap(), gap)
    }

    /// Pairs within 1.01 diameters: those that touch are one diameter apart, the next ones 1.15 at least.
    fn pairs_by_hand(places: &[Vec3]) -> u64 {
        let is_near = |a: Vec3, b: Vec3| (a - b).norm() < 2.02;
        let pairs = (0..places.len()).map(|i| places[..i].iter().filter(|b| is_near(places[i], **b)).count());
        pairs.sum::<usize>() as u64
    }

    /// Touching spheres touch wherever they are and however large: as many contacts as by hand, and one cluster.
    #[test]
    fn touching_spheres_touch_at_any_place_and_size() {
        for kind in ["hcp", "fcc", "bcc", "cubic"] {
            let places = lattice(kind, 1.0, 0.0, "").1.position;
            let (grains, contacts) = (places.len(), pairs_by_hand(&places));
            assert_above!(grains, 100);
            assert_above!(contacts, 2 * grains as u64);
            for (radius, at) in [(1.0, 0.0), (1.0, 0.1), (0.3, 17.7), (1e-6, 0.012), (4e-5, -1.0 / 3.0)] {
                let found = together(lattice(kind, radius, at, ""));
                let size = found.summary.largest_size as usize;
                assert_eq!((found.summary.count, size), (1, grains), "{kind}, R = {radius} m about {at} m");
                assert_eq!(found.contacts, contacts, "{kind}, R = {radius} m about {at} m");
            }
        }
    }

    #[test]
    fn a_gap_of_the_scenario_moves_clusters_and_not_contacts() {
        let of = |gap: &str| {
            let spread = lattice("cubic", 1.0, 0.0, &format!("[measures]\ncluster_gap = {gap}"));
            let mut grains = spread.1;
            // Half a radius of gap between all surfaces.
            grains.position = grains.position.iter().map(|&position| position * 1.25).collect();
            let found = together((spread.0, grains));
            (found.summary.count > 1, found.contacts)
        };
        assert_eq!([of("0.49"), of("0.51"), of("0")], [(true, 0), (false, 0), (true, 0)]);
    }

    /// 1 - 0.0025/0.0025 = 0 for a loose bed at its start; half of one agglomerate gone is 0.5; 0.01/0.0025 is -3.
    #[test]
    fn the_degree_since_the_start_by_hand() {
        let with = |largest_fraction| Clusters { count: 1, largest_fraction };
        let cases = [(0.0025, 0.0025, 0.0), (1.0, 0.5, 0.5), (0.0025, 0.01, -3.0), (0.8, 0.2, 0.75)];
        for (start, now, degree) in cases {
            assert_near!(dispersion_since(&with(start), &with(now)), degree, 1e-15);
        }
    }
}
