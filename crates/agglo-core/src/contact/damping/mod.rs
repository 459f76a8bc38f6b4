//! Dissipation along the line of centers.

mod law;
mod restitution;
mod viscous_area;

pub use law::DampingLaw;
pub use restitution::damping_ratio;

use super::{ContactGeometry, Elastic, PairConstants};
use crate::math::{Pace, Real};
use crate::particles::Mixture;

family! {
    /// The closed set of normal damping laws; each is a dashpot whose coefficient depends on the contact.
    pub enum Damping at "contact.damping", pages in "contact/damping", each by each_damping ($) {
        ViscousArea in viscous_area: "Coefficient times contact area (Zohdi 2016, eq. 19).";
        Restitution in restitution: "Coefficient from a coefficient of restitution (Tsuji; Antypov and Elliott).";
    }
}

impl Damping {
    /// Whether the coefficient takes the stiffness of the elastic law.
    #[inline]
    pub fn takes_stiffness(&self) -> bool {
        fn of<L: DampingLaw>(_: &L) -> bool {
            L::TAKES_STIFFNESS
        }
        each_damping!(self, law => of(law))
    }

    /// Dashpot coefficient c [N s/m]; the force on the pair is -c times the speed of separation.
    #[inline(always)]
    pub fn coefficient<F: Real>(
        &self,
        pair: &PairConstants<F>,
        geometry: &ContactGeometry<F>,
        elastic: &Elastic<F>,
    ) -> F {
        each_damping!(self, law => law.coefficient(pair, geometry, elastic))
    }

    /// Writes down what it has for a pair of materials, or what the pair has by itself.
    pub fn settle(&self, pair: &mut PairConstants, own: Option<&Mixture>) {
        each_damping!(self, law => law.settle(pair, own));
    }

    /// Whether a pair of materials can have a restitution of its own.
    pub fn reads_restitution(&self) -> bool {
        each_damping!(self, law => law.reads_restitution())
    }

    /// How fast the dashpot is at this overlap.
    pub fn pace(&self, pair: &PairConstants, geometry: &ContactGeometry, elastic: &Elastic) -> Pace {
        Pace::of_dashpot(self.coefficient(pair, geometry, elastic), geometry.effective_mass)
    }

    /// Whether it can outgrow the elastic contact, so that only the overlap of the moment says how fast it is.
    pub fn outgrows_contact(&self) -> bool {
        each_damping!(self, law => law.outgrows_contact())
    }
}
