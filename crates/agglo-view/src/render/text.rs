//! Words in pictures. The font is DejaVu Sans, which has the letters of units: µ, ², ⁻.

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};

use super::image::Image;

/// Draws words.
pub(super) struct Writer {
    /// Nothing where the font that is built in cannot be read, which a test excludes.
    font: Option<FontRef<'static>>,
}

/// Which end of a text is at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Align {
    Left,
    Middle,
    Right,
}

impl Writer {
    pub fn new() -> Self {
        Self { font: FontRef::try_from_slice(dejavu::sans::regular()).ok() }
    }

    /// Letters of a text from 0 on, and its length in pixels; `size` is the height of a line.
    fn set(&self, text: &str, size: f64) -> (Vec<Glyph>, f64) {
        let Some(font) = &self.font else { return (Vec::new(), 0.0) };
        let font = font.as_scaled(PxScale::from(size as f32));
        let (mut letters, mut right) = (Vec::new(), 0.0);
        let mut before = None;
        for letter in text.chars() {
            let id = font.glyph_id(letter);
            right += before.map_or(0.0, |before| font.kern(before, id));
            letters.push(id.with_scale_and_position(font.scale(), point(right, 0.0)));
            right += font.h_advance(id);
            before = Some(id);
        }
        (letters, f64::from(right))
    }

    /// Length of a text in pixels.
    pub fn length(&self, text: &str, size: f64) -> f64 {
        self.set(text, size).1
    }

    /// Writes a text; its base line is at `y`, its end or middle at `x`, in pixels.
    pub fn write(
        &self,
        image: &mut Image,
        text: &str,
        [x, y]: [f64; 2],
        align: Align,
        (size, color): (f64, u32),
    ) {
        let (letters, length) = self.set(text, size);
        let left = match align {
            Align::Left => x,
            Align::Middle => x - 0.5 * length,
            Align::Right => x - length,
        };
        let Some(font) = &self.font else { return };
        for mut letter in letters {
            letter.position.x += left as f32;
            letter.position.y = y as f32;
            let Some(outline) = font.outline_glyph(letter) else { continue };
            let corner = outline.px_bounds().min;
            outline.draw(|column, row, cover| {
                let (x, y) = (corner.x as i64 + i64::from(column), corner.y as i64 + i64::from(row));
                image.cover(x, y, color, cover);
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_all_letters_that_units_need() {
        let writer = Writer::new();
        let font = writer.font.as_ref().unwrap();
        for letter in "0123456789.,-\u{2212}×⁰¹²³⁴⁵⁶⁷⁸⁹⁻ abcXYZ µ/()=<>".chars() {
            assert_ne!(font.glyph_id(letter).0, 0, "{letter}");
        }
    }

    #[test]
    fn words_stand_where_they_should() {
        let writer = Writer::new();
        let columns = |align: Align| {
            let mut image = Image::new([200, 40]);
            writer.write(&mut image, "HH", [100.0, 30.0], align, (24.0, 0));
            let covered: Vec<u32> = (0..200).filter(|&x| (0..40).any(|y| image.pixel(x, y)[3] > 0)).collect();
            (covered[0], covered[covered.len() - 1])
        };
        let length = writer.length("HH", 24.0);
        // A letter has some white about it: less than a sixth of a line each side.
        let is_near = |found: u32, wanted: f64| (f64::from(found) - wanted).abs() < 4.0;
        let (left, right) = columns(Align::Left);
        assert!(is_near(left, 100.0) && is_near(right, 100.0 + length), "{left} {right} {length}");
        let (left, right) = columns(Align::Right);
        assert!(is_near(left, 100.0 - length) && is_near(right, 100.0), "{left} {right}");
        let (left, right) = columns(Align::Middle);
        assert!(
            is_near(left, 100.0 - 0.5 * length) && is_near(right, 100.0 + 0.5 * length),
            "{left} {right}"
        );
    }
}
