"""Checks what the program is built from: licences that users may rely on, and no second version of a crate without a word why.

usage: cargo metadata --format-version 1 --locked | check_dependencies.py
"""

from __future__ import annotations

import json
import re
import sys
from collections import defaultdict

#: Licences that ask for no more than their text; `X WITH Y` is one.
FREE = {
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "MIT",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
}
#: Crates of which two dependencies want different versions: the most that there are. A new one is looked at before it is added.
TWICE = {
    "bitflags": 2,
    "equator": 2,
    "equator-macro": 2,
    "foldhash": 2,
    "getrandom": 2,
    # One for each of parry3d, nalgebra's converter and rapier, which only the benches take.
    "glam": 4,
    "hashbrown": 3,
    "miniz_oxide": 2,
    "num-derive": 2,
    "strsim": 2,
    "syn": 3,
    "thiserror": 2,
    "thiserror-impl": 2,
    "web-time": 2,
}


def is_free(expression: str) -> bool:
    """Whether an SPDX expression leaves a choice that is free throughout."""
    text = expression.replace("/", " OR ").strip()
    while "(" in text:
        inner = re.search(r"\(([^()]*)\)", text)
        text = text.replace(inner.group(0), "MIT" if is_free(inner.group(1)) else "none")
    return any(all(part.strip() in FREE for part in choice.split(" AND ")) for choice in text.split(" OR "))


def faults(packages: list[dict]) -> list[str]:
    """What is wrong, a line each."""
    found, versions = [], defaultdict(set)
    for package in packages:
        name, licence = package["name"], package["license"]
        versions[name].add(package["version"])
        if package["source"] and not is_free(licence or ""):
            found.append(f"{name} {package['version']}: licence {licence}; take another crate, or add the licence to FREE")
    for name, own in sorted(versions.items()):
        if len(own) > TWICE.get(name, 1):
            found.append(f"{name}: versions {', '.join(sorted(own))}; bring them together, or state them in TWICE")
    return found


def main() -> int:
    assert is_free("(MIT OR Apache-2.0) AND Unicode-3.0") and is_free("MIT OR GPL-3.0") and not is_free("MIT AND GPL-3.0")
    found = faults(json.load(sys.stdin)["packages"])
    print("\n".join(found) or "dependencies: licences and versions as stated")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
