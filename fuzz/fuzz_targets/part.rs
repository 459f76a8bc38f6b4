#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = agglo_fuzz::readers::part(&agglo_fuzz::BENCH, bytes);
});
