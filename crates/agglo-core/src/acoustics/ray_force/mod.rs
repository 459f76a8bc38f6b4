//! How a ray pushes the grain that it hits, at the point of impact.

mod impulse;
mod law;
mod published_step;
mod radiation_pressure;

pub use law::{Impedance, RayLaw};

use super::{Hit, Medium};
use crate::math::Vec3;

family! {
    /// The closed set of ray-force laws.
    pub enum RayForce at "acoustics.force", pages in "acoustics/ray_force", each by each_ray_force ($) {
        Impulse in impulse: "[A] 7 for the duration of the pulse: the impulse of a hit does not depend on the step.";
        PublishedStep in published_step: "[A] 7 for the one step in which the ray lands; does not converge.";
        RadiationPressure in radiation_pressure: "Momentum balance of the ray, for the duration of the pulse.";
    }
}

impl RayForce {
    /// Force [N] on the grain that is hit, whose `impedance` it is.
    pub fn force(&self, hit: &Hit, impedance: Impedance, medium: &Medium) -> Vec3 {
        each_ray_force!(self, law => law.force(hit, impedance, medium))
    }

    /// How long a hit presses [s]; `radius` [m] is the mean radius of the grains.
    pub fn duration(&self, radius: f64, medium: &Medium) -> f64 {
        each_ray_force!(self, law => law.duration(radius, medium))
    }

    /// Whether a hit is an impulse, whatever the step; otherwise a force for one step.
    pub fn is_impulse(&self) -> bool {
        each_ray_force!(self, law => law.is_impulse())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::acoustics::fresnel::Interface;
    use crate::units::Quantity;

    const CERAMIC: Impedance = Impedance { sound: 6000.0 * 4500.0, shear: 6000.0 * 2700.0 };

    fn hit(cos: f64) -> Hit {
        hit_on(cos, 0.0)
    }

    /// A hit on ceramic in water whose shear waves have this speed [m/s].
    fn hit_on(cos: f64, shear_speed: f64) -> Hit {
        let direction_in = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, -cos);
        let interface = Interface::new(&Medium::default(), 6000.0, 4500.0, shear_speed);
        let out = interface.scatter(direction_in, Vec3::AXES[2]);
        Hit {
            sheared: out.sheared,
            refracted_shear: out.refracted_shear,
            normal: Vec3::AXES[2],
            direction_in,
            direction_out: out.reflected,
            refracted: out.refracted,
            reflectance: out.reflectance,
            power_in: 4.7e6,
            ray_area: 3.1e-4,
            ..Hit::default()
        }
    }

    fn impulse() -> RayForce {
        RayForce::Impulse(Impulse { duration: Quantity(2e-6) })
    }

    /// 4.7e6 W · 72/361 · 2.7e7 Pa s/m · 3.1e-4 m² = 7.846e9 N² at normal incidence.
    #[test]
    fn published_force_by_hand() {
        let force = impulse().force(&hit(1.0), CERAMIC, &Medium::default());
        let by_hand = (4.7e6 * 72.0 / 361.0 * 2.7e7 * 3.1e-4_f64).sqrt();
        assert_close!(force.z, -by_hand, 1e-14, "in N");
        assert_eq!(force.x, 0.0);
        let step = RayForce::PublishedStep(PublishedStep { step_fraction: 0.1 });
        assert_eq!(step.force(&hit(1.0), CERAMIC, &Medium::default()), force);
    }

    #[test]
    fn power_equals_force_times_wave_velocity() {
        let hit = hit(0.97);
        let force = impulse().force(&hit, CERAMIC, &Medium::default()).norm();
        let power = force * force / (CERAMIC.sound * hit.ray_area);
        assert_close!(power, hit.power_in * (1.0 - hit.reflectance), 1e-14, "in W");
        // Along the refracted ray: Snell's sine, three times that of the ray that comes.
        let sine = impulse().force(&hit, CERAMIC, &Medium::default()).x / force;
        assert_close!(sine, 3.0 * hit.direction_in.x, 1e-14);
    }

    #[test]
    fn total_reflection_gives_no_published_force_but_radiation_pressure() {
        let hit = hit(0.5);
        assert_eq!(impulse().force(&hit, CERAMIC, &Medium::default()), Vec3::ZERO);
        let law = RayForce::RadiationPressure(RadiationPressure { duration: Quantity(2e-6) });
        let force = law.force(&hit, CERAMIC, &Medium::default());
        // A mirror: 2 I cos/c along the inward normal.
        let expected = Vec3::new(0.0, 0.0, -2.0 * 0.5 * 4.7e6 / 1500.0);
        assert_close_vector!(force, expected, 1e-12, "in N");
    }

    /// Sound and shear each carry F²/(impedance a_r), together the power that enters; at 15 degrees both enter, at 25 degrees
    /// only shear does (19.5 and 33.7 degrees are critical), along its own direction, sin 25° · 2700/1500.
    #[test]
    fn a_solid_is_pushed_by_both_waves() {
        for degrees in [15.0_f64, 25.0] {
            let hit = hit_on(degrees.to_radians().cos(), 2700.0);
            let force = impulse().force(&hit, CERAMIC, &Medium::default());
            let power = hit.power_in
                * [1.0 - hit.reflectance - hit.sheared, hit.sheared][usize::from(degrees > 19.5)];
            let wave = [hit.refracted, hit.refracted_shear][usize::from(degrees > 19.5)];
            let (own, other) = ([CERAMIC.sound, CERAMIC.shear], [hit.refracted_shear, Vec3::ZERO]);
            let part = wave * (power * own[usize::from(degrees > 19.5)] * hit.ray_area).sqrt();
            let rest = force - part;
            if degrees < 19.5 {
                let shear = rest.norm_squared() / (CERAMIC.shear * hit.ray_area) / hit.power_in;
                assert_near!(shear, hit.sheared, 1e-12);
                assert_above!(hit.sheared, 0.01);
                assert_near_vector!(rest.normalized(), other[0], 1e-12);
            } else {
                assert_below!(rest.norm(), 1e-12 * force.norm());
                assert_above!(hit.sheared, 0.1);
                let sine = force.x / force.norm();
                assert_close!(sine, degrees.to_radians().sin() * 1.8, 1e-13);
            }
        }
    }

    /// F_rad/F = v_t (1 + R)/(c_i (1 - R)) at normal incidence, as the page of `radiation_pressure` says.
    #[test]
    fn the_two_laws_differ_by_the_wave_s_velocity() {
        let (hit, medium) = (hit(1.0), Medium::default());
        let published = impulse().force(&hit, CERAMIC, &medium).norm();
        let law = RayForce::RadiationPressure(RadiationPressure { duration: Quantity(1.0) });
        let wave = published / (CERAMIC.sound * hit.ray_area);
        let factor = wave * (1.0 + hit.reflectance) / (1500.0 * (1.0 - hit.reflectance));
        assert_close!(law.force(&hit, CERAMIC, &medium).norm() / published, factor, 1e-13);
    }

    #[test]
    fn durations() {
        let medium = Medium::default();
        assert_eq!(impulse().duration(0.05, &medium), 2e-6);
        let step = RayForce::PublishedStep(PublishedStep { step_fraction: 0.1 });
        assert_close!(step.duration(0.05, &medium), 0.1 * 0.05 / 1500.0, 1e-15, "in s");
    }
}
