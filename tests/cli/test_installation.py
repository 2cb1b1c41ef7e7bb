"""`doctor` and `completion`: the installation itself."""

from __future__ import annotations

import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

import dalembert.cli.installation.doctor_command as doctor_command
import dalembert.studio
from dalembert.cli.installation import installed_packages, self_test
from dalembert.cli.installation.installed_packages import EXTRAS, PackageState
from tests.cli.conftest import Run

PROJECT = Path(__file__).parents[2] / "pyproject.toml"
FOR_DEVELOPERS = {"all", "docs", "test"}


def test_a_sound_installation_passes(run: Run) -> None:
    ran = run("doctor")
    assert (ran.status, ran.err) == (0, "")
    assert ran.out.count("\nok: ") == len(self_test.CHECKS) == 3
    assert "This installation works" in ran.out
    assert "FAILED" not in ran.out


def test_machine_code_is_not_called_good_where_it_is_missing(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(self_test, "find_spec", lambda name: None)
    ran = run("doctor")
    assert (ran.status, ran.out.count("\nok: ")) == (0, len(self_test.CHECKS) - 1)
    assert "machine code against" not in ran.out


def test_its_extras_are_those_of_the_package() -> None:
    project = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]
    assert EXTRAS.keys() == {"", *project["optional-dependencies"]} - FOR_DEVELOPERS


def test_missing_and_old_packages_are_named_with_their_remedy(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    states = [
        PackageState("", "numpy", "1.26.4", "2.0"),
        PackageState("", "scipy", "", "1.14"),
        PackageState("fast", "llvmlite", "", "0.45"),
        PackageState("cad", "ezdxf", "1.3.0", "1.3"),
    ]
    monkeypatch.setattr(doctor_command, "packages", lambda: states)
    ran = run("doctor")
    assert ran.status == 1
    assert "FAILED: numpy 1.26.4 is too old; pip install 'numpy>=2.0'\n" in ran.out
    assert "FAILED: scipy is missing; pip install 'scipy>=1.14'\n" in ran.out
    assert "To get one:\n  pip install 'dalembert[fast]'\n\n" in ran.out
    assert "This installation has faults" in ran.out


def test_sources_without_metadata_have_no_packages(monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(name: str) -> None:
        raise installed_packages.PackageNotFoundError(name)

    monkeypatch.setattr(installed_packages, "requires", absent)
    assert installed_packages.packages() == []
    monkeypatch.setattr(installed_packages, "version", absent)
    assert installed_packages.installed("numpy") == ""


def test_a_wrong_number_fails_the_self_test(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def raises() -> str:
        raise ZeroDivisionError("division by zero")

    wrong = {"two routes": lambda: self_test.compared("effort", 1.0, 1.0 + 2e-9), "broken": raises}
    monkeypatch.setattr(self_test, "CHECKS", wrong)
    ran = run("doctor")
    assert ran.status == 1
    assert "FAILED: two routes: effort: 1.0 by one route, 1.000000002 by the other\n" in ran.out
    assert "FAILED: broken: ZeroDivisionError: division by zero\n" in ran.out


COMPLETED = """
source completion.bash
try() {{ COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _dalembert; echo "${{COMPREPLY[*]}}"; }}
try dalembert doc
try dalembert solve four_bar.yaml --pos
try dalembert draw four_bar.yaml --theme ""
"""


@pytest.mark.long
def test_bash_completes_commands_options_and_values(run: Run, folder: Path) -> None:
    if shutil.which("bash") is None:
        pytest.skip("no bash")
    (folder / "completion.bash").write_text(run("completion", "bash").out, encoding="utf-8")
    script = COMPLETED.format()
    ran = subprocess.run(["bash", "-c", script], capture_output=True, text=True, cwd=folder, check=True)
    assert ran.stdout.splitlines() == ["doctor", "--positions", "light dark print"]


@pytest.mark.long
@pytest.mark.parametrize(("shell", "head"), [("zsh", "#compdef dalembert"), ("fish", "# Fish completion")])
def test_other_shells_have_every_command(run: Run, shell: str, head: str) -> None:
    script = run("completion", shell).out
    assert script.startswith(head)
    assert all(name in script for name in ("check-answers", "doctor", "--positions"))


def test_packages_in_the_bundles_are_listed_with_permissive_licences() -> None:
    text = (Path(dalembert.studio.__file__).parent / "bundle" / "licences.txt").read_text(encoding="utf-8")
    listed = re.findall(r"^(\S+) \d+\.\d+\.\d+ \((.+)\)$", text, re.MULTILINE)
    assert {"@codemirror/view", "@lezer/yaml"} <= {name for name, _ in listed}
    assert {licence for _, licence in listed} <= {"MIT", "ISC", "BSD-2-Clause", "BSD-3-Clause", "0BSD"}
    assert text.count("Permission is hereby granted") == len(listed)
