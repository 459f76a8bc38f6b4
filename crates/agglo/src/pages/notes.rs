//! What to say of words that stand for something else than one would think, or for nothing yet.

/// Words, and what is said of them.
pub(super) const NOTES: [(&[&str], &str); 6] = [
    (
        &["rolling", "rolling_friction", "rolling_resistance", "torsion"],
        "There is no law of rolling resistance: friction (`regularized`, `mindlin`) acts on sliding, and leaves rolling free.\n\
         What resists rolling is the bending of bonds (`agglo explain beam`), and the medium, which brakes rotation\n\
         (`agglo explain drag`).",
    ),
    (
        &["beam"],
        "`beam` is the bond between two grains. Beams of sound are `acoustics.beams`: `agglo explain beams`.",
    ),
    (
        &["beams"],
        "`beams` are those of sound. The bond between two grains is `bonds.beam`: `agglo explain beam`.",
    ),
    (
        &["adhesion", "cohesion", "jkr", "dmt"],
        "There is no law of adhesion in a contact. Grains attract each other at a distance by `van_der_waals`, in contact by\n\
         `strain_bond`, and are held together by `beam`: `agglo explain van_der_waals`, and so on. Hard spheres that stick\n\
         merge (`agglo explain sticking`).",
    ),
    (
        &["ray_force", "ray_forces"],
        "How a ray pushes what it hits is `radiation_pressure`, its own momentum; `impulse`, the force of the 2016 paper for the\n\
         duration of the pulse; or `published_step`, that for one step as printed: `agglo explain radiation_pressure`, and so on.",
    ),
    (
        &["wall", "walls"],
        "`[[walls]]` are of soft spheres. Hard spheres have the faces of their control volume: `agglo explain volume.boundary`.",
    ),
];

/// What is said of a word.
pub(super) fn note(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase().replace('-', "_");
    NOTES.iter().find(|(words, _)| words.contains(&word.as_str())).map(|(_, note)| *note)
}
