"""A peer on zenoh-ros2-sdk, another implementation of rmw_zenoh; see `peer_process`."""

import logging
import sys

from peer_program import run
from zenoh_ros2_sdk import (
    ROS2Publisher,
    ROS2ServiceClient,
    ROS2ServiceServer,
    ROS2Subscriber,
)
from zenoh_ros2_sdk.qos import QosDurability, QosProfile

STRING = {"msg_type": "std_msgs/msg/String", "msg_definition": "string data\n"}
SET_BOOL = {
    "srv_type": "std_srvs/srv/SetBool",
    "request_definition": "bool data\n",
    "response_definition": "bool success\nstring message\n",
}
LATCHED = QosProfile(durability=QosDurability.TRANSIENT_LOCAL, history_depth=1)


class Peer:
    def __init__(self, domain_id: int, port: int) -> None:
        self.at = {"domain_id": domain_id, "router_port": port}
        self.messages = {}
        self.publishers = {}
        out = self.publisher("/peer/out")
        self.echo = ROS2Subscriber(
            "/peer/in", callback=lambda m: out.publish(data=m.data), **STRING, **self.at
        )
        self.server = ROS2ServiceServer("/peer/set", callback=self.set, **SET_BOOL, **self.at)
        self.clients = []

    def set(self, request):
        return self.server.response_msg_class(success=request.data, message="sdk")

    def call(self, name):
        client = ROS2ServiceClient(name, **SET_BOOL, **self.at)
        self.clients.append(client)
        response = client.call(data=True)
        return response and [bool(response.success), response.message]

    def received(self, topic):
        return self.messages[topic]

    def subscribe(self, topic, latched=""):
        messages = self.messages[topic] = []
        qos = LATCHED if latched else None
        subscriber = ROS2Subscriber(
            topic, callback=lambda m: messages.append(m.data), qos=qos, **STRING, **self.at
        )
        self.clients.append(subscriber)

    def publisher(self, topic):
        if topic not in self.publishers:
            self.publishers[topic] = ROS2Publisher(topic, **STRING, **self.at)
        return self.publishers[topic]

    def raw(self, topic, data):
        self.publisher(topic).pub.put(bytes.fromhex(data))

    def publish(self, topic, *words):
        self.publisher(topic).publish(data=" ".join(words))

    def subscribers(self, topic):
        return int(self.publisher(topic).pub.matching_status.matching)


if __name__ == "__main__":
    logging.disable(logging.WARNING)
    run(Peer(int(sys.argv[1]), int(sys.argv[2])))
