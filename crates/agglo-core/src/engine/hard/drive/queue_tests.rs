use std::collections::BTreeSet;

use super::*;
use crate::math::rng::{Purpose, Stream};

/// Names that are not in the order of the places.
fn id(sphere: u32) -> u32 {
    sphere.wrapping_mul(7919) % 65_521
}

/// The order that the queue must have: what is filed, by time and name, in a set that sorts it.
#[derive(Default)]
struct Sorted {
    /// Times above zero sort like their bits.
    entries: BTreeSet<(u64, u32, u32)>,
}

impl Sorted {
    fn file(&mut self, before: Option<f64>, time: f64, sphere: u32) {
        if let Some(before) = before {
            self.entries.remove(&(before.to_bits(), id(sphere), sphere));
        }
        if time.is_finite() {
            self.entries.insert((time.to_bits(), id(sphere), sphere));
        }
    }

    fn next(&mut self, until: f64) -> Option<(f64, u32)> {
        let first = *self.entries.first()?;
        let time = f64::from_bits(first.0);
        (time <= until).then(|| {
            self.entries.remove(&first);
            (time, first.2)
        })
    }
}

/// When a sphere's next event is: soon, in a crowd, at the same moment as others, at once, far away, never.
fn due(kind: f64, now: f64, stream: &mut Stream) -> f64 {
    let u = stream.uniform();
    match (kind * 20.0) as u32 {
        0..=9 => now - 1e-6 * (1.0 - u).ln(),
        10..=12 => now + 1e-7 + 1e-16 * u,
        13 | 14 => now + 1e-6 * (8.0 * u).floor(),
        15 => now,
        16 | 17 => now + 1e-3 * u,
        18 => now + 1e6 * u * u * u,
        _ => f64::INFINITY,
    }
}

#[test]
fn order_of_a_sorted_list() {
    for (seed, count) in [(0, 1), (1, 3), (2, 70), (3, 500), (4, 2000)] {
        let mut stream = Stream::new(seed, Purpose::Sampling, 0);
        let mut next_events: Vec<NextEvent> =
            (0..count).map(|sphere| NextEvent { id: id(sphere), ..NextEvent::EMPTY }).collect();
        let (mut queue, mut sorted, mut now) = (Queue::default(), Sorted::default(), 0.0);
        let mut taken = 0;
        for round in 0..40_000_u32 {
            if round % 9_000 == 0 {
                queue.rebuild(now, &mut next_events);
            }
            // Some are filed anew, some taken out.
            for _ in 0..2 {
                let sphere = (stream.uniform() * f64::from(count)) as u32;
                let (before, kind) = (next_events[sphere as usize].due(), stream.uniform());
                let time = due(kind, now, &mut stream);
                next_events[sphere as usize].collision = time;
                sorted.file(Some(before), time, sphere);
                queue.file(&mut next_events, sphere);
            }
            let until = if stream.uniform() < 0.3 { now + 1e-7 * stream.uniform() } else { f64::MAX };
            let wanted = sorted.next(until);
            assert_eq!(
                queue.next(&mut next_events, until, |_, _, _| {}),
                wanted,
                "round {round} of seed {seed}"
            );
            if let Some((time, sphere)) = wanted {
                taken += 1;
                // A jump of a million seconds is not gone back from: the rest follows it.
                now = time;
                let later = due(0.4 * stream.uniform(), now, &mut stream);
                next_events[sphere as usize].collision = later;
                sorted.file(None, later, sphere);
                queue.file(&mut next_events, sphere);
            }
        }
        assert!(taken > 20_000, "{taken}");
    }
}

/// Thousands at one moment, in the order of their ids, and nothing after them.
#[test]
fn all_at_one_moment() {
    for time in [0.0, 1.0, 1e300] {
        let named = |sphere| NextEvent { collision: time, id: id(sphere), ..NextEvent::EMPTY };
        let mut next_events: Vec<NextEvent> = (0..5000).map(named).collect();
        let mut queue = Queue::default();
        queue.rebuild(0.0, &mut next_events);
        let mut last = None;
        for _ in 0..5000 {
            let (found, sphere) = queue.next(&mut next_events, f64::MAX, |_, _, _| {}).unwrap();
            assert_eq!(found, time);
            assert_below!(last, Some(id(sphere)));
            last = Some(id(sphere));
            next_events[sphere as usize].collision = f64::INFINITY;
            queue.file(&mut next_events, sphere);
        }
        assert_eq!(queue.next(&mut next_events, f64::MAX, |_, _, _| {}), None);
        // It can be used again after it ran dry.
        next_events[7].crossing = 2e300;
        queue.file(&mut next_events, 7);
        assert_eq!(queue.next(&mut next_events, f64::MAX, |_, _, _| {}), Some((2e300, 7)));
    }
}
