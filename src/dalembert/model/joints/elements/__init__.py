"""Joints that are machine elements: belts, ropes, cams, brakes, clutches; what a pin's bolt has for keys.

In: keys of a file. Out: frozen parts of the description. Imports what ``model.joints`` does.
"""
