"""Whether drawings can be read: texts that overlap each other, and texts that a stroke crosses."""

from __future__ import annotations

import numpy as np

from dalembert.views.paper.canvas import crossings, overlapping, segments
from dalembert.views.paper.scene import Scene, Text


def text_overlaps(scene: Scene) -> list[tuple[str, str]]:
    """Pairs of texts that overlap; none in a good drawing."""
    texts = scene.texts()
    boxes = np.array([t.box for t in texts], float).reshape(-1, 4)
    pairs = np.argwhere(np.triu(overlapping(boxes, boxes), 1))
    return [(texts[a].text, texts[b].text) for a, b in pairs]


def text_over_lines(scene: Scene) -> list[str]:
    """Texts that a stroke crosses; none in a good drawing."""
    texts = scene.texts()
    boxes = np.array([t.box for t in texts], float).reshape(-1, 4)
    strokes = segments([i for i in scene.flat() if not isinstance(i, Text)])
    if not len(strokes) or not len(boxes):
        return []
    return [texts[k].text for k in np.flatnonzero(crossings(boxes, strokes).any(axis=1))]
