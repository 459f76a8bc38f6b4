//! Color maps for values, and colors for names of grains.

/// A color map: equal steps of the value look equally far apart, in gray and to the color-blind too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Map {
    /// From violet over green to yellow.
    Viridis,
    /// From blue over gray to yellow.
    Cividis,
    /// From violet over red to yellow, like glowing matter.
    Inferno,
}

/// Every fifteenth of the 256 colors of a map.
type Table = [u32; 18];

/// Source: S. van der Walt and N. Smith (2015), public domain (CC0).
const VIRIDIS: Table = [
    0x44_0154, 0x48_1769, 0x47_2a7a, 0x43_3d84, 0x3d_4e8a, 0x35_5e8d, 0x2e_6d8e, 0x29_7b8e, 0x23_898e,
    0x1f_978b, 0x21_a585, 0x2e_b37c, 0x46_c06f, 0x65_cb5e, 0x89_d548, 0xb0_dd2f, 0xd8_e219, 0xfd_e725,
];
/// Source: J. R. Nuñez, C. R. Anderson and R. S. Renslow, *PLoS ONE* 13, e0199239 (2018), public domain (CC0).
const CIVIDIS: Table = [
    0x00_224e, 0x00_2d68, 0x16_3770, 0x2e_416d, 0x3f_4c6c, 0x4e_566c, 0x5c_616e, 0x69_6b71, 0x76_7676,
    0x83_8179, 0x92_8c78, 0xa0_9875, 0xaf_a471, 0xbf_b06b, 0xcf_bd62, 0xdf_ca57, 0xf0_d846, 0xfe_e838,
];
/// Source: S. van der Walt and N. Smith (2015), public domain (CC0).
const INFERNO: Table = [
    0x00_0004, 0x0a_0722, 0x1e_0c45, 0x38_0962, 0x51_0e6c, 0x69_166e, 0x80_1f6c, 0x98_2766, 0xb0_315b,
    0xc6_3d4d, 0xd9_4d3d, 0xe9_612b, 0xf4_7918, 0xfa_9407, 0xfc_b014, 0xf8_cd37, 0xf2_ea69, 0xfc_ffa4,
];

/// Colors of names of grains, in their order, as red, green and blue, a byte each.
///
/// Source: M. Okabe and K. Ito, *Color universal design* (2008).
pub const NAMED: [u32; 7] = [0x00_72b2, 0xe6_9f00, 0x00_9e73, 0xcc_79a7, 0x56_b4e9, 0xd5_5e00, 0xf0_e442];
/// Color of what has no name of its own.
pub const PLAIN: u32 = 0xbd_bdbd;

/// Steps of a map that is given out: two for each of the tables, so that those whole are exact.
const STOPS: u32 = 34;

impl Map {
    /// All of them by their words.
    pub const WORDS: [(&'static str, Self); 3] =
        [("viridis", Self::Viridis), ("cividis", Self::Cividis), ("inferno", Self::Inferno)];

    /// Its word.
    pub fn word(self) -> &'static str {
        Self::WORDS.iter().find(|(_, map)| *map == self).map_or("", |(word, _)| word)
    }

    /// The table and where it begins: the black end of inferno cannot be told from shade and is left out.
    fn table(self) -> (&'static Table, f64) {
        match self {
            Self::Viridis => (&VIRIDIS, 0.0),
            Self::Cividis => (&CIVIDIS, 0.0),
            Self::Inferno => (&INFERNO, 0.15),
        }
    }

    /// The color for a part from 0 to 1 of a range of values, as red, green and blue, a byte each.
    pub fn color(self, part: f64) -> u32 {
        let (table, begin) = self.table();
        let part = if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) };
        let place = (begin + (1.0 - begin) * part) * (table.len() - 1) as f64;
        let below = (place as usize).min(table.len() - 2);
        let share = place - below as f64;
        let channel = |shift: u32| {
            let at = |index: usize| f64::from(table[index] >> shift & 0xff);
            (((1.0 - share) * at(below) + share * at(below + 1)).round() as u32) << shift
        };
        channel(16) | channel(8) | channel(0)
    }

    /// The map at equal steps, between which colors can be mixed.
    pub fn stops(self) -> impl Iterator<Item = u32> {
        (0..=STOPS).map(move |step| self.color(f64::from(step) / f64::from(STOPS)))
    }
}

/// Color of a grain with the number of a name; plain gray without one.
pub fn name_color(number: Option<usize>) -> u32 {
    number.map_or(PLAIN, |number| NAMED[number % NAMED.len()])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lightness as the eye sees it (CIE L*) rises evenly: so the maps can be read in gray and with any kind of
    /// color vision. A step of a hundredth is 0.6 to 0.8 of L*, half and twice of which are let pass.
    #[test]
    fn maps_get_lighter_evenly() {
        for (word, map) in Map::WORDS {
            let lightness = |step: i32| {
                let color = map.color(f64::from(step) / 100.0);
                // As light, by the curve of sRGB screens.
                let channel = |shift: u32| match f64::from(color >> shift & 0xff) / 255.0 {
                    dark if dark <= 0.04045 => dark / 12.92,
                    value => ((value + 0.055) / 1.055).powf(2.4),
                };
                let [r, g, b] = [16, 8, 0].map(channel);
                116.0 * (0.2126 * r + 0.7152 * g + 0.0722 * b).cbrt() - 16.0
            };
            let mean = (lightness(100) - lightness(0)) / 20.0;
            for step in (5..=100).step_by(5) {
                let rise = lightness(step) - lightness(step - 5);
                assert!(rise > 0.5 * mean && rise < 2.0 * mean, "{word} {step}: {rise} and not {mean}");
            }
        }
    }

    /// Mixed between its stops a map is itself, but for rounding twice; inferno is cut, so that its stops lie beside those of
    /// the table, and two steps of a channel's 255 more are let pass.
    #[test]
    fn stops_give_the_map_back() {
        for (word, map) in Map::WORDS {
            let stops: Vec<u32> = map.stops().collect();
            let most = if map == Map::Inferno { 3.0 } else { 1.0 };
            for step in 0..=200 {
                let part = f64::from(step) / 200.0;
                let place = part * (stops.len() - 1) as f64;
                let below = (place as usize).min(stops.len() - 2);
                let share = place - below as f64;
                for shift in [16, 8, 0] {
                    let channel = |color: u32| f64::from(color >> shift & 0xff);
                    let mixed = (1.0 - share) * channel(stops[below]) + share * channel(stops[below + 1]);
                    assert!((mixed - channel(map.color(part))).abs() <= most, "{word} {part}");
                }
            }
        }
    }

    #[test]
    fn beyond_the_ends_are_the_ends() {
        assert_eq!((Map::Viridis.color(-1.0), Map::Viridis.color(2.0)), (0x44_0154, 0xfd_e725));
        assert_eq!(Map::Cividis.color(f64::NAN), Map::Cividis.color(0.0));
    }
}
