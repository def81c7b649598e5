"""Images: `sensor_msgs::Image` of ROS as `yarp::sig::Image`, and back.

In: the struct of ROS, or the Bottle that a YARP image is: `[mat] [CODE] (PIXEL TOTAL QUANTUM WIDTH
HEIGHT) {PIXELS}`, all in bytes and pixels (`yarp/sig/ImageNetworkHeader.h`). Pixels are not copied
unless a row must be moved, or bytes swapped.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from robocomp_dsl.runtime.codec.bottle.values import Vocab, is_word, vocab
from robocomp_dsl.runtime.data.convert import as_array, as_scalar
from robocomp_dsl.runtime.data.errors import EncodeError
from robocomp_dsl.runtime.data.schema import INT
from robocomp_dsl.runtime.errors import MalformedMessage

IMAGE_ID = "sensor_msgs/msg/Image"
_MAT = "mat"
_CODES = {
    "mono8": ("mono", 1, 1),
    "mono16": ("mo16", 2, 2),
    "rgb8": ("rgb", 3, 1),
    "rgba8": ("rgba", 4, 1),
    "bgr8": ("bgr", 3, 1),
    "bgra8": ("bgra", 4, 1),
    "32FC1": ("dec", 4, 4),
    "32FC3": ("rgb.", 12, 4),
    "32SC1": ("int", 4, 4),
    "8SC1": ("sign", 1, 1),
    "8SC3": ("rgb-", 3, 1),
    "32SC3": ("rgbi", 12, 4),
    "bayer_grbg8": ("grbg", 1, 1),
    "bayer_bggr8": ("bggr", 1, 1),
    "bayer_gbrg8": ("gbrg", 1, 1),
    "bayer_rggb8": ("rggb", 1, 1),
    "bayer_grbg16": ("gr16", 2, 2),
    "bayer_bggr16": ("bg16", 2, 2),
    "bayer_gbrg16": ("gb16", 2, 2),
    "bayer_rggb16": ("rg16", 2, 2),
}
"""Encoding of ROS: pixel code of YARP, bytes of a pixel, bytes of one of its numbers."""
_SAME = {"8UC1": "mono8", "16UC1": "mono16", "8UC3": "bgr8", "8UC4": "bgra8"}
"""Encodings of ROS without a meaning for colours, as OpenCV orders them."""
_ENCODINGS = {vocab(code): (name, size) for name, (code, size, _) in _CODES.items()}
_QUANTA = (8, 1, 4, 16, 32, 64)
"""8 is the default of YARP."""
_MAX_QUANTUM = 2**15 - 1
_BOTTOM_UP = 1


def image_to_items(type_: type[Any]) -> Callable[[Any], list[Any]]:
    """A function from a `sensor_msgs::Image` to the items of a YARP image."""
    dtype = np.dtype(np.uint8)

    def convert(image: Any) -> list[Any]:
        if not isinstance(image, type_):
            raise EncodeError(f"takes a {type_.__name__}, not a {type(image).__name__}")
        encoding = str(image.encoding)
        encoding = _SAME.get(encoding, encoding)
        if encoding not in _CODES:
            raise EncodeError(
                f"YARP has no pixels of the encoding `{encoding:.40}`; it has"
                f" {', '.join(_CODES)}. `yarp.layout=fields` publishes the struct as it is",
                "encoding",
            )
        code, pixel, number = _CODES[encoding]
        width, height, step = (_number(image, name) for name in ("width", "height", "step"))
        try:
            data = as_array(image.data, dtype)
        except EncodeError as error:
            raise EncodeError(error.reason, "data") from None
        step = step or width * pixel
        if step < width * pixel:
            raise EncodeError(f"is {step}, but {width} pixels have {width * pixel} bytes", "step")
        if len(data) != step * height:
            raise EncodeError(
                f"{height} rows of {step} bytes have {step * height} bytes, not {len(data)}", "data"
            )
        if image.is_bigendian and number > 1:
            data = _swapped(data, step, width * pixel, number)
        quantum, data = _padded(data, height, step, width * pixel)
        numbers = np.array([pixel, len(data), quantum, width, height], np.int32)
        return [vocab(_MAT), vocab(code), numbers, data.data]

    return convert


def _number(image: Any, name: str) -> int:
    """A size of an image; YARP's are int32."""
    try:
        number = int(as_scalar(INT, getattr(image, name)))
    except EncodeError as error:
        raise EncodeError(error.reason, name) from None
    if number < 0:
        raise EncodeError(f"is {number}", name)
    return number


def _swapped(data: np.ndarray[Any, Any], step: int, row: int, number: int) -> Any:
    """Numbers of the other byte order; what pads the rows is removed."""
    rows = np.ascontiguousarray(data.reshape(-1, step)[:, :row])
    swapped = rows.reshape(-1, number)[:, ::-1].reshape(rows.shape)
    return _aligned(swapped, row, step).ravel()


def _aligned(rows: Any, row: int, step: int) -> Any:
    """`rows`, each with `step` bytes."""
    if row == step:
        return np.ascontiguousarray(rows)
    padded = np.zeros((len(rows), step), np.uint8)
    padded[:, :row] = rows[:, :row]
    return padded


def _step(row: int, quantum: int) -> int:
    """Bytes of a row of a YARP image."""
    return -(-row // quantum) * quantum


def _padded(data: Any, height: int, step: int, row: int) -> tuple[int, Any]:
    """The quantum whose rows have `step` bytes, or 8 and rows that were moved."""
    for quantum in (*_QUANTA, step):
        if 0 < quantum <= _MAX_QUANTUM and _step(row, quantum) == step:
            return quantum, data
    quantum = _QUANTA[0]
    rows = data.reshape(height, step)
    return quantum, _aligned(rows, row, _step(row, quantum)).ravel()


def is_image(items: Any) -> bool:
    """Whether a Bottle is a YARP image."""
    return isinstance(items, list) and len(items) == 4 and is_word(items[0], _MAT)


def items_to_image(type_: type[Any]) -> Callable[[Any], Any]:
    """A function from the items of a YARP image to a `sensor_msgs::Image` without frame."""

    def convert(items: Any) -> Any:
        _, code, numbers, data = items
        if not isinstance(code, Vocab) or code not in _ENCODINGS:
            shown = code.text if isinstance(code, Vocab) else code
            known = ", ".join(each.text for each in _ENCODINGS)
            raise MalformedMessage(f"a YARP image of `{shown!s:.20}`; known: {known}")
        encoding, pixel = _ENCODINGS[code]
        values = [int(number) for number in numbers] if _is_geometry(numbers) else []
        if len(values) != 5 or not isinstance(data, bytes | memoryview):
            raise MalformedMessage(
                "a YARP image has five numbers (pixel, total, quantum, width, height) and a blob"
            )
        # The upper half of the quantum is the order of the rows: 0 means from top to bottom.
        quantum, order = values[2] & 0xFFFF, values[2] >> 16 & 0xFFFF
        width, height = values[3:]
        step = _step(width * pixel, quantum or 1)
        if min(width, height) < 0 or step * height != len(data) or values[0] != pixel:
            raise MalformedMessage(
                f"a YARP image of {width} x {height} pixels of {values[0]} bytes, quantum"
                f" {quantum}, has {len(data)} bytes; it should have {step * height}"
            )
        pixels = np.frombuffer(data, np.uint8)
        if order == _BOTTOM_UP:
            pixels = np.ascontiguousarray(pixels.reshape(height, step)[::-1]).ravel()
        return type_(
            encoding=encoding, height=height, width=width, is_bigendian=0, step=step, data=pixels
        )

    return convert


def _is_geometry(numbers: Any) -> bool:
    return isinstance(numbers, list | np.ndarray) and all(
        isinstance(number, int | np.integer) for number in numbers
    )
