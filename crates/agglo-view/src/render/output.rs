//! Where pictures go: a file, a folder of files, a movie.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::TempPath;

use super::error::RenderError;
use super::image::Image;
use agglo::record::{RecordError, atomic};

/// What is made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// One picture.
    Picture(PathBuf),
    /// Numbered pictures: the folder, and what stands before and after the numbers.
    Pictures(PathBuf, [String; 2]),
    /// A movie, H.264 in MP4.
    Movie(PathBuf),
    /// A movie as GIF.
    Gif(PathBuf),
}

impl Output {
    /// What a path asks for, by its end: a file `.png`, `.mp4` or `.gif`, a folder (`frames/`), or a pattern
    /// (`frames/*.png`).
    ///
    /// # Errors
    /// [`RenderError::Output`].
    /// ```
    /// use agglo_view::render::Output;
    /// use std::path::Path;
    /// assert_eq!(Output::of(Path::new("a/b.mp4")).unwrap(), Output::Movie("a/b.mp4".into()));
    /// let frames = Output::Pictures("a".into(), ["frame_".into(), ".png".into()]);
    /// assert_eq!(Output::of(Path::new("a/")).unwrap(), frames);
    /// ```
    pub fn of(path: &Path) -> Result<Self, RenderError> {
        let unknown = || RenderError::Output { path: path.to_owned() };
        let text = path.to_str().ok_or_else(unknown)?;
        if text.ends_with(std::path::is_separator) || path.is_dir() {
            return Ok(Self::Pictures(path.components().collect(), ["frame_".into(), ".png".into()]));
        }
        let name = path.file_name().and_then(|name| name.to_str()).ok_or_else(unknown)?;
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        match (name.split_once('*'), extension.to_lowercase().as_str()) {
            (Some((before, after)), "png") if !after.contains('*') => {
                let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
                let folder = folder.unwrap_or(Path::new(".")).to_owned();
                Ok(Self::Pictures(folder, [before.to_owned(), after.to_owned()]))
            }
            (None, "png") => Ok(Self::Picture(path.to_owned())),
            (None, "mp4") => Ok(Self::Movie(path.to_owned())),
            (None, "gif") => Ok(Self::Gif(path.to_owned())),
            _ => Err(unknown()),
        }
    }

    /// Whether there is one picture only.
    pub fn is_single(&self) -> bool {
        matches!(self, Self::Picture(_))
    }

    /// Whether it is a movie.
    pub fn is_movie(&self) -> bool {
        matches!(self, Self::Movie(_) | Self::Gif(_))
    }

    /// A size that it can have: movies have even ones.
    pub fn fitting(&self, size: [u32; 2]) -> [u32; 2] {
        if matches!(self, Self::Movie(_)) { size.map(|length| length.next_multiple_of(2)) } else { size }
    }

    /// Opens it for pictures of this size, `rate` of them a second.
    pub(super) fn open(&self, size: [u32; 2], rate: f64) -> Result<Sink, RenderError> {
        match self {
            Self::Picture(path) => {
                make_folder(folder_of(path))?;
                Ok(Sink::Picture(path.clone()))
            }
            Self::Pictures(folder, name) => {
                let is_used = |entries: std::fs::ReadDir| {
                    entries.flatten().any(|entry| {
                        let entry = entry.file_name().to_string_lossy().into_owned();
                        *name == ["frame_", ".png"]
                            || (entry.starts_with(&name[0]) && entry.ends_with(&name[1]))
                    })
                };
                if std::fs::read_dir(folder).is_ok_and(is_used) {
                    return Err(RenderError::Occupied { dir: folder.clone() });
                }
                make_folder(folder)?;
                Ok(Sink::Pictures { folder: folder.clone(), name: name.clone(), count: 0 })
            }
            Self::Movie(path) => {
                // Players want even sizes, colors at half the resolution, and what they need first at the start.
                let codec = ["-c:v", "libx264", "-preset", "medium", "-crf", "18", "-pix_fmt", "yuv420p"];
                let more = ["-movflags", "+faststart", "-threads", "1", "-f", "mp4"];
                Ok(Sink::Movie(Encoder::start(path, size, rate, &[&codec[..], &more[..]].concat())?))
            }
            Self::Gif(path) => {
                // Each picture has colors of its own: so nothing has to wait for the last one.
                let palette = "split[a][b];[a]palettegen=stats_mode=single[p];\
                               [b][p]paletteuse=new=1:dither=bayer:bayer_scale=4";
                Ok(Sink::Movie(Encoder::start(
                    path,
                    size,
                    rate,
                    &["-vf", palette, "-loop", "0", "-f", "gif"],
                )?))
            }
        }
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn make_folder(folder: &Path) -> Result<(), RenderError> {
    Ok(std::fs::create_dir_all(folder).map_err(RecordError::file("make the folder", folder))?)
}

/// What takes pictures.
#[derive(Debug)]
pub(super) enum Sink {
    Picture(PathBuf),
    Pictures { folder: PathBuf, name: [String; 2], count: usize },
    Movie(Encoder),
}

impl Sink {
    /// Takes the next picture.
    pub fn take(&mut self, image: &Image) -> Result<(), RenderError> {
        match self {
            Self::Picture(path) => write_png(path, image),
            Self::Pictures { folder, name: [before, after], count } => {
                *count += 1;
                write_png(&folder.join(format!("{before}{:06}{after}", *count - 1)), image)
            }
            Self::Movie(encoder) => encoder.take(image),
        }
    }

    /// Ends it; a movie gets its name only now.
    pub fn finish(self) -> Result<(), RenderError> {
        match self {
            Self::Movie(encoder) => encoder.finish(),
            Self::Picture(_) | Self::Pictures { .. } => Ok(()),
        }
    }
}

fn write_png(path: &Path, image: &Image) -> Result<(), RenderError> {
    let mut bytes = Vec::new();
    image.write_png(&mut bytes).map_err(RecordError::file("write", path))?;
    Ok(atomic::write(path, &bytes)?)
}

/// Movies in the making: the files that go if they are not finished.
static IN_THE_MAKING: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Those files.
fn in_the_making() -> MutexGuard<'static, Vec<PathBuf>> {
    IN_THE_MAKING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Takes away the parts of movies that are not finished, in a program that ends at once.
pub fn clear_at_exit() {
    for part in in_the_making().drain(..) {
        // What is not there need not go, and of other trouble nobody is left to be told.
        let _ = std::fs::remove_file(part);
    }
}

/// A program that makes a movie from pixels. The movie is written beside its place; unless it is finished it goes.
#[derive(Debug)]
pub(super) struct Encoder {
    program: Child,
    pixels: Option<ChildStdin>,
    part: Option<TempPath>,
    path: PathBuf,
}

impl Encoder {
    fn start(path: &Path, [width, height]: [u32; 2], rate: f64, how: &[&str]) -> Result<Self, RenderError> {
        let folder = folder_of(path);
        make_folder(folder)?;
        let part = atomic::beside(path)?;
        let (size, rate) = (format!("{width}x{height}"), rate.to_string());
        let input = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", &size, "-r", &rate, "-i", "pipe:0"];
        let mut program = Command::new("ffmpeg");
        program
            .args(["-hide_banner", "-loglevel", "error", "-nostdin", "-y"])
            .args(input)
            .args(how)
            .arg(&part);
        program.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        // Ctrl-C is for this program, which then tells that one.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut program, 0);
        let mut program = program.spawn().map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => RenderError::NoFfmpeg,
            _ => RenderError::Ffmpeg { path: path.to_owned(), reason: error.to_string() },
        })?;
        let pixels = program.stdin.take();
        in_the_making().push(part.to_path_buf());
        Ok(Self { program, pixels, part: Some(part), path: path.to_owned() })
    }

    fn take(&mut self, image: &Image) -> Result<(), RenderError> {
        let taken = self.pixels.as_mut().map(|pixels| pixels.write_all(&image.rgb()));
        // It tells at its end why it hung up.
        if let Some(Err(error)) = taken { Err(self.failed(&error.to_string())) } else { Ok(()) }
    }

    fn finish(mut self) -> Result<(), RenderError> {
        self.pixels = None;
        let ended = self.program.wait();
        if !ended.as_ref().is_ok_and(std::process::ExitStatus::success) {
            return Err(self.failed(&ended.map_or_else(|error| error.to_string(), |code| code.to_string())));
        }
        let Some(part) = self.part.take() else { return Ok(()) };
        in_the_making().retain(|other| *other != *part);
        let kept = part.persist(&self.path).map_err(|error| error.error);
        Ok(kept.map_err(RecordError::file("write", &self.path))?)
    }

    /// The error with the last words of the program, or else with `reason`.
    fn failed(&mut self, reason: &str) -> RenderError {
        self.pixels = None;
        let mut words = String::new();
        if let Some(mut said) = self.program.stderr.take() {
            // Words that cannot be read are not the trouble to tell of.
            let _ = said.read_to_string(&mut words);
        }
        let last: Vec<&str> = words.lines().rev().take(3).collect();
        let last: Vec<&str> = last.into_iter().rev().collect();
        let reason = if last.is_empty() { reason.to_owned() } else { last.join("\n") };
        RenderError::Ffmpeg { path: self.path.clone(), reason }
    }
}

impl Drop for Encoder {
    /// A program that was not waited for would go on with nobody to write to.
    fn drop(&mut self) {
        self.pixels = None;
        // It has ended already where the movie is finished.
        let _ = self.program.kill();
        let _ = self.program.wait();
        if let Some(part) = &self.part {
            in_the_making().retain(|other| *other != **part);
        }
    }
}
