//! Numeric trouble during a run: what, when, where, and what to do about it.

use thiserror::Error;

use crate::text::readable;

/// When and where a step went wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Number of the step.
    pub step: u64,
    /// Simulated time at its start [s].
    pub time: f64,
    /// Length of the step [s].
    pub dt: f64,
}

impl std::fmt::Display for Moment {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "step {} at t = {:.6e} s (step size {:.3e} s)", self.step, self.time, self.dt)
    }
}

/// Why a run cannot go on.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SimError {
    /// A motion is infinite or not a number.
    #[error("{at}: the motion of grain {grain} is not finite under {laws}; make the step smaller")]
    NotFinite {
        /// When.
        at: Moment,
        /// Id of the grain.
        grain: u32,
        /// The laws that act on it.
        laws: String,
    },
    /// A run cannot be spread over several domains.
    #[error("the run cannot be spread over several domains: {reason}; leave --domains out")]
    Alone {
        /// Why.
        reason: String,
    },
    /// The domains of a run are no longer in the same state.
    #[error(
        "{at}: the state was changed from outside, which the other domains of the run do not know of; run it with one domain"
    )]
    Apart {
        /// When.
        at: Moment,
    },
    /// A hook could not give its forces.
    #[error("{at}: {name} gave no forces: {reason}")]
    Hook {
        /// When.
        at: Moment,
        /// What it calls itself.
        name: String,
        /// What kept it from it.
        reason: String,
    },
    /// An entry of the ledger of energy is infinite or not a number.
    #[error(
        "{at}: the ledger of energy is not finite under {laws}; make the step smaller, or the values less extreme"
    )]
    LedgerNotFinite {
        /// When.
        at: Moment,
        /// The laws that act.
        laws: String,
    },
    /// A quantity of a run's end is infinite or not a number.
    #[error(
        "t = {time:.6e} s: {quantity} of the summary is not finite, so there is no summary; the values of the scenario are too \
         extreme"
    )]
    QuantityNotFinite {
        /// When [s].
        time: f64,
        /// Its key in the summary.
        quantity: String,
    },
    /// A grain moves too far in one step.
    #[error(
        "{at}: grain {grain} moves {radii:.3} of its radius in one step under {laws}, more than limits.displacement = \
         {limit}; make the step smaller, or the pulse weaker, or set limits.on_breach = \"warn\""
    )]
    TooFar {
        /// When.
        at: Moment,
        /// Id of the grain.
        grain: u32,
        /// Motion over radius.
        radii: f64,
        /// What is allowed.
        limit: f64,
        /// The laws that act on it.
        laws: String,
    },
    /// Two grains overlap too much for the law.
    #[error(
        "{at}: grains {} and {} overlap by {strain:.3} of the sum of their radii, more than limits.strain = {limit}, \
         under {laws}; make the contact stiffer, or the pulse weaker, or set limits.on_breach = \"warn\"",
        grains[0], grains[1]
    )]
    TooDeep {
        /// When.
        at: Moment,
        /// Ids of the grains.
        grains: [u32; 2],
        /// Overlap over the sum of the radii.
        strain: f64,
        /// What is allowed.
        limit: f64,
        /// The contact law.
        laws: String,
    },
    /// A grain overlaps a wall too much for the law.
    #[error(
        "{at}: grain {grain} overlaps walls.{wall} by {strain:.3} of its radius, more than limits.strain = {limit}, under \
         {laws}; make the contact stiffer, or the wall slower, or set limits.on_breach = \"warn\""
    )]
    TooDeepInWall {
        /// When.
        at: Box<Moment>,
        /// Id of the grain.
        grain: u32,
        /// Name of the wall.
        wall: Box<str>,
        /// Overlap over the radius.
        strain: f64,
        /// What is allowed.
        limit: f64,
        /// The contact law.
        laws: String,
    },
    /// A grain is placed in a wall.
    #[error(
        "grain {grain} is placed in the wall \"{wall}\": it overlaps it by {}, {part:.3} of its radius, and {limit} is allowed; \
         place it on the wall's side where grains are, or move the wall",
        readable(*overlap, "m")
    )]
    InWall {
        /// Id of the grain.
        grain: u32,
        /// Name of the wall.
        wall: Box<str>,
        /// Overlap [m].
        overlap: f64,
        /// The same over the radius.
        part: f64,
        /// What is allowed.
        limit: f64,
    },
    /// The cut-off of the near field leaves out too much.
    #[error(
        "fields.near_field.cutoff leaves out {:.1} % of the forces (root mean square, where grains are at the start), more \
         than fields.near_field.truncation = {limit}; leave cutoff away, so that all pairs count, make it longer, or allow \
         the error", 100.0 * part
    )]
    Truncated {
        /// What is left out over all.
        part: f64,
        /// What is allowed.
        limit: f64,
    },
    /// Grains would meet two images of one another.
    #[error(
        "[volume] is too narrow: grains act on one another up to {reach:.3e} m from center to center, which is not below half of \
         the shortest edge across which space repeats itself, {period:.3e} m; enlarge it, or let its faces be open"
    )]
    NarrowSpace {
        /// The shortest period [m].
        period: f64,
        /// How far grains act on one another, from center to center [m].
        reach: f64,
    },
    /// A volume has what only the other kind of spheres knows.
    #[error("[volume] has {what}, which {spheres} spheres do not know: take another")]
    ForeignVolume {
        /// What it has.
        what: &'static str,
        /// Who does not know it.
        spheres: &'static str,
    },
    /// Grains that leave would change how far a deformation goes.
    #[error(
        "volume.deformation is given beside absorbing faces, and what leaves would change where it stops: leave out one of the two"
    )]
    AbsorbsInDeformation,
    /// All grains have left.
    #[error(
        "{at}: the last grains leave through absorbing faces, and nothing is left to follow; let the run end before (time.end)"
    )]
    NoneLeft {
        /// When.
        at: Moment,
    },
    /// A deformation leads away from where it is to stop.
    #[error(
        "volume.deformation leads away from solid_fraction = {wanted}: the grains fill {now:.6} of [volume] at the start; turn the \
         strain_rate round, take another solid_fraction, or leave it out"
    )]
    DeformsAway {
        /// Volume of the grains over that of the control volume at the start.
        now: f64,
        /// Where it is to stop.
        wanted: f64,
    },
    /// A deformation along an axis on which nothing presses.
    #[error(
        "volume.deformation.strain_rate: space does not repeat itself along {0}: take 0 there, or periodic faces"
    )]
    DeformsOpenSpace(char),
    /// A wall ends at a face.
    #[error(
        "wall \"{wall}\" is not the same all along {axis}, on which space repeats itself: let the faces of [volume] across it be open"
    )]
    WallAcrossFaces {
        /// Its name.
        wall: String,
        /// The axis.
        axis: char,
    },
    /// Walls in a volume that is deformed.
    #[error("walls do not follow volume.deformation: leave out one of the two")]
    WallsInDeformation,
    /// Rays would have to follow a space that changes.
    #[error(
        "volume.deformation is given beside acoustics, whose rays do not follow it: leave out one of the two"
    )]
    RaysInDeformation,
    /// Rays would have to end in a region that space repeats.
    #[error(
        "acoustics.region is given where space repeats itself, and its images are not known: leave it out, or let the faces of [volume] be \
         open"
    )]
    RegionAcrossFaces,
    /// The observer asked to stop before the clock started.
    #[error("stopped while grains came to rest (start.relax); nothing is kept of that")]
    StoppedAtRest,
    /// A law asks for steps so short that the run would never end.
    #[error(
        "{at}: {law} has become so fast that it asks for steps of {wanted:.3e} s; do grains come closer than the law is \
         meant for? A law of contact or a smallest distance keeps them apart"
    )]
    TooFast {
        /// When.
        at: Moment,
        /// The law.
        law: &'static str,
        /// The step that it asks for [s].
        wanted: f64,
    },
    /// Energy comes from nothing, or is lost, beyond what the ledger explains.
    #[error(
        "{at}: the ledger does not explain {part:.3} of all energy, more than limits.drift_error = {limit}, under {laws}; \
         make the step smaller, or raise limits.drift_error"
    )]
    Unexplained {
        /// When.
        at: Moment,
        /// What is not explained, over all energy that was there or came in.
        part: f64,
        /// What is allowed.
        limit: f64,
        /// The laws that act.
        laws: String,
    },
    /// The iteration of the staggered scheme does not converge.
    #[error(
        "{at}: the staggered iteration does not converge (error {error:.3e}), least of all at grain {grain}, under \
         {laws}; the contact or bond is too stiff for it, or the damping too strong: raise target_iterations, or use \
         engine.verlet"
    )]
    NotConverged {
        /// When.
        at: Moment,
        /// The last iteration error.
        error: f64,
        /// Id of the grain that moved most in the last iteration.
        grain: u32,
        /// The laws that act.
        laws: String,
    },
    /// Rays start inside a grain before any grain has moved.
    #[error(
        "{at}: acoustics.beams.{beam}: {rays} rays of its disc start inside grains, the first of them in grain {grain}; move \
         the beam's start away from the grains, or make its radius smaller"
    )]
    BeamInGrain {
        /// When.
        at: Moment,
        /// Number of the beam.
        beam: u32,
        /// How many rays.
        rays: u32,
        /// Id of one of the grains.
        grain: u32,
    },
    /// Rays start inside a wall before any grain has moved.
    #[error(
        "{at}: acoustics.beams.{beam}: {rays} rays of its disc start inside the wall \"{wall}\"; move the beam's start to where grains are, \
         or make its radius smaller"
    )]
    BeamInWall {
        /// The step.
        at: Moment,
        /// Number of the beam.
        beam: u32,
        /// How many rays.
        rays: u32,
        /// Name of the first wall.
        wall: String,
    },
    /// A beam that the scenario has not.
    #[error("there is no beam {beam}; the scenario has {beams}, numbered from 0")]
    NoBeam {
        /// Its number.
        beam: u32,
        /// How many there are.
        beams: usize,
    },
    /// The grains do not come to rest before the clock starts.
    #[error(
        "start.relax: after {time:.3e} s the fastest grain still moves at {speed:.3e} m/s, more than {limit:.3e} m/s; \
         allow a longer relaxation, a shorter damping_time or a higher speed"
    )]
    NoRest {
        /// Simulated time of the relaxation [s].
        time: f64,
        /// Speed of the fastest grain [m/s].
        speed: f64,
        /// What counts as rest [m/s].
        limit: f64,
    },
    /// A saved state that no run of this scenario can have come to.
    #[error("the saved state is no state of such a run: {reason}")]
    Forged {
        /// What is wrong with it.
        reason: String,
    },
    /// A scenario of the other kind of spheres was given to an engine.
    #[error("{0}")]
    OtherSpheres(&'static str),
    /// A hard sphere moves in a way that is not finite.
    #[error("t = {time:.6e} s: the motion of grain {grain} is not finite after a collision under {laws}")]
    CollisionNotFinite {
        /// When [s].
        time: f64,
        /// Id of the grain.
        grain: u32,
        /// The laws that act.
        laws: String,
    },
    /// Bounces follow one another without end while the clock stands, or as good as stands.
    #[error(
        "t = {time:.6e} s: the clock went on by {lasted:.1e} s in {events} events, the last bounce is that of {who}; {help}"
    )]
    Standstill {
        /// When [s].
        time: f64,
        /// By how much the clock went on [s].
        lasted: f64,
        /// In how many events.
        events: u64,
        /// Whose bounce was the last: two grains by their ids, or a grain and a wall.
        who: String,
        /// What to do.
        help: &'static str,
    },
    /// A sphere is so far out, or so fast, that its position cannot be told to 1e-5 of its radius.
    #[error(
        "t = {time:.6e} s: the position of grain {grain}, {distance:.3e} m from the origin at {speed:.3e} m/s, is known to \
         {rounding:.1e} m only, since numbers have 16 digits; that is more than 1e-5 of its radius ({radius:.3e} m). \
         Put the grains nearer to the origin, or end the run sooner"
    )]
    OutOfDigits {
        /// When [s].
        time: f64,
        /// Id of the grain.
        grain: u32,
        /// Its distance from the origin [m].
        distance: f64,
        /// Its speed [m/s].
        speed: f64,
        /// What its position is rounded to [m].
        rounding: f64,
        /// Its radius [m].
        radius: f64,
    },
    /// A sphere in an open volume has flown so far that cells cannot be counted.
    #[error(
        "t = {time:.6e} s: grain {grain} is {distance:.3e} m from the origin, more than 1e9 cells of {cell:.3e} m from \
         [volume]; use a larger volume, or end the run sooner"
    )]
    OutOfCells {
        /// When [s].
        time: f64,
        /// Id of the grain.
        grain: u32,
        /// Its distance from the origin [m].
        distance: f64,
        /// Width of a cell [m].
        cell: f64,
    },
    /// An entry of the ledger of hard spheres is infinite or not a number.
    #[error(
        "t = {time:.6e} s: the ledger of energy is not finite under {laws}; make the values less extreme"
    )]
    HardLedgerNotFinite {
        /// When [s].
        time: f64,
        /// The laws that act.
        laws: String,
    },
    /// The ledger of hard spheres does not add up.
    #[error(
        "t = {time:.6e} s: the ledger does not explain {part:.3} of all energy under {laws}; these numbers are \
         not to be believed: it is a fault of the program, please report it"
    )]
    HardUnexplained {
        /// When [s].
        time: f64,
        /// What is not explained, over all energy that was there or came in.
        part: f64,
        /// The laws that act.
        laws: String,
    },
    /// A sphere has grown wider than a periodic volume.
    #[error(
        "t = {time:.6e} s: grain {grain} has grown to a diameter of {diameter:.3e} m, wider than the periodic volume \
         ({edge:.3e} m), and would collide with itself; use a larger volume or fewer grains"
    )]
    Outgrown {
        /// When [s].
        time: f64,
        /// Id of the grain.
        grain: u32,
        /// Its diameter [m].
        diameter: f64,
        /// Shortest edge of the volume [m].
        edge: f64,
    },
}

/// Settings that are settings already are always right.
impl From<std::convert::Infallible> for SimError {
    fn from(never: std::convert::Infallible) -> Self {
        match never {}
    }
}
