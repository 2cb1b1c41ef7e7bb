"""Coordinates of a motion near dead centres of its drives: freedoms of other joints, piece by piece.

In: a motion that comes near one. Out: its pieces, and their instants and poses as those of the drives. Imports
``analysis`` and the rest of ``machine.motion``.

dead_centres       detects that a motion comes near one
leading_freedoms   the freedoms that place the links best, and the efforts on them that replace those of the drives
pieces             one integration after the other, and their instants joined
"""
