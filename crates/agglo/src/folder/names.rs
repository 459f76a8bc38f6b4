//! The names of files and folders.

/// Held by whoever writes.
pub const LOCK: &str = ".agglo.lock";
/// The scenario with every default written out.
pub const SCENARIO: &str = "scenario.toml";
/// The campaign with every default written out.
pub const CAMPAIGN: &str = "search.toml";
/// What a run or campaign came to.
pub const SUMMARY: &str = "summary.json";
/// The page.
#[cfg(feature = "report")]
pub const REPORT: &str = "report.html";
/// Tables over time.
pub const SERIES: &str = "series";
/// Frames.
pub const FRAMES: &str = "frames";
/// Tables of grains that were placed from.
pub const TABLES: &str = "tables";
/// Checkpoints.
pub const CHECKPOINTS: &str = "checkpoints";
/// The run of the best candidate of a campaign.
pub const BEST: &str = "best";
/// Starts that ended, while a campaign goes on.
pub const JOURNAL: &str = "replicates.journal";
/// Pictures of a campaign.
pub const PICTURES: &str = "pictures";
