//! Soft and hard spheres behind the common trait.

use std::borrow::Cow;

use super::{Measures, SimError, Simulation, Start, hard, soft};
use crate::particles::Particles;

/// The part of the trait that both kinds of spheres have under the same names of their own.
macro_rules! in_common {
    ($engine:ident) => {
        type Settings = $engine::Settings;
        type State<'a> = $engine::SimulationState<'a>;

        fn start(settings: Self::Settings, start: Start) -> Result<Self, SimError> {
            Self::start(settings, start)
        }

        fn resume(settings: Self::Settings, state: Self::State<'_>) -> Result<Self, SimError> {
            Self::resume(settings, state)
        }

        fn time(&self) -> f64 {
            self.clock().time
        }

        fn end(&self) -> f64 {
            self.end()
        }

        fn steps(&self) -> u64 {
            self.clock().step
        }

        fn save(&self) -> Self::State<'_> {
            self.state()
        }

        fn into_start(self) -> Start {
            self.into_start()
        }
    };
}

impl Simulation for soft::Simulation {
    in_common!(soft);

    fn step(&mut self) -> Result<(), SimError> {
        self.step()
    }

    fn advance(&mut self, until: f64) -> Result<(), SimError> {
        self.advance(until)
    }

    fn grains(&self) -> Cow<'_, Particles> {
        Cow::Borrowed(&self.system.grains)
    }

    fn measures(&self) -> Measures {
        let (grains, balance) = (&self.system.grains, self.balance());
        Measures {
            grains: grains.len(),
            mass: grains.mass.iter().sum(),
            momentum: self.momentum().linear,
            kinetic_energy: balance.stored.kinetic + balance.stored.rotational,
            unexplained: balance.drift_relative.abs(),
        }
    }
}

impl Simulation for hard::Simulation {
    in_common!(hard);

    fn step(&mut self) -> Result<(), SimError> {
        self.advance(self.end())
    }

    fn advance(&mut self, until: f64) -> Result<(), SimError> {
        self.advance(until)
    }

    fn grains(&self) -> Cow<'_, Particles> {
        Cow::Owned(self.snapshot().grains)
    }

    fn measures(&self) -> Measures {
        let (grains, balance) = (self.snapshot().grains, self.balance());
        Measures {
            grains: grains.len(),
            mass: grains.mass.iter().sum(),
            momentum: self.momentum(),
            kinetic_energy: balance.stored.kinetic,
            unexplained: balance.unexplained(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Scenario, place};

    /// Run in two parts, with a save and a resume between them, it comes to the same bits as in one; and its measures are those of
    /// its grains.
    macro_rules! goes_on {
        ($name:ident, $engine:ident, $file:literal, $time:expr) => {
            #[test]
            fn $name() {
                let text = include_str!(concat!("../../../../scenarios/", $file));
                let scenario = Scenario::from_toml(text).unwrap();
                let settings = || $engine::Settings::try_from(&scenario).unwrap();
                let start = || {
                    <$engine::Simulation as Simulation>::start(settings(), place(&scenario).unwrap().into())
                };
                let (mut whole, mut first) = (start().unwrap(), start().unwrap());
                whole.run_until($time).unwrap();
                first.run_until(0.5 * $time).unwrap();
                assert_between!(first.time(), 0.5 * $time..0.75 * $time, "s");
                let saved = postcard::to_stdvec(&first.save()).unwrap();
                let state: $engine::SimulationState<'_> = postcard::from_bytes(&saved).unwrap();
                let mut second = <$engine::Simulation as Simulation>::resume(settings(), state).unwrap();
                second.run_until($time).unwrap();
                assert_at_least!(second.time(), $time, "s");
                assert_true!(second.steps() > first.steps() && !second.is_finished(), "it went on");
                let [one, two] =
                    [&whole, &second].map(|simulation| postcard::to_stdvec(&simulation.save()).unwrap());
                assert_eq!(one, two, "the state as bytes");
                measures_hold(&second);
                let next = Start::from(&second.into_start().grains);
                let third = <$engine::Simulation as Simulation>::start(settings(), next).unwrap();
                assert_eq!(third.time(), 0.0);
            }
        };
    }

    fn measures_hold(simulation: &impl Simulation) {
        let (grains, measures) = (simulation.grains(), simulation.measures());
        assert_eq!(measures.grains, grains.len());
        assert_close!(measures.mass, grains.mass.iter().sum(), 1e-15, "kg");
        // Soft grains drag half the mass of the fluid that they displace, an eighth of their own.
        let inertia = if simulation.end() == 300e-6 { 1.125 } else { 1.0 };
        let motion = |at: usize| grains.velocity[at] * (inertia * grains.mass[at]);
        let momentum = (0..grains.len()).map(motion).fold(crate::math::Vec3::ZERO, |sum, own| sum + own);
        assert_close_vector!(measures.momentum, momentum, 1e-9, "kg m/s");
        let energy = |at: usize| {
            0.5 * (motion(at).dot(grains.velocity[at])
                + grains.inertia(at) * grains.angular_velocity[at].norm_squared())
        };
        assert_close!(measures.kinetic_energy, (0..grains.len()).map(energy).sum(), 1e-9, "J");
        assert_below!(measures.unexplained, 1e-2);
    }

    goes_on!(soft_spheres_go_on, soft, "ink-agglomerate.toml", 3e-6);
    goes_on!(hard_spheres_go_on, hard, "reacting-agglomeration.toml", 2e-5);
}
