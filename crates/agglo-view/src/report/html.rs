//! The page: one file with everything in it.

use std::collections::BTreeMap;
use std::io::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;

use super::cite::{PAPERS, Paper};
use super::{Citation, Line, Listing, QuantityTable, Report};
use crate::chart::{Chart, Drawn};
use crate::plot::{LINES, Map, NAMED, PLAIN};
use agglo::folder::names::SCENARIO;

const STYLE: &str = include_str!("page/page.css");
/// The script as it stands between its tags, made of those in `page/`, and its digest; see `build.rs`.
const SCRIPT: &str = include_str!(concat!(env!("OUT_DIR"), "/page.js"));
const SCRIPT_DIGEST: &str = include_str!(concat!(env!("OUT_DIR"), "/page.sha256"));
const STAGE: &str = include_str!("page/replay.html");
const LICENSES: &str = include_str!("page/licenses.html");
/// Plotly.js as base64 of deflated bytes, and the digest of its text; see `build.rs`.
const PLOTLY: &str = include_str!(concat!(env!("OUT_DIR"), "/plotly.min.js.deflate.base64"));
const PLOTLY_DIGEST: &str = include_str!(concat!(env!("OUT_DIR"), "/plotly.sha256"));

/// Nothing may be loaded from anywhere, and no script runs but the page's own and the charts' library, told by their
/// digests: not what stands in a title or a name, should it ever get past the escaping. The charts compile some of their
/// drawing as they go.
fn policy() -> String {
    format!(
        "default-src 'none'; script-src {SCRIPT_DIGEST} {PLOTLY_DIGEST} 'unsafe-eval'; style-src 'unsafe-inline'; \
         img-src data: blob:; base-uri 'none'; form-action 'none'"
    )
}

/// The text as it may stand in a page.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

impl Report {
    /// The whole page.
    pub fn page(&self) -> String {
        let (title, policy) = (escaped(&self.title), policy());
        let mut page = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n"
        );
        let sections = [
            self.head(),
            self.notes(),
            self.links(),
            self.stage(),
            self.tables_of(true),
            self.charts(),
            self.tables_of(false),
            self.files.iter().map(file).collect(),
            self.sources(),
        ];
        page.extend(sections);
        page.push_str("</main>\n");
        page.push_str(&foot());
        page.push_str(&self.data());
        page.push_str("</body>\n</html>\n");
        page
    }

    fn head(&self) -> String {
        let (title, story, kind) = (escaped(&self.title), escaped(&self.story), escaped(&self.kind));
        format!(
            "<header>\n<p class=\"soft\">{kind}</p>\n<h1>{title}</h1>\n<p class=\"story\">{story}</p>\n</header>\n<main>\n\
             <noscript><p class=\"note\">The replay and the charts need JavaScript, which this browser does not \
             run.</p></noscript>\n"
        )
    }

    fn notes(&self) -> String {
        if self.notes.is_empty() {
            return String::new();
        }
        let item = |note: &String| format!("<li>{}</li>\n", escaped(note));
        let items: String = self.notes.iter().map(item).collect();
        format!(
            "<section class=\"note\" id=\"notes\">\n<p>What is not here, or not whole:</p>\n<ul>\n{items}</ul>\n</section>\n"
        )
    }

    fn stage(&self) -> String {
        let Some(replay) = &self.replay else { return String::new() };
        let has = |array: &str| replay.plan.frames.iter().any(|frame| frame.arrays.contains_key(array));
        STAGE
            .replace("{{bonds}}", &switch("bonds", has("bonds")))
            .replace("{{rays}}", &switch("rays", has("ray_x")))
            .replace("{{walls}}", &switch("walls", has("wall_x")))
    }

    fn charts(&self) -> String {
        if self.charts.is_empty() {
            return String::new();
        }
        let cards: String = self.charts.iter().map(card).collect();
        format!(
            "<h2>Charts</h2>\n<p class=\"soft\">Point to see values, drag to zoom, double click to go back, click a \
             name to hide its line.</p>\n<section id=\"charts\" class=\"charts\">\n{cards}</section>\n"
        )
    }

    /// The tables that stand before the charts, or those after them.
    fn tables_of(&self, first: bool) -> String {
        self.tables.iter().filter(|table| table.is_first == first).map(table).collect()
    }

    fn links(&self) -> String {
        let link = |[place, what]: &[String; 2]| {
            format!("<p><a href=\"{}\">{}</a></p>\n", escaped(place), escaped(what))
        };
        self.links.iter().map(link).collect()
    }

    fn sources(&self) -> String {
        let program = escaped(&super::cite::program());
        let items: String = self.citations.iter().map(source).collect();
        let paper = |paper: &Paper| format!("<li><b>{}</b>: {}</li>\n", paper.label, escaped(&paper.whole()));
        let papers: String = PAPERS.iter().filter(|paper| self.mentions(paper.label)).map(paper).collect();
        let unknown = format!("<li>The laws are not known: {SCENARIO} cannot be read.</li>\n");
        let unknown = if self.laws_are_unknown { unknown.as_str() } else { "" };
        format!(
            "<h2>What to cite</h2>\n<ul class=\"card sources\">\n<li>{program}</li>\n{items}{papers}{unknown}</ul>\n"
        )
    }

    /// Whether captions and sources speak of the paper of that label.
    fn mentions(&self, label: &str) -> bool {
        let sources = self.citations.iter().map(|citation| &citation.source);
        let abouts = self.tables.iter().map(|table| &table.about);
        let captions = self.charts.iter().map(|chart| &chart.caption);
        sources.chain(abouts).chain(captions).any(|text| text.contains(label))
    }

    /// The data and the scripts at the end of the page.
    fn data(&self) -> String {
        let plan = self.replay.as_ref().map(|replay| &replay.plan);
        let data = serde_json::json!({ "replay": plan, "charts": self.charts, "palette": palette() });
        // Within a script only `</` and `<!--` could end it early.
        let data = data.to_string().replace('<', "\\u003c");
        let frames = self.replay.as_ref().map_or_else(String::new, |replay| replay.packed.clone());
        let plotly = if self.charts.is_empty() { "" } else { PLOTLY };
        format!(
            "<script type=\"application/json\" id=\"report\">{data}</script>\n\
             <script type=\"text/plain\" id=\"frames\">{frames}</script>\n\
             <script type=\"text/plain\" id=\"plotly\">{plotly}</script>\n\
             <script type=\"module\">{SCRIPT}</script>\n"
        )
    }
}

/// The colors of the page: maps by their words, colors of names, lines with their dashes.
fn palette() -> serde_json::Value {
    let text = |color: u32| format!("{color:06x}");
    let stops = |map: Map| map.stops().map(text).collect::<Vec<_>>();
    let maps: BTreeMap<_, _> = Map::WORDS.iter().map(|&(word, map)| (word, stops(map))).collect();
    serde_json::json!({ "maps": maps, "names": NAMED.map(text), "plain": text(PLAIN), "lines": lines() })
}

/// Colors, dashes and widths [pixels] of lines: those of charts, and once more in the same colors, but with the dashes
/// of another and wider, so that twelve lines can be told apart.
fn lines() -> Vec<(String, &'static str, f64)> {
    let count = LINES.len();
    let line = |number: usize| {
        let (color, _) = LINES[number % count];
        let again = number / count;
        (color.to_string(), LINES[(number + again * count / 2) % count].1, if again == 0 { 2.0 } else { 4.0 })
    };
    (0..2 * count).map(line).collect()
}

fn switch(name: &str, is_there: bool) -> String {
    if is_there {
        format!("<label><input type=\"checkbox\" data-part=\"{name}\" checked> {name}</label>")
    } else {
        String::new()
    }
}

fn card(chart: &Chart) -> String {
    let (id, title, caption) = (escaped(&chart.id), escaped(&chart.title), escaped(&chart.caption));
    let item = |words: &String| format!("<li>{}</li>", escaped(words));
    let words: String = chart.words.iter().map(item).collect();
    let words = if words.is_empty() {
        words
    } else {
        format!("<details><summary>In words</summary><ul>{words}</ul></details>\n")
    };
    let class =
        if matches!(chart.drawn, Drawn::Parallel(_) | Drawn::Pairs(_)) { "card whole" } else { "card" };
    format!(
        "<figure class=\"{class}\">\n<h3>{title}</h3>\n<div class=\"chart\" id=\"chart-{id}\" role=\"img\" \
         aria-label=\"{title}. {caption}\"></div>\n<figcaption>{caption}</figcaption>\n{words}</figure>\n"
    )
}

fn table(table: &QuantityTable) -> String {
    // Names of columns are long words, which may break after an underscore.
    let head = |name: &String| format!("<th scope=\"col\">{}</th>", escaped(name).replace('_', "_<wbr>"));
    let head: String = table.head.iter().map(head).collect();
    let head = if table.head.is_empty() { head } else { format!("<tr>{head}</tr>\n") };
    let cell = |cell: &String| format!("<td>{}</td>", escaped(cell));
    let row = |row: &Vec<String>| {
        let cells: String = row.iter().map(cell).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let rows: String = table.rows.iter().map(row).collect();
    let about = match table.about.as_str() {
        "" => String::new(),
        about => format!("<p class=\"soft\">{}</p>\n", escaped(about)),
    };
    format!(
        "<h2>{}</h2>\n{about}<div class=\"card wide{}\" tabindex=\"0\"><table>\n{head}{rows}</table></div>\n",
        escaped(&table.title),
        if table.is_first { " numbers" } else { "" }
    )
}

fn file(file: &Listing) -> String {
    if file.lines.is_empty() {
        return String::new();
    }
    let lines: String = file.lines.iter().map(line).collect();
    let title = escaped(&file.title);
    let any = file.lines.iter().any(|line| line.is_default);
    let marks = if any { "; defaults are gray and marked <i>default</i>" } else { "" };
    format!(
        "<h2>{title}</h2>\n<details class=\"card file\"><summary>Show the file{marks}</summary>\n<pre>{lines}</pre>\
         </details>\n"
    )
}

fn line(line: &Line) -> String {
    let text = escaped(&line.text);
    if line.is_default {
        format!("<span class=\"default\">{text}<i>  default</i></span>\n")
    } else {
        format!("<span>{text}</span>\n")
    }
}

fn source(citation: &Citation) -> String {
    let (title, source) = (escaped(citation.title.trim_end_matches('.')), escaped(&citation.source));
    format!("<li><b>{}</b> ({title}): {source}</li>\n", citation.law)
}

fn foot() -> String {
    let version = env!("CARGO_PKG_VERSION");
    format!(
        "<footer>\n<p class=\"soft\">Written by agglo {version}. This file asks nothing of the network.</p>\n{LICENSES}\
         </footer>\n"
    )
}

/// Base64 of deflated bytes.
pub fn deflated(bytes: &[u8]) -> String {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::fast());
    // Writing to a vector cannot fail.
    let packed = encoder.write_all(bytes).and_then(|()| encoder.finish()).unwrap_or_default();
    STANDARD.encode(packed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_of_twelve_lines_look_alike() {
        let lines = lines();
        assert_eq!(lines.len(), 12);
        for (at, (color, dashes, width)) in lines.iter().enumerate() {
            // Told apart by color, and without colors by dashes or width.
            let alike = |other: &(String, &str, f64)| (other.1, other.2) == (*dashes, *width);
            assert!(!lines[..at].iter().any(alike), "{at}");
            assert!(!lines[..at].iter().any(|other| other.0 == *color && other.1 == *dashes), "{at}");
        }
    }

    #[test]
    fn what_users_write_cannot_break_the_page() {
        let hostile = "</script><script>alert(1)</script>\" onload=\"x & <!--".to_owned();
        let report = Report {
            title: hostile.clone(),
            story: hostile.clone(),
            notes: vec![hostile.clone()],
            tables: vec![QuantityTable {
                title: hostile.clone(),
                rows: vec![vec![hostile.clone()]],
                ..QuantityTable::default()
            }],
            charts: vec![Chart { title: hostile.clone(), caption: hostile.clone(), ..Chart::default() }],
            files: vec![Listing {
                title: hostile.clone(),
                lines: vec![Line { text: hostile.clone(), is_default: true }],
            }],
            ..Report::default()
        };
        let page = report.page();
        let (shown, data) = page.split_once("<script type=\"application/json\"").unwrap();
        assert_lacks!(shown, "<script>");
        assert_lacks!(shown, "\" onload");
        assert_lacks!(data.split_once('>').unwrap().1.split_once("</script>").unwrap().0, "<");
        assert_contains!(page, "&lt;script&gt;alert(1)&lt;/script&gt;");
        // What runs is told by its digest; that it is the right one is seen where a browser opens pages.
        assert_eq!(page.matches("<script type=\"module\">").count(), 1);
        let (_, scripts) = page.split_once("script-src ").unwrap();
        let scripts: Vec<&str> = scripts.split(';').next().unwrap().split(' ').collect();
        assert_all!(scripts[..2].iter(), |digest| digest.starts_with("'sha256-") && digest.len() == 53);
        assert_eq!(scripts[2..], ["'unsafe-eval'"]);
        // Four scripts of our own, and Plotly as a block that has no angle brackets.
        assert_eq!(page.matches("<script").count(), 4);
        assert_eq!(page.matches("</script>").count(), 4);
        assert_above!(PLOTLY.len(), 1_000_000);
        assert_lacks!(PLOTLY, "<");
    }
}
