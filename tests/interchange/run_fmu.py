"""Runs a compiled unit with fmpy, in a process without dalembert: rows of inputs in, outputs out, as JSON; or a motion
from the start, as often as ``count`` says up to a time."""

import json
import sys
from typing import Any


def run(folder: str, library: str, version: str, rows: list[dict[str, float]]) -> dict[str, Any]:
    """Outputs and status of each row."""
    from fmpy.fmi2 import FMU2Model
    from fmpy.fmi3 import FMU3Model
    from fmpy.model_description import read_model_description

    described = read_model_description(folder)
    places = {v.name: v.valueReference for v in described.modelVariables}
    unit = (FMU2Model if version == "2.0" else FMU3Model)(
        guid=described.guid if version == "2.0" else described.instantiationToken,
        unzipDirectory=folder,
        modelIdentifier=described.modelExchange.modelIdentifier,
        instanceName="unit",
        libraryPath=library,
    )
    unit.instantiate()
    if version == "2.0":
        unit.setupExperiment(startTime=0.0)
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    outputs = [v.name for v in described.modelVariables if v.causality == "output" and v.name != "status"]
    real, whole = ("Real", "Integer") if version == "2.0" else ("Float64", "Int32")
    answers, states = [], []
    for row in rows:
        getattr(unit, f"set{real}")([places[name] for name in row], list(row.values()))
        answers.append(list(getattr(unit, f"get{real}")([places[name] for name in outputs])))
        states.append(int(getattr(unit, f"get{whole}")([places["status"]])[0]))
    unit.terminate()
    unit.freeInstance()
    units = {v.name: v.unit for v in described.modelVariables}
    factors = {d.name: d.factor for unit in described.unitDefinitions for d in unit.displayUnits}
    shown = {v.name: (v.displayUnit, factors.get(v.displayUnit)) for v in described.modelVariables}
    alone = not any(name.split(".")[0] == "dalembert" for name in sys.modules)
    return {
        "outputs": outputs,
        "answers": answers,
        "status": states,
        "units": units,
        "shown": shown,
        "alone": alone,
    }


def move(folder: str, kind: str, until: float, count: int, tolerance: float) -> dict[str, Any]:
    """Values by name along a motion of a unit with states."""
    from fmpy import simulate_fmu

    step = until / (count - 1)
    options = {"stop_time": until, "output_interval": step, "relative_tolerance": tolerance}
    rows = simulate_fmu(folder, fmi_type=kind, fmi_call_logger=None, **options)
    return {name: rows[name].tolist() for name in rows.dtype.names}


if __name__ == "__main__":
    given = json.load(sys.stdin)
    print(json.dumps(move(sys.argv[1], **given) if isinstance(given, dict) else run(*sys.argv[1:4], given)))
