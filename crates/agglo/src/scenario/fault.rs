//! What is wrong with a scenario: every fault at once, each with its place, its key and what to do.

use std::fmt;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use serde::Serialize;

use crate::text::visible;

/// One thing that is wrong with a scenario. Programs are told of it under these names, but for the bytes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Fault {
    /// Line in the file, from 1; none where the fault has no line (a missing key of the whole file, a setting).
    pub line: Option<usize>,
    /// Column in that line in characters, from 1.
    pub column: Option<usize>,
    /// Bytes of the file, or of `setting` if there is one, that are meant.
    #[serde(skip)]
    pub span: Option<Range<usize>>,
    /// The setting `key=value` that is at fault, where it is not the file.
    pub setting: Option<String>,
    /// Path of the key, such as `acoustics.beams.0.rays`; empty for faults of syntax.
    pub key: String,
    /// What was found and what is allowed.
    pub message: String,
    /// What to do: the nearest valid word, the place where a key belongs.
    pub help: Option<String>,
}

impl Fault {
    /// A fault of a key, not yet placed in a file.
    pub(crate) fn new(key: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            line: None,
            column: None,
            span: None,
            setting: None,
            key: key.into(),
            message: message.into(),
            help: None,
        }
    }

    /// The same with an advice.
    pub(crate) fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The key and the message in one line.
    pub fn headline(&self) -> String {
        if self.key.is_empty() { self.message.clone() } else { format!("{}: {}", self.key, self.message) }
    }

    fn group<'a>(&'a self, source: &'a str, filename: &'a str) -> Group<'a> {
        let (text, path) = match &self.setting {
            Some(setting) => (setting.as_str(), "--set"),
            None => (source, filename),
        };
        let mut group = Group::with_title(Level::ERROR.primary_title(visible(&self.headline()).into_owned()));
        if let Some(span) = &self.span {
            let (lines, number, span) = window(text, span);
            let mark = AnnotationKind::Primary.span(span);
            group = group.element(Snippet::source(lines).line_start(number).path(path).annotation(mark));
        }
        match &self.help {
            Some(help) => group.element(Level::HELP.message(visible(help).into_owned())),
            None => group,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let (Some(line), Some(column)) = (self.line, self.column) {
            write!(f, "line {line}, column {column}: ")?;
        }
        if let Some(setting) = &self.setting {
            write!(f, "--set {setting}: ")?;
        }
        write!(f, "{}", self.headline())?;
        self.help.as_ref().map_or(Ok(()), |help| write!(f, "; {help}"))
    }
}

/// Everything that is wrong with a scenario, in the order of the file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Faults(Vec<Fault>);

impl Faults {
    /// Sorts faults by their place; those without one come last.
    pub(crate) fn new(mut faults: Vec<Fault>) -> Self {
        faults.sort_by_key(|fault| {
            (fault.setting.is_some(), fault.line.is_none(), fault.line, fault.column, fault.key.clone())
        });
        Self(faults)
    }

    /// The faults one by one.
    pub fn iter(&self) -> std::slice::Iter<'_, Fault> {
        self.0.iter()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All faults with the lines of `source` that they point to; `color` adds terminal colors. Nothing else in it acts on
    /// a terminal.
    pub fn render(&self, source: &str, filename: &str, color: bool) -> String {
        let filename = &*visible(filename);
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        let pages: Vec<String> =
            self.iter().map(|fault| renderer.render(&[fault.group(source, filename)])).collect();
        let count = match self.len() {
            1 => "1 fault".to_owned(),
            count => format!("{count} faults"),
        };
        format!("{}\n\n{count} in {filename}; nothing was run or written", pages.join("\n\n"))
    }
}

impl<'a> IntoIterator for &'a Faults {
    type Item = &'a Fault;
    type IntoIter = std::slice::Iter<'a, Fault>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.iter().map(Fault::to_string).collect();
        write!(f, "{}", lines.join("\n"))
    }
}

impl std::error::Error for Faults {}

/// The lines of a text that a span stands in, without what acts on a terminal: their text, the number of the first of them
/// from 1, and the span in that text.
fn window(text: &str, span: &Range<usize>) -> (String, usize, Range<usize>) {
    let boundary =
        |at: usize| (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0);
    let (start, end) = (boundary(span.start), boundary(span.end.max(span.start)));
    let first = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
    // A table goes on for many lines; its first says which it is.
    let line_end = |from: usize| text[from..].find('\n').map_or(text.len(), |newline| from + newline);
    let end = end.min(line_end(start));
    let last = line_end(end);
    let (first, cut) =
        (boundary(first.max(start.saturating_sub(FARTHEST))), boundary(last.min(end + FARTHEST)));
    let [before, marked, after] = [&text[first..start], &text[start..end], &text[end..cut]].map(visible);
    let from = before.len();
    let to = from + marked.len();
    let number = text[..first].matches('\n').count() + 1;
    (format!("{before}{marked}{after}"), number, from..to)
}

/// Bytes of a line that are shown before and after what is meant.
const FARTHEST: usize = 200;

/// Line and column, from 1, of a byte in a text.
pub(super) fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let mut at = byte.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    let before = &text[..at];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

/// No word of ours is half as long.
const LONGEST_WORD: usize = 100;

/// The word of `words` that `word` most probably stands for.
pub(crate) fn nearest<'a>(word: &str, words: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Nobody means a short word by a long text, and to compare them takes long.
    if word.len() > LONGEST_WORD {
        return None;
    }
    let lower = word.to_lowercase().replace('-', "_");
    let close = |known: &str| {
        let edits = strsim::normalized_damerau_levenshtein(&lower, known);
        let starts = strsim::jaro_winkler(&lower, known) - 0.25;
        edits.max(starts)
    };
    let mut best: Option<(f64, &str)> = None;
    for known in words {
        let score = close(known);
        if score >= 0.5 && best.is_none_or(|(highest, _)| score > highest) {
            best = Some((score, known));
        }
    }
    best.map(|(_, known)| known)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_characters_not_bytes() {
        assert_eq!(line_and_column("a\nµb", 0), (1, 1));
        assert_eq!(line_and_column("a\nµb", 4), (2, 2));
        assert_eq!(line_and_column("a\nµb", 99), (2, 3));
    }

    #[test]
    fn the_nearest_word_is_near() {
        let words = ["hertz", "hooke", "strain_power"];
        assert_eq!(nearest("Hertzz", words), Some("hertz"));
        assert_eq!(nearest("strain-power", words), Some("strain_power"));
        assert_eq!(nearest("viscosity", words), None);
    }

    #[test]
    fn a_rendered_fault_shows_its_line() {
        let source = "version = 1\nseed = \"x\"\n";
        let mut fault = Fault::new("seed", "found a string").with_help("write a number");
        fault.span = Some(19..22);
        let page = Faults::new(vec![fault]).render(source, "my.toml", false);
        assert!(page.contains("seed: found a string") && page.contains("my.toml:2:8"), "{page}");
        assert!(page.contains("seed = \"x\"") && page.contains("help: write a number"), "{page}");
    }
}
