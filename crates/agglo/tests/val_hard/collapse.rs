//! Inelastic collapse: infinitely many impacts in a finite time, S. McNamara and W. R. Young, Phys. Fluids A 4, 496 (1992).

use crate::common;
use crate::support::{self, Gas};

/// A dense, strongly inelastic gas goes on beyond the times at which it would collapse, and never gains energy.
#[test]
fn a_gas_that_would_collapse_goes_on() {
    for (restitution, solid_fraction) in [(0.1, 0.3), (0.2, 0.35)] {
        let impact = format!("[impact.restitution.constant]\nrestitution = {restitution}\n");
        let gas = Gas { count: 1_000, solid_fraction, impact: &impact, ..Gas::default() };
        let mut simulation = gas.start();
        let start = support::kinetic(&simulation);
        let mut before = start;
        for tenth in 1..=10 {
            support::run_until(&mut simulation, 0.1 * f64::from(tenth));
            let now = support::kinetic(&simulation);
            // Sums of a thousand terms; impacts made elastic round as well.
            assert!(now <= before * (1.0 + 1e-12), "{now:e} after {before:e}");
            before = now;
        }
        let counts = &simulation.system().state.counts;
        support::report(&format!(
            "collapse, e = {restitution}: {} impacts, {} of them made elastic; {:.1e} of the energy is left, drift {:.1e}",
            counts.collisions,
            counts.tc_bounces,
            before / start,
            simulation.balance().kinetic_drift_relative
        ));
        let (impacts, tc_bounces) = (counts.collisions as f64, counts.tc_bounces as f64);
        let figures = [("impacts", impacts), ("tc_bounces", tc_bounces), ("left", before / start)];
        common::found(&format!("collapse_{restitution}"), &figures);
        assert!(counts.tc_bounces > 0, "no collapse");
        assert_below!(before, 1e-2 * start);
        assert_eq!(counts.merges, 0);
        support::assert_ledger(&simulation);
    }
}
