//! Formulas of contact against the laws that they write down.

use super::*;
use crate::contact::check::assert_slope;
use crate::contact::normal::{Hertz, NormalLaw};
use crate::testing::told_by;

const HERTZ: &str = "4/3*effective_modulus*sqrt(effective_radius)*overlap^1.5";

fn geometry(overlap: f64) -> ContactGeometry {
    ContactGeometry { overlap, ..ContactGeometry::new([1e-3, 4e-3], [1e-6, 2e-6], [1e7, 3e7], 5e-3) }
}

fn law(force: &str, energy: Option<&str>, reach: Option<f64>) -> Custom {
    Custom { force: Written::new(force), energy: energy.map(Written::new), reach: reach.map(Quantity) }
}

/// Force, slope and energy, given and integrated: the same arithmetic in another order, 1e-13; the integral to 1e-12.
#[test]
fn a_formula_of_hertz_is_hertz() {
    let pair = PairConstants { effective_modulus: 3e9, ..PairConstants::default() };
    let given = law(HERTZ, Some("8/15*effective_modulus*sqrt(effective_radius)*overlap^2.5"), None);
    let integrated = law(HERTZ, None, None);
    for overlap in [1e-12, 1e-7, 1e-5, 3e-4] {
        let geometry = geometry(overlap);
        assert_close!(given.force(&pair, &geometry, 0.3), Hertz {}.force(&pair, &geometry), 1e-13, "in N");
        assert_close!(
            given.slopes(&pair, &geometry, 0.3)[0],
            Hertz {}.tangent_stiffness(&pair, &geometry),
            1e-13,
            "in N/m"
        );
        assert_close!(given.energy(&pair, &geometry), Hertz {}.energy(&pair, &geometry), 1e-13, "in J");
        assert_close!(integrated.energy(&pair, &geometry), Hertz {}.energy(&pair, &geometry), 1e-12, "in J");
        assert_close!(
            given.pace(&pair, &geometry).square,
            Hertz {}.pace(&pair, &geometry).square,
            1e-12,
            "in 1/s²"
        );
    }
}

/// Every name stands for what its page says: grains of 1 mm and 4 mm, 1 mg and 2 mg.
#[test]
fn names_stand_for_what_they_say() {
    let pair = PairConstants { effective_modulus: 3e9, ..PairConstants::default() };
    let rows = [
        ("overlap", 1e-5),
        ("speed", -0.3),
        ("radius_sum", 5e-3),
        ("effective_radius", 0.8e-3),
        ("smaller_radius", 1e-3),
        ("larger_radius", 4e-3),
        ("effective_mass", 2e-6 / 3.0),
        ("effective_modulus", 3e9),
        ("contact_stiffness", 2e7),
    ];
    for (name, wanted) in rows {
        assert_close!(law(name, None, None).force(&pair, &geometry(1e-5), -0.3), wanted, 1e-14, "{name}");
    }
    assert_eq!(OfPair::ALL.len(), rows.len());
}

/// k δ + c v: ω² = k/m*, Γ = c/m*, and the critical step 2/(Γ + √(Γ² + ω²)) by hand.
#[test]
fn the_critical_step_is_that_of_the_slopes() {
    let (pair, geometry) = (PairConstants::default(), geometry(1e-5));
    let pace = law("2e4*overlap + 3*speed", None, None).pace(&pair, &geometry);
    let (square, rate) = (2e4 / geometry.effective_mass, 3.0 / geometry.effective_mass);
    assert_close!(pace.critical_step(), 2.0 / (rate + (rate * rate + square).sqrt()), 1e-14, "in s");
    // A spring that is stiffest half way: sin has its steepest slope at 0.
    let pace = law("2e-2*sin(1e6*overlap)", None, None).pace(&pair, &geometry);
    assert_close!(
        pace.square,
        2e4 * (0.2_f64).cos() / geometry.effective_mass,
        1e-12,
        "at a 50th of the way"
    );
}

/// What is beyond rest is the part with the speed, and nothing where there is none.
#[test]
fn the_rest_is_elastic() {
    let (pair, geometry) = (PairConstants::default(), geometry(1e-5));
    let dashpot = law("2e4*overlap + 3*speed*abs(speed)", None, None);
    assert_close!(dashpot.beyond_rest(&pair, &geometry, -0.5), -0.75, 1e-13, "in N");
    assert_eq!(law("2e4*overlap", None, None).beyond_rest(&pair, &geometry, -0.5), 0.0);
    let force = |overlap| dashpot.force(&pair, &ContactGeometry { overlap, ..geometry }, 0.0);
    assert_slope(1e-5, |overlap| dashpot.energy(&pair, &ContactGeometry { overlap, ..geometry }), force);
}

/// -k (δ + ℓ) from δ = -ℓ on stores -k (δ + ℓ)²/2, given up to a constant or integrated.
#[test]
fn energy_begins_where_the_force_does() {
    let pair = PairConstants::default();
    for energy in [None, Some("7 - 1e3/2*(overlap + 1e-4)^2")] {
        let law = law("-1e3*(overlap + 1e-4)", energy, Some(1e-4));
        for overlap in [-1e-4, -3e-5, 0.0, 2e-5] {
            let wanted = -500.0 * (overlap + 1e-4) * (overlap + 1e-4);
            assert_near!(law.energy(&pair, &geometry(overlap)), wanted, 1e-14, "in J");
        }
    }
}

/// A thousandth in the energy is told, a ten-millionth is rounding; a kink, a pole and a root of what is negative are told with
/// where they are.
#[test]
fn what_is_wrong_is_found_by_trying() {
    let spring = |energy: &str| told_by(&law("2e4*overlap", Some(energy), None));
    assert_eq!(spring("1e4*overlap^2"), "");
    assert_eq!(spring("1.0000001e4*overlap^2"), "");
    assert_contains!(spring("1.001e4*overlap^2"), "is not the energy of the force: at an overlap of");
    assert_contains!(spring("speed"), "cannot name speed");
    assert_contains!(told_by(&law("1/(overlap - 2e-4)", None, None)), "is infinite at an overlap of 200 um");
    assert_contains!(told_by(&law("sqrt(-overlap)", None, None)), "is not a number at an overlap of");
    assert_contains!(told_by(&law("overlap + ln(speed + 0.5)", None, None)), "and a speed of -1 m/s");
    assert_contains!(told_by(&law("overlap^0.5", None, Some(1e-4))), "is not a number at an overlap of -");
    assert_contains!(
        told_by(&law("2e4*overlap - speed", None, None)),
        "drives grains instead of slowing them"
    );
    assert_contains!(told_by(&law("2e4*overlap - 1", None, None)), "jumps to -1 N where it begins to act");
}
