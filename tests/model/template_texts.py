"""The model file of each template as it was read: what it takes by default, and where its points are drawn.

`python -m tests.model.template_texts` writes it anew; read the difference before it is committed.
"""

from __future__ import annotations

from pathlib import Path

import dalembert as da
from dalembert.model.library import TEMPLATES

WRITTEN = Path(__file__).with_name("template_texts.txt")
HEAD = "=== "


def text_of(name: str) -> str:
    return str(getattr(da, name)())


def texts() -> dict[str, str]:
    """Template -> its text as it was read."""
    parts = WRITTEN.read_text(encoding="utf-8").split(HEAD)[1:]
    return {name: text for name, _, text in (part.partition("\n") for part in parts)}


if __name__ == "__main__":
    written = "".join(f"{HEAD}{name}\n{text_of(name)}" for name in TEMPLATES)
    WRITTEN.write_text(written, encoding="utf-8", newline="\n")
