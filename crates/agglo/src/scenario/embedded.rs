//! From a scenario to grains that are embedded in a flow.

use crate::engine::hard::{EmbeddedError, Microscale, Settings};
use crate::packing::{ConstantSize, Fill, GrainGroup, Placement, Size};
use crate::units::Quantity;

use super::Scenario;

/// Radius of a grain that stands for all, over the shortest edge of the volume, while a scenario is held to its rules.
const SAMPLE: f64 = 1e-3;

impl TryFrom<&Scenario> for Microscale {
    type Error = EmbeddedError;

    /// Takes engine, laws, materials, volume and seed of a scenario. Its grains, its length and its output have no meaning
    /// here; there need be no grains.
    ///
    /// # Errors
    /// [`EmbeddedError::Scenario`] where it breaks the rules of hard spheres, all materials taken to be used;
    /// [`EmbeddedError::Run`] where it is one of soft spheres.
    fn try_from(scenario: &Scenario) -> Result<Self, EmbeddedError> {
        let settings = Settings::try_from(scenario)?;
        let edges = settings.volume.edges().to_array();
        let radius = SAMPLE * edges.into_iter().fold(f64::INFINITY, f64::min);
        let grains = scenario.materials.keys().map(|name| sample(name, radius)).collect();
        let all_used = Scenario { grains, ..scenario.clone() };
        all_used.check().map_err(|faults| EmbeddedError::Scenario(faults.into()))?;
        Ok(Self::new(settings))
    }
}

/// One grain of a material, so that the rules look at what it needs.
fn sample(material: &str, radius: f64) -> GrainGroup {
    GrainGroup {
        material: material.to_owned(),
        size: Size::Constant(ConstantSize { radius: Quantity(radius) }),
        placement: Placement::Fill(Fill { count: Some(1), solid_fraction: None, gap: Quantity(0.0) }),
        velocity: [Quantity(0.0); 3],
        velocity_spread: None,
        spin: [Quantity(0.0); 3],
        temperature: Quantity(300.0),
        charge: Quantity(0.0),
        polarity: 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::SimError;

    /// All materials are held to what the laws need, used by a group or not.
    #[test]
    fn a_scenario_that_lacks_something_is_refused() {
        let text = r#"
            version = 1
            time.end = "1 s"
            [engine.event_driven]
            [volume]
            lower = ["-5 mm", "-5 mm", "-5 mm"]
            upper = ["5 mm", "5 mm", "5 mm"]
            [materials]
            clay = { density = "2000 kg/m3" }
            lead = { density = "11000 kg/m3" }
            [impact.restitution.constant]
            restitution = 1.0
            [[grains]]
            material = "clay"
            size.constant.radius = "0.5 mm"
            placement.fill.count = 1
        "#;
        let mut scenario = Scenario::from_toml(text).unwrap();
        scenario.impact = None;
        assert_matches!(Microscale::try_from(&scenario), Err(EmbeddedError::Run(SimError::OtherSpheres(_))));
        let law = r#"{"restitution": {"hardness": {}}}"#;
        scenario.impact = serde_json::from_str(law).unwrap();
        let message = Microscale::try_from(&scenario).unwrap_err().to_string();
        assert_contains!(message, "materials.lead");
        assert_contains!(message, "materials.clay");
    }
}
