//! A force of one's own on single grains, given as formulas of place, velocity and time.
//!
//! # Equation
//! ```text
//! F = F(r, v, t) = F(r, 0, t) + F_v,   P_v = -F_v · v                                     CU3
//! F(r, 0, t) = -∇U where U is given,   ω² = |∂F/∂r|/m,   Γ = |∂F/∂v|/m                    CU4
//! ```
//! F_v, what the force is beyond that at rest, is booked as drag: P_v is lost, or put in where it is negative. The force at rest does
//! work from outside, as that of electric fields; with the energy U the grains store it, and only what U changes by in time comes from
//! outside.
//!
//! # Source
//! None: the formulas are the scenario's own. For the energy of a field see L. D. Landau and E. M. Lifshitz, *Mechanics* (1976), section 5.
//!
//! # Symbols
//! | symbol | name in code     | unit | meaning                                 |
//! |--------|------------------|------|-----------------------------------------|
//! | F      | `force`          | N    | three formulas                          |
//! | U      | `energy`         | J    | potential energy at rest, as a formula  |
//! | r      | `x`, `y`, `z`    | m    | center of the grain                     |
//! | v      | `vx`, `vy`, `vz` | m/s  | its velocity                            |
//! | t      | `t`              | s    | time                                    |
//! | P_v    |                  | W    | power that the part with the velocity takes |
//!
//! Names in the formulas, all in SI units: `x`, `y`, `z`, `vx`, `vy`, `vz`, `t`, `radius`, `mass`, `charge`.
//!
//! # Critical step
//! ω² and Γ of the formulas' slopes (CU4) where grains are; looked at every 100 steps.
//!
//! # Valid when
//! The formulas have values where grains are; where they have none, the run stops. The force does not turn grains. A part that
//! depends on the velocity is not solved for, as drag is: the automatic step has to resolve its decay.
//!
//! # Compared with others
//! `fix addforce` and `fix efield` of LAMMPS take formulas as well, with an energy that the user vouches for; here an energy whose
//! slopes are not the force is refused. `fields.drag` is faster where the force is the drag of the medium.
//!
//! # In a scenario
//! ```toml
//! [fields.custom]
//! force = ["-2*x - 1e-6*vx", "-2*y - 1e-6*vy", "-1e-6*vz"]
//! energy = "x^2 + y^2"
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::fields::{Custom, FieldLaw, Grain};
//! use agglo::math::Vec3;
//! let trap = Custom::new(["-2*x", "-2*y", "-2*z"]);
//! let grain = Grain { position: Vec3::new(0.5, 0.0, -1.0), ..Grain::default() };
//! assert_eq!(trap.force(&grain), Vec3::new(-1.0, 0.0, 2.0));
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Channel, FieldLaw, Grain, Part};
use crate::law::{Context, Faults, Law, Sample};
use crate::math::formula::{Names, Written};
use crate::math::{Pace, Vec3};
use crate::text::readable;

/// A force on every grain as formulas.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Custom {
    /// Force [N] along x, y and z.
    pub force: [FieldFormula; 3],
    /// Potential energy [J] whose slopes the force at rest is; without it the ledger books work from outside.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub energy: Option<FieldFormula>,
}

/// A formula over what is known of a grain in a field.
pub type FieldFormula = Written<OfGrain>;

/// What is known of a grain in a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfGrain {
    /// A coordinate of the center [m]: 0 for x, 1 for y, 2 for z.
    Place(u8),
    /// A component of the velocity [m/s].
    Velocity(u8),
    /// Time [s].
    Time,
    /// Radius [m].
    Radius,
    /// Mass [kg].
    Mass,
    /// Charge [C].
    Charge,
}

impl Names for OfGrain {
    const ALL: &'static [(&'static str, &'static str, Self)] = &[
        ("x", "m", Self::Place(0)),
        ("y", "m", Self::Place(1)),
        ("z", "m", Self::Place(2)),
        ("vx", "m/s", Self::Velocity(0)),
        ("vy", "m/s", Self::Velocity(1)),
        ("vz", "m/s", Self::Velocity(2)),
        ("t", "s", Self::Time),
        ("radius", "m", Self::Radius),
        ("mass", "kg", Self::Mass),
        ("charge", "C", Self::Charge),
    ];
}

const VELOCITY: [OfGrain; 3] = [OfGrain::Velocity(0), OfGrain::Velocity(1), OfGrain::Velocity(2)];
/// Part of the force by which the slopes of an energy may differ from it.
const TOLERANCE: f64 = 1e-6;

impl Custom {
    /// A force [N] without an energy.
    pub fn new(force: [&str; 3]) -> Self {
        Self { force: force.map(Written::new), energy: None }
    }

    fn has_velocity(&self) -> bool {
        self.force.iter().any(|component| VELOCITY.iter().any(|name| component.has(*name)))
    }

    /// Slopes of a formula over place [per m], velocity [per m/s] and time [per s].
    fn slopes(formula: &FieldFormula, grain: &Grain) -> [f64; 7] {
        let along = |name| {
            let way = match name {
                OfGrain::Place(axis) => usize::from(axis),
                OfGrain::Velocity(axis) => 3 + usize::from(axis),
                OfGrain::Time => 6,
                _ => usize::MAX,
            };
            std::array::from_fn(|own| if own == way { 1.0 } else { 0.0 })
        };
        formula.slopes(|name| value(name, grain), along)
    }
}

#[inline]
fn value(name: OfGrain, grain: &Grain) -> f64 {
    let component = |vector: Vec3, axis: u8| match axis {
        0 => vector.x,
        1 => vector.y,
        _ => vector.z,
    };
    match name {
        OfGrain::Place(axis) => component(grain.position, axis),
        OfGrain::Velocity(axis) => component(grain.velocity, axis),
        OfGrain::Time => grain.time,
        OfGrain::Radius => grain.radius,
        OfGrain::Mass => grain.mass,
        OfGrain::Charge => grain.charge,
    }
}

impl FieldLaw for Custom {
    const CHANNEL: Channel = Channel::Field;

    #[inline]
    fn force(&self, grain: &Grain) -> Vec3 {
        let [x, y, z] = self.force.each_ref().map(|component| component.at(|name| value(name, grain)));
        Vec3::new(x, y, z)
    }

    #[inline]
    fn parts(&self, grain: &Grain) -> [Option<Part>; 2] {
        let all = self.force(grain);
        let force =
            if self.has_velocity() { self.force(&Grain { velocity: Vec3::ZERO, ..*grain }) } else { all };
        let power = match &self.energy {
            Some(energy) => Self::slopes(energy, grain)[6],
            None => force.dot(grain.velocity),
        };
        let moving = all - force;
        let drag = Part { channel: Channel::Drag, force: moving, power: moving.dot(grain.velocity) };
        [Some(Part { channel: Channel::Field, force, power }), self.has_velocity().then_some(drag)]
    }

    fn energy(&self, grain: &Grain) -> f64 {
        self.energy.as_ref().map_or(0.0, |energy| energy.at(|name| value(name, grain)))
    }

    fn stores(&self) -> bool {
        self.energy.is_some()
    }

    /// By the slopes of the force: no more than the root of the largest sums of a row and of a column, which is exact where they
    /// are those of a trap, of a drag or of a rotation about an axis.
    fn pace(&self, grain: &Grain, mass: f64) -> Pace {
        let slopes = self.force.each_ref().map(|component| Self::slopes(component, grain));
        let norm = |first: usize| {
            let size = |row: usize, column: usize| slopes[row][first + column].abs();
            let row = |row: usize| (0..3).map(|column| size(row, column)).sum::<f64>();
            let column = |column: usize| (0..3).map(|row| size(row, column)).sum::<f64>();
            let largest = |sums: [f64; 3]| sums.into_iter().fold(0.0, f64::max);
            (largest([0, 1, 2].map(row)) * largest([0, 1, 2].map(column))).sqrt()
        };
        Pace::of_spring(norm(0), mass) + Pace::of_dashpot(norm(3), mass)
    }
}

impl Law for Custom {
    fn faults(&self, faults: &mut Faults, context: &Context<'_>) {
        let mut are_formulas = true;
        for (axis, component) in self.force.iter().enumerate() {
            if let Some(message) = component.fault() {
                faults.fail(&format!("force.{axis}"), message.to_owned());
                are_formulas = false;
            }
        }
        if let Some(energy) = &self.energy {
            let moving = || VELOCITY.iter().any(|name| energy.has(*name));
            let of_velocity = "the energy is that at rest: it cannot name vx, vy or vz";
            if let Some(message) = energy.fault().or_else(|| moving().then_some(of_velocity)) {
                faults.fail("energy", message.to_owned());
                are_formulas = false;
            }
        }
        if are_formulas {
            self.try_out(faults, context);
        }
    }
}

/// Places at which formulas are tried, over their distance from the origin.
const WAYS: [Vec3; 5] = [
    Vec3::new(0.36, -0.48, 0.8),
    Vec3::new(-0.6, 0.64, 0.48),
    Vec3::new(0.8, 0.36, -0.48),
    Vec3::new(-0.48, -0.8, -0.36),
    Vec3::new(1.0, 0.0, 0.0),
];
/// Distances from the origin [radii], and times [s].
const DISTANCES: [f64; 5] = [1.0, 10.0, 1e2, 1e3, 1e5];
const TIMES: [f64; 3] = [0.0, 1e-3, 0.7];

impl Custom {
    /// Formulas that have a value nowhere, and an energy that is not that of the force.
    fn try_out(&self, faults: &mut Faults, context: &Context<'_>) {
        let mut grains = context.samples.iter().flat_map(tried).peekable();
        if grains.peek().is_none() {
            return;
        }
        let mut has_value = [false; 3];
        let mut differs = None;
        for grain in grains {
            let force = self.force(&grain);
            let components = [force.x, force.y, force.z];
            for (known, component) in has_value.iter_mut().zip(components) {
                *known |= component.is_finite();
            }
            let Some(energy) = self.energy.as_ref().filter(|_| differs.is_none()) else { continue };
            let slopes = Self::slopes(energy, &grain);
            let size = force.norm();
            for (axis, component) in components.into_iter().enumerate() {
                let off = (component + slopes[axis]).abs() > TOLERANCE * size.max(slopes[axis].abs());
                if off && (component + slopes[axis]).is_finite() {
                    differs = Some((grain, axis, -slopes[axis], component));
                }
            }
        }
        for (axis, component) in self.force.iter().enumerate().filter(|(axis, _)| !has_value[*axis]) {
            let message =
                format!("\"{}\" is infinite or not a number wherever it is tried", component.text());
            faults.fail(&format!("force.{axis}"), message);
        }
        if let Some((Grain { position, time, .. }, axis, slope, force)) = differs {
            let [x, y, z] = [position.x, position.y, position.z].map(|place| readable(place, "m"));
            let [slope, force] = [slope, force].map(|newton| readable(newton, "N"));
            let message = format!(
                "is not the energy of the force: at ({x}, {y}, {z}) and {} its slope makes {slope} along {}, the force at rest is {force}",
                readable(time, "s"),
                ["x", "y", "z"][axis]
            );
            faults.fail_with(
                "energy",
                message,
                "leave it out, and its work is booked as that of a field from outside",
            );
        }
    }
}

/// A grain at rest wherever formulas are tried.
fn tried<'a>(sample: &'a Sample<'a>) -> impl Iterator<Item = Grain> + 'a {
    let Sample { radius, mass, charge, .. } = *sample;
    let places = DISTANCES.into_iter().flat_map(move |distance| WAYS.map(|way| way * (distance * radius)));
    places.flat_map(move |position| {
        TIMES.map(|time| Grain { position, mass, radius, charge, time, ..Grain::default() })
    })
}

#[cfg(test)]
#[path = "custom_tests.rs"]
mod tests;
