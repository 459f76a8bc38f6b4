//! What a contact and a bond remember turns with the pair about its axis: by the mean of both angular velocities, in
//! space.

use super::Simulation;
use super::saved_contacts::SavedContacts;
use crate::contact::friction::TangentialSpring;
use crate::math::Vec3;
use crate::testing::Scenario;

/// Two grains of unlike size, so heavy that no load moves them, pressed together along x.
const HEAVY: &str = r#"
version = 1
time.end = "1 s"
engine.verlet.step = "50 us"
[limits]
drift_error = 1e30
[materials.a]
density = "1e20 kg/m3"
[materials.b]
density = "3e20 kg/m3"
[[grains]]
material = "a"
size.constant.radius = "1 mm"
placement.list.positions = [["0 m", "0 m", "0 m"]]
[[grains]]
material = "b"
size.constant.radius = "2 mm"
placement.list.positions = [["2.99 mm", "0 m", "0 m"]]
[contact.normal.hooke]
stiffness = "1 kN/m"
[contact.friction.mindlin]
static_friction = 1e9
stiffness_ratio = 0.8
[bonds.beam]
youngs_modulus = "1 MPa"
tensile_strength = "1 GPa"
shear_strength = "1 GPa"
gap = 0.1
"#;

#[test]
fn memory_turns_with_the_mean_of_both_spins() {
    let scenario = Scenario::from_toml(HEAVY).unwrap_or_else(|faults| panic!("{faults}"));
    let mut grains = crate::testing::place(&scenario).unwrap();
    // 30 and 10 rad/s about the axis: after 1000 steps of 50 us the mean has turned by 1 rad.
    grains.angular_velocity = vec![Vec3::AXES[0] * 30.0, Vec3::AXES[0] * 10.0];
    let started = Simulation::start(&scenario, grains).unwrap_or_else(|error| panic!("{error}"));
    let mut state = started.state();
    let [y, z] = [Vec3::AXES[1], Vec3::AXES[2]];
    let (a, b, kept) = state.contacts.by_ids()[0];
    let spring = TangentialSpring { force: y * 1e-3, sliding: false, ..kept };
    state.contacts = SavedContacts::AtHand(vec![(a, b, spring)]);
    let bond = &mut state.bonds.to_mut()[0].state;
    (bond.shear, bond.bending) = (y * 2e-3, z * 3e-6);
    let mut simulation = Simulation::resume(&scenario, state).unwrap_or_else(|error| panic!("{error}"));
    for _ in 0..1000 {
        simulation.step().unwrap_or_else(|error| panic!("{error}"));
    }
    let (sine, cosine) = 1.0_f64.sin_cos();
    let (along, aside) = (y * cosine + z * sine, z * cosine - y * sine);
    let spring = simulation.system.remembered()[0].2.force;
    let bond = simulation.system.network.bonds()[0].state;
    // The spring turns by the arc tangent of its angle in a step, 1e-3: off by a third of its cube, a thousand times.
    for (name, unit, found, wanted, tolerance) in [
        ("spring of the contact", "N", spring, along * 1e-3, 1e-6),
        ("shear of the bond", "N", bond.shear, along * 2e-3, 1e-9),
        ("bending of the bond", "N m", bond.bending, aside * 3e-6, 1e-9),
    ] {
        let off = (found - wanted).norm() / wanted.norm();
        let (found, wanted) = (found.to_array(), wanted.to_array());
        assert!(
            off < tolerance,
            "{name}: found {found:?} {unit}, expected {wanted:?} {unit}, off by {off:.1e}"
        );
    }
    // The second turns back against the first by 20 rad/s: k_s J of 1 rad.
    let disc = std::f64::consts::PI * 1e-12 / 2.0;
    let wanted = -0.4 * 1e6 / 2.99e-3 * disc * 1.0;
    assert!(
        (bond.twist / wanted - 1.0).abs() < 1e-9,
        "twist: found {} N m, expected {wanted} N m",
        bond.twist
    );
}
