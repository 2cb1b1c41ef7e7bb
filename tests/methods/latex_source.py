"""A reader of LaTeX that finds what a compiler would stop at: an oracle for reports, sharing no code with their writer.

It knows the commands and environments of article, amsmath, booktabs and textcomp that it is told of, keeps the modes
(text, mathematics), the groups and the environments, and counts the columns of tables and matrices.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

TOKEN = re.compile(r"\\[A-Za-z]+\*?|\\.|\\\n|\$\$?|[{}&_^#%~]|\n[ \t]*\n|\s+|[^\\${}&_^#%~\s]", re.DOTALL)

BOTH = {
    *("title", "author", "date", "section", "subsection", "subsubsection", "maketitle", "textit", "textbf"),
    *(
        "documentclass",
        "usepackage",
        "geometry",
        "setcounter",
        "setlength",
        "parindent",
        "textbackslash",
        "dots",
    ),
    *(
        "par",
        "medskip",
        "fitted",
        "scalebox",
        "hspace",
        "hfill",
        "rule",
        "IfFileExists",
        "parskip",
        "nopagebreak",
        "allowbreak",
        "emergencystretch",
        "textsuperscript",
        "textsubscript",
        "noindent",
        "vspace",
    ),
    *("toprule", "midrule", "bottomrule", "small", "scriptsize", "footnotesize", "begin", "end"),
}
MATHS = {
    *(
        "alpha",
        "beta",
        "gamma",
        "delta",
        "theta",
        "omega",
        "phi",
        "mu",
        "cos",
        "sin",
        "tan",
        "arcsin",
        "arctan",
        "sum",
    ),
    *(
        "cdot",
        "times",
        "circ",
        "dot",
        "ddot",
        "quad",
        "angle",
        "parallel",
        "perp",
        "to",
        "mathrm",
        "mathbf",
        "frac",
    ),
    *("text", "backslash", "sim", "hat", "approx", "surd", "Omega", "pi", "xi", "Delta"),
    *("sqrt", "left", "right", "le", "ge", "ne", "pm", "sigma", "tau", "lambda", "varphi", "psi", "rho"),
}
SIGNS = {r"\\", r"\&", r"\%", r"\#", r"\_", r"\{", r"\}", r"\~", r"\^", r"\,", r"\ ", r"\[", r"\]", r"\$"}
MATHS_ENVIRONMENTS = {"gather*", "align*", "equation*", "bmatrix", "pmatrix"}
ALIGNED = {"tabular", "bmatrix", "pmatrix", "align*"}
WRITTEN = re.compile(r"[\x20-\x7e\n\t\u00c0-\u00ff]")
"""What the encodings of the preamble can set: ASCII, and the letters of Latin-1."""


@dataclass
class Reader:
    """Where the reading stands: open groups and environments with the line they began in, and what was wrong."""

    open: list[tuple[str, int]] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)
    line: int = 1
    cells: list[list[int]] = field(
        default_factory=list
    )  # columns wanted, cells so far, of each aligned environment
    scripts: set[str] = field(default_factory=set)  # what stands on the atom before
    script: bool = False  # whether what comes next is a sub- or superscript
    outer: list[set[str]] = field(default_factory=list)  # scripts on the atom before each open group

    @property
    def maths(self) -> bool:
        """Whether this is mathematics: the innermost mode that was opened."""
        return any(name in ("$", r"\[") or name in MATHS_ENVIRONMENTS for name, _ in self.open)

    def fail(self, what: str) -> None:
        self.wrong.append(f"line {self.line}: {what}")

    def opens(self, name: str) -> None:
        self.open.append((name, self.line))

    def closes(self, name: str) -> None:
        if not self.open or self.open[-1][0] != name:
            last = "nothing" if not self.open else f"{self.open[-1][0]} of line {self.open[-1][1]}"
            self.fail(f"{name} is closed, and open is {last}")
        else:
            self.open.pop()

    def row_ends(self) -> None:
        """A row of a table or matrix has as many cells as the others."""
        if self.cells and self.open[-1][0] in ALIGNED:
            wanted, found = self.cells[-1]
            if wanted and found != wanted:
                self.fail(f"a row of {self.open[-1][0]} has {found} cells, not {wanted}")
            self.cells[-1] = [wanted or found, 1]


PICTURE = re.compile(r"\\begin\{tikzpicture\}.*?\\end\{tikzpicture\}", re.DOTALL)
NODE = re.compile(r"^\\node\[.*?\] at \([^)]*\) \{(.*)\};$", re.MULTILINE)
OWN = re.compile(r"^\\newcommand.*$", re.MULTILINE)
FORMULA = re.compile(r"^\\(?:letters|numbers)\{(.*)\}$", re.MULTILINE)


def plain_source(source: str) -> str:
    """The document with its own commands written out, and of pictures the texts alone."""
    source = PICTURE.sub(lambda found: "\n\n".join(NODE.findall(found[0])), OWN.sub("", source))
    return FORMULA.sub(r"\\[\1\\]", source)


def problems(source: str) -> list[str]:
    """What a compiler would stop at, or set wrongly, each with its line."""
    r, source = Reader(), plain_source(source)
    tokens = TOKEN.findall(source)
    if "".join(tokens) != source:
        r.fail("something is no token")
    k = 0
    while k < len(tokens):
        k += _read(r, tokens, k)
        r.line += tokens[k - 1].count("\n")
    if r.open:
        r.fail(f"never closed: {r.open}")
    for wanted in (r"\documentclass", r"\begin{document}", r"\end{document}"):
        if source.count(wanted) != 1:
            r.fail(f"{wanted} stands {source.count(wanted)} times")
    labels, named = (
        set(re.findall(r"\\label\{(.*?)\}", source)),
        set(re.findall(r"\\(?:eq)?ref\{(.*?)\}", source)),
    )
    if named - labels:
        r.fail(f"refers to {named - labels}")
    return r.wrong


def _read(r: Reader, tokens: list[str], k: int) -> int:
    """Read the token at k; how many were taken."""
    token = tokens[k]
    if token in (r"\begin", r"\end"):
        name = re.match(r"\{([a-z*]+)\}(\{[lcr]+\})?", "".join(tokens[k + 1 : k + 60]))
        assert name is not None, r.line
        _environment(r, token, name[1], name[2] or "")
        taken, length = 1, 0
        while length < len(name[0]):
            length += len(tokens[k + taken])
            taken += 1
        return taken
    _one(r, token)
    _keep_scripts(r, token)
    return 1


def _keep_scripts(r: Reader, token: str) -> None:
    """An atom begins without scripts, unless it is one itself."""
    if token == "{":
        r.outer.append(r.scripts if r.script else set())
        r.scripts = set()
    elif token == "}":
        r.scripts = r.outer.pop() if r.outer else set()
    elif token.strip() and token not in "_^" and not r.script:
        r.scripts = set()
    if token.strip():
        r.script = token in "_^"


def _environment(r: Reader, token: str, name: str, columns: str) -> None:
    if name not in MATHS_ENVIRONMENTS | {"document", "tabular", "center", "minipage"}:
        r.fail(f"an unknown environment {name}")
    if token == r"\begin":
        if name in ("gather*", "align*", "equation*", "tabular") and r.maths:
            r.fail(f"{name} within mathematics")
        if name in ("bmatrix", "pmatrix") and not r.maths:
            r.fail(f"{name} outside mathematics")
        r.opens(name)
        if name in ALIGNED:
            r.cells.append([max(len(columns) - 2, 0), 1])
        return
    if name in ALIGNED:
        if name != "tabular":
            r.row_ends()  # the last row of a matrix has no end of its own
        elif r.cells[-1][1] != 1:
            r.fail("the last row of a tabular has no end")
        r.cells.pop()
    r.closes(name)


def _one(r: Reader, token: str) -> None:
    if token == "{":
        r.opens("{")
    elif token == "}":
        r.closes("{")
    elif token == "$":
        if r.open and r.open[-1][0] == "$":
            r.closes("$")
        elif r.maths:
            r.fail("a dollar sign within mathematics")
        else:
            r.opens("$")
    elif token == r"\[":
        if r.maths:
            r.fail("a display within mathematics")
        r.opens(r"\[")
    elif token == r"\]":
        r.closes(r"\[")
    elif token == r"\\":
        r.row_ends()
    elif token.startswith("\\"):
        _command(r, token)
    else:
        _character(r, token)


def _command(r: Reader, token: str) -> None:
    if not token[1].isalpha():
        if token not in SIGNS:
            r.fail(f"an unknown command {token}")
    elif token[1:] in MATHS:
        if not r.maths:
            r.fail(f"{token} outside mathematics")
    elif token[1:] not in BOTH:
        r.fail(f"an unknown command {token}")


def _character(r: Reader, token: str) -> None:
    if token in "_^" and token:
        if not r.maths:
            r.fail(f"{token} outside mathematics")
        elif token in r.scripts:
            r.fail(f"two of {token} on one atom")
        r.scripts.add(token)
    elif token == "&":
        if not r.open or r.open[-1][0] not in ALIGNED:
            r.fail("& outside a table")
        else:
            r.cells[-1][1] += 1
    elif token in ("#", "%", "$$"):
        r.fail(f"{token} unescaped")
    elif token.isspace():
        if token.count("\n") > 1 and r.maths:
            r.fail("an empty line within mathematics")
    elif not WRITTEN.fullmatch(token):
        r.fail(f"the sign {token} ({ord(token):04x}) is not in the encoding")
