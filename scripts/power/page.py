# SPDX-License-Identifier: BSD-3-Clause
"""docs/power.md from the lines of the trials."""

import math
import re
import statistics

from power import design
from power.outcome import key
from power.program import hash_of_sources

HEAD = """# How often a diagnosis is right

Made by `scripts/power_study`, which goes on where it was stopped: {done} of {all} trials. Every line of
`docs/power/trials.csv` is one: a cable of 1.2 m with EI 0.1 N m², 24 to 60 links (the case has 12),
filmed for 4 s at 30, 60 or 120 Hz with 12 markers and 0.5, 1 or 3 mm of noise, now and then with lost
markers or whole pixels; the last 30 % held out. What is hidden is coded apart
from the models (`truth`) and integrated by another method. The kinds:

| kind | trials | what |
|---|---|---|
{kinds}
Noise of other kinds: correlated in time,
smoothed tracks, one marker three times noisier, a camera that shakes, Student's t with 4 degrees of
freedom, 0.1 % outliers of 20 standard deviations, or all but smoothing. The elastic rod has {elements} finite elements
and friction that sticks. It is filmed well (`rod`), with friction half as
much larger at rest and drag that goes with Reynolds' number (`rod_laws`), with all noise but smoothing
(`rod_noise`), by a camera with a lens, a shutter that rolls for 2 ms and marks misplaced by 2 mm (`rod_camera`), with density
and load stated 1 % wrong and the length 0.2 % (`rod_knowns`), or all of these (`rod_all`). Of rods, what is said of knowns and
sensors does not count, for it may be so; what is said of physics does. Friction of a rod sticks: `joint_hysteresis`, the form of
`joint_dry_friction` that does, counts as that. The other set-ups (`scripts/power/design.py`): a strip of
0.3 m, a rope of 10 m, a steel wire of 2 mm, all three rods; a bob on a string, with a case of one link; 2 and 4 markers; 1 and
20 s; 2 and 4 recordings; every second turn with all noise but smoothing.

An effect's strength is what a refitted
baseline leaves of it, in units of the noise (`docs/power/strengths.csv`). Rates are the observed ones
with their 95 % intervals (Clopper and Pearson). The limits of the diagnosis were set while looking at other seeds of
the same kinds of recordings. An effect whose other form is named (`form_of`) counts as named. The true share of an
effect is that of the same film without noise, with the same marks lost: the effects found are fitted to it in all subsets.
{program}

"""
KINDS = {
    "quiet": "nothing missing, white noise",
    "dirty_quiet": "nothing missing, noise of other kinds",
    "single": "one effect of the library, strength 1, 3 or 10",
    "dirty_single": "one effect, strength 3 or 10, noise of other kinds",
    "double": "two effects",
    "outside": "something that is in no library",
    "beside": "something that is in no library, and an effect of it",
    "known": "length, density or load stated 0.5, 1 or 3 % wrong, or marks misplaced by 2, 3.5 or 5 mm (standard deviation); "
             "a wrong density has no name of its own, any known or sensor counts as right there; physics is wrong",
    "rod_quiet": "an elastic rod, nothing missing",
    "rod_single": "an elastic rod, one effect, strength 3 or 10",
    "setup_quiet": "other cables, markers, durations, numbers of recordings; nothing missing",
    "setup_single": "the same, one effect, strength 3 or 10",
}
BOUNDS = """An asked bound is `met` where the whole interval lies within it, `missed` where all of it lies beyond,
and `not shown` where the trials are too few to tell.

"""
KNOWN_PROGRAM = "The sources of the trials have the SHA-256 `{hash}` (`docs/power/program.txt`). {others}"
SINCE = """ The sources
have changed since. These are the rates of the program of then, by its rules and by what counted as right then;
[diagnosis.md](diagnosis.md#limits) says what is newer."""
OLD_PROGRAM = """The trials so far were run before the sources' hash was
kept, with rules of choice that have changed since: the held-out part now rules effects out, and a verdict
may be `partly`."""


def bounds(hits, count):
    """95 % interval of a rate (Clopper and Pearson): outside of it, what was observed or more of it has 2.5 %."""
    at_most = lambda k, p: sum(math.comb(count, i) * p**i * (1 - p)**(count - i) for i in range(k + 1))

    def where(falling, level):  # bisection of a function that falls with p
        low, high = 0.0, 1.0
        for _ in range(50):
            middle = (low + high) / 2
            low, high = (middle, high) if falling(middle) > level else (low, middle)
        return low

    lower = where(lambda p: at_most(hits - 1, p), 0.975) if hits > 0 else 0.0
    return lower, where(lambda p: at_most(hits, p), 0.025) if hits < count else 1.0


def interval(hits, count, together=1):
    """`together`: so many come as one, and say no more than one."""
    if count == 0:
        return "-"
    lower, upper = bounds(round(hits / together), round(count / together))
    return f"{hits}/{count} = {100 * hits / count:.1f} % ({100 * lower:.1f} to {100 * upper:.1f})"


def write(file, rows, seconds, program):
    """`seconds`: CPU time of each diagnosis, by outcome.key(row); `program`: program.text_of() the trials."""
    ran = [r for r in rows if r["verdict"] not in ("not reached", "not filmed")]
    kinds = "".join(f"| `{kind}` | {len(of_kind(rows, kind))} of {design.COUNTS[kind]} | {what} |\n"
                    for kind, what in KINDS.items())
    text = HEAD.format(done=len(rows), all=len(design.trials()), elements=design.ROD_ELEMENTS, kinds=kinds,
                       program=said_of(program))
    text += rates(ran, seconds) + by_effect(ran) + confusion(ran) + by_dirt(ran) + others(ran) + not_run(rows)
    file.write_text(text)


def said_of(program):
    hash_of_trials, _, others = program.partition("\n")
    if not hash_of_trials:
        return OLD_PROGRAM
    return KNOWN_PROGRAM.format(hash=hash_of_trials, others=others) + (SINCE if hash_of_trials != hash_of_sources() else "")


def of_kind(rows, kind):
    return [r for r in rows if r["kind"] == kind]


def right(row):
    """As outcome.judged() says, but `partly` does not count: it may leave out some of what is hidden."""
    return row["right"] == "yes" and row["verdict"] != "partly"


def met(asked, observed):
    """Whether the interval lies within what is asked, beyond it, or holds the bound."""
    wanted = [float(number) for number in re.findall(r"\d+", asked)]
    if not wanted:
        return ""
    lower, upper = map(float, re.search(r"\((.*) to (.*)\)", observed).groups())
    least, most = (wanted if len(wanted) == 2 else [0, wanted[0]] if "most" in asked else [wanted[0], 100])
    if least <= lower and upper <= most:
        return "met"
    return "missed" if upper < least or lower > most else "not shown"


def table(header, lines):
    text = "| " + " | ".join(header) + " |\n|" + "---|" * len(header) + "\n"
    return text + "".join("| " + " | ".join(line) + " |\n" for line in lines) + "\n"


def rates(rows, seconds):
    kinds = {kind: of_kind(rows, kind) for kind in design.KINDS}
    single = kinds["single"]
    strong = [r for r in single if int(r["strength"]) >= 3]
    count = lambda some, test: interval(sum(map(bool, map(test, some))), len(some))
    named = lambda r: r.get("effects") and r["right"] == "no"
    wrong = lambda r: r["verdict"] == "named" and r["right"] == "no"
    not_none = lambda r: r["verdict"] != "none"
    nothing_missing = [r for kind in design.KINDS if kind.endswith("quiet") for r in kinds[kind]]
    other_truths = kinds["dirty_single"] + kinds["rod_single"] + kinds["setup_single"]
    of_known = [r for r in strong + kinds["dirty_single"] if r["hidden"] in design.KNOWNS_AND_SENSORS]
    certain = [r for r in rows if r["verdict"] == "partly" and r.get("certain")]
    shares = [tuple(map(int, r["shares_held"].split("/"))) for r in rows if r.get("shares_held")]
    lines = [
        ["nothing missing, all kinds: something named", "at most 2 %", count(nothing_missing, named)],
        ["... white noise", "at most 2 %", count(kinds["quiet"], named)],
        ["... noise of other kinds", "at most 2 %", count(kinds["dirty_quiet"], named)],
        ["... rod: physics named", "at most 2 %", count(kinds["rod_quiet"], named)],
        ["... other set-ups", "at most 2 %", count(kinds["setup_quiet"], named)],
        ["nothing missing, white noise: not called `none`", "", count(kinds["quiet"], not_none)],
        ["nothing missing, noise of other kinds: not called `none`", "", count(kinds["dirty_quiet"], not_none)],
        ["strength 3 and more: right name, or among indistinguishable ones", "at least 95 %",
         count(strong, right)],
        ["other noise, rods and other set-ups: right name, or among indistinguishable ones", "at least 90 %",
         count(other_truths, right)],
        ["... noise of other kinds", "at least 90 %", count(kinds["dirty_single"], right)],
        ["... rod", "at least 90 %", count(kinds["rod_single"], right)],
        ["... other set-ups", "at least 90 %", count(kinds["setup_single"], right)],
        ["strength 3 and more: named wrongly", "at most 2 %", count(strong, wrong)],
        ["other noise, rods and other set-ups: named wrongly", "at most 2 %", count(other_truths, wrong)],
        ["... noise of other kinds", "at most 2 %", count(kinds["dirty_single"], wrong)],
        ["... rod", "at most 2 %", count(kinds["rod_single"], wrong)],
        ["... other set-ups", "at most 2 %", count(kinds["setup_single"], wrong)],
        ["both of two effects", "at least 80 %", count(kinds["double"], right)],
        ["outside the library: called unexplained, or a law discovered alone", "at least 90 %",
         count(kinds["outside"], right)],
        ["a part called certain in `partly` that is not there", "at most 5 %",
         count(certain, lambda r: r["right"] == "no")],
        ["intervals of shares that hold the true share", "90 to 97 %",
         # Two shares of a part add up to almost one: their intervals hold or miss together.
         interval(sum(hits for hits, _ in shares), sum(of for _, of in shares), together=2)],
        ["a wrong known or sensor, strength 3 and more: blamed rightly", "at least 90 %", count(of_known, right)],
        ["length, density, load or marks wrong, something named: blamed rightly", "at least 90 %",
         count([r for r in kinds["known"] if r.get("effects")], right)],
        ["length, density, load or marks wrong: nothing named", "",
         count(kinds["known"], lambda r: not r.get("effects"))],
    ]
    for s in design.STRENGTHS:
        some = [r for r in single if int(r["strength"]) == s]
        lines.append([f"strength {s}: something found", "", count(some, lambda r: r["verdict"] != "none")])
        lines.append([f"strength {s}: right", "", count(some, right)])
    lines = [line + [met(line[1], line[2])] for line in lines if line[2] != "-"]
    text = "## Rates\n\n" + BOUNDS + table(["what", "asked", "observed", "asked bound"], lines)
    return text + times(rows, seconds)


def times(rows, seconds):
    """CPU times by what was said, in one line: no machine repeats it."""
    def said(verdicts, effects):
        return [seconds[key(r)] for r in rows if key(r) in seconds and r["verdict"] in verdicts
                and len(r["effects"].split("+")) in effects]

    parts = []
    for what, spent, asked in (
            ("one name", said(["named"], [1]), 30),
            ("nothing missing or two names", said(["none"], [1]) + said(["named"], [2]), 120),
            ("any other verdict", said(["ambiguous", "partly", "discovered", "unexplained"], range(9)), 120)):
        if spent:
            within = sum(t <= asked for t in spent)
            parts.append(f"{what}: {within} of {len(spent)} within {asked} s (median {statistics.median(spent):.1f} s, "
                         f"longest {max(spent):.1f} s)")
    return "CPU time of a diagnosis, compiling where the cache lacked a model; " + "; ".join(parts) + ".\n\n" if parts else ""


def by_effect(rows):
    lines = []
    for effect in design.EFFECTS:
        line = [effect]
        for s in design.STRENGTHS:
            some = [r for r in of_kind(rows, "single")
                    if r["hidden"] == effect and int(r["strength"]) == s]
            line.append(f"{sum(map(right, some))}/{len(some)}" if some else "-")
        lines.append(line)
    return "## Right, by effect and strength\n\n" + table(
        ["hidden", *(f"strength {s}" for s in design.STRENGTHS)], lines)


def by_dirt(rows):
    lines = []
    hits = lambda some, test: f"{sum(map(bool, map(test, some)))}/{len(some)}"
    for dirt in (*design.DIRT, *design.ROD):
        some = [r for r in rows if r["dirt"] == dirt and not r["setup"]]
        quiet, single = [r for r in some if not r["hidden"]], [r for r in some if r["hidden"]]
        lines.append([dirt, hits(quiet, lambda r: r["right"] == "no" and r.get("effects")),
                      hits(quiet, lambda r: r["verdict"] != "none"), hits(single, right)])
    return "## By kind of noise\n\n" + table(
        ["noise", "something named, nothing hidden", "not called `none`", "right, strength 3 and 10"], lines)


def said(row):
    if row["verdict"] == "named":
        return row["effects"]
    if row["verdict"] in ("ambiguous", "partly"):
        return f"{row['verdict']}: {row['members' if row['verdict'] == 'ambiguous' else 'effects']}"
    return row["verdict"]


def confusion(rows):
    lines = []
    for effect in design.EFFECTS:
        counts = {}
        for r in of_kind(rows, "single"):
            if r["hidden"] == effect and int(r["strength"]) >= 3:
                counts[said(r)] = counts.get(said(r), 0) + 1
        if counts:
            told = "; ".join(f"{n} {what.replace('+', ', ')}"
                             for what, n in sorted(counts.items(), key=lambda c: (-c[1], c[0])))
            lines.append([effect, told])
    return "## What was said (confusion), strength 3 and 10\n\n" + table(["hidden", "said"], lines)


def others(rows):
    text = ""
    for kind, title in [("quiet", "Quiet recordings that were not `none`"),
                        ("double", "Two effects"), ("outside", "Outside the library"),
                        ("beside", "Outside the library, and an effect of it"),
                        ("known", "Wrong knowns"),
                        ("rod_quiet", "Rods with nothing missing that were not `none`"), ("rod_single", "Rods"),
                        ("setup_quiet", "Other set-ups with nothing missing that were not `none`"),
                        ("setup_single", "Other set-ups")]:
        some = [r for r in of_kind(rows, kind) if "quiet" not in kind or r["verdict"] != "none"]
        counts = {}
        for r in some:
            hidden = ", ".join(word for word in (r["setup"], *r["hidden"].split("+"), r["dirt"] if not r["hidden"] else "")
                               if word) or "nothing"
            what = (hidden, str(r["off"] or r["strength"]), said(r).replace("+", ", "))
            counts[what] = counts.get(what, 0) + 1
        lines = [[hidden, str(s), told, str(n)] for (hidden, s, told), n in sorted(counts.items())]
        if lines:
            text += f"## {title}\n\n" + table(["hidden", "size" if kind == "known" else "strength", "said", "times"], lines)
    return text


def not_run(rows):
    counts = {}
    for r in rows:
        if r["verdict"] in ("not reached", "not filmed"):
            what = (r["hidden"], str(r["strength"]), str(r["noise_m"]), r["verdict"])
            counts[what] = counts.get(what, 0) + 1
    if not counts:
        return ""
    lines = [[*what, str(n)] for what, n in sorted(counts.items())]
    return ("## Left out of the rates\n\nStrengths that no amplitude within the effect's bounds reaches.\n\n"
            + table(["hidden", "strength", "noise, m", "why", "trials"], lines))
