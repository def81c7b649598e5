"""Offscreen OpenGL: by EGL, or else by OSMesa, which renders on the CPU.

In: nothing. Out: a MuJoCo context, or `NoRendering`, whose message says what to install. The
libraries are probed before Python's OpenGL is loaded, because it can use only one of them.
"""

from __future__ import annotations

import ctypes
import os
from typing import Any

from robocomp_dsl.hardware.devices.errors import NoRendering

_EGL, _OSMESA = "libEGL.so.1", "libOSMesa.so.8"
_PLATFORM_DEVICE = 0x313F  # EGL_PLATFORM_DEVICE_EXT
_MOST_DEVICES = 32
CHOSEN = "MUJOCO_GL"


def new_context(width: int, height: int) -> Any:
    """A context of `width` by `height` pixels, not current yet. Raises `NoRendering`."""
    ways = {"egl": (egl_trouble, _egl), "osmesa": (osmesa_trouble, _osmesa)}
    chosen = os.environ.get(CHOSEN, "").lower()
    troubles = []
    for name in [chosen] if chosen in ways else ways:
        trouble, make = ways[name]
        reason = trouble()
        if not reason:
            return make(width, height)
        troubles.append(reason)
    raise NoRendering("offscreen rendering is not available: " + "; ".join(troubles))


def _egl(width: int, height: int) -> Any:
    from mujoco.egl import GLContext  # noqa: PLC0415 - loads OpenGL for EGL

    return GLContext(width, height)


def _osmesa(width: int, height: int) -> Any:
    from mujoco.osmesa import GLContext  # noqa: PLC0415 - loads OpenGL for OSMesa

    return GLContext(width, height)


def osmesa_trouble() -> str:
    """Why OSMesa cannot be used; empty if it can."""
    return "" if _library(_OSMESA) else f"`{_OSMESA}` is missing: apt install libosmesa6"


def egl_trouble() -> str:
    """Why EGL cannot be used; empty if it can."""
    egl = _library(_EGL)
    if egl is None:
        return f"`{_EGL}` is missing: apt install libegl1 libgl1-mesa-dri"
    if not _any_device(egl):
        return "EGL has no rendering device: apt install libgl1-mesa-dri"
    return ""


def _library(name: str) -> ctypes.CDLL | None:
    try:
        return ctypes.CDLL(name)
    except OSError:
        return None


def _any_device(egl: ctypes.CDLL) -> bool:
    """Whether a display can be opened on one of EGL's devices (EGL_EXT_platform_device)."""
    find = egl.eglGetProcAddress
    find.restype, find.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
    listing, opening = find(b"eglQueryDevicesEXT"), find(b"eglGetPlatformDisplayEXT")
    if not listing or not opening:
        return False
    devices, count = (ctypes.c_void_p * _MOST_DEVICES)(), ctypes.c_int()
    query = ctypes.CFUNCTYPE(
        ctypes.c_uint, ctypes.c_int, ctypes.c_void_p, ctypes.POINTER(ctypes.c_int)
    )(listing)
    if not query(_MOST_DEVICES, ctypes.cast(devices, ctypes.c_void_p), ctypes.byref(count)):
        return False
    display_of = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p)(
        opening
    )
    egl.eglInitialize.argtypes = [ctypes.c_void_p] * 3
    displays = (display_of(_PLATFORM_DEVICE, devices[i], None) for i in range(count.value))
    return any(display and egl.eglInitialize(display, None, None) for display in displays)
