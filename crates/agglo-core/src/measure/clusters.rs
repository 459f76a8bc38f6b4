//! Clusters: grains that hang together by contacts, bonds or closeness.

use serde::{Deserialize, Serialize};

/// Which grain belongs to which cluster. Clusters are numbered from the heaviest down; of equally heavy ones the one
/// with the grain of smaller index comes first. A grain without neighbors is a cluster of one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Clusters {
    /// The cluster of each grain [n].
    pub labels: Vec<u32>,
    /// Grains in each cluster [clusters].
    pub sizes: Vec<u32>,
    /// Mass of each cluster [clusters] [kg].
    pub masses: Vec<f64>,
}

/// Joins grains along edges, one by one (disjoint sets with path halving; the smaller index is the root).
#[derive(Clone, Debug, Default)]
pub struct Joiner {
    parent: Vec<u32>,
}

impl Joiner {
    /// `count` grains, each on its own.
    pub fn new(count: usize) -> Self {
        let mut joiner = Self::default();
        joiner.reset(count);
        joiner
    }

    /// Sets all `count` grains on their own again; memory is used again.
    pub fn reset(&mut self, count: usize) {
        self.parent.clear();
        self.parent.extend(0..count as u32);
    }

    fn root(&mut self, grain: u32) -> u32 {
        let mut at = grain;
        while self.parent[at as usize] != at {
            let above = self.parent[at as usize];
            self.parent[at as usize] = self.parent[above as usize];
            at = self.parent[at as usize];
        }
        at
    }

    /// Puts two grains [index] into one cluster.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// The clusters, given the grains' masses [n] [kg]. The outcome does not depend on the order of the edges.
    pub fn clusters(&mut self, masses: &[f64]) -> Clusters {
        let count = self.parent.len();
        // Numbered by their first grains to begin with: a root is its cluster's smallest index.
        let mut labels = vec![0; count];
        let mut found: Vec<(f64, u32)> = Vec::new();
        for grain in 0..count as u32 {
            let root = self.root(grain);
            let label = if root == grain {
                found.push((0.0, 0));
                found.len() as u32 - 1
            } else {
                labels[root as usize]
            };
            labels[grain as usize] = label;
            let cluster = &mut found[label as usize];
            cluster.0 += masses[grain as usize];
            cluster.1 += 1;
        }
        let mut order: Vec<u32> = (0..found.len() as u32).collect();
        order.sort_by(|&a, &b| found[b as usize].0.total_cmp(&found[a as usize].0));
        let mut rank = vec![0; order.len()];
        for (place, &cluster) in (0..).zip(&order) {
            rank[cluster as usize] = place;
        }
        Clusters {
            labels: labels.into_iter().map(|label| rank[label as usize]).collect(),
            sizes: order.iter().map(|&cluster| found[cluster as usize].1).collect(),
            masses: order.iter().map(|&cluster| found[cluster as usize].0).collect(),
        }
    }
}

impl Clusters {
    /// The clusters of grains with `masses` [n] [kg] that the edges (pairs of indices) join.
    ///
    /// ```
    /// # extern crate agglo_core as agglo;
    /// use agglo::measure::Clusters;
    /// let found = Clusters::new(&[1.0, 1.0, 2.0, 1.0], [(3, 1), (1, 0)]);
    /// assert_eq!(found.labels, [0, 0, 1, 0]);
    /// assert_eq!(found.masses, [3.0, 2.0]);
    /// assert!((found.dispersion_degree() - 0.4).abs() < 1e-15);
    /// ```
    pub fn new(masses: &[f64], edges: impl IntoIterator<Item = (u32, u32)>) -> Self {
        let mut joiner = Joiner::new(masses.len());
        edges.into_iter().for_each(|(a, b)| joiner.join(a, b));
        joiner.clusters(masses)
    }

    /// How many clusters, single grains included.
    pub fn count(&self) -> usize {
        self.sizes.len()
    }

    /// Mass of the heaviest cluster over that of all grains; 0 where there is no mass.
    pub fn largest_mass_fraction(&self) -> f64 {
        let total: f64 = self.masses.iter().sum();
        if total > 0.0 { self.masses[0] / total } else { 0.0 }
    }

    /// 1 - mass of the heaviest cluster over that of all grains: 0 for one agglomerate, near 1 when dispersed.
    pub fn dispersion_degree(&self) -> f64 {
        1.0 - self.largest_mass_fraction()
    }

    /// Grains [index] of one cluster, in rising order.
    pub fn members(&self, cluster: u32) -> Vec<u32> {
        (0..).zip(&self.labels).filter(|&(_, &label)| label == cluster).map(|(grain, _)| grain).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};

    #[test]
    fn numbered_from_the_heaviest_then_by_first_grain() {
        // 0-4 weigh 2, 1-3 weigh 2, 2 weighs 5, 5 weighs 1.
        let found = Clusters::new(&[1.0, 1.0, 5.0, 1.0, 1.0, 1.0], [(4, 0), (1, 3)]);
        assert_eq!(found.labels, [1, 2, 0, 2, 1, 3]);
        assert_eq!(
            (found.sizes.as_slice(), found.masses.as_slice()),
            (&[1, 2, 2, 1][..], &[5.0, 2.0, 2.0, 1.0][..])
        );
        assert_eq!(found.members(1), [0, 4]);
        assert_near!(found.largest_mass_fraction(), 0.5, 1e-15);
        assert_eq!(found.count(), 4);
    }

    #[test]
    fn no_grains() {
        let none = Clusters::new(&[], []);
        assert_eq!((none.count(), none.largest_mass_fraction()), (0, 0.0));
    }

    /// Labels equal those of a flood fill over the same random edges, in either order of the edges.
    #[test]
    fn agrees_with_a_flood_fill() {
        let n = 500_u32;
        let mut stream = Stream::new(8, Purpose::Sampling, 0);
        let mut any = || (stream.uniform() * f64::from(n)) as u32;
        let edges: Vec<(u32, u32)> = (0..260).map(|_| (any(), any())).collect();
        let found = Clusters::new(&vec![1.0; n as usize], edges.iter().copied());
        assert_eq!(found, Clusters::new(&vec![1.0; n as usize], edges.iter().rev().map(|&(a, b)| (b, a))));
        let mut fill = vec![u32::MAX; n as usize];
        for seed in 0..n {
            let mut front = vec![seed];
            while let Some(at) = front.pop() {
                if fill[at as usize] == u32::MAX {
                    fill[at as usize] = seed;
                    front.extend(edges.iter().filter(|edge| edge.0 == at).map(|edge| edge.1));
                    front.extend(edges.iter().filter(|edge| edge.1 == at).map(|edge| edge.0));
                }
            }
        }
        for a in 0..n as usize {
            for b in 0..a {
                assert_eq!(found.labels[a] == found.labels[b], fill[a] == fill[b]);
            }
        }
        assert_true!(
            found.sizes.is_sorted_by(|a, b| a >= b),
            "from the largest to the smallest: {:?}",
            found.sizes
        );
        assert_above!(found.sizes[0], 10);
    }

    /// A long chain joined end to end: no recursion, and not slow.
    #[test]
    fn a_chain_of_a_million() {
        let n = 1_000_000;
        let found = Clusters::new(&vec![1.0; n as usize], (1..n).rev().map(|k| (k, k - 1)));
        assert_eq!(found.sizes, [n]);
        assert_eq!(found.dispersion_degree(), 0.0);
    }
}
