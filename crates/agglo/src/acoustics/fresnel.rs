//! Angles, reflection and refraction at a grain.
