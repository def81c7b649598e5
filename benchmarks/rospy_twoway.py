"""Round trips of plain rospy: a string there and back by topics, and a persistent service.

    PYTHON rospy_twoway.py serve NAME        until its input ends
    PYTHON rospy_twoway.py call NAME CALLS   for each line `topic` or `service`: the median in us

Run by a Python that has rospy: Debian's, with `ros-base`. No import of this project.
"""

from __future__ import annotations

import sys
import threading
from statistics import median
from time import perf_counter_ns, sleep

import rospy
from std_msgs.msg import String
from std_srvs.srv import SetBool, SetBoolResponse

TEXT = "x" * 80


def serve(name: str) -> None:
    """An echo and a service, until the input ends."""
    rospy.init_node(f"{name}_server", disable_signals=True)
    back = rospy.Publisher(f"/{name}/back", String, queue_size=10, tcp_nodelay=True)
    rospy.Subscriber(f"/{name}/there", String, back.publish, tcp_nodelay=True)
    rospy.Service(f"/{name}/set", SetBool, lambda request: SetBoolResponse(request.data, TEXT))
    print("ready", flush=True)
    sys.stdin.read()


def call(name: str, calls: int) -> None:
    """One round for each line of the input."""
    rospy.init_node(f"{name}_client", disable_signals=True)
    bell = threading.Semaphore(0)
    rospy.Subscriber(f"/{name}/back", String, lambda _: bell.release(), tcp_nodelay=True)
    there = rospy.Publisher(f"/{name}/there", String, queue_size=None, tcp_nodelay=True)
    rospy.wait_for_service(f"/{name}/set")
    proxy = rospy.ServiceProxy(f"/{name}/set", SetBool, persistent=True)
    message = String(TEXT)

    def by_topic() -> None:
        there.publish(message)
        bell.acquire(timeout=5)

    while not there.get_num_connections():
        sleep(0.01)
    while True:  # until the connection back is open, too
        there.publish(message)
        if bell.acquire(timeout=0.5):
            break
    each = {"topic": by_topic, "service": lambda: proxy(True)}
    print("ready", flush=True)
    for line in sys.stdin:
        took = []
        for _ in range(calls):
            start = perf_counter_ns()
            each[line.strip()]()
            took.append(perf_counter_ns() - start)
        print(median(took) / 1000, flush=True)


if __name__ == "__main__":
    if sys.argv[1] == "serve":
        serve(sys.argv[2])
    else:
        call(sys.argv[2], int(sys.argv[3]))
