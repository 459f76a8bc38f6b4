//! A part of a study: some of its evaluations, in a folder of their own.
//!
//! All points of a study are known beforehand, and a replicate depends on the number of its evaluation alone. So a part goes
//! through the plan as the whole does, and runs those of its own range under the numbers that they have there. What it leaves
//! is its journal; [`join`](super::join) makes the journal of the whole of all of them.

use std::fmt;
use std::io::ErrorKind;
use std::ops::Range;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::archive::Stage;
use super::conduct::{AT_ONCE, Conductor, Stop};
use super::course::Course;
use super::{CampaignError, CampaignSummary};
use crate::folder::{CampaignFolder, FolderError, names};
use crate::record::{RecordError, atomic, door};
use crate::search::Model;
use crate::text::cell;

/// A part of a study, such as 3/16.
///
/// ```
/// use agglo::search::campaign::Part;
/// let part: Part = "3/16".parse()?;
/// assert_eq!(part.range(100), Ok(12..18));
/// assert_eq!(part.to_string(), "3 of 16");
/// # Ok::<(), agglo::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Which one, from 1.
    pub number: u64,
    /// Of how many.
    pub of: u64,
}

impl FromStr for Part {
    type Err = CampaignError;

    fn from_str(text: &str) -> Result<Self, CampaignError> {
        let numbers = text.split_once('/').and_then(|(number, of)| {
            let [number, of] = [number, of].map(|word| word.trim().parse().ok());
            Some(Self { number: number?, of: of? })
        });
        numbers.filter(|part| part.is_one()).ok_or_else(|| {
            let text = cell(text);
            let wanted = "one from 1/16 to 16/16 is wanted, if there are 16 parts";
            CampaignError::Parts(format!("\"{text}\" is no part; {wanted}"))
        })
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {}", self.number, self.of)
    }
}

impl Part {
    fn is_one(self) -> bool {
        (1..=self.of).contains(&self.number)
    }

    /// Numbers of its evaluations, of which the study has so many.
    ///
    /// # Errors
    /// In words, where it has fewer evaluations than parts.
    pub fn range(self, evaluations: u64) -> Result<Range<u64>, String> {
        if self.of > evaluations {
            let Self { number, of } = self;
            return Err(format!(
                "part {number}/{of}: the study has {evaluations} evaluations, and so at most as many parts"
            ));
        }
        // Numbers of files are far below what a product of two of them could overflow with.
        let border = |parts: u64| (u128::from(evaluations) * u128::from(parts) / u128::from(self.of)) as u64;
        Ok(border(self.number - 1)..border(self.number))
    }

    /// Notes down which part a folder holds.
    pub(super) fn write(self, folder: &CampaignFolder) -> Result<(), RecordError> {
        // A struct of numbers always has a text.
        let text = serde_json::to_string(&self).unwrap_or_default();
        atomic::write(&folder.part(), (text + "\n").as_bytes())
    }

    /// Which part a folder holds; none where it holds a whole campaign.
    pub(super) fn read(folder: &CampaignFolder) -> Result<Option<Self>, FolderError> {
        let path = folder.part();
        let text = match door::read_text(&path, door::MOST_OF_A_TEXT) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            read => read.map_err(RecordError::file("read", &path))?,
        };
        let part = serde_json::from_str(&text).ok().filter(|part: &Self| part.is_one());
        let reason = || format!("its {} is damaged, or of another version", names::PART);
        part.map(Some)
            .ok_or_else(|| FolderError::NoCampaign { dir: folder.root().to_owned(), reason: reason() })
    }
}

impl<M: Model> Conductor<'_, M> {
    /// Evaluates the part of a study and sums it up. The journal stays: it is what the part is for.
    pub(super) fn part(
        &mut self,
        mut course: Course<'_>,
        (_, own): &(Part, Range<u64>),
        wall_s: &dyn Fn() -> f64,
    ) -> Result<CampaignSummary, Stop> {
        let mut candidates = Vec::new();
        for (number, point) in (0..own.end).zip(course.optimizer.ask()) {
            let candidate = self.candidate(&point);
            if own.contains(&number) {
                candidates.push((number, candidate));
            } else {
                // Later ones with the same values are not run, as in the whole.
                self.way(number, Stage::Search, &candidate);
            }
        }
        while !candidates.is_empty() {
            let rest = candidates.split_off(AT_ONCE.min(candidates.len()));
            self.batch(Stage::Search, std::mem::replace(&mut candidates, rest))?;
        }
        self.generations = 1;
        self.folder.hold_on()?;
        self.records.flush()?;
        // What all evaluations say together is the whole's to tell.
        course.findings = &|_| Vec::new();
        let of_all = self.summary(&course, None);
        let mut summary = CampaignSummary { front: Vec::new(), ended_early: None, ..of_all };
        self.write_summary(&mut summary, wall_s)?;
        Ok(summary)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each evaluation is in one part, and no part is larger than another by more than one.
    #[test]
    fn parts_make_the_whole() {
        for (evaluations, of) in [(9, 4), (16, 16), (1_000_000, 7), (5, 1)] {
            let ranges: Vec<Range<u64>> =
                (1..=of).map(|number| Part { number, of }.range(evaluations).unwrap()).collect();
            let ends: Vec<u64> = ranges.iter().map(|range| range.end).collect();
            let starts: Vec<u64> = ranges.iter().map(|range| range.start).collect();
            assert_eq!((starts[0], ends.last()), (0, Some(&evaluations)));
            assert_eq!(starts[1..], ends[..ends.len() - 1]);
            let sizes: Vec<u64> = ranges.iter().map(|range| range.end - range.start).collect();
            let (least, most) = (sizes.iter().min().unwrap(), sizes.iter().max().unwrap());
            assert!(most - least <= 1 && *least > 0, "{sizes:?}");
        }
    }

    #[test]
    fn what_is_no_part_is_refused() {
        for text in ["0/4", "5/4", "3", "3/0", "-1/4", "a/b", "1/2/3", "", "1/99999999999999999999"] {
            let words = text.parse::<Part>().unwrap_err().to_string();
            assert_contains!(words, &format!("\"{text}\" is no part"));
        }
        assert_eq!(" 3 / 4".parse::<Part>().unwrap(), Part { number: 3, of: 4 });
        let words = Part { number: 3, of: 16 }.range(9).unwrap_err();
        assert_contains!(words, "part 3/16: the study has 9 evaluations");
    }
}
