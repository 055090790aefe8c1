"""The twin's MuJoCo data as a `dm_control` Physics that looks and does not touch."""

from typing import Any

import mujoco

try:
    from dm_control.mujoco import Physics, wrapper
except ImportError as error:
    raise ImportError("physics needs dm_control: pip install 'ion-twin[dm-control]'") from error


class PhysicsView(Physics):
    """Shares model and data with a twin; stepping is the environment's.

    dm_control would step by half steps of its own: after 5 s that is 12 mm elsewhere.
    """

    def after_reset(self) -> None:
        """Nothing: the twin's data are up to date, and a forward pass would change its bits."""

    def step(self, nstep: int = 1) -> None:
        """Refused.

        Raises:
            RuntimeError: always.
        """
        raise RuntimeError("the physics is a view: step the environment instead")


def view(data: mujoco.MjData) -> Any:
    """A view of a twin's data."""
    return PhysicsView(wrapper.MjData(data))
