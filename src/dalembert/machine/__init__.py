"""Machine design on top of the force analysis: what a machine does to its foundation, and what is chosen by it.

In: a ``Result``, or a description. Out: numbers by name, each with its check. Imports ``analysis`` and what it imports;
no pictures (``views/machine``), no worked letters (``reports/machine_sections``), no command (``cli``).

shaking    force and moment on the ground, two ways; harmonics of any output; even positions over whole turns
gyroscopes the couple of a rotor whose carrier turns, as the books show it
balance/   counterweights under bounds, proved best; rotors; engines beside the books' series
flywheel/  the energy curve, size of a flywheel, and the exact speed over the cycle with it
motion/    motion under forces: the equation of motion, simulation, events
members/   forces inside links, stresses, fatigue, buckling
bearings/  pressure, PV and life of the joints that turn, and a choice from a table
motors/    what a drive asks its motor for, and the gear ratio of least torque
output/    what all answers of this room have in common: columns, record, parts to read
"""
