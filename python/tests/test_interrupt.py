"""Ctrl-C stops what goes on, soon, and what was recorded stays."""

import re
import signal
import subprocess
import sys
import threading
import time

import pytest

import pirca

#: Says when it begins, and what came of it.
PROGRAM = """
import pirca, sys
study = pirca.Study({study!r}, {given})
print("begins", flush=True)
try:
    study.{call}
except KeyboardInterrupt:
    print("stopped", flush=True)
    # The next one is not stopped by what stopped this one.
    print(len(pirca.Study({study!r}).wall()), flush=True)
"""


def stopped(study, given, call, after):
    """The seconds that it took to stop, and what was printed."""
    program = PROGRAM.format(study=str(study), given=given, call=call)
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "begins\n", child.stderr.read()
    time.sleep(after)
    assert child.poll() is None, f"it ended before it could be stopped: {child.stderr.read()}"
    begun = time.monotonic()
    child.send_signal(signal.SIGINT)
    try:
        out, err = child.communicate(timeout=60)
    finally:
        child.kill()
    assert child.returncode == 0, err
    return time.monotonic() - begun, out


def test_a_run_stops_and_goes_on_where_it_stood(studies, capfd):
    seconds, out = stopped(studies / "joint-arrangement", "members=20000", "run(out='half')", after=3)
    assert out.startswith("stopped\n") and seconds < 10, (seconds, out)
    with pytest.raises(pirca.RunError, match="was stopped before"):
        pirca.Run("half")
    # A run of fewer walls goes on from those that were recorded.
    run = pirca.Study(studies / "joint-arrangement", members=2).run(out="half", progress=True)
    recorded = re.search(r"24 evaluations, (\d+) of them recorded before", capfd.readouterr().err)
    assert len(run.members) == 24 and int(recorded[1]) > 0


@pytest.mark.parametrize(
    ("study", "given", "call"),
    [
        ("joint-arrangement", "members=4", "run(solver='explicit', out='one')"),
        ("sources-of-scatter", "", "sensitivity(points=4096, out='two')"),
        ("tilting-table", "", "diagnose(build=False, gain=False, out='three')"),
        ("tilting-table", "", "diagnose(bank='four', out='five')"),
        ("arrangements", "", "compare(walls=100000, out='six', same_within_deg=1e-6)"),
    ],
)
def test_whatever_goes_on_stops(studies, study, given, call):
    seconds, out = stopped(studies / study, given, call, after=2)
    assert out.startswith("stopped\n") and seconds < 10, (seconds, out)


def test_a_long_analysis_stops(walls):
    program = (
        "import pirca\nprint('begins', flush=True)\n"
        f"try: pirca.analyse({str(walls / 'leaning-tower.json')!r}, phi_deg=35, solver='explicit', kn=1e9, step_deg=0.01)\n"
        "except KeyboardInterrupt: print('stopped')\n"
    )
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "begins\n"
    time.sleep(0.5)
    assert child.poll() is None
    child.send_signal(signal.SIGINT)
    assert child.communicate(timeout=5)[0] == "stopped\n"


def test_the_interpreter_is_free_meanwhile(studies):
    counted = []
    running = threading.Event()

    def count():
        while not running.wait(0.01):
            counted.append(None)

    counter = threading.Thread(target=count)
    counter.start()
    begun = time.monotonic()
    pirca.Study(studies / "joint-arrangement", members=30).run()
    seconds = time.monotonic() - begun
    running.set()
    counter.join()
    assert len(counted) > 20 * seconds, f"{len(counted)} in {seconds} s"
