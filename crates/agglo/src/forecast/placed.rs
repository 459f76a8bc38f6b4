//! Notes on grains as they are placed, which no key tells by itself.

use crate::contact::Bonds;
use crate::contact::network::Network;
use crate::engine::Start;
use crate::engine::soft::truncation;
use crate::particles::Particles;
use crate::scenario::Scenario;
use crate::text::digits;

pub(super) fn notes(notes: &mut Vec<String>, scenario: &Scenario, start: &Start) {
    let grains = &start.grains;
    notes.extend(bonds(scenario, start));
    notes.extend(region(scenario, grains));
    notes.extend(cutoff(scenario, grains));
}

/// Bonds that find no neighbors.
fn bonds(scenario: &Scenario, start: &Start) -> Option<String> {
    let bonds = scenario.soft()?.bonds.as_ref();
    let Some(Bonds::Beam(law)) = bonds else { return None };
    let network = Network::start(Some(law), start.bonds.clone(), &start.grains, &scenario.space());
    law.warning(network.made_at_start()).map(str::to_owned)
}

/// Grains that lie outside the region of rays.
fn region(scenario: &Scenario, grains: &Particles) -> Option<String> {
    let region = scenario.acoustics()?.region.as_ref()?;
    let is_outside = |at: &usize| !region.contains(grains.position[*at], grains.radius[*at]);
    let (outside, all) = ((0..grains.len()).filter(is_outside).count(), grains.len());
    (outside > 0).then(|| {
        format!(
            "acoustics.region leaves {outside} of {all} grains outside at the start: rays that leave it are lost to them; \
             without the key rays live until they can hit nothing any more"
        )
    })
}

/// What the cut-off of the near field leaves out.
fn cutoff(scenario: &Scenario, grains: &Particles) -> Option<String> {
    let law = scenario.soft()?.fields.near_field.as_ref()?;
    let found = truncation(law, grains, &scenario.space())?;
    let part = digits(100.0 * found.forces);
    let verdict = if found.forces > law.truncation { "the run will refuse it" } else { "that is allowed" };
    let energy = found.energy.map_or(String::new(), |energy| {
        format!("; the energy of the pairs within it is {} times that of all", digits(energy))
    });
    Some(format!(
        "fields.near_field.cutoff leaves out {part} % of the forces on the grains as they are placed; {verdict}{energy}"
    ))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::packing::place;

    /// Grains of 1 mm, 2.2 mm apart from center to center along x from 0 on, under these tables.
    fn found(count: u32, more: &str) -> Vec<String> {
        let places: Vec<String> =
            (0..count).map(|k| format!("[\"{} mm\", \"0 m\", \"0 m\"]", 2.2 * f64::from(k))).collect();
        let sound = if more.contains("acoustics") { "sound_speed = \"5000 m/s\"\n" } else { "" };
        let text = format!(
            "version = 1\ntime.end = \"1 ms\"\nengine.verlet.step = \"1 us\"\n[materials.glass]\n\
             density = \"2500 kg/m3\"\n{sound}youngs_modulus = \"1 GPa\"\npoisson_ratio = 0.2\n\
             [[grains]]\nmaterial = \"glass\"\ncharge = \"1 nC\"\nsize.constant.radius = \"1 mm\"\n\
             placement.list.positions = [{}]\n[contact.normal.hertz]\n{more}",
            places.join(", ")
        );
        let scenario = Scenario::from_toml(&text).unwrap();
        let mut all = Vec::new();
        notes(&mut all, &scenario, &place(&scenario, Path::new("")).unwrap().into());
        all
    }

    /// Surfaces are 0.2 of a radius apart.
    #[test]
    fn bonds_that_find_no_neighbors_are_told() {
        let beam = |gap: f64| {
            format!(
                "[bonds.beam]\nyoungs_modulus = \"1 GPa\"\ntensile_strength = \"1 MPa\"\nshear_strength = \"1 MPa\"\n\
                 gap = {gap}\n"
            )
        };
        let told = found(3, &beam(0.199));
        assert!(told.len() == 1 && told[0].contains("no bond was made"), "{told:?}");
        assert_eq!(found(3, &beam(0.201)), [""; 0]);
    }

    /// Of grains at 0, 2.2, 4.4, 6.6 and 8.8 mm the ball about the first holds three whole: 4.4 mm + 1 mm.
    #[test]
    fn grains_outside_the_region_of_rays_are_counted() {
        let beam = |radius: f64| {
            format!(
                "[acoustics]\nregion.sphere = {{ center = [\"0 m\", \"0 m\", \"0 m\"], radius = \"{radius} mm\" }}\n\
                 [acoustics.force.impulse]\nduration = \"1 us\"\n[[acoustics.beams]]\n\
                 start = [\"0 m\", \"-2 mm\", \"0 m\"]\ndirection = [0.0, 1.0, 0.0]\nradius = \"1 mm\"\nrays = 10\n\
                 strength.pressure = \"1 MPa\"\n"
            )
        };
        let told = found(5, &beam(5.5));
        assert!(told.len() == 1 && told[0].contains("leaves 2 of 5 grains outside"), "{told:?}");
        assert_eq!(found(5, &beam(9.9)), [""; 0]);
    }

    /// Four equal charges cut off at 1.5 times their distance, as in `engine/soft/forces/truncation.rs`: sqrt(250/2482) of the
    /// forces is left out, and 3/13 of the energy is left.
    #[test]
    fn a_cutoff_is_measured() {
        let field = |limit: f64| {
            format!(
                "[fields.near_field]\ncutoff = \"3.3 mm\"\ntruncation = {limit}\n\
                 law.coulomb.relative_permittivity = 80.0\n"
            )
        };
        let told = found(4, &field(0.3));
        assert!(
            told.len() == 1 && told[0].contains("31.74 % of the forces") && told[0].contains("refuse"),
            "{told:?}"
        );
        assert!(told[0].contains("is 0.2308 times"), "{told:?}");
        assert_contains!(found(4, &field(0.4))[0], "allowed");
    }
}
