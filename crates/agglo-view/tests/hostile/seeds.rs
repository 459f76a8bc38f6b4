//! What mutation begins from: the shipped files, and folders of small runs and searches made on the spot.

use std::fmt::Write as _;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

use agglo::packing::{Placement, Table};
use agglo::run;
use agglo::scenario::{Scenario, template};
use agglo::search::Campaign;
use agglo::search::campaign::{self, Means};
use agglo_view::pictures::campaign_pictures;

/// Twelve bonded grains, one pulse.
const SMALL: [&str; 7] = [
    "grains.0.placement.random.region.sphere.radius=90 um",
    "grains.0.placement.random.solid_fraction=0.15",
    "acoustics.beams.0.rays=100",
    "time.end=8 us",
    "output.frames=3 us",
    "output.checkpoints=1.5 us",
    "output.pulses.frames=2 us",
];
const SEARCH: &str = include_str!("search.toml");
const TABLE: &str = "# four grains\nx_m,y_m,z_m,radius_m,vx_m_s,vy_m_s,vz_m_s,temperature_K\n\
    0,0,0,1e-3,0,0,0,300\n0.01,0,0,1e-3,0,-0.5,0,310\n0,1e-2,0,2e-3,0,0,0,300\n0,0,1e-2,1.5e-3,0.25,0,0,300\n";

/// A scenario's text that is valid.
pub fn valid() -> &'static str {
    template("microscale").expect("it is there").text
}

/// The same solid fraction with 60 hard grains.
const FEW: [&str; 4] = [
    "time.end=0.2 ms",
    "grains.0.placement.fill.count=60",
    "grains.0.size.length_ratio.count=60",
    "output.frames=0.1 ms",
];

/// Makes the folders `stopped`, `finished` and `grown` of runs, `begun` and `begun-hard` of scenarios that start from a
/// state, `search` and `ended` of searches, `part` of a study's, and `table`.
pub fn make(place: &Path) {
    let scenario = Scenario::with_overrides(valid(), &SMALL).unwrap_or_else(|faults| panic!("{faults}"));
    fs::create_dir_all(place.join("table")).expect("a folder");
    fs::write(place.join("table/grains.csv"), TABLE).expect("a file");
    let mut tabled = scenario.clone();
    tabled.grains[0].placement = Placement::Table(Table { file: "grains.csv".into() });
    fs::write(place.join("table/scenario.toml"), tabled.to_toml().expect("a text")).expect("a file");

    let hard = Scenario::with_overrides(template("reacting").expect("it is there").text, &FEW)
        .unwrap_or_else(|faults| panic!("{faults}"));
    for (name, scenario) in [("begun", &scenario), ("begun-hard", &hard)] {
        let mut next = scenario.clone();
        next.grains.clear();
        next.from = Some("state.agglo".into());
        fs::create_dir_all(place.join(name)).expect("a folder");
        fs::write(place.join(name).join("scenario.toml"), next.to_toml().expect("a text")).expect("a file");
        fs::write(place.join(name).join("state.agglo"), "").expect("a file");
    }

    let goes_on = |_: &run::Progress| ControlFlow::Continue(());
    run::run(&scenario, Path::new(""), &place.join("finished"), &mut { goes_on }).expect("it runs");
    run::run(&hard, Path::new(""), &place.join("grown"), &mut { goes_on }).expect("it runs");
    // What it had when it was half done.
    run::run(&scenario, Path::new(""), &place.join("stopped"), &mut { goes_on }).expect("it runs");
    fs::remove_file(place.join("stopped/summary.json")).expect("it has finished");
    let checkpoints = place.join("stopped/checkpoints");
    let mut names: Vec<_> =
        fs::read_dir(checkpoints).expect("a folder").flatten().map(|entry| entry.path()).collect();
    names.sort();
    fs::remove_file(names.pop().expect("a checkpoint at the end")).expect("a file");

    let search = Campaign::from_toml(SEARCH).unwrap_or_else(|faults| panic!("{faults}"));
    let ended = |dir: &Path, most: u64| {
        let mut observer = |progress: &campaign::CampaignProgress| {
            if progress.evaluations < most { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let means = Means { draw: Some(&campaign_pictures), ..Means::threads(1) };
        campaign::run(&search, Path::new(""), dir, means, &mut observer).expect("it searches");
    };
    ended(&place.join("ended"), u64::MAX);
    ended(&place.join("search"), 3);

    let (before, _) = SEARCH.split_once("[method.random]").expect("it is there");
    let study = Campaign::from_toml(&format!("{before}[plan.morris]\ntrajectories = 2\nlevels = 2\n"));
    let study = study.unwrap_or_else(|faults| panic!("{faults}"));
    let goes_on = |_: &campaign::CampaignProgress| ControlFlow::Continue(());
    let part = campaign::Part { number: 1, of: 2 };
    campaign::run_part(&study, Path::new(""), (&place.join("part"), part), Means::threads(1), &mut {
        goes_on
    })
    .expect("it runs");
}

/// A checkpoint with the length of its payload and its checksum put right.
pub fn sealed(bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    // Magic, format, length of the version, version, step before the payload; its length and the checksum behind it.
    let payload_at = 13 + bytes.get(12).map_or(0, |length| usize::from(*length)) + 8;
    if bytes.len() < payload_at + 12 {
        return bytes;
    }
    let length_at = bytes.len() - 12;
    let length = (length_at - payload_at) as u64;
    bytes[length_at..length_at + 8].copy_from_slice(&length.to_le_bytes());
    let end = bytes.len() - 4;
    let sum = crc32fast::hash(&bytes[..end]);
    bytes[end..].copy_from_slice(&sum.to_le_bytes());
    bytes
}

/// A journal with the checksum of every line but the first put right.
pub fn sealed_lines(bytes: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.split_inclusive('\n');
    let mut sealed = lines.next().unwrap_or_default().to_owned();
    for line in lines {
        let content = line.trim_end_matches('\n').rsplit_once(',').map_or(line, |(content, _)| content);
        let checksum = crc32fast::hash(content.as_bytes());
        writeln!(sealed, "{content},{checksum:08x}").expect("a string takes all");
    }
    sealed.into_bytes()
}
