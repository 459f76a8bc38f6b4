"""A force of one's own: grains in a standing wave of ultrasound gather in its nodal planes.

    python3 examples/custom_force.py out/standing-wave             # seconds; --short: fewer

The force on a small sphere is that of Yosioka and Kawasima (1955), F = 4 π Φ k R³ E sin(2 k z) along z, with the contrast factor Φ,
the wave number k and the energy density E. It is given as a function over all grains; the drag of the water is agglo's. Where
inertia does not matter, tan(k z) grows by exp(t/τ), with 1/τ = (4/3) Φ k² R² E/η: the simulation is held to that.
"""

import argparse
from pathlib import Path

import agglo
import matplotlib.pyplot as plt
import numpy as np

VISCOSITY_PA_S, RADIUS_M = 1e-3, 10e-6
CONTRAST, ENERGY_J_M3, FREQUENCY_HZ, SOUND_SPEED_M_S = 0.2, 200.0, 2e6, 1500.0
WAVE_1_M = 2 * np.pi * FREQUENCY_HZ / SOUND_SPEED_M_S
RATE_1_S = 4 / 3 * CONTRAST * WAVE_1_M**2 * RADIUS_M**2 * ENERGY_J_M3 / VISCOSITY_PA_S

SCENARIO = {
    "version": 1,
    "title": "Grains in a standing wave",
    "time": {"end": "15 ms"},
    "engine": {"verlet": {}},
    # Without a law of contact grains pass through one another, as the closed form has it.
    "limits": {"on_breach": "warn"},
    "medium": {"density": "1000 kg/m3", "viscosity": f"{VISCOSITY_PA_S} Pa s"},
    "materials": {"polystyrene": {"density": "1050 kg/m3"}},
    "grains": [
        {
            "material": "polystyrene",
            "size": {"constant": {"radius": f"{RADIUS_M} m"}},
            "placement": {
                "random": {"count": 300, "region": {"box": {"lower": ["0 mm"] * 3, "upper": ["0.375 mm", "0.375 mm", "0.75 mm"]}}}
            },
        }
    ],
    "fields": {"drag": {"law": "stokes"}},
}


def wave(time_s, position_m, velocity_m_s, angular_velocity_rad_s):
    """The forces [n, 3] [N] on all grains; it must give the same for the same arguments."""
    force = np.zeros_like(position_m)
    strength = 4 * np.pi * CONTRAST * WAVE_1_M * RADIUS_M**3 * ENERGY_J_M3
    force[:, 2] = strength * np.sin(2 * WAVE_1_M * position_m[:, 2])
    return force


def in_closed_form(start_m, time_s):
    """Places along z without inertia."""
    node = np.round(start_m / (np.pi / WAVE_1_M)) * np.pi / WAVE_1_M
    return node + np.arctan(np.tan(WAVE_1_M * (start_m - node)) * np.exp(RATE_1_S * time_s)) / WAVE_1_M


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the picture goes")
    parser.add_argument("--short", action="store_true", help="a quarter of the time and a tenth of the grains, for a try")
    given = parser.parse_args()
    scenario = agglo.Scenario.from_dict(SCENARIO)
    if given.short:
        scenario = scenario.replace({"time.end": "4 ms", "grains.0.placement.random.count": 30})
    simulation = agglo.Simulation(scenario)
    # How fast the force changes from place to place, over the mass: it bounds the automatic step.
    mass = simulation.grains()["mass_kg"][0]
    steepest = 8 * np.pi * CONTRAST * WAVE_1_M**2 * RADIUS_M**3 * ENERGY_J_M3
    simulation.attach(wave, stiffness_over_mass=steepest / mass)
    times, places = [], []
    for time_s, grains in agglo.snapshots(simulation, every_s=scenario.end_s / 60):
        times.append(time_s)
        places.append(grains["position_m"][:, 2])
    times, places = np.array(times), np.array(places)
    exact = in_closed_form(places[0], times[:, None])
    off = np.abs(places - exact).max()
    balance = simulation.balance()
    print(f"{simulation.steps:,} steps; at most {1e6 * off:.2g} µm off the closed form without inertia")
    print(
        f"work of the wave {balance['work_custom_J']:.3g} J, lost to drag {balance['lost_drag_J']:.3g} J, "
        f"not explained {balance['drift_J']:.1g} J"
    )

    given.folder.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(agglo.plot_style()):
        figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), width_ratios=(2, 1), layout="constrained")
        shown = np.argsort(places[0])[:: max(len(places[0]) // 30, 1)]
        left.plot(1e3 * times, 1e3 * places[:, shown], color="#0072b2", linestyle="-", linewidth=1)
        left.plot(1e3 * times[::6], 1e3 * exact[::6, shown], color="#d55e00", linestyle="none", marker=".", markersize=4)
        left.plot([], [], color="#0072b2", linestyle="-", label="agglo")
        left.plot([], [], color="#d55e00", linestyle="none", marker=".", label="closed form")
        left.set(title="Grains gather in planes half a wave apart", xlabel="time (ms)", ylabel="z (mm)")
        left.legend(loc="upper right")
        right.hist(
            1e3 * places[[0, -1]].T,
            bins=40,
            orientation="horizontal",
            color=["#999999", "#0072b2"],
            label=["at the start", "at the end"],
        )
        right.set(xlabel="grains", ylabel="z (mm)")
        right.legend(loc="upper right")
        figure.savefig(given.folder / "standing-wave.svg")


if __name__ == "__main__":
    main()
