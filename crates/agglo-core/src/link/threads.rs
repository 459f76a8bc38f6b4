//! Domains of one process, each with a thread of its own, that pass messages.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, PoisonError};

use super::Link;

/// The way of one thread to all others.
#[derive(Debug)]
pub struct Threads {
    number: usize,
    to: Vec<Sender<Arc<[f64]>>>,
    from: Mutex<Vec<Receiver<Arc<[f64]>>>>,
}

/// The ways between so many domains, for a thread each.
pub fn threads(domains: usize) -> Vec<Threads> {
    let mut to: Vec<Vec<_>> = (0..domains).map(|_| Vec::new()).collect();
    let mut all = Vec::with_capacity(domains);
    for number in 0..domains {
        let mut from = Vec::with_capacity(domains);
        for senders in &mut to {
            let (sender, receiver) = channel();
            senders.push(sender);
            from.push(receiver);
        }
        all.push((number, from));
    }
    let linked =
        |((number, from), to): ((usize, Vec<_>), Vec<_>)| Threads { number, to, from: Mutex::new(from) };
    all.into_iter().zip(to).map(linked).collect()
}

impl Link for Threads {
    fn domains(&self) -> usize {
        self.to.len()
    }

    fn number(&self) -> usize {
        self.number
    }

    /// # Panics
    /// Where another domain has ended.
    fn exchange(&self, own: Vec<f64>) -> Vec<Arc<[f64]>> {
        let own: Arc<[f64]> = own.into();
        for to in &self.to {
            // One that has ended is noticed below.
            let _ = to.send(Arc::clone(&own));
        }
        let from = self.from.lock().unwrap_or_else(PoisonError::into_inner);
        let hear = |(number, from): (usize, &Receiver<Arc<[f64]>>)| {
            from.recv().unwrap_or_else(|_| panic!("domain {number} has ended before its time"))
        };
        from.iter().enumerate().map(hear).collect()
    }
}
