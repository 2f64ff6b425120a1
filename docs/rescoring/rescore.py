#!/usr/bin/env python3
"""Makes the score of an attempt again from what `trocar export traces` wrote, and compares.

Shares no code with Trocar: written after docs/scoring.md, with the standard library alone.

    rescore.py FOLDER...        each with trace.csv, events.csv, context.json, rubric.json, result.json

Ends with 1 where a metric, a sub-score or the score differs by more than 1e-9.
"""

import bisect
import copy
import csv
import json
import math
import pathlib
import sys

TOLERANCE = 1e-9
ACTING = ("completed", "timeout")


# -- Reading -----------------------------------------------------------------------------------------------------------

def number(text):
    return float(text) if text else math.nan


def rows(file):
    with open(file, newline="", encoding="utf-8") as lines:
        yield from csv.DictReader(lines)


def vector(row, name, unit):
    return tuple(number(row[f"{name}_{axis}_{unit}"]) for axis in "xyz")


class Attempt:
    def __init__(self, folder):
        folder = pathlib.Path(folder)
        self.context = json.loads((folder / "context.json").read_text())
        self.rubric = json.loads((folder / "rubric.json").read_text())
        self.result = json.loads((folder / "result.json").read_text())
        self.rate_hz = self.result["device"]["rate_hz"]
        events = [dict(t=number(r["t_s"]), type=r["type"], severity=r["severity"], object=int(r["object"]),
                       value=number(r["value"])) for r in rows(folder / "events.csv")]
        samples = [dict(t=number(r["t_s"]), tip=vector(r, "tip", "m"), force=math.hypot(*vector(r, "force", "n")),
                        grip=number(r["grip_n"]), contact=r["contact"] in ("1", "true"),
                        pedal=r["pedal"] in ("1", "true")) for r in rows(folder / "trace.csv")]
        # Only what lies between START and DONE or TIMEOUT is graded.
        start = next((e["t"] for e in events if e["type"] == "START"), None)
        end = next((e["t"] for e in events if start is not None and e["type"] in ("DONE", "TIMEOUT")
                    and e["t"] >= start), math.inf)
        graded = start is not None
        self.events = [e for e in events if graded and start <= e["t"] <= end]
        self.samples = [s for s in samples if graded and start <= s["t"] <= end]
        self.times = [s["t"] for s in self.samples]
        self.end = samples[-1]["t"] if graded and math.isinf(end) else end
        self.seconds = self.end - start if graded else None

    def stage(self, name):
        """A stage of an operation as an attempt of its own, its objects counted from 0; None: it never began."""
        number, context = next((i, c) for i, c in enumerate(self.context["stages"]) if c["stage"] == name)
        begun = [i for i, e in enumerate(self.events) if e["type"] == "STAGE_BEGUN"]
        from_ = next((i for i in begun if self.events[i]["object"] == number), None)
        if from_ is None:
            return None
        to = next((i for i in begun if i > from_), len(self.events))
        end = self.events[to]["t"] if to < len(self.events) else self.end
        own = copy.copy(self)
        own.context = context
        own.events = []
        for event in self.events[from_ + 1:to]:
            index = event["object"] - context["first_object"]
            own.events.append(dict(event, object=index if 0 <= index < context["objects_total"] else -1))
        for event in self.events[to:]:  # clips that came off later
            index = event["object"] - context["first_object"]
            if event["type"] == "CLIP_WASTED" and 0 <= index < context["objects_total"]:
                own.events.append(dict(event, object=index, t=end))
        start = self.events[from_]["t"]
        own.samples = [s for s in self.samples if start <= s["t"] <= end]
        own.times = [s["t"] for s in own.samples]
        own.seconds = end - start
        return own

    def count(self, *types):
        return sum(e["type"] in types for e in self.events)


# -- The filter: butterworth2-zero-phase-10hz, taken at 100 Hz ---------------------------------------------------------

def low_pass(signal, rate_hz, cutoff_hz):
    """2nd-order Butterworth, bilinear with pre-warping, forwards and backwards. The ends are extended by odd reflection
    over three periods of the cut-off; the filter starts in the steady state of its first value."""
    if len(signal) < 2 or cutoff_hz >= 0.45 * rate_hz:
        return signal
    pad = min(len(signal) - 1, math.ceil(3 * rate_hz / cutoff_hz))
    x = ([2 * signal[0] - v for v in signal[pad:0:-1]] + signal +
         [2 * signal[-1] - v for v in signal[-2:-2 - pad:-1]])
    k = math.tan(math.pi * cutoff_hz / rate_hz)
    norm = 1 / (1 + math.sqrt(2) * k + k * k)
    b0 = k * k * norm
    b1, b2, a1, a2 = 2 * b0, b0, 2 * (k * k - 1) * norm, (1 - math.sqrt(2) * k + k * k) * norm

    def once(values):
        s1, s2 = (1 - b0) * values[0], (b2 - a2) * values[0]
        out = []
        for v in values:
            y = b0 * v + s1
            s1, s2 = b1 * v - a1 * y + s2, b2 * v - a2 * y
            out.append(y)
        return out

    x = once(once(x)[::-1])[::-1]
    return x[pad:pad + len(signal)]


def resample(times, values, rate_hz):
    """On a uniform grid, linear between neighbours."""
    out, i = [], 0
    for k in range(math.floor((times[-1] - times[0]) * rate_hz + 1e-6) + 1):
        t = times[0] + k / rate_hz
        while i + 2 < len(times) and times[i + 1] <= t:
            i += 1
        share = min(1.0, max(0.0, (t - times[i]) / (times[i + 1] - times[i])))
        out.append(values[i] + share * (values[i + 1] - values[i]))
    return out


def path_length(attempt):
    if len(attempt.samples) < 2:
        return None
    axes = []
    for axis in range(3):
        fine = low_pass(resample(attempt.times, [s["tip"][axis] for s in attempt.samples], attempt.rate_hz),
                        attempt.rate_hz, 10)
        axes.append(resample([i / attempt.rate_hz for i in range(len(fine))], fine, min(100, attempt.rate_hz)))
    points = list(zip(*axes))
    return sum(math.dist(a, b) for a, b in zip(points, points[1:]))


def ideal_length(context):
    """From each waypoint up by the retract height, across, down to the next; the first leg starts in the air."""
    up = [context["retract_height_m"] * c for c in context["approach"]]
    points = context["waypoints"]
    total = 0.0
    for i, (a, b) in enumerate(zip(points, points[1:])):
        from_ = a if i == 0 else [p + u for p, u in zip(a, up)]
        over = [p + u for p, u in zip(b, up)]
        total += (0 if i == 0 else context["retract_height_m"]) + math.dist(from_, over) + context["retract_height_m"]
    return total


# -- Metrics -----------------------------------------------------------------------------------------------------------

def frozen_spans(attempt):
    """From CLUTCH or PORT_HOLD to INSTRUMENT_FREE."""
    spans, since = [], None
    for e in attempt.events:
        if since is None and e["type"] in ("CLUTCH", "PORT_HOLD"):
            since = e["t"]
        if since is not None and e["type"] == "INSTRUMENT_FREE":
            spans.append((since, e["t"]))
            since = None
    return spans + ([(since, attempt.times[-1])] if since is not None else [])


def mean_share(attempt, judged):
    """judged: (object, time, seconds, force, (low, high)). Time in the band counts up to the context's hold."""
    spans, seconds = frozen_spans(attempt), {}
    for obj, t, w, force, (low, high) in judged:
        times = seconds.setdefault(obj, [0.0, 0.0])
        if not low <= force <= high:
            times[1] += w
        elif not any(a <= t < b for a, b in spans):
            times[0] += w
    most = attempt.context.get("counted_hold_s", 0)
    if most == 0:  # recorded before it was kept
        return None
    shares = [min(i, most) / (min(i, most) + o) for i, o in seconds.values() if min(i, most) + o > 0]
    return sum(shares) / len(shares) if shares else None


def pooled_share(judged):
    """As rubrics of version 1 had it: all objects together."""
    judged = list(judged)
    whole = sum(w for _, _, w, _, _ in judged)
    return sum(w for _, _, w, force, (low, high) in judged if low <= force <= high) / whole if whole > 0 else None


def pressing(attempt):
    t = attempt.times
    weight = [0.0] * len(t)
    for i in range(1, len(t)):
        half = (t[i] - t[i - 1]) / 2
        weight[i] += half
        weight[i - 1] += half
    context = attempt.context
    bands = context.get("object_bands") or [[context["band_low_n"], context["band_high_n"]]]
    rise = context.get("rise_s", 0.5)
    judged, seen = [], set()
    for i, e in enumerate(attempt.events):
        if e["type"] != "TARGET_TOUCHED" or e["object"] in seen:
            continue
        seen.add(e["object"])
        to = next((o["t"] for o in attempt.events[i:] if o["type"] == "TARGET_HELD" and o["object"] == e["object"]),
                  t[-1])
        at = max(0, e["object"])
        band = bands[at] if at < len(bands) else bands[0]
        is_open = False
        for k in range(bisect.bisect_left(t, e["t"]), len(t)):
            if t[k] > to:
                break
            force = attempt.samples[k]["force"]
            is_open = is_open or force >= band[0] or t[k] >= e["t"] + rise
            if is_open:
                judged.append((e["object"], t[k], weight[k], force, band))
    return judged


def carrying(attempt):
    windows, t = attempt.context.get("grip_windows", []), attempt.times
    judged = []
    for i, e in enumerate(attempt.events):
        if e["type"] != "LIFTED" or not 0 <= e["object"] < len(windows):
            continue
        to = next((o["t"] for o in attempt.events[i:] if o["type"] == "SET_DOWN" and o["object"] == e["object"]), t[-1])
        for k in range(1, len(t)):
            if e["t"] < t[k] <= to:
                judged.append((e["object"], t[k], t[k] - t[k - 1], attempt.samples[k]["grip"], windows[e["object"]]))
    return judged


def matched_in_time_share(attempt):
    late, done = set(), set()
    for e in attempt.events:
        if e["type"] == "TARGET_TIMEOUT":
            late.add(e["object"])
        if e["type"] == "TARGET_HELD" and e["object"] not in late:
            done.add(e["object"])
    return len(done) / attempt.context["objects_total"]


def mean_value(attempt, kind, factor=1.0):
    values = [e["value"] for e in attempt.events if e["type"] == kind]
    return factor * (sum(values) / len(values)) if values else None


def wire_touch_share(attempt):
    """Gate by gate from its TARGET_LIT to the next: time in contact over that of an unhurried way, 1 at most."""
    lit, t = [e["t"] for e in attempt.events if e["type"] == "TARGET_LIT"], attempt.times
    shares, k = [], 1
    for i, since in enumerate(lit):
        to, touching = lit[i + 1] if i + 1 < len(lit) else t[-1], 0.0
        while k < len(t) and t[k] <= to:
            if attempt.samples[k]["contact"] and t[k] > since:
                touching += t[k] - t[k - 1]
            k += 1
        shares.append(min(1.0, touching / attempt.context["counted_hold_s"]))
    return sum(shares) / len(shares) if shares else None


def search_share(attempt):
    if not attempt.count("NODULE_FOUND", "FALSE_MARK", "SEARCH_ENDED"):
        return None
    return (attempt.count("NODULE_FOUND") - attempt.count("FALSE_MARK")) / attempt.context["objects_total"]


def pressed_well_share(attempt):
    presses = [e for e in attempt.events if e["type"] == "PLACE_PRESSED"]
    return sum(e["value"] for e in presses if e["severity"] == "info") if presses else None


def right_answers_share(attempt):
    if not attempt.count("ANSWERED", "WRONG_ANSWER"):
        return None
    right = {e["object"] for e in attempt.events if e["type"] == "ANSWERED"}
    return len(right) / attempt.context["objects_total"]


def path_ratio(attempt):
    length, ideal = path_length(attempt), ideal_length(attempt.context)
    return length / ideal if length and ideal > 0 else None


def force_max(attempt):
    touched = any(s["contact"] for s in attempt.samples)
    return max(s["force"] for s in attempt.samples) if touched else None


def beyond_soft(attempt, part):
    """In contact, beyond the soft limit; a sample stands for half of the way to its neighbours."""
    t, total, soft = attempt.times, 0.0, attempt.context["soft_force_n"]
    for i, sample in enumerate(attempt.samples):
        weight = (t[min(i + 1, len(t) - 1)] - t[max(i - 1, 0)]) / 2
        total += weight * part(sample["force"], soft) if sample["contact"] and sample["force"] > soft else 0
    return total if any(s["contact"] for s in attempt.samples) else None


def grip_mean(attempt):
    """Over the time with a grip above 0.05 N; a sample stands for half of the way to its neighbours."""
    t, total, held = attempt.times, 0.0, 0.0
    for i, sample in enumerate(attempt.samples):
        if sample["grip"] > 0.05:
            weight = (t[min(i + 1, len(t) - 1)] - t[max(i - 1, 0)]) / 2
            total += sample["grip"] * weight
            held += weight
    return total / held if held > 0 else None


def last_told(attempt, kind):
    """Mean over objects of what was last told of each."""
    last = {e["object"]: e["value"] for e in attempt.events if e["type"] == kind}
    return sum(last.values()) / len(last) if last else None


def first_told(attempt, kind):
    first = {e["object"]: e["value"] for e in reversed(attempt.events) if e["type"] == kind}
    return sum(first.values()) / len(first) if first else None


def time_per_target(attempt):
    done = attempt.context["objects_done"]
    return (attempt.times[-1] - attempt.times[0]) / done if attempt.count("HORIZON_KEPT") and done else None


def holds_lost(attempt):
    return attempt.count("SLIP", "LET_GO", "COVERED") if attempt.count("TISSUE_TAKEN") else None


def clip_metric(value):
    """None until something was named, clipped or cut."""
    def of(attempt):
        return value(attempt) if attempt.count("NAMED", "CLIP_SET", "CLIP_WASTED", "DIVIDED") else None
    return of


def clips_correct_share(attempt):
    good = set()
    for event in attempt.events:
        if event["type"] == "CLIP_SET":
            good.add(event["object"])
        if event["type"] == "CLIP_WASTED":
            good.discard(event["object"])
    return len(good) / 6


def clip_errors(attempt):
    close = sum(e["type"] == "DIVIDED" and e["severity"] != "info" for e in attempt.events)
    return attempt.count("CLIP_WASTED", "WRONG_STRUCTURE") + close
def of_strands(value):
    """None until a strand was divided."""
    return lambda attempt: value(attempt) if attempt.count("STRAND_DIVIDED") else None


def strand_clearance_share(attempt):
    asked_m = attempt.context.get("strand_lift_m", 0.006)
    return sum(min(1, e["value"] / asked_m) for e in attempt.events
               if e["type"] == "STRAND_DIVIDED" and e["severity"] != "major") / attempt.context.get("strands_total", 5)


def safe_energy_share(attempt):
    total = 0.0
    objects = attempt.context["objects_total"]
    for i in range(objects):
        def seconds(kind):
            return sum(e["value"] for e in attempt.events if e["type"] == kind and e["object"] == i)
        safe = seconds("CURRENT_USED")
        if safe > 0:
            total += safe / (safe + seconds("UNSAFE_CURRENT")) / objects
    return total


def spurts_at(attempt):
    return next((e["t"] for e in attempt.events if e["type"] == "SPURTS"), None)


def spurted_ml(attempt):
    since = spurts_at(attempt)
    told = [e["value"] for e in attempt.events
            if since is not None and e["t"] >= since and e["type"] in ("SPURTS", "BLEEDING", "SEALED")]
    return told[-1] if told else None


def strand_current(attempt):
    until = spurts_at(attempt)
    down = sum(s["pedal"] and (until is None or s["t"] < until) for s in attempt.samples)
    return down / attempt.rate_hz / attempt.count("STRAND_DIVIDED")


def of_pegs(attempt, *kinds):
    """Count of these events; None before a ring was on a peg."""
    return attempt.count(*kinds) if attempt.count("BUMP", "TARGET_HELD") else None


def transfer_errors(attempt):
    drops, bumps = of_pegs(attempt, "DROP"), of_pegs(attempt, "BUMP")
    return None if drops is None else drops + bumps / 2


def mean_of_pairs(kind):
    """Mean over objects of the mean of what was told of each."""
    def of(attempt):
        pairs = {}
        for event in attempt.events:
            if event["type"] == kind:
                pairs.setdefault(event["object"], []).append(event["value"])
        return sum(sum(values) / len(values) for _, values in sorted(pairs.items())) / len(pairs) if pairs else None
    return of


def needle_redos(attempt):
    if not attempt.count("NEEDLE_GRIPPED"):
        return None
    again = sum(e["type"] == "NEEDLE_GRIPPED" and e["severity"] != "info" for e in attempt.events)
    return again + attempt.count("BITE_UNDONE", "NEEDLE_LOST")


def gauze_metric(value):
    """None until something was cut."""
    def of(attempt):
        return value(attempt) if attempt.count("SNIP") else None
    return of


def sum_of(attempt, name):
    return sum(e["value"] for e in attempt.events if e["type"] == name)


METRICS = {
    "time_s": lambda a: a.seconds,
    "wrong_places": lambda a: a.count("WRONG_PLACE"),
    "excess_events": lambda a: a.count("EXCESS_FORCE", "GRIP_EXCESS"),
    "path_ratio": path_ratio,
    "object_in_band_share": lambda a: mean_share(a, pressing(a)),
    "object_grip_window_share": lambda a: mean_share(a, carrying(a)),
    "in_band_share": lambda a: pooled_share(pressing(a)),
    "grip_window_share": lambda a: pooled_share(carrying(a)),
    "crushed": lambda a: a.count("CRUSH"),
    "block_regrasps": lambda a: a.count("REGRASP"),
    "objects_done_share": lambda a: a.context["objects_done"] / a.context["objects_total"],
    "matched_in_time_share": matched_in_time_share,
    "position_error_m": lambda a: mean_value(a, "POSITION_ERROR"),
    "angle_error_deg": lambda a: mean_value(a, "ANGLE_ERROR", 180 / math.pi),
    "wire_touch_share": wire_touch_share,
    "wire_touches": lambda a: a.count("WIRE_TOUCHED"),
    "ring_angle_deg": lambda a: mean_value(a, "ANGLE_ERROR", 180 / math.pi),
    "time_per_target_s": time_per_target,
    "horizon_share": lambda a: last_told(a, "HORIZON_KEPT"),
    "wall_contacts": lambda a: a.count("WALL_CONTACT") if a.count("HORIZON_KEPT") else None,
    "view_jerks": lambda a: last_told(a, "VIEW_JERKS"),
    "force_max_n": force_max,
    "soft_impulse_ns": lambda a: beyond_soft(a, lambda force, soft: force - soft),
    "pressed_impulse_ns": lambda a: beyond_soft(a, lambda force, soft: force),
    "grip_mean_n": grip_mean,
    "time_to_expose_s": lambda a: first_told(a, "EXPOSED"),
    "holds_lost": holds_lost,
    "right_answers_share": right_answers_share,
    "transfer_errors": transfer_errors,
    "grip_marks": lambda a: of_pegs(a, "GRIP_EXCESS"),
    "search_share": search_share,
    "clips_correct_share": clip_metric(clips_correct_share),
    "clip_errors": clip_metric(clip_errors),
    "clip_angle_deg": lambda a: mean_value(a, "CLIP_SET"),
    "cut_off_middle_m": lambda a: mean_value(a, "DIVIDED"),
    "entry_error_m": mean_of_pairs("BITE_BEGUN"),
    "exit_error_m": mean_of_pairs("BITE_THROUGH"),
    "needle_angle_deg": mean_of_pairs("NEEDLE_DRAWN"),
    "needle_redos": needle_redos,
    "safe_energy_share": of_strands(safe_energy_share),
    "strands_lifted_share": of_strands(
        lambda a: sum(e["type"] == "STRAND_DIVIDED" and e["severity"] == "info" for e in a.events)
        / a.context.get("strands_total", 5)),
    "strand_clearance_share": of_strands(strand_clearance_share),
    "spurted_ml": spurted_ml,
    "strand_current_s": of_strands(strand_current),
    "cut_area_share": gauze_metric(lambda a: sum_of(a, "SNIP")),
    "cut_outside_share": gauze_metric(lambda a: min(1, sum_of(a, "OFF_LINE"))),
    "hard_pulls": gauze_metric(lambda a: a.count("PULLED_HARD")),
    "pressed_well_share": pressed_well_share,
    "localisation_error_m": lambda a: mean_value(a, "NODULE_FOUND"),
}


# -- The score ---------------------------------------------------------------------------------------------------------

def score(attempt):
    """@return score, {sub-score: (metric's value, share)}"""
    rubric, context = attempt.rubric, attempt.context
    if context["outcome"] not in ACTING or attempt.result["status"] == "void":
        return None, {}  # nothing is graded: left, ended by the device, or its record or pacing is unfit
    parts, total, most, danger = {}, 0.0, 100.0, 100.0
    for rule in rubric["subscores"]:
        stage, _, metric = rule["metric"].rpartition("/")
        if metric not in METRICS:
            raise SystemExit(f"this program does not know the metric {metric}")
        judged = attempt.stage(stage) if stage else attempt
        raw = METRICS[metric](judged) if judged else None
        share = 0.0 if raw is None else (raw - rule["zero_at"]) / (rule["full_at"] - rule["zero_at"])
        share = min(1.0, max(0.0, share))
        parts[rule["name"]] = (raw, share)
        total += rule["weight"] * share
        if rule["gate"] and share < rule["gate_below"]:
            danger = min(danger, rubric["gate_cap"])
    if any(e["severity"] == "critical" for e in attempt.events):
        danger = min(danger, rubric["critical_cap"])
    if context["outcome"] == "timeout" or context["objects_done"] < context["objects_total"]:
        most = min(most, rubric["unfinished_cap"] * context["objects_done"] / context["objects_total"])
    return min(total * danger if rubric["caps"] == "scale" else min(100 * total, danger), most), parts


def differs(a, b):
    return (a is None) != (b is None) or (a is not None and abs(a - b) > TOLERANCE)


def main(folders):
    wrong = 0
    for folder in folders:
        attempt = Attempt(folder)
        made, parts = score(attempt)
        told = attempt.result["score"]
        if differs(made, told):
            wrong += 1
            print(f"{folder}: score {made}, Trocar says {told}")
        for part in attempt.result["subscores"]:
            raw, share = parts.get(part["name"], (None, None))
            for what, own, theirs in (("value", raw, part["raw"]), ("share", share, part["value"])):
                if differs(own, theirs):
                    wrong += 1
                    print(f"{folder}: {part['name']}, {what}: {own}, Trocar says {theirs}")
        print(f"{folder}: {'no score' if made is None else f'{made:.6f}'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
