//! What comes out of a hand-over either way: grains in the order of their materials, and the agglomerates that they are or
//! belong to.

use std::path::{Path, PathBuf};

use super::files::{self, Cluster, Told};
use super::record::{Cleared, ball};
use super::{Grown, HandOver, Motion, Options};
use crate::particles::{Particles, Row};

/// Grains that came out, with what is told of them.
pub(super) struct CameOut {
    pub grains: Particles,
    pub told: Vec<Told>,
    pub clusters: Vec<Cluster>,
    pub cleared: Cleared,
}

impl CameOut {
    /// Puts grains in the order of their materials: groups follow one another in a scenario, and ids their order.
    pub fn new(mut rows: Vec<(Row, Told)>, clusters: Vec<Cluster>, cleared: Cleared) -> Self {
        rows.sort_by_key(|(row, _)| row.material);
        let (mut grains, mut all) = (Particles::default(), Vec::new());
        for (id, (row, told)) in (0..).zip(rows) {
            grains.push(Row { id, ..row });
            all.push(told);
        }
        Self { grains, told: all, clusters, cleared }
    }

    /// The record, but for what one way alone has to say.
    pub fn record(
        &self,
        (grown, options, to): (&Grown, &Options<'_>, &Path),
        tables: Vec<PathBuf>,
        [before, after]: [Motion; 2],
    ) -> HandOver {
        let Self { clusters, cleared, .. } = self;
        let (center, radius) = ball(&self.grains);
        let [clusters_table, record] = files::places(to);
        HandOver {
            to: if grown.is_hard() { "soft" } else { "hard" },
            from: grown.shown.clone(),
            time_s: grown.state.time,
            with: options.with.1.to_owned(),
            scenario: to.to_owned(),
            tables,
            clusters_table,
            record,
            clusters: clusters.len(),
            single: clusters.iter().filter(|cluster| cluster.primaries == 1).count(),
            largest: clusters.iter().map(|cluster| cluster.primaries).max().unwrap_or(0),
            packing: None,
            moved: cleared.moved,
            farthest_m: cleared.farthest,
            spread: cleared.spread,
            volume_m: None,
            center_m: center.to_array(),
            radius_m: radius,
            before,
            after,
            spin_dropped_kg_m2_s: 0.0,
            notes: Vec::new(),
        }
    }
}

/// The title of the run, or what it is called where it has none.
pub(super) fn titled(grown: &Grown) -> &str {
    let title = grown.state.past.title.as_str();
    if title.is_empty() { "A run" } else { title }
}
