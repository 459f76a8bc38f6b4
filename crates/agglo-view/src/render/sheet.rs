//! Walls of a run: thin sheets, which let what is behind them through, with their edges.
//!
//! A sheet is seen from the side where grains are, and not at all from behind: so one looks into a vessel through its near side.

use super::bvh::{Bounds, Ray};
use agglo::math::Vec3;

/// A triangle of a wall, its corners [m] counted against the clock where it is seen from the side of the grains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheet {
    /// Its corners [m].
    pub corners: [Vec3; 3],
    /// Number of its wall.
    pub wall: u32,
}

/// Faces that meet at a smaller angle than this are parts of one that is round: its cosine.
const SMOOTH: f64 = 0.8;

impl Sheet {
    /// Unit vector toward the side where grains are; nothing of a triangle without an area.
    fn normal(&self) -> Option<Vec3> {
        let [a, b, c] = self.corners;
        let area = (b - a).cross(c - a);
        let size = area.norm();
        (size > 0.0 && size.is_finite()).then(|| area / size)
    }

    pub(super) fn bounds(&self) -> Bounds {
        let [a, b, c] = self.corners.map(|corner| Bounds::of_sphere(corner, 0.0));
        a.and(b).and(c)
    }

    /// Whether it turns the side where grains are to a place [m].
    fn faces(&self, eye: Vec3) -> bool {
        self.normal().is_some_and(|normal| normal.dot(eye - self.corners[0]) > 0.0)
    }

    /// Distance at which a ray meets it from the side of the grains, and its normal (T. Möller and B. Trumbore, J. Graph. Tools 2, 21
    /// (1997)).
    #[inline]
    pub(super) fn hit(&self, ray: &Ray) -> Option<(f64, Vec3)> {
        let [a, b, c] = self.corners;
        let (along_b, along_c) = (b - a, c - a);
        let across = ray.direction.cross(along_c);
        let size = along_b.dot(across);
        // Positive where the ray comes from the side of the grains.
        if size.is_nan() || size <= 0.0 {
            return None;
        }
        let from_a = ray.origin - a;
        let over = from_a.cross(along_b);
        let (part_b, part_c) = (from_a.dot(across) / size, ray.direction.dot(over) / size);
        let distance = along_c.dot(over) / size;
        let is_met = part_b >= 0.0 && part_c >= 0.0 && part_b + part_c <= 1.0 && distance > 0.0;
        if is_met { Some((distance, self.normal()?)) } else { None }
    }
}

/// The edges [m] of walls that are drawn for an eye [m]: where a wall ends, where faces meet at an angle, and where a round one turns away.
pub(super) fn edges(sheets: &[Sheet], eye: Vec3) -> Vec<[Vec3; 2]> {
    let mut sides: Vec<([u64; 7], usize, [Vec3; 2])> = Vec::with_capacity(3 * sheets.len());
    for (number, sheet) in sheets.iter().enumerate() {
        if sheet.normal().is_none() {
            continue;
        }
        for corner in 0..3 {
            let mut ends = [sheet.corners[corner], sheet.corners[(corner + 1) % 3]];
            // Neighbors walk along a shared side in opposite directions.
            if bits(ends[1]) < bits(ends[0]) {
                ends.swap(0, 1);
            }
            let ([x, y, z], [u, v, w]) = (bits(ends[0]), bits(ends[1]));
            sides.push(([u64::from(sheet.wall), x, y, z, u, v, w], number, ends));
        }
    }
    sides.sort_by_key(|side| (side.0, side.1));
    let shared = sides.chunk_by(|one, other| one.0 == other.0);
    shared
        .filter(|same| is_drawn(sheets, same.iter().map(|side| side.1), eye))
        .map(|same| same[0].2)
        .collect()
}

/// Whether a side of these triangles is drawn.
fn is_drawn(sheets: &[Sheet], mut of: impl ExactSizeIterator<Item = usize>, eye: Vec3) -> bool {
    let pair = if of.len() == 2 { of.next().zip(of.next()) } else { None };
    let Some((one, other)) = pair.map(|(one, other)| (&sheets[one], &sheets[other])) else { return true };
    let angle = one.normal().zip(other.normal()).map_or(1.0, |(one, other)| one.dot(other));
    angle < SMOOTH || one.faces(eye) != other.faces(eye)
}

/// What tells places apart; corners that belong together have the same bits, but for the sign of zero.
fn bits(place: Vec3) -> [u64; 3] {
    place.to_array().map(|part| (part + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;
    use agglo::units::Quantity;
    use agglo::walls::{Cuboid, Cylinder, Shape, Side};

    fn sheets(shape: &Shape) -> Vec<Sheet> {
        let of = |corners| Sheet { corners, wall: 0 };
        shape.triangles(Vec3::ZERO, 1.0).into_iter().map(of).collect()
    }

    fn cube(side: Side) -> Shape {
        let corner = |at: f64| [Quantity(at); 3];
        Shape::Box(Cuboid { lower: corner(-1.0), upper: corner(1.0), side })
    }

    #[test]
    fn a_sheet_is_met_from_the_side_of_the_grains() {
        let sheet = Sheet { corners: [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]].map(Vec3::from), wall: 0 };
        let down = |x: f64, y: f64| sheet.hit(&Ray::new(Vec3::new(x, y, 3.0), -Vec3::AXES[2]));
        assert_eq!(down(0.5, 0.5), Some((3.0, Vec3::AXES[2])));
        // Beyond its longest side, and beyond the other two.
        assert_eq!((down(1.1, 1.0), down(-0.1, 0.5), down(0.5, -0.1)), (None, None, None));
        assert_none!(sheet.hit(&Ray::new(Vec3::new(0.5, 0.5, -3.0), Vec3::AXES[2])), "from behind");
        assert_none!(
            sheet.hit(&Ray::new(Vec3::new(0.5, 0.5, -3.0), -Vec3::AXES[2])),
            "it lies behind the eye"
        );
    }

    /// Into a box one sees its far faces, onto one its near faces: three of either, and of a ray through its middle one.
    #[test]
    fn vessels_are_open_to_the_eye() {
        let eye = Vec3::new(-9.0, -5.0, 4.0);
        let ray = Ray::new(eye, (-eye).normalized());
        for (side, wanted) in [(Side::Inside, 1.0), (Side::Outside, -1.0)] {
            let found: Vec<f64> =
                sheets(&cube(side)).iter().filter_map(|sheet| sheet.hit(&ray)).map(|hit| hit.0).collect();
            // Where the line meets the faces across x: 1 over 9 of the way from the middle.
            assert_eq!(found.len(), 1, "faces on the line of sight: {found:?}");
            assert_near!(found[0], eye.norm() * (1.0 + wanted / 9.0), 1e-12, "in m");
        }
    }

    /// A cube has its twelve edges, whatever the eye; a pipe its two rims, and two lines along which it turns away.
    #[test]
    fn edges_are_where_faces_meet() {
        let eye = Vec3::new(-9.0, -5.0, 4.0);
        assert_eq!(edges(&sheets(&cube(Side::Inside)), eye).len(), 12);
        let pipe = Shape::Cylinder(Cylinder {
            point: [Quantity(0.0); 3],
            axis: [0.0, 0.0, 1.0],
            radius: Quantity(1.0),
            length: None,
            side: Side::Inside,
        });
        let found = edges(&sheets(&pipe), eye);
        let along = |ends: &&[Vec3; 2]| (ends[1] - ends[0]).norm() > 1.0;
        let (turns, rims): (Vec<&[Vec3; 2]>, Vec<&[Vec3; 2]>) = found.iter().partition(along);
        assert_eq!((turns.len(), rims.len()), (2, 2 * 48), "lines along the pipe, and pieces of its rims");
        // Where lines of sight touch the pipe: at 1/distance from the direction to the eye, up to a piece of the circle.
        let level = Vec3::new(eye.x, eye.y, 0.0);
        for [end, _] in turns {
            let angle = Vec3::new(end.x, end.y, 0.0).dot(level.normalized()).acos();
            assert_near!(angle, (1.0 / level.norm()).acos(), std::f64::consts::TAU / 48.0, "in rad");
        }
    }
}
