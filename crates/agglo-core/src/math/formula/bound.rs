//! A formula that was read, with its names bound to what they stand for.

use super::number::{Dual, Number};
use super::parse::{self, DEEPEST, Operation};

/// A formula, whose names stand for whatever `S` says.
#[derive(Clone, Debug)]
pub struct Formula<S> {
    text: String,
    operations: Box<[Operation]>,
    names: Vec<S>,
    names_pi: bool,
}

impl<S: Copy> Formula<S> {
    /// Reads a formula whose names are found by `find`; it is asked once for each.
    ///
    /// # Errors
    /// Says what is wrong with the text, or what `find` says of a name.
    pub fn new(text: &str, mut find: impl FnMut(&str) -> Result<S, String>) -> Result<Self, String> {
        let read = parse::read(text)?;
        let names = read.names.iter().map(|name| find(name)).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { text: text.to_owned(), operations: read.operations.into(), names, names_pi: read.names_pi })
    }

    /// Its text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What its names stand for, each once.
    pub fn names(&self) -> &[S] {
        &self.names
    }

    /// Whether it has the constant `pi` in it.
    pub fn names_pi(&self) -> bool {
        self.names_pi
    }

    /// Its value, where names have these.
    #[inline]
    pub fn at(&self, value: impl Fn(S) -> f64) -> f64 {
        self.worked_out(value)
    }

    /// Its value and its slopes along `N` ways, where names have these values and change by so much along each way.
    #[inline]
    pub fn with_slopes<const N: usize>(
        &self,
        value: impl Fn(S) -> f64,
        along: impl Fn(S) -> [f64; N],
    ) -> (f64, [f64; N]) {
        let Dual { value, slopes } = self.worked_out(|name| Dual { value: value(name), slopes: along(name) });
        (value, slopes)
    }

    #[inline]
    fn worked_out<N: Number>(&self, value: impl Fn(S) -> N) -> N {
        let mut results = [N::of(0.0); DEEPEST];
        let mut count = 0;
        for operation in &self.operations {
            match *operation {
                Operation::Constant(constant) => {
                    results[count] = N::of(constant);
                    count += 1;
                }
                Operation::Name(name) => {
                    results[count] = value(self.names[name as usize]);
                    count += 1;
                }
                Operation::Unary(function) => results[count - 1] = results[count - 1].call(function),
                Operation::Binary(operator) => {
                    count -= 1;
                    results[count - 1] = results[count - 1].join(operator, results[count]);
                }
            }
        }
        results[0]
    }
}
