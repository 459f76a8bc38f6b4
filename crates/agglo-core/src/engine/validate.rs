//! Whether what was read back can be gone on with: helpers for those who hold a saved state to what a run can come to.
//!
//! A checkpoint's checksum tells accidents, not intent. So before a state is used its lengths, indices and numbers are
//! looked at, by each part for itself; what is left may be another state than was saved, but never one that steps out of
//! an array.

use serde::Serialize;

use crate::math::Vec3;
use crate::text::not_finite;

/// Why a state is refused.
pub type Fault = String;

/// Counters start below this, so that they cannot overflow.
pub const MOST_COUNTED: u64 = 1 << 62;

/// Fails with `reason` unless `holds`.
pub fn ensure(holds: bool, reason: impl FnOnce() -> Fault) -> Result<(), Fault> {
    if holds { Ok(()) } else { Err(reason()) }
}

/// Fails where a number in a part of the state is not finite.
pub fn finite<T: Serialize>(what: &str, part: &T) -> Result<(), Fault> {
    match not_finite(part) {
        None => Ok(()),
        Some(key) => Err(format!("{what}: {key} is not finite")),
    }
}

/// Fails where one of many vectors is not finite.
pub fn finite_vectors(what: &str, values: &[Vec3]) -> Result<(), Fault> {
    ensure(values.iter().all(|value| value.is_finite()), || format!("{what} is not finite"))
}

/// Fails where a length is not what it should be.
pub fn length(what: &str, found: usize, due: usize) -> Result<(), Fault> {
    ensure(found == due, || format!("{what}: {found} entries where {due} are due"))
}
