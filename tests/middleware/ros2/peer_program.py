"""The command loop of the peer programs; see `peer_process`."""

import json
import sys


def run(peer) -> None:
    """Call a method of `peer` for each line of stdin, and write what it returns as JSON."""

    def reply(value):
        sys.stdout.write(json.dumps(value) + "\n")
        sys.stdout.flush()

    reply("ready")
    for line in sys.stdin:
        name, *arguments = line.split()
        reply(getattr(peer, name)(*arguments))
