//! Forces on single grains, and between grains at a distance.

mod custom;
mod drag;
mod expression;
mod flow;
mod gravity;
mod law;
mod lorentz;
mod magnetic;
pub mod near_field;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use custom::{FieldFormula, OfGrain};
pub use drag::{Drag, DragLaw, Validity, rotational_drag};
pub use expression::{Expression, FieldVector, evaluate};
pub use flow::{Flow, FlowAt, FlowField};
pub use law::{Channel, FieldLaw, Grain, Part};
pub use near_field::NearField;

use crate::law::{Chosen, Entry};
use crate::math::{Pace, Vec3};
use crate::pages::Page;

/// Makes the table of fields from the list of forces on single grains, and all by which the rest of the program knows
/// them: `word: Law, page word, "what it is";`. The law is `word::Law`, and its page is at the head of that file.
macro_rules! fields {
    ($($word:ident: $Law:ident, page $page:ident, $says:tt;)+) => {
        $(pub use $word::$Law;)+

        /// The fields of a scenario; each is off if left out.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub struct Fields {
            $(
                #[doc = $says]
                #[serde(default, skip_serializing_if = "Option::is_none")]
                pub $word: Option<$Law>,
            )+
            /// Drag of the medium.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub drag: Option<Drag>,
            /// Attraction and repulsion between grains at a distance.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub near_field: Option<NearField>,
        }

        $(lone_law!($Law at "fields", $word, page $page);)+

        impl Fields {
            /// All laws of the table, but for those of the near field.
            pub const LAWS: &'static [Entry] = &[$($Law::ENTRY,)+ Drag::ENTRY];

            /// Their pages.
            pub const PAGES: &'static [Page] = &[$($Law::PAGE,)+ Drag::PAGE];

            /// Paths of the forces on single grains, in their order.
            pub const SINGLE: &'static [&'static str] = &[$(concat!("fields.", stringify!($word))),+];

            /// All that the scenario has chosen.
            pub fn chosen(&self) -> impl Iterator<Item = Chosen<'_>> {
                [
                    $(self.$word.as_ref().map($Law::chosen),)+
                    self.drag.as_ref().map(Drag::chosen),
                    self.near_field.as_ref().map(NearField::chosen),
                ]
                .into_iter()
                .flatten()
            }

            /// Looks at each part of the force of each field on a grain.
            #[inline]
            pub fn each_part(&self, grain: &Grain, mut look: impl FnMut(Part)) {
                $(if let Some(law) = &self.$word {
                    FieldLaw::parts(law, grain).into_iter().flatten().for_each(&mut look);
                })+
            }

            /// Energy stored [J] by a grain in the fields whose energy is known.
            pub fn energy(&self, grain: &Grain) -> f64 {
                let mut sum = 0.0;
                $(sum += self.$word.as_ref().map_or(0.0, |law| FieldLaw::energy(law, grain));)+
                sum
            }

            /// Whether a field stores energy.
            pub fn store(&self) -> bool {
                $(self.$word.as_ref().is_some_and(FieldLaw::stores))||+
            }

            /// How fast each field is where this mass [kg] resists it, in the order of [`Self::SINGLE`].
            pub fn paces(&self, grain: &Grain, mass: f64) -> [Pace; Self::SINGLE.len()] {
                [$(self.$word.as_ref().map_or(Pace::NONE, |law| FieldLaw::pace(law, grain, mass))),+]
            }

            /// What all fields turn the velocity of a grain by [kg/s].
            #[inline]
            pub fn turning(&self, grain: &Grain) -> Vec3 {
                let mut sum = Vec3::ZERO;
                $(if let Some(law) = self.$word.as_ref().filter(|law| law.turns()) {
                    sum += FieldLaw::turning(law, grain);
                })+
                sum
            }

            /// Whether a field turns velocities.
            pub fn turn(&self) -> bool {
                $(self.$word.as_ref().is_some_and(FieldLaw::turns))||+
            }

            /// Whether a field acts on charges alone.
            pub fn are_by_charge(&self) -> bool {
                self.near_field.as_ref().is_some_and(|field| field.law.is_by_charge())
                    $(|| self.$word.as_ref().is_some_and(FieldLaw::is_by_charge))+
            }

            /// Whether a force acts on single grains.
            pub fn has_single(&self) -> bool {
                self.drag.is_some() $(|| self.$word.is_some())+
            }
        }
    };
}

fields! {
    gravity: Gravity, page gravity, "Weight, with buoyancy if wanted.";
    lorentz: Lorentz, page lorentz, "Electric and magnetic force on charges.";
    magnetic: Magnetic, page magnetic, "Magnetic force on magnetizable grains.";
    custom: Custom, page custom_field, "A force as formulas of place, velocity and time.";
}
