//! Cooling of a granular gas, P. K. Haff, J. Fluid Mech. 134, 401 (1983): T = T0 (1 + t/t_H)^-2 with
//! t_H = 6/(w (1 - e²)), w Enskog's rate of impacts of a sphere at the start.

use crate::common;
use crate::support::{self, Gas, Mean};

/// √(T0/T) - 1 over t/t_H at three times, as means over starts that have been mixed by elastic impacts.
fn cooling(gas: &Gas<'_>, restitution: f64, starts: u64) -> [Mean; 3] {
    let impact = format!("[impact.restitution.constant]\nrestitution = {restitution}\n");
    let mut ratios = [const { Vec::new() }; 3];
    for seed in 0..starts {
        let mut mixed = Gas { seed, ..*gas }.start();
        support::collide(&mut mixed, 5 * u64::from(gas.count));
        let mut simulation = Gas { seed, impact: &impact, ..*gas }.start_with(&mixed);
        let start = support::temperature(&simulation);
        let rate = support::enskog(gas, support::carnahan_starling(gas.solid_fraction), start);
        let time = 6.0 / (rate * (1.0 - restitution * restitution));
        for (ratios, times) in ratios.iter_mut().zip([1.0, 2.0, 4.0]) {
            support::run_until(&mut simulation, times * time);
            ratios.push(((start / support::temperature(&simulation)).sqrt() - 1.0) / times);
        }
        support::assert_ledger(&simulation);
    }
    ratios.map(|ratios| Mean::of(&ratios))
}

/// 1.2 %: velocities are not quite Maxwell's, in the steady state of cooling that makes it 0.2 to 0.3 % slower (van Noije
/// and Ernst 1998); and three standard errors, which are held to 0.9 %.
fn compare(restitution: f64, starts: u64) {
    let gas = Gas { count: 4_000, solid_fraction: 0.05, ..Gas::default() };
    for (found, times) in cooling(&gas, restitution, starts).into_iter().zip([1, 2, 4]) {
        support::report(&format!(
            "Haff, e = {restitution}: at {times} t_H the speed has fallen {:.4} +- {:.4} times as expected",
            found.mean, found.error
        ));
        common::found(&format!("haff_{restitution}"), &[("ratio", found.mean), ("error", found.error)]);
        assert!((found.mean - 1.0).abs() < 0.012, "{found:?}");
        assert!(found.error < 0.003, "{found:?}");
    }
}

#[test]
fn val_haff_1983_cooling() {
    compare(0.95, 8);
}

#[test]
#[ignore = "10 million impacts"]
fn val_haff_1983_cooling_of_many() {
    compare(0.95, 12);
    compare(0.98, 12);
}
