//! Asks the processor for memory that will be read soon.

/// Asks for the cache line of an item; nothing happens where there is no such item, or on processors without the hint.
#[inline]
pub fn prefetch<T>(items: &[T], at: usize) {
    #[cfg(target_arch = "x86_64")]
    if let Some(item) = items.get(at) {
        #[allow(unsafe_code, reason = "a hint: it reads nothing, changes nothing and cannot fail")]
        // SAFETY: the address is that of a reference, and the instruction does not access memory.
        unsafe {
            use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
            _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(item).cast());
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (items, at);
}
