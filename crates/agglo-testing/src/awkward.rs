//! Numbers for tests of every table, journal and list.

/// Numbers that writers of numbers get wrong.
pub const AWKWARD: [f64; 18] = [
    0.1,
    1.0 / 3.0,
    1e-28,
    -1e-28,
    5e-324,
    f64::MIN_POSITIVE,
    f64::MAX,
    f64::MIN,
    1e22,
    9_007_199_254_740_993.0,
    1e16,
    9_999_999_999_999_998.0,
    123_456_789.125,
    2.5e-7,
    9.999_999_999_999_999e-5,
    6.626_070_15e-34,
    1512.0,
    -3.0,
];
