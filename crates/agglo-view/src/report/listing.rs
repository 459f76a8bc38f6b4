//! The scenario with its defaults marked.

use serde::Deserialize;
use toml::Value;

use agglo::scenario::Scenario;

/// A line of a scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// Its text.
    pub text: String,
    /// Whether the value would be the same without it.
    pub is_default: bool,
}

/// The lines of a resolved scenario's text.
///
/// A value is a default if the scenario is the same without it: it is left out, read again and compared.
pub fn listing(scenario: &Scenario, text: &str) -> Vec<Line> {
    let Ok(whole) = text.parse::<toml::Table>() else { return plain(text) };
    let mut table = Vec::new();
    let mut counts: Vec<(String, usize)> = Vec::new();
    text.lines()
        .map(|line| {
            if let Some(header) = line.strip_prefix('[') {
                table = path_of(header, &mut counts);
            }
            let key =
                line.split_once('=').map(|(key, _)| key.trim()).filter(|_| !line.starts_with(['#', '[']));
            let is_default = key.is_some_and(|key| {
                let path: Vec<&str> = table.iter().map(String::as_str).chain([key]).collect();
                let mut reduced = Value::Table(whole.clone());
                remove(&mut reduced, &path)
                    && Scenario::deserialize(reduced).is_ok_and(|same| same == *scenario)
            });
            Line { text: line.to_owned(), is_default }
        })
        .collect()
}

/// The lines without marks.
pub fn plain(text: &str) -> Vec<Line> {
    text.lines().map(|line| Line { text: line.to_owned(), is_default: false }).collect()
}

/// The path of a table's header; lists count their entries.
fn path_of(header: &str, counts: &mut Vec<(String, usize)>) -> Vec<String> {
    let is_list = header.starts_with('[');
    let name = header.trim_matches(['[', ']']);
    if is_list {
        match counts.iter_mut().find(|(known, _)| known == name) {
            Some((_, count)) => *count += 1,
            None => counts.push((name.to_owned(), 0)),
        }
    }
    let mut path = Vec::new();
    let mut so_far = String::new();
    for word in name.split('.') {
        so_far = if so_far.is_empty() { word.to_owned() } else { format!("{so_far}.{word}") };
        path.push(word.trim_matches('"').to_owned());
        if let Some((_, count)) = counts.iter().find(|(known, _)| *known == so_far) {
            path.push(count.to_string());
        }
    }
    path
}

/// Takes a value away; whether it was there.
fn remove(value: &mut Value, path: &[&str]) -> bool {
    match (value, path) {
        (Value::Table(table), [key]) => table.remove(*key).is_some(),
        (Value::Table(table), [key, rest @ ..]) => {
            table.get_mut(*key).is_some_and(|inner| remove(inner, rest))
        }
        (Value::Array(items), [index, rest @ ..]) => index
            .parse()
            .ok()
            .and_then(|at: usize| items.get_mut(at))
            .is_some_and(|inner| remove(inner, rest)),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use agglo::scenario::template;

    #[test]
    fn defaults_are_marked_and_choices_are_not() {
        let scenario = Scenario::from_toml(template("acoustic-published").unwrap().text).unwrap().resolved();
        let text = scenario.to_toml().unwrap();
        let lines = listing(&Scenario::from_toml(&text).unwrap(), &text);
        let mark = |start: &str| lines.iter().find(|line| line.text.starts_with(start)).unwrap().is_default;
        assert!(mark("polarity ="), "no one asked for a polarity");
        assert_false!(mark("version ="), "the key stands in the file");
        assert!(!mark("end ="), "the end of time is given");
        assert_eq!(
            lines.iter().map(|line| line.text.as_str()).collect::<Vec<_>>(),
            text.lines().collect::<Vec<_>>()
        );
    }
}
