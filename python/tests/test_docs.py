"""The pages of the package do what they say: their code runs from top to bottom, and prints what stands below it."""

import re
import shutil

import pytest
from conftest import ROOT

BLOCK = re.compile(r"^```(python|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page", ["python/README.md", "docs/python.md"])
def test_its_code_runs(page, empty_folder, capfd):
    (empty_folder / "studies").symlink_to(ROOT / "studies")
    (empty_folder / "distributions").symlink_to(ROOT / "distributions")
    shutil.copy(ROOT / "tests/cli/fixtures/walls/leaning-tower.json", "my-wall.json")
    names, blocks, printed = {}, 0, ""
    for language, text in BLOCK.findall((ROOT / page).read_text(encoding="utf-8")):
        if language == "python":
            exec(compile(text, page, "exec"), names)
            printed, blocks = capfd.readouterr().out, blocks + 1
        else:
            # "..." stands for lines that are left out, "[..]" for what differs from run to run.
            wanted = re.escape(text.strip()).replace(re.escape("[..]"), ".*?").replace(re.escape("..."), "(?s:.*)")
            assert re.fullmatch(wanted, printed.strip()), f"{page} promises\n{text}\nand got\n{printed}"
    assert blocks > 0
