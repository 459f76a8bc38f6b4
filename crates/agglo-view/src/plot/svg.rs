//! The few shapes that charts are made of, as SVG text.

use super::color::{Color, INK, PAPER};

/// Size of text [px].
pub(super) const FONT: f64 = 13.0;
/// Size of a chart's title [px].
const TITLE: f64 = 16.0;
/// Width of a chart [px].
pub(super) const WIDTH: f64 = 800.0;
const FAMILY: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

/// A place in the picture [px], from its upper left corner, y downwards.
pub(super) type Place = [f64; 2];

/// An upright rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
}

impl Area {
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    pub fn center(&self) -> Place {
        [self.left + 0.5 * self.width, self.top + 0.5 * self.height]
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pen<'a> {
    pub color: Color,
    pub width: f64,
    pub opacity: f64,
    pub dashes: &'a str,
}

impl Pen<'_> {
    pub fn new(color: Color, width: f64) -> Self {
        Self { color, width, opacity: 1.0, dashes: "" }
    }

    fn attributes(&self) -> String {
        let opacity = optional(self.opacity < 1.0, || format!(" stroke-opacity=\"{}\"", short(self.opacity)));
        let dashes = optional(!self.dashes.is_empty(), || format!(" stroke-dasharray=\"{}\"", self.dashes));
        format!("stroke=\"{}\" stroke-width=\"{}\"{opacity}{dashes}", self.color, short(self.width))
    }
}

/// What an attribute adds, if it is there.
fn optional(is_there: bool, attribute: impl FnOnce() -> String) -> String {
    if is_there { attribute() } else { String::new() }
}

/// Which part of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a text is written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    pub anchor: Anchor,
    pub size: f64,
    /// Turned by so many degrees, clockwise.
    pub turn: f64,
    pub is_bold: bool,
    /// Whether it has a rim in the ground's color, to be read on lines.
    pub has_rim: bool,
}

impl Style {
    pub fn new(anchor: Anchor) -> Self {
        Self { anchor, size: FONT, turn: 0.0, is_bold: false, has_rim: false }
    }
}

/// A picture in the making.
#[derive(Debug)]
pub(super) struct Svg {
    height: f64,
    title: String,
    description: String,
    body: String,
}

impl Svg {
    /// An empty picture with its title.
    pub fn new(height: f64, title: &str, description: &str) -> Self {
        let (title, description) = (escape(title), escape(description));
        let mut svg = Self { height, title, description, body: String::new() };
        let style = Style { size: TITLE, is_bold: true, ..Style::new(Anchor::Middle) };
        svg.write([0.5 * WIDTH, 26.0], &svg.title.clone(), style);
        svg
    }

    pub fn line(&mut self, [x1, y1]: Place, [x2, y2]: Place, pen: Pen<'_>) {
        let [x1, y1, x2, y2] = [x1, y1, x2, y2].map(short);
        let pen = pen.attributes();
        self.push(&format!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" {pen}/>"));
    }

    /// A line through places.
    pub fn path(&mut self, places: &[Place], pen: Pen<'_>) {
        if places.len() > 1 {
            let (points, pen) = (list(places), pen.attributes());
            self.push(&format!(
                "<polyline points=\"{points}\" fill=\"none\" stroke-linejoin=\"round\" {pen}/>"
            ));
        }
    }

    /// A filled shape with these corners.
    pub fn polygon(&mut self, places: &[Place], fill: Color, opacity: f64) {
        let (points, opacity) = (list(places), short(opacity));
        self.push(&format!("<polygon points=\"{points}\" fill=\"{fill}\" fill-opacity=\"{opacity}\"/>"));
    }

    pub fn rect(&mut self, area: Area, fill: Color, opacity: f64) {
        let [x, y, width, height] = [area.left, area.top, area.width, area.height].map(short);
        let opacity = short(opacity);
        self.push(&format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{fill}\" fill-opacity=\"{opacity}\"/>"
        ));
    }

    /// A filled circle with a thin rim in the ground's color, so that neighbors stay apart.
    pub fn dot(&mut self, [x, y]: Place, radius: f64, fill: Color, opacity: f64) {
        let [x, y, radius, opacity] = [x, y, radius, opacity].map(short);
        self.push(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{fill}\" fill-opacity=\"{opacity}\" \
             stroke=\"{PAPER}\" stroke-width=\"0.5\"/>"
        ));
    }

    pub fn text(&mut self, place: Place, text: &str, style: Style) {
        self.write(place, &escape(text), style);
    }

    fn write(&mut self, [x, y]: Place, escaped: &str, style: Style) {
        let [x, y, size, turn] = [x, y, style.size, style.turn].map(short);
        let anchor = match style.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let turned = optional(style.turn != 0.0, || format!(" transform=\"rotate({turn} {x} {y})\""));
        let weight = if style.is_bold { " font-weight=\"bold\"" } else { "" };
        let rim = optional(style.has_rim, || {
            format!(" paint-order=\"stroke\" stroke=\"{PAPER}\" stroke-width=\"3\"")
        });
        self.push(&format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\"{turned}{weight}{rim}>{escaped}</text>"
        ));
    }

    fn push(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    /// The whole file.
    pub fn finish(self) -> String {
        let Self { height, title, description, body } = self;
        let [width, height] = [WIDTH, height].map(short);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" aria-labeledby=\"title description\" \
             font-family=\"{FAMILY}\" fill=\"{INK}\">\n\
             <title id=\"title\">{title}</title>\n<desc id=\"description\">{description}</desc>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{PAPER}\"/>\n{body}</svg>\n"
        )
    }
}

/// Width of a text at a size [px], from the mean width of letters and digits in the usual fonts.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    0.56 * size * text.chars().count() as f64
}

fn list(places: &[Place]) -> String {
    let pairs: Vec<String> = places.iter().map(|&[x, y]| format!("{},{}", short(x), short(y))).collect();
    pairs.join(" ")
}

/// A number to a hundredth, without zeros at the end.
pub(super) fn short(number: f64) -> String {
    let rounded = (100.0 * number).round() / 100.0;
    // Adding zero turns -0 into 0.
    format!("{}", rounded + 0.0)
}

/// A text that can stand between tags.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            letter if letter.is_control() => escaped.push(' '),
            letter => escaped.push(letter),
        }
    }
    escaped
}
