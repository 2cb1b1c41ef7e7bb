"""Kinds of options that commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

Flag = Annotated[bool, Parameter(negative=())]
Every = Annotated[bool, Parameter(name="--all", negative=())]
Target = Annotated[Path | None, Parameter(allow_leading_hyphen=True)]
Output = Annotated[Path | None, Parameter(name=["--output", "-o"])]
