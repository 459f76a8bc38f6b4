//! The newest frame of a run as a picture for the terminal.

use std::path::{Path, PathBuf};

use agglo_view::plot::{Map, Quantity};
use agglo_view::render::{Background, FrameSequence, Image, Options, Renderer, Side};

/// Step of the camera for one press of an arrow.
const TURN: f64 = 15.0_f64.to_radians();

/// The newest frame, drawn anew when something has changed.
#[derive(Debug)]
pub(super) struct Portrait {
    dir: PathBuf,
    side: Side,
    /// Which of the quantities that the frames hold the colors show.
    color: usize,
    words: Vec<&'static str>,
    shown: Option<Shown>,
    /// What the shown picture is of: frame, side, color, size.
    key: Option<(usize, Side, usize, [u32; 2])>,
    /// Why there is no picture.
    pub trouble: Option<String>,
}

/// A picture and what it shows.
#[derive(Debug)]
pub(super) struct Shown {
    pub image: Image,
    pub quantity: Quantity,
    /// Map and values at its ends.
    pub scale: Option<(Map, [f64; 2])>,
    /// Time of the frame [s].
    pub time: f64,
}

impl Portrait {
    /// Of the run in a folder.
    pub fn new(dir: &Path) -> Self {
        let (dir, side) = (dir.to_owned(), Side::default());
        Self { dir, side, color: 0, words: Vec::new(), shown: None, key: None, trouble: None }
    }

    /// The picture.
    pub fn shown(&self) -> Option<&Shown> {
        self.shown.as_ref()
    }

    /// Colors by the next quantity.
    pub fn next_color(&mut self) {
        self.color = (self.color + 1) % self.words.len().max(1);
    }

    /// Turns the camera by steps to the right and up.
    pub fn turn(&mut self, right: f64, up: f64) {
        let highest = 85_f64.to_radians();
        self.side.azimuth = (self.side.azimuth + right * TURN).rem_euclid(std::f64::consts::TAU);
        self.side.elevation = (self.side.elevation + up * TURN).clamp(-highest, highest);
    }

    /// Draws the newest frame for a picture of this size in pixels, unless it is shown already.
    pub fn update(&mut self, size: [u32; 2]) {
        // A run that has just begun has no frame yet.
        let Ok(sequence) = FrameSequence::open(&self.dir) else { return };
        let key = (sequence.len(), self.side, self.color, size);
        if self.key == Some(key) || size.contains(&0) {
            return;
        }
        match self.draw(sequence, size) {
            Ok(shown) => (self.shown, self.trouble) = (shown, None),
            Err(error) => self.trouble = Some(error.to_string()),
        }
        self.key = Some(key);
    }

    fn draw(
        &mut self,
        sequence: FrameSequence,
        size: [u32; 2],
    ) -> Result<Option<Shown>, agglo_view::render::RenderError> {
        let newest = sequence.len() - 1;
        let frame = sequence.read(newest)?;
        self.words = Quantity::all_in(&frame).map(|quantity| quantity.word).collect();
        let color = self.words.get(self.color).copied().unwrap_or("speed").to_owned();
        let (background, words) = (Background::Transparent, false);
        let options = Options { color, side: self.side, size, background, words, ..Options::default() };
        let Some(renderer) = Renderer::prepare(sequence, options, &[newest], &mut |_| true)? else {
            return Ok(None);
        };
        Ok(Some(Shown {
            image: renderer.picture(newest)?,
            quantity: *renderer.quantity(),
            scale: renderer.scale(),
            time: frame.time,
        }))
    }
}
