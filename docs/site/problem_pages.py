"""The gallery and the validation page, from the bundled problems and the tests: no number on them is typed."""

from __future__ import annotations

import platform
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.grading.file_answers import ComparedAnswer, check

HEADS = "| quantity | published | computed | exact | deviation | tolerance | |"
RULE = "| --- | --- | --- | --- | --- | --- | --- |"
LAW_HEADS = "laws | machines, default tests | with the long tests | all tests |"
Laws = dict[str, dict[str, Any]]
"""What `law_counts.py` prints."""
FILTER = """<div class="filters"><input id="problem-text" placeholder="Search titles and sources" aria-label="Search">
<select id="problem-kind" aria-label="Kind"><option value="">all kinds</option>{options}</select></div>"""


def problems() -> dict[str, Path]:
    """Page -> file of every bundled problem and example."""
    return dict(cases()) | {f"example-{name}": path for name, path in examples().items()}


def write_all(source: Path, part: str, laws: Laws) -> Iterator[tuple[int, int, str]]:
    """Write a page for each problem, the index and the validation page; yields count done, total and name."""
    folder = source / "gallery"
    folder.mkdir()
    chosen = {name: path for name, path in problems().items() if part in name}
    entries, rows = [], list[tuple[str, da.Mechanism, ComparedAnswer]]()
    for done, (name, path) in enumerate(chosen.items()):
        yield done + 1, len(chosen), name
        m = da.load(path)
        compared = check(m, name)
        rows += [(name, m, row) for row in compared]
        kinds = write_problem(folder, source / "_static" / "problems", name, path, m, compared)
        entries.append((name, m.title, m.source_text, kinds))
    (folder / "index.md").write_text(index(entries), encoding="utf-8")
    (source / "validation.md").write_text(validation(rows, laws), encoding="utf-8")


def write_problem(
    folder: Path, static: Path, name: str, path: Path, m: da.Mechanism, compared: list[ComparedAnswer]
) -> list[str]:
    """One page: drawing, file, printed answers, worked solution, live page; the kinds that the filter knows."""
    static.mkdir(exist_ok=True)
    r = da.solve(m)
    plane = m.dimension == 2
    da.draw.mechanism(r, forces=True).save(static / f"{name}.svg", overwrite=True)
    links = []
    for word, ending, made in (
        ("Worked solution", "-solution.html", lambda to: da.report(r).save(to, overwrite=True)),
        ("Live page", "-live.html", lambda to: da.page(m, to, overwrite=True)),
    ):
        try:
            made(static / f"{name}{ending}")
        except da.DalembertError as error:
            links.append(f"No {word.lower()}: {escape(str(error))}")
        else:
            links.append(f'<a href="../_static/problems/{name}{ending}">{word}</a>')
    friction = any(getattr(joint, "friction", None) for joint in m.joints.values())
    moving = any(np.any(np.nan_to_num(r.speed(link))) for link in r.links)
    kinds = [
        "plane" if plane else "space",
        "dynamic" if moving else "static",
        *(["friction"] if friction else []),
    ]
    answers = (
        "\n".join([HEADS, RULE, *(answer(row) for row in compared)])
        if compared
        else "The file states no answers."
    )
    text = [
        f"# {m.title or name}",
        f"Source: {m.source_text}" if m.source_text else "",
        "<p>" + " · ".join(links) + "</p>",
        f'<img class="drawing" src="../_static/problems/{name}.svg" alt="{escape(m.title or name)}, with forces">',
        "## Answers",
        answers,
        "## File",
        f"`dalembert examples {name.removeprefix('example-')} -o FILE` writes it.",
        "```yaml\n" + path.read_text(encoding="utf-8").rstrip() + "\n```",
    ]
    complete = "\n\n".join(["---\norphan: true\n---", *filter(None, text)])
    (folder / f"{name}.md").write_text(f"{complete}\n", encoding="utf-8")
    return kinds


def answer(row: ComparedAnswer) -> str:
    met = '<span class="yes">met</span>' if row.ok else '<span class="no">not met</span>'
    figures = (row.quantity, row.published, row.computed, row.exact, row.deviation, row.tolerance, met)
    return "| " + " | ".join(f.replace("|", "\\|") or "-" for f in figures) + " |"


def index(entries: list[tuple[str, str, str, list[str]]]) -> str:
    """The grid of all problems, with its filter."""
    kinds = sorted({kind for *_, some in entries for kind in some})
    options = "".join(f'<option value="{kind}">{kind}</option>' for kind in kinds)
    items = "".join(
        f'<a href="{name}.html" data-kind="{" ".join(some)}">'
        f'<img src="../_static/problems/{name}.svg" alt="" loading="lazy">'
        f"<span>{escape(title or name)}</span><span><small>{escape(source)}</small></span></a>\n"
        for name, title, source, some in entries
    )
    return (
        f"# Gallery\n\n{len(entries)} problems that are part of the program, each with its drawing, its file, its "
        f"printed answers compared, the worked solution and a live page.\n\n{FILTER.format(options=options)}\n\n"
        f'<div class="problems">\n{items}</div>\n'
    )


def validation(rows: list[tuple[str, da.Mechanism, ComparedAnswer]], laws: Laws) -> str:
    """Every published answer beside ours, by source; the laws that the tests try; the limits of the model."""
    met, exact = sum(row.ok for *_, row in rows), sum(bool(row.exact) for *_, row in rows)
    count = len({name for name, *_ in rows})
    made = f"dalembert {da.__version__}, Python {platform.python_version()}, numpy {np.__version__}"
    parts = [
        "# Validation",
        f"{met} of {len(rows)} published answers of {count} problems are met within the rounding or the drawing "
        f"accuracy of their sources; {exact} of them also have an exact value. `dalembert validate` makes the same "
        "comparison on your machine.",
        f"Computed by {made}. Times are [measured](benchmarks.md) beside other programs.",
        "Below: [laws](#laws), [limits of the model](#limits-of-the-model), [published answers](#published-answers).",
        law_part(laws),
        not_modelled(),
        "## Published answers",
    ]
    by_source: dict[str, list[str]] = {}
    for name, m, row in rows:
        head = (m.source_text or "Other").split(",")[0].split(";")[0]
        by_source.setdefault(head, []).append(f"| [{name}](gallery/{name}.md) {answer(row)}")
    for head, lines in sorted(by_source.items()):
        parts += [f"### {head}", "\n".join([f"| problem {HEADS}", f"| --- {RULE}", *lines])]
    return "\n\n".join(parts) + "\n"


def law_part(laws: Laws) -> str:
    """Laws and the machines on which the tests try them, by room; then each file of tests."""
    rooms: dict[str, list[dict[str, Any]]] = {}
    for module, part in laws.items():
        rooms.setdefault(module.split("/")[1], []).append(part)
    by_room = [law_row(f"`tests/{room}`", parts) for room, parts in sorted(rooms.items())]
    by_file = [law_row(part["said"].rstrip(".;").replace("|", "\\|"), [part]) for part in laws.values()]
    total = law_row("**all**", list(laws.values()))
    rule = "| --- | ---: | ---: | ---: | ---: |"
    rooms_head, files_head = (f"| {what} | {LAW_HEADS}\n{rule}" for what in ("tests", "what holds"))
    said = (
        "A law holds for every machine, whether or not a book has it: reactions do no work, velocities are the "
        "differences of positions, a mirrored or scaled machine has a mirrored or scaled answer, a program written "
        "independently gives the same. Each law is tried on machines, mechanisms or force systems that are drawn at "
        "random; a machine counts once for each law that is tried on it."
    )
    rows = [rooms_head, *by_room, total, "", "By file of tests:", "", files_head, *by_file]
    return "\n".join(["## Laws", "", said, "", *rows])


def law_row(name: str, parts: list[dict[str, Any]]) -> str:
    machines = [sum(part["machines"][tier] for part in parts) for tier in range(3)]
    cells = [sum(len(part["laws"]) for part in parts), *machines]
    return f"| {name} | " + " | ".join(f"{cell:,}" for cell in cells) + " |"


def not_modelled() -> str:
    """The page of the guide, one heading lower."""
    return "#" + (Path(__file__).parents[1] / "limits.md").read_text(encoding="utf-8").strip()
