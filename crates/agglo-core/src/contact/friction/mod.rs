//! Resistance to sliding: one law of the paper without memory, one with a spring that each contact keeps.

mod law;
mod mindlin;
mod regularized;
mod spring;

pub use law::{FrictionLaw, Sliding};
pub use spring::{Memory, TangentialSpring};

use super::{ContactGeometry, Elastic, PairConstants};
use crate::math::{Pace, Real, Vector};
use crate::particles::Mixture;

family! {
    /// The closed set of friction laws.
    pub enum Friction at "contact.friction", pages in "contact/friction", each by each_friction ($) {
        Regularized in regularized: "The paper's regularized law (Zohdi 2016, eqs 20-24); its stick force carries the time step and does not converge.";
        Mindlin in mindlin: "Mindlin / Cundall-Strack: a tangential spring kept per contact.";
    }
}

impl Friction {
    /// Whether contacts remember anything for the law.
    #[inline]
    pub fn has_memory(&self) -> bool {
        fn of<L: FrictionLaw>(_: &L) -> bool {
            <L::Memory<f64> as Memory<f64>>::IS_KEPT
        }
        each_friction!(self, law => of(law))
    }

    /// The force on i [N] and what to remember.
    #[inline(always)]
    pub fn force<F: Real>(
        &self,
        pair: &PairConstants<F>,
        geometry: &ContactGeometry<F>,
        sliding: &Sliding<F>,
        before: &TangentialSpring<F>,
    ) -> (Vector<F>, TangentialSpring<F>) {
        each_friction!(self, law => {
            let (force, memory) = law.force(pair, geometry, sliding, &Memory::taken_from(before));
            (force, memory.kept())
        })
    }

    /// How fast it is, with the elastic law and the normal dashpot [N s/m].
    pub fn pace(
        &self,
        pair: &PairConstants,
        geometry: &ContactGeometry,
        elastic: &Elastic,
        dashpot: f64,
    ) -> Pace {
        each_friction!(self, law => law.pace(pair, geometry, elastic, dashpot))
    }

    /// Writes down the coefficients for a pair of materials, or what the pair has by itself.
    pub fn settle(&self, pair: &mut PairConstants, own: Option<&Mixture>) {
        each_friction!(self, law => law.settle(pair, own));
    }

    /// Static friction, and dynamic friction where the law has one of its own.
    pub fn coefficients(&self) -> (f64, Option<f64>) {
        each_friction!(self, law => law.coefficients())
    }

    /// Whether it can outgrow the elastic contact, so that only the overlap of the moment says how fast it is.
    pub fn outgrows_contact(&self) -> bool {
        each_friction!(self, law => law.outgrows_contact())
    }
}
