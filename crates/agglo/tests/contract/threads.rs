//! The same bits for any number of threads.

use rayon::ThreadPoolBuilder;

use crate::{common, crowd};

fn after(engine: &'static str, count: u32, steps: usize, threads: usize) -> Vec<u8> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut simulation = crowd::start(engine, count);
        common::steps(&mut simulation, steps);
        crowd::assert_busy(&simulation);
        common::bytes(&simulation)
    })
}

/// 700 grains are three leaves of the parallel loops and 600 rays three tasks.
#[test]
fn same_bits_on_1_2_and_7_threads() {
    for engine in [crowd::VERLET, crowd::ADAPTIVE] {
        let alone = after(engine, 700, 150, 1);
        for threads in [2, 7] {
            let when = format!("{threads} threads and one, {engine}");
            common::assert_same_state(&after(engine, 700, 150, threads), &alone, &when);
        }
    }
}
