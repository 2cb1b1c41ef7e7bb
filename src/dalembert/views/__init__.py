"""Results as pictures: Result -> Scene, pure; the scene knows no mechanics, formats write it.

In: a ``Result``. Out: a ``Scene``. Imports ``analysis``, ``wrench``.
"""

from dalembert.views import draw
from dalembert.views.paper.scene import Scene

__all__ = ["Scene", "draw"]
