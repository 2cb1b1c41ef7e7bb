"""Motions with events of many designs side by side.

In: designs of one machine. Out: their ends and outputs. Imports ``machine.motion.coded`` and what it imports.

motion_block    smooth motions, and their outputs
motion_kernel   what is called with designs, and its answer
event_program   rates in machine code with all that is watched, and the outputs
course          steps of all designs to their next events, and what happens there
event_block     outputs at instants and events, reduced
event_machine   code and guards of a machine
event_kernel    what is called with designs that have events
one_design      a design by itself
over_instants   an output of one design over its instants
along_motions   quantities along the motions of many designs, with derivatives by differences
simulation_plan settings of the motion of each design, from a file or a call
"""
