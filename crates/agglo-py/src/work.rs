//! Work: without the interpreter's lock; what takes time on a pool of threads and ended by Ctrl-C, what does not at once.

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

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

thread_local! {
    /// The pool that a thread of Python is itself one of, for work that is soon done: to wake another would take longer. A thread is
    /// of one pool as long as it lives.
    static HERE: RefCell<Option<Pool>> = const { RefCell::new(None) };
}

impl Pool {
    /// Its threads, if it is of this process and has as many as are wanted.
    fn threads(&self, wanted: usize) -> Option<Arc<ThreadPool>> {
        (self.process == std::process::id() && self.wanted == wanted).then(|| Arc::clone(&self.threads))
    }
}

/// How many threads were asked for, 0 for all processors.
fn wanted() -> usize {
    *WANTED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The pool of this process, with as many threads as were asked for.
fn pool(_: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let wanted = wanted();
    let mut held = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some(threads) = held.as_ref().and_then(|pool| pool.threads(wanted)) {
        return Ok(threads);
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

/// The pool that this thread is one of; that of the process where it is of another one already: one of a parent that was forked, one
/// with another number of threads, or one that calls Python.
fn pool_here(py: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let wanted = wanted();
    if let Some(threads) = HERE.with_borrow(|here| here.as_ref().and_then(|pool| pool.threads(wanted))) {
        return Ok(threads);
    }
    if rayon::current_thread_index().is_some() {
        return pool(py);
    }
    let built = ThreadPoolBuilder::new().num_threads(wanted).use_current_thread().build();
    let threads = Arc::new(started(wanted, built)?);
    HERE.set(Some(Pool { process: std::process::id(), wanted, threads: Arc::clone(&threads) }));
    Ok(threads)
}

/// So many threads, or all processors with 0.
fn made(wanted: usize) -> PyResult<ThreadPool> {
    started(wanted, ThreadPoolBuilder::new().num_threads(wanted).build())
}

fn started(wanted: usize, built: Result<ThreadPool, ThreadPoolBuildError>) -> PyResult<ThreadPool> {
    built.map_err(|error| RunError::new_err(format!("cannot start {wanted} threads: {error}")))
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

/// Does something on this thread and those that help it, without the interpreter's lock. Nobody asks for Ctrl-C meanwhile: it is soon
/// done, or asks itself ([`Signals`]).
pub(crate) fn here<R: Send>(py: Python<'_>, work: impl FnOnce() -> R + Send) -> PyResult<R> {
    let pool = pool_here(py)?;
    Ok(py.detach(|| pool.install(work)))
}

/// Asks the interpreter for Ctrl-C now and then, from work that goes on in small pieces.
pub(crate) struct Signals {
    asked: Instant,
}

impl Signals {
    pub(crate) fn new() -> Self {
        Self { asked: Instant::now() }
    }

    /// Asks, if it was not done just before.
    pub(crate) fn ask(&mut self) -> PyResult<()> {
        if self.asked.elapsed() < LOOK_EVERY {
            return Ok(());
        }
        self.asked = Instant::now();
        Python::attach(|py| {
            py.check_signals()?;
            Ok(())
        })
    }
}

/// As [`interruptible`], on threads of its own: others find the pool free while it goes on and calls functions of Python, which may
/// want the pool themselves.
pub(crate) fn interruptible_apart<R: Send>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> R + Send,
) -> PyResult<R> {
    let threads = made(wanted())?;
    // The thread that calls functions of Python is known to the interpreter all the while, and not made known for each call.
    let known = |stop: &_| Python::attach(|py| py.detach(|| work(stop)));
    until_a_signal(py, |stop| threads.install(|| known(stop)))
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
