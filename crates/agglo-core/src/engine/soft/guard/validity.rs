//! Where a run leaves the range of its models. These are warnings: the run goes on as it would without them.

use crate::acoustics::{Beam, Medium};
use crate::contact::Bonds;
use crate::contact::network::Network;
use crate::fields::Drag;
use crate::particles::Particles;

use crate::engine::soft::forces::laws::Laws;

/// Below this wave number times radius sound goes around a grain.
const SMALLEST_KA: f64 = 10.0;

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

/// A warning where no grains are bonded by a law that bonds neighbors at the start.
pub fn of_bonds(law: Option<&Bonds>, network: &Network) -> Option<&'static str> {
    let law = law?.lasting()?;
    (network.made_at_start() == 0 && law.forming_strain.is_none()).then_some(
        "bonds.beam: no bond was made, since no two grains are closer than bonds.beam.gap, or none was left in the run \
         of start.from; nothing holds the grains together",
    )
}

/// A warning for each beam whose frequency is too low for rays at the smallest grain.
pub fn of_rays(beams: &[Beam], medium: &Medium, grains: &Particles) -> Vec<String> {
    let smallest = grains.radius.iter().copied().fold(f64::INFINITY, f64::min);
    let warning = |(beam, number): (&Beam, usize)| {
        let ka = medium.wavenumber_radius(beam.frequency?.si(), smallest);
        (ka < SMALLEST_KA).then(|| {
            format!(
                "acoustics.beams.{number}: k a is {ka:.3e} at the smallest grain; rays do not hold below 10, where sound \
                 goes around grains"
            )
        })
    };
    beams.iter().zip(0..).filter_map(warning).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::soft::Settings;
    use crate::testing::Scenario;
    use crate::units::Frequency;

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

    /// k a = 2 π f R/c = 10 at 2.387 MHz for 1 mm in water at 1500 m/s; the larger grain does not count.
    #[test]
    fn rays_warn_below_their_frequency() {
        let text = include_str!("../../../../../../scenarios/acoustic-dispersal-published.toml");
        let beam = Scenario::from_toml(text).unwrap().acoustics().unwrap().beams[0].clone();
        let bound = 10.0 * 1500.0 / (std::f64::consts::TAU * 1e-3);
        let hertz = |number: f64| serde_json::from_str::<Frequency>(&format!("\"{number} Hz\"")).unwrap();
        let with = |frequency: Option<f64>| Beam { frequency: frequency.map(hertz), ..beam.clone() };
        let beams = [with(Some(1.005 * bound)), with(Some(0.995 * bound)), with(None)];
        let grains = Particles { radius: vec![3e-3, 1e-3], ..Particles::default() };
        let warnings = of_rays(&beams, &Medium::default(), &grains);
        assert_eq!(warnings.len(), 1);
        assert!(warnings[0].starts_with("acoustics.beams.1: k a is 9.950e0"), "{}", warnings[0]);
    }
}
