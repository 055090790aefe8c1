"""What `--ablate` can take away, to see whether a course is worth passing."""

LIDARS = ("lidar_bumper", "lidar_roof", "lidar_left", "lidar_right", "lidar_field")
SENSORS = (*LIDARS, "sonar", "gps", "imu", "compass", "odometry")

ABLATIONS: dict[str, frozenset[str]] = {
    "blind": frozenset({*LIDARS, "sonar"}),
    "no-lidar": frozenset(LIDARS),
    **{f"no-{name.replace('_', '-')}": frozenset({name}) for name in SENSORS},
}
"""Ablation to the sensors that fall silent, of those that a vehicle has."""


def disabled_sensors(ablate: tuple[str, ...]) -> frozenset[str]:
    """The sensors that are silent under these ablations.

    Raises:
        ValueError: an unknown ablation; lists those that exist.
    """
    if unknown := [name for name in ablate if name not in ABLATIONS]:
        raise ValueError(f"--ablate {unknown[0]}: unknown; known are {', '.join(ABLATIONS)}")
    return frozenset().union(*(ABLATIONS[name] for name in ablate))
