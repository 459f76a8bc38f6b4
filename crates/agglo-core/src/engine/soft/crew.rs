//! The other domains of a run, on threads of their own.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

/// Those that follow.
#[derive(Debug, Default)]
pub(super) struct Crew {
    /// How far each is to go [s].
    orders: Vec<Sender<f64>>,
    threads: Vec<JoinHandle<()>>,
}

impl Crew {
    /// Takes on one that follows what it is told; `number` is its own.
    ///
    /// # Errors
    /// There is no thread for it.
    pub fn take_on(
        &mut self,
        number: usize,
        follow: impl FnOnce(Receiver<f64>) + Send + 'static,
    ) -> std::io::Result<()> {
        let (orders, due) = channel();
        let thread = std::thread::Builder::new().name(format!("domain {number}"));
        self.threads.push(thread.spawn(move || follow(due))?);
        self.orders.push(orders);
        Ok(())
    }

    /// Lets all go on as far as this one [s].
    pub fn follow(&self, until: f64) {
        for order in &self.orders {
            // One that has ended is noticed where it does not answer.
            let _ = order.send(until);
        }
    }
}

impl Drop for Crew {
    fn drop(&mut self) {
        self.orders.clear();
        for thread in self.threads.drain(..) {
            // One that has failed was noticed where it did not answer.
            let _ = thread.join();
        }
    }
}
