"""Prints the lowest version that pyproject.toml states for each package, to install and test with exactly these.

python docs/lowest.py > lowest.txt && python -m pip install -r lowest.txt
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

PROJECT = Path(__file__).parents[1] / "pyproject.toml"
FOR_DEVELOPERS = ("docs", "test")


def lowest() -> list[str]:
    """`name==version` of each package, of dalembert itself and of its extras."""
    project = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    listed = [*project["dependencies"], *(r for e in extras if e not in FOR_DEVELOPERS for r in extras[e])]
    found = (re.match(r"([\w.-]+)>=([\w.]+)", requirement) for requirement in listed)
    return list(dict.fromkeys(f"{each[1]}=={each[2]}" for each in found if each))


if __name__ == "__main__":
    print("\n".join(lowest()))
