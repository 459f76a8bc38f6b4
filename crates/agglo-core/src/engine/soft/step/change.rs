//! How far grains move in a step.

use crate::contact::pass::Record;
use crate::domain::Stretch;
use crate::link::row_of_fields;
use crate::math::Vec3;

/// What one update of the trial motion amounts to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Change {
    /// Sum of |r^K - r^(K-1)| [m].
    pub since_last: f64,
    /// Sum of |r^K - r^L| [m].
    pub since_start: f64,
    /// Largest motion over the step, in radii of the grain, and the grain's place.
    pub farthest: f64,
    /// The place of that grain.
    pub farthest_grain: u32,
    /// Longest |r^K - r^(K-1)| of a grain [m].
    pub wavering: f64,
    /// The place of that grain.
    pub wavering_grain: u32,
    /// Place of the first grain whose motion is not finite.
    pub not_finite: Option<u32>,
}

row_of_fields!(Change {
    since_last: f64,
    since_start: f64,
    farthest: f64,
    farthest_grain: u32,
    wavering: f64,
    wavering_grain: u32,
    not_finite: Option<u32>,
});

impl Change {
    pub fn join(a: Self, b: Self) -> Self {
        let (farthest, farthest_grain) = if b.farthest > a.farthest {
            (b.farthest, b.farthest_grain)
        } else {
            (a.farthest, a.farthest_grain)
        };
        let (wavering, wavering_grain) = if b.wavering > a.wavering {
            (b.wavering, b.wavering_grain)
        } else {
            (a.wavering, a.wavering_grain)
        };
        Self {
            since_last: a.since_last + b.since_last,
            since_start: a.since_start + b.since_start,
            farthest,
            farthest_grain,
            wavering,
            wavering_grain,
            not_finite: a.not_finite.or(b.not_finite),
        }
    }

    /// Iteration error w_K, the change of the last iteration over that of the step.
    pub fn error(&self) -> f64 {
        if self.since_start > 0.0 { self.since_last / self.since_start } else { 0.0 }
    }
}

impl Change {
    /// Moves a grain from the start of its step of `dt` [s], in which the velocity changes by `kick` [m/s] and the angular velocity
    /// by `twist` [rad/s], the part `phi` of it counting for the way; it follows space where that is stretched, which is no motion
    /// of its own.
    #[inline(always)]
    pub fn note_move(
        &mut self,
        grain: usize,
        record: &mut Record,
        (dt, phi, stretch): (f64, f64, Option<Stretch>),
        (kick, twist): (Vec3, Vec3),
    ) {
        let ((start, velocity, _), (last, ..)) = (record.before(), record.now());
        let moved = velocity * dt + kick * (phi * dt);
        let place = stretch.map_or(start, |stretch| stretch.of(start)) + moved;
        record.end(place, kick, twist);
        self.note(grain, place - last, moved, record.radius());
    }

    #[inline]
    fn note(&mut self, grain: usize, since_last: Vec3, since_start: Vec3, radius: f64) {
        let (moved, wavered) = (since_start.norm(), since_last.norm());
        self.since_last += wavered;
        if wavered > self.wavering {
            self.wavering = wavered;
            self.wavering_grain = grain as u32;
        }
        self.since_start += moved;
        let radii = moved / radius;
        if !radii.is_finite() {
            self.not_finite = self.not_finite.or(Some(grain as u32));
        } else if radii > self.farthest {
            self.farthest = radii;
            self.farthest_grain = grain as u32;
        }
    }
}

/// A step that was begun when the one before it ended.
#[derive(Clone, Copy, Debug)]
pub struct Afloat {
    /// Its length [s].
    pub dt: f64,
    /// How far grains moved.
    pub change: Change,
}
