//! Laws given as formulas and hooks keep the contracts: threads and restart change no bit.

use agglo::engine::soft::{Hook, LoadViews, Scene, Simulation};
use agglo::math::Vec3;
use rayon::ThreadPoolBuilder;

use crate::{common, crowd};

/// The crowd with a formula in the place of Hertz' law, and with a trap and a drag by formulas besides.
fn text(engine: &str, count: u32) -> String {
    let text = crowd::text(engine, count);
    let contact = "[contact.custom]\nforce = \"4/3*effective_modulus*sqrt(effective_radius)*max(0, overlap)^1.5*(1 + 0.1*atan(speed))\"\n\
                   reach = \"1 um\"\n";
    let field =
        "[fields.custom]\nforce = [\"-3*x - 1e-9*vx*abs(vx)\", \"-3*y - 1e-9*vy*abs(vy)\", \"-3*z\"]\n";
    // A small grain that many rays hit at once moves by more than half of its radius in a step.
    let parts = [
        ("strain = 0.4\n", "strain = 0.4\ndisplacement = 10.0\n"),
        ("[contact.normal.hertz]\n", contact),
        ("[fields.near_field]\n", &format!("{field}[fields.near_field]\n")),
    ];
    parts.iter().fold(text, |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replace(old, new)
    })
}

/// A hook with a memory: it kicks the grain whose turn it is.
struct Turns(u32);

impl Hook for Turns {
    fn name(&self) -> &'static str {
        "turns"
    }

    fn load(&self, now: &Scene<'_>, loads: &mut LoadViews<'_>) {
        for (at, id) in now.grains.id.iter().enumerate() {
            if id % 50 == self.0 % 50 {
                loads.force[at] += now.motion.velocity[at].cross(Vec3::AXES[2]) * 1e-6;
                loads.torque[at] += now.motion.angular_velocity[at] * -1e-16;
            }
        }
    }

    fn after_step(&mut self, _: &Scene<'_>) {
        self.0 += 1;
    }
}

#[test]
fn same_bits_on_1_2_and_7_threads() {
    for engine in [crowd::VERLET, crowd::ADAPTIVE] {
        let after = |threads: usize| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut simulation = common::start(&text(engine, 700), crowd::falling_in);
                simulation.attach(Box::new(Turns(0)));
                common::steps(&mut simulation, 100);
                assert!(simulation.ledger.flows.damping > 0.0, "no contact was damped");
                common::bytes(&simulation)
            })
        };
        let alone = after(1);
        for threads in [2, 7] {
            common::assert_same_state(
                &after(threads),
                &alone,
                &format!("{threads} threads and one, {engine}"),
            );
        }
    }
}

/// With the hook attached again, and its memory put back, a resumed run has the bits of the one that went on.
#[test]
fn same_bits_after_a_restart() {
    for engine in [crowd::VERLET, crowd::ADAPTIVE] {
        let text = text(engine, 200);
        let mut whole = common::start(&text, crowd::falling_in);
        whole.attach(Box::new(Turns(0)));
        common::steps(&mut whole, 120);
        let scenario = common::scenario(&text);
        let mut resumed = Simulation::resume(&scenario, common::written_and_read(&whole)).unwrap();
        resumed.attach(Box::new(Turns(120)));
        common::steps(&mut whole, 60);
        common::steps(&mut resumed, 60);
        common::assert_same_state(&common::bytes(&resumed), &common::bytes(&whole), engine);
        let mut lost = Simulation::resume(&scenario, common::written_and_read(&whole)).unwrap();
        common::steps(&mut lost, 1);
        let warned = lost.warnings.counts().keys().any(|text| text.contains("had a hook"));
        assert!(warned, "{:?}", lost.warnings);
    }
}
