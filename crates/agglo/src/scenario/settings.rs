//! Settings `key.path=value` that replace or add values of a scenario file.

use toml::de::DeValue;

use super::fault::Fault;
use super::tree::{Entry, Node, Place, Value};

/// Puts the value of one setting into the tree, or says what is wrong; `source` is its number, from 1.
pub(super) fn apply(root: &mut Node, setting: &str, source: usize) -> Option<(Place, Fault)> {
    let place = |span| Place { source, span };
    let Some(end) = outside_quotes(setting, '=').next() else {
        let fault = Fault::new("", format!("\"{setting}\" is not a setting; key.path=value is wanted"));
        return Some((place(0..setting.len()), fault.with_help("for example time.end=\"1 s\"")));
    };
    let key = &setting[..end];
    let path = words(key);
    let path: Vec<&str> = path.iter().map(String::as_str).collect();
    let key_place = place(0..key.len());
    if path.iter().any(|word| word.is_empty()) {
        let fault = Fault::new("", format!("\"{}\" is not a path of keys", key.trim()));
        return Some((key_place, fault.with_help("for example acoustics.beams.0.rays=500")));
    }
    let value = value_of(setting, key.len() + 1, source);
    let refused = put(root, &path, &key_place, value).err()?;
    Some((key_place, Fault::new(key.trim(), refused)))
}

/// Where a character stands outside of quotes.
fn outside_quotes(text: &str, wanted: char) -> impl Iterator<Item = usize> {
    let mut quote = None;
    text.char_indices().filter_map(move |(at, c)| {
        match quote {
            Some(open) if c == open => quote = None,
            Some(_) => return None,
            None if c == '"' || c == '\'' => quote = Some(c),
            None => return (c == wanted).then_some(at),
        }
        None
    })
}

/// The words of a path; a word in quotes can have points.
fn words(key: &str) -> Vec<String> {
    let ends = outside_quotes(key, '.').chain([key.len()]);
    let mut from = 0;
    ends.map(|end| {
        let word = key[from..end].trim();
        from = end + 1;
        let bare = ['"', '\''].iter().find_map(|&quote| word.strip_prefix(quote)?.strip_suffix(quote));
        bare.unwrap_or(word).to_owned()
    })
    .collect()
}

/// The value: TOML if it is, else the text itself as a string.
fn value_of(setting: &str, start: usize, source: usize) -> Node {
    let text = setting[start..].trim();
    let begin = setting.len() - setting[start..].trim_start().len();
    match DeValue::parse(text) {
        Ok(parsed) => {
            let mut node = Node::from_toml(&parsed, source);
            shift(&mut node, begin);
            node
        }
        Err(_) => Node {
            place: Place { source, span: begin..begin + text.len() },
            value: Value::Text(text.to_owned()),
        },
    }
}

fn shift(node: &mut Node, by: usize) {
    let move_place = |place: &mut Place| place.span = place.span.start + by..place.span.end + by;
    move_place(&mut node.place);
    match &mut node.value {
        Value::List(items) => items.iter_mut().for_each(|item| shift(item, by)),
        Value::Table(entries) => {
            for entry in entries {
                move_place(&mut entry.place);
                shift(&mut entry.node, by);
            }
        }
        _ => {}
    }
}

fn put(node: &mut Node, path: &[&str], place: &Place, value: Node) -> Result<(), String> {
    let Some((word, rest)) = path.split_first() else {
        *node = value;
        return Ok(());
    };
    match &mut node.value {
        Value::Table(entries) => {
            let at = entries.iter().position(|entry| entry.key == *word).unwrap_or_else(|| {
                let empty = Node { place: place.clone(), value: Value::Table(Vec::new()) };
                entries.push(Entry { key: (*word).to_owned(), place: place.clone(), node: empty });
                entries.len() - 1
            });
            put(&mut entries[at].node, rest, place, value)
        }
        Value::List(items) => {
            let count = items.len();
            let index = word.parse::<usize>().ok().filter(|index| *index < count);
            let Some(index) = index else {
                return Err(format!("\"{word}\" is no entry of a list of {count}; the first is 0"));
            };
            put(&mut items[index], rest, place, value)
        }
        other => Err(format!("\"{word}\" cannot be set inside {}", other.found())),
    }
}
