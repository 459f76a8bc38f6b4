//! Grains that differ in material, radius, density and temperature, in touch off their centers: what each of them feels, by
//! hand. Equal grains would hide whose number is whose.

use std::f64::consts::PI;

use agglo::engine::soft::Simulation;
use agglo::math::Vec3;

use crate::common::{self, grain, place};
use crate::unlike::Unlike;

/// Of stone at 420 K and of wood at 350 K; the wood is larger.
fn stone_and_wood(distance: f64, more: &str) -> Unlike {
    Unlike {
        materials: [
            "density = \"2600 kg/m3\"\nyoungs_modulus = \"1.2 GPa\"\npoisson_ratio = 0.2\ncontact_stiffness = \"10 MPa\"\n\
             softening = { reference_temperature = \"500 K\", sensitivity = 1.5, lowest_stiffness = \"1 MPa\" }",
            "density = \"700 kg/m3\"\nyoungs_modulus = \"0.3 GPa\"\npoisson_ratio = 0.4\ncontact_stiffness = \"3 MPa\"\n\
             softening = { reference_temperature = \"400 K\", sensitivity = 0.5, lowest_stiffness = \"0.1 MPa\" }",
        ],
        radii: [1e-3, 2.5e-3],
        temperatures: [420.0, 350.0],
        distance,
        end: 1.0,
        engine: common::verlet(1e-7),
        limits: String::new(),
        more: more.to_owned(),
    }
}

fn mass(density: f64, radius: f64) -> f64 {
    density * 4.0 / 3.0 * PI * radius.powi(3)
}

/// A pair of stone and wood that overlaps by 10 um along an axis askew, and how it moves: by hand.
struct Askew {
    normal: Vec3,
    overlap: f64,
    /// Distances from the centers to the plane in which the spheres cut each other.
    lever_arms: [f64; 2],
    separation: f64,
    slip: Vec3,
    mass: f64,
    radius: f64,
    area: f64,
}

fn askew(laws: &str) -> (Simulation, Askew) {
    let normal = Vec3::new(2.0, -1.0, 2.0) / 3.0;
    let (radii, overlap) = ([1e-3, 2.5e-3], 10e-6);
    let distance = radii[0] + radii[1] - overlap;
    let (velocities, angular_velocities) = (
        [Vec3::new(0.3, 0.1, -0.2), Vec3::new(-0.1, 0.25, 0.05)],
        [Vec3::new(40.0, -90.0, 20.0), Vec3::new(-15.0, 30.0, 70.0)],
    );
    let simulation = stone_and_wood(distance, laws).start(|grains| {
        grains.position = vec![Vec3::ZERO, normal * distance];
        grains.velocity = velocities.to_vec();
        grains.angular_velocity = angular_velocities.to_vec();
    });
    // From the law of cosines in the triangle of both centers and a point of the circle.
    let first = (distance * distance + radii[0] * radii[0] - radii[1] * radii[1]) / (2.0 * distance);
    let lever_arms = [first, distance - first];
    let relative = velocities[1]
        - velocities[0]
        - (angular_velocities[0] * lever_arms[0] + angular_velocities[1] * lever_arms[1]).cross(normal);
    let separation = relative.dot(normal);
    let masses = [mass(2600.0, radii[0]), mass(700.0, radii[1])];
    let askew = Askew {
        normal,
        overlap,
        lever_arms,
        separation,
        slip: relative - normal * separation,
        mass: masses[0] * masses[1] / (masses[0] + masses[1]),
        radius: radii[0] * radii[1] / (radii[0] + radii[1]),
        area: PI * (radii[0] * radii[0] - first * first),
    };
    (simulation, askew)
}

/// Asserts the loads of both grains for a repulsion [N] and a force across the normal [N] on the first.
fn assert_loads(simulation: &Simulation, pair: &Askew, repulsion: f64, across: Vec3, what: &str) {
    let loads = &simulation.system.loads;
    let [first, second] = [0, 1].map(|id| place(simulation, id));
    let force = across - pair.normal * repulsion;
    let couple = pair.normal.cross(across);
    // The area follows from a difference of squares: rounding over the overlap's part of the radius, 1e-16/1e-2.
    let tolerance = 1e-11;
    assert_close_vector!(loads.force[first], force, tolerance, "{what}: force on the stone, N");
    assert_close_vector!(loads.force[second], -force, tolerance, "{what}: force on the wood, N");
    let moments = pair.lever_arms.map(|arm| couple * arm);
    assert_close_vector!(loads.torque[first], moments[0], tolerance, "{what}: torque on the stone, N m");
    assert_close_vector!(loads.torque[second], moments[1], tolerance, "{what}: torque on the wood, N m");
}

/// Hertz with the dashpot of a restitution and that of the spring across, which is not loaded yet: as it is, and cut to
/// dynamic friction.
#[test]
fn hertz_restitution_and_mindlin_by_hand() {
    for friction in [50.0_f64, 0.1] {
        let laws = format!(
            "[contact.normal.hertz]\n[contact.damping.restitution]\nrestitution = 0.4\n[contact.friction.mindlin]\n\
             static_friction = {friction}\ndynamic_friction = {}\ndashpot = 0.7",
            0.5 * friction
        );
        let (simulation, pair) = askew(&laws);
        let modulus = 1.0 / ((1.0 - 0.04) / 1.2e9 + (1.0 - 0.16) / 0.3e9);
        let elastic = 4.0 / 3.0 * modulus * pair.radius.sqrt() * pair.overlap.powf(1.5);
        let stiffness = 2.0 * modulus * (pair.radius * pair.overlap).sqrt();
        let damping = 0.4_f64.ln().abs() / 0.4_f64.ln().hypot(PI);
        let dashpot = 2.0 * damping * (5.0 / 6.0 * stiffness * pair.mass).sqrt();
        let repulsion = elastic - dashpot * pair.separation;
        let trial = pair.slip * (0.7 * dashpot);
        let sticks = trial.norm() < friction * repulsion;
        assert_eq!(sticks, friction > 1.0, "the case is made for {friction}");
        let across = if sticks { trial } else { trial.normalized() * (0.5 * friction * repulsion) };
        assert_loads(&simulation, &pair, repulsion, across, &format!("friction {friction}"));
    }
}

/// The published laws: K E^p A with the mean of two stiffnesses, each softened by its own heat; c A along the normal; K A Δt
/// across it, and a bond on top of both.
#[test]
fn published_laws_by_hand() {
    let bond = "[bonds.strain_bond]\nstiffness = \"2 MPa\"\nexponent = 1.5\ntangential_stiffness = \"3e9 Pa/m\"\n\
                threshold_strain = 0.001";
    let laws = "[contact.normal.strain_power]\nexponent = 1.5\n[contact.damping.viscous_area]\ncoefficient = \"1e5 Pa s/m\"\n\
                [contact.friction.regularized]\nstiffness = \"1e10 Pa/m\"\nstatic_friction = 50.0\ndynamic_friction = 40.0\n";
    for bond in [None, Some(bond)] {
        let (simulation, pair) = askew(&format!("{laws}{}", bond.unwrap_or_default()));
        let softened =
            |stiffness: f64, sensitivity: f64, ratio: f64| stiffness * (-sensitivity * (ratio - 1.0)).exp();
        let stiffness = 0.5 * (softened(10e6, 1.5, 420.0 / 500.0) + softened(3e6, 0.5, 350.0 / 400.0));
        let strain = (pair.overlap / 3.5e-3).powf(1.5);
        let attraction = if bond.is_some() { 2e6 * strain * pair.area } else { 0.0 };
        let bound = if bond.is_some() { 3e9 } else { 0.0 };
        let repulsion = (stiffness * strain - 1e5 * pair.separation) * pair.area - attraction;
        let across = pair.slip * ((1e10 + bound) * pair.area * 1e-7);
        assert_loads(&simulation, &pair, repulsion, across, &format!("bond {}", bond.is_some()));
    }
}

/// One ray that bounces off the second grain onto the first; a third grain is not hit. By hand from where it started: both
/// points, both reflections (Fresnel and Snell in fluids), each grain's push, twist and power, and the books of all.
#[test]
fn one_ray_on_two_grains_by_hand() {
    let laws = [
        "force.impulse.duration = \"50 ns\"",
        "force.radiation_pressure.duration = \"50 ns\"",
        "force.published_step.step_fraction = 0.2",
    ];
    for law in laws {
        let text = format!(
            "version = 1\ntime.end = \"1 us\"\n{}[medium]\ndensity = \"1000 kg/m3\"\nsound_speed = \"1500 m/s\"\n\
             {}{}{}[acoustics]\n{law}\n[[acoustics.beams]]\nstart = [\"0 m\", \"9 um\", \"7 um\"]\n\
             direction = [1.0, 0.0, 0.0]\nradius = \"0.1 um\"\nrays = 1\nstrength.power = \"3 mW\"\n",
            common::verlet(5e-9),
            alone("hard", 4000.0, 5000.0, 20.0),
            alone("soft", 1300.0, 2300.0, 30.0),
            alone("idle", 2000.0, 3000.0, 10.0),
        );
        // Where the second bounce is to be: 60 um on, 4 um off the center.
        let aim = Ray { origin: Vec3::new(0.0, 9e-6, 7e-6), direction: Vec3::AXES[0], power: 1.0 };
        let second = Vec3::new(100e-6, 0.0, 0.0);
        let bounced = aim.bounce(second, 30e-6, SOFT).next;
        let aside = bounced.direction.cross(Vec3::new(1.0, 2.0, 3.0)).normalized();
        let first = bounced.origin + bounced.direction * 60e-6 + aside * 4e-6;
        let mut simulation = common::start(&text, |grains| {
            grains.position = vec![first, second, Vec3::new(0.0, -500e-6, 0.0)];
        });
        assert!(
            place(&simulation, 0) != 0 && place(&simulation, 1) != 1,
            "no grain stands at the place of its name"
        );
        common::steps(&mut simulation, 1);
        let seen = simulation.pulses.flight().rays()[0];
        let ray = Ray { origin: seen.origin, direction: seen.direction, power: seen.power };
        assert_close!(ray.power, 3e-3, 1e-15, "power of the ray, W");
        let on_second = ray.bounce(second, 30e-6, SOFT);
        let on_first = on_second.next.bounce(first, 20e-6, HARD);
        common::finish(&mut simulation);
        assert!(simulation.pulses.flight().rays().is_empty(), "the ray has left");
        // Mean radius 20 um, a fifth of that.
        let duration = if law.contains("published") { 0.2 * 20e-6 / 1500.0 } else { 50e-9 };
        let mut books = (0.0, Vec3::ZERO, Vec3::ZERO);
        for (id, hit, density, radius, at) in
            [(0, &on_first, 4000.0, 20e-6, first), (1, &on_second, 1300.0, 30e-6, second)]
        {
            let impulse = hit.force(law, density) * duration;
            let arm = hit.next.origin - at;
            let (mass, found) = (mass(density, radius), grain(&simulation, id));
            let inertia = 0.4 * mass * radius * radius;
            let (velocity, angular_velocity) = (impulse / mass, arm.cross(impulse) / inertia);
            let what = |what: &str| format!("{law}: {what} of grain {id}");
            assert_close_vector!(found.velocity, velocity, 1e-9, "{}, m/s", what("velocity"));
            assert_close_vector!(
                found.angular_velocity,
                angular_velocity,
                1e-9,
                "{}, rad/s",
                what("angular velocity")
            );
            assert_close!(found.absorbed_power, hit.absorbed, 1e-9, "{}, W", what("absorbed power"));
            books.0 += 0.5 * (mass * velocity.norm_squared() + inertia * angular_velocity.norm_squared());
            books.1 += impulse;
            books.2 += at.cross(impulse) + arm.cross(impulse);
        }
        let idle = grain(&simulation, 2);
        assert_eq!(
            (idle.velocity, idle.angular_velocity, idle.absorbed_power),
            (Vec3::ZERO, Vec3::ZERO, 0.0),
            "grain 2 is not hit"
        );
        let flow = simulation.ledger.flows.rays;
        assert_close!(flow.power, books.0, 1e-9, "{law}: energy from rays, J");
        assert_close_vector!(flow.force, books.1, 1e-9, "{law}: impulse from rays, N s");
        // Grains move by a part of their radius of 1e-6 until they are hit.
        assert_close_vector!(flow.torque, books.2, 1e-5, "{law}: torque of rays, N m s");
        let pulse = simulation.pulses.counts()[0];
        assert_eq!((pulse.reflections, pulse.segments), (2, 3), "{law}");
        assert_close!(
            pulse.power_absorbed,
            on_first.absorbed + on_second.absorbed,
            1e-9,
            "absorbed by both, W"
        );
        assert_close!(pulse.power_escaped, on_first.next.power, 1e-9, "power that leaves, W");
    }
}

fn alone(name: &str, density: f64, speed: f64, radius_um: f64) -> String {
    format!(
        "[materials.{name}]\ndensity = \"{density} kg/m3\"\nsound_speed = \"{speed} m/s\"\n[[grains]]\nmaterial = \"{name}\"\n\
         size.constant.radius = \"{radius_um} um\"\nplacement.list.positions = [[\"0 m\", \"{radius_um} mm\", \"0 m\"]]\n"
    )
}

/// Density [kg/m³] and speed of sound [m/s].
const HARD: [f64; 2] = [4000.0, 5000.0];
const SOFT: [f64; 2] = [1300.0, 2300.0];

#[derive(Clone, Copy)]
struct Ray {
    origin: Vec3,
    direction: Vec3,
    power: f64,
}

/// What a ray does at a sphere.
struct Bounce {
    next: Ray,
    came: Ray,
    refracted: Vec3,
    absorbed: f64,
}

impl Ray {
    /// At a fluid sphere in water.
    fn bounce(&self, center: Vec3, radius: f64, [density, speed]: [f64; 2]) -> Bounce {
        let from = self.origin - center;
        let along = from.dot(self.direction);
        let way = -along - (along * along - from.norm_squared() + radius * radius).sqrt();
        let point = self.origin + self.direction * way;
        let normal = (point - center) / radius;
        let cosine = -self.direction.dot(normal);
        let ratio = speed / 1500.0;
        let sine = ratio * (1.0 - cosine * cosine).sqrt();
        let inside = (1.0 - sine * sine).sqrt();
        let impedance = density * speed / (1000.0 * 1500.0);
        let amplitude = (impedance * cosine - inside) / (impedance * cosine + inside);
        let power = self.power * amplitude * amplitude;
        Bounce {
            next: Self { origin: point, direction: self.direction + normal * (2.0 * cosine), power },
            came: *self,
            refracted: self.direction * ratio + normal * (ratio * cosine - inside),
            absorbed: self.power - power,
        }
    }
}

impl Bounce {
    /// On a grain of this density [kg/m³].
    fn force(&self, law: &str, density: f64) -> Vec3 {
        if law.contains("radiation") {
            return (self.came.direction * self.came.power - self.next.direction * self.next.power) / 1500.0;
        }
        let speed = if density == HARD[0] { HARD[1] } else { SOFT[1] };
        let area = PI * 1e-14;
        self.refracted * (self.absorbed * density * speed * area).sqrt()
    }
}

/// A grain held by a bond at a heavy one of another size, under a force on its center and a moment along the bond. By
/// hand, with the disc at lever arms a_i and a_j from the centers, a_i + a_j = l: across it moves by F/(k_s A) + a_j²
/// F/(k_n I), since the disc bears the moment a_j F and turns by a_j F/(k_n I); the heavy one feels F and the moment l
/// n x F + T.
#[test]
fn one_bond_between_unequal_grains() {
    for [held, loaded] in [[1.0, 2.0], [2.0, 1.0], [1.0, 5.0], [5.0, 1.0]] {
        let radii = [held * 1e-3, loaded * 1e-3];
        let length = radii[0] + radii[1];
        let (force, charge) = (Vec3::new(2e-5, 1e-5, -0.5e-5), 1e-9);
        let field = force.to_array().map(|component| format!("\"{} V/m\"", component / charge)).join(", ");
        // The medium turns about the axis of the pair at 100/s: the moment 8 π η R³ ω on each at rest.
        let unlike = Unlike {
            materials: ["density = \"1e20 kg/m3\"", "density = \"2500 kg/m3\""],
            radii,
            temperatures: [300.0; 2],
            distance: length,
            // Twenty times as long as the slowest of its motions dies away, which the larger does more slowly.
            end: 2e-3 * loaded.powf(2.4),
            engine: "[engine.verlet]\nsafety = 0.3".to_owned(),
            limits: String::new(),
            more: format!(
                "[bonds.beam]\nyoungs_modulus = \"1 GPa\"\nshear_ratio = 0.3\nradius_ratio = 0.8\n\
                 tensile_strength = \"1 GPa\"\nshear_strength = \"1 GPa\"\ndamping_ratio = 0.5\n\
                 [fields.lorentz]\nelectric_field = [{field}]\n[medium]\ndensity = \"1 g/m3\"\nviscosity = \"50 uPa s\"\n\
                 [fields.drag]\n\
                 law = \"stokes\"\nmedium_velocity = [\"0 m/s\", \"-100*z\", \"100*y\"]"
            ),
        };
        let mut simulation = unlike.start(|grains| {
            grains.charge[1] = charge;
        });
        common::finish(&mut simulation);
        let disc = 0.8e-3 * held.min(loaded);
        let per_area = 1e9 / length;
        let (area, second) = (PI * disc.powi(2), PI * disc.powi(4) / 4.0);
        let (along, across) = (per_area * area, 0.3 * per_area * area);
        let (bending, twisting) = (per_area * second, 0.3 * per_area * 2.0 * second);
        let arm = radii[1];
        let aside = Vec3::new(0.0, force.y, force.z);
        let moved = grain(&simulation, 1).position - Vec3::AXES[0] * length;
        let stretch = grain(&simulation, 1).position.norm() - length;
        let give = 1.0 / across + arm * arm / bending;
        let what = |what: &str| format!("{held} R held, {loaded} R loaded: {what}");
        // What is left of the motion is below 1e-8; the axis turns by 1e-6 at most, to which the load is askew
        // then, and off its axis the medium draws the grain aside by 4e-7 of the force.
        let tolerance = 5e-6;
        assert_close!(stretch, force.x / along, tolerance, "{}, m", what("stretch"));
        assert_close_vector!(
            Vec3::new(0.0, moved.y, moved.z),
            aside * give,
            tolerance,
            "{}, m",
            what("deflection")
        );
        let drag_moment = radii.map(|radius: f64| 8.0 * PI * 5e-5 * radius.powi(3) * 100.0);
        let twist = Vec3::AXES[0] * drag_moment[1];
        let loads = &simulation.system.loads;
        let (heavy, free) = (place(&simulation, 0), place(&simulation, 1));
        assert_close_vector!(loads.force[heavy], force, tolerance, "{}, N", what("force on the held grain"));
        let reaction = Vec3::AXES[0].cross(aside) * length + twist + Vec3::AXES[0] * drag_moment[0];
        assert_close_vector!(
            loads.torque[heavy],
            reaction,
            tolerance,
            "{}, N m",
            what("moment on the held grain")
        );
        let rest = tolerance * force.norm();
        assert!(loads.force[free].norm() < rest, "{} N left", loads.force[free].norm());
        assert!(loads.torque[free].norm() < rest * length, "{} N m left", loads.torque[free].norm());
        let bond = simulation.system.network.bonds()[0];
        assert_close!(bond.state.twist, drag_moment[1], tolerance, "{}, N m", what("twisting moment"));
        let stored = 0.5
            * (force.x * force.x / along
                + aside.norm_squared() * give
                + drag_moment[1] * drag_moment[1] / twisting);
        assert_close!(
            simulation.stored_energy().bonds,
            stored,
            tolerance,
            "{}, J",
            what("energy of the bond")
        );
    }
}
