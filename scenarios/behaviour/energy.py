"""Energy: what the drive cost at the wheels."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import fsum
from typing import Any

from scenarios.episode import Episode
from scenarios.verdicts.judge import TICK_S
from tape.record import Record


@dataclass
class Energy:
    """Watches a run. From what the plant applies; only ION's knows its torque."""

    energy_j: float | None = None
    way_m: float = 0.0

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Take what drives the wheels at the end of this tick."""
        del records  # Unused.
        self.way_m += abs(episode.truth.speed_mps) * TICK_S
        power_w = _power_w(getattr(episode.simulator, "plant", None))
        if power_w is not None:
            # Engine braking gives nothing back.
            self.energy_j = (self.energy_j or 0.0) + max(power_w, 0.0) * TICK_S

    def figures(self) -> dict[str, Any]:
        """What was measured; None for a vehicle that does not tell, or did not move."""
        energy_j, way_m = self.energy_j, self.way_m
        measured = energy_j is not None
        return {
            "energy_MJ": energy_j * 1e-6 if measured else None,
            "energy_kJ_per_m": energy_j * 1e-3 / way_m if measured and way_m else None,
        }


def _power_w(plant: Any) -> float | None:
    """Drive torque of all wheels times their mean speed: what the coupling of the wheels loses
    between them is part of it."""
    torque_n_m = getattr(plant, "drive_torque_n_m", None)
    if torque_n_m is None:
        return None
    spin_radps: list[float] = plant.wheel_speed_radps.tolist()
    return torque_n_m * fsum(spin_radps) / len(spin_radps)
