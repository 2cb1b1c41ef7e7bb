"""A functional mock-up unit with its C sources: FMI 2.0 or 3.0, model exchange and co-simulation.

Of inverse dynamics, outputs are functions of the inputs at the same instant (default: model exchange; in co-simulation
an importer sets inputs, steps, then reads, so that outputs come one step late). Of forward dynamics, positions and
speeds are states. The importer compiles it; nothing of Python is in it.
"""

from __future__ import annotations

import hashlib
import io
import zipfile
from collections.abc import Sequence
from importlib.resources import files
from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.interchange.targets.forward_dynamics import forward_unit
from dalembert.interchange.targets.target_variables import (
    TargetFunction,
    identifier,
    kernel_of,
    target_function,
)
from dalembert.interchange.targets.unit_description import build_description, description
from dalembert.interchange.targets.unit_variables import UnitLayout, layout_of

if TYPE_CHECKING:
    from dalembert.analysis.batch.compiled_kernel import Kernel
    from dalembert.model import Mechanism

VERSIONS = ("2.0", "3.0")
DATE = (1980, 1, 1, 0, 0, 0)
"""Date of the files in the archive: the same mechanism gives the same bytes."""


def write_fmu(m: Mechanism, version: str = "2.0", forward: bool = False) -> tuple[bytes, list[str]]:
    """A unit whose inputs are position, speed and acceleration of the drives; ``forward``: their efforts."""
    if not forward:
        return fmu_bytes(kernel_of(m), version), [
            "the motion: position, speed and acceleration of the drives are inputs"
        ]
    _check(version)
    name = identifier(m.title)
    k, function, layout, lost = forward_unit(m, name)
    return _archive(k, function, layout, name, version), lost


def fmu_bytes(k: Kernel, version: str = "2.0") -> bytes:
    """The archive of a kernel's unit: its numbers are parameters, the drives' position, speed and acceleration inputs.

    Raises ModelError for a version that is not 2.0 or 3.0, and for what only Python computes.
    """
    _check(version)
    name = identifier(k.mechanism.title)
    function = target_function(k, f"{name}_position")
    return _archive(k, function, layout_of(function), name, version)


def _check(version: str) -> None:
    if version not in VERSIONS:
        raise ModelError(f"FMI {version} is not written", f"use {' or '.join(VERSIONS)}")


def _archive(k: Kernel, f: TargetFunction, layout: UnitLayout, name: str, version: str) -> bytes:
    wrapper = f"fmi{version[0]}.c"
    texts = {
        "mechanism.c": _static(f.source + layout.terms, name),
        "model.c": _source("model.c"),
        "states.c": _source("states.c" if layout.terms else "no_states.c"),
        wrapper: _source(wrapper),
    }
    token = hashlib.sha256("\n".join([*texts.values(), str(layout.variables)]).encode()).hexdigest()[:32]
    token = f"{{{token[:8]}-{token[8:12]}-{token[12:16]}-{token[16:20]}-{token[20:]}}}"
    texts["model.h"] = _header(layout, name, token)
    units = k.mechanism.units
    archive = {"modelDescription.xml": description(version, layout, k.mechanism.title, name, token, units)}
    archive |= {f"sources/{file}": text for file, text in texts.items()}
    if version == "3.0":
        archive["sources/buildDescription.xml"] = build_description(name, wrapper)
    return zipped(archive)


def zipped(texts: dict[str, str]) -> bytes:
    """A zip archive with fixed dates."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for file, text in texts.items():
            archive.writestr(zipfile.ZipInfo(file, DATE), text, zipfile.ZIP_DEFLATED)
    return out.getvalue()


def _source(file: str) -> str:
    return (files("dalembert.interchange.targets") / "sources" / file).read_text(encoding="utf-8")


def _static(source: str, name: str) -> str:
    """The exported functions, hidden from other units in one program."""
    for function in (f"int {name}_position(", f"int {name}_terms("):
        source = source.replace(function, f"static {function}", 1)
    return source


def _header(layout: UnitLayout, name: str, token: str) -> str:
    """Places of all variables: time, inputs, parameters, states, outputs."""
    known = [v.of.start + 0.0 for v in layout.known]
    rows: dict[str, object] = {
        "MODEL_FUNCTION": f"{name}_position",
        "TOKEN": f'"{token}"',
        "NUMBERS": len(layout.numbers),
        "CHANNELS": len(layout.channels),
        "FIRST_OUTPUT": 1 + len(known),
        "FIRST_RESULT": 1 + len(known) + len(layout.nominal),
        "REALS": 1 + len(layout.variables),
        "START_VALUES": _listed([0.0, *known]),
        "NUMBER_PLACES": _listed(layout.numbers),
        "CHANNEL_PLACES": _listed(layout.channels),
    }
    if layout.terms:
        rows |= {
            "DRIVES": len(layout.nominal),
            "TERMS_FUNCTION": f"{name}_terms",
            "TERM_CHANNELS": len(layout.term_channels),
            "TERM_CHANNEL_PLACES": _listed(layout.term_channels),
            "NOMINAL_VALUES": _listed(layout.nominal),
        }
    return "".join(f"#define {key} {value}\n" for key, value in rows.items())


def _listed(values: Sequence[float]) -> str:
    return f"{{{', '.join(map(repr, values)) or '0'}}}"
