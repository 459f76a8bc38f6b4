//! Constants of nature, CODATA 2022 (exact where the SI defines them).

/// Molar gas constant [J/(mol K)].
pub const GAS_CONSTANT: f64 = 8.314_462_618;
/// Boltzmann constant [J/K].
pub const BOLTZMANN: f64 = 1.380_649e-23;
/// Stefan-Boltzmann constant [W/(m² K⁴)].
pub const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;
/// Newtonian constant of gravitation [m³/(kg s²)].
pub const GRAVITATIONAL: f64 = 6.674_30e-11;
/// Vacuum electric permittivity [F/m].
pub const VACUUM_PERMITTIVITY: f64 = 8.854_187_818_8e-12;
/// Elementary charge [C].
pub const ELEMENTARY_CHARGE: f64 = 1.602_176_634e-19;
