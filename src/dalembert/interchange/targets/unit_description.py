"""``modelDescription.xml`` of a functional mock-up unit, of FMI 2.0 and 3.0, with units and dependencies."""

from __future__ import annotations

from dalembert.interchange.targets.target_variables import TargetVariable, structured
from dalembert.interchange.targets.unit_variables import UnitLayout
from dalembert.interchange.xml_text import XmlText, digits
from dalembert.units import KINDS, Units

STATUS = (
    "0 solved, 1 the linkage does not close, 2 doubtful, 3 at rest, 7 jammed, 9 self-locking (numbers hold)"
)


def description(version: str, layout: UnitLayout, title: str, name: str, token: str, units: Units) -> str:
    """The text of the description, for a unit with a token, its C name and its title."""
    from dalembert import __version__

    text = XmlText()
    head = {"generationTool": f"dalembert {__version__}", "variableNamingConvention": "structured"}
    told = {"guid": token} if version == "2.0" else {"instantiationToken": token}
    more = {"numberOfEventIndicators": 0} if version == "2.0" else {}
    text.begin("fmiModelDescription", fmiVersion=version, modelName=title or name, **told, **head, **more)
    (_kinds2 if version == "2.0" else _kinds3)(text, name)
    _units(text, layout, units)
    text.begin("LogCategories")
    text.add("Category", name="logStatus")
    text.end()
    text.begin("ModelVariables")
    (_variables2 if version == "2.0" else _variables3)(text, layout, units)
    text.end()
    text.begin("ModelStructure")
    (_structure2 if version == "2.0" else _structure3)(text, layout)
    text.end()
    text.end()
    return str(text)


def build_description(name: str, wrapper: str) -> str:
    """``buildDescription.xml`` of FMI 3.0: the one file to compile."""
    text = XmlText()
    text.begin("fmiBuildDescription", fmiVersion="3.0")
    text.begin("BuildConfiguration", modelIdentifier=name)
    text.begin("SourceFileSet", language="C99")
    text.add("SourceFile", name=wrapper)
    for _ in range(3):
        text.end()
    return str(text)


def _kinds2(text: XmlText, name: str) -> None:
    for kind in ("ModelExchange", "CoSimulation"):
        more = {"canHandleVariableCommunicationStepSize": "true"} if kind == "CoSimulation" else {}
        state = {"canGetAndSetFMUstate": "true"}
        text.begin(kind, modelIdentifier=name, canBeInstantiatedOnlyOncePerProcess="false", **more, **state)
        text.begin("SourceFiles")
        text.add("File", name="fmi2.c")
        text.end()
        text.end()


def _kinds3(text: XmlText, name: str) -> None:
    text.add("ModelExchange", modelIdentifier=name, canGetAndSetFMUState="true")
    steps = {"canHandleVariableCommunicationStepSize": "true"}
    text.add("CoSimulation", modelIdentifier=name, canGetAndSetFMUState="true", **steps)


def _units(text: XmlText, layout: UnitLayout, units: Units) -> None:
    """SI units with their dimensions, and the units of the file as those to display."""
    kinds = sorted({v.of.kind for v in layout.variables})
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


def _variables2(text: XmlText, layout: UnitLayout, units: Units) -> None:
    for k, v in enumerate(layout.variables):
        keys = {"name": structured(v.of.name), "valueReference": k + 1, "causality": v.causality}
        variability = "tunable" if v.causality == "parameter" else "continuous"
        text.begin("ScalarVariable", **keys, variability=variability, initial=v.initial)
        start = None if v.initial == "calculated" else digits(v.of.start)
        unit = {"unit": v.of.unit or None, "displayUnit": _shown(v.of, units)}
        text.add("Real", **unit, start=start, derivative=v.derivative_of)
        text.end()
    keys = {"name": "status", "valueReference": len(layout.variables) + 1, "description": STATUS}
    text.begin("ScalarVariable", **keys, causality="output", variability="discrete", initial="calculated")
    text.add("Integer")
    text.end()


def _variables3(text: XmlText, layout: UnitLayout, units: Units) -> None:
    text.add("Float64", name="time", valueReference=0, causality="independent", variability="continuous")
    for k, v in enumerate(layout.variables):
        text.add(
            "Float64",
            name=structured(v.of.name),
            valueReference=k + 1,
            causality=v.causality,
            variability="tunable" if v.causality == "parameter" else "continuous",
            unit=v.of.unit or None,
            displayUnit=_shown(v.of, units),
            start=None if v.initial == "calculated" else digits(v.of.start),
            initial=None if v.causality == "parameter" else v.initial,
            derivative=v.derivative_of,
        )
    keys = {"name": "status", "valueReference": len(layout.variables) + 1, "description": STATUS}
    text.add("Int32", **keys, causality="output", variability="discrete", initial="calculated")


def _dependent(layout: UnitLayout) -> list[tuple[int, str]]:
    """Each output with the inputs and states that it depends on."""
    states = layout.state_references
    known = " ".join(map(str, [*layout.references("input"), *states]))
    outputs = [*layout.references("output"), len(layout.variables) + 1]
    return [(k, str(k) if k in states else known) for k in outputs]


def _derivatives(layout: UnitLayout) -> list[tuple[int, str]]:
    """Each derivative with what it depends on."""
    depends = dict(_dependent(layout))
    return [(k + 1, depends[k + 1]) for k, v in enumerate(layout.variables) if v.derivative_of is not None]


def _calculated(layout: UnitLayout) -> list[int]:
    """Values that initialization computes; they depend on all known ones."""
    return [k for k, _ in _dependent(layout) if k not in layout.state_references]


def _structure2(text: XmlText, layout: UnitLayout) -> None:
    for part, rows in (("Outputs", _dependent(layout)), ("Derivatives", _derivatives(layout))):
        if rows:
            text.begin(part)
            for index, depends in rows:
                text.add("Unknown", index=index, dependencies=depends)
            text.end()
    text.begin("InitialUnknowns")
    for index in _calculated(layout):
        text.add("Unknown", index=index)
    text.end()


def _structure3(text: XmlText, layout: UnitLayout) -> None:
    for part, rows in (
        ("Output", _dependent(layout)),
        ("ContinuousStateDerivative", _derivatives(layout)),
    ):
        for reference, depends in rows:
            text.add(part, valueReference=reference, dependencies=depends)
    for reference in _calculated(layout):
        text.add("InitialUnknown", valueReference=reference)
