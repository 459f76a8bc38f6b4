//! Pictures of a run: one view and one range of colors for all frames.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::camera::{Camera, Side};
use super::error::RenderError;
use super::frame_sequence::{Ball, FrameSequence};
use super::image::{Image, light_of};
use super::overlay::{Entry, Legend, Overlay};
use super::scene::{Background, Ground, Scene};
use super::sheet::{self, Sheet};
use super::solid::{Light, Line, Sphere};
use super::survey::{framed, joined, range, seen, survey};
use crate::plot::{Coloring, Map, NAMED, Quantity, name_color};
use agglo::math::Vec3;

/// What the camera looks at.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum View {
    /// All frames, but for the outermost grains.
    #[default]
    Fit,
    /// The first frame.
    First,
    /// This place [m], as near as for all frames.
    At(Vec3),
}

/// What pictures show and how.
#[derive(Clone, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a wish of its own")]
pub struct Options {
    /// Word of the quantity that grains are colored by.
    pub color: String,
    /// Color map for values; that of the quantity if left out.
    pub map: Option<Map>,
    /// Values [SI] at the ends of the color map; those of all frames if left out.
    pub range: Option<[f64; 2]>,
    /// What the camera looks at.
    pub view: View,
    /// From which side.
    pub side: Side,
    /// How many times as large as what fits the picture.
    pub zoom: f64,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// What is behind everything.
    pub background: Background,
    /// Whether there is a floor.
    pub ground: bool,
    /// Whether bonds are drawn.
    pub bonds: bool,
    /// Whether rays are drawn.
    pub rays: bool,
    /// Whether the edges of the control volume are drawn, where there is one.
    pub volume: bool,
    /// Whether walls are drawn, where there are such.
    pub walls: bool,
    /// Whether there are words: legend, scale and time.
    pub words: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            color: "speed".to_owned(),
            map: None,
            range: None,
            view: View::Fit,
            side: Side::default(),
            zoom: 1.0,
            size: [1280, 720],
            background: Background::Light,
            ground: false,
            bonds: false,
            rays: false,
            volume: true,
            walls: true,
            words: true,
        }
    }
}

/// A run before the camera.
#[derive(Debug)]
pub struct Renderer {
    sequence: FrameSequence,
    options: Options,
    quantity: Quantity,
    camera: Camera,
    ground: Option<Ground>,
    range: [f64; 2],
    /// Whether grains have values below and above the range.
    beyond: [bool; 2],
    last_time: f64,
    /// Whether a frame that was drawn had rays in flight.
    has_shown_rays: AtomicBool,
}

/// Room about what is framed.
const MARGIN: f64 = 1.12;
/// Colors of lines.
const BOND: u32 = 0x50_5050;
const BOND_ON_DARK: u32 = 0xc8_c8c8;
const RAY: u32 = 0x1c_1c1c;
const RAY_ON_DARK: u32 = 0x56_b4e9;
const EDGE: u32 = 0x8c_8c8c;
const WALL: u32 = 0x6e_7f90;

impl Renderer {
    /// Looks through the frames with these numbers and sets up the camera and the colors. `look` is told how many
    /// are done and may end it.
    ///
    /// # Errors
    /// [`RenderError`]; nothing where `look` ended it.
    pub fn prepare(
        sequence: FrameSequence,
        options: Options,
        frames: &[usize],
        look: &mut dyn FnMut(usize) -> bool,
    ) -> Result<Option<Self>, RenderError> {
        let first = frames.first().copied().unwrap_or(0);
        let quantity = quantity(&sequence, first, &options.color)?;
        for (wanted, what) in [(options.bonds, "bonds"), (options.rays, "rays")] {
            if wanted {
                sequence.needs(what)?;
            }
        }
        let mut surveys = Vec::new();
        for some in frames.chunks(16) {
            if !look(surveys.len()) {
                return Ok(None);
            }
            let found = some.par_iter().map(|&number| survey(&sequence, number, &quantity, &options));
            surveys.extend(found.collect::<Result<Vec<_>, _>>()?);
        }
        let Some(reach) = framed(&surveys, &sequence, options.view) else {
            return Err(RenderError::NoGrains { dir: sequence.dir().to_owned() });
        };
        let reach = corners(&sequence, &options)
            .fold(reach, |reach, corner| joined(reach, seen(corner, options.side)));
        let (range, beyond) = range(&surveys, &quantity, options.range);
        let camera = camera(reach, &options);
        let last_time = frames.last().and_then(|&last| sequence.times().nth(last)).unwrap_or(0.0);
        let ground = options.ground.then(|| ground(reach, options.side));
        let has_shown_rays = AtomicBool::new(false);
        Ok(Some(Self {
            sequence,
            options,
            quantity,
            camera,
            ground,
            range,
            beyond,
            last_time,
            has_shown_rays,
        }))
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// What the colors show.
    pub fn quantity(&self) -> &Quantity {
        &self.quantity
    }

    /// The color map and the values at its ends; nothing where colors are names.
    pub fn scale(&self) -> Option<(Map, [f64; 2])> {
        match self.coloring() {
            Coloring::Values(map) => Some((map, self.range)),
            Coloring::Clusters | Coloring::Materials => None,
        }
    }

    /// The frames.
    pub fn sequence(&self) -> &FrameSequence {
        &self.sequence
    }

    /// The picture of the frame with this number.
    ///
    /// # Errors
    /// [`RenderError`] where it cannot be read.
    pub fn picture(&self, number: usize) -> Result<Image, RenderError> {
        let frame = self.sequence.read(number)?;
        let values = self.values(number, &frame)?;
        let colors = self.colors(&values);
        let balls = self.sequence.balls(number, &frame)?;
        let sheets = if self.options.walls { self.sequence.walls(number)? } else { Vec::new() };
        let spheres =
            balls.iter().zip(colors).map(|(&(center, radius), color)| Sphere { center, radius, color });
        let scene = Scene {
            spheres: spheres.collect(),
            lines: self.lines(number, &balls, &sheets)?,
            sheets,
            ground: self.ground,
            background: self.options.background,
        };
        let mut image = scene.draw(&self.camera);
        if self.options.words {
            self.overlay(frame.time).draw(&mut image);
        }
        Ok(image)
    }

    fn values(&self, number: usize, frame: &agglo::record::frames::Frame) -> Result<Vec<f64>, RenderError> {
        let path = || self.sequence.path(number).to_owned();
        self.quantity.of(frame).ok_or_else(|| RenderError::Field { path: path(), field: self.quantity.field })
    }

    fn colors(&self, values: &[f64]) -> Vec<Light> {
        match self.coloring() {
            Coloring::Values(map) => {
                let [low, high] = self.range;
                values.iter().map(|value| light_of(map.color((value - low) / (high - low)))).collect()
            }
            Coloring::Materials => {
                values.iter().map(|&value| light_of(name_color(Some(value as usize)))).collect()
            }
            Coloring::Clusters => {
                // A file that somebody has changed may have any number here.
                let mut sorted = values.to_vec();
                sorted.sort_unstable_by(f64::total_cmp);
                let up_to = |value: f64, with: bool| {
                    sorted.partition_point(|other| {
                        let order = other.total_cmp(&value);
                        order.is_lt() || with && order.is_eq()
                    })
                };
                let is_alone = |value: f64| up_to(value, true) - up_to(value, false) < 2;
                let color =
                    |value: f64| name_color((!is_alone(value)).then_some(cluster_number(value as usize)));
                values.iter().map(|&value| light_of(color(value))).collect()
            }
        }
    }

    /// What was asked for and makes no difference.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.options.map.is_some() && !matches!(self.quantity.coloring, Coloring::Values(_)) {
            let word = self.quantity.word;
            notes.push(format!("the map is left aside: {word} has a color for each name"));
        }
        notes
    }

    /// That rays were asked for and none was there in the frames drawn so far.
    pub fn note_of_rays(&self) -> Option<String> {
        let is_missing = self.options.rays && !self.has_shown_rays.load(Ordering::Relaxed);
        is_missing.then(|| {
            "no frame that was drawn has rays in flight: they fly for less than the time between two frames; a \
             shorter output.frames shows them"
                .to_owned()
        })
    }

    fn coloring(&self) -> Coloring {
        match (self.quantity.coloring, self.options.map) {
            (Coloring::Values(_), Some(map)) => Coloring::Values(map),
            (coloring, _) => coloring,
        }
    }

    fn lines(&self, number: usize, balls: &[Ball], sheets: &[Sheet]) -> Result<Vec<Line>, RenderError> {
        let pixel = self.camera.pixel();
        let mut lines = Vec::new();
        if self.options.bonds {
            let smallest = balls.iter().fold(f64::INFINITY, |least, ball| least.min(ball.1));
            let (radius, is_dark) = (0.25 * smallest, self.options.background == Background::Dark);
            let color = light_of(if is_dark { BOND_ON_DARK } else { BOND });
            let bonds = self.sequence.bonds(number)?.into_iter();
            lines.extend(bonds.map(|ends| Line { ends, radius, color }));
        }
        if self.options.rays {
            let (length, radius) = (0.02 * f64::from(self.options.size[1]) * pixel, 0.6 * pixel);
            let streak = |[at, to]: [Vec3; 2]| [at - to * length, at];
            let rays = self.sequence.rays(number)?;
            self.has_shown_rays.fetch_or(!rays.is_empty(), Ordering::Relaxed);
            let is_dark = self.options.background == Background::Dark;
            let color = light_of(if is_dark { RAY_ON_DARK } else { RAY });
            lines.extend(rays.into_iter().map(streak).map(|ends| Line { ends, radius, color }));
        }
        let (radius, color) = (0.7 * pixel, light_of(WALL));
        let of_walls = sheet::edges(sheets, self.camera.eye());
        lines.extend(of_walls.into_iter().map(|ends| Line { ends, radius, color }));
        if self.options.volume {
            let (radius, color) = (0.9 * pixel, light_of(EDGE));
            let volume = self.sequence.volume_at(number, balls);
            lines.extend(volume.into_iter().flat_map(edges).map(|ends| Line { ends, radius, color }));
        }
        Ok(lines)
    }

    fn overlay(&self, time: f64) -> Overlay {
        let legend = match self.coloring() {
            Coloring::Values(map) => Legend::values(&self.quantity, map, self.range, self.beyond),
            Coloring::Clusters => Legend::names(
                self.quantity.title,
                vec![
                    Entry { label: "heaviest".to_owned(), colors: vec![name_color(Some(0))] },
                    Entry {
                        label: "others".to_owned(),
                        colors: (1..4).map(|k| name_color(Some(k))).collect(),
                    },
                    Entry { label: "single grains".to_owned(), colors: vec![name_color(None)] },
                ],
            ),
            Coloring::Materials => Legend::names(self.quantity.title, self.materials()),
        };
        Overlay {
            legend,
            pixel: self.camera.pixel(),
            time,
            last_time: self.last_time,
            is_dark: self.options.background == Background::Dark,
        }
    }

    /// Materials are numbered in the order of the alphabet.
    fn materials(&self) -> Vec<Entry> {
        let names =
            self.sequence.scenario().map(|scenario| scenario.materials.keys().cloned().collect::<Vec<_>>());
        let names = names.unwrap_or_else(|| {
            (self.range[0] as usize..=self.range[1] as usize)
                .take(NAMED.len())
                .map(|number| format!("material {number}"))
                .collect()
        });
        let entry = |(number, label)| Entry { label, colors: vec![name_color(Some(number))] };
        names.into_iter().enumerate().map(entry).collect()
    }
}

/// The number of a cluster's color: that of the heaviest is used once.
fn cluster_number(cluster: usize) -> usize {
    if cluster == 0 { 0 } else { 1 + (cluster - 1) % (NAMED.len() - 1) }
}

/// The quantity with this word, if the frames hold it.
fn quantity(sequence: &FrameSequence, number: usize, word: &str) -> Result<Quantity, RenderError> {
    let frame = sequence.read(number)?;
    let known: Vec<Quantity> = Quantity::all_in(&frame).collect();
    let asked = word.to_lowercase().replace(['-', ' '], "_");
    known.iter().find(|quantity| quantity.word == asked).copied().ok_or_else(|| {
        let nearest = known.iter().map(|quantity| (strsim::jaro(&asked, quantity.word), quantity.word));
        let nearest = nearest.filter(|(likeness, _)| *likeness > 0.7).max_by(|a, b| a.0.total_cmp(&b.0));
        let advice = nearest.map(|(_, word)| format!("; did you mean \"{word}\"?")).unwrap_or_default();
        let words: Vec<&str> = known.iter().map(|quantity| quantity.word).collect();
        RenderError::Color {
            dir: sequence.dir().to_owned(),
            found: word.to_owned(),
            advice,
            known: words.join(", "),
        }
    })
}

fn camera(reach: [[f64; 2]; 3], options: &Options) -> Camera {
    let axes = options.side.axes();
    let middle = axes
        .iter()
        .zip(reach)
        .fold(Vec3::ZERO, |sum, (&axis, [low, high])| sum + axis * (0.5 * (low + high)));
    let center = if let View::At(place) = options.view { place } else { middle };
    let half = reach.map(|[low, high]| 0.5 * MARGIN * (high - low));
    Camera::framing(center, half, options.side, options.size).zoomed(options.zoom)
}

/// A floor that what is framed stands on: as low as its lower edge in the picture.
fn ground(reach: [[f64; 2]; 3], side: Side) -> Ground {
    let axes = side.axes();
    let middle = axes
        .iter()
        .zip(reach)
        .fold(Vec3::ZERO, |sum, (&axis, [low, high])| sum + axis * (0.5 * (low + high)));
    let half = reach.map(|[low, high]| 0.5 * (high - low));
    let size = half.iter().fold(0.0_f64, |most, &half| most.max(half));
    Ground { center: middle - Vec3::AXES[2] * half[1], radius: 4.0 * size }
}

fn corners(sequence: &FrameSequence, options: &Options) -> impl Iterator<Item = Vec3> {
    let is_shown = options.volume && options.view != View::First;
    let at_start = sequence.volume().map(|volume| [volume.lower(), volume.upper()]);
    at_start.into_iter().flat_map(edges).flatten().filter(move |_| is_shown)
}

/// The edges of the block between two corners [m].
fn edges(corners: [Vec3; 2]) -> impl Iterator<Item = [Vec3; 2]> {
    let [lower, upper] = corners.map(Vec3::to_array);
    (0..12).map(move |edge| {
        let (along, others) = (edge / 4, [(edge / 4 + 1) % 3, (edge / 4 + 2) % 3]);
        let mut ends = [lower; 2];
        ends[1][along] = upper[along];
        for (bit, other) in others.into_iter().enumerate() {
            if edge >> bit & 1 == 1 {
                for end in &mut ends {
                    end[other] = upper[other];
                }
            }
        }
        ends.map(Vec3::from)
    })
}

#[cfg(test)]
#[path = "renderer_tests.rs"]
mod tests;
