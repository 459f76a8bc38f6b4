//! No assertion of the tree fails with its own source text alone.

use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Blanks out comments, and texts with zeros, character by character, so that places stay; lines keep their ends.
fn without_words(text: &str) -> Vec<char> {
    let mut left: Vec<char> = text.chars().collect();
    let mut at = 0;
    while at < left.len() {
        let end = end_of_words(&left, at);
        // A comment is nothing, a text is an argument.
        let filler = if left[at] == '/' { ' ' } else { '0' };
        left[at..end].iter_mut().filter(|letter| **letter != '\n').for_each(|letter| *letter = filler);
        at = end.max(at + 1);
    }
    left
}

/// End of the comment, text or character that begins at `at`, or `at` where none does.
fn end_of_words(letters: &[char], at: usize) -> usize {
    let rest = &letters[at..];
    let find = |from: usize, ends: &[char]| {
        (from..rest.len())
            .find(|&k| rest[k..].starts_with(ends))
            .map_or(letters.len(), |k| at + k + ends.len())
    };
    let is_word = at > 0 && (letters[at - 1].is_alphanumeric() || letters[at - 1] == '_');
    match rest {
        ['/', '/', ..] => find(2, &['\n']),
        ['/', '*', ..] => find(2, &['*', '/']),
        ['r', '"' | '#', ..] if !is_word => {
            let marks = rest[1..].iter().take_while(|letter| **letter == '#').count();
            if rest.get(1 + marks) != Some(&'"') {
                return at;
            }
            let mut ends = vec!['"'];
            ends.resize(1 + marks, '#');
            find(2 + marks, &ends)
        }
        ['"', ..] => {
            let mut k = 1;
            while k < rest.len() && rest[k] != '"' {
                k += if rest[k] == '\\' { 2 } else { 1 };
            }
            (at + k + 1).min(letters.len())
        }
        ['\'', '\\', _, ..] => find(3, &['\'']),
        ['\'', _, '\'', ..] => at + 3,
        _ => at,
    }
}

/// Lines of the assertions of a source text that have no words.
fn bare(text: &str) -> Vec<usize> {
    let letters = without_words(text);
    let name: Vec<char> = "assert!(".chars().collect();
    let mut lines = Vec::new();
    for at in 0..letters.len() {
        let before = at.checked_sub(1).map_or(' ', |k| letters[k]);
        if letters[at..].starts_with(&name) && !before.is_alphanumeric() {
            // `debug_assert!` as well; other macros of such a name show their operands.
            let prefix: String =
                letters[..at].iter().rev().take_while(|c| c.is_alphanumeric() || **c == '_').collect();
            if (prefix.is_empty() || prefix == "_gubed") && arguments(&letters[at + name.len()..]) < 2 {
                lines.push(letters[..at].iter().filter(|letter| **letter == '\n').count() + 1);
            }
        }
    }
    lines
}

/// Number of arguments up to the closing bracket.
fn arguments(letters: &[char]) -> usize {
    let (mut depth, mut count, mut is_empty) = (0, 0, true);
    for letter in letters {
        match letter {
            '(' | '[' | '{' => depth += 1,
            ')' if depth == 0 => return count + usize::from(!is_empty),
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 => {
                count += 1;
                is_empty = true;
                continue;
            }
            _ => {}
        }
        is_empty &= letter.is_whitespace();
    }
    count
}

/// All sources below a folder.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in folder.read_dir().expect("the sources are there").flatten() {
        let path = entry.path();
        if path.is_dir() && !path.ends_with("target") {
            sources(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn every_assertion_of_the_tree_says_what_it_found() {
    let mut found = Vec::new();
    sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join(".."), &mut found);
    assert!(found.len() > 400, "only {} sources were read", found.len());
    found.sort();
    let mut faults = String::new();
    for path in found {
        let text = std::fs::read_to_string(&path).expect("a source");
        for line in bare(&text) {
            let _ = writeln!(faults, "  {}:{line}", path.display());
        }
    }
    assert!(
        faults.is_empty(),
        "assert! without words, whose failure shows no value: take a macro of agglo-testing, or add words with the value\n{faults}"
    );
}

/// The sample has its bare ones on the lines that say so.
#[test]
fn the_bare_ones_of_a_sample_are_found() {
    let sample = r##"
//! assert!(in_a_comment);
assert!(a < b); // bare
assert!(a < b, "{a}");
assert!(text.contains(", "), "{text}");
assert!(text.contains(", ")); // bare
    assert!(f(a, b), // why
        "words");
debug_assert!(a.iter().all(|x| { g(x, 1) }),); // bare
assert!(c == ',' && d == '"' || e == '\''); // bare
assert_close!(a, b, 1.0); prop_assert!(a); let x = "assert!(a)";
assert!(
    a,
    r#"raw " words, {a}"#
);
assert!(x, r"\"); assert!(y); // bare
"##;
    let wanted: Vec<usize> = sample
        .lines()
        .enumerate()
        .filter(|(_, line)| line.ends_with("// bare"))
        .map(|(at, _)| at + 1)
        .collect();
    assert_eq!(bare(sample), wanted);
}
