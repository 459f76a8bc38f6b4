//! Lists of pairs and the cells behind them find whom they must find, and do not look at everybody for it.

use super::*;
use crate::engine::hard::test_systems::{Grain, particles};
use crate::units::Quantity;

/// An open volume, of which spheres have flown out.
fn volume() -> Volume {
    Volume {
        lower: [0.0; 3].map(Quantity),
        upper: [10.0, 10.0, 10.0].map(Quantity),
        boundary: Boundary::Open,
        faces: None,
        deformation: None,
    }
}

/// A row of 1,000 spheres of radius 1, 5 apart, far off the origin along x.
fn row() -> Spheres {
    let grains: Vec<Grain> =
        (0..1000).map(|at| ([4000.0 + 5.0 * f64::from(at), -70.0, 30.0], [0.0; 3], 1.0)).collect();
    Spheres::new(&particles(&grains), |_| 1.0)
}

/// Cells lie where the spheres are, not where the volume is: who looks 4 far sees some tens, not all.
#[test]
fn cells_lie_about_the_spheres() {
    let (spheres, mut cells) = (row(), CellIndex::<Sorted>::default());
    cells.fill(&spheres, &span(&volume()), 4.0);
    for at in [0_u32, 1, 500, 999] {
        let mut seen = Vec::new();
        cells.visit_all(spheres.motion[at as usize].position, 4.0, &mut |other, _| seen.push(other));
        for other in at.saturating_sub(1)..=(at + 1).min(999) {
            assert_has!(seen, &other);
        }
        assert_at_most!(seen.len(), 50);
    }
}

/// A list ends with its slack, or when spheres have drifted by two mean distances, whatever those are.
#[test]
fn a_list_ends_after_two_mean_distances() {
    for size in [1e-6, 1.0, 1e3] {
        let mut spheres = row();
        for motion in &mut spheres.motion {
            motion.position *= size;
            motion.radius *= size;
        }
        let upper = [10.0 * size; 3].map(Quantity);
        let volume = Volume { upper, ..volume() };
        let mut near = Near::new(1.0);
        near.list(&spheres, &volume, 0.0);
        assert_close!(near.spacing(), size, 1e-12, "in m: 1,000 m³ for 1,000 spheres");
        let mut drift = |way: f64| {
            near.moved(way * size, 0.0);
            near.is_valid()
        };
        assert_true!(drift(1.9), "the list holds after 1.9 mean distances of {size} m");
        assert_false!(drift(0.2), "the list holds after 2.1 mean distances of {size} m");
        near.refresh(&spheres, &volume);
        assert_true!(near.is_valid(), "the list is made anew");
    }
}
