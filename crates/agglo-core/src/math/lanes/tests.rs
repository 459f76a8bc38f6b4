use super::*;
use crate::math::Vector;
use crate::math::rng::{Purpose, Stream};

/// Every operation on rows of four numbers, and what comes of it in bits.
#[derive(Clone)]
struct Everything<'a>(&'a [[f64; 4]]);

impl Work for Everything<'_> {
    type Out = Vec<u64>;

    fn with<F: Lanes>(self) -> Vec<u64> {
        let mut found = vec![Vec::new(); self.0.len()];
        for first in (0..self.0.len()).step_by(F::COUNT) {
            let [a, b, c, d] = F::from_rows(|lane| &self.0[first + lane]);
            let (v, w) = (Vector::new(a, b, c), Vector::new(b, d, a));
            let less = a.below(b);
            let numbers = [
                a + b,
                a - b,
                a * b,
                a / b,
                -a,
                a.sqrt(),
                a.abs().powf(1.7),
                a.abs(),
                a.round(),
                (a.abs().min(F::of(1e3)) * F::of(8.0)).round() * F::of(0.5),
                a.min(b),
                a.max(b),
                F::select(less, c, d),
                F::select(a.at_most(b), c, d),
                F::select(F::both(less, c.below(d)), a, d),
                F::select(F::not(less), a, d),
                F::of(0.3) * a,
                v.dot(w),
                v.cross(w).norm(),
                F::from_lanes(|lane| self.0[first + lane][2]),
                F::select(F::mask_from_lanes(|lane| self.0[first + lane][1] > 0.0), a, b),
                F::select(F::mask_from_flags(&[7, 2, 0, 255, 1, 6, 2, 5][first % 8..], 2), a, b),
            ];
            for lane in 0..F::COUNT {
                let bits = numbers.map(|number| number.lane(lane).to_bits());
                found[first + lane].extend(bits);
                found[first + lane].push(u64::from(F::bits(less) >> lane & 1));
            }
            let items: Vec<u32> = (0..F::COUNT).map(|lane| (first + lane) as u32).collect();
            let mut squeezed = vec![0; F::COUNT];
            F::squeeze(F::bits(less), &items, &mut squeezed);
            for item in &squeezed[..F::bits(less).count_ones() as usize] {
                found[*item as usize].push(u64::from(*item));
            }
            F::to_rows([d, c, b, a], |lane, row| found[first + lane].extend(row.map(f64::to_bits)));
        }
        found.concat()
    }
}

/// Each NaN counts as one: which of two comes through is not said by the standard.
fn plain(bits: Vec<u64>) -> Vec<u64> {
    let one = |bits: u64| if f64::from_bits(bits).is_nan() { f64::NAN.to_bits() } else { bits };
    bits.into_iter().map(one).collect()
}

#[test]
fn lanes_give_the_bits_of_single_numbers() {
    let mut stream = Stream::new(11, Purpose::Sampling, 0);
    let mut rows: Vec<[f64; 4]> = (0..4000)
        .map(|_| std::array::from_fn(|_| stream.normal() * 10.0_f64.powf(200.0 * stream.uniform() - 100.0)))
        .collect();
    let edges =
        [0.0, -0.0, 1.0, -1.0, 5e-324, 2.5, -0.5, f64::MAX, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    for a in edges {
        for b in edges {
            rows.push([a, b, b, a]);
        }
    }
    rows.truncate(rows.len() / WIDEST * WIDEST);
    let single = plain(Everything(&rows).with::<f64>());
    for found in in_every_width(&Everything(&rows)) {
        assert_true!(plain(found) == single, "the same bits");
    }
    let less = rows.iter().filter(|row| row[0] < row[1]).count();
    assert_eq!(single.len(), rows.len() * 27 + less);
}

#[test]
fn all_is_all_lanes() {
    #[derive(Clone)]
    struct All;
    impl Work for All {
        type Out = ();
        fn with<F: Lanes>(self) {
            assert_true!(F::all(F::mask_from_lanes(|_| true)), "every lane");
            for one in 0..F::COUNT {
                assert_false!(F::all(F::mask_from_lanes(|lane| lane != one)), "all but one");
                assert_false!(F::all(F::mask_from_lanes(|lane| lane == one && F::COUNT > 1)), "one");
            }
        }
    }
    in_every_width(&All);
}
