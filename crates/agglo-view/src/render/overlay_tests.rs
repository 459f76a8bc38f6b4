//! Legends, scales and times.

use super::*;
use agglo::record::frames::{FieldValues, Frame};

fn quantity(field: &str) -> Quantity {
    let fields = vec![(field.to_owned(), FieldValues::Scalars(Vec::new()))];
    Quantity::all_in(&Frame { fields, ..Frame::default() }).next().unwrap()
}

fn marks(field: &str, range: [f64; 2]) -> (String, Vec<(f64, String)>) {
    let legend = Legend::values(&quantity(field), Map::Viridis, range, [false; 2]);
    let Legend::Values { title, marks, .. } = legend else { panic!("{legend:?}") };
    (title, marks)
}

/// Marks are round numbers in the unit that the title names, and stand where the map has these values.
#[test]
fn marks_stand_at_their_values() {
    let (title, found) = marks("radius_m", [0.5e-6, 2.5e-6]);
    assert_eq!(title, "Radius (µm)");
    let labels: Vec<&str> = found.iter().map(|(_, label)| label.as_str()).collect();
    assert_eq!(labels, ["0.5", "1.0", "1.5", "2.0", "2.5"]);
    for (k, (place, _)) in found.iter().enumerate() {
        assert!((place - 0.25 * k as f64).abs() < 1e-9, "{place}");
    }
    assert_eq!(marks("temperature_K", [300.0, 12_000.0]).0, "Temperature (K)");
    assert_eq!(marks("velocity_m_s", [0.0, 14.0]).0, "Speed (m/s)");
    assert_eq!(marks("id", [0.0, 1999.0]).0, "Grain");
}

#[test]
fn lengths_are_round() {
    let label = |pixel: f64| round_length(pixel, 200.0).1;
    assert_eq!(label(0.0011), "200 mm");
    assert_eq!(label(0.01), "2 m");
    assert_eq!(label(3e-8), "5 µm");
    assert_eq!(label(2.6e-9), "500 nm");
    for power in -12..6 {
        let pixel = 1.7 * 10_f64.powi(power);
        let pixels = round_length(pixel, 200.0).0 / pixel;
        assert!(pixels > 80.0 && pixels <= 200.0, "{pixels}");
    }
}

#[test]
fn times_have_the_unit_of_the_last() {
    assert_eq!(time_label(0.5e-6, 120e-6), "t = 0.5 µs");
    assert_eq!(time_label(0.0, 2.0), "t = 0.000 s");
    assert_eq!(time_label(1.5, 2.0), "t = 1.500 s");
    assert_eq!(time_label(1.5, 7200.0), "t = 2 s");
    assert_eq!(time_label(0.0, 0.0), "t = 0.000 s");
}

fn overlay(pixel: f64) -> Overlay {
    let legend = Legend::values(&quantity("velocity_m_s"), Map::Viridis, [0.0, 1.0], [false, true]);
    Overlay { legend, pixel, time: 0.0, last_time: 1.0, is_dark: false }
}

/// The bar in the picture is as long as its label says: meters over meters a pixel. Bytes of partly covered pixels
/// are rounded.
#[test]
fn the_bar_is_as_long_as_it_says() {
    for pixel in [3.7e-6, 1.3e-3, 0.21] {
        let mut image = Image::new([1280, 720]);
        image.fill([0.0, 0.0], [1280.0, 720.0], 0xff_ffff);
        overlay(pixel).draw(&mut image);
        let ink = f64::from(0xff - 0x1e);
        let darkness =
            |y: u32| -> f64 { (0..640).map(|x| f64::from(255 - image.pixel(x, y)[0]) / ink).sum() };
        let longest = (360..720).map(darkness).fold(0.0, f64::max);
        let wanted = round_length(pixel, 0.2 * 1280.0).0 / pixel;
        assert!((longest - wanted).abs() < 0.01, "{longest} pixels instead of {wanted}");
    }
}

/// The column of the map shows its colors from the bottom to the top, and a point where values go beyond.
#[test]
fn the_legend_shows_the_map() {
    let mut image = Image::new([1280, 720]);
    overlay(0.01).draw(&mut image);
    let color = |x: u32, y: u32| {
        let [r, g, b, _] = image.pixel(x, y).map(u32::from);
        r << 16 | g << 8 | b
    };
    // The map is 302 pixels high, from row 209 on.
    let at = |row: u32| Map::Viridis.color(1.0 - (f64::from(row) + 0.5 - 209.0) / 302.0);
    let is_column = |x: &u32| [209, 359, 510].iter().all(|&row| color(*x, row) == at(row));
    let column: Vec<u32> = (1000..1280).filter(is_column).collect();
    assert!(column.len() > 10, "{column:?}");
    let middle = column[column.len() / 2];
    // Above it the point, of the uppermost color and ever narrower.
    assert_eq!(color(middle, 205), Map::Viridis.color(1.0));
    assert_eq!(image.pixel(column[0], 203)[3], 0);
}

/// Words fit into small pictures and thumbnails too: nothing is written beyond an edge in the middle of a picture.
#[test]
fn small_pictures_hold_their_words() {
    for size in [[640, 360], [320, 180], [400, 700]] {
        let mut image = Image::new(size);
        overlay(0.01).draw(&mut image);
        let edge = |x: u32| (0..size[1]).any(|y| image.pixel(x, y)[3] > 0);
        assert!(!edge(0) && !edge(size[0] - 1), "{size:?}");
    }
}
