"""Compares the shares of a variance that pirca finds with those that SALib and OpenTURNS find.

usage: check_sensitivity.py FOLDER      (FOLDER: what `pirca sensitivity tests/peers/column --out FOLDER` wrote;
                                       needs the packages of requirements.txt)

1. Ishigami's function and the g-function at the points of points.csv, evaluated here again: 256 rows of 16 uniforms,
   numpy.random.default_rng(2026).random((256, 16)).round(6), own and partner's; base point k belongs to
   randomisation k mod 16. shares.csv states what pirca finds, and a Rust test (`statistics`, sensitivity) holds
   pirca to it.
2. The same two functions at many more points, against their shares in closed form: the closed forms that pirca's tests rest on.
3. The column of random dips: the values that pirca found for its walls, and the closed form of the wall's angle of collapse.

pirca's estimators are Jansen's (1999), its variance that of own and partner's values together, divisor 2 n - 1. SALib's total is the
same over a divisor of 2 n. OpenTURNS' Jansen divides the sums of squares by 2 n - 1 and takes the variance of the own values alone.
Freed of these differences all three must be the same number. SALib's first order is another estimator, that of Saltelli and others
(2010): it is the same within the errors of both alone.

Exits with 1 and a message when something is not what was expected.
"""

import csv
import json
import math
import pathlib
import sys

import numpy as np
import openturns as ot
import pyarrow.parquet
from SALib.analyze import sobol
from SALib.test_functions import Ishigami, Sobol_G

# The same sums in another order, of values that differ by rounding.
ROUNDING = 1e-9
# Points of a scrambled net, and what is left of its error there: some 0.001, where a plain sample of the size errs by 0.01.
MANY = 2**14
LEFT = 0.003
# pirca's intervals are Student's at 15 degrees of freedom, 2.13 standard errors: twice as far is missed once in some 2,000 cases.
FAR = 2.0
HERE = pathlib.Path(__file__).parent

G = np.array([0.0, 1.0, 4.5, 9.0, 99.0, 99.0, 99.0, 99.0])
FUNCTIONS = {
    "ishigami": (3, lambda u: Ishigami.evaluate(math.pi * (2.0 * u - 1.0))),
    "g": (8, lambda u: Sobol_G.evaluate(u, a=G)),
}
# First order and total; see tests/statistics/sensitivity.rs.
CLOSED_FORMS = {
    "ishigami": [(0.313905, 0.557589), (0.442411, 0.442411), (0.0, 0.243684)],
    "g": [(0.71619, 0.78714), (0.17905, 0.24220), (0.02368, 0.03432), (0.00716, 0.01046)]
    + 4 * [(0.0000716, 0.000105)],
}


def fail(message):
    print(f"check_sensitivity: {message}", file=sys.stderr)
    sys.exit(1)


def same(what, found, expected, most):
    if not abs(found - expected) <= most:
        fail(f"{what}: {found} instead of {expected}, allowed is {most:.3g}")


def evaluated(function, own, partner):
    """Values at own, partner's and mixed inputs, the latter group by group."""
    mixed = []
    for group in range(own.shape[1]):
        inputs = own.copy()
        inputs[:, group] = partner[:, group]
        mixed.append(function(inputs))
    return function(own), function(partner), mixed


def salib(own, partner, mixed):
    """SALib's indices, with the half widths of their intervals; its total freed of its divisor."""
    count = len(mixed)
    problem = {"num_vars": count, "names": [f"x{k}" for k in range(count)], "bounds": count * [[0.0, 1.0]]}
    values = np.column_stack([own, *mixed, partner]).ravel()
    found = sobol.analyze(problem, values, calc_second_order=False, num_resamples=500, seed=1)
    found["ST"] = found["ST"] * (2 * len(own) - 1) / (2 * len(own))
    return found


def openturns(own, partner, mixed):
    """OpenTURNS' indices by Jansen, freed of its divisor and of its variance: first order, total."""
    n = len(own)
    # It asks for the inputs and uses their number alone.
    inputs = ot.Sample((2 + len(mixed)) * n, len(mixed))
    values = ot.Sample(np.concatenate([own, partner, *mixed])[:, None])
    found = ot.JansenSensitivityAlgorithm(inputs, values, n)
    ratio = np.var(own, ddof=1) / np.var(np.concatenate([own, partner]), ddof=1) * (2 * n - 1) / (2 * n)
    first = 1.0 - (1.0 - np.array(found.getFirstOrderIndices())) * ratio
    return first, np.array(found.getTotalOrderIndices()) * ratio


def compare(what, shares, values):
    """Holds shares, as pairs of (value, low, high) of first order and total, to what the peers make of the same values."""
    by_salib, (first, total) = salib(*values), openturns(*values)
    for k, ours in enumerate(shares):
        name = f"{what}, input {k + 1}"
        half = [0.5 * (high - low) for _, low, high in ours]
        same(f"{name}, first order by OpenTURNS", first[k], ours[0][0], ROUNDING)
        same(f"{name}, total by OpenTURNS", total[k], ours[1][0], ROUNDING)
        same(f"{name}, total by SALib", by_salib["ST"][k], ours[1][0], ROUNDING)
        same(f"{name}, first order by SALib", by_salib["S1"][k], ours[0][0], half[0] + by_salib["S1_conf"][k])
        # The error from 16 randomisations, within a quarter or so, and SALib's from resampled points. An input of no
        # influence has no error to compare.
        if ours[1][0] > 0.001 and not 0.5 < half[1] / by_salib["ST_conf"][k] < 2.0:
            fail(f"{name}: the interval of the total is {half[1]} wide at each side, SALib's {by_salib['ST_conf'][k]}")


def check_stated():
    points = np.loadtxt(HERE / "points.csv", delimiter=",", skiprows=1)
    stated = {}
    with open(HERE / "shares.csv") as file:
        for row in csv.DictReader(file):
            shares = [[float(row[f"{order}{end}"]) for end in ("", "_low", "_high")] for order in ("first", "total")]
            stated.setdefault(row["function"], []).append(shares)
    for name, (count, function) in FUNCTIONS.items():
        own, partner = points[:, :count], points[:, 8 : 8 + count]
        if len(stated[name]) != count:
            fail(f"shares.csv has {len(stated[name])} inputs of {name}")
        compare(name, stated[name], evaluated(function, own, partner))
        for k, (shares, exact) in enumerate(zip(stated[name], CLOSED_FORMS[name])):
            for order, (value, low, high), closed in zip(("first order", "total"), shares, exact):
                same(f"{name}, input {k + 1}, {order} in closed form", closed, value, FAR * 0.5 * (high - low))
        print(f"check_sensitivity: {name} at {len(points)} points, {count} inputs: the shares that the peers find")


def check_closed_forms():
    for name, (count, function) in FUNCTIONS.items():
        net = ot.LowDiscrepancyExperiment(ot.SobolSequence(), ot.JointDistribution(2 * count * [ot.Uniform(0, 1)]), MANY)
        net.setRandomize(True)
        ot.RandomGenerator.SetSeed(1)
        points = np.array(net.generate())
        values = evaluated(function, points[:, :count], points[:, count:])
        by_salib, (first, total) = salib(*values), openturns(*values)
        for k, exact in enumerate(CLOSED_FORMS[name]):
            what = f"closed form of {name}, input {k + 1}"
            for by, found in (("SALib", (by_salib["S1"][k], by_salib["ST"][k])), ("OpenTURNS", (first[k], total[k]))):
                same(f"{what}, first order by {by}", found[0], exact[0], LEFT)
                same(f"{what}, total by {by}", found[1], exact[1], LEFT)
        print(f"check_sensitivity: {name} at {MANY} points: the closed forms")


def check_column(folder):
    """A column falls at phi less its largest dip: phi uniform in (23, 27) deg, and five dips in (-5, 5)."""
    summary = json.loads((folder / "sensitivity.json").read_text())
    names = [group["name"] for group in summary["groups"]]
    if names != ["joint.phi_deg", "layout"] or summary["failed"]:
        fail(f"groups {names}, failed {summary['failed']}")
    # The estimates themselves: what is printed are the nearest shares that can be.
    shares = [[group["estimated_first"], group["estimated_total"]] for group in summary["groups"]]
    for group in summary["groups"]:
        first, total = group["first"], group["total"]
        if not (0.0 <= first[0] <= total[0] + ROUNDING and total[0] <= 1.0):
            fail(f"column, {group['name']}: first order {first[0]} and total {total[0]} cannot be")
    table = pyarrow.parquet.read_table(folder / "sensitivity.parquet").to_pydict()
    walls = {name: [] for name in ["own", "partner", *names]}
    for name, value in zip(table["numbers_from_the_partner"], table["value"]):
        walls[name].append(value)
    own, partner, *mixed = [np.array(values) for values in walls.values()]
    compare("column", shares, (own, partner, mixed))

    largest = ot.MaximumDistribution(ot.Uniform(-5.0, 5.0), 5)
    inputs = ot.JointDistribution([ot.Uniform(23.0, 27.0), largest])
    ot.RandomGenerator.SetSeed(1)
    drawn = np.array(inputs.getSample(2 * MANY))
    values = evaluated(lambda x: x[:, 0] - x[:, 1], drawn[:MANY], drawn[MANY:])
    by_salib, (first, total) = salib(*values), openturns(*values)
    for k, name in enumerate(names):
        found = {"SALib": (by_salib["S1"][k], by_salib["ST"][k]), "OpenTURNS": (first[k], total[k])}
        for by, pair in found.items():
            for order, value, (_, low, high) in zip(("first order", "total"), pair, shares[k]):
                if not low <= value <= high:
                    fail(f"column, {name}, {order} in closed form by {by}: {value} outside {low} to {high}")
    print(f"check_sensitivity: the column at {len(own)} points: the shares that the peers find, and its closed form's")


def main():
    if len(sys.argv) != 2:
        fail(__doc__.strip())
    check_stated()
    check_closed_forms()
    check_column(pathlib.Path(sys.argv[1]))


if __name__ == "__main__":
    main()
