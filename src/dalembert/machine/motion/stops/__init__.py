"""End stops of drives and joints, and contacts that only push: their gaps are freedoms that end at 0.

In: a motion with stops, a mechanism with contacts. Out: speeds behind impacts, rest, lift-off and landing, and the
forces of stops and contacts. Imports ``analysis`` and the rest of ``machine.motion``.

impacts           speeds behind an impact, what it loses, rest on a stop
stop_loads        what stops give, as efforts of drives and loads of the analysis
gap_contacts      the gaps of contacts, and their names
opened_contacts   the mechanism whose contacts may open: the gap of each is a drive's, or a freedom with a stop
touching          which contacts are closed along a motion: lift-off, landing, sets that satisfy all signs
contact_answer    reactions, normal forces and gaps, in a result of the description itself
"""
