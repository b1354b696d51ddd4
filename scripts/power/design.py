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
BESIDE = ("air_drag_quadratic", "joint_dry_friction", "support_motion", "load_drag")  # of something of OUTSIDE
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
# Friction that is half as much larger at rest; a thin cylinder's drag in air, which goes with Reynolds' number.
LAWS = ["--effect", "friction_law.stribeck=0.5", "--effect", "drag_law.growth=0.08"]
ROD = {
    "rod": [],
    "rod_laws": LAWS,
    "rod_noise": DIRT["all"],
    "rod_camera": CAMERA,
    "rod_knowns": [],
    "rod_all": DIRT["all"] + CAMERA + LAWS,
}
WRONG_KNOWNS = {"density": 0.01, "load": 0.01, "length": 0.002}  # shares of rod_knowns and rod_all, up or down
ROD_EFFECTS = ["air_drag_quadratic", "joint_dry_friction", "support_motion", "load_drag", "joint_hysteresis",
               "air_drag_linear", "steady_wind", "rest_curvature", "air_drag_isotropic"]
# Friction of a rod sticks, and the library has a form of it that does (form_of in its description).
ROD_FORMS = {"joint_dry_friction": "joint_hysteresis"}
ROD_ELEMENTS = 48  # half as many move no mark by more than 0.7 mm
# What a wrong camera or wrong knowns may be called; no physics that is missing.
KNOWNS_AND_SENSORS = {"load_mass", "scale", "camera_tilt", "camera_lens", "clock_offset", "marker_offset",
                      "marker_places", "cable", "origin_offset", "gravity_tilt", "pivot_rest_angle"}


@dataclasses.dataclass(frozen=True)
class Setup:
    """A cable, how it is filmed and what model the case has; in place of those of CABLE."""

    cable: dict  # make_recording's options
    effects: tuple  # that may be hidden
    truth: str = "rod"  # or a chain of links
    links: int = 12  # of the case
    own_strengths: bool = True  # whether amplitudes are measured on this cable, not on CABLE

    def length(self):
        return float(self.cable.get("--length", CABLE["--length"]))


# 1.2 m, half a pound at its end, stiff enough for few links.
CABLE = {"--length": "1.2", "--bending-stiffness": "0.1", "--bending-damping": "0.01", "--load": "0.2",
         "--held": "0.6 0.9", "--duration": "4", "--markers": "12"}
_PHYSICS = ("air_drag_quadratic", "joint_dry_friction", "support_motion", "rest_curvature")
SETUPS = {
    "strip": Setup({"--length": "0.3", "--density": "0.05", "--bending-stiffness": "0.02",
                    "--bending-damping": "0.0002", "--load": "0.05", "--held": "0.1 0.26", "--duration": "3"}, _PHYSICS),
    "rope": Setup({"--length": "10", "--density": "0.3", "--bending-stiffness": "0.5",
                   "--bending-damping": "0.05", "--load": "1", "--held": "4 8", "--duration": "10"}, _PHYSICS),
    "wire": Setup({"--length": "1.5", "--density": "0.0245", "--bending-stiffness": "0.157",  # 2 mm of steel
                   "--bending-damping": "0.002", "--load": "0.2", "--held": "0.7 1.2"}, _PHYSICS),
    "bob": Setup({"--length": "1", "--density": "5e-6", "--bending-stiffness": "1e-6", "--bending-damping": "2e-5",
                  "--load": "0.2", "--held": "0.5 0.866", "--duration": "10", "--markers": "1", "--links": "10"},
                 ("load_drag", "support_motion", "camera_tilt"), truth="chain", links=1),
    "2 markers": Setup({"--markers": "2"}, _PHYSICS, own_strengths=False),
    "4 markers": Setup({"--markers": "4"}, _PHYSICS, own_strengths=False),
    "1 s": Setup({"--duration": "1"}, _PHYSICS, own_strengths=False),
    "20 s": Setup({"--duration": "20"}, _PHYSICS, own_strengths=False),
    "2 recordings": Setup({"--recordings": "2"}, _PHYSICS, own_strengths=False),
    "4 recordings": Setup({"--recordings": "4", "--duration": "2"}, _PHYSICS, own_strengths=False),
}
# A known that the case states wrongly, by these shares (up or down), or by m for the marks' places.
KNOWNS = {"length": (0.005, 0.01, 0.03), "density": (0.005, 0.01, 0.03), "load": (0.005, 0.01, 0.03),
          "marks": (0.002, 0.0035, 0.005)}
# What a wrong known is rightly called. The density has no name of its own: any other known or sensor may do.
CALLED = {"load": {"load_mass"}, "marks": {"marker_places"}, "length": {"cable"}, "density": KNOWNS_AND_SENSORS}
STRENGTHS = (1, 3, 10)  # times the noise, in what a refitted baseline leaves
NOISES = (0.001, 0.0005, 0.003)  # m
RATES = (60, 30, 120)  # frames/s
LINKS = (24, 48, 36, 60)  # of the hidden chain; the case has 12
# How many trials of each kind, and the first seed of each: others were used while the diagnosis was changed. In all they
# take two cores six hours; what a diagnosis costs most of is filmed least.
COUNTS = {"quiet": 500, "dirty_quiet": 500, "single": 1008, "dirty_single": 336, "double": 100, "outside": 200,
          "beside": 16, "known": 240, "rod_quiet": 120, "rod_single": 90, "setup_quiet": 160, "setup_single": 100}
KINDS = tuple(COUNTS)
FIRST_SEED = 1300000


@dataclasses.dataclass(frozen=True)
class Trial:
    kind: str  # of KINDS
    hidden: tuple  # names, of EFFECTS and OUTSIDE; of KNOWNS in the kind known
    strength: int
    noise: float
    rate: int
    links: int
    lost: float
    pixel: float
    seed: int
    dirt: str = ""  # of DIRT or ROD; empty: white noise
    setup: str = ""  # of SETUPS; empty: CABLE
    off: float = 0.0  # by how much a known is wrong

    def is_rod(self):
        return self.kind.startswith("rod") or (self.setup != "" and SETUPS[self.setup].truth == "rod")

    def key(self):
        return (self.kind, "+".join(self.hidden), str(self.strength), str(self.noise), str(self.seed))


def _of_kind(kind, k):
    """Trial k of a kind: names, strengths, noises, dirt and set-ups go round at different paces."""
    hidden, strength, noise, dirt, setup, off = (), 0, NOISES[k % 3], "", "", 0.0
    if kind == "dirty_quiet":
        dirt, noise = list(DIRT)[k % len(DIRT)], NOISES[k // len(DIRT) % 3]
    elif kind == "single":
        i, turn = k % len(EFFECTS), k // len(EFFECTS) + k % len(EFFECTS)
        hidden, strength, noise = (list(EFFECTS)[i],), STRENGTHS[turn % 3], NOISES[turn // 3 % 3]
    elif kind == "dirty_single":
        hidden, strength = (list(EFFECTS)[k % len(EFFECTS)],), STRENGTHS[1 + k // len(EFFECTS) % 2]
        dirt, noise = list(DIRT)[k % len(DIRT)], NOISES[k // len(DIRT) % 3]
    elif kind == "double":
        hidden, strength = PAIRS[k % len(PAIRS)], STRENGTHS[1 + k // len(PAIRS) % 2]
        noise = NOISES[k // 2 % 3]
    elif kind == "outside":
        hidden, strength = (list(OUTSIDE)[k % 4],), STRENGTHS[1 + k // 4 % 2]
        noise = NOISES[k // 8 % 3]
    elif kind == "beside":
        hidden = (list(OUTSIDE)[k % 4], BESIDE[k // 4 % len(BESIDE)])
        strength, noise = STRENGTHS[1 + k // 16 % 2], NOISES[k // 32 % 3]
    elif kind == "known":
        name = list(KNOWNS)[k % len(KNOWNS)]
        hidden, off, noise = (name,), KNOWNS[name][k // len(KNOWNS) % 3], NOISES[k // 12 % 3]
    elif kind.startswith("rod"):
        dirt, noise = list(ROD)[k % len(ROD)], NOISES[k // len(ROD) % 2]  # of 1 mm or half of it
    elif kind.startswith("setup"):
        setup, dirt = list(SETUPS)[k % len(SETUPS)], "all" if k // len(SETUPS) % 2 else ""
        noise = NOISES[k // len(SETUPS) % 2] * SETUPS[setup].length() / float(CABLE["--length"])
        noise = round(noise, 9)
    if kind == "rod_single":
        hidden, strength = (ROD_EFFECTS[k % len(ROD_EFFECTS)],), STRENGTHS[1 + k // len(ROD_EFFECTS) % 2]
    if kind == "setup_single":
        some, turn = SETUPS[setup].effects, k // len(SETUPS)
        hidden, strength = (some[turn % len(some)],), STRENGTHS[1 + turn // len(some) % 2]
    rod = kind.startswith("rod") or (setup and SETUPS[setup].truth == "rod")
    rate = 30 if setup == "20 s" else RATES[(k + k // 6) % 3]
    links = ROD_ELEMENTS if rod else LINKS[(k + k // 4) % 4]
    return Trial(kind, hidden, strength, noise, rate, links,
                 0.05 if k % 5 == 4 else 0.0, 0.0005 if k % 7 == 6 and not setup else 0.0,
                 FIRST_SEED + 1000 * KINDS.index(kind) + k, dirt, setup, off)


def trials():
    """All of them. Every beginning has of each kind the same share of its trials."""
    order = [((k + 0.5) / count, i, k) for i, count in enumerate(COUNTS.values()) for k in range(count)]
    return [_of_kind(KINDS[i], k) for _, i, k in sorted(order)]
