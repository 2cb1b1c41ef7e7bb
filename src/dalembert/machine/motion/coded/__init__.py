"""Motions in machine code.

In: the nodes of an ``Equation``. Out: steps of motions side by side, and which of them an event may end. Imports
``kernel``, ``core`` and what they import.

rate_program     rates of a state as a program: accelerations, with friction where joints rub, and works
traced_terms     terms of the equation of motion from a traced analysis
acting_nodes     what acts on drives and in joints, and stops that are struck
traced_friction  accelerations and friction together, as nodes
steps            steps of Dormand and Prince's method
shared_motion    one equation for the motions of many designs
coded_motion     where a motion runs in machine code, and the steps at which a guard has to look
"""
