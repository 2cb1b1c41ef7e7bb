"""Motion under forces of the released drives.

In: a ``Mechanism``, an end. Out: a ``Simulation``: a ``Result`` over time, events, works, checks. Imports
``analysis``, ``kernel``, ``core`` and what they import.

equation     M_r u' + h = tau, from the compiled inverse dynamics (equation_trace: per structure, or per mechanism)
actuation    actuation of each drive: given efforts, motors with their switches, brakes
coded        the method's steps, in machine code where the motion is smooth between events
many         motions of many designs side by side, and what happens in each
integration  segments between events: contacts that come to rest, switches, the user's (occurrences)
stops        end stops: impacts, rest, their forces
coordinates  near a dead centre of a drive other freedoms take over, piece by piece
standstill   whether friction holds a drive at rest, by the analysis of the machine at rest at that position
simulation   `da.simulate`; energies: of a result, in closed form
"""
