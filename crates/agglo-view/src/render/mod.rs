//! Pictures and movies of runs: a ray tracer for spheres, without a screen.
//!
//! Grains are shown as they are: true sizes and places, in perspective, from one place for all frames. Light from the whole sky
//! and from a sun over the photographer's left shoulder shows which grains lie deep inside and which touch. Nothing is
//! drawn at random, so pictures have no noise, and the same frame gives the same bits for any number of threads.
//!
//! What this does not do: it reads what a run has written and computes nothing of the run itself.

mod animation;
mod bvh;
mod camera;
mod error;
mod frame_sequence;
mod image;
mod light;
mod output;
mod overlay;
mod renderer;
mod scene;
mod sheet;
mod solid;
mod survey;
mod text;

pub use animation::{Animation, AnimationEnding, AnimationProgress, Shots, animate};
pub use camera::{Camera, Side};
pub use error::RenderError;
pub use frame_sequence::FrameSequence;
pub use image::Image;
pub use output::{Output, clear_at_exit};
pub use renderer::{Options, Renderer, View};
pub use scene::{Background, Ground, Scene};
pub use solid::{Light, Line, Sphere};
