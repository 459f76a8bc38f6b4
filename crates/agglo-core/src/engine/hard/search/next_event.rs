//! What a sphere does next, and where it is filed: one cache line per sphere.

use serde::{Deserialize, Serialize};

use crate::engine::hard::spheres::NONE;

/// What a sphere does next, and where it is filed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[repr(C, align(64))]
pub struct NextEvent {
    /// Time of its next collision [s]. Without a partner it is the time before which it has none, and at which it must look
    /// again. Infinite where none is known.
    pub collision: f64,
    /// Time at which it leaves its cell or comes to a wall [s].
    pub crossing: f64,
    /// Its id, which decides between events of one moment.
    pub id: u32,
    /// Its cell; beyond the grid where the volume is open.
    pub cell: [i32; 3],
    /// Whom it collides with; [`NONE`] if it must look again.
    pub partner: u32,
    /// Number of the cell in its level.
    #[serde(skip)]
    pub flat: u32,
    /// Its time bin.
    #[serde(skip)]
    pub bin: u32,
    /// Edges of the volume that are added to the partner's position.
    pub image: [i8; 3],
    /// Its level of the grid; [`NextEvent::NOWHERE`] for an empty slot.
    pub level: u8,
    /// What `crossing` is.
    pub exit: Exit,
}

/// How a sphere leaves its cell: through a cell's face, or stopped by a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Exit {
    /// 0, 1, 2 for x, y, z.
    pub axis: u8,
    /// 1 or -1.
    pub side: i8,
    /// Whether there is a wall.
    pub is_wall: bool,
}

impl NextEvent {
    /// Level of an empty slot.
    pub const NOWHERE: u8 = u8::MAX;

    /// Of an empty slot.
    pub const EMPTY: Self = Self {
        collision: f64::INFINITY,
        crossing: f64::INFINITY,
        id: NONE,
        cell: [0; 3],
        partner: NONE,
        flat: NONE,
        bin: NONE,
        image: [0; 3],
        level: Self::NOWHERE,
        exit: Exit { axis: 0, side: 1, is_wall: false },
    };

    /// The collision with the partner is so many edges of the volume farther along an axis.
    #[inline]
    pub fn shift(&mut self, axis: usize, edges: i8) {
        self.image[axis] = self.image[axis].saturating_add(edges);
    }

    /// Time of its next event [s].
    #[inline]
    pub fn due(&self) -> f64 {
        self.collision.min(self.crossing)
    }
}
