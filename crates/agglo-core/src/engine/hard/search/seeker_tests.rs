use super::*;

fn collide(distance: [f64; 3], velocity: [f64; 3], reach: f64) -> f64 {
    time_to_collision(distance.into(), velocity.into(), reach, f64::INFINITY)
}

#[test]
fn closed_forms() {
    // 4 m to go at 2 m/s.
    assert_eq!(collide([5.0, 0.0, 0.0], [-2.0, 0.0, 0.0], 1.0), 2.0);
    // 0.6 of the reach off the line: they touch 0.8 of it before the nearest point. One rounding each of four.
    assert_close!(collide([10.0, 0.6, 0.0], [-1.0, 0.0, 0.0], 1.0), 9.2, 1e-15);
    assert_close!(collide([0.0, 3.0, -50.0], [0.0, 0.0, 10.0], 5.0), 4.6, 1e-15);
    // Along a diagonal: (3, 4, 12) is 13 long, 8 to go at 2.
    let along = [-6.0 / 13.0, -8.0 / 13.0, -24.0 / 13.0];
    assert_close!(collide([3.0, 4.0, 12.0], along, 5.0), 4.0, 1e-15);
}

#[test]
fn grazing() {
    // Off the line by the reach: they touch with no approach.
    assert_eq!(collide([10.0, 1.0, 0.0], [-1.0, 0.0, 0.0], 1.0), f64::INFINITY);
    assert_eq!(collide([10.0, 1.0 + 1e-12, 0.0], [-1.0, 0.0, 0.0], 1.0), f64::INFINITY);
    for short in [1e-3, 1e-6, 1e-9_f64] {
        let offset = 1.0 - short;
        let wanted = 10.0 - (short * (2.0 - short)).sqrt();
        // 1 - offset² has lost 1e-16/short of itself, which half counts under the root.
        let found = collide([10.0, offset, 0.0], [-1.0, 0.0, 0.0], 1.0);
        assert!((found - wanted).abs() < 1e-14 + 100.0 * 1e-16 / short.sqrt(), "{found} {wanted}");
    }
}

#[test]
fn touching_overlapping_and_at_rest() {
    for distance in [[2.0, 0.0, 0.0], [1.5, 0.1, -0.3], [1e-9, 0.0, 0.0]] {
        let toward = distance.map(|along: f64| -3.0 * along);
        assert_eq!(collide(distance, toward, 2.0), 0.0);
        assert_eq!(collide(distance, distance, 2.0), f64::INFINITY, "they part");
        assert_eq!(collide(distance, [0.0; 3], 2.0), f64::INFINITY, "at rest");
    }
    assert_eq!(collide([2.0, 0.0, 0.0], [0.0, 1.0, 0.0], 2.0), f64::INFINITY, "one slides along the other");
    assert_eq!(collide([0.0; 3], [1.0, 2.0, 3.0], 2.0), f64::INFINITY, "one in the other has no direction");
    assert_eq!(collide([9.0, 0.0, 0.0], [0.0; 3], 2.0), f64::INFINITY);
    assert_eq!(collide([9.0, 0.0, 0.0], [1.0, 0.0, 0.0], 2.0), f64::INFINITY);
}

/// A gap of 2^-40 at a distance of 1 still has all the digits that its squares leave, and swapping the partners turns no
/// bit.
#[test]
fn small_gaps_do_not_cancel() {
    let gap = 2_f64.powi(-40);
    // 1 + 2 gap + gap² is rounded at 1e-16: 1e-4 of the gap's 1e-12; the root adds no more.
    assert_close!(collide([1.0 + gap, 0.0, 0.0], [-1.0, 0.0, 0.0], 1.0), gap, 1e-4);
    let (distance, velocity) = (Vec3::new(0.3, -1.7, 2.9), Vec3::new(-0.31, 1.5, -2.2));
    let forth = time_to_collision(distance, velocity, 0.7, f64::INFINITY);
    assert_finite!(forth);
    assert_eq!(forth.to_bits(), time_to_collision(-distance, -velocity, 0.7, f64::INFINITY).to_bits());
    // Lengths and times in other units: powers of two round nothing.
    assert_eq!(
        time_to_collision(distance * 0.25, velocity * 0.25, 0.175, f64::INFINITY).to_bits(),
        forth.to_bits()
    );
    assert_eq!(time_to_collision(distance, velocity * 0.25, 0.7, f64::INFINITY), 4.0 * forth);
}

/// Ways up to 1e12 times the radii, head-on and past the middle by 0.6 of the reach, along an axis and across it.
#[test]
fn small_spheres_far_apart() {
    for way in [1e3, 1e6, 1e9, 1e12] {
        let head_on = collide([way, 0.0, 0.0], [-2.0, 0.0, 0.0], 1.0);
        assert!((head_on - 0.5 * (way - 1.0)).abs() <= 4e-16 * way, "{head_on}");
        let aside = collide([way, 0.6, 0.0], [-2.0, 0.0, 0.0], 1.0);
        assert!((aside - 0.5 * (way - 0.8)).abs() <= 4e-16 * way, "{aside}");
        assert_eq!(collide([way, 1.001, 0.0], [-2.0, 0.0, 0.0], 1.0), f64::INFINITY);
        // Along (3, 4, 12)/13: the point is rounded to 2e-16 of the way, and so is how far they pass one another.
        let (along, at) = ([-6.0 / 13.0, -8.0 / 13.0, -24.0 / 13.0], way / 13.0);
        let slanted = collide([3.0 * at, 4.0 * at, 12.0 * at], along, 1.0);
        assert!((slanted - 0.5 * (way - 1.0)).abs() <= 1e-15 * way + (1e-15 * way).powi(2), "{slanted}");
    }
}

#[test]
fn what_is_rounding() {
    let x = Vec3::AXES[0];
    let speeds = [x * 1e3, x * 1e3];
    assert_true!(is_rounding(x, x * -1e-13, speeds), "such an overlap is only round-off");
    assert_false!(is_rounding(x, x * -1e-11, speeds), "such an overlap is only round-off");
    assert_false!(is_rounding(x, x * -1e-13, [x * 1e-13, Vec3::ZERO]), "such an overlap is only round-off");
    // Speeds alone decide: grains of micrometers as of kilometers.
    for size in [1e-6, 1e3] {
        assert_true!(
            is_rounding(x * size, x * -1e-13, speeds),
            "such an overlap is only round-off, {size} m"
        );
        assert_false!(
            is_rounding(x * size, x * -1e-11, speeds),
            "such an overlap is only round-off, {size} m"
        );
    }
}
