//! Constants and one learning after another against the tutorial's formulas, worked out independently of this code.

use super::*;

/// Fifteen digits were written down.
const DIGITS: f64 = 2e-14;

/// N. Hansen (2016), table 1 with α_cov = 2: n, λ, then μ_eff, c_σ, d_σ, c_c, c_1, c_μ, and of the weights the sum of the
/// negative ones, the first and the last.
const TABLE: [(usize, usize, [f64; 9]); 8] = [
    (
        1,
        4,
        [
            1.459_789_888_852_59,
            0.463_791_868_189_567,
            1.463_791_868_189_57,
            0.689_403_988_860_966,
            0.296_305_519_569_289,
            0.075_492_908_322_809_8,
            -1.967_893_879_149_34,
            0.804_162_859_932_73,
            -1.417_877_593_820_79,
        ],
    ),
    // So many points that c_1 + c_μ is held to 1, which leaves nothing for negative weights.
    (
        1,
        100,
        [
            26.966_655_064_651,
            0.878_665_275_802_001,
            7.085_142_232_630_64,
            0.525_452_498_709_286,
            0.062_002_709_084_108_7,
            0.937_997_290_915_891,
            0.0,
            0.082_358_236_564_673_2,
            0.0,
        ],
    ),
    (
        2,
        6,
        [
            2.028_611_464_610_06,
            0.446_204_987_378_317,
            1.446_204_987_378_32,
            0.624_554_539_026_826,
            0.154_815_399_896_414,
            0.085_592_779_426_664_2,
            -2.207_323_654_840_6,
            0.637_042_571_241_217,
            -1.155_981_778_158_92,
        ],
    ),
    (
        3,
        7,
        [
            2.254_815_082_201_6,
            0.414_909_001_098_062,
            1.414_909_001_098_06,
            0.558_801_322_886_019,
            0.096_409_632_579_272_1,
            0.069_588_469_232_910_7,
            -2.258_447_524_533_35,
            0.585_645_106_509_765,
            -1.063_656_696_984_26,
        ],
    ),
    (
        5,
        13,
        [
            3.980_869_172_953_99,
            0.427_789_510_005_858,
            1.427_789_510_005_86,
            0.452_796_111_342_271,
            0.045_797_119_175_238,
            0.093_696_862_072_776_6,
            -1.488_779_647_067_22,
            0.381_834_789_060_088,
            -0.391_918_635_461_504,
        ],
    ),
    (
        10,
        10,
        [
            3.167_299_281_410_7,
            0.284_428_587_946_367,
            1.284_428_587_946_37,
            0.294_990_383_035_622,
            0.015_283_824_524_751_7,
            0.023_551_776_650_417_5,
            -1.648_945_714_440_65,
            0.456_272_646_903_406,
            -0.549_749_917_697_385,
        ],
    ),
    (
        10,
        200,
        [
            52.601_528_592_966_3,
            0.807_696_656_117_438,
            4.139_462_140_954_32,
            0.377_652_422_672_481,
            0.011_093_144_617_544_9,
            0.517_498_920_902_709,
            -0.091_093_510_621_710_4,
            0.047_392_356_835_424_8,
            -0.001_629_210_694_084_06,
        ],
    ),
    (
        40,
        15,
        [
            4.540_915_209_075_96,
            0.132_030_568_702_083,
            1.132_030_568_702_08,
            0.093_009_216_634_249_2,
            0.001_169_432_725_261_84,
            0.003_405_219_643_706_35,
            -1.343_423_581_331_45,
            0.344_796_198_592_021,
            -0.308_367_259_320_542,
        ],
    ),
];

#[test]
fn constants_of_the_tutorial() {
    for (dimensions, population, wanted) in TABLE {
        let rates = Rates::new(population, dimensions);
        let negative: f64 = rates.weights.iter().filter(|weight| **weight < 0.0).sum();
        let found = [
            ("μ_eff", rates.effective_parents),
            ("c_σ", rates.path_sigma),
            ("d_σ", rates.damping),
            ("c_c", rates.path),
            ("c_1", rates.rank_one),
            ("c_μ", rates.rank_mu),
            ("sum of negative weights", negative),
            ("first weight", rates.weights[0]),
            ("last weight", rates.weights[population - 1]),
        ];
        for ((name, found), wanted) in found.into_iter().zip(wanted) {
            assert_near!(
                found,
                wanted,
                DIGITS * wanted.abs().max(1.0),
                "{name} for n = {dimensions}, λ = {population}"
            );
        }
    }
}

/// What a generation of six steps, best first, makes of the distribution.
struct Generation {
    steps: [[f64; 2]; 6],
    /// |C^(-1/2) y|² of each.
    squares: [f64; 6],
    mean: [f64; 2],
    sigma: f64,
    covariance: [f64; 4],
    path_sigma: [f64; 2],
    path: [f64; 2],
}

/// Three generations from m = (0.4, 0.6), σ = 0.3, C = 1. The third goes so far that the path waits (h_σ = 0).
const GENERATIONS: [Generation; 3] = [
    Generation {
        steps: [[0.5, -1.0], [1.2, -0.3], [-0.4, -0.8], [0.3, 1.1], [-1.5, 0.2], [0.7, 2.0]],
        squares: [1.25, 1.53, 0.8, 1.3, 2.29, 4.49],
        mean: [0.588_595_217_805_384, 0.364_462_984_341_232],
        sigma: 0.295_498_608_477_011,
        covariance: [
            0.951_271_665_381_524,
            -0.224_036_635_636_254,
            -0.224_036_635_636_254,
            0.951_629_405_502_991,
        ],
        path_sigma: [0.745_543_401_666_792, -0.931_110_925_908_478],
        path: [0.829_880_826_799_491, -1.036_440_136_560_04],
    },
    Generation {
        steps: [[0.9, -1.4], [0.6, -1.0], [1.1, -0.2], [-0.7, 0.4], [-0.2, 1.3], [-1.8, 0.5]],
        squares: [
            2.421_732_061_803_973,
            1.198_755_040_949_903,
            1.275_862_613_970_355,
            0.576_612_269_031_895_4,
            1.788_418_462_315_722,
            3.412_406_006_163_906,
        ],
        mean: [0.833_949_590_918_176, 0.012_196_938_565_446_7],
        sigma: 0.378_600_009_809_49,
        covariance: [
            1.037_645_140_682_88,
            -0.630_016_046_852_633,
            -0.630_016_046_852_633,
            1.478_749_414_606_74,
        ],
        path_sigma: [1.267_533_876_960_89, -1.873_146_934_396_9],
        path: [1.407_661_095_182_59, -1.962_825_690_392_12],
    },
    Generation {
        steps: [[3.0, -2.0], [2.5, -3.0], [4.0, -1.0], [-0.7, 0.4], [-0.2, 1.3], [-1.8, 0.5]],
        squares: [
            8.702_557_794_972_961,
            8.027_054_142_714_919,
            17.281_371_902_160_77,
            0.472_793_761_090_414_5,
            1.305_640_382_186_833,
            3.443_113_047_489_395,
        ],
        mean: [1.945_557_853_048_86, -0.823_063_999_480_088],
        sigma: 0.855_641_987_075_927,
        covariance: [
            1.674_755_092_252_66,
            -1.171_505_154_362_35,
            -1.171_505_154_362_35,
            1.926_936_780_550_48,
        ],
        path_sigma: [3.839_029_778_039_15, -2.477_354_125_432_12],
        path: [0.528_499_968_774_83, -0.736_933_996_139_257],
    },
];

#[test]
fn learning_by_the_tutorial() {
    let rates = Rates::new(6, 2);
    let mut distribution = Distribution::new(vec![0.4, 0.6], 0.3);
    for (number, wanted) in GENERATIONS.iter().enumerate() {
        let draws: Vec<Draw> = wanted
            .steps
            .iter()
            .zip(wanted.squares)
            .map(|(step, square)| Draw { step: step.to_vec(), square })
            .collect();
        distribution.learn(&draws.iter().collect::<Vec<_>>(), &rates);
        let entries = [
            ("mean", &distribution.mean, wanted.mean.to_vec()),
            ("covariance", &distribution.covariance, wanted.covariance.to_vec()),
            ("path of σ", &distribution.path_sigma, wanted.path_sigma.to_vec()),
            ("path", &distribution.path, wanted.path.to_vec()),
        ];
        for (name, found, wanted) in entries {
            for (k, (found, wanted)) in found.iter().zip(wanted).enumerate() {
                // Roots of matrices round a few times more than their entries.
                let off = (found - wanted).abs();
                assert!(
                    off < 1e-12,
                    "{name}[{k}] after generation {number}: found {found}, expected {wanted}"
                );
            }
        }
        assert!(
            (distribution.sigma - wanted.sigma).abs() < 1e-12,
            "σ after generation {number}: found {}, expected {}",
            distribution.sigma,
            wanted.sigma
        );
    }
}

/// A draw's squared deviate is the squared length of C^(-1/2) y, on which negative weights are scaled.
#[test]
fn a_draw_tells_its_length() {
    let rates = Rates::new(6, 2);
    let mut distribution = Distribution::new(vec![0.4, 0.6], 0.3);
    let first = &GENERATIONS[0];
    let draws: Vec<Draw> = first
        .steps
        .iter()
        .zip(first.squares)
        .map(|(step, square)| Draw { step: step.to_vec(), square })
        .collect();
    distribution.learn(&draws.iter().collect::<Vec<_>>(), &rates);
    let mut stream = Stream::new(1, crate::math::rng::Purpose::Sampling, 0);
    for _ in 0..20 {
        let draw = distribution.draw(&mut stream);
        let [a, b, _, d] = first.covariance;
        let [x, y] = [draw.step[0], draw.step[1]];
        // yᵀ C⁻¹ y of a 2 x 2 matrix.
        let square = (d * x * x - 2.0 * b * x * y + a * y * y) / (a * d - b * b);
        assert_near!(draw.square, square, DIGITS * square.max(1.0), "squared length of a draw");
        let point: Vec<f64> = distribution.point(&draw).collect();
        let wanted = first.mean[1] + first.sigma * y;
        assert_near!(point[1], wanted, DIGITS * wanted.abs().max(1.0), "point of a draw");
    }
}
