//! Input as nobody means it: seeds with bits flipped, parts cut, lines swapped, and words and numbers from a dictionary.

use agglo::math::rng::{Purpose, Stream};

/// Numbers that break what is not looked at.
const NUMBERS: [&str; 24] = [
    "0",
    "-0.0",
    "-1",
    "1",
    "2",
    "1e-3",
    "0.5",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e150",
    "1e30",
    "1e18",
    "1e9",
    "nan",
    "inf",
    "-inf",
    "4294967296",
    "2147483647",
    "9223372036854775807",
    "18446744073709551616",
    "1_000",
    "0x7f",
];
/// What stands where a value is due.
const VALUES: [&str; 20] = [
    "true",
    "[]",
    "{}",
    "\"\"",
    "\" \"",
    "\"1\"",
    "\"1 m\"",
    "\"-1 mm\"",
    "\"1e300 m\"",
    "\"1e-300 s\"",
    "\"0 s\"",
    "\"300 K\"",
    "\"\\u001b[31m\"",
    "\"\u{202e}\"",
    "[[[[]]]]",
    "1979-05-27",
    "\"../../x\"",
    "\"/dev/zero\"",
    "'''\n'''",
    "null",
];
/// Bytes that mean something to somebody.
const BYTES: [u8; 16] = [0, 1, 7, 8, 10, 13, 27, 34, 44, 61, 91, 93, 127, 128, 200, 255];
/// Eight bytes that break what is not looked at.
const EIGHTS: [f64; 10] =
    [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -1.0, 1e300, -1e300, 1e-300, 1e18, 4_294_967_296.0];

/// Seeds of one kind, and the words in them.
pub struct Mutator {
    seeds: Vec<Vec<u8>>,
    /// Words and values of all seeds, and further ones.
    words: Vec<Vec<u8>>,
    /// Whether lines, words and numbers are to be found in the seeds.
    is_text: bool,
}

/// Random choices of one case.
struct Choice(Stream);

impl Choice {
    fn below(&mut self, n: usize) -> usize {
        ((self.0.uniform() * n as f64) as usize).min(n.saturating_sub(1))
    }

    fn of<'a, T>(&mut self, values: &'a [T]) -> &'a T {
        &values[self.below(values.len())]
    }
}

impl Mutator {
    /// Begins from these seeds; `words` are further words for text.
    pub fn new(seeds: Vec<Vec<u8>>, words: &[String], is_text: bool) -> Self {
        let mut known: Vec<Vec<u8>> = words.iter().map(|word| word.clone().into_bytes()).collect();
        if is_text {
            for seed in &seeds {
                let is_part = |byte: &u8| !(byte.is_ascii_alphanumeric() || b"_.-+\"".contains(byte));
                known.extend(seed.split(is_part).filter(|word| !word.is_empty()).map(<[u8]>::to_vec));
            }
        }
        known.sort();
        known.dedup();
        Self { seeds, words: known, is_text }
    }

    /// The input of the case with this number: always the same.
    pub fn case(&self, number: u32) -> Vec<u8> {
        let mut choice = Choice(Stream::new(u64::from(number), Purpose::Sampling, 81));
        let mut bytes = self.seeds[number as usize % self.seeds.len()].clone();
        // The first cases are the seeds themselves.
        if (number as usize) < self.seeds.len() {
            return bytes;
        }
        for _ in 0..=choice.below(4) {
            if self.is_text && choice.below(4) > 0 {
                self.change_text(&mut bytes, &mut choice);
            } else {
                self.change_bytes(&mut bytes, &mut choice);
            }
        }
        bytes
    }

    fn change_bytes(&self, bytes: &mut Vec<u8>, choice: &mut Choice) {
        let length = bytes.len();
        if length < 16 {
            return bytes.extend_from_slice(choice.of::<Vec<u8>>(&self.seeds));
        }
        let at = choice.below(length - 8);
        match choice.below(9) {
            0 | 1 => bytes[at] ^= 1 << choice.below(8),
            2 => bytes[at] = *choice.of(&BYTES),
            3 => bytes[at..at + 8].copy_from_slice(&choice.of(&EIGHTS).to_le_bytes()),
            4 => bytes.insert(at, *choice.of(&BYTES)),
            5 => bytes.truncate(at),
            6 => drop(bytes.drain(at..at + 1 + choice.below((length - at).min(200)))),
            7 => {
                let part = bytes[at..at + 1 + choice.below((length - at).min(200))].to_vec();
                let to = choice.below(length);
                bytes.splice(to..to, part);
            }
            _ => {
                // The end of another.
                let other = choice.of::<Vec<u8>>(&self.seeds);
                let from = choice.below(other.len());
                bytes.truncate(at);
                bytes.extend_from_slice(&other[from..]);
            }
        }
    }

    fn change_text(&self, bytes: &mut Vec<u8>, choice: &mut Choice) {
        match choice.below(12) {
            0..=3 => replace(bytes, number_at, choice.of(&NUMBERS).as_bytes(), choice),
            4 => replace(bytes, word_at, choice.of::<Vec<u8>>(&self.words), choice),
            5 => replace(bytes, word_at, choice.of(&NUMBERS).as_bytes(), choice),
            6 => replace(bytes, value_at, choice.of(&VALUES).as_bytes(), choice),
            7 => replace(bytes, value_at, choice.of::<Vec<u8>>(&self.words), choice),
            8 => swap_lines(bytes, choice),
            9 => double_line(bytes, choice),
            10 => {
                let lines = lines(choice.of::<Vec<u8>>(&self.seeds));
                let to = choice.below(bytes.len() + 1);
                let to = bytes[..to].iter().rposition(|byte| *byte == b'\n').map_or(0, |newline| newline + 1);
                let line = choice.of(&lines).clone();
                bytes.splice(to..to, line);
            }
            _ => nest(bytes, choice),
        }
    }
}

/// A range of bytes from here on.
type Find = fn(&[u8], usize) -> Option<std::ops::Range<usize>>;

/// Replaces one of the ranges that `find` finds.
fn replace(bytes: &mut Vec<u8>, find: Find, with: &[u8], choice: &mut Choice) {
    let from = choice.below(bytes.len().max(1));
    if let Some(range) = find(bytes, from).or_else(|| find(bytes, 0)) {
        bytes.splice(range, with.iter().copied());
    }
}

fn run_of(
    bytes: &[u8],
    from: usize,
    is_first: fn(&u8) -> bool,
    is_part: fn(&u8) -> bool,
) -> Option<std::ops::Range<usize>> {
    // A run that has begun before is not cut in two.
    let from = from + bytes.get(from..)?.iter().position(|byte| !is_part(byte))?;
    let start = from + bytes[from..].iter().position(is_first)?;
    let end =
        bytes[start..].iter().position(|byte| !is_part(byte)).map_or(bytes.len(), |length| start + length);
    Some(start..end)
}

fn number_at(bytes: &[u8], from: usize) -> Option<std::ops::Range<usize>> {
    let range =
        run_of(bytes, from, u8::is_ascii_digit, |byte| byte.is_ascii_digit() || b".e".contains(byte))?;
    let has_sign = range.start > 0 && bytes[range.start - 1] == b'-';
    Some(range.start - usize::from(has_sign)..range.end)
}

fn word_at(bytes: &[u8], from: usize) -> Option<std::ops::Range<usize>> {
    run_of(bytes, from, u8::is_ascii_alphabetic, |byte| byte.is_ascii_alphanumeric() || *byte == b'_')
}

/// What stands behind a sign of equality.
fn value_at(bytes: &[u8], from: usize) -> Option<std::ops::Range<usize>> {
    let start = from + bytes.get(from..)?.iter().position(|byte| b"=:".contains(byte))? + 1;
    let end =
        bytes[start..].iter().position(|byte| b"\n#".contains(byte)).map_or(bytes.len(), |end| start + end);
    Some(start..end)
}

fn lines(bytes: &[u8]) -> Vec<Vec<u8>> {
    bytes.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect()
}

fn swap_lines(bytes: &mut Vec<u8>, choice: &mut Choice) {
    let mut lines = lines(bytes);
    if lines.len() > 1 {
        let (a, b) = (choice.below(lines.len()), choice.below(lines.len()));
        lines.swap(a, b);
        *bytes = lines.concat();
    }
}

fn double_line(bytes: &mut Vec<u8>, choice: &mut Choice) {
    let mut lines = lines(bytes);
    if !lines.is_empty() {
        let from = lines[choice.below(lines.len())].clone();
        let count = *choice.of(&[1, 1, 1, 30]);
        let to = choice.below(lines.len());
        lines.splice(to..to, std::iter::repeat_n(from, count));
        *bytes = lines.concat();
    }
}

/// Brackets within brackets, keys within keys.
fn nest(bytes: &mut Vec<u8>, choice: &mut Choice) {
    let depth = *choice.of(&[3, 50, 3000]);
    let deep = match choice.below(5) {
        0 => "[".repeat(depth),
        1 => format!("\nx = {}1{}\n", "{ a = ".repeat(depth), " }".repeat(depth)),
        2 => format!("\n{}z = 1\n", "a.".repeat(depth)),
        3 => format!("\n[{}z]\n", "a.".repeat(depth)),
        _ => "{\"a\":".repeat(depth),
    };
    let to = choice.below(bytes.len() + 1);
    bytes.splice(to..to, deep.into_bytes());
}
