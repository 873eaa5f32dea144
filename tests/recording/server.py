"""A machine that speaks OPC UA, for tests: axis positions and currents whose values are counters, so that losses count.

Each tick writes the tick's number, and 1 000 000 more for each further channel, with one source timestamp to all nodes, and
a line `number,nanoseconds` to the truth file before that. Started again with the same truth file, it counts on.

    python tests/record/server.py --port 4840 --truth truth.csv [--rate 50] [--channels 4] [--history none|memory|FILE]
"""

import argparse
import asyncio
import contextlib
import logging
import signal
from datetime import UTC, datetime, timedelta
from pathlib import Path

from asyncua import Server, ua
from asyncua.crypto.cert_gen import setup_self_signed_certificate
from asyncua.crypto.permission_rules import User, UserRole
from asyncua.server.history_sql import HistorySQLite
from cryptography.x509.oid import ExtendedKeyUsageOID

EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
STEP = 1_000_000


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser()
    parser.add_argument("--port", type=int, required=True)
    parser.add_argument("--truth", type=Path, required=True)
    parser.add_argument("--rate", type=float, default=50.0)
    parser.add_argument("--channels", type=int, default=4)
    parser.add_argument("--history", default="none")
    parser.add_argument("--keys", type=Path, help="folder for the keys of server and recorder: encrypted, with a user")
    return parser.parse_args()


async def made(options: argparse.Namespace) -> tuple[Server, list[ua.NodeId]]:
    server = Server(user_manager=Gate() if options.keys else None)
    await server.init()
    server.set_endpoint(f"opc.tcp://127.0.0.1:{options.port}/machine")
    server.set_security_policy([ua.SecurityPolicyType.NoSecurity])
    if options.keys:
        await encrypted(server, options.keys)
    index = await server.register_namespace("urn:elastogeo:test")
    if options.history not in ("none", "memory"):
        server.iserver.history_manager.set_storage(HistorySQLite(options.history))
        await server.iserver.history_manager.init()
    machine = await server.nodes.objects.add_object(ua.NodeId("Machine", index), "Machine")
    nodes = []
    for channel in range(options.channels):
        name = f"Axis{channel}.{'Current' if channel % 2 else 'Position'}"
        nodes.append(
            await machine.add_variable(ua.NodeId(1000 + channel, index), name, ua.Variant(-1.0, ua.VariantType.Double))
        )
    words = await machine.add_variable(ua.NodeId("Words", index), "Words", "no number")
    assert words
    return server, [node.nodeid for node in nodes]


class Gate:
    """Lets in the user metrology with the password of the tests, nobody else."""

    def get_user(self, _server, username=None, password=None, certificate=None):  # noqa: ARG002
        return User(role=UserRole.User) if (username, password) == ("metrology", "a password of tests") else None


async def encrypted(server: Server, keys: Path) -> None:
    """Make keys for the server and for a recorder, and ask for an encrypted channel."""
    await server.set_application_uri("urn:elastogeo:test:server")
    for name, use in (("server", ExtendedKeyUsageOID.SERVER_AUTH), ("recorder", ExtendedKeyUsageOID.CLIENT_AUTH)):
        pair = keys / f"{name}.pem", keys / f"{name}.der"
        await setup_self_signed_certificate(*pair, f"urn:elastogeo:test:{name}", "localhost", [use], {})
    await server.load_certificate(keys / "server.der")
    await server.load_private_key(keys / "server.pem")
    server.set_security_policy([ua.SecurityPolicyType.Basic256Sha256_SignAndEncrypt])


def counted(truth: Path) -> int:
    if not truth.exists():
        return 0
    return len(truth.read_text().splitlines())


async def main() -> None:
    logging.disable(logging.CRITICAL)
    options = arguments()
    server, nodes = await made(options)
    stop = asyncio.Event()
    asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, stop.set)
    number = counted(options.truth)
    with open(options.truth, "a", encoding="ascii") as truth:
        last = 0

        async def tick() -> None:
            nonlocal number, last
            now = (datetime.now(UTC) - EPOCH) // timedelta(microseconds=1)
            last = max(now, last + 1)
            time = EPOCH + timedelta(microseconds=last)
            truth.write(f"{number},{last * 1000}\n")
            truth.flush()
            for channel, node in enumerate(nodes):
                value = ua.Variant(float(number + channel * STEP), ua.VariantType.Double)
                await server.write_attribute_value(node, ua.DataValue(value, SourceTimestamp=time, ServerTimestamp=time))
            number += 1

        await tick()
        if options.history != "none":
            for node in nodes:
                await server.historize_node_data_change(server.get_node(node), period=None, count=0)
        async with server:
            print("ready", flush=True)
            while not stop.is_set():
                await tick()
                with contextlib.suppress(TimeoutError):
                    await asyncio.wait_for(stop.wait(), 1 / options.rate)


if __name__ == "__main__":
    asyncio.run(main())
