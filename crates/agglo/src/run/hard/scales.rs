//! How far a run of hard spheres is from where its models end: quantities of its grains at the end.

use crate::acoustics::Medium;
use crate::engine::hard::Snapshot;
use crate::impact::self_gravity::critical_radius;
use crate::impact::softening::Hardness;
use crate::measure::biot_number;
use crate::particles::Material;
use crate::scenario::Scenario;

/// Quantities that say whether models hold; those that cannot be had are left out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scales {
    /// Radius [m] at which the largest grain's own gravity would matter ([B] 4.16).
    pub self_gravity_radius: Option<f64>,
    /// Largest Biot number: one temperature for a grain holds below 0.1.
    pub biot: Option<f64>,
    /// Largest Reynolds number in the medium at rest, where the scenario names one that is not the default.
    pub reynolds: Option<f64>,
}

impl Scales {
    /// Takes the quantities; `largest` is the place of the largest grain in the snapshot.
    pub fn of(scenario: &Scenario, now: &Snapshot, largest: usize) -> Self {
        let materials: Vec<&Material> = scenario.materials.values().collect();
        let places = 0..now.grains.len();
        let most = |quantities: &mut dyn Iterator<Item = f64>| quantities.reduce(f64::max);
        let medium = (scenario.medium != Medium::default()).then_some(&scenario.medium);
        let reynolds = |at: usize, medium: &Medium| {
            medium.reynolds_number(now.grains.radius[at], now.grains.velocity[at].norm())
        };
        Self {
            self_gravity_radius: self_gravity_radius(&materials, now, largest),
            biot: most(&mut places.clone().filter_map(|at| biot(scenario, &materials, now, at))),
            reynolds: medium.and_then(|medium| most(&mut places.filter_map(|at| reynolds(at, medium)))),
        }
    }
}

fn self_gravity_radius(materials: &[&Material], now: &Snapshot, at: usize) -> Option<f64> {
    let material = materials.get(*now.grains.material.get(at)? as usize)?;
    let hardness = Hardness::of(material)?.at(now.grains.temperature[at]);
    Some(critical_radius(material.density.si(), hardness))
}

fn biot(scenario: &Scenario, materials: &[&Material], now: &Snapshot, at: usize) -> Option<f64> {
    let cooling = scenario.impact()?.cooling.as_ref()?;
    let material = materials.get(now.grains.material[at] as usize)?;
    let (radius, temperature) = (now.grains.radius[at], now.grains.temperature[at]);
    let conductivity = material.thermal_conductivity?.si();
    let emissivity = material.emissivity.unwrap_or(0.0);
    biot_number(radius, conductivity, cooling.convection.si(), emissivity, temperature)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::particles::Row;

    const SCENARIO: &str = r#"
version = 1
time.end = "1 s"
engine.event_driven = {}
grains = []
[volume]
lower = ["0 m", "0 m", "0 m"]
upper = ["1 m", "1 m", "1 m"]
[materials.a]
density = "1 kg/m3"
[materials.b]
density = "2000 kg/m3"
hardness = "1 MPa"
emissivity = 0.5
thermal_conductivity = "2 W/(m K)"
[impact.restitution.hardness]
[impact.cooling]
convection = "20 W/(m2 K)"
"#;

    fn scenario(more: &str) -> Scenario {
        toml::from_str(&(SCENARIO.to_owned() + more)).unwrap()
    }

    fn grains() -> Snapshot {
        let mut now = Snapshot::default();
        for (material, radius, temperature) in [(0, 1.0, 5000.0), (1, 6e-3, 1000.0), (1, 7e-3, 300.0)] {
            let velocity = Vec3::new(0.0, 0.0, 3.0 / radius);
            now.grains.push(Row { velocity, radius, material, temperature, ..Row::default() });
            now.primaries.push(1);
        }
        now
    }

    /// Bi = (20 + 4 σ 0.5 1e9) 6e-3/(3 2), the other one is colder; b = (3/2000) sqrt(1e6/(2 π 6.6743e-11)) = 73.2 km.
    #[test]
    fn quantities_by_hand() {
        let scales = Scales::of(&scenario(""), &grains(), 2);
        assert_close!(scales.biot.unwrap(), 0.133_407_488_38, 1e-12);
        let radius = 1.5e-3 * (1e6 / (std::f64::consts::TAU * 6.6743e-11)).sqrt();
        assert_close!(scales.self_gravity_radius.unwrap(), radius, 1e-12, "in m");
        // Water, the default, is not taken for the gas that hard spheres fly in.
        assert_eq!(scales.reynolds, None);
        let first = Scales::of(&scenario(""), &grains(), 0);
        assert_eq!(
            (first.self_gravity_radius, first.biot),
            (None, scales.biot),
            "whichever grain is the largest"
        );
    }

    /// 2 r v is 6 m²/s for all: in air of 1.2 kg/m³ and 18 uPa s 6 1.2/1.8e-5 = 4e5.
    #[test]
    fn a_medium_that_is_named_has_a_reynolds_number() {
        let air = "[medium]\ndensity = \"1.2 kg/m3\"\nsound_speed = \"340 m/s\"\nviscosity = \"18 uPa s\"\n";
        let found = Scales::of(&scenario(air), &grains(), 0).reynolds.unwrap();
        assert!((found / 4e5 - 1.0).abs() < 1e-12, "{found}");
    }

    #[test]
    fn no_grains_have_no_quantities() {
        assert_eq!(Scales::of(&scenario(""), &Snapshot::default(), 0), Scales::default());
    }
}
