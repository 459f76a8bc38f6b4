//! Rays in space that repeats itself: the grid holds the images of spheres that reach into the block, and a ray is walked through it
//! piece by piece, from face to face, without being moved.
//!
//! Where a ray meets an image is worked out from its origin, from where the sphere is at home and from by how many periods the image is
//! away, whatever way led there: so a hit has the same bits however the way was cut into steps, and whichever of its images the grid has a
//! sphere under. Pieces and cells only say which images are tested.

use super::span::{RaySpan, Sphere, SphereHit};
use crate::domain::{Image, Space};
use crate::math::Vec3;

/// Images of spheres, as a grid was built of them.
#[derive(Clone, Debug)]
pub(super) struct Around {
    space: Space,
    /// The spheres as they were when the grid was built.
    homes: Vec<Sphere>,
    /// How many periods each would be away by now if it had not come back in, the other way about.
    back: Vec<Image>,
    /// What the grid has: a sphere, and in which image.
    images: Vec<(u32, Image)>,
}

/// The nearest image of a sphere that a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageHit {
    /// Distance from the span's origin, and number of the sphere.
    pub hit: SphereHit,
    /// Way [m] from the sphere to its image.
    pub shift: Vec3,
}

fn sum(a: Image, b: Image) -> Image {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// A ray's passage through one image of the block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub image: Image,
    pub from: f64,
    pub to: f64,
    /// Along which axis it goes on, and whether up.
    onward: Option<(usize, bool)>,
}

impl Around {
    pub fn new(space: Space) -> Self {
        Self { space, homes: Vec::new(), back: Vec::new(), images: Vec::new() }
    }

    pub fn space(&self) -> &Space {
        &self.space
    }

    /// Whether no sphere is farther than the margin [m] from where it was when the grid was built; tells in passing in which image each of
    /// them is now.
    pub fn follow(&mut self, spheres: &[Sphere], margin: f64) -> bool {
        let Self { space, homes, back, .. } = self;
        spheres.len() == homes.len()
            && spheres.iter().zip(homes).zip(back).all(|((now, then), back)| {
                let moved = now.center - then.center;
                let shortest = space.shortest(moved);
                *back = space.periods_between(moved, shortest);
                let room = margin - (now.radius - then.radius);
                room >= 0.0 && shortest.norm_squared() <= room * room
            })
    }

    /// The images that reach into the block, in the order of their spheres.
    pub fn images_of(
        &mut self,
        spheres: &[Sphere],
        reaches: impl Fn(Sphere) -> bool,
        built: &mut Vec<Sphere>,
    ) {
        self.homes.clear();
        self.homes.extend_from_slice(spheres);
        self.back.clear();
        self.back.resize(spheres.len(), [0; 3]);
        self.images.clear();
        let [xs, ys, zs] = [0, 1, 2].map(|axis| if self.space.repeats_along(axis) { -1..=1 } else { 0..=0 });
        for (number, sphere) in (0..).zip(spheres) {
            for image in xs.clone().flat_map(|x| {
                let zs = zs.clone();
                ys.clone().flat_map(move |y| zs.clone().map(move |z| [x, y, z]))
            }) {
                let there = Sphere { center: sphere.center + self.space.shift_to(image), ..*sphere };
                if reaches(there) {
                    self.images.push((number, image));
                    built.push(there);
                }
            }
        }
    }

    /// The sphere of an entry of the grid, and in which image it is for a ray on a piece of its way.
    pub fn image_of(&self, entry: u32, piece: Image) -> (u32, Image) {
        let (sphere, image) = self.images[entry as usize];
        (sphere, sum(sum(image, self.back[sphere as usize]), piece))
    }

    /// The passage that a ray is on at a distance [m] through an image of the block, up to another [m].
    fn piece(&self, span: &RaySpan, image: Image, from: f64, to: f64) -> Piece {
        let (shift, [lower, upper]) = (self.space.shift_to(image), self.space.corners());
        let mut piece = Piece { image, from, to, onward: None };
        for axis in (0..3).filter(|axis| self.space.repeats_along(*axis) && span.direction[*axis] != 0.0) {
            let up = span.direction[axis] > 0.0;
            let face = if up { upper[axis] } else { lower[axis] } + shift[axis];
            let at = (face - span.origin[axis]) / span.direction[axis];
            if at < piece.to {
                (piece.to, piece.onward) = (at, Some((axis, up)));
            }
        }
        piece
    }

    /// The passages of a ray one by one, until `visit`, which gives the distance [m] beyond which nothing matters, is before the next.
    pub fn pieces(&self, span: &RaySpan, mut visit: impl FnMut(&Piece) -> f64) {
        let image = self.space.image_at(span.origin + span.direction * span.from);
        let mut piece = self.piece(span, image, span.from, span.to);
        loop {
            let most = visit(&piece);
            let Some((axis, up)) = piece.onward.filter(|_| piece.to <= most) else { return };
            let mut image = piece.image;
            image[axis] += if up { 1 } else { -1 };
            piece = self.piece(span, image, piece.to, span.to);
        }
    }

    /// The image that a ray has just left, if it left any: that which is nearest to its origin. A grain that it left has moved by far less
    /// than a period since.
    pub fn left(&self, span: &RaySpan, spheres: &[Sphere]) -> Option<Image> {
        let center = spheres.get(span.skip as usize)?.center;
        let away = span.origin - center;
        Some(self.space.periods_between(self.space.shortest(away), away))
    }
}
