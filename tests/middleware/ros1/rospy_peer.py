"""A ROS 1 node on rospy, which knows nothing of this project; see `ros1_peers`.

It runs with the system's Python. It answers each line, a JSON list of a command and its arguments,
with a line of JSON.
"""

import importlib
import json
import sys
import threading
import time

import genpy.dynamic
import rospy
from std_msgs.msg import String
from std_srvs.srv import SetBool, SetBoolResponse


def message_class(type_):
    package, name = type_.split("/")
    return getattr(importlib.import_module(f"{package}.msg"), name)


def plain(value):
    if isinstance(value, genpy.rostime.TVal):
        return [value.secs, value.nsecs]
    if hasattr(value, "_slot_types"):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, bytes):
        return {"bytes": len(value), "sum": sum(value)}
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    return value


class Peer:
    def __init__(self, name):
        rospy.init_node(name, disable_signals=True)
        self.name = name
        self.messages = {}
        self.publishers = {}
        self.dynamic = {}
        self.streams = {}
        out = rospy.Publisher(f"/{name}/out", String, queue_size=100, tcp_nodelay=True)
        rospy.Subscriber(f"/{name}/in", String, out.publish, tcp_nodelay=True)
        self.map = rospy.Publisher(f"/{name}/map", String, queue_size=1, latch=True)
        self.map.publish("latched by rospy")
        rospy.Service(f"/{name}/set", SetBool, self.set)

    def set(self, request):
        if not request.data:
            raise ValueError("rospy refuses")
        return SetBoolResponse(True, "rospy")

    def type_of(self, type_):
        return self.dynamic.get(type_) or message_class(type_)

    def define(self, type_, text):
        self.dynamic.update(genpy.dynamic.generate_dynamic(type_, text))
        return self.dynamic[type_]._md5sum

    def subscribe(self, topic, type_):
        messages = self.messages[topic] = []
        rospy.Subscriber(topic, self.type_of(type_), lambda m: messages.append(plain(m)))

    def received(self, topic):
        return self.messages[topic]

    def advertise(self, topic, type_):
        self.publishers[topic] = rospy.Publisher(topic, self.type_of(type_), queue_size=10)

    def advertise_malformed(self, topic, type_, size):
        """Advertise a type whose messages are `size` bytes that mean nothing."""

        class Malformed(self.type_of(type_)):
            def serialize(self, buff):
                buff.write(b"\x7f" * size)

        self.publishers[topic] = rospy.Publisher(topic, Malformed, queue_size=10)

    def connections(self, topic):
        return self.publishers[topic].get_num_connections()

    def publish(self, topic, fields):
        publisher = self.publishers[topic]
        message = publisher.data_class()
        for name, value in fields.items():
            *path, last = name.split(".")
            target = message
            for part in path:
                target = getattr(target, part)
            setattr(target, last, value)
        publisher.publish(message)

    def stream(self, topic, fields, period):
        """Publish the same message again and again, until `stop`."""
        running = self.streams[topic] = threading.Event()

        def run():
            while not running.is_set():
                self.publish(topic, fields)
                time.sleep(period)

        threading.Thread(target=run, daemon=True).start()

    def stream_stamped(self, topic, stamp, period):
        """Publish with this time stamp, in s and ns."""
        self.stream(topic, {"header.stamp": rospy.Time(*stamp)}, period)

    def stop(self, topic):
        self.streams[topic].set()

    def subscribe_slowly(self, topic, type_, pause):
        """Subscribe with a callback that sleeps for `pause` s; TCP holds what comes meanwhile."""
        messages = self.messages[topic] = []

        def receive(message):
            messages.append(time.time())
            time.sleep(pause)

        rospy.Subscriber(topic, self.type_of(type_), receive, queue_size=1, buff_size=65536)

    def count(self, topic):
        return len(self.messages[topic])

    def last(self, topic):
        return self.messages[topic][-1] if self.messages[topic] else None

    def publish_image(self, topic, size):
        message = self.publishers[topic].data_class()
        message.data = bytes(range(256)) * (size // 256)
        self.publishers[topic].publish(message)

    def call(self, name, data):
        rospy.wait_for_service(name, 30)
        try:
            reply = rospy.ServiceProxy(name, SetBool)(data)
        except rospy.ServiceException as error:
            return ["failed", str(error)]
        return [reply.success, reply.message]

    def serve(self, name):
        """Serve SetBool: succeeds for true, with the request as its message."""
        rospy.Service(name, SetBool, lambda r: SetBoolResponse(r.data, f"rospy got {r.data}"))

    def stream_images(self, topic, encoding, width, height, period):
        """Publish images whose first byte counts, stamped with their number in s."""
        self.advertise(topic, "sensor_msgs/Image")
        message = self.publishers[topic].data_class()
        message.encoding, message.width, message.height = encoding, width, height
        message.step = width * (3 if encoding == "rgb8" else 1)
        pixels = bytearray(message.step * height)
        pixels[-1] = 77

        def run():
            for number in range(1, 1_000_000):
                pixels[0] = number % 256
                message.data = bytes(pixels)
                message.header.stamp = rospy.Time(1_700_000_000 + number, 250_000_000)
                self.publishers[topic].publish(message)
                time.sleep(period)

        threading.Thread(target=run, daemon=True).start()

    def call_often(self, name, count):
        rospy.wait_for_service(name, 30)
        proxy = rospy.ServiceProxy(name, SetBool, persistent=True)
        return [proxy(True).message for _ in range(count)]

    def parameter(self, name):
        return rospy.get_param(name, None)

    def set_parameter(self, name, value):
        rospy.set_param(name, value)


def reply(value):
    sys.stdout.write(json.dumps(value) + "\n")
    sys.stdout.flush()


def main():
    peer = Peer(sys.argv[1])
    reply("ready")
    for line in sys.stdin:
        command, *arguments = json.loads(line)
        try:
            answer = getattr(peer, command)(*arguments)
        except Exception as error:
            answer = {"error": repr(error)}
        reply(answer)


if __name__ == "__main__":
    main()
