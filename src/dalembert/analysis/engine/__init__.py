"""Answers from programs that are kept: one trace a structure, evaluated for any numbers in it at any positions.

What comes in is a compiled mechanism, what goes out a ``Result``, or none where the careful path has to look
(``analysis.one_pass``): where no program is kept yet, the linkage does not close, or something is in doubt.
"""
