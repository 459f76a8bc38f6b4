//! Reads the text of a formula into the operations that work it out, in the order in which they are done.

use super::number::{Binary, Unary};
use super::words::{FUNCTIONS, PI};

/// Parentheses within parentheses that are followed.
const MOST_NESTED: usize = 64;

/// Intermediate results that a formula may have at a time.
pub(super) const DEEPEST: usize = 32;

/// One thing to do with the results so far.
#[derive(Clone, Copy, Debug)]
pub(super) enum Operation {
    Constant(f64),
    /// The name with this number.
    Name(u32),
    Unary(Unary),
    Binary(Binary),
}

/// A formula that was read, with the names in it.
pub(super) struct Read {
    pub operations: Vec<Operation>,
    pub names: Vec<String>,
    pub names_pi: bool,
}

/// # Errors
/// Says what is wrong with the text.
pub(super) fn read(text: &str) -> Result<Read, String> {
    let mut reader = Reader {
        text,
        parts: parts(text)?,
        at: 0,
        nested: 0,
        held: 0,
        read: Read { operations: Vec::new(), names: Vec::new(), names_pi: false },
    };
    reader.sum()?;
    match reader.next() {
        None => Ok(reader.read),
        Some(Part::Sign(')')) => Err(reader.broken("nothing opens a )")),
        Some(Part::Sign(',')) => Err(reader.broken("a comma stands outside of a function")),
        Some(part) => Err(reader.broken(&format!("an operator is missing before {}", part.shown()))),
    }
}

/// A number, a word or a sign.
#[derive(Clone, Copy)]
enum Part<'a> {
    Number(f64, &'a str),
    Name(&'a str),
    Function(&'a str),
    Sign(char),
}

impl Part<'_> {
    fn shown(self) -> String {
        match self {
            Self::Number(_, text) | Self::Name(text) | Self::Function(text) => format!("\"{text}\""),
            Self::Sign(sign) => format!("\"{sign}\""),
        }
    }
}

fn parts(text: &str) -> Result<Vec<Part<'_>>, String> {
    let mut parts = Vec::new();
    let mut rest = text;
    while let Some(next) = rest.chars().next() {
        let length = if next.is_ascii_digit() || next == '.' {
            let length = length_of_number(rest);
            let number = rest[..length].parse::<f64>().ok().filter(|number| number.is_finite());
            let shown = &rest[..length];
            let no_number = || format!("\"{text}\" is not a formula: \"{shown}\" is no number");
            parts.push(Part::Number(number.ok_or_else(no_number)?, shown));
            length
        } else if next.is_alphabetic() || next == '_' {
            let stop = |c: char| !(c.is_alphanumeric() || c == '_' || c == '.');
            let length = rest.find(stop).unwrap_or(rest.len());
            let word = &rest[..length];
            let is_called = rest[length..].trim_start().starts_with('(');
            if is_called && !FUNCTIONS.contains(&word) {
                let known = FUNCTIONS.join(", ");
                return Err(format!("\"{text}\" calls \"{word}\"; functions are {known}"));
            }
            parts.push(if is_called { Part::Function(word) } else { Part::Name(word) });
            length
        } else if next.is_whitespace() || "+-*/^(),".contains(next) {
            if !next.is_whitespace() {
                parts.push(Part::Sign(next));
            }
            next.len_utf8()
        } else {
            return Err(format!("\"{text}\" is not a formula: \"{next}\" has no meaning in one"));
        };
        rest = &rest[length..];
    }
    Ok(parts)
}

/// Length of the number at the start of a text.
fn length_of_number(text: &str) -> usize {
    let digits = |from: usize| {
        let stop = text[from..].find(|c: char| !(c.is_ascii_digit() || c == '.'));
        stop.map_or(text.len(), |at| from + at)
    };
    let mantissa = digits(0);
    if text[mantissa..].starts_with(['e', 'E']) {
        let sign = usize::from(text[mantissa + 1..].starts_with(['+', '-']));
        let exponent = digits(mantissa + 1 + sign);
        if exponent > mantissa + 1 + sign {
            return exponent;
        }
    }
    mantissa
}

struct Reader<'a> {
    text: &'a str,
    parts: Vec<Part<'a>>,
    at: usize,
    nested: usize,
    /// Results that wait for what is done with them.
    held: usize,
    read: Read,
}

impl<'a> Reader<'a> {
    fn broken(&self, why: &str) -> String {
        format!("\"{}\" is not a formula: {why}", self.text)
    }

    fn peek(&self) -> Option<Part<'a>> {
        self.parts.get(self.at).copied()
    }

    fn next(&mut self) -> Option<Part<'a>> {
        let part = self.peek();
        self.at += 1;
        part
    }

    /// Takes the next part if it is one of these signs.
    fn sign(&mut self, signs: &str) -> Option<char> {
        match self.peek() {
            Some(Part::Sign(sign)) if signs.contains(sign) => {
                self.at += 1;
                Some(sign)
            }
            _ => None,
        }
    }

    /// A sign before the first term is a subtraction from zero, so that -x^2 is -(x²).
    fn sum(&mut self) -> Result<(), String> {
        if matches!(self.peek(), Some(Part::Sign('+' | '-'))) {
            self.hold(Operation::Constant(0.0))?;
        } else {
            self.product()?;
        }
        self.joined_by("+-", Self::product)
    }

    fn product(&mut self) -> Result<(), String> {
        self.power()?;
        self.joined_by("*/", Self::power)
    }

    fn power(&mut self) -> Result<(), String> {
        self.atom()?;
        self.joined_by("^", Self::atom)
    }

    /// What follows the first part, as long as one of these signs comes next.
    fn joined_by(
        &mut self,
        signs: &str,
        part: impl Fn(&mut Self) -> Result<(), String>,
    ) -> Result<(), String> {
        while let Some(sign) = self.sign(signs) {
            part(self)?;
            self.join(sign);
        }
        Ok(())
    }

    fn atom(&mut self) -> Result<(), String> {
        match self.next() {
            Some(Part::Number(number, _)) => self.hold(Operation::Constant(number)),
            Some(Part::Name(PI)) => {
                self.read.names_pi = true;
                self.hold(Operation::Constant(std::f64::consts::PI))
            }
            Some(Part::Name(name)) => {
                let names = &mut self.read.names;
                let number = names.iter().position(|known| known == name).unwrap_or_else(|| {
                    names.push(name.to_owned());
                    names.len() - 1
                });
                self.hold(Operation::Name(number as u32))
            }
            Some(Part::Function(name)) => self.call(name),
            Some(Part::Sign('(')) => {
                self.inside(Self::sum)?;
                self.closed()
            }
            Some(Part::Sign(sign)) => Err(self.nothing_before(sign)),
            None => Err(self.broken("it ends too early")),
        }
    }

    /// What is wrong where a sign stands in the place of a number.
    fn nothing_before(&self, sign: char) -> String {
        let before = self.at.checked_sub(2).and_then(|at| self.parts.get(at));
        let is_operator = |sign: char| Binary::signed(sign).is_some();
        match before {
            Some(Part::Sign(first)) if is_operator(*first) && is_operator(sign) => {
                let text = self.text;
                format!("\"{text}\" has two operators in a row; put the second into parentheses")
            }
            _ => self.broken(&format!("something is missing before \"{sign}\"")),
        }
    }

    fn inside(&mut self, read: impl FnOnce(&mut Self) -> Result<(), String>) -> Result<(), String> {
        self.nested += 1;
        if self.nested > MOST_NESTED {
            return Err(self.too_deep());
        }
        read(self)?;
        self.nested -= 1;
        Ok(())
    }

    fn closed(&mut self) -> Result<(), String> {
        self.sign(")").map(drop).ok_or_else(|| self.broken("a ) is missing"))
    }

    fn call(&mut self, name: &str) -> Result<(), String> {
        // The part after a function opens its arguments.
        self.at += 1;
        self.inside(Self::sum)?;
        if let Some(function) = Unary::named(name) {
            if self.sign(",").is_some() {
                return Err(self.broken(&format!("{name} takes one argument")));
            }
            self.read.operations.push(Operation::Unary(function));
        } else if let Some(function) = Binary::named(name) {
            if self.sign(",").is_none() {
                return Err(self.broken(&format!("{name} takes two arguments")));
            }
            self.inside(Self::sum)?;
            self.read.operations.push(Operation::Binary(function));
            self.held -= 1;
        }
        self.closed()
    }

    fn hold(&mut self, operation: Operation) -> Result<(), String> {
        self.read.operations.push(operation);
        self.held += 1;
        if self.held > DEEPEST { Err(self.too_deep()) } else { Ok(()) }
    }

    fn too_deep(&self) -> String {
        self.broken("parts of it are nested too deeply")
    }

    /// Joins the last two results; those of two constants are one already.
    fn join(&mut self, sign: char) {
        let Some(operator) = Binary::signed(sign) else { return };
        self.held -= 1;
        let operations = &mut self.read.operations;
        if let [.., Operation::Constant(a), Operation::Constant(b)] = operations[..] {
            operations.truncate(operations.len() - 2);
            operations.push(Operation::Constant(operator.value(a, b)));
        } else {
            operations.push(Operation::Binary(operator));
        }
    }
}
