"""Templates and bundled problems that the studio opens."""

from __future__ import annotations

import re
from functools import cache

from dalembert.arrays import Tree
from dalembert.bundled import cases, examples
from dalembert.errors import ModelError


@cache
def problems() -> list[Tree]:
    """Name, title and kind of each; those that need a file beside them are left out.

    >>> [p["name"] for p in problems() if p["kind"] == "template"][:2]
    ['four_bar', 'slider_crank']
    """
    from dalembert.model.library import TEMPLATES

    out = [{"kind": "template", "name": name, "title": t.description} for name, t in TEMPLATES.items()]
    for kind, files in (("example", examples()), ("problem", cases())):
        for name, path in files.items():
            text = path.read_text(encoding="utf-8")
            title = re.search(r"^title: *(.+?)\s*$", text, re.MULTILINE)
            if not re.search(r"\bfile: ", text):
                out.append({"kind": kind, "name": name, "title": (title[1] if title else name).strip("'\"")})
    return out


def problem_text(kind: str, name: str) -> str:
    """The text of one; raises ModelError for any other name."""
    from dalembert.model.library import template_text

    if not any(p["kind"] == kind and p["name"] == name for p in problems()):
        raise ModelError(f"{name!r} is not a bundled {kind}", "choose one of the list")
    if kind == "template":
        return template_text(name)
    return (examples() if kind == "example" else cases())[name].read_text(encoding="utf-8")
