//! A uniform grid over spheres that rays walk through (3-D DDA).
