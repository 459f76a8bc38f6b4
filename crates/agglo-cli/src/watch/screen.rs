//! How the dashboard looks.

use agglo::text::{readable, visible};
use agglo_view::watch::{Curve, Sight};
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Color, Style, Stylize};
use ratatui::symbols::Marker;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Axis, Block, Borders, Chart, Dataset, Gauge, GraphType, Paragraph};

use super::cells::{self, Depth};
use super::portrait::Shown;

/// All that is on the screen.
pub(super) struct Screen<'a> {
    pub title: &'a str,
    /// Part of the simulated time that has passed.
    pub part: f64,
    /// "0.310 of 2 s, 812 steps/s, 1:02 left".
    pub state: &'a str,
    pub sight: &'a Sight,
    pub picture: Option<&'a Shown>,
    pub depth: Depth,
    /// Warnings and troubles, the newest last.
    pub notes: &'a [String],
    /// What the keys do.
    pub keys: &'a str,
}

/// Colors of curves (Okabe and Ito), as far as the terminal has them.
const CURVES: [[u8; 3]; 3] = [[0x56, 0xb4, 0xe9], [0xe6, 0x9f, 0x00], [0x00, 0x9e, 0x73]];
/// Lines for notes.
const NOTES: usize = 3;
/// Columns of quantities and curves.
const SIDE: u16 = 46;

/// Where the picture is, in cells.
pub(super) fn picture_area(area: Rect) -> Rect {
    let [_, middle, ..] = rows(area, 0);
    let [left, _] = columns(middle);
    // A frame about it, and the line of its colors.
    Rect {
        x: left.x + 1,
        y: left.y + 1,
        width: left.width.saturating_sub(2),
        height: left.height.saturating_sub(3),
    }
}

fn rows(area: Rect, notes: usize) -> [Rect; 4] {
    let notes = Constraint::Length(notes as u16);
    Layout::vertical([Constraint::Length(2), Constraint::Fill(1), notes, Constraint::Length(1)]).areas(area)
}

fn columns(area: Rect) -> [Rect; 2] {
    let side = SIDE.min(area.width / 2);
    Layout::horizontal([Constraint::Fill(1), Constraint::Length(side)]).areas(area)
}

impl Screen<'_> {
    /// Draws everything.
    pub fn draw(&self, frame: &mut Frame<'_>) {
        let notes = &self.notes[self.notes.len().saturating_sub(NOTES)..];
        let [head, middle, foot, keys] = rows(frame.area(), notes.len());
        self.head(frame, head);
        let [left, right] = columns(middle);
        self.picture(frame, left);
        self.side(frame, right);
        let lines: Vec<Line<'_>> = notes.iter().map(|note| Line::from(visible(note)).yellow()).collect();
        frame.render_widget(Paragraph::new(lines), foot);
        frame.render_widget(Paragraph::new(self.keys).dim(), keys);
    }

    fn head(&self, frame: &mut Frame<'_>, area: Rect) {
        let [title, bar] = Layout::vertical([Constraint::Length(1), Constraint::Length(1)]).areas(area);
        frame.render_widget(Paragraph::new(visible(self.title)).bold(), title);
        let label = format!("{:.1} %  {}", 100.0 * self.part, self.state);
        let filled =
            Style::new().fg(self.depth.color([0x00, 0x72, 0xb2])).bg(self.depth.color([0x30, 0x30, 0x30]));
        let label = Span::styled(label, Style::new().fg(Color::White).bold());
        let gauge = Gauge::default().gauge_style(filled).ratio(self.part.clamp(0.0, 1.0)).label(label);
        frame.render_widget(gauge, bar);
    }

    fn picture(&self, frame: &mut Frame<'_>, area: Rect) {
        let title = self.picture.map(|shown| format!(" frame at t = {} ", readable(shown.time, "s")));
        let block = Block::new().borders(Borders::ALL).title(title.unwrap_or_default());
        frame.render_widget(block, area);
        let Some(shown) = self.picture else {
            let place = Rect { x: area.x + 2, y: area.y + 1, width: area.width.saturating_sub(4), height: 1 };
            frame.render_widget(Paragraph::new("no frame yet").dim(), place.intersection(area));
            return;
        };
        let inside = Rect {
            x: area.x + 1,
            y: area.y + 1,
            width: area.width.saturating_sub(2),
            height: area.height.saturating_sub(3),
        };
        cells::draw(&shown.image, self.depth, inside, frame.buffer_mut());
        let below = Rect { y: area.y + area.height.saturating_sub(2), height: 1, ..inside };
        frame.render_widget(Paragraph::new(self.colors(shown)).centered(), below.intersection(area));
    }

    /// "speed  0 m/s ████ 9.8 m/s".
    fn colors(&self, shown: &Shown) -> Line<'static> {
        let title = shown.quantity.title.to_lowercase();
        let Some((map, [low, high])) = shown.scale else { return Line::from(title) };
        let end = |value: f64| readable(value, shown.quantity.unit);
        let mut parts = vec![Span::from(format!("{title}  {} ", end(low)))];
        parts.extend((0..20).map(|k| {
            let color = map.color(f64::from(k) / 19.0);
            let bytes = [16, 8, 0].map(|shift| (color >> shift & 0xff) as u8);
            Span::styled("█", Style::new().fg(self.depth.color(bytes)))
        }));
        parts.push(Span::from(format!(" {}", end(high))));
        Line::from(parts)
    }

    fn side(&self, frame: &mut Frame<'_>, area: Rect) {
        let quantities = self.sight.quantities.len() as u16;
        let count = self.sight.curves.len();
        // Quantities come first; curves share what is left, as many as find room.
        let left = area.height.saturating_sub(quantities + 2);
        let curves = count.min(usize::from(left / 6));
        let mut heights = vec![Constraint::Length((quantities + 2).min(area.height))];
        heights.extend(vec![Constraint::Fill(1); curves]);
        let areas = Layout::vertical(heights).split(area);
        self.quantities(frame, areas[0]);
        for (k, curve) in self.sight.curves.iter().take(curves).enumerate() {
            let color = self.depth.color(CURVES[k % CURVES.len()]);
            draw_curve(frame, areas[k + 1], curve, color);
        }
    }

    fn quantities(&self, frame: &mut Frame<'_>, area: Rect) {
        let block = Block::new().borders(Borders::ALL).title(" now ");
        let room = usize::from(area.width.saturating_sub(2));
        let lines = self.sight.quantities.iter().map(|quantity| {
            let (name, value) = (quantity.name, quantity.text());
            let space = room.saturating_sub(name.len() + value.chars().count() + 2);
            Line::from(vec![format!(" {name}{:space$}", "").into(), value.bold()])
        });
        frame.render_widget(Paragraph::new(lines.collect::<Vec<_>>()).block(block), area);
    }
}

fn draw_curve(frame: &mut Frame<'_>, area: Rect, curve: &Curve, color: Color) {
    let block = Block::new().borders(Borders::ALL).title(format!(" {} ", curve.name));
    let over = |of: fn(&(f64, f64)) -> f64| {
        let ends = curve.points.iter().map(of);
        ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
    };
    let [[first, last], [low, high]] = [over(|point| point.0), over(|point| point.1)];
    // A point is no curve.
    if curve.points.len() < 2 || first >= last {
        frame.render_widget(block, area);
        return;
    }
    let room = if low < high { 0.0 } else { 0.5 * low.abs().max(1e-300) };
    let (low, high) = (low - room, high + room);
    let data = Dataset::default()
        .marker(Marker::Braille)
        .graph_type(GraphType::Line)
        .style(color)
        .data(&curve.points);
    let times = Axis::default().bounds([first, last]).labels([readable(first, "s"), readable(last, "s")]);
    let values =
        Axis::default().bounds([low, high]).labels([readable(low, curve.unit), readable(high, curve.unit)]);
    frame.render_widget(Chart::new(vec![data]).block(block).x_axis(times).y_axis(values), area);
}
