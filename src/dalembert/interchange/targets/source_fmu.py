"""A functional mock-up unit with its C sources: FMI 2.0 or 3.0, model exchange and co-simulation.

Outputs are functions of the inputs at the same instant (default: model exchange). In co-simulation an importer sets
inputs, steps, then reads, so that outputs come one step late. The importer compiles it; nothing of Python is in it.
"""

from __future__ import annotations

import hashlib
import io
import zipfile
from importlib.resources import files
from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.interchange.targets.target_variables import (
    TargetFunction,
    TargetVariable,
    identifier,
    kernel_of,
    structured,
    target_function,
)
from dalembert.interchange.xml_text import XmlText, digits
from dalembert.units import KINDS, Units

if TYPE_CHECKING:
    from dalembert.analysis.batch.compiled_kernel import Kernel
    from dalembert.model import Mechanism

VERSIONS = ("2.0", "3.0")
DATE = (1980, 1, 1, 0, 0, 0)
"""Date of the files in the archive: the same mechanism gives the same bytes."""

STATUS = (
    "0 solved, 1 the linkage does not close, 2 doubtful, 3 at rest, 7 jammed, 9 self-locking (numbers hold)"
)


def write_fmu(m: Mechanism, version: str = VERSIONS[0]) -> tuple[bytes, list[str]]:
    """A unit whose inputs are position, speed and acceleration of the drives."""
    return fmu_bytes(kernel_of(m), version), [
        "the motion: position, speed and acceleration of the drives are inputs"
    ]


def fmu_bytes(k: Kernel, version: str = "2.0") -> bytes:
    """The archive of a kernel's unit: its numbers are parameters, the drives' position, speed and acceleration inputs.

    Raises ModelError for a version that is not 2.0 or 3.0, and for what only Python computes.
    """
    if version not in VERSIONS:
        raise ModelError(f"FMI {version} is not written", f"use {' or '.join(VERSIONS)}")
    name = identifier(k.mechanism.title)
    function = target_function(k, f"{name}_position")
    wrapper = f"fmi{version[0]}.c"
    texts = {
        "mechanism.c": _static(function.source, name),
        "model.c": _source("model.c"),
        wrapper: _source(wrapper),
    }
    token = hashlib.sha256("\n".join([*texts.values(), str(function)]).encode()).hexdigest()[:32]
    token = f"{{{token[:8]}-{token[8:12]}-{token[12:16]}-{token[16:20]}-{token[20:]}}}"
    texts["model.h"] = _header(function, name, token)
    described = _fmi2 if version == "2.0" else _fmi3
    archive = {"modelDescription.xml": described(k, function, name, token)}
    archive |= {f"sources/{file}": text for file, text in texts.items()}
    if version == "3.0":
        archive["sources/buildDescription.xml"] = _build_description(name, wrapper)
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
    """The exported function, hidden from other units in one program."""
    return source.replace(f"int {name}_position(", f"static int {name}_position(", 1)


def _header(f: TargetFunction, name: str, token: str) -> str:
    """Places of all variables: time, inputs, parameters, outputs."""
    known = [*f.inputs, *f.parameters]
    place = {id(v): k + 1 for k, v in enumerate(known)}
    numbers = {
        (v.place if v in f.parameters else -1 - v.place): place[id(v)] for v in known if _is_number(f, v)
    }
    channels = {v.place: place[id(v)] for v in f.inputs if v.place >= 0}
    starts = ", ".join(repr(v.start + 0.0) for v in known)
    count = 1 + len(known) + len(f.outputs)
    lines = [
        f"#define MODEL_FUNCTION {name}_position",
        f'#define TOKEN "{token}"',
        f"#define NUMBERS {len(numbers)}",
        f"#define CHANNELS {len(channels)}",
        f"#define FIRST_OUTPUT {1 + len(known)}",
        f"#define REALS {count}",
        f"#define START_VALUES {{0.0{', ' if starts else ''}{starts}}}",
        f"#define NUMBER_PLACES {{{', '.join(str(numbers[k]) for k in sorted(numbers)) or '0'}}}",
        f"#define CHANNEL_PLACES {{{', '.join(str(channels[k]) for k in sorted(channels)) or '0'}}}",
    ]
    return "\n".join(lines) + "\n"


def _is_number(f: TargetFunction, v: TargetVariable) -> bool:
    return v in f.parameters or v.place < 0


def _units(text: XmlText, f: TargetFunction, units: Units) -> None:
    """SI units with their dimensions, and the units of the file as those to display."""
    kinds = sorted({v.kind for v in (*f.inputs, *f.parameters, *f.outputs)})
    text.begin("UnitDefinitions")
    for unit in sorted({KINDS[kind].si for kind in kinds} - {""}):
        shown = {units.text(kind): 1 / units.unit(kind).si(1.0) for kind in kinds if KINDS[kind].si == unit}
        dimension = next(KINDS[kind].dimension for kind in KINDS if KINDS[kind].si == unit)
        exponents = dict(zip(("m", "kg", "s", "rad"), dimension, strict=True))
        text.begin("Unit", name=unit)
        text.add("BaseUnit", **{key: int(value) for key, value in exponents.items() if value})
        for name, factor in shown.items():
            if name != unit:
                text.add("DisplayUnit", name=name, factor=digits(factor))
        text.end()
    text.end()


def _shown(variable: TargetVariable, units: Units) -> str | None:
    """The unit of the file, where it is not that of the variable."""
    shown = units.text(variable.kind)
    return shown if variable.unit and shown != variable.unit else None


def _fmi2(k: Kernel, f: TargetFunction, name: str, token: str) -> str:
    from dalembert import __version__

    text = XmlText()
    text.begin(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=k.mechanism.title or name,
        guid=token,
        generationTool=f"dalembert {__version__}",
        variableNamingConvention="structured",
        numberOfEventIndicators=0,
    )
    for kind in ("ModelExchange", "CoSimulation"):
        more = {"canHandleVariableCommunicationStepSize": "true"} if kind == "CoSimulation" else {}
        state = {"canGetAndSetFMUstate": "true"}
        text.begin(kind, modelIdentifier=name, canBeInstantiatedOnlyOncePerProcess="false", **more, **state)
        text.begin("SourceFiles")
        text.add("File", name="fmi2.c")
        text.end()
        text.end()
    _units(text, f, k.mechanism.units)
    text.begin("LogCategories")
    text.add("Category", name="logStatus")
    text.end()
    text.begin("ModelVariables")
    reference = 0
    for causality, variables in (("input", f.inputs), ("parameter", f.parameters), ("output", f.outputs)):
        variability = "tunable" if causality == "parameter" else "continuous"
        for variable in variables:
            reference += 1
            keys: dict[str, object] = {"name": structured(variable.name), "valueReference": reference}
            initial = "calculated" if causality == "output" else "exact" if causality == "parameter" else None
            text.begin(
                "ScalarVariable", **keys, causality=causality, variability=variability, initial=initial
            )
            start = None if causality == "output" else digits(variable.start)
            shown = _shown(variable, k.mechanism.units)
            text.add("Real", unit=variable.unit or None, displayUnit=shown, start=start)
            text.end()
    keys = {"name": "status", "valueReference": reference + 1, "description": STATUS}
    text.begin("ScalarVariable", **keys, causality="output", variability="discrete", initial="calculated")
    text.add("Integer")
    text.end()
    text.end()
    first = len(f.inputs) + len(f.parameters) + 1
    depends = " ".join(str(i + 1) for i in range(len(f.inputs)))
    text.begin("ModelStructure")
    for part in ("Outputs", "InitialUnknowns"):
        text.begin(part)
        for index in range(first, first + len(f.outputs) + 1):
            text.add("Unknown", index=index, dependencies=depends)
        text.end()
    text.end()
    text.end()
    return str(text)


def _fmi3(k: Kernel, f: TargetFunction, name: str, token: str) -> str:
    from dalembert import __version__

    text = XmlText()
    text.begin(
        "fmiModelDescription",
        fmiVersion="3.0",
        modelName=k.mechanism.title or name,
        instantiationToken=token,
        generationTool=f"dalembert {__version__}",
        variableNamingConvention="structured",
    )
    text.add("ModelExchange", modelIdentifier=name, canGetAndSetFMUState="true")
    steps = {"canHandleVariableCommunicationStepSize": "true"}
    text.add("CoSimulation", modelIdentifier=name, canGetAndSetFMUState="true", **steps)
    _units(text, f, k.mechanism.units)
    text.begin("LogCategories")
    text.add("Category", name="logStatus")
    text.end()
    text.begin("ModelVariables")
    text.add("Float64", name="time", valueReference=0, causality="independent", variability="continuous")
    reference = 0
    for causality, variables in (("input", f.inputs), ("parameter", f.parameters), ("output", f.outputs)):
        for variable in variables:
            reference += 1
            text.add(
                "Float64",
                name=structured(variable.name),
                valueReference=reference,
                causality=causality,
                variability="tunable" if causality == "parameter" else "continuous",
                unit=variable.unit or None,
                displayUnit=_shown(variable, k.mechanism.units),
                start=None if causality == "output" else digits(variable.start),
                initial="calculated" if causality == "output" else None,
            )
    keys = {"name": "status", "valueReference": reference + 1, "description": STATUS}
    text.add("Int32", **keys, causality="output", variability="discrete", initial="calculated")
    text.end()
    depends = " ".join(str(i + 1) for i in range(len(f.inputs)))
    first = len(f.inputs) + len(f.parameters) + 1
    text.begin("ModelStructure")
    for part in ("Output", "InitialUnknown"):
        for index in range(first, first + len(f.outputs) + 1):
            text.add(part, valueReference=index, dependencies=depends)
    text.end()
    text.end()
    return str(text)


def _build_description(name: str, wrapper: str) -> str:
    text = XmlText()
    text.begin("fmiBuildDescription", fmiVersion="3.0")
    text.begin("BuildConfiguration", modelIdentifier=name)
    text.begin("SourceFileSet", language="C99")
    text.add("SourceFile", name=wrapper)
    for _ in range(3):
        text.end()
    return str(text)
