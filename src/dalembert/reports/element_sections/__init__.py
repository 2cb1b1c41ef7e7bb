"""Sections of the worked solution about machine elements: belts and ropes, brakes and clutches, laws of motion.

In: a report's sheet and context. Out: lines added to the sheet. Imports ``views`` and what it imports.
"""
