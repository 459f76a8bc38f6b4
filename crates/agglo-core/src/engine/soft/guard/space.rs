//! Whether space that repeats itself is such as the engine can follow: wide enough, so that two grains meet in one of their images
//! alone, and without what cannot go across its faces.

use crate::contact::ContactLaws;
use crate::domain::{Boundary, Deformation, Volume, volume_of_spheres};
use crate::engine::SimError;
use crate::engine::soft::settings::Settings;
use crate::particles::Particles;
use crate::units::{Frequency, Length};

/// The axes, as they are named.
const AXES: [char; 3] = ['x', 'y', 'z'];

/// Holds the periods of space to how far grains reach, and its faces to what can cross them.
///
/// # Errors
/// [`SimError::ForeignVolume`] and [`SimError::AbsorbsInDeformation`] where faces are none that soft spheres know, or go with nothing else;
/// [`SimError::NarrowSpace`] where half a period is not above the longest distance of centers at which grains act on one another,
/// [`SimError::RaysInDeformation`] and [`SimError::RegionAcrossFaces`] where rays cannot follow space, [`SimError::WallAcrossFaces`] and [`SimError::WallsInDeformation`] where walls
/// cannot follow space, [`SimError::DeformsAway`] and [`SimError::DeformsOpenSpace`] where a deformation leads nowhere.
pub fn hold(settings: &Settings, grains: &Particles) -> Result<(), SimError> {
    let space = settings.space();
    if let Some(volume) = &settings.volume {
        hold_faces(volume)?;
        if let Some(law) = &volume.deformation {
            hold_deformation(law, volume, grains)?;
        }
    }
    if !space.repeats() {
        return Ok(());
    }
    if let Some(acoustics) = &settings.acoustics {
        let is_deformed = settings.volume.as_ref().is_some_and(|volume| volume.deformation.is_some());
        if is_deformed {
            return Err(SimError::RaysInDeformation);
        }
        if acoustics.region.is_some() {
            return Err(SimError::RegionAcrossFaces);
        }
    }
    for wall in &settings.walls {
        if let Some(axis) = wall.cut_by(&space) {
            return Err(SimError::WallAcrossFaces { wall: wall.name.clone(), axis: AXES[axis] });
        }
    }
    let is_deformed = settings.volume.as_ref().is_some_and(|volume| volume.deformation.is_some());
    if is_deformed && !settings.walls.is_empty() {
        return Err(SimError::WallsInDeformation);
    }
    let largest = grains.radius.iter().copied().fold(0.0, f64::max);
    let beyond = settings.contact.as_ref().map_or(0.0, ContactLaws::reach);
    let gap = settings.beam().map_or(0.0, |law| law.gap * largest);
    let near_field = settings.fields.near_field.as_ref();
    let cutoff = near_field.map_or(0.0, |law| law.cutoff.map_or(f64::INFINITY, Length::si));
    let reach = (2.0 * largest + beyond.max(gap)).max(cutoff);
    let last = settings.space_in_time(grains).at(settings.end);
    let period = space.shortest_period().min(last.shortest_period());
    if 2.0 * reach < period { Ok(()) } else { Err(SimError::NarrowSpace { period, reach }) }
}

/// Antipodal faces are of hard spheres, and who is taken out of a volume leaves its solid fraction another.
fn hold_faces(volume: &Volume) -> Result<(), SimError> {
    let has = |wanted: Boundary| volume.boundaries().contains(&wanted);
    if has(Boundary::Antipodal) {
        return Err(SimError::ForeignVolume { what: "antipodal faces", spheres: "soft" });
    }
    if has(Boundary::Absorbing) && volume.deformation.is_some() {
        return Err(SimError::AbsorbsInDeformation);
    }
    Ok(())
}

fn hold_deformation(law: &Deformation, volume: &Volume, grains: &Particles) -> Result<(), SimError> {
    let axes = law.strain_rate.map(Frequency::si).into_iter().zip(volume.repeats()).zip(AXES);
    if let Some((_, axis)) = axes.into_iter().find(|((rate, repeats), _)| *rate != 0.0 && !repeats) {
        return Err(SimError::DeformsOpenSpace(axis));
    }
    let solid = volume_of_spheres(grains.radius.iter().copied());
    match law.solid_fraction.filter(|_| law.end(volume.volume(), solid).is_none()) {
        Some(wanted) => Err(SimError::DeformsAway { now: solid / volume.volume(), wanted }),
        None => Ok(()),
    }
}
