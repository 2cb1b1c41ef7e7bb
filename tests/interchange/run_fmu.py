"""Runs a compiled unit with fmpy, in a process without dalembert: rows of inputs in, outputs out, as JSON."""

import json
import sys

from fmpy.fmi2 import FMU2Model
from fmpy.fmi3 import FMU3Model
from fmpy.model_description import read_model_description

folder, library, version = sys.argv[1:4]
rows = json.load(sys.stdin)
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
read = unit.getReal if version == "2.0" else unit.getFloat64
write = unit.setReal if version == "2.0" else unit.setFloat64
whole = unit.getInteger if version == "2.0" else unit.getInt32
answers, states = [], []
for row in rows:
    write([places[name] for name in row], list(row.values()))
    answers.append(list(read([places[name] for name in outputs])))
    states.append(int(whole([places["status"]])[0]))
unit.terminate()
unit.freeInstance()
units = {v.name: v.unit for v in described.modelVariables}
alone = not any(name.split(".")[0] == "dalembert" for name in sys.modules)
print(json.dumps({"outputs": outputs, "answers": answers, "status": states, "units": units, "alone": alone}))
