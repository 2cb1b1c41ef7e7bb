"""Machine design on top of the force analysis: the forces of a machine on its foundation, and the choice of machine
elements.

In: a ``Result``, or a description. Out: numbers by name, each with its check. Imports ``analysis`` and what it imports;
no pictures (``views/machine``), no worked letters (``reports/machine_sections``), no command (``cli``).

shaking    force and moment on the ground, by two methods; harmonics of any output; even positions over full turns
gyroscopes the couple of a rotor whose carrier turns, as in textbooks
balance/   counterweights under bounds, proved optimal; rotors; engines beside the textbook series
flywheel/  the energy curve, size of a flywheel, and the exact speed over the cycle with it
motion/    motion under forces: the equation of motion, simulation, events
members/   forces inside links, stresses, fatigue, buckling
bearings/  pressure, PV and life of the joints that turn, and a choice from a table
motors/    torque that a drive requires of its motor, and the gear ratio of least torque
output/    common parts of the answers in this package: columns, record, printed parts
"""
