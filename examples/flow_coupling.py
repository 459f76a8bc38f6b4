"""A coupling to a flow solver: dust takes the speed out of a jet of air, and the jet takes the dust along.

    python3 examples/flow_coupling.py out/jet                      # seconds; --short: fewer grains

The flow is a solver of a dozen lines: the speed u(z, t) of a plane jet along x, which spreads by viscosity. The two take turns of a
millisecond: agglo moves the grains with Stokes' drag in the flow as it is, given as a function, and what momentum the grains have gained
is taken from the cells in which they are. Nothing else takes momentum, so that what air and dust have together must stay.
"""

import argparse
from pathlib import Path

import agglo
import matplotlib.pyplot as plt
import numpy as np

RADIUS_M, DUST_KG_M3 = 30e-6, 2500.0
AIR_KG_M3, VISCOSITY_PA_S = 1.2, 1.8e-5
SPEED_M_S, WIDTH_M, HEIGHT_M, AREA_M2 = 0.1, 2e-3, 20e-3, 1e-4
INTERVAL_S = 1e-3

SCENARIO = {
    "version": 1,
    "title": "Dust in a jet",
    "time": {"end": "0.2 s"},
    # The fastest move a third of their radius in a step.
    "engine": {"verlet": {"step": "0.1 ms"}},
    # There is no law of contact: the few grains that meet pass through one another.
    "limits": {"on_breach": "warn"},
    "materials": {"dust": {"density": f"{DUST_KG_M3} kg/m3"}},
    "grains": [
        {
            "material": "dust",
            "size": {"constant": {"radius": f"{RADIUS_M} m"}},
            "placement": {
                "random": {
                    "count": 1500,
                    "region": {"box": {"lower": ["0 mm", "0 mm", "-3 mm"], "upper": ["10 mm", "10 mm", "3 mm"]}},
                }
            },
        }
    ],
}


class Jet:
    """The speed of the air along x in cells over z; nothing passes the upper and the lower face."""

    def __init__(self, cells=100):
        self.height = HEIGHT_M / cells
        self.z = (np.arange(cells) + 0.5) * self.height - HEIGHT_M / 2
        self.speed = SPEED_M_S / np.cosh(self.z / WIDTH_M) ** 2
        self.cell_mass = AIR_KG_M3 * AREA_M2 * self.height

    def advance(self, interval_s):
        """Viscosity spreads the momentum; explicit steps of a quarter of the stable one."""
        diffusion = VISCOSITY_PA_S / AIR_KG_M3 / self.height**2
        steps = int(np.ceil(interval_s * diffusion * 8))
        for _ in range(steps):
            flux = diffusion * np.diff(self.speed)
            self.speed += interval_s / steps * (np.append(flux, 0.0) - np.append(0.0, flux))

    def cell(self, z):
        """The cell of each place."""
        return np.clip(((z + HEIGHT_M / 2) / self.height).astype(int), 0, len(self.z) - 1)

    def take(self, z, impulse):
        """Takes momentum [n] [kg m/s] from the cells of places [n]."""
        np.subtract.at(self.speed, self.cell(z), impulse / self.cell_mass)

    @property
    def momentum(self):
        return self.cell_mass * self.speed.sum()


def couple(scenario, gives_back=True):
    """Times, speeds of the jet, mean speeds of the dust and momenta of both, interval by interval."""
    jet, simulation = Jet(), agglo.Simulation(scenario)
    drag = 6 * np.pi * VISCOSITY_PA_S * RADIUS_M
    mass = simulation.grains()["mass_kg"][0]

    def pull(time_s, position_m, velocity_m_s, angular_velocity_rad_s):
        force = -drag * velocity_m_s
        force[:, 0] += drag * jet.speed[jet.cell(position_m[:, 2])]
        return force

    simulation.attach(pull, stiffness_over_mass=0.0, damping_over_mass=drag / mass)
    times, profiles, dust, momenta = [], [], [], []
    before = simulation.grains()
    while True:
        times.append(simulation.time_s)
        profiles.append(jet.speed.copy())
        dust.append(before["velocity_m_s"][:, 0].mean())
        momenta.append((jet.momentum, (before["mass_kg"] * before["velocity_m_s"][:, 0]).sum()))
        if simulation.is_finished:
            break
        since = simulation.time_s
        simulation.run_until(since + INTERVAL_S)
        after = simulation.grains()
        # Without contacts all of a grain's momentum is from the air around it. The interval is as long as agglo's steps made it.
        if gives_back:
            jet.take(after["position_m"][:, 2], after["mass_kg"] * (after["velocity_m_s"] - before["velocity_m_s"])[:, 0])
        jet.advance(simulation.time_s - since)
        before = after
    return np.array(times), np.array(profiles), np.array(dust), np.array(momenta), jet


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the picture goes")
    parser.add_argument("--short", action="store_true", help="a quarter of the time, for a try")
    given = parser.parse_args()
    scenario = agglo.Scenario.from_dict(SCENARIO)
    if given.short:
        scenario = scenario.replace({"time.end": "50 ms"})
    times, profiles, dust, momenta, jet = couple(scenario)
    _, alone, carried, _, _ = couple(scenario, gives_back=False)
    whole = momenta.sum(axis=1)
    print(f"momentum of air and dust: {whole[0]:.6g} kg m/s at the start, changed by {np.ptp(whole) / whole[0]:.1g} of it")
    print(
        f"dust has {momenta[-1, 1] / whole[-1]:.1%} of it at the end; its mean speed is {1e3 * dust[-1]:.1f} mm/s, "
        f"and {1e3 * carried[-1]:.1f} mm/s where the air does not feel it"
    )

    given.folder.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(agglo.plot_style()):
        figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12, 3.8), layout="constrained")
        for profile, words in [
            (profiles[0], "at the start"),
            (alone[-1], "air alone at the end"),
            (profiles[-1], "with dust at the end"),
        ]:
            left.plot(1e3 * profile, 1e3 * jet.z, label=words)
        left.set(title="The jet", xlabel="speed of the air (mm/s)", ylabel="z (mm)", ylim=(-8, 8))
        middle.plot(1e3 * times, 1e3 * dust, label="dust takes momentum")
        middle.plot(1e3 * times, 1e3 * carried, label="the air does not feel it")
        middle.set(title="Mean speed of the dust", xlabel="time (ms)", ylabel="speed (mm/s)")
        right.stackplot(1e3 * times, 1e9 * momenta.T, labels=["air", "dust"], colors=["#56b4e9", "#e69f00"])
        right.plot(1e3 * times, 1e9 * whole, color="#222222", linestyle="-", linewidth=1)
        right.set(title="Momentum", xlabel="time (ms)", ylabel="along x (nN s)")
        for axes in (left, middle, right):
            axes.legend()
        figure.savefig(given.folder / "jet.svg")


if __name__ == "__main__":
    main()
