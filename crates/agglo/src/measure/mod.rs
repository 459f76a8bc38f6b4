//! Figures taken from a state: moments, clusters, sizes, the ledger. Nothing here changes a state.
