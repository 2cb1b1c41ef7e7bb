"""Coordinates of a motion near dead centres of its drives: freedoms of other joints, piece by piece.

In: a motion that comes near one. Out: its pieces, and their instants and poses as those of the drives. Imports
``analysis`` and the rest of ``machine.motion``.

dead_centres       whether a motion comes near one
leading_freedoms   which freedoms place the links best; what acts on them in place of the drives
pieces             one integration after the other, and their instants joined
"""
