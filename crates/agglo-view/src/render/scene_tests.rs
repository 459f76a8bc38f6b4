//! Pictures against closed forms.

use super::*;
use crate::render::camera::Side;

const SIZE: [u32; 2] = [240, 240];

fn sphere(center: [f64; 3], radius: f64, color: Light) -> Sphere {
    Sphere { center: center.into(), radius, color }
}

fn scene(spheres: Vec<Sphere>) -> Scene {
    Scene { spheres, background: Background::Transparent, ..Scene::default() }
}

fn camera() -> Camera {
    Camera::new(Vec3::ZERO, 10.0, Side { azimuth: 0.0, elevation: 0.0 }, SIZE)
}

/// Area that is covered, in pixels.
fn covered(image: &Image) -> f64 {
    image.pixels().iter().map(|pixel| f64::from(pixel[3]) / 255.0).sum()
}

/// A sphere on the optical axis is a disc. Its outline is where rays touch the sphere: on the plane at distance one its
/// radius is r/√(d² - r²).
///
/// Eight rays a pixel miss the part of a pixel that is covered by 0.1 or so, either way; the outline crosses 2 pi R
/// pixels, so that about 0.1 √(2 pi R) of the area is in error: 2.5 of 25,000 pixels.
#[test]
fn a_sphere_is_a_disc_of_its_size() {
    for radius in [0.8, 0.37] {
        let image = scene(vec![sphere([0.0; 3], radius, [1.0; 3])]).draw(&camera());
        let in_pixels = radius / (100.0 - radius * radius).sqrt() / camera().pixel_at(1.0);
        let wanted = std::f64::consts::PI * in_pixels * in_pixels;
        let bound = 3.0 * 0.1 * (std::f64::consts::TAU * in_pixels).sqrt();
        assert!((covered(&image) - wanted).abs() < bound, "{} instead of {wanted}", covered(&image));
    }
}

/// Grains of half a pixel lie between the rays through the middles of pixels. All together cover what they should: with
/// 8 rays a pixel each grain's area has a scatter of about a third of itself, which 400 grains share.
#[test]
fn tiny_grains_are_not_lost() {
    let radius = 0.5 * camera().pixel();
    let spacing = 7.3 * camera().pixel();
    let place = |k: i32| [0.0, spacing * f64::from(k % 20 - 10), spacing * f64::from(k / 20 - 10)];
    let image = scene((0..400).map(|k| sphere(place(k), radius, [1.0; 3])).collect()).draw(&camera());
    let wanted = 400.0 * std::f64::consts::PI * 0.25;
    assert!((covered(&image) / wanted - 1.0).abs() < 3.0 * 0.33 / 20.0, "{} {wanted}", covered(&image));
}

#[test]
fn what_is_hidden_is_not_seen() {
    let (white, red) = ([1.0; 3], [1.0, 0.0, 0.0]);
    // Looking along +x; the red one is behind the white one.
    let (front, behind) = (sphere([0.0; 3], 0.6, white), sphere([2.0, 0.0, 0.0], 0.5, red));
    let reds =
        |image: &Image| image.pixels().iter().filter(|pixel| pixel[0] > pixel[1].saturating_add(1)).count();
    assert_eq!(reds(&scene(vec![behind, front]).draw(&camera())), 0);
    let before = sphere([-2.0, 0.0, 0.0], 0.5, red);
    assert_above!(reds(&scene(vec![before, front]).draw(&camera())), 1000);
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    use agglo::math::rng::{Purpose, Stream};
    let mut stream = Stream::new(8, Purpose::Sampling, 0);
    let ball = |_| Sphere {
        center: stream.direction() * stream.uniform(),
        radius: 0.02 + 0.1 * stream.uniform(),
        color: [0.2, 0.5, 0.9],
    };
    let mut crowd = scene((0..300).map(ball).collect());
    crowd.ground = Some(Ground { center: Vec3::new(0.0, 0.0, -1.1), radius: 5.0 });
    let ends = [Vec3::new(0.0, -1.0, -1.0), Vec3::new(0.0, 1.0, 1.0)];
    crowd.lines = vec![Line { ends, radius: 0.01, color: [0.0; 3] }];
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| crowd.draw(&camera()))
    };
    let one = on(1);
    assert_eq!(on(2), one);
    assert_eq!(on(5), one);
}

#[test]
fn grains_darken_each_other_where_they_touch() {
    let alone = scene(vec![sphere([0.0, 0.5, 0.0], 0.5, [1.0; 3])]).draw(&camera());
    let pair = scene(vec![sphere([0.0, 0.5, 0.0], 0.5, [1.0; 3]), sphere([0.0, -0.5, 0.0], 0.5, [1.0; 3])]);
    let pair = pair.draw(&camera());
    // Looking along +x, y is to the left.
    let at = |y: f64| {
        let ([x, y], _) = camera().project(Vec3::new(-0.1, y, 0.0)).unwrap();
        (x as u32, y as u32)
    };
    let brightness = |image: &Image, (x, y): (u32, u32)| i32::from(image.pixel(x, y)[0]);
    let (near, far) = (at(0.08), at(0.9));
    assert_below!(brightness(&pair, near), brightness(&alone, near) - 6);
    assert_below!((brightness(&pair, far) - brightness(&alone, far)).abs(), 6);
}

#[test]
fn lines_keep_their_color_and_hide_behind_grains() {
    let ends = [Vec3::new(2.0, 3.0, 0.0), Vec3::new(2.0, -3.0, 0.0)];
    let line = Line { ends, radius: 0.05, color: [0.0, 1.0, 0.0] };
    let picture = Scene { lines: vec![line], ..scene(vec![sphere([0.0; 3], 0.5, [1.0; 3])]) }.draw(&camera());
    let middle = picture.pixel(120, 120);
    assert!(middle[0] == middle[1] && middle[3] == 255, "{middle:?}");
    assert_eq!((picture.pixel(20, 120), picture.pixel(20, 20)), ([0, 255, 0, 255], [0; 4]));
}

#[test]
fn the_floor_takes_shadows_and_fades() {
    let mut picture = scene(vec![sphere([0.0; 3], 0.5, [1.0; 3])]);
    picture.background = Background::Light;
    picture.ground = Some(Ground { center: Vec3::new(0.0, 0.0, -0.6), radius: 6.0 });
    let camera = Camera::new(Vec3::ZERO, 10.0, Side { azimuth: 0.0, elevation: 0.7 }, SIZE);
    let image = picture.draw(&camera);
    let at = |place: [f64; 3]| {
        let ([x, y], _) = camera.project(place.into()).unwrap();
        i32::from(image.pixel(x as u32, y as u32)[0])
    };
    // Where the line from the sun through the middle of the ball meets the floor, right beside the ball.
    let [right, up, forward] = *camera.axes();
    let to_sun = up * 0.75 - right * 0.55 - forward * 0.65;
    let (shadow, open) = (at((to_sun * (-0.6 / to_sun.z)).to_array()), at([-0.3, 1.2, -0.6]));
    assert!(shadow + 60 < open, "{shadow} {open}");
    assert_eq!(image.pixel(1, 1), [255; 4]);
}

/// A sheet that turns its front to the eye takes its part of what is behind it; seen from behind, or behind the ball, it takes nothing.
#[test]
fn sheets_let_through_what_is_behind_them() {
    let ball = scene(vec![sphere([0.0; 3], 0.5, [1.0, 0.0, 0.0])]);
    // Looking along +x, y is to the left: right, top, left is against the clock.
    let corners = |x: f64| [[x, -3.0, -3.0], [x, 0.0, 4.0], [x, 3.0, -3.0]].map(Vec3::from);
    let with = |corners| Scene { sheets: vec![Sheet { corners, wall: 0 }], ..ball.clone() }.draw(&camera());
    let (alone, veiled) = (ball.draw(&camera()), with(corners(-2.0)));
    let (before, after) = (alone.pixel(120, 120), veiled.pixel(120, 120));
    assert_eq!((before[3], after[3]), (255, 255), "the ball hides all");
    assert_below!(after[0], before[0]);
    assert_above!(after[2], before[2] + 30, "the sheet is gray, the ball is red");
    let [up, aside] = [veiled.pixel(120, 40), veiled.pixel(10, 10)];
    assert_eq!(
        (up[3], aside[3]),
        ((SHEET_COVERS * 255.0).round() as u8, 0),
        "beside the ball, and beside the sheet"
    );
    let [a, b, c] = corners(-2.0);
    assert_true!(with([a, c, b]) == alone, "seen from behind");
    assert_eq!(with(corners(2.0)).pixel(120, 120), before, "behind the ball");
}
