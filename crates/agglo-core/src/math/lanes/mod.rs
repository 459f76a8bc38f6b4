//! Contacts side by side: as many numbers as the processor at hand works on at once.
//!
//! Work that is written for [`Lanes`] runs by [`widest`] in lanes of eight where the processor has them, else one by one. Which
//! it is is found when the program runs, so one program serves every processor, and results have the same bits: lanes
//! round as single numbers do. Instructions of a certain processor are in one file each.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod number;
#[cfg(target_arch = "x86_64")]
mod register;
#[cfg(any(test, target_arch = "x86_64"))]
mod twice;

pub use number::{Lanes, WIDEST, Work};
#[cfg(test)]
pub use twice::Twice;

/// Does work in the widest lanes that the processor has.
#[inline]
pub fn widest<W: Work>(work: W) -> W::Out {
    #[cfg(target_arch = "x86_64")]
    return avx512::with(work).or_else(avx2::with).unwrap_or_else(Work::with::<f64>);
    #[cfg(not(target_arch = "x86_64"))]
    return work.with::<f64>();
}

/// Does work in lanes of every width that the processor has.
#[cfg(test)]
pub fn in_every_width<W: Work + Clone>(work: &W) -> Vec<W::Out> {
    let plain = [work.clone().with::<f64>(), work.clone().with::<Twice<f64>>()];
    #[cfg(target_arch = "x86_64")]
    let wide = [avx2::with(work.clone()).ok(), avx512::with(work.clone()).ok()];
    #[cfg(not(target_arch = "x86_64"))]
    let wide = [None, None];
    plain.into_iter().chain(wide.into_iter().flatten()).collect()
}

#[cfg(test)]
mod tests;
