//! The dashboard on a terminal that is a table of cells.

use agglo::math::Vec3;
use agglo_view::render::{Background, Camera, Scene, Side, Sphere};
use agglo_view::watch::{Curve, Reading, Sight};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::style::Color;

use super::cells::{self, Depth};
use super::screen::{Screen, picture_area};

fn sight() -> Sight {
    let quantity = |name, value, unit| Reading { name, column: ("clusters", "x"), value, unit };
    let points = (0..50).map(|k| (0.02 * f64::from(k), f64::from(k * k))).collect();
    let curve = |name| Curve { name, unit: "m/s", points: Vec::clone(&points) };
    Sight {
        quantities: vec![
            quantity("clusters", 1234.0, ""),
            quantity("dispersion degree", 0.4217, "%"),
            quantity("mean speed", 0.0032, "m/s"),
            quantity("fractal dimension", f64::NAN, ""),
        ],
        curves: vec![curve("mean speed"), curve("clusters")],
        ..Sight::default()
    }
}

fn screen(sight: &Sight, size: [u16; 2], notes: &[String]) -> Buffer {
    screen_of("a run", sight, size, notes)
}

fn screen_of(title: &str, sight: &Sight, size: [u16; 2], notes: &[String]) -> Buffer {
    let mut terminal = Terminal::new(TestBackend::new(size[0], size[1])).unwrap();
    let screen = Screen {
        title,
        part: 0.31,
        state: "0.310 of 1 s, 812 steps/s, 0:04 left",
        sight,
        picture: None,
        depth: Depth::Full,
        notes,
        keys: "q leave",
    };
    terminal.draw(|frame| screen.draw(frame)).unwrap();
    terminal.backend().buffer().clone()
}

fn lines(buffer: &Buffer) -> Vec<String> {
    let area = buffer.area;
    let row = |y| (0..area.width).map(|x| buffer[(x, y)].symbol()).collect::<String>();
    (0..area.height).map(row).collect()
}

#[test]
fn all_quantities_are_shown_with_their_units() {
    let lines = lines(&screen(&sight(), [120, 40], &[]));
    let shows = |words: &[&str]| lines.iter().any(|line| words.iter().all(|word| line.contains(word)));
    assert_starts!(lines[0], "a run");
    assert!(lines[1].contains("31.0 %  0.310 of 1 s, 812 steps/s, 0:04 left"), "{}", lines[1]);
    for words in [
        ["clusters", "1234"],
        ["dispersion degree", "42.2 %"],
        ["mean speed", "3.2 mm/s"],
        ["fractal dimension", " - "],
    ] {
        assert!(shows(&[words[0], words[1].trim_end()]), "{words:?} in\n{}", lines.join("\n"));
    }
    // Curves have the ends of their axes, and are drawn in Braille.
    assert_true!(shows(&["2.401 km/s"]), "in one line of the screen");
    assert_true!(shows(&["980 ms"]), "in one line of the screen");
    let is_braille = |letter: char| ('\u{2801}'..='\u{28ff}').contains(&letter);
    assert_above!(
        lines.iter().flat_map(|line| line.chars()).filter(|&letter| is_braille(letter)).count(),
        20
    );
    assert_starts!(lines[39], "q leave");
}

/// Terminals obey more than the controls that the library of the screen leaves out: marks that turn the direction too.
#[test]
fn titles_and_notes_do_not_act_on_the_terminal() {
    let notes = ["warning: \u{1b}[2Jgone \u{202e}turned".to_owned()];
    let lines = lines(&screen_of("red \u{1b}[31m\u{2066}", &sight(), [120, 40], &notes));
    assert!(lines[0].starts_with("red \\u{1b}[31m\\u{2066}"), "{}", lines[0]);
    assert_any!(lines.iter(), |line| line.contains("warning: \\u{1b}[2Jgone \\u{202e}turned"));
}

#[test]
fn the_last_notes_are_shown() {
    let notes: Vec<String> = (0..5).map(|k| format!("warning: number {k}")).collect();
    let lines = lines(&screen(&sight(), [100, 30], &notes));
    assert_starts!(lines[26], "warning: number 2");
    assert_starts!(lines[28], "warning: number 4");
}

/// However small the terminal, nothing breaks.
#[test]
fn small_terminals_show_what_fits() {
    for size in [[1, 1], [10, 3], [20, 8], [46, 12], [300, 4]] {
        let shown = screen(&sight(), size, &["note".to_owned()]);
        assert_eq!(shown.area.width, size[0]);
    }
}

/// Two pixels a cell: a ball covers the middle and leaves the corners as they are.
#[test]
fn a_picture_is_drawn_in_half_cells() {
    let mut buffer = Buffer::empty(ratatui::layout::Rect::new(0, 0, 100, 30));
    let area = picture_area(buffer.area);
    let size = [u32::from(area.width), 2 * u32::from(area.height)];
    let sphere = Sphere { center: Vec3::ZERO, radius: 1.0, color: [1.0, 0.0, 0.0] };
    let scene = Scene { spheres: vec![sphere], background: Background::Transparent, ..Scene::default() };
    let image = scene.draw(&Camera::framing(Vec3::ZERO, [1.2; 3], Side::default(), size));
    cells::draw(&image, Depth::Full, area, &mut buffer);
    let middle = &buffer[(area.x + area.width / 2, area.y + area.height / 2)];
    let (Color::Rgb(upper, ..), Color::Rgb(lower, ..)) = (middle.fg, middle.bg) else { panic!("{middle:?}") };
    assert_eq!(middle.symbol(), "▀");
    assert_above!(upper, 100);
    assert_above!(lower, 100);
    assert_eq!(buffer[(area.x, area.y)].symbol(), " ");
    // The upper edge of the ball goes through cells that are half covered.
    let symbols: Vec<&str> = buffer.content.iter().map(ratatui::buffer::Cell::symbol).collect();
    assert_has!(symbols, &"▄");
    assert_has!(symbols, &"▀");
    cells::draw(&image, Depth::Indexed, area, &mut buffer);
    let middle = &buffer[(area.x + area.width / 2, area.y + area.height / 2)];
    assert_matches!((middle.fg, middle.bg), (Color::Indexed(_), Color::Indexed(_)));
}
