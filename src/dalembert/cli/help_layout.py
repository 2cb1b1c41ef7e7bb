"""The layout of --help."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

from cyclopts.help import PlainFormatter

if TYPE_CHECKING:
    from rich.console import Console


class Hanging(PlainFormatter):
    """Plain text; continuation lines of an option's sentence are aligned under the first."""

    def _print_plain(self, console: Console, text: str) -> None:
        if text.startswith(self.indent):
            first, others = self.indent, 3 * self.indent
            text = textwrap.fill(
                " ".join(text.split()),
                console.width,
                initial_indent=first,
                subsequent_indent=others,
                break_on_hyphens=False,
            )
        super()._print_plain(console, text)
