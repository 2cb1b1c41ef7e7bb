"""Motion under forces of the drives that are let go.

In: a ``Mechanism``, an end. Out: a ``Simulation``: a ``Result`` over time, events, works, checks. Imports
``analysis``, ``kernel``, ``core`` and what they import.

equation     M_r u' + h = tau, from the compiled inverse dynamics (equation_trace: a structure's, or its own)
actuation    what moves each drive: given efforts, motors with their switches, brakes
steps        the method's steps, in machine code where the motion is smooth
integration  segments between events: contacts that come to rest, switches, the user's (occurrences)
stops        end stops: impacts, rest, their forces
coordinates  where a drive comes near its dead centre, other freedoms lead on, piece by piece
standstill   whether friction holds a drive at rest, by the analysis of the machine at rest there
simulation   `da.simulate`; energies: of a result, in closed form
"""
