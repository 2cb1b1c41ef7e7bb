"""`dalembert completion`: the script with which a shell completes commands and options."""

from __future__ import annotations

from typing import Annotated, Literal

from dalembert.cli.options import with_help

EXAMPLES = """Examples:
  source <(dalembert completion bash)
  dalembert completion bash > ~/.local/share/bash-completion/completions/dalembert
  dalembert completion zsh > ~/.zfunc/_dalembert
  dalembert completion fish > ~/.config/fish/completions/dalembert.fish"""


def completion(
    shell: Annotated[Literal["bash", "zsh", "fish"], with_help("Shell: bash, zsh or fish.")], /
) -> int:
    """Print the script that completes commands, options and their values in a shell."""
    from dalembert.cli.app import command_line

    print(command_line("").generate_completion(shell=shell))
    return 0


COMMANDS = {completion: EXAMPLES}
"""Function of the command -> the examples under its help."""
