//! What a run writes: tables, frames, checkpoints, summaries. Recorders see and never change.
