"""`dalembert schema`, `new`, `convert`, `examples` and `joints`: descriptions rather than answers."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Literal

from dalembert.cli.options import Force, ModelFile, NewFile, Seen, Set, Theme, flag, with_help
from dalembert.cli.options import output as written
from dalembert.errors import ModelError
from dalembert.printing import table
from dalembert.saving import check_new, new_file
from dalembert.wording import closest

YAML = (".yaml", ".yml")


def schema(*, output: NewFile = None, force: Force = False) -> int:
    """Print the JSON schema of the model file, for completion and checks in editors."""
    return write_or_print(schema_text(), output, force)


def new(
    template: Annotated[str, with_help("Name of the template.")] = "",
    /,
    *,
    output: NewFile = None,
    force: Force = False,
) -> int:
    """Create a model file from a template; without a name, list the templates."""
    if not template:
        return write_or_print(template_list(), output, force)
    return _model_file(template_file(template), output, force)


def examples(
    name: Annotated[str, with_help("Name of the example (default: list them).")] = "",
    /,
    *,
    output: NewFile = None,
    force: Force = False,
) -> int:
    """Bundled problems: list them, print one, or copy one to a file."""
    if not name:
        return write_or_print(example_list(), output, force)
    _model_file(example_text(name), output, force)
    if output is not None and not is_screen(output):
        for beside in _files_beside(name):
            write_or_print(beside.read_text(encoding="utf-8"), output.parent / beside.name, force)
    return 0


def _files_beside(name: str) -> list[Path]:
    """The files of columns that an example names, which lie beside it."""
    from dalembert.bundled import cases, examples

    path = {**cases(), **examples()}[name]
    named = re.findall(r"\bfile: ([\w.-]+\.csv)", path.read_text(encoding="utf-8"))
    return [path.parent / file for file in dict.fromkeys(named)]


def _model_file(text: str, output: Path | None, force: bool) -> int:
    if output is not None and not is_screen(output) and output.suffix.lower() not in YAML:
        raise ModelError(
            f"{output} is not named like YAML, which this is",
            "end its name with .yaml; `dalembert convert` writes JSON and TOML",
        )
    return write_or_print(text, output, force)


def is_screen(output: Path | None) -> bool:
    """True if what a command writes is printed."""
    return output is None or str(output) in ("-", "/dev/stdout")


def write_or_print(text: str, output: Path | None, force: bool) -> int:
    """Text to a new file, or printed."""
    if is_screen(output):
        print(text.rstrip("\n"))
        return 0
    assert output is not None
    with new_file(output, force) as temporary:
        temporary.write_text(text, encoding="utf-8")
    print(f"Written: {output}")
    return 0


def schema_text() -> str:
    """The JSON schema of the model file."""
    from dalembert.model import json_schema

    return json.dumps(json_schema(), indent=2, ensure_ascii=False) + "\n"


def example_list() -> str:
    """Names and titles of the bundled examples."""
    from dalembert.bundled import cases, examples

    rows = [[name, _title(path)] for name, path in examples().items()]
    shown = table(["example", "title"], rows, 2)
    return f"{shown}\n\n{len(cases())} published problems with their answers are bundled too: `dalembert validate`."


def example_text(name: str) -> str:
    """The file of a bundled example, or of a bundled published problem."""
    from dalembert.bundled import cases, examples

    files = {**cases(), **examples()}
    if name not in files:
        raise ModelError(f"unknown example {name!r}", closest(name, list(examples())))
    return files[name].read_text(encoding="utf-8")


def _title(path: Path) -> str:
    """The title of a model file, read without the rest."""
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("title:"):
            return line.removeprefix("title:").strip().strip("\"'")
    return ""


def convert(
    file: ModelFile,
    target: Annotated[Path | None, with_help("File to write, as -o.")] = None,
    /,
    *,
    output: Annotated[Path | None, written("File to write; its extension selects the format.")] = None,
    set: Set = None,  # noqa: A002
    fmi: Annotated[Literal["2.0", "3.0"] | None, with_help("Version of an .fmu file (default: 2.0).")] = None,
    forward: Annotated[
        bool, flag("An .fmu file whose inputs are efforts, and whose states the motion.")
    ] = False,
    strict: Annotated[bool, flag("Write nothing where something would not be kept.")] = False,
    force: Force = False,
) -> int:
    """Write a model file as .yaml, .json or .toml, or in the format of another program; FILE may be in any of these."""
    from dalembert.cli.options import with_settings
    from dalembert.model import convert as convert_file

    if (target is None) == (output is None):
        raise ModelError("convert needs one output file", "write dalembert convert FILE OUT")
    out = target or output
    assert out is not None
    check_new(out, force)
    change = (lambda m: with_settings(m, set)) if set else None
    lost = convert_file(file, out, force, strict, change, fmi or "", forward)
    for note in lost:
        print(f"not kept: {note}", file=sys.stderr)
    print(f"Written: {out}")
    return 0


def template_list() -> str:
    """Names of the templates and what they build."""
    from dalembert.model.library import TEMPLATES

    return table(["template", "what it is"], [[name, t.description] for name, t in TEMPLATES.items()], 2)


def template_file(name: str) -> str:
    """The commented model file of a template."""
    from dalembert.model.library import template_text

    return template_text(name)


JOINT_HEADS = ("joint", "turns", "slides", "reactions", "local axes")


def joint_rows() -> list[list[str]]:
    """Type, turns and slides of j in i, reactions, local axes of every joint in space, a row each."""
    from dalembert.model.joints.pairs import PAIRS
    from dalembert.views.symbols.pair_pictures import sorted_kinds

    return [
        [kind, str(len(p.turns)), str(len(p.slides)), " ".join(p.reactions), p.local]
        for kind, p in ((kind, PAIRS[kind]) for kind in sorted_kinds())
    ]


def joint_table() -> str:
    """The joints in space: turns and slides of j in i, and the reactions along the joint's local axes."""
    shown = table(JOINT_HEADS, joint_rows(), len(JOINT_HEADS))
    more = (
        "Beside these there are gears in space, and in the plane pin, slider, slot, weld, gear and rolling."
    )
    drawn = "`dalembert joints -o joints.svg` draws them."
    return f"{shown}\n\nA screw slides with its turn. {drawn}\n{more}"


def joints(
    *,
    output: Annotated[
        Path | None,
        written("Drawing of all joints (.svg, .pdf, .png, .dxf), or a folder for one drawing per joint."),
    ] = None,
    camera: Seen = None,
    theme: Theme = "light",
    force: Force = False,
) -> int:
    """Print the joints in space: degrees of freedom, local axes, and reactions along these axes."""
    from dalembert.cli.documents.draw_command import camera_at
    from dalembert.model.joints.pairs import PAIRS
    from dalembert.views import draw

    if output is None:
        return write_or_print(joint_table(), None, force)
    seen = camera_at(camera)
    if output.suffix:
        draw.joints(seen).save(output, force, theme)
    else:
        output.mkdir(parents=True, exist_ok=True)
        for kind in PAIRS:
            draw.joint(kind, seen).save(output / f"{kind}.svg", force, theme)
    print(f"Written: {output}")
    return 0


COMMANDS: dict[Callable[..., int], str] = {
    schema: "Examples:\n  dalembert schema > dalembert.schema.json",
    new: """Examples:
  dalembert new
  dalembert new slider_crank -o engine.yaml""",
    convert: """Examples:
  dalembert convert four_bar.yaml -o four_bar.json
  dalembert convert four_bar.yaml four_bar.xml
  dalembert convert arm.urdf arm.yaml""",
    examples: """Examples:
  dalembert examples
  dalembert examples four_bar -o four_bar.yaml""",
    joints: """Examples:
  dalembert joints
  dalembert joints -o joints.svg
  dalembert joints -o pictures""",
}
"""Function of each command -> the examples under its help."""
