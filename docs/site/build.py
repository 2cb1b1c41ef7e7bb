"""The site: `make docs` writes it to build/site, from the pages of docs/ and from what the program says of itself.

Pages of docs/ are taken as they are, with links to examples and cases led to the gallery. The pages of the commands, of
the model file's keys and of the names in Python, the gallery and the validation page are made from the program. Every
`>>>` block and every command line is run, the notebooks are executed, and a warning is an error.

    python docs/site/build.py [--part GALLERY] [--no-notebooks]
"""

from __future__ import annotations

import argparse
import doctest
import json
import os
import re
import shutil
import subprocess
import sys
import time
from html import escape
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
SOURCE, SITE = ROOT / "build" / "site-source", ROOT / "build" / "site"
SECTIONS = {
    "learn": (
        "Learn",
        "The first answer in a minute; then a tutorial for each reader.",
        "getting-started tutorials/student tutorials/teacher tutorials/designer tutorials/programmer",
    ),
    "analyse": (
        "Analyse",
        "How to get a particular answer about one mechanism.",
        "methods friction space joints force-systems live-pages studio machine machine-examples exams notebooks",
    ),
    "many-designs": (
        "Many designs",
        "From one mechanism to thousands or a billion of them.",
        "kernel optimization studies formats",
    ),
    "reference": (
        "Reference",
        "What every key, option, name and status means.",
        "model-file model-keys command-line commands api quantities statuses conventions limits json-answer theory "
        "architecture benchmarks licences",
    ),
}
"""Section page -> its title, its sentence and its pages, those that exist."""
READERS = {
    "tutorials/student": "For students",
    "tutorials/teacher": "For teachers",
    "tutorials/designer": "For designers",
    "tutorials/programmer": "For programmers",
}
"""Tutorial -> its short name in the navigation."""
PICTURES = (
    "example-excavator",
    "example-four_cylinder",
    "example-cam_and_follower",
    "brk-1-simple-band-brake",
    "example-rssr",
    "example-hexapod",
)
"""Problems of the gallery on the home page."""
NOTEBOOKS = {"student": "student", "teacher": "teacher", "designer": "designer", "programmer": "tour"}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--part", help="only the problems of the gallery whose name contains this")
    parser.add_argument("--no-examples", action="store_true", help="leave the examples of the pages out")
    parser.add_argument("--no-notebooks", action="store_true", help="show the notebooks without running them")
    options = parser.parse_args()
    sys.path.insert(0, str(HERE))
    import problem_pages
    import reference_pages

    shutil.rmtree(SOURCE, ignore_errors=True)
    SOURCE.mkdir(parents=True)
    lines = (
        None if options.no_examples else subprocess.Popen([sys.executable, str(HERE / "page_commands.py")])
    )
    counted = subprocess.Popen([sys.executable, str(HERE / "law_counts.py")], stdout=subprocess.PIPE)
    failed = 0 if options.no_examples else run_examples()
    say("pages of the guide")
    copy_pages()
    for name, text in reference_pages.pages():
        say(name)
        write(f"{name}.md", text)
    laws = json.loads(counted.communicate()[0])
    for done, count, name in problem_pages.write_all(SOURCE, options.part or "", laws):
        say(f"gallery {done} of {count}: {name}")
    write("index.md", home())
    sections()
    if failed:
        return 1
    say("sphinx")
    shutil.rmtree(SITE, ignore_errors=True)
    settings = os.environ | {
        "SITE_NOTEBOOKS": "off" if options.no_notebooks else "force",
        "IPYTHONDIR": str(kernel_settings()),
    }
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-n", "-c", str(HERE)]
    command += ["-d", str(ROOT / "build" / "site-doctrees")]
    ended = subprocess.run([*command, str(SOURCE), str(SITE)], env=settings, check=False)
    for unused in SITE.rglob("*.map"):
        unused.unlink()
    pages = len(list(SITE.rglob("*.html")))
    size = sum(p.stat().st_size for p in SITE.rglob("*") if p.is_file()) / 1e6
    say(f"{pages} pages, {size:.0f} MB: {SITE / 'index.html'}")
    return ended.returncode or counted.returncode or (lines.wait() if lines else 0)


def kernel_settings() -> Path:
    """Settings of the notebooks' kernels: not the user's, and no warning of a socket within this machine."""
    folder = ROOT / "build" / "site-ipython"
    (folder / "profile_default").mkdir(parents=True, exist_ok=True)
    config = folder / "profile_default" / "ipython_kernel_config.py"
    config.write_text('get_config().IPKernelApp.log_level = "ERROR"\n', encoding="utf-8")
    return folder


def say(what: str) -> None:
    """A line of progress with the seconds since the start."""
    print(f"{time.perf_counter() - STARTED:6.1f} s  {what}", flush=True)


def run_examples() -> int:
    """Run every `>>>` block of the pages; the number that failed."""
    os.chdir(ROOT)
    failures = tried = 0
    flags = doctest.NORMALIZE_WHITESPACE
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]:
        result = doctest.testfile(str(page), module_relative=False, optionflags=flags)
        failures, tried = failures + result.failed, tried + result.attempted
    say(f"{tried} examples of the pages run, {failures} failed")
    return failures


def write(name: str, text: str) -> None:
    path = SOURCE / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def copy_pages() -> None:
    """The pages of docs/ with their figures, the notebooks as tutorials, and the home page with its live page."""
    import dalembert as da
    from dalembert.bundled import examples

    for page in (ROOT / "docs").glob("*.md"):
        if page.name != "index.md":
            write(page.name, resolved(page.read_text(encoding="utf-8")))
    for data in (ROOT / "docs").glob("*.yaml"):
        shutil.copy(data, SOURCE)
    shutil.copytree(ROOT / "docs" / "figures", SOURCE / "figures")
    for title, name in NOTEBOOKS.items():
        (SOURCE / "tutorials").mkdir(exist_ok=True)
        shutil.copy(
            ROOT / "examples" / "notebooks" / f"{name}.ipynb", SOURCE / "tutorials" / f"{title}.ipynb"
        )
    shutil.copytree(ROOT / "examples", SOURCE / "examples", ignore=shutil.ignore_patterns("notebooks"))
    static = SOURCE / "_static"
    static.mkdir()
    for name in ("site.css", "filter.js"):
        shutil.copy(HERE / name, static)
    da.page(da.load(examples()["four_bar"]), static / "four_bar.html", overwrite=True)
    r = da.dynamics(da.load(examples()["four_bar"]))
    da.draw.mechanism(r, forces=True).save(static / "four_bar.svg", overwrite=True)


def home() -> str:
    """The home page, with the first sentence of the validation page and pictures of the gallery."""
    text = (HERE / "home.md").read_text(encoding="utf-8")
    sentence = (SOURCE / "validation.md").read_text(encoding="utf-8").split("\n\n")[1].partition(";")[0]
    pages = [name for name in PICTURES if (SOURCE / "gallery" / f"{name}.md").is_file()]
    texts = [(SOURCE / "gallery" / f"{name}.md").read_text(encoding="utf-8") for name in pages]
    pictures = "".join(
        f'<a href="gallery/{name}.html"><img src="_static/problems/{name}.svg" alt="" loading="lazy">'
        f"<span>{escape(text.partition('# ')[2].partition(chr(10))[0])}</span></a>\n"
        for name, text in zip(pages, texts, strict=True)
    )
    text = text.replace("<!-- validated -->", f"{sentence} ([validation](validation.md)).")
    return text.replace("<!-- pictures -->", f'<div class="problems">\n{pictures}</div>')


def resolved(text: str) -> str:
    """A page with its links out of docs/ led to the gallery, to the pages here, or shown as names of files."""
    to_problem = r"\]\(\.\./(cases|examples)/([\w-]+)\.yaml\)"
    text = re.sub(to_problem, lambda m: f"](gallery/{problem(*m.groups())}.md)", text)
    text = re.sub(r"<!-- table of (benchmarks/kept/\w+\.txt) -->", lambda m: table_of(ROOT / m[1]), text)
    to_figures = r"\]\(\.\./benchmarks/kept/(\w+)\.txt\)"
    text = re.sub(to_figures, lambda m: f"](benchmarks.md#{m[1].replace('_', '-')})", text)
    return re.sub(r"\[([^\]]+)\]\(\.\./[^)]+\)", r"\1", text)


def table_of(kept: Path) -> str:
    """The table that a benchmark printed."""
    return "\n".join(line for line in kept.read_text(encoding="utf-8").splitlines() if line.startswith("|"))


def problem(folder: str, name: str) -> str:
    return name if folder == "cases" else f"example-{name}"


def sections() -> None:
    """The pages of the sections, each with its table of contents."""
    for name, (title, sentence, pages) in SECTIONS.items():
        there = [
            p for p in pages.split() if any((SOURCE / f"{p}{end}").is_file() for end in (".md", ".ipynb"))
        ]
        here = [f"{READERS[p]} <{p}>" if p in READERS else p for p in there]
        contents = "\n".join(["```{toctree}", ":maxdepth: 2", "", *here, "```"])
        write(f"{name}.md", f"# {title}\n\n{sentence}\n\n{contents}\n")


STARTED = time.perf_counter()

if __name__ == "__main__":
    sys.exit(main())
