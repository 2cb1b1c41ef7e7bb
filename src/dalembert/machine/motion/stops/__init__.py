"""End stops of drives and joints.

In: a motion with stops. Out: speeds behind impacts, rest, and the stops' forces. Imports ``analysis`` and the rest of
``machine.motion``.

impacts      speeds behind an impact, what it loses, rest on a stop
stop_loads   what stops give, as efforts of drives and loads of the analysis
"""
