"""Errors are exceptions with the text of the command line."""

import shutil
import warnings
from functools import partial

import pytest

import pirca


def test_each_has_the_text_of_the_command_line(studies, pirca_command, empty_folder):
    broken = empty_folder / "broken"
    shutil.copytree(studies / "joint-arrangement", broken)
    text = (broken / "study.toml").read_text()
    (broken / "study.toml").write_text(text.replace("phi_deg", "phi_degg", 1))
    study = studies / "joint-arrangement"
    cases = [
        (pirca.InputError, 3, lambda: pirca.Study("nowhere"), ["check", "nowhere"]),
        (pirca.InputError, 3, lambda: pirca.Study(broken), ["check", broken]),
        (pirca.InputError, 3, lambda: pirca.Study(study, variant="none"), ["check", "--variant", "none", study]),
        (pirca.UsageError, 2, lambda: pirca.Study(study).capacity(below_deg=5), ["capacity", "--below-deg", 5, study]),
        (
            pirca.UsageError,
            2,
            lambda: pirca.Study(study).wall("none"),
            ["wall", study, "--arm", "none", "--out", "a.json"],
        ),
        (pirca.RunError, 1, lambda: pirca.Study(study).run(out="file"), ["run", study, "--out", "file"]),
    ]
    (empty_folder / "file").write_text("in the way")
    for kind, code, ask, arguments in cases:
        with pytest.raises(kind) as raised:
            ask()
        assert pirca_command(*arguments, code=code).stderr == f"error: {raised.value}\n"
        assert isinstance(raised.value, pirca.Error)


def test_what_is_out_of_range_is_refused_as_by_the_command_line(studies, pirca_command):
    study = studies / "joint-arrangement"
    with pytest.raises(pirca.UsageError) as raised:
        pirca.Study(study, members=0).run()
    assert str(raised.value) == pirca_command("run", study, "--members=0", code=2).stderr.strip()


def test_errors_are_also_those_that_python_has():
    assert issubclass(pirca.InputError, ValueError) and issubclass(pirca.UsageError, ValueError)
    assert issubclass(pirca.RunError, RuntimeError)


def test_what_looks_odd_is_a_warning_and_stops_the_command_where_that_is_an_error(studies):
    ask = partial(pirca.Study, studies / "tilting-block", variant="scattered-stiffness")
    with pytest.warns(UserWarning, match="averages out") as warned:
        ask()
    assert warned[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning, match="averages out"):
            ask()


def test_a_name_that_looks_like_an_option_is_a_name(studies, pirca_command):
    shutil.copytree(studies / "joint-arrangement", "--json")
    assert pirca.Study("--json").name == "--json"
    with pytest.raises(pirca.InputError, match="./-nowhere"):
        pirca.Study("-nowhere")
