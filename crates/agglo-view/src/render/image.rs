//! Pictures as pixels, and PNG.

use std::io;

use rayon::prelude::*;

use super::solid::Light;

/// A picture: rows from the top, red, green, blue and opacity a pixel (sRGB, not multiplied by opacity).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<[u8; 4]>,
}

/// Light that covers what is behind it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Ink {
    pub light: Light,
    /// 0 lets all through, 1 nothing.
    pub cover: f32,
}

impl Ink {
    /// The mean of inks with weights that add up to one.
    pub fn mean(parts: impl IntoIterator<Item = (f32, Self)>) -> Self {
        let mut sum = Self::default();
        for (weight, ink) in parts {
            sum.cover += weight * ink.cover;
            for (sum, part) in sum.light.iter_mut().zip(ink.light) {
                *sum += weight * ink.cover * part;
            }
        }
        let light = if sum.cover > 0.0 { sum.light.map(|part| part / sum.cover) } else { [0.0; 3] };
        Self { light, cover: sum.cover }
    }

    /// As a pixel.
    pub fn bytes(self) -> [u8; 4] {
        let [r, g, b] = self.light.map(encoded);
        [r, g, b, (self.cover.clamp(0.0, 1.0) * 255.0).round() as u8]
    }
}

/// Light as a byte of sRGB (IEC 61966-2-1).
fn encoded(light: f32) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let part = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    (part * 255.0).round() as u8
}

/// The light of a byte of sRGB.
fn decoded(byte: u8) -> f32 {
    let part = f32::from(byte) / 255.0;
    if part <= 0.040_45 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
}

/// The light of a color with a byte each for red, green and blue, red first.
pub(super) fn light_of(color: u32) -> Light {
    [16, 8, 0].map(|shift| decoded((color >> shift & 0xff) as u8))
}

impl Image {
    /// A picture with nothing in it.
    pub fn new([width, height]: [u32; 2]) -> Self {
        Self { width, height, pixels: vec![[0; 4]; (width * height) as usize] }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// The pixels, row by row.
    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.pixels
    }

    /// The pixel in this column and row.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        self.pixels[(y * self.width + x) as usize]
    }

    pub(super) fn rows_mut(&mut self) -> impl IndexedParallelIterator<Item = &mut [[u8; 4]]> {
        self.pixels.par_chunks_mut(self.width as usize)
    }

    /// Lays a color over the pixel in this column and row, as far as it covers it; beyond the edges nothing is done.
    ///
    /// Words are mixed by the bytes and not by light: thin dark strokes would fade otherwise.
    pub(super) fn cover(&mut self, x: i64, y: i64, color: u32, cover: f32) {
        if x < 0 || y < 0 || x >= i64::from(self.width) || y >= i64::from(self.height) || cover <= 0.0 {
            return;
        }
        let pixel = &mut self.pixels[(y as u32 * self.width + x as u32) as usize];
        let (cover, before) = (cover.min(1.0), f32::from(pixel[3]) / 255.0);
        let after = cover + before * (1.0 - cover);
        for (shift, byte) in [16, 8, 0].into_iter().zip(pixel.iter_mut()) {
            let part = (color >> shift & 0xff) as f32;
            let mixed = (part * cover + f32::from(*byte) * before * (1.0 - cover)) / after;
            *byte = mixed.round() as u8;
        }
        pixel[3] = (after * 255.0).round() as u8;
    }

    /// Fills a box from its upper left corner on; parts of pixels are covered in part.
    pub(super) fn fill(&mut self, [left, top]: [f64; 2], [width, height]: [f64; 2], color: u32) {
        let overlap = |from: f64, length: f64, at: i64| {
            ((from + length).min(at as f64 + 1.0) - from.max(at as f64)).clamp(0.0, 1.0) as f32
        };
        for y in top.floor() as i64..(top + height).ceil() as i64 {
            for x in left.floor() as i64..(left + width).ceil() as i64 {
                self.cover(x, y, color, overlap(left, width, x) * overlap(top, height, y));
            }
        }
    }

    /// The picture as a PNG file, without opacity where all is opaque.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn write_png(&self, file: &mut dyn io::Write) -> io::Result<()> {
        let is_opaque = self.pixels.iter().all(|pixel| pixel[3] == 255);
        let mut encoder = png::Encoder::new(file, self.width, self.height);
        encoder.set_color(if is_opaque { png::ColorType::Rgb } else { png::ColorType::Rgba });
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        let bytes = if is_opaque { self.rgb() } else { self.pixels.as_flattened().to_vec() };
        writer.write_image_data(&bytes)?;
        writer.finish()?;
        Ok(())
    }

    /// Red, green and blue of all pixels.
    pub fn rgb(&self) -> Vec<u8> {
        self.pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_come_back() {
        for byte in 0..=255 {
            assert_eq!(encoded(decoded(byte)), byte);
        }
        // The middle of sRGB's bytes is a fifth of the light.
        assert_near!(f64::from(light_of(0x80_0000)[0]), 0.216, 1e-3);
    }

    #[test]
    fn inks_are_mixed_by_what_they_cover() {
        let (red, nothing) = (Ink { light: [1.0, 0.0, 0.0], cover: 1.0 }, Ink::default());
        let half = Ink::mean([(0.5, red), (0.5, nothing)]);
        // Half transparent, and as red as before.
        assert_eq!((half.light, half.cover), ([1.0, 0.0, 0.0], 0.5));
        assert_eq!(half.bytes(), [255, 0, 0, 128]);
    }

    #[test]
    fn boxes_cover_parts_of_pixels() {
        let mut image = Image::new([4, 3]);
        image.fill([0.0, 0.0], [4.0, 3.0], 0xff_ffff);
        image.fill([0.5, 1.0], [2.0, 1.0], 0x00_0000);
        let row: Vec<u8> = (0..4).map(|x| image.pixel(x, 1)[0]).collect();
        assert_eq!(row, [128, 0, 128, 255]);
        assert_eq!(image.pixel(1, 0), [255; 4]);
        image.fill([-5.0, -5.0], [100.0, 100.0], 0x12_3456);
        assert_eq!(image.pixel(3, 2), [0x12, 0x34, 0x56, 255]);
    }

    #[test]
    fn png_files_hold_the_pixels() {
        for color in [[1, 2, 3, 255], [1, 2, 3, 100]] {
            let mut image = Image::new([3, 2]);
            image.pixels.fill(color);
            image.pixels[4] = [9, 8, 7, color[3]];
            let mut file = Vec::new();
            image.write_png(&mut file).unwrap();
            let mut reader = png::Decoder::new(io::Cursor::new(file)).read_info().unwrap();
            let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
            let info = reader.next_frame(&mut bytes).unwrap();
            assert_eq!((info.width, info.height), (3, 2));
            let wanted = if color[3] == 255 { image.rgb() } else { image.pixels.as_flattened().to_vec() };
            assert_eq!(bytes, wanted);
        }
    }
}
