"""Studies against the JSON Schemas that their first lines name, as an editor with taplo reads them.

Arguments: the program, and folders of studies. Every study.toml must be valid by its schema; each slip below, made in a sound study, must not be.
"""

import copy
import json
import pathlib
import subprocess
import sys
import tomllib

from jsonschema import Draft7Validator

program, *folders = sys.argv[1:]
written = {}


def by_program(name):
    """The schema of that file name, as the program writes it now."""
    if name not in written:
        of = name.removesuffix(".schema.json")
        text = subprocess.run([program, "reference", "schema", "--of", of], check=True, capture_output=True, text=True).stdout
        Draft7Validator.check_schema(json.loads(text))
        written[name] = text
    return written[name]


def named_by(path):
    """The schema that a study names in its first line, which must be the program's own."""
    first = path.read_text().splitlines()[0]
    assert first.startswith("#:schema ./") or first.startswith("#:schema ../"), f"{path}: {first}"
    schema = path.parent / first.removeprefix("#:schema ")
    text = schema.read_text()
    assert text == by_program(schema.name), f"{schema} is not what `pirca reference schema` prints"
    return Draft7Validator(json.loads(text))


def put(study, path, value):
    """The study with another value at a path of keys; None takes the key away."""
    changed = copy.deepcopy(study)
    *above, last = path
    table = changed
    for key in above:
        table = table[key]
    if value is None:
        del table[last]
    else:
        table[last] = value
    return changed


SLIPS = [
    (["wall", "heigth_m"], 1.0),
    (["wall", "height_m"], None),
    (["wall", "height_m"], 0),
    (["wall", "height_m"], "1"),
    (["wall", "wythes"], 1.5),
    (["wall", "battered_face"], "fornt"),
    (["joint", "phi_deg"], 95),
    (["joint", "phi_deg"], {"family": "uniform", "low": 20}),
    (["joint", "phi_deg"], {"family": "uniform", "low": 20, "high": 30, "sd": 2}),
    (["joint", "kn_pa_per_m"], []),
    (["joint", "table_closure_m"], [1e-4, 2e-4]),
    (["load", "mean_pressure_pa"], 1000),
    (["load", "protocol"], "lateral"),
    (["restraint", "ends"], None),
    (["arm"], []),
    (["arm", 0, "members"], 0),
    (["arm", 0, "members"], {"until": "half_width", "of": "median", "below": 0.05, "at_most": 100}),
    (["arm", 0, "length_m"], 0.4),
    (["arm", 1, "height_m"], None),
    (["arm", 1, "stones"], "survey.csv"),
    (["arm", 1, "wall"], {"heigth_m": 1.0}),
    (["uncertain"], {"joint.phi_deg": 30}),
    (["uncertain"], {"joint.phi": {"family": "uniform", "low": 20, "high": 30}}),
    (["variant", 0, "set"], {}),
    (["blocks"], {}),
]
SOUND = [
    (["joint", "phi_deg"], "joint/friction:shale"),
    (["arm", 1, "members"], {"until": "half_width", "of": "quantile-0.05", "below": 0.05, "at_most": 100}),
    (["arm", 1, "length_m"], {"family": "empirical", "values": "survey.csv:length_m"}),
    (["arm", 1, "wall"], {"height_m": 0.5}),
    (["arm", 1, "joint"], {"normal_law": "table", "table_closure_m": [1e-4, 2e-4]}),
    (["uncertain"], {"joint.phi_deg": {"family": "uniform", "low": 20, "high": 30}}),
]

seen = 0
for path in sorted(path for folder in folders for path in pathlib.Path(folder).rglob("study.toml")):
    validator = named_by(path)
    study = tomllib.loads(path.read_text())
    faults = [f"{path}: {'.'.join(map(str, fault.path))}: {fault.message[:300]}" for fault in validator.iter_errors(study)]
    assert not faults, "\n".join(faults)
    seen += 1
    names = [arm["arrangement"] for arm in study.get("arm", [])]
    if names[:2] != ["discontinuous", "coursed"]:
        continue
    # The template of `pirca init`: a running bond and random courses on a tilting table.
    for slip in SLIPS:
        assert list(validator.iter_errors(put(study, *slip))), f"valid by its schema: {slip}"
    for change in SOUND:
        faults = list(validator.iter_errors(put(study, *change)))
        assert not faults, f"{change}: {faults[0].message[:300]}"
    surveyed = put(put(put(study, ["arm", 1, "stones"], "survey.csv"), ["arm", 1, "length_m"], None), ["arm", 1, "height_m"], None)
    assert validator.is_valid(surveyed), "stones take the place of length_m and height_m"
    seen += 100
assert seen > 105, f"{seen}: the template of `pirca init` is not among {folders}"
published = Draft7Validator(json.loads(by_program("published.schema.json")))
for path in sorted(path for folder in folders for path in pathlib.Path(folder).rglob("published.toml")):
    claims = tomllib.loads(path.read_text())
    if "claim" in claims:
        faults = [fault.message[:300] for fault in published.iter_errors(claims)]
        assert not faults, f"{path}: {faults}"
print(f"{seen % 100} studies are valid by their schemas; {len(SLIPS)} slips are found")
