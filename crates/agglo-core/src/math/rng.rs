//! Counter-based random numbers: Philox4x32-10, keyed by seed, stream and index.
//!
//! The number that belongs to (seed, stream, index) is a pure function of these three, so results do not
//! depend on the order in which, or on the thread on which, numbers are asked for.
//!
//! Source: J. K. Salmon et al., *Parallel random numbers: as easy as 1, 2, 3*, SC'11 (2011).

const MULTIPLIER: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
const WEYL: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];

/// One block of Philox4x32-10: four words from a counter and a key.
fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for _ in 0..10 {
        let a = u64::from(MULTIPLIER[0]) * u64::from(counter[0]);
        let b = u64::from(MULTIPLIER[1]) * u64::from(counter[2]);
        counter = [
            (b >> 32) as u32 ^ counter[1] ^ key[0],
            b as u32,
            (a >> 32) as u32 ^ counter[3] ^ key[1],
            a as u32,
        ];
        key = [key[0].wrapping_add(WEYL[0]), key[1].wrapping_add(WEYL[1])];
    }
    counter
}

/// What a stream of random numbers is for; one purpose, one stream, so that none disturbs another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Purpose {
    /// Where grains are put at the start.
    Placement = 1,
    /// Sizes of grains.
    Size = 2,
    /// Velocities at the start.
    Velocity = 3,
    /// Where rays start in their beam.
    Beam = 4,
    /// Random checks in tests and studies.
    Sampling = 5,
    /// Fragments of agglomerates that break.
    Fragment = 6,
    /// Proposals of optimizers.
    Search = 7,
    /// Seeds of the random starts of an ensemble.
    Start = 8,
    /// Sizes of the fragments of agglomerates that break.
    FragmentSize = 9,
    /// Where primaries go that a merged grain is taken apart into.
    Primaries = 10,
}

/// An endless sequence of random numbers that belongs to (seed, purpose, part).
#[derive(Clone, Debug)]
pub struct Stream {
    key: [u32; 2],
    lane: [u32; 2],
    index: u64,
    spare: Option<f64>,
}

impl Stream {
    /// The sequence of `purpose` number `part` (a grain group, a pulse ...) under `seed`.
    pub fn new(seed: u64, purpose: Purpose, part: u32) -> Self {
        Self { key: [seed as u32, (seed >> 32) as u32], lane: [purpose as u32, part], index: 0, spare: None }
    }

    /// Goes to the number with this index.
    pub fn jump_to(&mut self, index: u64) {
        self.index = index;
        self.spare = None;
    }

    fn next_block(&mut self) -> [u32; 4] {
        let counter = [self.index as u32, (self.index >> 32) as u32, self.lane[0], self.lane[1]];
        self.index += 1;
        philox(counter, self.key)
    }

    /// Uniform in [0, 1), 53 random bits.
    pub fn uniform(&mut self) -> f64 {
        if let Some(value) = self.spare.take() {
            return value;
        }
        let [a, b, c, d] = self.next_block();
        self.spare = Some(unit_interval(c, d));
        unit_interval(a, b)
    }

    /// Standard normal deviate (Box-Muller).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }

    /// A direction uniform on the unit sphere.
    pub fn direction(&mut self) -> super::Vec3 {
        let z = 2.0 * self.uniform() - 1.0;
        let (sin, cos) = (std::f64::consts::TAU * self.uniform()).sin_cos();
        let rho = (1.0 - z * z).max(0.0).sqrt();
        super::Vec3::new(rho * cos, rho * sin, z)
    }
}

fn unit_interval(high: u32, low: u32) -> f64 {
    let bits = (u64::from(high) << 32 | u64::from(low)) >> 11;
    bits as f64 * (1.0 / (1_u64 << 53) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Known answers published with the reference implementation (Random123, kat_vectors, philox4x32 10).
    #[test]
    fn known_answers() {
        assert_eq!(philox([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(
            philox([u32::MAX; 4], [u32::MAX; 2]),
            [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]
        );
        assert_eq!(
            philox([0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344], [0xa409_3822, 0x299f_31d0]),
            [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]
        );
    }

    /// Mean 1/2 and variance 1/12 within five standard errors of a million draws.
    #[test]
    fn uniform_moments() {
        let mut stream = Stream::new(7, Purpose::Sampling, 0);
        let n = 1_000_000;
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..n {
            let u = stream.uniform();
            assert_between!(u, 0.0..1.0);
            sum += u;
            squares += (u - 0.5) * (u - 0.5);
        }
        assert_near!(sum / n as f64, 0.5, 5.0 * (1.0 / 12.0_f64 / n as f64).sqrt());
        assert_near!(squares / n as f64, 1.0 / 12.0, 5.0 * (1.0 / 180.0_f64 / n as f64).sqrt());
    }

    #[test]
    fn streams_do_not_disturb_one_another() {
        let mut alone = Stream::new(1, Purpose::Size, 0);
        let expected: Vec<f64> = (0..8).map(|_| alone.uniform()).collect();
        let mut a = Stream::new(1, Purpose::Size, 0);
        let mut b = Stream::new(1, Purpose::Size, 1);
        for value in expected {
            assert_eq!(a.uniform(), value);
            assert_ne!(b.uniform(), value);
        }
    }
}
