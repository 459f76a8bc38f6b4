//! The order of grains along a space-filling curve, so that neighbors in space are neighbors in memory.

use crate::domain::extent_of_places;
use crate::math::Vec3;

/// Bits per axis of the curve's grid.
const BITS: u32 = 21;

/// The order of points along Morton's curve; equal places keep their order.
pub fn morton_order(positions: &[Vec3]) -> Vec<u32> {
    let (lower, upper) = extent_of_places(positions.iter().copied()).unwrap_or_default();
    let extent = (upper - lower).to_array().into_iter().fold(f64::MIN_POSITIVE, f64::max);
    let scale = f64::from(1_u32 << BITS) * (1.0 - 1e-9) / extent;
    let key = |at: Vec3| morton_code(((at - lower) * scale).to_array().map(|along| along as u64));
    let mut keyed: Vec<(u64, u32)> =
        positions.iter().zip(0..).map(|(at, number)| (key(*at), number)).collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, number)| number).collect()
}

/// Number along Morton's curve of a cell, by the lowest 21 bits of its coordinates.
pub fn morton_code(cell: [u64; 3]) -> u64 {
    let [x, y, z] = cell.map(spread_bits);
    x | y << 1 | z << 2
}

/// Puts two empty bits between the lowest 21 bits.
fn spread_bits(value: u64) -> u64 {
    let mut bits = value & 0x1F_FFFF;
    bits = (bits | bits << 32) & 0x001F_0000_0000_FFFF;
    bits = (bits | bits << 16) & 0x001F_0000_FF00_00FF;
    bits = (bits | bits << 8) & 0x100F_00F0_0F00_F00F;
    bits = (bits | bits << 4) & 0x10C3_0C30_C30C_30C3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_spread() {
        assert_eq!(spread_bits(0b111), 0b100_1001);
        assert_eq!(spread_bits(1 << 20), 1 << 60);
    }

    #[test]
    fn corners_of_a_cube_in_z_order() {
        let corner = |k: u32| Vec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        let shuffled = [5, 0, 3, 7, 1, 6, 2, 4].map(corner);
        let order = morton_order(&shuffled);
        let sorted: Vec<Vec3> = order.iter().map(|k| shuffled[*k as usize]).collect();
        assert_eq!(sorted, (0..8).map(corner).collect::<Vec<_>>());
        assert_eq!(morton_order(&[]), Vec::<u32>::new());
    }
}
