//! Text of others as a terminal may show it: names, titles, cells and paths can hold codes that move the cursor, recolor
//! the screen or turn the direction of writing. The one function through which such text goes.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Characters of a value that a message quotes.
const LONGEST: usize = 80;

/// The text with every character that acts on the terminal written out, such as `\u{1b}`. Line ends and tabs stay.
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::text::visible;
/// assert_eq!(visible("a \u{1b}[31mred\u{1b}[0m title\n"), "a \\u{1b}[31mred\\u{1b}[0m title\n");
/// ```
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(acts) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if acts(c) {
            // Writing to a string cannot fail.
            let _ = write!(shown, "{}", c.escape_unicode());
        } else {
            shown.push(c);
        }
    }
    Cow::Owned(shown)
}

/// The same in one line, cut at a length that a message can quote.
pub fn cell(text: &str) -> String {
    let mut short: String = text.chars().take(LONGEST).collect();
    if short.len() < text.len() {
        short.push_str("...");
    }
    visible(&short).replace('\n', "\\n").replace('\t', "\\t")
}

/// Controls of both sets, and what turns the direction of writing or breaks lines.
fn acts(c: char) -> bool {
    (c.is_control() && c != '\n' && c != '\t')
        || matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_acts_on_a_terminal_is_written_out() {
        for acting in ["\u{1b}", "\u{7}", "\r", "\u{8}", "\u{7f}", "\u{9b}", "\u{202e}", "\u{2066}", "\0"] {
            let shown = visible(acting);
            assert!(shown.starts_with("\\u{") && shown.is_ascii(), "{acting:?}: {shown}");
        }
        let harmless = "Korngrößen µm, 10 °C: 砂 \t|\n";
        assert_matches!(visible(harmless), Cow::Borrowed(text) if *text == harmless);
    }

    #[test]
    fn cells_are_cut() {
        assert_eq!(cell(&"µ".repeat(1_000_000)), "µ".repeat(80) + "...");
        assert_eq!(cell("two\nlines\u{1b}"), "two\\nlines\\u{1b}");
    }
}
