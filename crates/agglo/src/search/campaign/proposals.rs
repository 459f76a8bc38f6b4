//! Points that a program outside proposes, held to those that it proposed before.
//!
//! The journal has what replicates came to by the numbers of their evaluations. A method of agglo proposes the same points
//! again, whose replicates these are; a program may not, and would be told what other points have come to. So the journal has
//! their checksums as well.

use super::CampaignError;
use super::journal::{Journal, Past};
use crate::search::optimizer::Point;

/// The points of a campaign that a program leads; nothing is looked at in others.
pub(super) struct Proposals<'a> {
    journal: &'a Journal,
    is_led: bool,
}

impl<'a> Proposals<'a> {
    /// Of a campaign that a program leads, or does not.
    pub fn new(journal: &'a Journal, is_led: bool) -> Self {
        Self { journal, is_led }
    }

    /// Writes down the points of the evaluations from this number on, and refuses others than those of an earlier session.
    pub fn hold(&self, past: &Past, first: u64, points: &[Point]) -> Result<(), CampaignError> {
        for (evaluation, point) in (first..).zip(points).filter(|_| self.is_led) {
            let bytes: Vec<u8> = point.iter().flat_map(|part| part.to_bits().to_le_bytes()).collect();
            let checksum = crc32fast::hash(&bytes);
            match past.points.get(&evaluation) {
                None => self.journal.propose(evaluation, checksum)?,
                Some(known) if *known == checksum => {}
                Some(_) => return Err(CampaignError::OtherPoint { evaluation }),
            }
        }
        Ok(())
    }
}
