//! Where grains leave the range of their law of drag. That is a warning: the run goes on as it would without it.

use crate::fields::Drag;
use crate::particles::Particles;

use crate::engine::soft::forces::laws::Laws;

/// A warning where a grain is too fast for the law of drag at `time` [s].
pub fn of_drag(laws: &Laws, grains: &Particles, time: f64) -> Option<&'static str> {
    let drag = laws.fields.drag.as_ref()?;
    let validity = drag.law.validity();
    let is_above = |at: usize| {
        let flow = laws.flow_at(grains.position[at], time);
        Drag::reynolds(&laws.medium, grains.radius[at], grains.velocity[at], &flow) > validity.reynolds
    };
    (0..grains.len()).any(is_above).then_some(validity.warning)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::soft::Settings;
    use crate::testing::Scenario;

    /// One grain of 1 mm radius in water (ρ = 1000 kg/m³, η = 1 mPa s) at a speed [m/s]: Re = 2000 v.
    fn warning(law: &str, speed: f64) -> Option<&'static str> {
        let text = format!(
            "version = 1\ntitle = \"one\"\ntime.end = \"1 s\"\nengine.verlet.step = \"1 ms\"\n\
             medium = {{ density = \"1000 kg/m3\", sound_speed = \"1500 m/s\", viscosity = \"1 mPa s\" }}\n\
             materials.glass.density = \"2500 kg/m3\"\nfields.drag.law = \"{law}\"\n\
             [[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"1 mm\"\n\
             placement.list = {{ positions = [[\"0 m\", \"0 m\", \"0 m\"]], \
             velocities = [[\"0 m/s\", \"{speed} m/s\", \"0 m/s\"]] }}\n"
        );
        let scenario = Scenario::from_toml(&text).unwrap();
        let grains = crate::testing::place(&scenario).unwrap();
        of_drag(&Laws::new(&Settings::try_from(&scenario).unwrap(), &grains), &grains, 0.0)
    }

    /// Half a per cent below and above the bounds.
    #[test]
    fn drag_warns_from_its_reynolds_number_on() {
        assert_eq!(warning("stokes", 0.995 * 1.0 / 2000.0), None);
        assert_contains!(warning("stokes", 1.005 * 1.0 / 2000.0).unwrap(), "above 1,");
        assert_eq!(warning("schiller_naumann", 0.995 * 0.5), None);
        assert_contains!(warning("schiller_naumann", 1.005 * 0.5).unwrap(), "above 1000");
    }
}
