//! The geometry of two overlapping spheres: the lens's disc, its growth, and where it lies.
//!
//! # Equation
//! ```text
//! L_i = (d - (R_j² - R_i²)/d)/2,   A = π (R_i² - L_i²)                                    [A] 68, 69
//! A = (π/4) S² u (2 - u) h(u),     h(u) = (q - u (2 - u))/(1 - u)²,   u = δ/S,   q = 4 R*/S
//! ```
//! The second form follows from the first by Heron's formula and has no cancellation as δ goes to 0. With a factor f_A for
//! flat partners both cases are one:
//! ```text
//! A = (π/4) f_A S² u (2 - u) h(u),   q = 4 R*/(f_A S);   f_A = 1 of two grains, f_A = 4 at a wall, where S = R* = R
//! ```
//! At a wall this is the disc π (R² - (R - δ)²) that the wall cuts out of the grain: that of the grain and its mirror image
//! behind the wall, which are strained by 2δ over 2R.
//!
//! # Source
//! [A] T. I. Zohdi, Comput. Mech. 57, 465 (2016), eqs 64-69.
//!
//! # Symbols
//! | symbol | name in code       | unit | meaning                                             |
//! |--------|--------------------|------|-----------------------------------------------------|
//! | δ      | `overlap`          | m    | R_i + R_j - d, > 0 in contact                       |
//! | S      | `radius_sum`       | m    | R_i + R_j; the grain's radius at a wall             |
//! | f_A    | `flatness`         | -    | 1 between two grains, 4 at a wall                   |
//! | R*     | `effective_radius` | m    | R_i R_j / S; the grain's radius at a wall           |
//! | d      | `distance()`       | m    | distance of the centers                             |
//! | u      | `strain()`         | -    | E of [A] 14, overlap over the sum of the radii    |
//! | A      | `area()`           | m²   | disc in which the spheres cut each other            |
//! | L_i    | `lever_arms()[0]`  | m    | from the center of i to that disc along the normal  |
//!
//! # Valid when
//! |R_i - R_j| < d <= S. One sphere inside the other has no disc: A = 0 there. For very unequal spheres the
//! disc shrinks again once the small one's center has passed it.
//!
//! # Compared with others
//! For δ much smaller than R*, A = 2 π R* δ: twice the area π R* δ of Hertz's contact.
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::contact::ContactGeometry;
//! let geometry = ContactGeometry::new([1.0, 1.0], [1.0, 1.0], [1e7, 1e7], 1.6);
//! assert!((geometry.area() - std::f64::consts::PI * (1.0 - 0.64)).abs() < 1e-14);
//! ```

use std::f64::consts::FRAC_PI_4;

use crate::math::Real;
use crate::math::lanes::Lanes;

/// Terms after which the series of [`ContactGeometry::strain_integral`] is cut.
const LONGEST_SERIES: u32 = 2000;

/// The geometry and inertia of one touching pair, as the laws see it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactGeometry<F = f64> {
    /// δ = R_i + R_j - d [m], > 0; below 0 for a law that acts beyond touching.
    pub overlap: F,
    /// R_i + R_j [m]; at a wall R_i, over which strains are taken there.
    pub radius_sum: F,
    /// Radius of the smaller grain [m]; at a wall that of the grain.
    pub smaller_radius: F,
    /// R* = R_i R_j / (R_i + R_j) [m]; at a wall R_i.
    pub effective_radius: F,
    /// m* = m_i m_j / (m_i + m_j) [kg]; at a wall m_i.
    pub effective_mass: F,
    /// Mean of the two partners' contact stiffness [Pa], softened by heat.
    pub stiffness: F,
    /// 1 between two grains; 4 at a wall, where a grain meets its mirror image and S² is a fourth of theirs.
    pub flatness: F,
}

impl<F: Real> ContactGeometry<F> {
    /// Two grains with radii [m], masses [kg] and contact stiffness [Pa], centers `distance` [m] apart.
    #[inline(always)]
    pub fn new(radii: [F; 2], masses: [F; 2], stiffness: [F; 2], distance: F) -> Self {
        let radius_sum = radii[0] + radii[1];
        Self {
            overlap: radius_sum - distance,
            radius_sum,
            smaller_radius: radii[0].min(radii[1]),
            effective_radius: radii[0] * radii[1] / radius_sum,
            effective_mass: masses[0] * masses[1] / (masses[0] + masses[1]),
            stiffness: F::of(0.5) * (stiffness[0] + stiffness[1]),
            flatness: F::of(1.0),
        }
    }

    /// A grain with radius [m], mass [kg] and contact stiffness [Pa], its and the wall's, whose center is `gap` [m] before a wall: the
    /// limit of a partner whose radius and mass are beyond all bounds, but for strains, which are taken over the grain's radius.
    #[inline(always)]
    pub fn at_wall(radius: F, mass: F, stiffness: [F; 2], gap: F) -> Self {
        Self {
            overlap: radius - gap,
            radius_sum: radius,
            smaller_radius: radius,
            effective_radius: radius,
            effective_mass: mass,
            stiffness: F::of(0.5) * (stiffness[0] + stiffness[1]),
            flatness: F::of(4.0),
        }
    }

    /// d = |r_j - r_i| [m]; at a wall the distance from the center to it.
    #[inline(always)]
    pub fn distance(&self) -> F {
        self.radius_sum - self.overlap
    }

    /// Mass [kg] that resists sliding at the contact of two solid spheres, which may roll: 1/m* + Σ R²/I = 7/(2 m*).
    #[inline(always)]
    pub fn sliding_mass(&self) -> F {
        F::of(2.0 / 7.0) * self.effective_mass
    }

    /// Overlap over the sum of the radii [-] ([A] 14).
    #[inline(always)]
    pub fn strain(&self) -> F {
        self.overlap / self.radius_sum
    }

    /// Area A [m²] of the disc in which the two spheres cut each other ([A] 64-69); 0 where there is none.
    #[inline(always)]
    pub fn area(&self) -> F {
        self.overlap * self.area_over_overlap()
    }

    /// A/δ [m], finite as the overlap goes to 0 (2 π R* there).
    #[inline(always)]
    pub fn area_over_overlap(&self) -> F {
        let strain = self.strain();
        F::of(FRAC_PI_4) * self.flatness * self.radius_sum * (F::of(2.0) - strain) * self.lens(strain)
    }

    /// dA/dδ [m]; negative where the disc shrinks with growing overlap.
    #[inline(always)]
    pub fn area_slope(&self) -> F {
        let (zero, one, two) = (F::of(0.0), F::of(1.0), F::of(2.0));
        let strain = self.strain();
        let lens = self.lens(strain);
        let rest = one - strain;
        let unlike = one - self.likeness();
        let lens_slope = -two * unlike / (rest * rest * rest);
        let growth = two * rest * lens + strain * (two - strain) * lens_slope;
        let slope = F::of(FRAC_PI_4) * self.flatness * self.radius_sum * growth;
        F::select(zero.below(lens), slope, zero)
    }

    /// q: 1 for equal partners.
    #[inline(always)]
    fn likeness(&self) -> F {
        F::of(4.0) * self.effective_radius / (self.flatness * self.radius_sum)
    }

    /// h(u), 0 where one sphere lies inside the other; 1 for equal spheres.
    #[inline(always)]
    fn lens(&self, strain: F) -> F {
        let (zero, one) = (F::of(0.0), F::of(1.0));
        let above = self.likeness() - strain * (F::of(2.0) - strain);
        let lens = above / ((one - strain) * (one - strain));
        F::select(zero.below(above), lens, zero)
    }
}

impl<F: Lanes> ContactGeometry<F> {
    /// That of the contact in a lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> ContactGeometry {
        ContactGeometry {
            overlap: self.overlap.lane(lane),
            radius_sum: self.radius_sum.lane(lane),
            smaller_radius: self.smaller_radius.lane(lane),
            effective_radius: self.effective_radius.lane(lane),
            effective_mass: self.effective_mass.lane(lane),
            stiffness: self.stiffness.lane(lane),
            flatness: self.flatness.lane(lane),
        }
    }
}

impl ContactGeometry {
    /// Integral of E^p A over the overlap from 0 to δ [m³]: energy per stiffness of a strain-power law.
    ///
    /// From the power series u (2 - u) h = 2 q u - (1 + 3 w) u² - w Σ (k + 2) u^(k+1), k >= 2, w = 1 - q,
    /// integrated term by term; good to 1e-12 up to a strain of 0.98, for any power p > -2.
    pub fn strain_integral(&self, exponent: f64) -> f64 {
        let like = self.likeness().min(1.0);
        let unlike = 1.0 - like;
        let strain = self.strain().clamp(0.0, 1.0 - unlike.sqrt());
        let lowest = exponent + 2.0;
        let mut sum = 2.0 * like / lowest - (1.0 + 3.0 * unlike) * strain / (lowest + 1.0);
        let mut power = strain;
        for k in 2..LONGEST_SERIES {
            let k = f64::from(k);
            power *= strain;
            let term = unlike * (k + 2.0) * power / (lowest + k);
            sum -= term;
            if term <= 1e-17 * sum.abs() {
                break;
            }
        }
        FRAC_PI_4 * self.flatness * self.radius_sum.powi(3) * strain.powf(lowest) * sum
    }
}

/// Distances [m] along the line of centers from each of two spheres to the plane of their common disc
/// ([A] 69); their sum is `distance` [m], also for spheres that do not touch.
#[inline]
pub fn lever_arms(radii: [f64; 2], distance: f64) -> [f64; 2] {
    let near = 0.5 * (distance - (radii[1] - radii[0]) * (radii[1] + radii[0]) / distance);
    [near, distance - near]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::contact::check::assert_slope;

    fn geometry(radii: [f64; 2], overlap: f64) -> ContactGeometry {
        ContactGeometry {
            overlap,
            ..ContactGeometry::new(radii, [1.0, 2.0], [1.0, 1.0], radii[0] + radii[1])
        }
    }

    const PAIRS: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, 0.7], [0.02, 0.5], [3e-6, 1e-4]];

    /// The form as printed, where it does not cancel: round-off of squares of the radii.
    #[test]
    fn area_is_that_of_the_paper() {
        for radii in PAIRS {
            let smaller = radii[0].min(radii[1]);
            for part in [0.1, 0.5, 1.0, 1.7] {
                let overlap = part * smaller;
                let d = radii[0] + radii[1] - overlap;
                let near = 0.5 * (d - (radii[1] * radii[1] - radii[0] * radii[0]) / d);
                let literal = PI * (radii[0] * radii[0] - near * near);
                let area = geometry(radii, overlap).area();
                assert!((area - literal).abs() < 1e-14 * radii[1].max(radii[0]).powi(2), "{radii:?} {part}");
                assert_near!(lever_arms(radii, d)[0], near, 1e-14 * radii[1].max(radii[0]));
                assert_close!(geometry([radii[1], radii[0]], overlap).area(), area, 1e-15);
            }
        }
    }

    /// A = 2 π R* δ (1 + O(δ/R*)): the relative error at δ = 1e-14 R* is 1e-14.
    #[test]
    fn area_is_exact_near_touching() {
        for radii in PAIRS {
            let effective = radii[0] * radii[1] / (radii[0] + radii[1]);
            let overlap = 1e-14 * effective;
            let ratio = geometry(radii, overlap).area() / (2.0 * PI * effective * overlap);
            assert!((ratio - 1.0).abs() < 3e-14, "{radii:?}: {ratio}");
            assert_eq!(geometry(radii, 0.0).area(), 0.0);
        }
    }

    #[test]
    fn a_swallowed_sphere_has_no_area() {
        for distance in [0.3, 0.1, 0.0] {
            let inside = ContactGeometry::new([1.0, 0.5], [1.0, 1.0], [1.0, 1.0], distance);
            assert_eq!([inside.area(), inside.area_slope()], [0.0, 0.0]);
            assert_finite!(inside.strain_integral(2.0));
        }
        assert_finite!(ContactGeometry::new([1.0, 1.0], [1.0, 1.0], [1.0, 1.0], 0.0).area());
    }

    #[test]
    fn slope_and_integral_belong_to_the_area() {
        for radii in PAIRS {
            let smaller = radii[0].min(radii[1]);
            for part in [1e-6, 0.01, 0.3, 1.2] {
                let at = part * smaller;
                assert_slope(at, |x| geometry(radii, x).area(), |x| geometry(radii, x).area_slope());
                for power in [0.5, 1.0, 2.0, 3.3] {
                    let integral = |x| geometry(radii, x).strain_integral(power);
                    let integrand = |x| geometry(radii, x).strain().powf(power) * geometry(radii, x).area();
                    assert_slope(at, integral, integrand);
                }
            }
        }
    }

    /// By hand: π (2 R δ - δ²), its slope, and π R³ (2 u^(p+2)/(p+2) - u^(p+3)/(p+3)), to rounding; and as far as R* and δ go that of a
    /// partner a billion times as large, whose disc differs by δ/R of it.
    #[test]
    fn a_wall_cuts_a_disc_out_of_the_grain() {
        let radius = 2e-3;
        let touching = ContactGeometry::at_wall(radius, 1e-5, [1e7, 3e7], radius);
        let at = |overlap: f64| ContactGeometry { overlap, ..touching };
        assert_eq!(ContactGeometry::at_wall(radius, 1e-5, [1e7, 3e7], 0.75 * radius), at(0.25 * radius));
        assert_eq!([at(0.0).stiffness, at(0.0).strain(), at(0.0).area()], [2e7, 0.0, 0.0]);
        for part in [1e-6, 1e-3, 0.1, 0.5, 1.2] {
            let overlap = part * radius;
            assert_close!(at(overlap).area(), PI * overlap * (2.0 * radius - overlap), 1e-14, "in m2");
            assert_close!(at(overlap).strain(), part, 1e-15);
            assert_slope(overlap, |x| at(x).area(), |x| at(x).area_slope());
            for power in [0.5, 2.0] {
                let wanted =
                    2.0 * part.powf(power + 2.0) / (power + 2.0) - part.powf(power + 3.0) / (power + 3.0);
                let found = at(overlap).strain_integral(power);
                // The series is good to 1e-12 up to a strain of 0.98; beyond it ends at the whole grain.
                if part < 0.98 {
                    assert_close!(found, PI * radius.powi(3) * wanted, 1e-12, "in m3");
                }
            }
        }
        let huge = ContactGeometry::new([radius, 1e9 * radius], [1e-5, 1e22], [1e7, 3e7], 0.0);
        assert_close!(huge.effective_radius, at(0.0).effective_radius, 2e-9);
        assert_close!(huge.effective_mass, at(0.0).effective_mass, 2e-9);
    }

    /// Equal spheres, p = 2: (π/4) S³ (u⁴/2 - u⁵/5), by hand.
    #[test]
    fn integral_of_equal_spheres_in_closed_form() {
        let u: f64 = 0.3;
        let by_hand = PI / 4.0 * 8.0 * (u.powi(4) / 2.0 - u.powi(5) / 5.0);
        assert_close!(geometry([1.0, 1.0], 0.6).strain_integral(2.0), by_hand, 1e-14);
    }
}
