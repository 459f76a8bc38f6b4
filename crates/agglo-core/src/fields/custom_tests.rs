//! Formulas of fields: parts, slopes, and what is told of them.

use super::*;
use crate::testing::told_by;

fn law(force: [&str; 3], energy: Option<&str>) -> Custom {
    Custom { energy: energy.map(Written::new), ..Custom::new(force) }
}

fn grain() -> Grain {
    Grain {
        position: Vec3::new(0.5, -2.0, 3.0),
        velocity: Vec3::new(4.0, 5.0, -6.0),
        mass: 0.7,
        radius: 0.2,
        charge: -0.3,
        density_ratio: 0.0,
        time: 0.25,
    }
}

#[test]
fn names_stand_for_what_they_say() {
    let rows = [
        ("x", 0.5),
        ("y", -2.0),
        ("z", 3.0),
        ("vx", 4.0),
        ("vy", 5.0),
        ("vz", -6.0),
        ("t", 0.25),
        ("radius", 0.2),
        ("mass", 0.7),
        ("charge", -0.3),
    ];
    for (name, wanted) in rows {
        assert_eq!(law(["0", name, "0"], None).force(&grain()), Vec3::new(0.0, wanted, 0.0), "{name}");
    }
    assert_eq!(OfGrain::ALL.len(), rows.len());
}

/// Work from outside is that of the force at rest, or what an energy changes by in time; the rest is drag.
#[test]
fn parts_are_booked_where_they_belong() {
    let force = ["-2*x*t - 3*vx", "0", "-3*vz*abs(vz)"];
    let drag = Vec3::new(-12.0, 0.0, 3.0 * 36.0);
    for (energy, power) in [(None, -0.25 * 4.0), (Some("x^2*t"), 0.25)] {
        let [outside, moving] = law(force, energy).parts(&grain()).map(Option::unwrap);
        assert_eq!(
            (outside.channel, outside.force, outside.power),
            (Channel::Field, Vec3::new(-0.25, 0.0, 0.0), power)
        );
        assert_eq!((moving.channel, moving.force, moving.power), (Channel::Drag, drag, -48.0 - 648.0));
    }
    let [_, moving] = law(["x", "y", "z"], None).parts(&grain());
    assert_none!(moving);
    assert_eq!(FieldLaw::energy(&law(["0", "0", "0"], Some("x^2*t")), &grain()), 0.0625);
}

/// A trap, a drag and a rotation have their closed forms: k/m, c/m, q B/m; a sum of them those sums.
#[test]
fn paces_in_closed_form() {
    let pace = |force: [&str; 3]| law(force, None).pace(&grain(), 0.5);
    assert_eq!(pace(["-8*x", "-8*y", "-8*z"]), Pace { square: 16.0, rate: 0.0 });
    assert_eq!(pace(["-8*x", "2*y", "0"]), Pace { square: 16.0, rate: 0.0 });
    assert_eq!(pace(["-3*vx", "-3*vy", "-3*vz"]), Pace { square: 0.0, rate: 6.0 });
    assert_eq!(pace(["3*vy", "-3*vx", "0"]), Pace { square: 0.0, rate: 6.0 });
    assert_eq!(pace(["-8*x - vx", "-8*y - vy", "-8*z - vz"]), Pace { square: 16.0, rate: 2.0 });
}

/// An energy is held to the force at rest, at any time; a pole is none of the formula's business where no grain is.
#[test]
fn what_is_wrong_is_found_by_trying() {
    let trap = ["-2*x*exp(-t)", "-4*y*exp(-t)", "-vz"];
    assert_eq!(told_by(&law(trap, Some("(x^2 + 2*y^2)*exp(-t)"))), "");
    assert_contains!(
        told_by(&law(trap, Some("(x^2 + 2.01*y^2)*exp(-t)"))),
        "energy: is not the energy of the force: at ("
    );
    assert_contains!(told_by(&law(trap, Some("x^2 + 2*y^2"))), "is not the energy of the force");
    assert_contains!(told_by(&law(["-y", "x", "0"], Some("x*y"))), "along ");
    assert_contains!(told_by(&law(trap, Some("vx^2"))), "cannot name vx");
    assert_eq!(told_by(&law(["1/x^2", "1/(1e-3 - x)", "0"], None)), "");
    assert_contains!(
        told_by(&law(["sqrt(-1 - x^2)", "0", "0"], None)),
        "force.0: \"sqrt(-1 - x^2)\" is infinite or not a number"
    );
    let unknown = told_by(&law(["u", "0", "2 N"], None));
    assert_contains!(unknown, "force.0: \"u\" uses \"u\"; a formula here knows x [m], y [m]");
    assert_contains!(
        unknown,
        "force.2: \"2 N\" is not a formula: an operator is missing before \"N\"; it is in SI units"
    );
}
