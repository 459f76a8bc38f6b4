//! Asks the processor for memory that will be read soon.

/// Bytes of a cache line.
#[cfg(target_arch = "x86_64")]
const LINE: usize = 64;

/// Asks for the cache lines of an item; nothing happens where there is no such item, or on processors without the hint.
#[inline]
pub fn prefetch<T>(items: &[T], at: usize) {
    #[cfg(target_arch = "x86_64")]
    if let Some(item) = items.get(at) {
        #[allow(unsafe_code, reason = "a hint: it reads nothing, changes nothing and cannot fail")]
        for line in 0..size_of::<T>().div_ceil(LINE) {
            // SAFETY: the address lies within what the reference names, and the instruction does not access memory.
            unsafe {
                use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
                _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(item).cast::<i8>().add(line * LINE));
            }
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (items, at);
}
