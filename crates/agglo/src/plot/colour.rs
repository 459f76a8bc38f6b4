//! Colours: a map for values and a list for names.

use std::fmt;

/// A colour: red, green and blue, one byte each, red first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub u32);

impl fmt::Display for Colour {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "#{:06x}", self.0)
    }
}

/// Text and axes.
pub(super) const INK: Colour = Colour(0x22_2222);
/// What is there to compare with.
pub(super) const GREY: Colour = Colour(0x99_9999);
/// Lines behind the data.
pub(super) const GRID: Colour = Colour(0xe4_e4e4);
/// The ground.
pub(super) const PAPER: Colour = Colour(0xff_ffff);

/// Every fifteenth of the 256 colours of viridis.
///
/// Source: S. van der Walt and N. Smith, viridis (2015), public domain (CC0).
const VIRIDIS: [u32; 18] = [
    0x44_0154, 0x48_1769, 0x47_2a7a, 0x43_3d84, 0x3d_4e8a, 0x35_5e8d, 0x2e_6d8e, 0x29_7b8e, 0x23_898e,
    0x1f_978b, 0x21_a585, 0x2e_b37c, 0x46_c06f, 0x65_cb5e, 0x89_d548, 0xb0_dd2f, 0xd8_e219, 0xfd_e725,
];

/// The colour for a part from 0 (dark violet) to 1 (yellow) of a range of values: equal parts look equally far from each
/// other, in grey as well.
/// ```
/// use agglo::plot::viridis;
/// assert_eq!(viridis(0.0).to_string(), "#440154");
/// assert_eq!(viridis(1.0).to_string(), "#fde725");
/// ```
pub fn viridis(part: f64) -> Colour {
    let last = VIRIDIS.len() - 1;
    let place = part.clamp(0.0, 1.0) * last as f64;
    let below = (place as usize).min(last - 1);
    let share = place - below as f64;
    let mixed = [16, 8, 0].map(|shift| {
        let channel = |index: usize| f64::from(VIRIDIS[index] >> shift & 0xff);
        ((1.0 - share) * channel(below) + share * channel(below + 1)).round() as u32
    });
    Colour(mixed[0] << 16 | mixed[1] << 8 | mixed[2])
}

/// Colours and dashes of lines and bars that have names, in their order.
///
/// Source: M. Okabe and K. Ito, *Color universal design* (2008); without its yellow, which is too light for lines.
const NAMED: [(u32, &str); 6] = [
    (0x00_72b2, ""),
    (0xd5_5e00, "7 3"),
    (0x00_9e73, "2 3"),
    (0xcc_79a7, "9 3 2 3"),
    (0xe6_9f00, "4 4"),
    (0x56_b4e9, "1 3"),
];

/// Colour of the name with this number.
pub(super) fn named(number: usize) -> Colour {
    Colour(NAMED[number % NAMED.len()].0)
}

/// Dashes of the name with this number.
pub(super) fn dashes(number: usize) -> &'static str {
    NAMED[number % NAMED.len()].1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Brightness as the eye weighs the channels rises from end to end, so that the map can be read in grey.
    #[test]
    fn viridis_gets_brighter_all_the_way() {
        let brightness = |step: u32| {
            let Colour(colour) = viridis(f64::from(step) / 100.0);
            let linear = |shift: u32| (f64::from(colour >> shift & 0xff) / 255.0).powf(2.2);
            0.2126 * linear(16) + 0.7152 * linear(8) + 0.0722 * linear(0)
        };
        for step in 1..=100 {
            assert!(brightness(step) > brightness(step - 1), "{step}");
        }
    }

    #[test]
    fn beyond_the_ends_are_the_ends() {
        assert_eq!((viridis(-1.0), viridis(2.0)), (viridis(0.0), viridis(1.0)));
    }
}
