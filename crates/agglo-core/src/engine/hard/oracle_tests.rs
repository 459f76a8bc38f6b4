//! The event-driven engine against a brute force that knows no cells, no queue and no past: from the spheres as they
//! are it works out the next event of all pairs and all images. After each event it starts again from the engine's
//! own state, so chaos amplifies nothing and every single event is held to its time, its pair and its outcome.

use super::Simulation;
use super::test_systems::{BOUNDARIES, EVENTS, Grain, advance_to, crowd, restitution, scenario, start};
use crate::math::Vec3;

/// Half the edge of the cube [m].
const HALF: f64 = 0.01;
/// The engine is looked at this much before and after each event [s]. Events are some 1e-6 s apart.
const MOMENT: f64 = 1e-12;

#[derive(Clone, Copy, Debug)]
struct Ball {
    id: u32,
    place: Vec3,
    velocity: Vec3,
    radius: f64,
    mass: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    /// Two meet, the second one shifted.
    Impact([usize; 2], Vec3),
    Wall(usize, usize),
    /// One leaves an antipodal volume.
    Face(usize, usize),
    Nothing,
}

#[derive(Clone, Debug)]
struct Brute {
    balls: Vec<Ball>,
    boundary: &'static str,
    restitution: f64,
    time: f64,
    collisions: u64,
    walls: u64,
    merges: u64,
    /// Whether two collisions were due at the same moment, so that their order is not physics.
    ambiguous: bool,
}

fn along(axis: usize, value: f64) -> Vec3 {
    Vec3::AXES[axis] * value
}

/// The textbook root of |d + u t| = s, and at once where two overlap and approach.
fn meets(d: Vec3, u: Vec3, s: f64) -> f64 {
    let (b, c, uu) = (d.dot(u), d.dot(d) - s * s, u.dot(u));
    if b >= 0.0 {
        return f64::INFINITY;
    }
    let root = b * b - uu * c;
    match (c <= 0.0, root <= 0.0) {
        (true, _) => 0.0,
        (_, true) => f64::INFINITY,
        _ => (-b - root.sqrt()) / uu,
    }
}

impl Brute {
    fn of(simulation: &Simulation, boundary: &'static str, restitution: f64) -> Self {
        let now = simulation.snapshot().grains;
        let ball = |at: usize| Ball {
            id: now.id[at],
            place: now.position[at],
            velocity: now.velocity[at],
            radius: now.radius[at],
            mass: now.mass[at],
        };
        let counts = &simulation.system().state.counts;
        Self {
            balls: (0..now.len()).map(ball).collect(),
            boundary,
            restitution,
            time: simulation.clock().time,
            collisions: counts.collisions,
            walls: counts.walls,
            merges: counts.merges,
            ambiguous: false,
        }
    }

    fn images(&self) -> Vec<Vec3> {
        let (reach, edge) = (i32::from(self.boundary == "periodic"), 2.0 * HALF);
        let steps = || (-reach..=reach).map(|k| f64::from(k) * edge);
        let mut images = Vec::new();
        for x in steps() {
            for y in steps() {
                images.extend(steps().map(|z| Vec3::new(x, y, z)));
            }
        }
        images
    }

    /// The first event within `limit` [s] from now, if there is one.
    fn first_within(&mut self, limit: f64) -> (f64, Event) {
        let mut first = (limit, Event::Nothing);
        let images = self.images();
        let balls = &self.balls;
        for (a, one) in balls.iter().enumerate() {
            for (b, other) in balls.iter().enumerate().skip(a + 1) {
                let (between, relative) = (other.place - one.place, other.velocity - one.velocity);
                for image in &images {
                    let wait = meets(between + *image, relative, one.radius + other.radius);
                    self.ambiguous |= wait == 0.0 && first.0 == 0.0;
                    if wait < first.0 {
                        first = (wait, Event::Impact([a, b], *image));
                    }
                }
            }
            for axis in 0..3 {
                let (speed, place) = (one.velocity[axis], one.place[axis]);
                let ahead = place * speed.signum();
                let (way, event) = match self.boundary {
                    "reflecting" => (HALF - one.radius - ahead, Event::Wall(a, axis)),
                    "antipodal" => (HALF - ahead, Event::Face(a, axis)),
                    _ => continue,
                };
                let wait = way.max(0.0) / speed.abs();
                if wait < first.0 {
                    first = (wait, event);
                }
            }
        }
        first
    }

    fn fly(&mut self, wait: f64) {
        self.time += wait;
        self.balls.iter_mut().for_each(|ball| ball.place += ball.velocity * wait);
    }

    /// Brings positions back into a periodic volume.
    fn fold(&mut self) {
        for ball in self.balls.iter_mut().filter(|_| self.boundary == "periodic") {
            for axis in 0..3 {
                let edges = ((ball.place[axis] + HALF) / (2.0 * HALF)).floor();
                ball.place -= along(axis, 2.0 * HALF * edges);
            }
        }
    }

    /// Flies to the next collision or wall before `until` [s]. Images next to one another are enough as long as nothing flies
    /// further than a quarter of an edge.
    fn fly_to_next(&mut self, until: f64) -> Event {
        let mut turns = agglo_testing::Turns::at_most(10_000_000, "an event");
        loop {
            turns.take();
            self.fold();
            let fastest = self.balls.iter().map(|ball| ball.velocity.norm()).fold(0.0, f64::max);
            let left = (until - self.time).max(0.0);
            let limit = if self.boundary == "periodic" { left.min(0.5 * HALF / fastest) } else { left };
            let (wait, event) = self.first_within(limit);
            self.fly(wait);
            match event {
                Event::Face(at, axis) => {
                    let ball = &mut self.balls[at];
                    let side = ball.velocity[axis].signum();
                    ball.place += along(axis, -side * HALF - ball.place[axis]);
                }
                Event::Nothing if self.time < until => {}
                _ => return event,
            }
            if self.time >= until {
                return Event::Nothing;
            }
        }
    }

    fn deal_with(&mut self, event: Event) {
        match event {
            Event::Wall(at, axis) => {
                let ball = &mut self.balls[at];
                ball.velocity += along(axis, -2.0 * ball.velocity[axis]);
                self.walls += 1;
            }
            Event::Impact(pair, image) => {
                self.collisions += 1;
                if self.restitution == 0.0 { self.merge(pair, image) } else { self.bounce(pair, image) }
            }
            Event::Face(..) | Event::Nothing => {}
        }
    }

    fn bounce(&mut self, [a, b]: [usize; 2], image: Vec3) {
        let (one, other) = (self.balls[a], self.balls[b]);
        let normal = (other.place + image - one.place).normalized();
        let approach = (one.velocity - other.velocity).dot(normal);
        let impulse = normal * ((1.0 + self.restitution) * approach / (1.0 / one.mass + 1.0 / other.mass));
        self.balls[a].velocity -= impulse / one.mass;
        self.balls[b].velocity += impulse / other.mass;
    }

    fn merge(&mut self, [a, b]: [usize; 2], image: Vec3) {
        let (one, mut other) = (self.balls[a], self.balls[b]);
        let mut folded = self.clone();
        folded.fold();
        let [p, q] = [a, b].map(|at| folded.balls[at].place.to_array());
        let first_is_name = one.mass > other.mass || (one.mass == other.mass && p < q);
        other.place += image;
        let mass = one.mass + other.mass;
        let mean = |p: Vec3, q: Vec3| (p * one.mass + q * other.mass) / mass;
        self.balls[a] = Ball {
            id: if first_is_name { one.id } else { other.id },
            place: mean(one.place, other.place),
            velocity: mean(one.velocity, other.velocity),
            radius: (one.radius.powi(3) + other.radius.powi(3)).cbrt(),
            mass,
        };
        self.balls.remove(b);
        self.merges += 1;
    }

    /// Pairs that overlap by more than rounding and approach.
    fn lost(&self) -> usize {
        let images = self.images();
        let mut lost = 0;
        for (a, one) in self.balls.iter().enumerate() {
            for other in &self.balls[a + 1..] {
                for image in &images {
                    let between = other.place - one.place + *image;
                    let reach = (one.radius + other.radius) * (1.0 - 1e-9);
                    let closing = between.dot(other.velocity - one.velocity);
                    lost += usize::from(between.norm() < reach && closing < -1e-12 * reach);
                }
            }
        }
        lost
    }
}

/// What is seen of a run.
#[derive(Debug, Default)]
struct Seen {
    collisions: u64,
    walls: u64,
    merges: u64,
    cascades: u64,
    compared: u64,
}

/// Follows the engine event by event through `collisions` collisions, or to where there is no collision any more.
fn follow(boundary: &'static str, e: f64, grains: &[Grain], collisions: u64) -> Seen {
    let mut simulation = start(&scenario(EVENTS, boundary, &restitution(e)), grains);
    let mut seen = Seen::default();
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "the collisions that are due");
    while seen.collisions < collisions {
        turns.take();
        let mut brute = Brute::of(&simulation, boundary, e);
        let before = (brute.collisions, brute.walls);
        let event = brute.fly_to_next(0.9);
        if event == Event::Nothing {
            advance_to(&mut simulation, 0.9);
            let counts = &simulation.system().state.counts;
            assert_eq!((counts.collisions, counts.walls), before, "events that brute force does not see");
            break;
        }
        let time = brute.time;
        assert!(time > simulation.clock().time - MOMENT, "time runs backwards");
        let early = time - MOMENT;
        advance_to(&mut simulation, early);
        let counts = &simulation.system().state.counts;
        assert_eq!(
            (counts.collisions, counts.walls),
            before,
            "too soon: {event:?} at {time:e} in {boundary}"
        );
        let mut event = event;
        while event != Event::Nothing {
            brute.deal_with(event);
            event = brute.fly_to_next(time + MOMENT);
        }
        advance_to(&mut simulation, time + MOMENT);
        compare(&simulation, &brute, time, &mut seen);
    }
    seen
}

/// Holds the engine just after an event to the brute force.
fn compare(simulation: &Simulation, brute: &Brute, time: f64, seen: &mut Seen) {
    let now = Brute::of(simulation, brute.boundary, brute.restitution);
    assert_eq!(now.lost(), 0, "overlapping spheres approach at {time:e} in {}", brute.boundary);
    seen.cascades += u64::from(brute.collisions > seen.collisions + 1);
    (seen.collisions, seen.walls, seen.merges) = (now.collisions, now.walls, now.merges);
    if brute.ambiguous {
        return;
    }
    assert_eq!(
        (now.collisions, now.walls),
        (brute.collisions, brute.walls),
        "at {time:e} in {}",
        brute.boundary
    );
    let mut expected = brute.balls.clone();
    expected.sort_by_key(|ball| ball.id);
    let names = |balls: &[Ball]| balls.iter().map(|ball| ball.id).collect::<Vec<_>>();
    assert_eq!(names(&now.balls), names(&expected), "at {time:e} in {}", brute.boundary);
    for (found, wanted) in now.balls.iter().zip(&expected) {
        let apart = (found.place - wanted.place).to_array().map(|along| {
            let edges = if brute.boundary == "open" { 0.0 } else { (along / (2.0 * HALF)).round() };
            along - 2.0 * HALF * edges
        });
        // One flight and one collision, rounded in two ways; a grazing collision loses half of all digits at the very worst.
        assert!(Vec3::from(apart).norm() < 1e-9 * wanted.radius, "{found:?} {wanted:?} at {time:e}");
        let speed = 1.0 + wanted.velocity.norm();
        assert!((found.velocity - wanted.velocity).norm() < 1e-9 * speed, "{found:?} {wanted:?} at {time:e}");
        assert_close!(found.radius, wanted.radius, 1e-14, "in m");
        assert_close!(found.mass, wanted.mass, 1e-14, "in kg");
    }
    assert_times(simulation, time);
    seen.compared += 1;
}

/// The engine has the event at its time to 1e-9 of the time that spheres take between two collisions, 1e-5 s and more.
fn assert_times(simulation: &Simulation, time: f64) {
    let spheres = &simulation.system().state.spheres;
    for at in spheres.living() {
        let bounced = spheres.bulk[at as usize].bounced_at;
        let is_now = (bounced - time).abs() < 1e-9;
        assert!(!is_now || (bounced - time).abs() < 1e-14, "{bounced:e} and not {time:e}");
    }
}

const INWARDS: f64 = 1000.0;

fn inwards(boundary: &str) -> f64 {
    if boundary == "open" { INWARDS } else { 0.0 }
}

fn clouds(e: f64, largest: f64, ratio: f64, collisions: u64) {
    for boundary in BOUNDARIES {
        let mut sum = Seen::default();
        for seed in 0..4 {
            let n = 30 + 20 * seed as usize;
            let seen = follow(boundary, e, &crowd(n, largest, ratio, inwards(boundary), seed), collisions);
            sum.collisions += seen.collisions;
            sum.walls += seen.walls;
            sum.compared += seen.compared;
            sum.cascades += seen.cascades;
        }
        // An open system has one collision and is gone.
        assert!(
            sum.collisions > if boundary == "open" || e == 0.0 { 60 } else { 4 * collisions - 1 },
            "{sum:?}"
        );
        assert!(sum.compared > 50 && (sum.walls > 20) == (boundary == "reflecting"), "{sum:?}");
    }
}

#[test]
fn equal_elastic_spheres() {
    clouds(1.0, 1e-3, 1.0, 90);
}

#[test]
fn elastic_spheres_of_sizes_up_to_1_to_20() {
    clouds(1.0, 2.5e-3, 20.0, 90);
}

#[test]
fn equal_inelastic_spheres() {
    clouds(0.6, 1e-3, 1.0, 70);
}

#[test]
fn inelastic_spheres_of_sizes_up_to_1_to_20() {
    clouds(0.6, 2.5e-3, 20.0, 70);
}

#[test]
fn equal_sticky_spheres() {
    clouds(0.0, 1e-3, 1.0, 150);
}

#[test]
fn sticky_spheres_of_sizes_up_to_1_to_20() {
    clouds(0.0, 2.5e-3, 20.0, 150);
}

/// One sphere that leaves hardly any room, and small ones in the corners.
#[test]
fn spheres_nearly_as_wide_as_the_volume() {
    for boundary in BOUNDARIES {
        for e in [1.0, 0.6, 0.0] {
            let mut grains: Vec<Grain> = vec![([0.0; 3], [3.0, -2.0, 1.0], 9.5e-3)];
            for corner in 0..8_u32 {
                let side = |bit: u32| if corner >> bit & 1 == 0 { -8.6e-3 } else { 8.6e-3 };
                let place = [side(0), side(1), side(2)];
                let swirl = [place[1] * 2e3, -place[0] * 1.5e3, place[2] * -1e3 + f64::from(corner)];
                grains.push((place, swirl, 1.1e-3 - 1e-5 * f64::from(corner)));
            }
            let seen = follow(boundary, e, &grains, 60);
            // Antipodal and open ones let the small spheres go.
            assert!(seen.compared >= 3, "{seen:?} in {boundary} with {e}");
            assert!(
                seen.collisions >= 60 || boundary == "open" || e == 0.0,
                "{seen:?} in {boundary} with {e}"
            );
        }
    }
}

/// Centers go through faces, edges and corners of the volume at the very moment of a collision, to rounding.
#[test]
fn impacts_at_the_moment_of_crossing_a_face() {
    let speed = [10.0, 7.0, 3.0];
    for axes in 1..8_u32 {
        for (delay, e) in [(0.0, 1.0), (1e-18, 1.0), (-1e-18, 0.6), (1e-15, 1.0), (-1e-15, 0.6), (0.0, 0.0)] {
            for other in [0.0, 1.0, -1.0] {
                let has = |axis: usize| if axes >> axis & 1 == 1 { 1.0 } else { 0.0 };
                // The first is at the face after 0.1 ms; the second is then the sum of the radii along x away from it.
                let time = 1e-4 + delay;
                let velocity = [0, 1, 2].map(|axis| has(axis) * speed[axis] + 0.5 * speed[(axis + 1) % 3]);
                let first = [0, 1, 2].map(|axis| {
                    let target = if has(axis) == 1.0 { HALF } else { 2e-3 };
                    target - velocity[axis] * 1e-4
                });
                let moves = [velocity[0] - 10.0, velocity[1] * other, velocity[2] * other];
                let second = [0, 1, 2].map(|axis| {
                    let way = if axis == 0 { 2.1e-3 } else { 0.0 };
                    let along = first[axis] + velocity[axis] * time + way - moves[axis] * time;
                    if along >= HALF { along - 2.0 * HALF } else { along }
                });
                let grains = [(first, velocity, 1e-3), (second, moves, 1.1e-3)];
                let seen = follow("periodic", e, &grains, 2);
                assert!(seen.collisions >= 1 && seen.compared >= 1, "{axes} {delay} {e}");
            }
        }
    }
}
