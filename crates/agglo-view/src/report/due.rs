//! Files that a run writes and that are not in its folder, or not as they should be.

use std::path::{Path, PathBuf};

use super::folder::{Folder, files};
use agglo::contact::Bonds;
use agglo::folder::names;
use agglo::record::frames::Collection;
use agglo::record::{About, Declared, Sheet};
use agglo::run::{tables_at_the_end, tables_of};

/// Names of frames in one note at the most.
const MOST_NAMES: usize = 5;

/// What is not as the run should have written it.
pub fn notes(folder: &Folder) -> Vec<String> {
    let mut notes = Vec::new();
    if let Some(scenario) = &folder.scenario {
        let is_hard = scenario.is_hard();
        for due in tables_of(scenario) {
            if due.file() != names::RAYS || scenario.acoustics().is_some() {
                notes.extend(table(folder, due));
            }
        }
        if folder.summary.is_some() {
            let at_the_end = tables_at_the_end(is_hard).iter().map(|table| table.file());
            let lost = at_the_end.filter(|name| !folder.root.join(name).exists());
            notes.extend(lost.map(|name| format!("{name} is missing")));
        }
    }
    notes.extend(frames(folder));
    notes
}

/// What is wrong with a table that is due.
fn table(folder: &Folder, due: &dyn Declared) -> Option<String> {
    let place = due.file();
    let path = folder.root.join(place);
    if !path.exists() {
        let charts = if due.series().is_some() { ": its charts are left out" } else { "" };
        return Some(format!("{place} is missing{charts}"));
    }
    let (names, dropped) = match due.series() {
        // Its rows are counted where it is read; one that cannot be read is named there.
        Some(name) => (folder.table(name)?.names.clone(), 0),
        None => match Sheet::read_with(&path, false) {
            Ok(sheet) => (sheet.names.clone(), damaged(&sheet, &due.columns())),
            Err(reason) => return Some(format!("{place} cannot be used: {reason}")),
        },
    };
    let lost: Vec<&str> =
        due.names().into_iter().filter(|due| !names.iter().any(|name| name == due)).collect();
    if !lost.is_empty() {
        return Some(format!("{place} is damaged: it has no {}", lost.join(", ")));
    }
    (dropped > 0).then(|| format!("{place} is cut or damaged: {dropped} of its rows cannot be used"))
}

/// Rows that were left out, and those with what is no finite number in a column of numbers.
fn damaged(sheet: &Sheet, columns: &[&About]) -> usize {
    let is_whole = |(name, entry): (&String, &String)| {
        let is_word = columns.iter().any(|column| column.name == name && column.is_word);
        is_word || entry.parse().is_ok_and(f64::is_finite)
    };
    let rows = sheet.rows.iter().filter(|row| !sheet.names.iter().zip(*row).all(is_whole));
    sheet.dropped + rows.count()
}

/// Frames that are missing, and lists of them that are missing or damaged.
fn frames(folder: &Folder) -> Vec<String> {
    let place = folder.root.join(names::FRAMES);
    let mut notes = Vec::new();
    let mut due = Vec::new();
    for kind in ["grains", "bonds", "rays", "walls"] {
        let list = place.join(names::frame_list(kind));
        let there = numbers(&files(&place, &format!("{kind}_"), names::FRAME_ENDING));
        let listed = Collection::read(&list)
            .map(|listed| numbers(&listed.frames().map(|(_, file)| PathBuf::from(file)).collect::<Vec<_>>()));
        // Frames of all kinds are written together, numbered from 0 without gaps.
        let last = there.iter().chain(listed.iter().flatten()).max();
        due.extend(last.map(|last| (kind, there.clone(), last + 1)));
        match listed {
            Ok(listed) if there.iter().all(|number| listed.contains(number)) => {}
            Ok(_) => notes.push(format!(
                "{}/{} does not list all frames; those in the folder are shown",
                names::FRAMES,
                names::frame_list(kind)
            )),
            Err(_) if there.is_empty() => {}
            Err(error) => notes.push(format!("{error}: the frames in the folder are shown instead")),
        }
    }
    let count = due.iter().map(|(.., count)| *count).max().unwrap_or(0);
    for kind in ["grains", "bonds", "rays", "walls"] {
        let there = due.iter().find(|(known, ..)| *known == kind).map(|(_, there, _)| there.as_slice());
        if there.is_some() || is_due(folder, kind) {
            notes.extend(missing(kind, there.unwrap_or_default(), count));
        }
    }
    notes
}

/// Whether the scenario asks for frames of that kind.
fn is_due(folder: &Folder, kind: &str) -> bool {
    folder.scenario.as_ref().is_some_and(|scenario| match kind {
        // Of bonds that have no memory there is nothing to draw.
        "bonds" => {
            let bonds = scenario.soft().and_then(|soft| soft.bonds.as_ref());
            matches!(bonds, Some(Bonds::Beam(_))) && scenario.output.bonds
        }
        "rays" => scenario.acoustics().is_some() && scenario.output.rays,
        "walls" => scenario.soft().is_some_and(|soft| !soft.walls.is_empty()),
        _ => true,
    })
}

/// The files of a kind that are not there.
fn missing(kind: &str, there: &[usize], count: usize) -> Option<String> {
    let lost: Vec<String> = (0..count)
        .filter(|number| !there.contains(number))
        .map(|number| names::frame(kind, number))
        .collect();
    if lost.is_empty() {
        return None;
    }
    let shown = lost.iter().take(MOST_NAMES).map(String::as_str).collect::<Vec<_>>().join(", ");
    let more = match lost.len().saturating_sub(MOST_NAMES) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    Some(format!("frames are missing: {shown}{more}"))
}

/// Numbers at the ends of the names.
fn numbers(paths: &[PathBuf]) -> Vec<usize> {
    let number = |path: &PathBuf| Path::new(path).file_stem()?.to_str()?.rsplit('_').next()?.parse().ok();
    paths.iter().filter_map(number).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::ops::ControlFlow;

    use super::*;
    use crate::report::Report;
    use agglo::run::run;
    use agglo::scenario::{Scenario, template};

    fn finished(name: &str, settings: &[&str]) -> tempfile::TempDir {
        let scenario = Scenario::with_overrides(template(name).unwrap().text, settings).unwrap();
        let folder = tempfile::tempdir().unwrap();
        run(&scenario, Path::new(""), &folder.path().join("out"), &mut |_| ControlFlow::Continue(()))
            .unwrap();
        folder
    }

    /// What a report says of a file that is missing, and of one that is damaged, is nothing else than that.
    #[test]
    fn each_file_that_is_not_whole_is_named() {
        let settings = ["time.end=\"0.1 ms\"", "output.frames=\"0.05 ms\""];
        let kept = finished("reacting", &settings);
        let folder = kept.path().join("out");
        let notes = || Report::of_run(&folder).unwrap().notes;
        assert!(notes().is_empty(), "{:?}", notes());
        let places = agglo::run::tables(true).iter().chain(tables_at_the_end(true)).map(|table| table.file());
        for place in places.chain(["frames/grains_000001.vtp", "frames/grains.pvd"]) {
            let name = Path::new(place).file_name().unwrap().to_str().unwrap();
            let whole = fs::read(folder.join(place)).unwrap();
            fs::remove_file(folder.join(place)).unwrap();
            assert!(notes().iter().any(|note| note.contains(name)), "{place}: {:?}", notes());
            fs::write(folder.join(place), &whole).unwrap();
        }
        fs::write(folder.join("frames/grains.pvd"), [0x9c, 0xff, 0x03]).unwrap();
        assert!(notes()[0].contains("grains.pvd"), "{:?}", notes());
        let summary = fs::read_to_string(folder.join("summary.json")).unwrap();
        fs::write(folder.join("summary.json"), &summary[..40]).unwrap();
        let report = Report::of_run(&folder).unwrap();
        let story = report.story;
        assert!(story.contains("100 %") && story.contains("Warnings are unknown"), "{story}");
        assert_false!(report.laws_are_unknown, "the laws stand in the scenario");
        fs::remove_file(folder.join("scenario.toml")).unwrap();
        assert_true!(Report::of_run(&folder).unwrap().laws_are_unknown, "the scenario is gone");
    }

    #[test]
    fn a_run_without_sound_misses_no_rays() {
        let text = template("acoustic-published").unwrap().text;
        let mut scenario = Scenario::from_toml(text).unwrap();
        let with =
            |scenario: &Scenario| notes(&Folder { scenario: Some(scenario.clone()), ..Folder::default() });
        assert_any!(with(&scenario).iter(), |note| note.contains("series/rays.csv is missing"));
        scenario.soft_mut().unwrap().acoustics = None;
        assert_no!(with(&scenario).iter(), |note| note.contains("rays"));
    }
}
