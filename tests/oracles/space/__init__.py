"""Independent answers in space: these modules import nothing of dalembert.

``moving``     vectors, rotations and poses on jets (value, rate, second rate)
``statics``    what a link's joints must carry, and the check of all free bodies and of the power
``rods``       RSSR, RSUR, RSSP and RSUP in closed form, free bodies solved one after another
``shafts``     Hooke's joint with its cross, and the double Cardan shaft
``spinning``   a rotor with skew inertia in two bearings, and a chain of revolutes (gyroscope, disk on an arm)
``natural``    any mechanism: 12 coordinates a link (origin and axes), constraints of second degree, multipliers
``rubbing``    friction on top of it: Newton and Euler link by link, each joint's law on its whole reaction
``rough_machines``  closed linkages with friction in their joints, for ``rubbing``
``random_drawn``  random mechanisms of all pairs, drawn as they close, for ``natural``
``free_motion``   states of two published free motions
``compliance``    reactions beyond equilibrium by least elastic energy of the joints
``screws``     mobility by the rank of the joints' screws, and of a loop that closes over a range (Denavit-Hartenberg)
``classics``   overconstrained linkages with their published mobility

The hand solutions turn numbers into ``Answer``: arrays over the positions, in ground axes, reactions on j at j's point.
"""
