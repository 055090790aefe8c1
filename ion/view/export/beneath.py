"""A scene that lies below one frame: move the frame, and all of it moves."""

from typing import Any, cast

import viser


class _Beneath:
    def __init__(self, scene: viser.SceneApi, root: str) -> None:
        self._scene, self._root = scene, root

    def __getattr__(self, name: str) -> Any:
        method = getattr(self._scene, name)
        return lambda node, *values, **named: method(self._root + node, *values, **named)


def beneath(scene: viser.SceneApi, root: str) -> viser.SceneApi:
    """The scene's methods that take a node's name first, which then lies below `root`."""
    return cast(viser.SceneApi, _Beneath(scene, root))
