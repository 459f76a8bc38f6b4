//! The laws of contact of a scenario, taken together.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::elastic::damped_part;
use super::{ContactGeometry, Custom, Damping, Elastic, Friction, Normal, PairConstants};
use crate::law::{Chosen, Faults, HIGHEST_EXPONENT};
use crate::math::Pace;
use crate::math::lanes::Lanes;
use crate::math::roots::root_between;
use crate::particles::{Material, Mixture};

/// What the laws of a scenario make of a contact along the line of centers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Along<F = f64> {
    /// What the elastic laws make of it; the stiffness only where another law takes it.
    pub elastic: Elastic<F>,
    /// Dashpot coefficient [N s/m].
    pub dashpot: F,
    /// Force on each grain, away from the other [N].
    pub repulsion: F,
    /// What is lost [W].
    pub dissipation: F,
    /// What a formula that drives the grains puts in [W].
    pub driven: F,
}

/// The laws of contact of a scenario: what repels, what dissipates, what resists sliding.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactLaws {
    /// The elastic repulsion along the line of centers; it or `custom` must be given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<Normal>,
    /// A force along the line of centers as a formula, which adds to `normal`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub custom: Option<Custom>,
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
        let along = self.normal.iter().map(Normal::chosen).chain(self.custom.iter().map(Custom::chosen));
        let damping = self.damping.iter().map(Damping::chosen);
        let friction = self.friction.iter().map(Friction::chosen);
        along.chain(damping).chain(friction)
    }

    /// What is wrong with the laws together; keys are relative to the table of contact.
    pub fn faults(&self, faults: &mut Faults) {
        if self.normal.is_none() && self.custom.is_none() {
            let message =
                "has neither normal nor custom: nothing would act along the line of centers".to_owned();
            faults.fail_with("", message, "for example [contact.normal.hertz]");
        }
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

    /// What the elastic laws make of a contact: what is built in where grains touch, and the formula at rest.
    #[inline(always)]
    pub fn elastic<F: Lanes>(
        &self,
        pair: &PairConstants<F>,
        geometry: &ContactGeometry<F>,
        with_stiffness: bool,
    ) -> Elastic<F> {
        let mut elastic = Elastic::default();
        let zero = F::of(0.0);
        if let Some(law) = &self.normal {
            let touches = zero.below(geometry.overlap);
            elastic.force = F::select(touches, law.force(pair, geometry), zero);
            elastic.damped_part = F::of(damped_part(law.exponent()));
            if with_stiffness {
                elastic.stiffness = F::select(touches, law.tangent_stiffness(pair, geometry), zero);
            }
        }
        if let Some(law) = &self.custom {
            let force = F::from_lanes(|lane| law.force(&pair.lane(lane), &geometry.lane(lane), 0.0));
            elastic.force = elastic.force + force;
            if with_stiffness {
                let slope = F::from_lanes(|lane| law.slopes(&pair.lane(lane), &geometry.lane(lane), 0.0)[0]);
                elastic.stiffness = elastic.stiffness + slope;
                elastic.damped_part = F::of(0.5) + F::of(0.5) / local_exponent(&elastic, geometry.overlap);
            }
        }
        elastic
    }

    /// What the laws make of a contact along the line of centers, whose grains part at `separation` [m/s].
    #[inline(always)]
    pub fn along<F: Lanes>(
        &self,
        pair: &PairConstants<F>,
        geometry: &ContactGeometry<F>,
        separation: F,
    ) -> Along<F> {
        let zero = F::of(0.0);
        let elastic = self.elastic(pair, geometry, self.takes_stiffness());
        let mut dashpot = zero;
        if let Some(law) = &self.damping {
            let touches = zero.below(geometry.overlap);
            dashpot = F::select(touches, law.coefficient(pair, geometry, &elastic), zero);
        }
        let resisted = dashpot * separation;
        let mut along = Along {
            elastic,
            dashpot,
            repulsion: elastic.force - resisted,
            dissipation: resisted * separation,
            driven: zero,
        };
        if let Some(law) = &self.custom {
            let beyond_rest = F::from_lanes(|lane| {
                law.beyond_rest(&pair.lane(lane), &geometry.lane(lane), -separation.lane(lane))
            });
            let lost = -beyond_rest * separation;
            along.repulsion = along.repulsion + beyond_rest;
            along.dissipation = along.dissipation + lost.max(zero);
            along.driven = (-lost).max(zero);
        }
        along
    }

    /// Energy stored along the line of centers [J].
    pub fn energy(&self, pair: &PairConstants, geometry: &ContactGeometry) -> f64 {
        let normal = self.normal.as_ref().filter(|_| geometry.overlap > 0.0);
        normal.map_or(0.0, |law| law.energy(pair, geometry))
            + self.custom.as_ref().map_or(0.0, |law| law.energy(pair, geometry))
    }

    /// How far beyond touching the laws act [m].
    #[inline]
    pub fn reach(&self) -> f64 {
        self.custom.as_ref().map_or(0.0, Custom::reach)
    }

    /// How fast a wave crosses a grain of this radius [m], where a step must not outrun it either.
    pub fn wave_pace(&self, material: &Material, radius: f64) -> Pace {
        self.normal.as_ref().map_or(Pace::NONE, |law| law.wave_pace(material, radius))
    }

    /// How fast the laws are in a contact that reaches this overlap: along the line of centers or across it.
    pub fn pace(&self, pair: &PairConstants, geometry: &ContactGeometry) -> Pace {
        self.pace_beside(
            pair,
            geometry,
            self.custom.as_ref().map_or(Pace::NONE, |law| law.pace(pair, geometry)),
        )
    }

    /// How fast the laws are in a contact with this overlap and this rate of it [m/s].
    pub fn pace_at(&self, pair: &PairConstants, geometry: &ContactGeometry, speed: f64) -> Pace {
        let custom = self.custom.as_ref().map_or(Pace::NONE, |law| law.pace_at(pair, geometry, speed));
        if geometry.overlap > 0.0 { self.pace_beside(pair, geometry, custom) } else { custom }
    }

    fn pace_beside(&self, pair: &PairConstants, geometry: &ContactGeometry, custom: Pace) -> Pace {
        let (elastic, mass) = (self.elastic(pair, geometry, true), geometry.effective_mass);
        let spring = self.normal.as_ref().map_or(Pace::NONE, |law| law.pace(pair, geometry)) + custom;
        let dashpot = self.damping.as_ref().map_or(Pace::NONE, |law| law.pace(pair, geometry, &elastic));
        // A law across the line of centers follows the stiffest that the contact was on its way to this overlap.
        let stiffest = Elastic { stiffness: spring.square * mass, ..elastic };
        let across = self
            .friction
            .as_ref()
            .map_or(Pace::NONE, |law| law.pace(pair, geometry, &stiffest, dashpot.rate * mass));
        (spring + dashpot).max(across)
    }

    /// Overlap [m] at which two grains have given all of an energy [J] to the contact; nothing if they have not where
    /// the center of one lies at that of the other.
    pub fn deepest_overlap(
        &self,
        pair: &PairConstants,
        geometry: &ContactGeometry,
        energy: f64,
    ) -> Option<f64> {
        let left = |overlap: f64| self.energy(pair, &ContactGeometry { overlap, ..*geometry }) - energy;
        let most = geometry.radius_sum;
        let ends = [left(0.0), left(most)];
        if ends[0] >= 0.0 {
            return Some(0.0);
        }
        (ends[1] >= 0.0).then(|| root_between(left, [0.0, most], ends, 1e-12 * most).at)
    }

    /// The laws without those that can outgrow the elastic contact: how fast the rest is at the deepest overlap holds
    /// for all others.
    #[must_use]
    pub fn bounded(&self) -> Self {
        let damping = self.damping.clone().filter(|law| !law.outgrows_contact());
        let friction = self.friction.clone().filter(|law| !law.outgrows_contact());
        Self { damping, friction, ..self.clone() }
    }

    /// Whether one of the laws can outgrow the elastic contact; a formula of the speed may grow with it without a bound.
    pub fn outgrow_contact(&self) -> bool {
        self.custom.as_ref().is_some_and(Custom::has_speed)
            || self.damping.as_ref().is_some_and(Damping::outgrows_contact)
            || self.friction.as_ref().is_some_and(Friction::outgrows_contact)
    }
}

/// n where a force grows like overlap^n, from the force and its slope at an overlap [m]; at least 1, and 1 where the force
/// does not grow.
#[inline(always)]
fn local_exponent<F: Lanes>(elastic: &Elastic<F>, overlap: F) -> F {
    let (zero, one) = (F::of(0.0), F::of(1.0));
    let grows = F::both(zero.below(elastic.force), zero.below(elastic.stiffness));
    let exponent = overlap * elastic.stiffness / elastic.force;
    F::select(grows, exponent.max(one).min(F::of(HIGHEST_EXPONENT)), one)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::normal::{Hertz, Hooke};
    use crate::units::Quantity;

    /// Hertz: δ = (15 m* v²/(16 E* √R*))^(2/5); Hooke: v √(m*/k); both by hand, and nothing where grains pass through.
    #[test]
    fn deepest_overlaps_are_those_of_the_closed_forms() {
        let of = |normal| ContactLaws { normal: Some(normal), custom: None, damping: None, friction: None };
        let pair = PairConstants { effective_modulus: 3e9, ..Default::default() };
        let geometry = ContactGeometry::new([1e-3, 4e-3], [1e-6, 2e-6], [0.0; 2], 5e-3);
        let (mass, speed) = (geometry.effective_mass, 0.7);
        let energy = 0.5 * mass * speed * speed;
        let by_hand =
            (15.0 * mass * speed * speed / (16.0 * 3e9 * geometry.effective_radius.sqrt())).powf(0.4);
        let hertz = of(Normal::Hertz(Hertz {})).deepest_overlap(&pair, &geometry, energy);
        assert_close!(hertz.unwrap(), by_hand, 1e-8, "in m");
        let hooke = of(Normal::Hooke(Hooke { stiffness: Quantity(2e4) }));
        assert_close!(
            hooke.deepest_overlap(&pair, &geometry, energy).unwrap(),
            speed * (mass / 2e4).sqrt(),
            1e-8,
            "in m"
        );
        let all = 0.5 * 2e4 * geometry.radius_sum * geometry.radius_sum;
        assert_eq!(hooke.deepest_overlap(&pair, &geometry, 1.001 * all), None);
    }
}
