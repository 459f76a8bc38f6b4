//! What domains tell one another, as rows of numbers.

use crate::math::Vec3;

/// Something that is as good as a row of so many numbers: all its bits come back from them.
pub trait Row: Sized {
    /// How many numbers, above zero.
    const NUMBERS: usize;

    /// Appends them.
    fn put(&self, to: &mut Vec<f64>);

    /// What the next numbers of a row, of which there are enough, are as good as.
    fn taken(row: &mut impl Iterator<Item = f64>) -> Self;
}

/// The next number of a row.
fn next(row: &mut impl Iterator<Item = f64>) -> f64 {
    row.next().unwrap_or_else(|| panic!("a row is shorter than what it is taken for"))
}

impl Row for f64 {
    const NUMBERS: usize = 1;

    fn put(&self, to: &mut Vec<f64>) {
        to.push(*self);
    }

    fn taken(row: &mut impl Iterator<Item = f64>) -> Self {
        next(row)
    }
}

/// Whole numbers that a row can hold exactly.
macro_rules! whole_numbers {
    ($($whole:ty),*) => {$(
        impl Row for $whole {
            const NUMBERS: usize = 1;

            fn put(&self, to: &mut Vec<f64>) {
                to.push(f64::from(*self));
            }

            fn taken(row: &mut impl Iterator<Item = f64>) -> Self {
                next(row) as Self
            }
        }
    )*};
}

whole_numbers!(u8, u32, i32);

/// None is below all that there can be.
impl Row for Option<u32> {
    const NUMBERS: usize = 1;

    fn put(&self, to: &mut Vec<f64>) {
        to.push(self.map_or(-1.0, f64::from));
    }

    fn taken(row: &mut impl Iterator<Item = f64>) -> Self {
        let number = next(row);
        (number >= 0.0).then_some(number as u32)
    }
}

impl<T: Row, const N: usize> Row for [T; N] {
    const NUMBERS: usize = N * T::NUMBERS;

    fn put(&self, to: &mut Vec<f64>) {
        for one in self {
            one.put(to);
        }
    }

    fn taken(row: &mut impl Iterator<Item = f64>) -> Self {
        std::array::from_fn(|_| T::taken(row))
    }
}

impl Row for Vec3 {
    const NUMBERS: usize = 3;

    fn put(&self, to: &mut Vec<f64>) {
        to.extend(self.to_array());
    }

    fn taken(row: &mut impl Iterator<Item = f64>) -> Self {
        <[f64; 3]>::taken(row).into()
    }
}

impl<A: Row, B: Row> Row for (A, B) {
    const NUMBERS: usize = A::NUMBERS + B::NUMBERS;

    fn put(&self, to: &mut Vec<f64>) {
        self.0.put(to);
        self.1.put(to);
    }

    fn taken(row: &mut impl Iterator<Item = f64>) -> Self {
        // The first comes first in the row.
        let first = A::taken(row);
        (first, B::taken(row))
    }
}

/// Makes a row of a type with these fields, each of which is a row.
macro_rules! row_of_fields {
    ($type:ty { $($field:ident: $of:ty),* $(,)? }) => {
        impl $crate::link::Row for $type {
            const NUMBERS: usize = 0 $(+ <$of as $crate::link::Row>::NUMBERS)*;

            fn put(&self, to: &mut Vec<f64>) {
                $($crate::link::Row::put(&self.$field, to);)*
            }

            fn taken(row: &mut impl Iterator<Item = f64>) -> Self {
                Self { $($field: $crate::link::Row::taken(row)),* }
            }
        }
    };
}

pub(crate) use row_of_fields;

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, PartialEq)]
    struct Mixed {
        place: Vec3,
        grain: Option<u32>,
        pair: (f64, [i32; 2]),
    }

    row_of_fields!(Mixed { place: Vec3, grain: Option<u32>, pair: (f64, [i32; 2]) });

    #[test]
    fn rows_bring_all_bits_back() {
        for grain in [None, Some(0), Some(u32::MAX)] {
            let one = Mixed {
                place: Vec3::new(-0.0, 1e-310, f64::MAX),
                grain,
                pair: (f64::INFINITY, [i32::MIN, 7]),
            };
            let mut row = Vec::new();
            one.put(&mut row);
            assert_eq!(row.len(), Mixed::NUMBERS);
            let back = Mixed::taken(&mut row.iter().copied());
            assert_eq!(back, one);
            assert_eq!(back.place.x.to_bits(), one.place.x.to_bits());
        }
        let mut row = Vec::new();
        f64::NAN.put(&mut row);
        assert_eq!(f64::taken(&mut row.into_iter()).to_bits(), f64::NAN.to_bits());
    }
}
