//! Reflection and refraction of a ray at a grain's surface.
//!
//! # Equation
//! $$ \frac{\sin\theta_t}{c_t} = \frac{\sin\theta_i}{c_i}, \qquad
//!    r = \frac{A\cos\theta_i - \cos\theta_t}{A\cos\theta_i + \cos\theta_t}, \qquad
//!    \mathcal R = r^2 $$ ([A] 2-3, 52-62)
//!
//! Beyond the critical angle, sin θ_i ≥ c_i/c_t, all is reflected: R = 1 ([A] 4). The reflected direction is
//! d + 2 cos θ_i n, the refracted one (c_t/c_i) d + ((c_t/c_i) cos θ_i - cos θ_t) n, with n outward.
//!
//! # Source
//! T. I. Zohdi, Comput. Mech. 57, 465 (2016), section 3.1 and Appendix 1.
//!
//! # Symbols
//! | symbol  | name in code      | unit | meaning                                             |
//! |---------|-------------------|------|-----------------------------------------------------|
//! | A       | `impedance_ratio` | 1    | rho_t c_t / (rho_i c_i): grain over medium           |
//! | c_i/c_t | `speed_ratio`     | 1    | speed of sound in the medium over that in the grain |
//! | cos θ_i | `cos_incident`    | 1    | cosine between the ray and the inward normal        |
//! | R       | `reflectance`     | 1    | part of the power that is reflected                 |
//! | d, n    | `direction`, `normal` | 1 | unit vectors: of the ray, and outward of the grain |
//!
//! # Valid when
//! The wavelength is much smaller than the grain (its surface is a plane to the wave) and both media are fluids:
//! shear waves in the grain are left out. Nothing of what enters the grain comes out again.
//!
//! # Compared with others
//! The paper prints ((18 - 1)/(18 + 1))² = 0.944 at normal incidence on ceramic in water ([A] 38); the square
//! is 0.8006, which is what this file returns. So 20 % of the power enters, not 5.6 %.
//! Reflection vanishes at the angle of intromission, sin² θ_i = (A² - 1)/(A² - 1/c²) with c = c_i/c_t, where that
//! lies between 0 and 1.
//!
//! # Example
//! ```
//! use agglo::acoustics::fresnel::Interface;
//! let ceramic_in_water = Interface { impedance_ratio: 18.0, speed_ratio: 1.0 / 3.0 };
//! let by_hand = (17.0_f64 / 19.0).powi(2);
//! assert!((ceramic_in_water.reflectance(1.0) - by_hand).abs() < 1e-15);
//! assert_eq!(ceramic_in_water.reflectance(0.9), 1.0); // 25.8 degrees: beyond the critical 19.5
//! ```

use super::Medium;
use crate::math::Vec3;

/// What a ray meets at a grain's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interface {
    /// A: impedance of the grain over that of the medium [1].
    pub impedance_ratio: f64,
    /// c_i/c_t: speed of sound in the medium over that in the grain [1].
    pub speed_ratio: f64,
}

/// What becomes of a ray at an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattering {
    /// Part of the power that is reflected [1].
    pub reflectance: f64,
    /// Direction of the reflected ray, a unit vector.
    pub reflected: Vec3,
    /// Direction of the refracted ray, a unit vector; zero at total reflection.
    pub refracted: Vec3,
}

impl Interface {
    /// The interface from a medium into a grain of this density [kg/m³] and speed of sound [m/s].
    pub fn new(medium: &Medium, density: f64, sound_speed: f64) -> Self {
        Self {
            impedance_ratio: density * sound_speed / medium.impedance(),
            speed_ratio: medium.sound_speed.si() / sound_speed,
        }
    }

    /// cos θ_t by the law of refraction; none at total reflection.
    #[inline]
    pub fn cos_refracted(&self, cos_incident: f64) -> Option<f64> {
        let sin_incident_squared = (1.0 - cos_incident) * (1.0 + cos_incident);
        let cos_squared = 1.0 - sin_incident_squared / (self.speed_ratio * self.speed_ratio);
        (cos_squared > 0.0).then(|| cos_squared.sqrt())
    }

    /// R: part of the power that is reflected; `cos_incident` from 0 to 1.
    #[inline]
    pub fn reflectance(&self, cos_incident: f64) -> f64 {
        self.cos_refracted(cos_incident).map_or(1.0, |cos| self.partial_reflectance(cos_incident, cos))
    }

    #[inline]
    fn partial_reflectance(&self, cos_incident: f64, cos_refracted: f64) -> f64 {
        let loaded = self.impedance_ratio * cos_incident;
        let amplitude = (loaded - cos_refracted) / (loaded + cos_refracted);
        amplitude * amplitude
    }

    /// Angle [rad] from the normal beyond which all is reflected; none where the grain is the slower medium.
    pub fn critical_angle(&self) -> Option<f64> {
        (self.speed_ratio < 1.0).then(|| self.speed_ratio.asin())
    }

    /// What becomes of a ray along the unit vector `direction` at a surface with the outward unit `normal`.
    #[inline]
    pub fn scatter(&self, direction: Vec3, normal: Vec3) -> Scattering {
        let cos_incident = (-direction.dot(normal)).clamp(0.0, 1.0);
        // Unit length anew at each bounce: curved surfaces amplify what rounding does to it.
        let reflected = (direction + normal * (2.0 * cos_incident)).normalized();
        match self.cos_refracted(cos_incident) {
            None => Scattering { reflectance: 1.0, reflected, refracted: Vec3::ZERO },
            Some(cos) => {
                let bend = 1.0 / self.speed_ratio;
                let refracted = direction * bend + normal * (bend * cos_incident - cos);
                Scattering {
                    reflectance: self.partial_reflectance(cos_incident, cos),
                    reflected,
                    refracted: refracted.normalized(),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CERAMIC: Interface = Interface { impedance_ratio: 18.0, speed_ratio: 1.0 / 3.0 };

    #[test]
    fn normal_incidence_on_ceramic_is_not_the_paper_s_misprint() {
        // (17/19)^2 = 289/361; a few roundings.
        assert!((CERAMIC.reflectance(1.0) - 289.0 / 361.0).abs() < 1e-15);
        assert!((CERAMIC.reflectance(1.0) - 0.800_554).abs() < 1e-6);
        assert!((CERAMIC.reflectance(1.0) - 0.944).abs() > 0.1);
    }

    #[test]
    fn water_and_ceramic_make_the_paper_s_interface() {
        let interface = Interface::new(&Medium::default(), 6000.0, 4500.0);
        assert!((interface.impedance_ratio - 18.0).abs() < 1e-14);
        assert!((interface.speed_ratio - 1.0 / 3.0).abs() < 1e-16);
    }

    #[test]
    fn total_reflection_starts_at_the_critical_angle() {
        let critical = CERAMIC.critical_angle().unwrap();
        // asin(1/3), to the digits of the reference.
        assert!((critical.to_degrees() - 19.471_22).abs() < 1e-5);
        assert!(CERAMIC.reflectance((critical - 1e-6).cos()) < 1.0);
        assert_eq!(CERAMIC.reflectance((critical + 1e-6).cos()), 1.0);
        assert_eq!(CERAMIC.reflectance(0.0), 1.0);
        assert!(Interface { speed_ratio: 1.5, ..CERAMIC }.critical_angle().is_none());
    }

    #[test]
    fn equal_media_reflect_nothing() {
        let same = Interface { impedance_ratio: 1.0, speed_ratio: 1.0 };
        for cos in [1.0, 0.7, 0.1] {
            // cos_t differs from cos_i by rounding only.
            assert!(same.reflectance(cos) < 1e-28);
        }
        let direction = Vec3::new(0.6, 0.0, -0.8);
        assert!((same.scatter(direction, Vec3::AXES[2]).refracted - direction).norm() < 1e-15);
    }

    /// A cos i = cos t with Snell's sin t = sin i / c gives sin² i = (A² - 1)/(A² - 1/c²), c = c_i/c_t.
    #[test]
    fn nothing_is_reflected_at_the_angle_of_intromission() {
        for (a, c) in [(2.0, 3.0), (0.5, 0.6), (1.5, 1.1)] {
            let interface = Interface { impedance_ratio: a, speed_ratio: c };
            let sin_squared: f64 = (a * a - 1.0) / (a * a - 1.0 / (c * c));
            assert!((0.0..1.0).contains(&sin_squared));
            let cos = (1.0 - sin_squared).sqrt();
            assert!(interface.reflectance(cos) < 1e-28);
            // With c_t/c_i in place of c_i/c_t there is no such zero, so the test knows one from the other.
            let swapped = Interface { speed_ratio: 1.0 / c, ..interface };
            assert!(swapped.reflectance(cos) > 1e-3);
        }
    }

    /// R at 10 degrees by hand: cos t = sqrt(1 - 9 sin² 10°) = 0.853591, r = 16.872949/18.580130.
    #[test]
    fn oblique_incidence_by_hand() {
        let angle = 10.0_f64.to_radians();
        let cos_t = (1.0 - 9.0 * angle.sin().powi(2)).sqrt();
        let r = (18.0 * angle.cos() - cos_t) / (18.0 * angle.cos() + cos_t);
        assert!((CERAMIC.reflectance(angle.cos()) - r * r).abs() < 1e-14);
        assert!((CERAMIC.reflectance(angle.cos()) - 0.824_678_15).abs() < 1e-8);
    }

    #[test]
    fn directions_are_unit_vectors_in_one_plane_and_obey_both_laws() {
        let normal = Vec3::new(1.0, 2.0, -0.5).normalized();
        let side = normal.frame().0;
        for degrees in [0.0_f64, 5.0, 12.0, 19.0, 19.5, 60.0, 90.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let out = CERAMIC.scatter(side * sin - normal * cos, normal);
            assert!((out.reflected - (side * sin + normal * cos)).norm() < 1e-15);
            if degrees < 19.4 {
                let expected = side * (3.0 * sin) - normal * (1.0 - 9.0 * sin * sin).sqrt();
                // The root near the critical angle amplifies rounding.
                assert!((out.refracted - expected).norm() < 1e-13);
                assert!((out.refracted.norm() - 1.0).abs() < 1e-15);
            } else {
                assert_eq!(out.refracted, Vec3::ZERO);
                assert_eq!(out.reflectance, 1.0);
            }
        }
    }
}
