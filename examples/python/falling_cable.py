# SPDX-License-Identifier: BSD-3-Clause
"""A cable falls from a catenary: its shapes, and where its end is over time.

    python3 examples/python/falling_cable.py falling_cable.png
"""
import sys

import catena
import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot

LINKS, LENGTH, DENSITY = 12, 3.39, 0.1424  # -, m, kg/m

model = catena.Model(LINKS)
length = LENGTH / LINKS
mass = DENSITY * length
parameters = model.parameters(
    length=length,
    mass=mass,
    inertia=mass * length**2 / 12,
    stiffness=0.5,  # N m/rad, of every joint
    damping=1e-3,  # N m s/rad
    load_mass=1.47,  # kg
)
start = catena.catenary(model, parameters, side=1.5, down=2.5)
run = catena.simulate(model, parameters, start, np.linspace(0, 3, 301))
side, down = catena.positions(model, parameters, run.trajectory)

figure, (shapes, end) = pyplot.subplots(1, 2, figsize=(10, 5))
shapes.plot(side[:176:10].T, down[:176:10].T, color="0.3", linewidth=0.8)
shapes.set(xlabel="side, m", ylabel="down, m", title="every 0.1 s", aspect="equal")
shapes.invert_yaxis()
end.plot(run.trajectory.time, side[:, -1], label="side")
end.plot(run.trajectory.time, down[:, -1], "--", label="down")
end.set(xlabel="time, s", ylabel="m", title="the load")
end.legend()
figure.savefig(sys.argv[1])
print(f"the load ends at side {side[-1, -1]:.3f} m, down {down[-1, -1]:.3f} m")
