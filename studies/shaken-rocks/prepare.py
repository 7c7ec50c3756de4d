"""Brings the scan and the motions of the shaken boulder into this folder: `python3 prepare.py [FOLDER]`.

They belong to others (github.com/ZhiangChen/virtual_shake_robot_pybullet, GPL-3) and are no part of this project. FOLDER is a checkout of
that repository; without it each file is downloaded. Writes `rock.obj` and `motions/testNNN.csv`.

A motion is the table's acceleration less its offset at rest, without spikes of a sample or two (the boulder hits the table as it falls:
nothing beyond 1.3 times the stated peak counts), low-passed at 25 Hz both ways, at 200 Hz, from 0.2 to 99.8 % of its energy.
"""

import csv
import math
import pathlib
import sys
import urllib.request

HERE = pathlib.Path(__file__).parent
SOURCE = "https://raw.githubusercontent.com/ZhiangChen/virtual_shake_robot_pybullet/main/"
STEP_S = 0.00125
EVERY = 4
CORNER_HZ = 25.0
SPIKE_G = 1.0
MARGIN = 100


def text(path):
    if len(sys.argv) > 1:
        return (pathlib.Path(sys.argv[1]) / path).read_text(encoding="latin-1")
    with urllib.request.urlopen(SOURCE + path) as answer:
        return answer.read().decode("latin-1")


def median(values):
    ordered = sorted(values)
    middle = len(ordered) // 2
    return ordered[middle] if len(ordered) % 2 else 0.5 * (ordered[middle - 1] + ordered[middle])


def without_spikes(values):
    kept = list(values)
    for k in range(2, len(values) - 2):
        usual = median(values[k - 2 : k + 3])
        if abs(values[k] - usual) > SPIKE_G:
            kept[k] = usual
    return kept


def low_passed(values):
    """Butterworth, second order, forwards and backwards."""
    w = math.tan(math.pi * CORNER_HZ * STEP_S)
    norm = 1.0 / (1.0 + math.sqrt(2.0) * w + w * w)
    b = w * w * norm
    a1, a2 = 2.0 * (w * w - 1.0) * norm, (1.0 - math.sqrt(2.0) * w + w * w) * norm

    def once(x):
        x1 = x2 = y1 = y2 = x[0]
        out = []
        for value in x:
            y = b * (value + 2.0 * x1 + x2) - a1 * y1 - a2 * y2
            out.append(y)
            x1, x2, y1, y2 = value, x1, y, y1
        return out

    return once(once(values)[::-1])[::-1]


def motion(test, peak):
    rows = [line.split("\t") for line in text(f"data/Shake_Table_Response/Test{test:03d}.txt").splitlines()[1:]]
    values = [float(row[1]) for row in rows if len(row) > 1 and row[1].strip()]
    middle = median(values)
    values = low_passed(without_spikes([x - middle for x in values]))[::EVERY]
    middle = median(values)
    values = [x - middle for x in values]
    noise = (1.5 * median([abs(x) for x in values[:100]])) ** 2
    energy, sums = 0.0, []
    for x in values:
        energy += max(x * x - noise, 0.0)
        sums.append(energy)
    first = next(k for k, e in enumerate(sums) if e >= 0.002 * energy)
    last = next(k for k, e in enumerate(sums) if e >= 0.998 * energy)
    most = 1.3 * peak
    return [min(max(x, -most), most) for x in values[max(0, first - MARGIN) : last + MARGIN]]


def main():
    (HERE / "motions").mkdir(exist_ok=True)
    lines = text("data/SP1_PBRmodel/SP1.obj").splitlines()
    corners = [[float(x) for x in line.split()[1:4]] for line in lines if line.startswith("v ")]
    low = [min(corner[axis] for corner in corners) for axis in range(3)]
    placed = [f"v {' '.join(f'{x - least:.4f}' for x, least in zip(corner, low))}" for corner in corners]
    faces = ["f " + " ".join(v.split("/")[0] for v in line.split()[1:]) for line in lines if line.startswith("f ")]
    (HERE / "rock.obj").write_text("\n".join(["o rock", *placed, *faces]) + "\n")
    with open(HERE / "outcomes.csv") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            test = int(row["test"])
            values = motion(test, float(row["pga_g"]))
            samples = [f"{EVERY * STEP_S * k:.3f},{x:.5f}" for k, x in enumerate(values)]
            (HERE / "motions" / f"test{test:03d}.csv").write_text("\n".join(["t_s,ay_g", *samples]) + "\n")


if __name__ == "__main__":
    main()
