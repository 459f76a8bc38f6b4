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
    /// # Example
    /// ```
    /// use agglo::engine::hard::{MicroGrains, Microscale};
    /// use agglo::math::Vec3;
    /// use agglo::scenario::Scenario;
    ///
    /// let scenario = Scenario::from_toml(r#"
    ///     version = 1
    ///     time.end = "1 s"              # not used: the caller says how long
    ///     [engine.event_driven]
    ///     [volume]
    ///     lower = ["0 mm", "0 mm", "0 mm"]
    ///     upper = ["10 mm", "10 mm", "10 mm"]
    ///     [materials.clay]
    ///     density = "2000 kg/m3"
    ///     heat_capacity = "1000 J/kg/K"
    ///     [impact.restitution.constant]
    ///     restitution = 0.0             # all that touch stick
    ///     [[grains]]                    # not used: the caller says which grains
    ///     material = "clay"
    ///     size.constant.radius = "0.5 mm"
    ///     placement.fill.count = 1
    /// "#)?;
    /// let microscale = Microscale::try_from(&scenario)?;
    /// let mut state = microscale.state(&MicroGrains {
    ///     radii: vec![5e-4; 2],
    ///     velocities: vec![Vec3::new(1.0, 0.0, 0.0), Vec3::ZERO],
    ///     temperatures: vec![300.0; 2],
    ///     positions: vec![Vec3::new(2e-3, 5e-3, 5e-3), Vec3::new(4e-3, 5e-3, 5e-3)],
    ///     ..MicroGrains::default()
    /// })?;
    /// for _ in 0..2 {
    ///     let (next, means) = microscale.step(&state, 1e-3)?;
    ///     println!("{} grains, {} K", means.grains, means.mean_temperature);
    ///     state = next;
    /// }
    /// // They collided after 1 ms, at the end of the first step or in the second, and fly on as one at half the speed.
    /// assert_eq!((state.grains.len(), state.grown[0].primaries), (1, 2));
    /// assert!((state.grains.velocity[0].x - 0.5).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
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
        angular_velocity: [Quantity(0.0); 3],
        temperature: Quantity(300.0),
        charge: Quantity(0.0),
        polarity: 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::SimError;
    use crate::scenario::template;

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
        let law = r#"{"restitution": {"hardness": {}}}"#;
        scenario.hard_mut().unwrap().impact = serde_json::from_str(law).unwrap();
        let message = Microscale::try_from(&scenario).unwrap_err().to_string();
        assert_contains!(message, "materials.lead");
        assert_contains!(message, "materials.clay");
    }

    #[test]
    fn soft_spheres_are_refused() {
        let scenario = Scenario::from_toml(template("acoustic").unwrap().text).unwrap();
        assert_matches!(Microscale::try_from(&scenario), Err(EmbeddedError::Run(SimError::OtherSpheres(_))));
    }
}
