//! What memory and disk there are, and whether a run fits into them.
//!
//! A tried allocation proves nothing: Linux promises memory that it does not have, and kills whoever then uses it. So what a
//! run will ask for is reckoned before anything is placed, and held to what is there.

use std::path::Path;

use super::counts;
use crate::engine::hard::Driver;
use crate::engine::soft::Scheme;
use crate::packing::StartError;
use crate::record::door;
use crate::scenario::{Engine, Scenario};
use crate::text::{digits, readable, two_digits};

/// A pulse that is due, and its books once it has flown.
const BYTES_PER_PULSE: f64 = 160.0;
/// The least that a frame and a row take, and a grain in a frame.
const LEAST_PER_FRAME: f64 = 1000.0;
const LEAST_PER_GRAIN: f64 = 60.0;
const LEAST_PER_ROW: f64 = 300.0;
/// A part of what is there from which on it is worth a note.
const MUCH: f64 = 0.25;

/// Memory and disk that are there [B]; none where the system does not say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Room {
    /// Memory that is free, or that could be made free; no more than the limit of the group of processes leaves.
    pub memory: Option<f64>,
    /// Disk that is free where results go.
    pub disk: Option<f64>,
}

impl Room {
    /// What is there now, with `folder` the place of the results; it need not be there yet.
    pub fn at(folder: &Path) -> Self {
        Self { memory: memory(), disk: disk(folder) }
    }
}

/// What a run takes at least [B], told from its scenario alone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Demand {
    grains: f64,
    rays: f64,
    pulses: f64,
    frames: f64,
    rows: f64,
    is_hard: bool,
}

impl Demand {
    /// What a scenario takes; `base` is the folder that its tables are relative to.
    pub fn of(scenario: &Scenario, base: &Path) -> Self {
        let groups = scenario.grains.iter();
        let end = scenario.time.end.si();
        let beams = || scenario.acoustics().into_iter().flat_map(|acoustics| &acoustics.beams);
        let output = scenario.resolved().output;
        let pulses = beams().map(|beam| f64::from(counts::pulses_before(beam, end))).sum();
        // What falls due within one step is written once; a launch may cut a step in two.
        let most = most_steps(scenario) + pulses + 1.0;
        let due = |interval: Option<crate::units::Time>| {
            interval.map_or(0.0, |interval| (end / interval.si()).min(most))
        };
        Self {
            grains: groups.map(|group| counts::expected(group, scenario.volume(), base)).sum::<f64>()
                + counts::of_earlier_run(scenario, base),
            rays: beams().map(|beam| f64::from(beam.rays)).sum(),
            pulses,
            frames: due(output.frames),
            rows: due(output.series),
            is_hard: scenario.is_hard(),
        }
    }

    /// Memory [B].
    pub fn memory(&self) -> f64 {
        counts::of_state(self.grains, self.rays, self.is_hard) + self.pulses * BYTES_PER_PULSE
    }

    /// Disk for rows and frames [B].
    pub fn disk(&self) -> f64 {
        self.frames * (LEAST_PER_FRAME + LEAST_PER_GRAIN * self.grains) + self.rows * LEAST_PER_ROW
    }

    /// Refuses `runs` of this at a time where they need more memory than there is.
    ///
    /// # Errors
    /// [`StartError::NoRoom`].
    pub fn refuse_memory(&self, room: &Room, runs: usize) -> Result<(), StartError> {
        let needed = self.memory() * runs as f64;
        let rays = format!(", {} rays, {} pulses", digits(self.rays), digits(self.pulses));
        let times = format!(", {runs} times at once");
        let who = [
            format!("{} grains", digits(self.grains)),
            if self.rays > 0.0 { rays } else { String::new() },
            if runs > 1 { times } else { String::new() },
        ]
        .concat();
        refuse("memory", needed, room.memory, who, "take fewer grains, rays, pulses or threads")
    }

    /// Refuses rows and frames that the disk cannot hold.
    ///
    /// # Errors
    /// [`StartError::NoRoom`].
    pub fn refuse_disk(&self, room: &Room) -> Result<(), StartError> {
        let who = format!("{} rows and {} frames", digits(self.rows), digits(self.frames));
        refuse("disk", self.disk(), room.disk, who, LONGER)
    }
}

/// The steps of a run where they are known to be no shorter than the scenario says; without end where they are not.
fn most_steps(scenario: &Scenario) -> f64 {
    let shortest = match &scenario.engine {
        Engine::Soft(soft) => match &soft.scheme {
            Scheme::Verlet(verlet) => verlet.step,
            Scheme::Staggered(_) => None,
        },
        Engine::Hard(hard) => match &hard.driver {
            Driver::TimeStepped(stepped) => Some(stepped.shortest_step),
            Driver::EventDriven(_) => None,
        },
    };
    shortest.map_or(f64::INFINITY, |step| scenario.time.end.si() / step.si())
}

const LONGER: &str = "make the intervals in [output] longer";

/// Refuses what is more than is there [B]; what is not known is not refused, what is no number is.
fn refuse(
    what: &'static str,
    needed: f64,
    there: Option<f64>,
    who: String,
    help: &'static str,
) -> Result<(), StartError> {
    match there {
        Some(there) if needed.is_nan() || needed > there => {
            Err(StartError::NoRoom { what, needed, there, who, help })
        }
        _ => Ok(()),
    }
}

/// Refuses a run into a folder that the machine cannot hold.
///
/// # Errors
/// [`StartError::NoRoom`].
pub fn refuse_run(scenario: &Scenario, base: &Path, folder: &Path) -> Result<(), StartError> {
    let (demand, room) = (Demand::of(scenario, base), Room::at(folder));
    demand.refuse_memory(&room, 1)?;
    demand.refuse_disk(&room)
}

/// Refuses so many simulations at a time, without folders, that the memory cannot hold.
///
/// # Errors
/// [`StartError::NoRoom`].
pub fn refuse_quiet(scenario: &Scenario, base: &Path, runs: usize) -> Result<(), StartError> {
    Demand::of(scenario, base).refuse_memory(&Room { memory: memory(), disk: None }, runs)
}

/// What to keep in mind of sizes [B] that a plan foresees, and a refusal of what does not fit.
///
/// # Errors
/// [`StartError::NoRoom`].
pub fn judge(room: &Room, memory: f64, disk: Option<f64>) -> Result<Vec<String>, StartError> {
    let mut notes = Vec::new();
    let of_memory = ("memory", Some(memory), room.memory, "take fewer grains, rays or pulses");
    let of_disk = ("disk", disk, room.disk, LONGER);
    for (what, needed, there, help) in [of_memory, of_disk] {
        let Some(needed) = needed else { continue };
        refuse(what, needed, there, "the whole run".to_owned(), help)?;
        if there.is_some_and(|there| needed > MUCH * there) {
            let [needed, there] =
                [needed, there.unwrap_or(0.0)].map(|bytes| readable(two_digits(bytes), "B"));
            notes.push(format!(
                "{what}: about {needed} of the {there} that are there; {help} if that is too much"
            ));
        }
    }
    Ok(notes)
}

/// Memory that is there [B].
fn memory() -> Option<f64> {
    let of_system = door::read_small(Path::new("/proc/meminfo")).and_then(|text| available(&text));
    let of_groups = door::read_small(Path::new("/proc/self/cgroup")).map(|text| left_by_groups(&text));
    [of_system, of_groups.flatten()].into_iter().flatten().reduce(f64::min)
}

/// `MemAvailable` of `/proc/meminfo` [B].
fn available(text: &str) -> Option<f64> {
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kilobytes: f64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(1024.0 * kilobytes)
}

/// What the limits of the groups of this process leave [B], version 2 or 1, of the group itself and all above it.
fn left_by_groups(text: &str) -> Option<f64> {
    let mut least: Option<f64> = None;
    for line in text.lines() {
        let mut parts = line.splitn(3, ':').skip(1);
        let (Some(controllers), Some(path)) = (parts.next(), parts.next()) else { continue };
        let (root, names) = match controllers {
            "" => ("/sys/fs/cgroup", ["memory.max", "memory.current", "inactive_file"]),
            list if list.split(',').any(|name| name == "memory") => (
                "/sys/fs/cgroup/memory",
                ["memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"],
            ),
            _ => continue,
        };
        // In a container the group's own path may not be there, and its limit stands at the root.
        let own = Path::new(path.trim_start_matches('/'));
        for part in own.ancestors() {
            if let Some(left) = left_by(&Path::new(root).join(part), names) {
                least = Some(least.map_or(left, |least| least.min(left)));
            }
        }
    }
    least
}

/// What one group's limit leaves [B]: files that are only remembered can go.
fn left_by(group: &Path, [limit, usage, remembered]: [&str; 3]) -> Option<f64> {
    let number = |name: &str| door::read_small(&group.join(name))?.trim().parse::<f64>().ok();
    let (limit, usage) = (number(limit)?, number(usage)?);
    let stat = door::read_small(&group.join("memory.stat")).unwrap_or_default();
    let of_line =
        |line: &str| line.split_once(' ').filter(|(name, _)| *name == remembered)?.1.trim().parse().ok();
    let remembered: f64 = stat.lines().find_map(of_line).unwrap_or(0.0);
    Some((limit - usage + remembered).max(0.0))
}

/// Disk that is free [B] at a place, or at the nearest folder above it that is there.
#[cfg(unix)]
fn disk(place: &Path) -> Option<f64> {
    let whole = std::path::absolute(place).ok()?;
    let found = whole.ancestors().find_map(|folder| rustix::fs::statvfs(folder).ok())?;
    Some(found.f_bavail as f64 * found.f_frsize as f64)
}

#[cfg(not(unix))]
fn disk(_: &Path) -> Option<f64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::template;

    fn demand(name: &str, settings: &[&str]) -> Demand {
        let scenario = Scenario::with_overrides(template(name).unwrap().text, settings).unwrap();
        Demand::of(&scenario, Path::new(""))
    }

    const ROOM: Room = Room { memory: Some(16e9), disk: Some(100e9) };

    #[test]
    fn what_the_machine_cannot_hold_is_refused_with_numbers() {
        let shipped = demand("acoustic-published", &[]);
        assert_ok!(shipped.refuse_memory(&ROOM, 64));
        assert_ok!(shipped.refuse_disk(&ROOM));
        let rays = demand("acoustic-published", &["acoustics.beams.0.rays=1000000000"]);
        let words = rays.refuse_memory(&ROOM, 1).unwrap_err().to_string();
        assert!(words.contains("about 120 GB of memory") && words.contains("16 GB"), "{words}");
        let pulses = ["acoustics.beams.0.pulses.count=2147483648", "acoustics.beams.0.pulses.period=1e-15 s"];
        assert_err!(demand("acoustic-published", &pulses).refuse_memory(&ROOM, 1));
        // Those after the end of the run do not count.
        assert_ok!(demand("acoustic-published", &pulses[..1]).refuse_memory(&ROOM, 1));
        let frames = demand("reacting", &["output.frames=1e-12 s"]);
        let words = frames.refuse_disk(&ROOM).unwrap_err().to_string();
        assert!(
            words.contains("of disk") && words.contains("make the intervals in [output] longer"),
            "{words}"
        );
    }

    /// A frame every picosecond, with steps of a microsecond: no more frames than steps.
    #[test]
    fn what_is_due_within_a_step_counts_once() {
        let often = ["output.frames=1 ps", "output.series=1 ps", "time.end=10 ms"];
        let known = demand("microscale", &[&often[..], &["engine.verlet={step=\"1 us\"}"]].concat());
        assert!((10_000.0..10_100.0).contains(&known.frames) && known.rows == known.frames, "{known:?}");
        assert_ok!(known.refuse_disk(&ROOM));
        // How long its steps are is found out on the way.
        let automatic = demand("microscale", &often);
        assert_eq!(automatic.frames, 1e10);
        assert_err!(automatic.refuse_disk(&ROOM));
        let rare = demand("microscale", &["engine.verlet={step=\"1 us\"}", "output.frames=1 us"]);
        assert!((299.9..300.1).contains(&rare.frames), "{rare:?}");
    }

    /// A cubic lattice of 1 um in a box of 1e6 m: 1e36 grains.
    #[test]
    fn counting_does_not_overflow() {
        let text = template("reacting").unwrap().text.to_owned();
        let mut scenario = Scenario::from_toml(&text).unwrap();
        scenario.grains[0].placement = crate::packing::Placement::Lattice(crate::packing::Lattice {
            region: crate::domain::Region::Box(crate::domain::Block {
                lower: [0.0; 3].map(crate::units::Quantity),
                upper: [1e6; 3].map(crate::units::Quantity),
            }),
            spacing: crate::units::Quantity(1e-6),
            kind: crate::packing::LatticeKind::Cubic,
            count: None,
        });
        scenario.grains[0].size = crate::packing::Size::Constant(crate::packing::ConstantSize {
            radius: crate::units::Quantity(1e-7),
        });
        let words = Demand::of(&scenario, Path::new("")).refuse_memory(&ROOM, 1).unwrap_err().to_string();
        assert!(words.contains("1e36 grains"), "{words}");
        let found = super::super::Plan::new(&scenario, Path::new(""));
        assert!(matches!(found, Err(StartError::NoRoom { .. })), "{found:?}");
        let (_place, stop) = (Path::new(""), std::sync::atomic::AtomicBool::new(false));
        let found = crate::run::quiet(&scenario, Path::new(""), &stop);
        assert_matches!(found, Err(crate::run::RunError::Placement(StartError::NoRoom { .. })));
    }

    #[test]
    fn a_plan_that_takes_much_has_a_note() {
        assert_eq!(judge(&ROOM, 1e9, Some(1e9)).unwrap(), Vec::<String>::new());
        let notes = judge(&ROOM, 8e9, Some(50e9)).unwrap();
        assert!(notes[0].contains("memory: about 8 GB of the 16 GB that are there"), "{notes:?}");
        assert!(notes[1].contains("disk: about 50 GB of the 100 GB that are there"), "{notes:?}");
        assert_err!(judge(&ROOM, 17e9, None));
        assert_err!(judge(&ROOM, 1e9, Some(f64::INFINITY)));
        assert_eq!(judge(&Room::default(), 1e30, Some(1e30)).unwrap(), Vec::<String>::new());
    }

    #[test]
    fn what_the_system_says_is_read() {
        assert_eq!(available("MemTotal: 9 kB\nMemAvailable:     2048 kB\n"), Some(2_097_152.0));
        let group = tempfile::tempdir().unwrap();
        let names = ["memory.max", "memory.current", "inactive_file"];
        assert_eq!(left_by(group.path(), names), None);
        std::fs::write(group.path().join("memory.max"), "1000\n").unwrap();
        std::fs::write(group.path().join("memory.current"), "700\n").unwrap();
        std::fs::write(group.path().join("memory.stat"), "anon 1\ninactive_file 100\n").unwrap();
        assert_eq!(left_by(group.path(), names), Some(400.0));
        std::fs::write(group.path().join("memory.max"), "max\n").unwrap();
        assert_eq!(left_by(group.path(), names), None);
        if cfg!(target_os = "linux") {
            let room = Room::at(Path::new("/nowhere/at/all"));
            assert!(room.memory.is_some_and(|bytes| bytes > 1e6) && room.disk.is_some(), "{room:?}");
        }
    }
}
