"""Where things are in the memory of the loaded MuJoCo library: for what its bindings leave out.

The layout of MuJoCo's structs is computed from the declarations that come with its bindings, and
checked on a small model against the addresses that the bindings give.
"""

import ctypes
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import mujoco
from mujoco.introspect.ast_nodes import AnonymousStructDecl, ArrayType, PointerType
from mujoco.introspect.enums import ENUMS
from mujoco.introspect.structs import STRUCTS

WORD = 8
"""Bytes of a pointer."""
SCALARS: dict[str, Any] = {
    "mjtNum": ctypes.c_double,
    "float": ctypes.c_float,
    "int": ctypes.c_int,
    "mjtBool": ctypes.c_bool,
    "mjtSize": ctypes.c_int64,
    "uint64_t": ctypes.c_uint64,
    "uintptr_t": ctypes.c_size_t,
    "size_t": ctypes.c_size_t,
}

CONTACT = [("dist", 0), ("pos", 8), ("normal", 32), ("tangent", 56)]
"""What a collision function fills in, and where, in bytes."""


class Words(NamedTuple):
    """Positions in an mjModel and, the last two, an mjData, in words."""

    nuser_geom: int
    geom_user: int
    geom_size: int
    geom_dataid: int
    hfield_size: int
    hfield_nrow: int
    hfield_ncol: int
    hfield_adr: int
    hfield_data: int
    geom_xpos: int
    geom_xmat: int


PROBE = """<mujoco>
  <asset><hfield name="f" nrow="3" ncol="4" size="1 1 1 1"/></asset>
  <worldbody>
    <geom type="hfield" hfield="f"/>
    <body><freejoint/><geom type="ellipsoid" size="1 2 3" user="1 2 3 4 5"/></body>
  </worldbody>
</mujoco>"""
"""Every array that is looked for has something in it."""


def words() -> Words:
    """Where the fields are.

    Raises:
        RuntimeError: this MuJoCo lays out its structs in another way than it declares.
    """
    contact = _struct("mjPreContact")
    if [(name, getattr(contact, name).offset) for name, _ in contact._fields_] != CONTACT:
        raise RuntimeError(_unknown("mjPreContact"))
    model = mujoco.MjModel.from_xml_string(PROBE)
    return Words(
        *_verified("mjModel", Words._fields[:-2], model),
        *_verified("mjData", Words._fields[-2:], mujoco.MjData(model)),
    )


def collision_table() -> Any:
    """MuJoCo's `mjCOLLISIONFUNC`: the address of the function for each pair of geom types."""
    n = int(mujoco.mjtGeom.mjNGEOMTYPES)
    return (ctypes.c_void_p * n * n).in_dll(_library(), "mjCOLLISIONFUNC")


def _library() -> ctypes.CDLL:
    folder = Path(mujoco.__file__).parent
    names = ("libmujoco.so.*", "libmujoco.*dylib", "mujoco.dll")
    found = [path for name in names for path in folder.glob(name)]
    if len(found) != 1:
        raise RuntimeError(f"{len(found)} MuJoCo libraries in {folder}, expected one")
    return ctypes.CDLL(str(found[0]))  # the same that the bindings have loaded


def _verified(struct: str, fields: tuple[str, ...], instance: Any) -> Iterator[int]:
    layout = _struct(struct)
    for name in fields:
        word = getattr(layout, name).offset // WORD
        value = getattr(instance, name)
        expected = value if isinstance(value, int) else value.ctypes.data
        if ctypes.c_int64.from_address(instance._address + word * WORD).value != expected:
            raise RuntimeError(_unknown(f"{struct}.{name}"))
        yield word


def _unknown(what: str) -> str:
    return f"MuJoCo {mujoco.__version__}: {what} is not where expected; 3.17 is known to work"


def _struct(name: str) -> Any:
    return _structure(STRUCTS[name].fields)


def _structure(fields: Any) -> Any:
    """The ctypes structure of declared fields."""
    declared = [(field.name, _ctype(field.type)) for field in fields]
    return type("Declared", (ctypes.Structure,), {"_fields_": declared})


def _ctype(declared: Any) -> Any:
    if isinstance(declared, PointerType):
        return ctypes.c_void_p
    if isinstance(declared, ArrayType):
        inner = _ctype(declared.inner_type)
        for n in reversed(declared.extents):
            inner = inner * n
        return inner
    if isinstance(declared, AnonymousStructDecl):
        return _structure(declared.fields)
    if declared.name in SCALARS:
        return SCALARS[declared.name]
    return ctypes.c_int if declared.name in ENUMS else _struct(declared.name)
