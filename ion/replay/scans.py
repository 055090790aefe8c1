"""Whether a tape has what the navigator steers by: `--log light` leaves the LIDAR scans out."""

from pathlib import Path

from ion.errors import UsageError
from nav.messages import Decision, LidarScan
from tape.reader import metadata, read


def check_scans(log: Path) -> float | None:
    """Refuse a tape without scans, unless the drive had none; reads as far as the first decision.

    Returns:
        When that was delivered, [s]; None if there is none.

    Raises:
        UsageError: it has none.
        TapeError: no tape, or a damaged one.
    """
    scans, first_s = False, None
    for item in read(log):
        scans |= isinstance(item.message, LidarScan)
        if isinstance(item.message, Decision):
            first_s = item.delivery_ns * 1e-9
            break
    if not scans and _needs_scans(log):
        raise UsageError(
            f"{log}: has no LIDAR scans (--log light?); expected a tape of --log full or inputs"
        )
    return first_s


def _needs_scans(log: Path) -> bool:
    """A drive may have been without scanners from the beginning."""
    from scenarios.ablation import disabled_sensors
    from scenarios.vehicles import VEHICLES  # loads the simulator: only here, as it takes a second

    said = metadata(log)
    vehicle = VEHICLES.get(said.get("vehicle", ""))
    if vehicle is None:
        return True
    ablate = tuple(said.get("ablate", "").split())
    silent = disabled_sensors(ablate, vehicle.lidars, vehicle.radars)
    return not set(vehicle.lidars) <= silent
