"""A program of YARP 3.5, which knows nothing of this project; see `yarp_peers`.

It runs with the Python of YARP's environment. Each line of its output is a list in JSON: an event
and its values.
"""

import json
import sys
import time

import yarp


def show(*values):
    sys.stdout.write(json.dumps(values) + "\n")
    sys.stdout.flush()


def fill(bottle, items):
    bottle.clear()
    for item in items:
        if isinstance(item, str):
            bottle.addString(item)
        elif isinstance(item, int):
            bottle.addInt32(item)
        else:
            bottle.addFloat64(item)


def write(name, items, period=0.02, stamp=0.0):
    """Write the items again and again; with a stamp, each message has it as its envelope."""
    port = yarp.BufferedPortBottle()
    port.open(name)
    show("ready")
    while True:
        if stamp:
            port.setEnvelope(yarp.Stamp(7, stamp))
        fill(port.prepare(), items)
        port.writeStrict()
        time.sleep(period)


def read(name, pause=0.0):
    """Read; `pause` in s after each message."""
    port = yarp.BufferedPortBottle()
    port.setStrict(pause > 0)
    port.open(name)
    show("ready")
    stamp = yarp.Stamp()
    while True:
        bottle = port.read(False)
        if bottle is None:
            time.sleep(0.001)
            continue
        port.getEnvelope(stamp)
        text = bottle.toString()
        show("read", text if len(text) < 1000 else len(text), stamp.getTime())
        time.sleep(pause)


def sleep(name):
    """A port that takes connections and reads nothing, as a program that hangs."""
    port = yarp.Port()
    port.open(name)
    show("ready")
    while True:
        time.sleep(1)


def serve(name, reply):
    """Answer requests."""
    server = yarp.RpcServer()
    server.open(name)
    show("ready")
    request, answer = yarp.Bottle(), yarp.Bottle()
    while True:
        if server.getInputCount() and server.read(request, True):
            show("request", request.toString())
            fill(answer, reply)
            server.reply(answer)
        time.sleep(0.001)


def write_images(name, width, height, period):
    """Write images of one color; the red of the first pixel counts."""
    port = yarp.BufferedPortImageRgb()
    port.open(name)
    show("ready")
    count = 0
    while True:
        image = port.prepare()
        image.resize(width, height)
        count = (count + 1) % 256
        image.pixel(0, 0).r = count
        image.pixel(width - 1, height - 1).b = 77
        port.setEnvelope(yarp.Stamp(count, time.time()))
        port.write()
        time.sleep(period)


def read_images(name):
    """Read images."""
    port = yarp.BufferedPortImageRgb()
    port.open(name)
    show("ready")
    stamp = yarp.Stamp()
    while True:
        image = port.read(False)
        if image is None:
            time.sleep(0.001)
            continue
        port.getEnvelope(stamp)
        size = [image.width(), image.height()]
        first, last = image.pixel(0, 0), image.pixel(size[0] - 1, size[1] - 1)
        show("image", size, [first.r, first.g, first.b], [last.r, last.g, last.b], stamp.getTime())


yarp.Network.init()
mode, *arguments = json.loads(sys.argv[1])
globals()[mode](*arguments)
