//! Work that takes time: on a pool of threads, without the interpreter's lock, and ended by Ctrl-C.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::error::{InputError, RunError};

/// How often the interpreter is asked for Ctrl-C.
const LOOK_EVERY: Duration = Duration::from_millis(50);
/// Threads that can be asked for at the most.
const MOST_THREADS: usize = 4096;

/// The pool of a process. A child that was forked has none of its parent's threads, and makes its own.
struct Pool {
    process: u32,
    wanted: usize,
    threads: Arc<ThreadPool>,
}

/// Locked only with the interpreter's lock held, under which Python forks as well: no child finds it locked.
static POOL: Mutex<Option<Pool>> = Mutex::new(None);
static WANTED: Mutex<usize> = Mutex::new(0);

/// The pool of this process, with as many threads as were asked for.
pub(crate) fn pool(_: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let wanted = *WANTED.lock().unwrap_or_else(PoisonError::into_inner);
    let mut held = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some(found) = held.as_ref().filter(|found| found.process == process && found.wanted == wanted) {
        return Ok(Arc::clone(&found.threads));
    }
    let pool = Arc::new(made(wanted)?);
    // A pool of the parent has no threads here that could end.
    if let Some(old) = held.replace(Pool { process, wanted, threads: Arc::clone(&pool) })
        && old.process != process
    {
        std::mem::forget(old.threads);
    }
    Ok(pool)
}

/// So many threads, or all processors with 0.
fn made(wanted: usize) -> PyResult<ThreadPool> {
    let made = ThreadPoolBuilder::new().num_threads(wanted).build();
    made.map_err(|error| RunError::new_err(format!("cannot start {wanted} threads: {error}")))
}

/// How many threads simulations use from now on: all processors, or as many as RAYON_NUM_THREADS says, with None. Results have
/// the same bits for any number.
#[pyfunction]
#[pyo3(signature = (threads=None))]
pub(crate) fn set_threads(threads: Option<usize>) -> PyResult<()> {
    let wanted = threads.unwrap_or(0);
    if threads == Some(0) || wanted > MOST_THREADS {
        return Err(InputError::new_err(format!(
            "threads is {wanted}; a number from 1 to {MOST_THREADS}, or None for all processors, is wanted"
        )));
    }
    *WANTED.lock().unwrap_or_else(PoisonError::into_inner) = wanted;
    Ok(())
}

/// Whether to go on, as those want to know who may be stopped.
pub(crate) fn unless(stop: &AtomicBool) -> ControlFlow<()> {
    if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// Does something that is soon done, on the pool and without the interpreter's lock.
pub(crate) fn briefly<R: Send>(py: Python<'_>, work: impl FnOnce() -> R + Send) -> PyResult<R> {
    let pool = pool(py)?;
    Ok(py.detach(|| pool.install(work)))
}

/// As [`interruptible`], on threads of its own: others find the pool free while it goes on and calls functions of Python, which may
/// want the pool themselves.
pub(crate) fn interruptible_apart<R: Send>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> R + Send,
) -> PyResult<R> {
    let wanted = *WANTED.lock().unwrap_or_else(PoisonError::into_inner);
    let threads = made(wanted)?;
    until_a_signal(py, |stop| threads.install(|| work(stop)))
}

/// Does something on the pool, without the interpreter's lock. At Ctrl-C the flag that it is given is set; what it comes to
/// then is dropped, and KeyboardInterrupt raised.
pub(crate) fn interruptible<R: Send>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> R + Send,
) -> PyResult<R> {
    let pool = pool(py)?;
    until_a_signal(py, |stop| pool.install(|| work(stop)))
}

/// Does something on another thread; asks the interpreter for signals meanwhile.
fn until_a_signal<R: Send>(py: Python<'_>, work: impl FnOnce(&AtomicBool) -> R + Send) -> PyResult<R> {
    let stop = AtomicBool::new(false);
    let (send, mut receive) = channel();
    std::thread::scope(|scope| {
        let stop = &stop;
        scope.spawn(move || send.send(work(stop)));
        let mut asked = None;
        loop {
            let waiting = &mut receive;
            match py.detach(move || waiting.recv_timeout(LOOK_EVERY)) {
                Ok(outcome) => return asked.map_or(Ok(outcome), Err),
                Err(RecvTimeoutError::Timeout) => {
                    if let Err(signal) = py.check_signals() {
                        stop.store(true, Ordering::Relaxed);
                        asked.get_or_insert(signal);
                    }
                }
                // The work panicked, and the scope hands the panic on.
                Err(RecvTimeoutError::Disconnected) => return Err(RunError::new_err("the work broke off")),
            }
        }
    })
}
