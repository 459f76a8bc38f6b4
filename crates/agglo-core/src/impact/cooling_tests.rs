use proptest::prelude::*;

use super::*;

fn law(convection: f64, gas: f64, surroundings: f64, integration: Integration) -> Cooling {
    Cooling {
        convection: Quantity(convection),
        gas_temperature: Quantity(gas),
        surroundings: Quantity(surroundings),
        integration,
    }
}

fn exact(convection: f64, emissivity: f64, gas: f64, surroundings: f64) -> Cooler {
    Cooler::new(&law(convection, gas, surroundings, Integration::Exact), emissivity)
}

/// (T [K], h, ε, T0, Ts, area over heat capacity, time) and the temperature after it, from mpmath: quadrature of dT over the rate
/// with 30 digits, inverted. 1e-12 is what the partial fractions lose where the series takes over.
#[test]
fn numbers_by_quadrature() {
    let cases = [
        ([1e3, 0.0, 0.5, 300.0, 300.0, 0.01, 10.0], 482.877_786_975_343_95),
        ([1e9, 0.0, 0.5, 300.0, 300.0, 0.01, 1e-6], 105_543.704_810_594_2),
        ([1e9, 0.0, 0.5, 300.0, 300.0, 0.01, 1e-3], 10_554.371_465_180_067),
        ([1e14, 0.0, 1.0, 300.0, 300.0, 1.0, 1e-3], 1_804.968_796_764_059_8),
        ([20.0, 0.0, 0.5, 300.0, 300.0, 0.01, 500.0], 299.999_504_010_176_9),
        ([1e3, 10.0, 0.5, 280.0, 400.0, 0.01, 10.0], 401.729_523_804_433_4),
        ([5e3, 1e3, 0.8, 280.0, 400.0, 0.01, 0.05], 1_800.683_175_473_281),
        ([1e7, 1e3, 0.8, 280.0, 400.0, 0.01, 1e-4], 19_431.716_478_336_51),
        ([30.0, 50.0, 0.9, 250.0, 900.0, 0.02, 0.5], 377.636_094_991_772_95),
        ([1e6, 1e8, 0.9, 250.0, 900.0, 0.02, 1e-7], 133_408.471_482_723_63),
        ([350.0, 1e-3, 0.1, 900.0, 250.0, 0.02, 1e4], 251.809_253_591_265_25),
    ];
    for ([start, convection, emissivity, gas, far, area, time], wanted) in cases {
        let found = exact(convection, emissivity, gas, far).cooled(start, area, time);
        assert!((found / wanted - 1.0).abs() < 1e-12, "{start} {convection}: {found} {wanted}");
    }
}

/// Surroundings at absolute zero: T = T(0)/(1 + 3 k T(0)³ t)^(1/3) by radiation; with convection e^(-a t) in place of the 1.
#[test]
fn towards_absolute_zero() {
    let (start, area, time): (f64, f64, f64) = (2e3, 0.02, 300.0);
    let k = 0.7 * STEFAN_BOLTZMANN * area;
    let wanted = start / (1.0 + 3.0 * k * start.powi(3) * time).cbrt();
    assert_close!(exact(0.0, 0.7, 300.0, 0.0).cooled(start, area, time), wanted, 1e-14);
    let weak = exact(1e-9, 0.7, 0.0, 0.0).cooled(start, area, time);
    assert_close!(weak, wanted, 1e-8);
    let strong = exact(0.5, 1e-30, 0.0, 0.0).cooled(start, area, time);
    assert_close!(strong, start * (-0.5 * area * time).exp(), 1e-12);
    assert_above!(exact(0.5, 0.7, 0.0, 0.0).cooled(start, area, 1e12), 0.0);
}

/// The rate at the start is that of the equation: a step of 1e-6 of the time of cooling, whose square is 1e-12 and more.
#[test]
fn slope_is_the_equation() {
    for (start, convection, emissivity) in
        [(900.0, 0.0, 0.3), (900.0, 30.0, 0.3), (150.0, 30.0, 0.3), (2e5, 30.0, 1.0)]
    {
        let (gas, far, area): (f64, f64, f64) = (310.0, 290.0, 0.05);
        let radiated = STEFAN_BOLTZMANN * emissivity * (f64::powi(start, 4) - far.powi(4));
        let rate = -area * (convection * (start - gas) + radiated);
        let step = 1e-6 * start / rate.abs();
        let slope = (exact(convection, emissivity, gas, far).cooled(start, area, step) - start) / step;
        assert!((slope / rate - 1.0).abs() < 1e-5, "{start}: {slope} {rate}");
    }
}

/// The published step, by hand: 300 K above gas and surroundings; and its overshoot where grains are hot.
#[test]
fn published_step_and_its_overshoot() {
    let cooler = Cooler::new(&law(10.0, 300.0, 280.0, Integration::Published), 0.5);
    let radiated = 0.5 * 5.670_374_419e-8 * (600.0_f64.powi(4) - 280.0_f64.powi(4));
    let wanted = 600.0 - 2.0 * 0.01 * (10.0 * 300.0 + radiated);
    assert_close!(cooler.cooled(600.0, 0.01, 2.0), wanted, 1e-14);
    assert_false!(
        cooler.overshoots(600.0, 0.01, 2.0),
        "an explicit step of so many s takes more than the whole difference to the surroundings"
    );
    assert_true!(
        cooler.overshoots(1e9, 0.01, 1e-8),
        "an explicit step of so many s takes more than the whole difference to the surroundings"
    );
    assert_eq!(cooler.cooled(1e9, 0.01, 1e-8), 280.0);
    assert_false!(
        exact(10.0, 0.5, 300.0, 280.0).overshoots(1e9, 0.01, 1e-8),
        "an explicit step of so many s takes more than the whole difference to the surroundings"
    );
}

#[test]
fn what_does_not_cool() {
    assert_false!(exact(0.0, 0.0, 300.0, 300.0).acts(), "a body without emissivity and film cools");
    assert_eq!(exact(0.0, 0.0, 300.0, 300.0).cooled(500.0, 1.0, 1e9), 500.0);
    for cooler in
        [exact(1.0, 0.0, 300.0, 300.0), exact(0.0, 0.5, 300.0, 300.0), exact(1.0, 0.5, 300.0, 300.0)]
    {
        assert_eq!(cooler.cooled(300.0, 1.0, 1e3), 300.0);
        assert_eq!(cooler.cooled(500.0, 1.0, 0.0), 500.0);
        assert_near!(cooler.cooled(1e14, 1.0, 1e12), 300.0, 1e-12);
        assert_near!(cooler.cooled(1.0, 1.0, 1e12), 300.0, 1e-12);
    }
}

/// Where nothing but weak radiation is left beside strong convection, the two ways agree.
#[test]
fn both_terms_become_convection_alone() {
    for ratio in [1e-12, 1e-30, 1e-200] {
        let (both, alone) = (exact(20.0, ratio, 320.0, 100.0), exact(20.0, 0.0, 320.0, 100.0));
        for (start, time) in [(1e3, 0.5), (50.0, 3.0), (321.0, 40.0)] {
            let (found, wanted) = (both.cooled(start, 0.03, time), alone.cooled(start, 0.03, time));
            assert!((found / wanted - 1.0).abs() < 1e-9, "{ratio} {start}: {found} {wanted}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    /// Any step keeps T above zero, between the start and the ends of equilibrium, and two steps are one.
    #[test]
    fn two_steps_are_one(
        start in 0.0..14.0_f64,
        convection in prop_oneof![Just(0.0), (-6.0..6.0_f64).prop_map(|x| 10.0_f64.powf(x))],
        emissivity in prop_oneof![Just(0.0), 1e-6..1.0_f64],
        gas in 10.0..2e3_f64,
        far in 10.0..2e3_f64,
        area in (-3.0..3.0_f64).prop_map(|x| 10.0_f64.powf(x)),
        first in (-12.0..12.0_f64).prop_map(|x| 10.0_f64.powf(x)),
        second in (-12.0..12.0_f64).prop_map(|x| 10.0_f64.powf(x)),
    ) {
        let start = 10.0_f64.powf(start);
        let cooler = exact(convection, emissivity, gas, far);
        let once = cooler.cooled(start, area, first + second);
        let between = cooler.cooled(start, area, first);
        let twice = cooler.cooled(between, area, second);
        prop_assert!(once > 0.0 && once.is_finite());
        let round = 1e-12 * start;
        prop_assert!(once >= start.min(gas.min(far)) - round && once <= start.max(gas.max(far)) + round);
        prop_assert!((once / twice - 1.0).abs() < 1e-10, "{} {} {}", once, between, twice);
    }
}
