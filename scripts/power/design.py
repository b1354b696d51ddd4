# SPDX-License-Identifier: BSD-3-Clause
"""Which recordings the power study makes, in which order."""

import dataclasses

# What is hidden, by what scales with the strength: parameter = number * strength's amplitude. What
# else the effect needs is fixed. `most` is the largest amplitude within the effect's sense.
EFFECTS = {
    "air_drag_linear": ({"normal": 1, "tangential": 0.3}, {}, 10),
    "air_drag_quadratic": ({"normal": 1, "tangential": 0.05}, {}, 10),
    "air_drag_isotropic": ({"coefficient": 1}, {}, 10),
    "load_drag": ({"coefficient": 1}, {}, 10),
    "steady_wind": ({"normal": 1, "tangential": 0.05}, {"wind": 2.0}, 10),
    "joint_dry_friction": ({"moment": 1}, {}, 1),
    "pivot_dry_friction": ({"moment": 1}, {}, 1),
    "support_motion": ({"side_amplitude": 1, "down_amplitude": 0.3},
                       {"frequency": 1.3, "side_phase": 0.4}, 0.3),
    "joint_stiffness_cubic": ({"cubic": 1}, {}, 1000),
    "joint_damping_quadratic": ({"coefficient": 1}, {}, 10),
    "rest_curvature": ({"curvature": 1}, {}, 10),
    "pivot_rest_angle": ({"rest": 1}, {}, 1.5),
    "pivot_stiffness": ({"change": 1}, {}, 100),
    "pivot_damping": ({"change": 1}, {}, 10),
    "link_damping": ({"coefficient": 1}, {}, 10),
    "load_mass": ({"correction": 1}, {}, 1),
    "load_inertia": ({"offset": 1, "about_centre": 0.01}, {}, 0.3),
    "centre_offset": ({"fraction": 1}, {}, 0.5),
    "added_mass": ({"normal": 1, "tangential": 0.1}, {}, 1),
    "buoyancy": ({"displaced": 1}, {}, 0.1),
    "gravity_tilt": ({"tilt": 1}, {}, 0.5),
    "axial_stretch": ({"axial_stiffness": -1}, {}, 1000),  # 1000 N over the amplitude
    "joint_hysteresis": ({"moment": 1}, {"reach": 0.02}, 1),
    "clock_offset": ({"offset": 1}, {}, 0.3),
    "scale": ({"factor": 1}, {}, 0.3),
    "camera_tilt": ({"tilt": 1}, {}, 0.5),
    "marker_offset": ({"across": 1, "along": 0.5}, {}, 0.1),
    "origin_offset": ({"side_shift": 1, "down_shift": 0.5}, {}, 0.3),
}
OUTSIDE = {
    "wall_spring": ({"stiffness": 1}, {"side": 0.2}, 1000),
    "magnet": ({"strength": 1}, {"depth": 0.1}, 1),
    "kick": ({"impulse": 1}, {"time": 1.5}, 1),
    "carried": ({"share": 1}, {}, 1),
}
PAIRS = [
    ("air_drag_quadratic", "joint_dry_friction"), ("support_motion", "air_drag_quadratic"),
    ("joint_stiffness_cubic", "load_drag"), ("camera_tilt", "air_drag_quadratic"),
    ("pivot_dry_friction", "steady_wind"), ("support_motion", "joint_dry_friction"),
    ("added_mass", "clock_offset"), ("pivot_stiffness", "air_drag_quadratic"),
    ("scale", "pivot_dry_friction"), ("rest_curvature", "air_drag_quadratic"),
]
# Joints of a finer chain turn less: the same cable has amplitudes that go with this power of n.
JOINT_POWERS = {"joint_damping_quadratic": 2, "joint_stiffness_cubic": 3}
# Noise that is not white, not normal or not alike for all markers, as make_recording's options.
DIRT = {
    "correlated_0.3": ["--autocorrelation", "0.3"],
    "correlated_0.6": ["--autocorrelation", "0.6"],
    "smoothed": ["--smoothed"],
    "noisy_marker": ["--noisy-marker", "3"],
    "shaking": ["--shaking", "1"],
    "tails": ["--tails", "4"],
    "outliers": ["--outliers", "0.001"],
    "all": ["--autocorrelation", "0.3", "--noisy-marker", "3", "--shaking", "1", "--tails", "4",
            "--outliers", "0.001"],
}
# An elastic rod instead of a chain of links, filmed under these conditions, as make_recording's options.
CAMERA = ["--lens", "0.005", "--shutter", "0.002", "--misplaced", "0.002"]
KNOWNS = ["--knowns-off", "0.01"]
# Friction that is half as much larger at rest; a thin cylinder's drag in air, which goes with Reynolds' number.
LAWS = ["--effect", "friction_law.stribeck=0.5", "--effect", "drag_law.growth=0.08"]
ROD = {
    "rod": [],
    "rod_laws": LAWS,
    "rod_noise": DIRT["all"],
    "rod_camera": CAMERA,
    "rod_knowns": KNOWNS,
    "rod_all": DIRT["all"] + CAMERA + KNOWNS + LAWS,
}
ROD_EFFECTS = ["air_drag_quadratic", "joint_dry_friction", "support_motion", "load_drag", "joint_hysteresis",
               "air_drag_linear", "steady_wind", "rest_curvature", "air_drag_isotropic"]
ROD_ELEMENTS = 48  # half as many move no mark by more than 0.7 mm
# What a wrong camera or wrong knowns may be called; no physics that is missing.
KNOWNS_AND_SENSORS = {"load_mass", "scale", "camera_tilt", "camera_lens", "clock_offset", "marker_offset",
                      "origin_offset", "gravity_tilt", "pivot_rest_angle"}
STRENGTHS = (1, 3, 10)  # times the noise, in what a refitted baseline leaves
NOISES = (0.001, 0.0005, 0.003)  # m
RATES = (60, 30, 120)  # frames/s
LINKS = (24, 48, 36, 60)  # of the hidden chain; the case has 12
SEEDS, QUIET, DOUBLE, OUT, ROD_QUIET, ROD_SINGLE = 20, 500, 60, 60, 300, 300
FIRST_SEED = 70000  # others were used while the diagnosis was changed
FIRST_ROD_SEED = 81000  # likewise
KINDS = ("quiet", "single", "double", "outside", "dirty_quiet", "dirty_single", "rod_quiet", "rod_single")


@dataclasses.dataclass(frozen=True)
class Trial:
    kind: str  # of KINDS
    hidden: tuple  # names
    strength: int
    noise: float
    rate: int
    links: int
    lost: float
    pixel: float
    seed: int
    dirt: str = ""  # of DIRT or ROD; empty: white noise

    def is_rod(self):
        return self.kind.startswith("rod")

    def key(self):
        return (self.kind, "+".join(self.hidden), str(self.strength), str(self.noise), str(self.seed))


def trials():
    """All of them; every beginning is balanced."""
    result = []
    count = {"quiet": 0, "double": 0, "outside": 0}

    def add(kind, hidden, strength, noise, k, dirt=""):
        rod = kind.startswith("rod")
        result.append(Trial(kind, hidden, strength, noise, RATES[k % 3], ROD_ELEMENTS if rod else LINKS[k % 4],
                            0.05 if k % 5 == 4 else 0.0, 0.0005 if k % 7 == 6 else 0.0, (FIRST_ROD_SEED if rod else FIRST_SEED) + k, dirt))

    effects, dirt = list(EFFECTS), list(DIRT)
    rounds = len(STRENGTHS) * len(NOISES) * SEEDS
    for r in range(rounds):
        for i, effect in enumerate(EFFECTS):
            turn = r + i
            add("single", (effect,), STRENGTHS[turn % 3], NOISES[turn // 3 % 3], r)
        for _ in range(6):
            k = count["quiet"]
            if k < QUIET:
                add("quiet", (), 0, NOISES[k % 3], k)
                add("dirty_quiet", (), 0, NOISES[k // len(dirt) % 3], k, dirt[k % len(dirt)])
                count["quiet"] += 1
        add("dirty_single", (effects[r % len(effects)],), STRENGTHS[1 + r // len(effects) % 2],
            NOISES[r // len(dirt) % 3], r, dirt[r % len(dirt)])
        k = count["double"]
        if k < DOUBLE:
            add("double", PAIRS[k % len(PAIRS)], STRENGTHS[1 + k // len(PAIRS) % 2],
                NOISES[k // 2 % 3], k)
            count["double"] += 1
        k = count["outside"]
        if k < OUT:
            add("outside", (list(OUTSIDE)[k % 4],), STRENGTHS[1 + k // 4 % 2], NOISES[k // 8 % 3], k)
            count["outside"] += 1
    for k in range(max(ROD_QUIET, ROD_SINGLE)):
        dirt = list(ROD)[k % len(ROD)]
        noise = NOISES[k // len(ROD) % 2]  # of 1 mm or half of it
        if k < ROD_QUIET:
            add("rod_quiet", (), 0, noise, k, dirt)
        if k < ROD_SINGLE:
            add("rod_single", (ROD_EFFECTS[k % len(ROD_EFFECTS)],), STRENGTHS[1 + k // len(ROD_EFFECTS) % 2],
                noise, k, dirt)
    return result
