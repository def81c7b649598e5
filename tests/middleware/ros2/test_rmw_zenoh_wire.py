"""Keys, tokens and attachments, as a ROS 2 node on rmw_zenoh_cpp writes them."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.middleware.rmw_zenoh.operations import service_info, topic_info
from robocomp_dsl.runtime.middleware.rmw_zenoh.wire import (
    NodeInfo,
    RemoteEndpoint,
    TopicInfo,
    attachment,
    gid_of,
    parse_attachment,
    parse_endpoint,
    qos_text,
)
from tests.middleware.ros2.ros_messages import CHAT, SWITCH

STRING_HASH = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
SET_BOOL_HASH = "RIHS01_abe9e4bb6b41b40e6789712c00ec8871923e089af3f667a79992a428cff2da0a"
NODE = NodeInfo(0, "a12ed016", 1, "/", "listener")


def test_topic_info_has_the_key_of_ros() -> None:
    info = topic_info("/pong", CHAT, CHAT.operations[0])
    assert info.key(0) == f"0/pong/std_msgs::msg::dds_::String_/{STRING_HASH}"


def test_service_info_has_the_key_of_ros() -> None:
    info = service_info("/robot/set", SWITCH, SWITCH.operations[0])
    assert info.key(5) == f"5/robot/set/std_srvs::srv::dds_::SetBool_/{SET_BOOL_HASH}"


def test_node_info_has_the_token_of_ros() -> None:
    assert NODE.token() == "@ros2_lv/0/a12ed016/1/1/NN/%/%/listener"
    inner = NodeInfo(3, "a1", 0, "/left/arm", "driver")
    assert inner.token() == "@ros2_lv/3/a1/0/0/NN/%/%left%arm/driver"


def test_endpoint_token_is_that_of_ros_and_is_parsed() -> None:
    info = TopicInfo("/ping", "std_msgs/msg/String", STRING_HASH)
    token = NODE.endpoint_token(4, "MS", info, "::,10:,:,:,,")
    assert token == (
        "@ros2_lv/0/a12ed016/1/4/MS/%/%/listener/%ping/std_msgs::msg::dds_::String_/"
        f"{STRING_HASH}/::,10:,:,:,,"
    )
    assert parse_endpoint(token) == RemoteEndpoint("MS", "/listener", info)


@pytest.mark.parametrize(
    "token",
    ["", "@ros2_lv", NODE.token(), "@ros2_lv/0/1/2/3/MS/%/%/x", "a/b/c/d/e/f/g/h/i/j/k/l/m"],
)
def test_parse_endpoint_ignores_other_tokens(token: str) -> None:
    assert parse_endpoint(token) is None


@pytest.mark.parametrize(
    ("qos", "text"),
    [
        (Qos(), "1:2:1,10:,:,:,,"),
        (Qos(reliable=False, depth=1), "2:2:1,1:,:,:,,"),
        (Qos(latched=True, keep_all=True, depth=7), "1:1:2,7:,:,:,,"),
        (Qos(deadline=1.5), "1:2:1,10:1,500000000:,:,,"),
    ],
)
def test_qos_text_has_the_numbers_of_rmw(qos: Qos, text: str) -> None:
    assert qos_text(qos) == text


def test_attachment_has_the_bytes_of_ros() -> None:
    gid = bytes.fromhex("2ce89364b73c4f34b7928b1dc9cfa78e")
    data = attachment(199, 0x18E9EE2294C6C200, gid)
    assert data.hex() == "c70000000000000000c2c69422eee9181" + "0" + gid.hex()
    assert parse_attachment(data) == (199, 0x18E9EE2294C6C200, gid)


@pytest.mark.parametrize("data", [b"", bytes(16), bytes(33), bytes(34)])
def test_parse_attachment_rejects_other_bytes(data: bytes) -> None:
    with pytest.raises(MalformedMessage, match=f"an attachment of {len(data)} bytes"):
        parse_attachment(data)


def test_gid_of_tokens_are_16_bytes_that_differ() -> None:
    assert len(gid_of("a")) == 16
    assert gid_of("a") != gid_of("b")
