"""A ROS 2 node on rclpy, which knows nothing of this project; see `peer_process`."""

import json
import sys
import threading

import rclpy
from peer_program import run
from rcl_interfaces.srv import GetParameters, ListParameters, SetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter, parameter_value_to_python
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from std_srvs.srv import SetBool

TIMEOUT_S = 60.0
RETRY_S = 5.0
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Peer:
    def __init__(self, domain_id: int) -> None:
        rclpy.init(args=[], domain_id=domain_id)
        self.node = rclpy.create_node("peer")
        self.messages = {}
        self.publishers = {}
        out = self.node.create_publisher(String, "/peer/out", 10)
        self.node.create_subscription(String, "/peer/in", out.publish, 10)
        scans = self.node.create_publisher(LaserScan, "/peer/scan_out", 10)
        self.node.create_subscription(LaserScan, "/peer/scan_in", scans.publish, 10)
        self.map = self.node.create_publisher(String, "/peer/map", LATCHED)
        self.map.publish(String(data="latched by rclpy"))
        self.node.create_service(SetBool, "/peer/set", self.set)
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        threading.Thread(target=self.executor.spin, daemon=True).start()

    def set(self, request, response):
        response.success, response.message = request.data, "rclpy"
        return response

    def call(self, name):
        client = self.node.create_client(SetBool, name)
        assert client.wait_for_service(TIMEOUT_S)
        reply = self.reply(client, SetBool.Request(data=True))
        return [reply.success, reply.message]

    def reply(self, client, request):
        done = threading.Event()
        while not done.is_set():  # the server may not have discovered the client yet
            future = client.call_async(request)
            future.add_done_callback(lambda _: done.set())
            done.wait(RETRY_S)
        return future.result()

    def ask_parameters(self, node, service, type_, request):
        client = self.node.create_client(type_, f"{node}/{service}")
        assert client.wait_for_service(TIMEOUT_S)
        return self.reply(client, request)

    def parameters(self, node):
        reply = self.ask_parameters(
            node, "list_parameters", ListParameters, ListParameters.Request()
        )
        return list(reply.result.names)

    def parameter(self, node, name):
        request = GetParameters.Request(names=[name])
        reply = self.ask_parameters(node, "get_parameters", GetParameters, request)
        return parameter_value_to_python(reply.values[0])

    def set_parameter(self, node, name, text):
        parameter = Parameter(name, value=json.loads(text)).to_parameter_msg()
        request = SetParameters.Request(parameters=[parameter])
        reply = self.ask_parameters(node, "set_parameters", SetParameters, request)
        return [reply.results[0].successful, reply.results[0].reason]

    def received(self, topic):
        return self.messages[topic]

    def subscribe(self, topic, latched=""):
        messages = self.messages[topic] = []
        qos = LATCHED if latched else QoSProfile(depth=10)
        self.node.create_subscription(String, topic, lambda m: messages.append(m.data), qos)

    def publisher(self, topic):
        if topic not in self.publishers:
            self.publishers[topic] = self.node.create_publisher(String, topic, 10)
        return self.publishers[topic]

    def raw(self, topic, data):
        self.publisher(topic).publish(bytes.fromhex(data))

    def publish(self, topic, *words):
        self.publisher(topic).publish(String(data=" ".join(words)))

    def subscribers(self, topic):
        return self.publisher(topic).get_subscription_count()


if __name__ == "__main__":
    run(Peer(int(sys.argv[1])))
