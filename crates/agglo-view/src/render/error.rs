//! Why there is no picture.

use std::path::PathBuf;

use agglo::record::RecordError;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// A file cannot be written.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A frame or the list of them cannot be read.
    #[error("{0}\nhelp: --frames A..B draws those that are whole; `agglo report` shows all that can be read")]
    Frame(RecordError),
    /// The folder has no frames.
    #[error(
        "{dir} has no frames: there is no {list}\nhelp: a run writes frames as its scenario says under [output]; name \
         the folder of a run, such as out/my, or of a search that has finished and run its best",
        dir = .dir.display(), list = .list.display()
    )]
    NoFrames {
        /// The folder.
        dir: PathBuf,
        /// The list of frames that should be there.
        list: PathBuf,
    },
    /// Frames that are not there were asked for.
    #[error("there are no frames {asked}: {dir} has {count}, from 0 to {last}", dir = .dir.display(), last = .count - 1)]
    FrameRange {
        /// The folder.
        dir: PathBuf,
        /// What was asked for.
        asked: String,
        /// How many frames there are.
        count: usize,
    },
    /// The frames do not hold what the grains should be colored by.
    #[error("the frames of {dir} cannot be colored by \"{found}\"{advice}\nthey can be by {known}", dir = .dir.display())]
    Color {
        /// The folder.
        dir: PathBuf,
        /// What was asked for.
        found: String,
        /// "; did you mean ...?"
        advice: String,
        /// What there is.
        known: String,
    },
    /// A frame lacks a field that others have.
    #[error("cannot draw {path}: it has no field `{field}`", path = .path.display())]
    Field {
        /// The frame.
        path: PathBuf,
        /// The field.
        field: &'static str,
    },
    /// Bonds or rays were asked for where there are none.
    #[error("{dir} has no frames of {what}: there is no {list}", dir = .dir.display(), list = .list.display())]
    NoLines {
        /// The folder.
        dir: PathBuf,
        /// "bonds" or "rays".
        what: &'static str,
        /// The list that should be there.
        list: PathBuf,
    },
    /// No frame has a grain in it.
    #[error("there is nothing to draw: no frame of {dir} has a grain", dir = .dir.display())]
    NoGrains {
        /// The folder.
        dir: PathBuf,
    },
    /// An output that is no kind of picture.
    #[error(
        "cannot tell from its name what {path} should be\nhelp: .png is a picture, .mp4 and .gif are movies, and a \
         folder (frames/) or a pattern (frames/*.png) is a numbered picture of each frame",
        path = .path.display()
    )]
    Output {
        /// What was asked for.
        path: PathBuf,
    },
    /// The folder for pictures is in use.
    #[error("the folder {dir} is not empty\nhelp: remove it, or name another one", dir = .dir.display())]
    Occupied {
        /// The folder.
        dir: PathBuf,
    },
    /// Movies have no transparency.
    #[error("a movie cannot be transparent: --background light or dark, or pictures (-o frames/) instead")]
    TransparentMovie,
    /// There is no ffmpeg.
    #[error(
        "movies are made by the program ffmpeg, which is not here\nhelp: install the package `ffmpeg`, or let agglo write \
         numbered pictures: -o frames/"
    )]
    NoFfmpeg,
    /// ffmpeg failed.
    #[error("ffmpeg could not write {path}: {reason}", path = .path.display())]
    Ffmpeg {
        /// The movie.
        path: PathBuf,
        /// Its last words.
        reason: String,
    },
}

impl RenderError {
    /// Exit code of the program: 1 for work that failed, 2 for bad input.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Record(_) | Self::Field { .. } | Self::Ffmpeg { .. } => 1,
            Self::Frame(_)
            | Self::NoFrames { .. }
            | Self::FrameRange { .. }
            | Self::Color { .. }
            | Self::NoLines { .. }
            | Self::NoGrains { .. }
            | Self::Output { .. }
            | Self::Occupied { .. }
            | Self::TransparentMovie
            | Self::NoFfmpeg => 2,
        }
    }
}
