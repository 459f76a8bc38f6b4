//! The laws of contact of a scenario, taken together.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Damping, Elastic, Friction, Normal, PairConstants, Touch};
use crate::law::Chosen;
use crate::math::{Pace, Real};
use crate::particles::Mixture;

/// The laws of contact of a scenario: what repels, what dissipates, what resists sliding.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactLaws {
    /// The elastic repulsion along the line of centers.
    pub normal: Normal,
    /// The dissipation along the line of centers; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<Damping>,
    /// The resistance to sliding; none if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
}

impl ContactLaws {
    /// All that the scenario has chosen.
    pub fn chosen(&self) -> impl Iterator<Item = Chosen<'_>> {
        let damping = self.damping.iter().map(Damping::chosen);
        let friction = self.friction.iter().map(Friction::chosen);
        std::iter::once(self.normal.chosen()).chain(damping).chain(friction)
    }

    /// Whether contacts have a memory.
    #[inline]
    pub fn has_memory(&self) -> bool {
        self.friction.as_ref().is_some_and(Friction::has_memory)
    }

    /// Whether damping or friction takes the stiffness of the elastic law.
    #[inline]
    pub fn takes_stiffness(&self) -> bool {
        self.has_memory() || self.damping.as_ref().is_some_and(Damping::takes_stiffness)
    }

    /// Writes down what the laws have for a pair of materials, or what the pair has by itself.
    pub fn settle(&self, pair: &mut PairConstants, own: Option<&Mixture>) {
        if let Some(law) = &self.damping {
            law.settle(pair, own);
        }
        if let Some(law) = &self.friction {
            law.settle(pair, own);
        }
    }

    /// What the elastic law makes of a contact.
    #[inline]
    pub fn elastic<F: Real>(
        &self,
        pair: &PairConstants<F>,
        touch: &Touch<F>,
        with_stiffness: bool,
    ) -> Elastic<F> {
        let stiffness =
            if with_stiffness { self.normal.tangent_stiffness(pair, touch) } else { F::default() };
        Elastic { force: self.normal.force(pair, touch), stiffness, exponent: self.normal.exponent() }
    }

    /// How fast the laws are in a contact with this overlap: along the line of centers or across it.
    pub fn pace(&self, pair: &PairConstants, touch: &Touch) -> Pace {
        let (elastic, mass) = (self.elastic(pair, touch, true), touch.effective_mass);
        let spring = self.normal.pace(pair, touch);
        let dashpot = self.damping.as_ref().map_or(Pace::NONE, |law| law.pace(pair, touch, &elastic));
        // A law across the line of centers follows the stiffest that the contact was on its way to this overlap.
        let stiffest = Elastic { stiffness: spring.square * mass, ..elastic };
        let across = self
            .friction
            .as_ref()
            .map_or(Pace::NONE, |law| law.pace(pair, touch, &stiffest, dashpot.rate * mass));
        (spring + dashpot).max(across)
    }

    /// The laws without those that can outgrow the elastic contact: how fast the rest is at the deepest overlap holds
    /// for all others.
    #[must_use]
    pub fn bounded(&self) -> Self {
        let damping = self.damping.clone().filter(|law| !law.outgrows_contact());
        let friction = self.friction.clone().filter(|law| !law.outgrows_contact());
        Self { normal: self.normal.clone(), damping, friction }
    }

    /// Whether one of the laws can outgrow the elastic contact.
    pub fn outgrow_contact(&self) -> bool {
        self.damping.as_ref().is_some_and(Damping::outgrows_contact)
            || self.friction.as_ref().is_some_and(Friction::outgrows_contact)
    }
}
