"""TOML to a tree."""

from __future__ import annotations

import re
import tomllib

from dalembert.arrays import Tree
from dalembert.model.files.yaml_text import DEEPEST, at_line


def read(text: str) -> Tree:
    """The tree; raises ModelError with its `line`."""
    for number, line in enumerate(text.split("\n")):
        if line.count("[") + line.count("{") + line.count(".") > 1000 and re.search(
            r"([\[{]\s*|\.\w*){40}", line
        ):
            what = f"the file is nested deeper than {DEEPEST} levels"
            raise at_line(what, "a model file needs 6 or so", number + 1)
    try:
        return tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        message = str(error)
        match = re.search(r"\(at line (\d+), column \d+\)", message)
        problem = re.sub(r" \(at .*\)", "", message).lower()
        line_number = int(match[1]) if match else text.count("\n") + 1
        words = f"it is not TOML here: {problem}"
        raise at_line(words, "check quotes, commas and brackets", line_number) from None
