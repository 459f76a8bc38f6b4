//! The names of all files and folders of a run, search or study. Nothing else writes one out: a test looks for them.

/// Held by whoever writes.
pub const LOCK: &str = ".agglo.lock";
/// The scenario with every default written out.
pub const SCENARIO: &str = "scenario.toml";
/// The campaign with every default written out.
pub const CAMPAIGN: &str = "search.toml";
/// What a run or campaign came to.
pub const SUMMARY: &str = "summary.json";
/// The page.
pub const REPORT: &str = "report.html";
/// Tables over time.
pub const SERIES: &str = "series";
/// Frames.
pub const FRAMES: &str = "frames";
/// Tables of grains that were placed from.
pub const TABLES: &str = "tables";
/// One of them that has no name of its own; those of a hand-over end with it.
pub const PLACED: &str = "grains.csv";
/// Checkpoints.
pub const CHECKPOINTS: &str = "checkpoints";
/// The run of the best candidate of a campaign.
pub const BEST_RUN: &str = "best";
/// Replicates that ended, while a campaign goes on.
pub const JOURNAL: &str = "replicates.journal";
/// Which part of a study a folder holds, where it holds one.
pub const PART: &str = "part.json";
/// Pictures of a campaign.
pub const PICTURES: &str = "pictures";

/// Bonds that broke or were made; merges and breakages of hard spheres.
pub const EVENTS: &str = "events.csv";
/// The ledger over time.
pub const ENERGY: &str = "series/energy.csv";
/// Momenta over time.
pub const MOMENTUM: &str = "series/momentum.csv";
/// Steps over time.
pub const STEPS: &str = "series/steps.csv";
/// Of soft spheres: clusters over time.
pub const CLUSTERS: &str = "series/clusters.csv";
/// Of soft spheres: places and speeds over time.
pub const MOMENTS: &str = "series/moments.csv";
/// Of soft spheres: rays over time.
pub const RAYS: &str = "series/rays.csv";
/// Of soft spheres: walls over time.
pub const WALLS: &str = "series/walls.csv";
/// Of hard spheres: grains over time.
pub const GRAINS: &str = "series/grains.csv";
/// Of hard spheres: impacts over time.
pub const IMPACTS: &str = "series/impacts.csv";
/// Of hard spheres: classes of sizes over time.
pub const SIZES: &str = "series/sizes.csv";
/// The caller's own measures over time.
pub const OWN: &str = "series/own.csv";
/// Of hard spheres: who became part of whom.
pub const GENEALOGY: &str = "genealogy.csv";
/// Of hard spheres: how often grains collide, merge and break.
pub const KERNELS: &str = "kernels.csv";
/// Of hard spheres: how often grains break.
pub const BREAKAGE: &str = "breakage.csv";
/// Of hard spheres: what they break into.
pub const DAUGHTERS: &str = "daughters.csv";

/// Candidates of a campaign.
pub const EVALUATIONS: &str = "evaluations.csv";
/// Its simulations.
pub const RUNS: &str = "runs.csv";
/// Its generations.
pub const GENERATIONS: &str = "generations.csv";
/// Candidates that could not be run.
pub const FAILURES: &str = "failures.csv";
/// Its best candidates.
pub const BEST: &str = "best.csv";
/// Of a study: means of each candidate.
pub const MEASURES: &str = "measures.csv";
/// Of a study: what refinement says.
pub const REFINEMENT: &str = "refinement.csv";
/// Of a study: how far each level is from the finest.
pub const DIFFERENCES: &str = "differences.csv";
/// Of a study: what moves or scatters the outcome.
pub const SENSITIVITY: &str = "sensitivity.csv";

/// Beside a scenario that a run was handed over to, after the scenario's name: its agglomerates.
pub const HANDED_CLUSTERS: &str = "clusters.csv";
/// What was kept of the run and what was not, likewise.
pub const HANDED_RECORD: &str = "hand-over.json";

/// The name of a table over time.
pub fn series(table: &str) -> String {
    format!("{SERIES}/{table}{TABLE_ENDING}")
}

/// The name of the table over time in this place, if it is one.
pub fn of_series(place: &str) -> Option<&str> {
    place.strip_prefix(SERIES)?.strip_prefix('/')?.strip_suffix(TABLE_ENDING)
}

/// The name of a frame of a kind: grains, bonds, rays, walls.
pub fn frame(kind: &str, number: usize) -> String {
    format!("{kind}_{number:06}{FRAME_ENDING}")
}

/// The name of the list of frames of a kind.
pub fn frame_list(kind: &str) -> String {
    format!("{kind}.pvd")
}

/// The name of a checkpoint.
pub fn checkpoint(step: u64) -> String {
    format!("{CHECKPOINT_BEGIN}{step:012}{CHECKPOINT_ENDING}")
}

/// The name of a picture of a campaign.
pub fn picture(what: &str) -> String {
    format!("{what}.svg")
}

/// How names of tables end.
pub const TABLE_ENDING: &str = ".csv";
/// How names of frames end.
pub const FRAME_ENDING: &str = ".vtp";
/// How names of checkpoints begin.
pub const CHECKPOINT_BEGIN: &str = "checkpoint-";
/// How names of checkpoints end.
pub const CHECKPOINT_ENDING: &str = ".agglo";
