"""Every command line of the pages, run in a folder that has what a checkout has: `examples/` and the files of `docs/`.

A block with a file's name behind its language (```yaml crane.yaml) is written to that file first. Commands of one page
run in their order in one folder. Studies run with fewer designs (`FEWER`).

    python docs/site/page_commands.py [--dalembert PATH] [PAGE ...]
"""

from __future__ import annotations

import argparse
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FEWER = {
    "designs: 1e5": "designs: 200",
    "designs: 2e4": "designs: 8",
    "--designs 1e6": "--designs 400",
    " 4711 ": " 47 ",
}
"""What is written in the pages -> what is run: the same commands with fewer designs."""
SERVES = ("studio",)
"""Commands that serve until they are stopped; tests/studio has them."""
BLOCK = re.compile(r"^```(\w*)(?: ([\w./-]+\.\w+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LINE = re.compile(r"^(?:\$ |#   )?(dalembert (?:.*\\\n)*.*)$", re.MULTILINE)

Run = Callable[[list[str], Path], tuple[int, str]]
"""Runs the arguments of a command in a folder: its exit status and what it says of an error."""


def pages() -> list[Path]:
    """The README, the guide, the home page, and the model files whose comments show commands."""
    docs = ROOT / "docs"
    files = [
        ROOT / "README.md",
        docs / "site" / "home.md",
        *sorted(docs.glob("*.md")),
        *sorted(docs.glob("*.yaml")),
    ]
    return [p for p in files if any(True for _ in commands(p))]


def commands(page: Path) -> Iterator[str]:
    """The command lines of a page, without those that serve."""
    text = page.read_text(encoding="utf-8")
    blocks = (
        [text]
        if page.suffix == ".yaml"
        else [b[3] for b in BLOCK.finditer(text) if b[1] in ("", "sh", "console")]
    )
    for block in blocks:
        for found in LINE.finditer(block):
            line = found[1].replace("\\\n", " ")
            line = re.split(r"\s{3,}", line)[0] if page.suffix == ".yaml" else line
            if line.split()[1] not in SERVES:
                yield line


def python_blocks(page: Path) -> list[str]:
    """The Python of a page that has no prompts, and so is not run as an example."""
    blocks = BLOCK.finditer(page.read_text(encoding="utf-8"))
    return [b[3] for b in blocks if b[1] == "python" and ">>> " not in b[3]]


def failures(page: Path, folder: Path, run: Run) -> list[str]:
    """Run a page's commands in an empty folder; those that failed, with their messages."""
    shutil.copytree(ROOT / "examples", folder / "examples", ignore=shutil.ignore_patterns("notebooks"))
    named = {f"docs/{p.name}": p.read_text(encoding="utf-8") for p in (ROOT / "docs").glob("*.yaml")}
    if page.suffix == ".md":
        named |= {b[2]: b[3] for b in BLOCK.finditer(page.read_text(encoding="utf-8")) if b[2]}
    for name, text in named.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(_fewer(text), encoding="utf-8")
    out = []
    for line in commands(page):
        status, said = run(shlex.split(_fewer(line), comments=True)[1:], folder)
        if status:
            out.append(f"{line}: {status}: {said}")
    return out


def _fewer(text: str) -> str:
    for written, run in FEWER.items():
        text = text.replace(written, run)
    return text


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dalembert", help="the command to run; default: that of this Python")
    parser.add_argument("pages", nargs="*", type=Path, help="default: all")
    options = parser.parse_args()
    command = [options.dalembert] if options.dalembert else [sys.executable, "-m", "dalembert"]

    def run(arguments: list[str], folder: Path) -> tuple[int, str]:
        ended = subprocess.run(
            [*command, *arguments],
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
            encoding="utf-8",
        )
        return ended.returncode, ended.stderr

    failed = 0
    for page in options.pages or pages():
        with tempfile.TemporaryDirectory() as folder:
            found = failures(page.resolve(), Path(folder), run)
        print(
            f"{page.name}: {sum(1 for _ in commands(page))} commands, {len(found)} failed",
            *found,
            sep="\n",
            flush=True,
        )
        failed += len(found)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
