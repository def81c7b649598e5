"""The topic or service of each operation of a port: its name and type in ROS."""

from __future__ import annotations

from robocomp_dsl.runtime.component.interface import Interface, Operation
from robocomp_dsl.runtime.data.ros_type_hash import message_hash, service_hash
from robocomp_dsl.runtime.middleware.rmw_zenoh.wire import TopicInfo
from robocomp_dsl.runtime.middleware.ros_common.interface_types import service_type, topic_type
from robocomp_dsl.runtime.middleware.ros_common.names import operation_name


def topic_info(name: str, interface: Interface, operation: Operation) -> TopicInfo:
    """The topic of a publication or command; `name` is that of the port."""
    topic = topic_type(operation)
    return TopicInfo(
        operation_name(name, interface, operation), topic.type_id, message_hash(topic.struct)
    )


def service_info(name: str, interface: Interface, operation: Operation) -> TopicInfo:
    """The service of a query; `name` is that of the port."""
    type_ = service_type(operation)
    return TopicInfo(
        operation_name(name, interface, operation),
        type_.type_id,
        service_hash(type_.request, type_.response),
    )
