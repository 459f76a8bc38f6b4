//! What of a run's frames is shown, so that the page stays small.

use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::pack;
use super::scene::{Scene, beside};
use agglo::record::door;

/// Bytes of the packed block in the page, at the most. The page has 25 MB: charts take up to 4 MB beside it.
pub const MOST_BYTES: usize = 19_000_000;
/// Frames are left out until there are this many; then grains are.
const FRAMES_KEPT: usize = 24;
/// Frames that are packed to see how many bytes a grain takes.
const SAMPLES: usize = 3;
/// No frame takes as many times the bytes that are reckoned from its head: below that nothing need be packed to see.
const SURELY: f64 = 4.0;

/// What of a run's frames is shown.
pub struct Choice {
    /// So many frames, evenly spaced.
    pub kept: usize,
    /// One of so many grains, rays, and bonds whose both ends are kept.
    pub share: u64,
}

impl Choice {
    /// What fits into so many bytes: frames are left out until few are left, then grains.
    pub fn of(files: &[PathBuf], most: usize) -> Self {
        let all = Self { kept: files.len(), share: 1 };
        let things: Vec<f64> = files.iter().map(|path| things(path)).collect();
        if SURELY * things.iter().sum::<f64>() <= most as f64 {
            return all;
        }
        let (mut bytes, mut packed) = (0.0, 0.0);
        for at in (Self { kept: SAMPLES.min(files.len()), share: 1 }).frames(files.len()) {
            // Frames that cannot be read are named when they are packed.
            if let Ok(scene) = Scene::read(&files[at], &mut Vec::new()) {
                packed += pack(&[scene], Vec::new()).packed.len() as f64;
                bytes += things[at];
            }
        }
        if bytes <= 0.0 {
            return all;
        }
        let mut choice = all;
        choice.thin_on((packed / bytes * things.iter().sum::<f64>()).ceil() as usize, most);
        choice
    }

    /// Leaves more out, as so many bytes are too many; whether there was anything to leave out.
    pub fn thin_on(&mut self, bytes: usize, most: usize) -> bool {
        if bytes <= most {
            return false;
        }
        let part = most as f64 / bytes as f64;
        let before = self.kept;
        self.kept = ((part * before as f64).floor() as usize).max(FRAMES_KEPT).min(before);
        // What the fewer frames do not save the grains must.
        let left = bytes as f64 * self.kept as f64 / before as f64;
        if left > most as f64 {
            self.share = ((self.share as f64 * left / most as f64).ceil() as u64).max(self.share + 1);
        }
        // With a share this large no page is too large for its grains.
        self.share < u64::from(u32::MAX)
    }

    /// Which of so many frames are shown: evenly spaced ones, the first and the last among them.
    pub fn frames(&self, count: usize) -> impl Iterator<Item = usize> + use<> {
        let (kept, last) = (self.kept, count.saturating_sub(1));
        let gaps = kept.saturating_sub(1).max(1);
        (0..kept).map(move |at| (at * last + gaps / 2) / gaps)
    }

    /// What is left out, in words.
    pub fn notes(&self, frames: usize) -> Vec<String> {
        let mut notes = Vec::new();
        if self.kept < frames {
            notes.push(format!("the replay shows {} of {frames} frames, to keep the file small", self.kept));
        }
        if self.share > 1 {
            notes.push(format!(
                "the replay shows one of {} grains and rays, and the bonds between those, to keep the file small",
                self.share
            ));
        }
        notes
    }
}

/// Points and lines of a frame and of what is drawn over it, each with the bytes that it takes unpacked, about.
fn things(path: &Path) -> f64 {
    let [grains, _] = counts(path);
    let [_, bonds] = counts(&beside(path, "bonds"));
    let [rays, walls] = ["rays", "walls"].map(|kind| counts(&beside(path, kind))[0]);
    24.0 * grains + 8.0 * bonds + 14.0 * rays + 6.0 * walls
}

/// How many points and lines the head of a frame announces; none where it does not.
fn counts(path: &Path) -> [f64; 2] {
    let mut head = Vec::new();
    // What is announced stands in the first lines.
    let read = door::open(path).and_then(|file| file.take(2_000).read_to_end(&mut head));
    let text = String::from_utf8_lossy(&head);
    let count = |key: &str| -> Option<f64> {
        text.split_once(&format!("{key}=\""))?.1.split_once('"')?.0.parse::<u32>().ok().map(f64::from)
    };
    if read.is_err() {
        [0.0; 2]
    } else {
        ["NumberOfPoints", "NumberOfLines"].map(|key| count(key).unwrap_or(0.0))
    }
}
