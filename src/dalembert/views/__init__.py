"""Results as pictures: Result -> Scene, pure; the scene knows no mechanics, back ends write it."""

from dalembert.views import draw
from dalembert.views.scene import Scene

__all__ = ["Scene", "draw"]
