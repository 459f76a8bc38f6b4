//! A run over several domains: simulations on threads of their own that follow the first one, step by step.

use std::hash::Hasher;
use std::sync::mpsc::Receiver;

use super::crew::Crew;
use super::settings::Settings;
use super::simulation::Simulation;
use crate::engine::SimError;
use crate::link::{Domain, threads};

impl Simulation {
    /// Spreads the run over several domains, each of which works out its own blocks of grains; see [`link`](crate::link). The others
    /// are threads that follow [`Simulation::advance`] and know of nothing else: whoever changes the state from outside afterwards, or
    /// attaches a hook, is told so by the next step. The settings are those that it runs under.
    ///
    /// # Errors
    /// As [`Simulation::resume`]; [`SimError::Alone`] where a hook acts, or no thread can be had.
    pub fn spread<S>(&mut self, settings: S, domains: usize) -> Result<(), SimError>
    where
        S: TryInto<Settings>,
        SimError: From<S::Error>,
    {
        if self.is_hooked {
            let reason = "a force of the caller's own acts".to_owned();
            return Err(SimError::Alone { reason });
        }
        let settings = settings.try_into()?;
        let threads_each = (rayon::current_num_threads() / domains.max(1)).max(1);
        // All must list the same pairs, so this one starts from its state as well.
        let events = std::mem::take(&mut self.events);
        let fresh = Self::restored(&settings, self.state())?;
        let mut crew = Crew::default();
        let mut links = threads(domains.max(1)).into_iter().map(|link| Domain::linked(Box::new(link)));
        let first = links.next().unwrap_or_default();
        for (domain, number) in links.zip(1..) {
            let mut follower = Self::restored(&settings, self.state())?;
            follower.system.domain = domain;
            let alone =
                |error: String| SimError::Alone { reason: format!("no thread for domain {number}: {error}") };
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads_each).build();
            let pool = pool.map_err(|error| alone(error.to_string()))?;
            let follow = move |orders| pool.install(|| follower.obey(orders));
            crew.take_on(number, follow).map_err(|error| alone(error.to_string()))?;
        }
        *self = fresh;
        self.events = events;
        self.system.domain = first;
        self.crew = crew;
        Ok(())
    }

    /// Goes where the first domain goes, until that ends.
    fn obey(&mut self, orders: Receiver<f64>) {
        for until in orders {
            // The first domain has the same error, and tells it; what happened is written down there.
            let _ = self.advance(until);
            self.events.clear();
        }
    }

    /// Sees to it that all domains go on, and from the same state.
    pub(super) fn set_out(&self, until: f64) -> Result<(), SimError> {
        if self.system.domain.domains() == 1 {
            return Ok(());
        }
        self.crew.follow(until);
        if self.system.domain.agree(self.fingerprint()) {
            return Ok(());
        }
        Err(SimError::Apart { at: self.moment(self.clock.next_step) })
    }

    /// A number that stands for the state: another one where anything that moves grains is different.
    fn fingerprint(&self) -> u64 {
        let mut hasher = std::hash::DefaultHasher::new();
        let (system, clock) = (&self.system, &self.clock);
        let grains = &system.grains;
        let counts = [
            system.network.bonds().len(),
            self.pulses.counts().len(),
            self.pulses.flight().rays().len(),
            usize::from(self.is_hooked),
        ];
        for count in counts {
            hasher.write_usize(count);
        }
        let vectors = [
            &grains.position,
            &grains.velocity,
            &grains.angular_velocity,
            &system.loads.force,
            &system.loads.torque,
        ];
        let vectors = vectors.into_iter().flatten().flat_map(|vector| vector.to_array());
        let values =
            [&grains.radius, &grains.mass, &grains.temperature, &grains.charge].into_iter().flatten();
        for value in
            [clock.time, clock.lag, clock.next_step].into_iter().chain(vectors).chain(values.copied())
        {
            hasher.write_u64(value.to_bits());
        }
        hasher.finish()
    }
}
