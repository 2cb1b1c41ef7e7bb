"""`dalembert members`: forces inside links, stresses, buckling."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

from cyclopts import Parameter

from dalembert.cli.machine.machine_commands import NO_OUTPUTS, Outputs, solve_over_a_turn
from dalembert.cli.options import AS_IN_FILE, Changes, ModelFile, Positions, Static
from dalembert.errors import ModelError


def members(
    file: ModelFile,
    /,
    *,
    links: Annotated[
        list[str] | None,
        Parameter(
            negative=(), consume_multiple=True, help="Links, one or more (default: all with a length)."
        ),
    ] = None,
    static: Static = False,
    positions: Positions = None,
    changes: Changes = AS_IN_FILE,
    out: Outputs = NO_OUTPUTS,
) -> int:
    """Axial force, shear and bending moment inside links of FILE; stress, safety and buckling of their sections."""
    from dalembert.machine.members.member_table import member_table

    out.check(file)
    result = solve_over_a_turn(file, static, positions, changes)
    try:
        found = member_table(result, links)
    except ModelError as error:
        raise error.at_source(result.mechanism.source) from None
    out.deliver(found)
    return 0


MEMBERS = """Examples:
  dalembert members press.yaml
  dalembert members press.yaml --links rod --drawing rod.svg --report rod.pdf
  dalembert members press.yaml --set "links.rod.section={circle: 30 mm, yield_stress: 250 MPa}" """

COMMANDS: dict[Callable[..., int], str] = {members: MEMBERS}
"""Each with its examples."""
