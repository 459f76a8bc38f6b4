//! What advances the clock. Soft spheres today; hard spheres have their place here.

pub mod soft;
