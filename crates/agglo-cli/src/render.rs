//! The verb `render`.

use std::ops::{ControlFlow, RangeInclusive};
use std::path::PathBuf;
use std::time::Instant;

use agglo::math::Vec3;
use agglo_view::plot::Map;
use agglo_view::render::{
    Animation, AnimationEnding, Background, Options, Output, Shots, Side, View, animate,
};
use clap::{Args, ValueEnum};

use crate::progress::{Display, clock};
use crate::session::Listener;
use crate::signals::{Ear, Late};
use crate::{Failure, print};

/// What to draw.
#[derive(Args, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is an option of its own")]
pub(crate) struct RenderOptions {
    /// The folder of the run
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// A picture (.png), a movie (.mp4, .gif), or a folder or pattern for numbered pictures (frames/, frames/*.png)
    #[arg(short, long = "output", value_name = "PATH")]
    output: PathBuf,
    /// What colors show: speed, temperature, cluster, absorbed_power, size, id ... as far as the frames hold it
    #[arg(long, default_value = "speed", value_name = "QUANTITY")]
    color: String,
    /// Color map of values [default: one that suits the quantity]
    #[arg(long, value_parser = map, value_name = "viridis|cividis|inferno")]
    map: Option<Map>,
    /// Values in SI units at the ends of the color map [default: those of all frames]
    #[arg(long, value_parser = range, value_name = "LOW,HIGH", allow_hyphen_values = true)]
    range: Option<[f64; 2]>,
    /// What is in the picture: all frames (fit), the first one (first), or what is about a place in meters
    #[arg(long, value_parser = view, default_value = "fit", value_name = "fit|first|X,Y,Z", allow_hyphen_values = true)]
    view: View,
    /// Direction of view about the z axis in degrees: 0 looks along +x, 90 along +y
    #[arg(long, default_value_t = 60.0, allow_hyphen_values = true, value_parser = angle::<3600>)]
    azimuth: f64,
    /// How far above the horizon the camera is, in degrees
    #[arg(long, default_value_t = 20.0, allow_hyphen_values = true, value_parser = angle::<90>)]
    elevation: f64,
    /// How many times as large as what fits
    #[arg(long, default_value_t = 1.0, value_parser = positive, allow_hyphen_values = true)]
    zoom: f64,
    /// Width and height in pixels
    #[arg(long, default_value = "1280x720", value_parser = size, value_name = "WIDTHxHEIGHT")]
    size: [u32; 2],
    /// What is behind everything
    #[arg(long, value_enum, default_value_t = Behind::Light)]
    background: Behind,
    /// Lay a floor under the grains
    #[arg(long)]
    ground: bool,
    /// Draw bonds, where the frames hold them
    #[arg(long)]
    bonds: bool,
    /// Draw rays in flight, where the frames hold them
    #[arg(long)]
    rays: bool,
    /// Leave the edges of the control volume out
    #[arg(long)]
    no_volume: bool,
    /// Leave walls out
    #[arg(long)]
    no_walls: bool,
    /// Leave legend, scale and time out
    #[arg(long)]
    no_words: bool,
    /// The first and the last frame, from 0, or a single one; of a picture (.png) the last is drawn [default: all]
    #[arg(long, value_parser = frames, value_name = "A..B")]
    frames: Option<RangeInclusive<usize>>,
    /// Draw every how many-th frame
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Frames in a second of a movie
    #[arg(long, default_value_t = 25.0, value_parser = positive, allow_hyphen_values = true)]
    fps: f64,
    /// Number of threads; all processors if left out
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub threads: Option<u32>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Behind {
    Light,
    Dark,
    Transparent,
}

impl RenderOptions {
    fn options(&self) -> Options {
        let background = match self.background {
            Behind::Light => Background::Light,
            Behind::Dark => Background::Dark,
            Behind::Transparent => Background::Transparent,
        };
        Options {
            color: self.color.clone(),
            map: self.map,
            range: self.range,
            view: self.view,
            side: Side { azimuth: self.azimuth.to_radians(), elevation: self.elevation.to_radians() },
            zoom: self.zoom,
            size: self.size,
            background,
            ground: self.ground,
            bonds: self.bonds,
            rays: self.rays,
            volume: !self.no_volume,
            walls: !self.no_walls,
            words: !self.no_words,
        }
    }
}

/// Draws a run.
pub(crate) fn render(options: &RenderOptions) -> Result<(), Failure> {
    let refused = |error: agglo_view::render::RenderError| {
        Failure::with_code(format!("error: {error}"), error.exit_code())
    };
    let (folder, path) = (&options.folder, options.output.display());
    crate::read::folder(folder)?;
    let output = Output::of(&options.output).map_err(refused)?;
    let is_movie = output.is_movie();
    let shots = Shots { frames: options.frames.clone(), every: options.every as usize, rate: options.fps };
    let ear = Ear::open(None, Late::Ends("stopped in the middle of a picture; those before it are kept"))?;
    let (began, mut display) = (Instant::now(), Display::new());
    let wanted = Animation { output, shots, options: options.options() };
    let ending = animate(folder, wanted, &mut |progress| {
        display.show_animation(progress);
        if ear.is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    display.rest();
    let wall = clock(began.elapsed().as_secs_f64());
    match ending.map_err(refused)? {
        AnimationEnding::Finished(1) => print(&format!("1 picture in {path} ({wall})")),
        AnimationEnding::Finished(count) => print(&format!("{count} pictures in {path} ({wall})")),
        AnimationEnding::Interrupted(_) if is_movie => {
            Err(Failure::failed(format!("stopped ({wall}); a movie is kept only whole, there is none")))
        }
        AnimationEnding::Interrupted(count) => {
            Err(Failure::failed(format!("stopped ({wall}); {count} pictures are in {path}")))
        }
    }
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("\"{text}\" is no number"))
}

fn positive(text: &str) -> Result<f64, String> {
    let number = number(text)?;
    if number > 0.0 { Ok(number) } else { Err("it must be above 0".to_owned()) }
}

/// An angle of at most `MOST` degrees either way.
fn angle<const MOST: u32>(text: &str) -> Result<f64, String> {
    let (degrees, most) = (number(text)?, f64::from(MOST));
    if degrees.abs() <= most { Ok(degrees) } else { Err(format!("it must be from -{MOST} to {MOST}")) }
}

fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let all = text.split(',').map(number).collect::<Result<Vec<_>, _>>()?;
    <[f64; N]>::try_from(all).map_err(|all| format!("{} numbers where {N} are due", all.len()))
}

fn range(text: &str) -> Result<[f64; 2], String> {
    let [low, high] = numbers(text)?;
    if low < high { Ok([low, high]) } else { Err("the first must be below the second".to_owned()) }
}

fn view(text: &str) -> Result<View, String> {
    match text {
        "fit" => Ok(View::Fit),
        "first" => Ok(View::First),
        _ => numbers(text)
            .map(|place| View::At(Vec3::from(place)))
            .map_err(|reason| format!("{reason}; say fit, first, or a place in meters such as 0,0,1e-3")),
    }
}

fn map(text: &str) -> Result<Map, String> {
    let known = Map::WORDS.iter().find(|(word, _)| *word == text);
    known.map(|(_, map)| *map).ok_or_else(|| "there are viridis, cividis and inferno".to_owned())
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let parts = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    let size: [u32; 2] = parts.ok_or_else(|| "it must be like 1280x720".to_owned())?;
    let fits = size.iter().all(|length| (16..=16_384).contains(length));
    if fits { Ok(size) } else { Err("each must be from 16 to 16384".to_owned()) }
}

fn frames(text: &str) -> Result<RangeInclusive<usize>, String> {
    let number = |text: &str| text.parse::<usize>().map_err(|_| "it must be like 10..40 or 12".to_owned());
    let (first, last) = text.split_once("..").unwrap_or((text, text));
    let (first, last) = (number(first)?, number(last)?);
    if first <= last { Ok(first..=last) } else { Err("the first must not be after the last".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_the_command_line_are_read_or_refused() {
        assert_eq!(size("640x360"), Ok([640, 360]));
        assert_eq!((frames("3..9"), frames("4")), (Ok(3..=9), Ok(4..=4)));
        assert_eq!(range("-1,2e3"), Ok([-1.0, 2000.0]));
        assert_eq!(view("0,-1e-3,2"), Ok(View::At(Vec3::new(0.0, -1e-3, 2.0))));
        for refused in [size("640"), size("8x720"), size("1e3x720")] {
            assert!(refused.is_err(), "{refused:?}");
        }
        assert_err!(frames("9..3"));
        assert_err!(frames(".."));
        assert_err!(range("2,1"));
        assert_err!(range("nan,1"));
        assert_err!(range("1"));
        assert_err!(view("left"));
        assert_err!(view("1,2"));
        assert_err!(positive("0"));
        assert_err!(angle::<90>("-91"));
        assert_err!(map("jet"));
    }
}
