"""Laws over arrays, rays among given spheres, pulses on demand."""

import agglo
import numpy as np
import pytest

PAIR = """
version = 1
time.end = "1 ms"
engine.verlet.step = "1 us"
[materials.glass]
density = "2500 kg/m3"
youngs_modulus = "70 GPa"
poisson_ratio = 0.2
sound_speed = "5000 m/s"
[materials.steel]
density = "7800 kg/m3"
youngs_modulus = "200 GPa"
poisson_ratio = 0.3
sound_speed = "5900 m/s"
shear_sound_speed = "3200 m/s"
[medium]
density = "1000 kg/m3"
sound_speed = "1500 m/s"
[contact.normal.hertz]
[contact.damping.restitution]
restitution = 0.5
[[grains]]
material = "glass"
size.constant.radius = "1 cm"
placement.list.positions = [["0 m", "0 m", "0 m"]]
[acoustics.force.impulse]
duration = "1 us"
[[acoustics.beams]]
start = ["-5 cm", "0 m", "0 m"]
direction = [1.0, 0.0, 0.0]
radius = "8 mm"
rays = 400
strength.pressure = "1 kPa"
pulses.count = 0
"""


def pair(**settings):
    return agglo.Scenario(PAIR, {key.replace("__", "."): value for key, value in settings.items()})


def test_contact_laws_over_arrays():
    overlap = np.array([[0.0, 1e-6], [5e-6, 2e-5]])
    found = agglo.contact(pair(), overlap, radii_m=[1e-3, 2e-3], materials=["glass", "steel"])
    modulus = 1.0 / (0.96 / 70e9 + 0.91 / 200e9)
    radius = 2e-3 / 3.0
    hertz = 4.0 / 3.0 * modulus * np.sqrt(radius) * overlap**1.5
    # Round-off of a power.
    assert found["elastic_N"] == pytest.approx(hertz, rel=1e-14) and np.array_equal(found["repulsion_N"], found["elastic_N"])
    assert found["energy_J"] == pytest.approx(0.4 * hertz * overlap, rel=1e-14)
    # The dashpot of a restitution e on Hertz: 2 sqrt(5/6) beta sqrt(S m*), S = 2 E* sqrt(R* overlap).
    masses = 4.0 / 3.0 * np.pi * np.array([2500.0 * 1e-9, 7800.0 * 8e-9])
    mass, stiffness = np.prod(masses) / np.sum(masses), 2.0 * modulus * np.sqrt(radius * overlap)
    part = np.log(0.5) / np.sqrt(np.log(0.5) ** 2 + np.pi**2)
    assert found["dashpot_N_s_m"] == pytest.approx(-2.0 * np.sqrt(5.0 / 6.0) * part * np.sqrt(stiffness * mass), rel=1e-10)
    moving = agglo.contact(pair(), 1e-6, [-0.1, 0.1], radii_m=[1e-3, 2e-3], materials=[0, 1])
    assert moving["repulsion_N"] == pytest.approx(hertz[0, 1] + moving["dashpot_N_s_m"] * [0.1, -0.1], rel=1e-14)
    assert moving["dissipation_W"] == pytest.approx(0.01 * moving["dashpot_N_s_m"], rel=1e-14)
    for overlap, told in [(np.nan, "finite"), (4e-3, "below the sum")]:
        with pytest.raises(agglo.InputError, match=told):
            agglo.contact(pair(), overlap, radii_m=[1e-3, 2e-3])
    with pytest.raises(agglo.InputError, match="no material 'iron'; there are glass, steel"):
        agglo.contact(pair(), 1e-6, radii_m=[1e-3, 2e-3], materials=["glass", "iron"])
    with pytest.raises(agglo.AggloError, match="soft spheres"):
        agglo.contact(agglo.Scenario.template("reacting"), 1e-6, radii_m=[1e-3, 1e-3])


def test_reflection_over_angles():
    """At normal incidence R = ((Z - Z_0)/(Z + Z_0))²; the three parts are all of the power."""
    for material, impedance in [("glass", 2500.0 * 5000.0), ("steel", 7800.0 * 5900.0)]:
        found = agglo.reflect(pair(), np.linspace(0.0, np.pi / 2, 200).reshape(2, 100), material=material)
        normal = ((impedance - 1.5e6) / (impedance + 1.5e6)) ** 2
        assert found["reflected"][0, 0] == pytest.approx(normal, rel=1e-13)
        assert found["reflected"] + found["sheared"] + found["refracted"] == pytest.approx(np.ones((2, 100)))
        assert found["reflected"][1, -1] == pytest.approx(1.0) and np.all(found["refracted"] > -1e-15)
    assert np.max(found["sheared"]) > 0.1
    with pytest.raises(agglo.InputError, match="pi/2"):
        agglo.reflect(pair(), 1.6)


def test_rays_among_given_spheres():
    hits, pulse = agglo.trace(pair())
    assert len(hits["sphere"]) == pulse["reflections"] == 400, "a single sphere is hit once by every ray"
    # Hits are on the sphere, and rays are reflected as by a mirror.
    assert np.linalg.norm(hits["point_m"], axis=1) == pytest.approx(np.full(400, 1e-2))
    assert hits["point_m"] == pytest.approx(1e-2 * hits["normal"])
    along = np.sum(hits["direction_in"] * hits["normal"], axis=1, keepdims=True)
    assert hits["direction_out"] == pytest.approx(hits["direction_in"] - 2.0 * along * hits["normal"])
    angle = np.arccos(np.clip(-along[:, 0], 0.0, 1.0))
    assert hits["reflected"] == pytest.approx(agglo.reflect(pair(), angle)["reflected"])
    assert pulse["power_in_W"] == pytest.approx(np.sum(hits["power_in_W"]))
    absorbed = np.sum(hits["power_in_W"] * (1.0 - hits["reflected"]))
    assert pulse["power_absorbed_W"] == pytest.approx(absorbed)
    # The same sphere given as an array, one behind it in its shadow, and one beside the beam.
    places = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]]
    more, _ = agglo.trace(pair(), places, 1e-2, ["glass", "glass", "steel"])
    first = more["sphere"] == 0
    assert np.count_nonzero(first) == 400 and np.array_equal(more["impulse_N_s"][first], hits["impulse_N_s"])
    for arguments, told in [
        (([[0.0, 0.0]], 1e-2), "shape"),
        ((places, None), "radius_m with it"),
        ((places, [1e-2, 1e-2, -1e-2]), "radii above 0"),
        ((places, 1e-2, [0, 0, 2]), "materials below 2"),
    ]:
        with pytest.raises(agglo.InputError, match=told):
            agglo.trace(pair(), *arguments)
    with pytest.raises(agglo.InputError, match="no beam 1; the scenario has 1"):
        agglo.trace(pair(), beam=1)


def test_pulses_on_demand():
    simulation = agglo.Simulation(pair())
    simulation.pulse()
    state = simulation.save()
    simulation.run_until(1e-4)
    again = agglo.Simulation.restore(pair(), state)
    again.run_until(1e-4)
    assert again.save() == simulation.save()
    hits, traced = agglo.trace(pair())
    assert simulation.pulses()[0]["reflections"] == traced["reflections"]
    impulse = np.sum(hits["impulse_N_s"], axis=0)
    # The sphere moves by some parts of 1e-12 of its radius meanwhile.
    assert simulation.measures()["momentum_kg_m_s"] == pytest.approx(impulse, rel=1e-9, abs=1e-12 * np.linalg.norm(impulse))
    with pytest.raises(agglo.InputError, match="no beam 1"):
        simulation.pulse(1)
    with pytest.raises(agglo.InputError, match="hard spheres"):
        agglo.Simulation(agglo.Scenario.template("reacting")).pulse()
