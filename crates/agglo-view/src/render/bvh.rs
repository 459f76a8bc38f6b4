//! A tree of boxes: which solids a ray may meet.

use agglo::math::Vec3;

/// A box with edges along the axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub lower: Vec3,
    pub upper: Vec3,
}

impl Bounds {
    const NOTHING: Self = Self {
        lower: Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        upper: Vec3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The box about a sphere.
    pub fn of_sphere(center: Vec3, radius: f64) -> Self {
        let reach = Vec3::new(radius, radius, radius);
        Self { lower: center - reach, upper: center + reach }
    }

    /// The box about both.
    pub fn and(self, other: Self) -> Self {
        Self { lower: self.lower.min(other.lower), upper: self.upper.max(other.upper) }
    }

    fn center(&self) -> Vec3 {
        (self.lower + self.upper) * 0.5
    }

    /// Half of its surface; nothing for the empty box.
    fn area(&self) -> f64 {
        let d = self.upper - self.lower;
        if d.x < 0.0 { 0.0 } else { d.x * d.y + d.y * d.z + d.z * d.x }
    }
}

/// A ray with what box tests need.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub origin: Vec3,
    /// Of length one.
    pub direction: Vec3,
    inverse: Vec3,
}

impl Ray {
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        let inverse = Vec3::new(1.0 / direction.x, 1.0 / direction.y, 1.0 / direction.z);
        Self { origin, direction, inverse }
    }

    pub fn at(&self, distance: f64) -> Vec3 {
        self.origin + self.direction * distance
    }

    /// Where the ray enters a box, at most `limit` away; infinite if it does not.
    #[inline]
    fn entry(&self, bounds: &Bounds, limit: f64) -> f64 {
        let (mut near, mut far) = (0.0, limit);
        for axis in 0..3 {
            let to_lower = (bounds.lower[axis] - self.origin[axis]) * self.inverse[axis];
            let to_upper = (bounds.upper[axis] - self.origin[axis]) * self.inverse[axis];
            // Not `f64::min`: where a ray runs in a face's plane this is not a number, and comparisons are false.
            let (first, last) = if to_lower < to_upper { (to_lower, to_upper) } else { (to_upper, to_lower) };
            near = if first > near { first } else { near };
            far = if last < far { last } else { far };
        }
        if near <= far { near } else { f64::INFINITY }
    }
}

/// An inner node has its first child right behind it and its second at `at`; a leaf has `count` solids from `at` on.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    at: u32,
    count: u32,
}

/// A tree over solids, which it puts into an order of its own: the *slots*.
#[derive(Debug, Default)]
pub(super) struct Bvh {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

/// Most solids of a leaf.
const LEAF: usize = 3;
/// Candidates for a cut.
const BINS: usize = 12;
/// From this depth on nodes are halved by number, so that the stack of a walk suffices: 40 + log2(2^32) < 80.
const UNBALANCED: usize = 40;
const STACK: usize = 80;

impl Bvh {
    /// A tree over solids with these bounds.
    pub fn new(bounds: &[Bounds]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: (0..bounds.len() as u32).collect() };
        if !bounds.is_empty() {
            tree.build(bounds, 0, bounds.len(), 0);
        }
        tree
    }

    /// The solid in each slot.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    fn build(&mut self, bounds: &[Bounds], from: usize, to: usize, depth: usize) {
        let slots = &self.order[from..to];
        let whole = slots.iter().fold(Bounds::NOTHING, |all, &solid| all.and(bounds[solid as usize]));
        let this = self.nodes.len();
        self.nodes.push(Node { bounds: whole, at: from as u32, count: (to - from) as u32 });
        if to - from <= LEAF {
            return;
        }
        let middle = from + self.cut(bounds, from, to, depth);
        self.build(bounds, from, middle, depth + 1);
        self.nodes[this] = Node { bounds: whole, at: self.nodes.len() as u32, count: 0 };
        self.build(bounds, middle, to, depth + 1);
    }

    /// Sorts the slots into two parts and returns the length of the first. Where to cut is judged by the surfaces of
    /// the parts, which tell how many rays will meet them.
    fn cut(&mut self, bounds: &[Bounds], from: usize, to: usize, depth: usize) -> usize {
        let slots = &mut self.order[from..to];
        let center = |solid: u32| bounds[solid as usize].center();
        let span = slots.iter().fold(Bounds::NOTHING, |all, &solid| {
            all.and(Bounds { lower: center(solid), upper: center(solid) })
        });
        let extent = span.upper - span.lower;
        let axis =
            (0..3).fold(0, |longest, axis| if extent[axis] > extent[longest] { axis } else { longest });
        let bin_of = |solid: u32| {
            let part = (center(solid)[axis] - span.lower[axis]) / extent[axis];
            ((part * BINS as f64) as usize).min(BINS - 1)
        };
        let half = slots.len() / 2;
        if depth < UNBALANCED && extent[axis] > 0.0 {
            let bin = best_bin(slots, bounds, &bin_of);
            let (first, second): (Vec<u32>, Vec<u32>) =
                slots.iter().partition(|&&solid| bin_of(solid) <= bin);
            if !first.is_empty() && !second.is_empty() {
                let (left, right) = slots.split_at_mut(first.len());
                left.copy_from_slice(&first);
                right.copy_from_slice(&second);
                return first.len();
            }
        }
        slots.select_nth_unstable_by(half, |&a, &b| {
            center(a)[axis].total_cmp(&center(b)[axis]).then_with(|| a.cmp(&b))
        });
        half
    }

    /// The nearest solid within `limit` and its distance; `hit` tells where the ray meets the solid in a slot.
    #[inline]
    pub fn nearest(
        &self,
        ray: &Ray,
        mut limit: f64,
        hit: impl Fn(usize) -> Option<f64>,
    ) -> Option<(usize, f64)> {
        let mut found = None;
        let mut stack = [(0_u32, 0.0_f64); STACK];
        let mut height = 0;
        let root = self.nodes.first()?;
        let mut next = Some((0_usize, ray.entry(&root.bounds, limit)));
        while let Some((at, entry)) = next {
            if entry < limit {
                let node = &self.nodes[at];
                if node.count == 0 {
                    let (left, right) = (at + 1, node.at as usize);
                    let to_left = ray.entry(&self.nodes[left].bounds, limit);
                    let to_right = ray.entry(&self.nodes[right].bounds, limit);
                    let near_is_left = to_left <= to_right;
                    let (near, far) = if near_is_left { (left, right) } else { (right, left) };
                    let (to_near, to_far) =
                        if near_is_left { (to_left, to_right) } else { (to_right, to_left) };
                    if to_far < limit {
                        stack[height] = (far as u32, to_far);
                        height += 1;
                    }
                    next = Some((near, to_near));
                    continue;
                }
                for slot in node.at as usize..(node.at + node.count) as usize {
                    if let Some(distance) = hit(slot).filter(|&distance| distance < limit) {
                        limit = distance;
                        found = Some((slot, distance));
                    }
                }
            }
            next = height.checked_sub(1).map(|top| {
                height = top;
                (stack[top].0 as usize, stack[top].1)
            });
        }
        found
    }

    /// Goes through the solids whose boxes `enters` lets in, until `visit` returns false.
    #[inline]
    pub fn walk(&self, enters: impl Fn(&Bounds) -> bool, mut visit: impl FnMut(usize) -> bool) {
        let mut stack = [0_u32; STACK];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let at = stack[height] as usize;
            let node = &self.nodes[at];
            if !enters(&node.bounds) {
                continue;
            }
            if node.count == 0 {
                (stack[height], stack[height + 1]) = (node.at, at as u32 + 1);
                height += 2;
            } else if !(node.at..node.at + node.count).all(|slot| visit(slot as usize)) {
                return;
            }
        }
    }

    /// Whether the ray meets any solid; `hits` tells of the solid in a slot.
    #[inline]
    pub fn meets(&self, ray: &Ray, mut hits: impl FnMut(usize) -> bool) -> bool {
        let mut met = false;
        self.walk(
            |bounds| ray.entry(bounds, f64::INFINITY).is_finite(),
            |slot| {
                met = hits(slot);
                !met
            },
        );
        met
    }
}

/// The bin after which the cut costs least.
fn best_bin(slots: &[u32], bounds: &[Bounds], bin_of: &impl Fn(u32) -> usize) -> usize {
    let mut bins = [(Bounds::NOTHING, 0_usize); BINS];
    for &solid in slots {
        let bin = &mut bins[bin_of(solid)];
        *bin = (bin.0.and(bounds[solid as usize]), bin.1 + 1);
    }
    let join = |a: (Bounds, usize), b: &(Bounds, usize)| (a.0.and(b.0), a.1 + b.1);
    let cost = |bin: usize| {
        let (left, right) = bins.split_at(bin + 1);
        let cost_of = |part: &[(Bounds, usize)]| {
            let (bounds, count) = part.iter().fold((Bounds::NOTHING, 0), join);
            bounds.area() * count as f64
        };
        cost_of(left) + cost_of(right)
    };
    let costs = (0..BINS - 1).map(cost);
    let best = costs.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
    best.map_or(0, |(bin, _)| bin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::solid::Sphere;
    use agglo::math::rng::{Purpose, Stream};

    fn cloud(count: usize, stream: &mut Stream) -> Vec<Sphere> {
        let sphere = |_| Sphere {
            center: stream.direction() * stream.uniform(),
            radius: 0.2 * stream.uniform().powi(3),
            color: [1.0; 3],
        };
        (0..count).map(sphere).collect()
    }

    /// The same solid at the same distance, to the last bit: both ask the same function.
    #[test]
    fn rays_find_what_brute_force_finds() {
        let mut stream = Stream::new(3, Purpose::Sampling, 0);
        let mut met = 0;
        for count in [0, 1, 3, 4, 17, 400] {
            let spheres = cloud(count, &mut stream);
            let bounds: Vec<Bounds> = spheres.iter().map(Sphere::bounds).collect();
            let tree = Bvh::new(&bounds);
            let in_slot = |slot: usize| &spheres[tree.order()[slot] as usize];
            for k in 0..3000 {
                let origin = stream.direction() * (2.0 * stream.uniform());
                // Along axes too, where box tests divide by zero.
                let direction = if k % 10 == 0 { Vec3::AXES[k % 3] } else { stream.direction() };
                let ray = Ray::new(origin, direction);
                let hits = spheres.iter().enumerate().filter_map(|(k, sphere)| Some((sphere.hit(&ray)?, k)));
                let wanted = hits.min_by(|a, b| a.0.total_cmp(&b.0));
                let found = tree.nearest(&ray, f64::INFINITY, |slot| in_slot(slot).hit(&ray));
                let found = found.map(|(slot, distance)| (distance, tree.order()[slot] as usize));
                assert_eq!(found, wanted);
                assert_eq!(tree.meets(&ray, |slot| in_slot(slot).hit(&ray).is_some()), wanted.is_some());
                met += usize::from(wanted.is_some());
            }
        }
        assert!(met > 1000, "{met} hits are too few to tell anything");
    }

    /// Solids in one place cannot be told apart by cuts in space, and very uneven ones make deep trees.
    #[test]
    fn heaps_and_uneven_clouds_are_cut_too() {
        let same = vec![Bounds::of_sphere(Vec3::ZERO, 1.0); 1000];
        let uneven: Vec<Bounds> =
            (0..1000).map(|k| Bounds::of_sphere(Vec3::new(2_f64.powi(k - 500), 0.0, 0.0), 1e-200)).collect();
        for bounds in [same, uneven] {
            let tree = Bvh::new(&bounds);
            let mut slots = 0;
            tree.walk(
                |_| true,
                |_| {
                    slots += 1;
                    true
                },
            );
            assert_eq!(slots, 1000);
            let mut order = tree.order().to_vec();
            order.sort_unstable();
            assert_eq!(order, (0..1000).collect::<Vec<_>>(), "each sphere once");
        }
    }
}
