//! Parts of a study put together.
//!
//! The journals of all parts are the journal of the whole. The whole is then gone on with as after a kill: it finds all
//! replicates there, runs none, and writes what one process would have written, by the same code.

use std::path::{Path, PathBuf};

use super::journal::Origin;
use super::part::Part;
use super::verbs::{go_on, text_of};
use super::{CampaignEnding, CampaignError, CampaignObserver, Means, finished, journal};
use crate::folder::{CampaignFolder, names};
use crate::record::{RecordError, atomic, door};

/// Makes the whole study of all its parts, in any order, in the folder `dir`.
///
/// The folder is, but for wall times, byte for byte the one that [`run`](super::run) would have written. Where lines of a
/// part's journal were damaged, their replicates are run again.
///
/// # Errors
/// [`CampaignError::Parts`] where one is missing, there twice, of another study, or not at its end; else as
/// [`resume`](super::resume).
pub fn join(
    parts: &[PathBuf],
    dir: &Path,
    means: Means<'_>,
    observer: &mut CampaignObserver<'_>,
) -> Result<CampaignEnding, CampaignError> {
    let parts = all_parts(parts)?;
    let Some((first, _)) = parts.first() else { return Err(refusal("there are no parts")) };
    let text = text_of(first)?;
    let origin = Origin { campaign: &text, function: None };
    let mut lines = origin.heading().into_bytes();
    for (folder, _) in &parts {
        refuse_other_study(first, folder)?;
        let found = journal::lines(&folder.journal(), &origin)?;
        let found = found.map_err(|reason| refusal(&format!("{}: {reason}", folder.root().display())))?;
        lines.extend(found.iter().skip(origin.heading().len()));
    }
    let read =
        |path: &Path| door::read_text(path, door::MOST_OF_A_TEXT).map_err(RecordError::file("read", path));
    let whole = CampaignFolder::create(dir)?;
    whole.take_tables_of(first)?;
    atomic::write(&whole.journal(), &lines)?;
    whole.put(&read(&first.campaign())?, &read(&first.scenario())?)?;
    go_on(&whole, means, observer)
}

fn refusal(reason: &str) -> CampaignError {
    CampaignError::Parts(format!("cannot join the parts of a study: {reason}"))
}

/// The folders of all parts of a study in their order, each of which is there once and has come to its end.
fn all_parts(parts: &[PathBuf]) -> Result<Vec<(CampaignFolder, Part)>, CampaignError> {
    let mut known: Vec<(CampaignFolder, Part)> = Vec::new();
    for dir in parts {
        let (folder, shown) = (CampaignFolder::at(dir), dir.display());
        let Some(part) = Part::read(&folder)? else {
            let help = "help: `agglo study FILE --part 1/4` runs the first of four parts";
            return Err(refusal(&format!("{shown} holds none: there is no {} in it\n{help}", names::PART)));
        };
        if let Some((other, one)) =
            known.iter().find(|(_, one)| one.of != part.of || one.number == part.number)
        {
            let other = other.root().display();
            return Err(refusal(&if one.of == part.of {
                format!("both {other} and {shown} are part {part}; give each part once")
            } else {
                format!("{other} is part {one}, {shown} is part {part}; give the parts of one division")
            }));
        }
        if finished(dir).is_none() {
            let reason =
                format!("part {part} has not come to its end; `agglo resume {shown}` goes on with it");
            return Err(refusal(&reason));
        }
        known.push((folder, part));
    }
    known.sort_by_key(|(_, part)| part.number);
    let of = known.first().map_or(0, |(_, part)| part.of);
    match missing(of, &known) {
        None => Ok(known),
        Some(missing) => Err(refusal(&format!("of {of} parts {missing}; give the folders of all of them"))),
    }
}

/// "number 3 is missing", "numbers 3, 5 are missing"; the first ones where they are many.
fn missing(of: u64, known: &[(CampaignFolder, Part)]) -> Option<String> {
    const SHOWN: usize = 10;
    let count = of - known.len() as u64;
    let is_missing = |number: &u64| known.binary_search_by_key(number, |(_, part)| part.number).is_err();
    let first: Vec<String> =
        (1..=of).filter(is_missing).take(SHOWN).map(|number| number.to_string()).collect();
    let more = if count > SHOWN as u64 { " and others" } else { "" };
    match count {
        0 => None,
        1 => Some(format!("number {} is missing", first.join(", "))),
        _ => Some(format!("numbers {}{more} are missing", first.join(", "))),
    }
}

/// Parts of one study have the same file and base, and the same tables.
fn refuse_other_study(first: &CampaignFolder, other: &CampaignFolder) -> Result<(), CampaignError> {
    let read = |path: PathBuf| {
        door::read_text(&path, door::MOST_OF_A_TEXT).map_err(RecordError::file("read", &path))
    };
    let differs = if read(first.campaign())? != read(other.campaign())? {
        names::CAMPAIGN
    } else if read(first.scenario())? != read(other.scenario())? {
        names::SCENARIO
    } else if first.told_of_tables()? != other.told_of_tables()? {
        names::TABLES
    } else {
        return Ok(());
    };
    let (first, other) = (first.root().display(), other.root().display());
    Err(refusal(&format!("{first} and {other} are of different studies: their {differs} is not the same")))
}
