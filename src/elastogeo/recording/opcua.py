"""One connection to an OPC UA server: a client that is used once, one subscription, and the history behind it.

Facts of the protocol: OPC 10000-4 (5.13.1.5 queues and their overflow, 7.38.1 the bits of a status, 5.14.5 numbered
notifications) and OPC 10000-11 (6.5.3 raw history). An asyncua client that has lost its connection may hang when it connects
again (FreeOpcUa/opcua-asyncio issue 1660), so each connection has a new one.
"""

from __future__ import annotations

import asyncio
import importlib
import logging
import math
import os
from collections import Counter
from collections.abc import Awaitable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol

from elastogeo.errors import InputError
from elastogeo.recording.settings import RecordingPlan

KEY_PASSWORD = "ELASTOGEO_OPCUA_KEY_PASSWORD"
PAGE = 5000

_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
_INFO_TYPE, _INFO_DATA_VALUE, _OVERFLOW = 0xC00, 0x400, 0x80
_LIFE = 60.0
"""Seconds that the server shall keep a subscription nobody asks for."""
_NO_HISTORY = (
    "BadHistoryOperationUnsupported",
    "BadHistoryOperationInvalid",
    "BadServiceUnsupported",
    "BadNotSupported",
    "BadNotReadable",
    "BadUserAccessDenied",
)


class ServerError(InputError):
    """The server did not answer, or not as asked."""


class NoHistoryError(InputError):
    """The server keeps no history of a node."""


@dataclass(frozen=True, slots=True)
class Sample:
    """One value as the server sent it: number of its channel, time [ns since 1970, UTC], value or NaN, status."""

    channel: int
    time: int
    value: float
    status: int

    @property
    def after_overflow(self) -> bool:
        """Whether the server says that it threw away samples before this one."""
        return self.status & _INFO_TYPE == _INFO_DATA_VALUE and bool(self.status & _OVERFLOW)


class Receiver(Protocol):
    """Who takes what a connection brings. Nothing of it may wait."""

    def receive(self, samples: Sequence[Sample], full: frozenset[int]) -> None:
        """Take samples in their order; the queue of the channels in `full` was full at the server."""

    def server_started(self, time: int | None) -> None:
        """Note when the server was started [ns since 1970, UTC]; None if it does not say so."""

    def lose(self, cause: str) -> None:
        """Note that samples of every channel may be missing from here on."""

    def note(self, sentence: str) -> None:
        """Note what the user must know, once."""


class Connection:
    """A connection, for one use: `open`, then wait for `lost`, then `close`.

    Parameters
    ----------
    plan : RecordingPlan
    password : str
        Of the plan's user.
    receiver : Receiver
    """

    def __init__(self, plan: RecordingPlan, password: str, receiver: Receiver) -> None:
        self._plan, self._receiver = plan, receiver
        self._asyncua, self._ua = _modules()
        self._nodes = [self._node(channel.node) for channel in plan.channel]
        self._client = self._asyncua.Client(plan.server, timeout=plan.timeout, watchdog_intervall=plan.timeout)
        self._client.connection_lost_callback = self._on_lost
        if plan.user:
            self._client.set_user(plan.user)
            self._client.set_password(password)
        self._queues: dict[int, int] = {}
        self._sequence: int | None = None
        self._heard = 0.0
        self._silence = plan.timeout
        self._watch: asyncio.Task[None] | None = None
        self.lost: asyncio.Future[str] = asyncio.get_running_loop().create_future()

    async def open(self) -> None:
        """Connect and subscribe.

        Raises
        ------
        ServerError
            If the server cannot be reached, refuses, or does not have one of the nodes.
        """
        if self._plan.security:
            await self._secure()
        await _answer(self._client.connect(), 3 * self._plan.timeout, f"{self._plan.server} cannot be reached")
        await self._check_values()
        self._receiver.server_started(await self._started())
        await self._subscribe()
        self._heard = asyncio.get_running_loop().time()
        self._watch = asyncio.create_task(self._listen())

    async def close(self) -> None:
        """Take leave of the server, if it is still there; never fails."""
        if self._watch is not None:
            self._watch.cancel()
        leaving = asyncio.ensure_future(self._client.disconnect())
        await asyncio.wait({leaving}, timeout=self._plan.timeout)
        if not leaving.done():
            leaving.cancel()
        elif not leaving.cancelled():
            leaving.exception()
        self._client.disconnect_socket()

    async def history(self, channel: int, start: int, end: int) -> tuple[list[Sample], bool]:
        """The raw history of a channel.

        Parameters
        ----------
        channel : int
        start, end : int [ns since 1970, UTC]
            Both included.

        Returns
        -------
        list of Sample, bool
            In the server's order; and whether that is all, rather than the first page of at least `PAGE`.

        Raises
        ------
        NoHistoryError
            If the server keeps none of this node.
        ServerError
            If it does not answer.
        """
        ua = self._ua
        details = ua.ReadRawModifiedDetails()
        details.IsReadModified, details.ReturnBounds = False, False
        details.StartTime, details.EndTime = _datetime(start), _datetime(end + 1000)
        details.NumValuesPerNode = PAGE
        wanted = ua.HistoryReadValueId()
        wanted.NodeId = self._nodes[channel]
        samples: list[Sample] = []
        while True:
            request = ua.HistoryReadParameters()
            request.HistoryReadDetails = details
            request.TimestampsToReturn = ua.TimestampsToReturn.Both
            request.ReleaseContinuationPoints = False
            request.NodesToRead = [wanted]
            name = self._plan.channel[channel].name
            answer = await _answer(
                self._client.uaclient.history_read(request), 4 * self._plan.timeout, f"no history of {name!r}"
            )
            status = answer[0].StatusCode
            if status.name in _NO_HISTORY:
                raise NoHistoryError(f"the server gives no history of {name!r} ({status.name})")
            if status.is_bad():
                raise ServerError(f"no history of {name!r} ({status.name})")
            values = getattr(answer[0].HistoryData, "DataValues", None) or []
            page = [self._sample(channel, value) for value in values]
            samples += [one for one in page if start <= one.time <= end]
            wanted.ContinuationPoint = answer[0].ContinuationPoint
            if not wanted.ContinuationPoint:
                return samples, len(page) < PAGE
            if len(samples) >= PAGE or not page:
                request.ReleaseContinuationPoints = True
                await _answer(self._client.uaclient.history_read(request), 4 * self._plan.timeout, f"no history of {name!r}")
                return samples, False

    def _node(self, text: str) -> Any:
        try:
            return self._ua.NodeId.from_string(text)
        except (self._ua.UaError, ValueError, TypeError) as error:
            raise InputError(f"{text!r} is no node ({error}); write it as ns=2;s=Axis.X.Current or ns=2;i=1001") from None

    async def _secure(self) -> None:
        security = self._plan.security
        parts = security.split(",")
        password = os.environ.get(KEY_PASSWORD)
        if password:
            parts[3] += f"::{password}"
        self._client.application_uri = _application_uri(Path(parts[2])) or self._client.application_uri
        await _answer(
            self._client.set_security_string(",".join(parts)), 3 * self._plan.timeout, "the connection cannot be secured"
        )

    async def _check_values(self) -> None:
        """Refuse nodes that are not there, or hold no single number."""
        read = self._client.uaclient.read_attributes(self._nodes, self._ua.AttributeIds.Value)
        values = await _answer(read, 2 * self._plan.timeout, "the nodes cannot be read")
        problems = []
        for channel, value in zip(self._plan.channel, values, strict=True):
            status = value.StatusCode
            content = value.Value.Value if value.Value is not None else None
            if status.name in ("BadNodeIdUnknown", "BadNodeIdInvalid", "BadAttributeIdInvalid", "BadUserAccessDenied"):
                problems.append(f"channel {channel.name!r}: node {channel.node!r} cannot be read ({status.name})")
            elif content is not None and not isinstance(content, bool | int | float):
                kind = type(content).__name__
                problems.append(f"channel {channel.name!r}: node {channel.node!r} holds a {kind}, not a single number")
        if problems:
            raise ServerError(f"{self._plan.server}: {'; '.join(problems)}. Correct the nodes, or leave them out")

    async def _started(self) -> int | None:
        """When the server was started [ns since 1970, UTC], if it says so."""
        node = self._ua.NodeId(self._ua.ObjectIds.Server_ServerStatus_StartTime)
        read = self._client.uaclient.read_attributes([node], self._ua.AttributeIds.Value)
        value = (await _answer(read, 2 * self._plan.timeout, "the server does not say when it was started"))[0].Value
        return _nanoseconds(value.Value) if value is not None and isinstance(value.Value, datetime) else None

    async def _subscribe(self) -> None:
        ua, plan = self._ua, self._plan
        parameters = ua.CreateSubscriptionParameters()
        parameters.RequestedPublishingInterval = plan.publishing * 1000
        parameters.RequestedMaxKeepAliveCount = max(1, int(plan.timeout / plan.publishing / 2))
        parameters.RequestedLifetimeCount = max(3 * parameters.RequestedMaxKeepAliveCount, int(_LIFE / plan.publishing))
        parameters.MaxNotificationsPerPublish = 0
        parameters.PublishingEnabled = True
        refused = f"{plan.server} makes no subscription"
        made = await _answer(
            self._client.uaclient.create_subscription(parameters, self._published), plan.timeout * 2, refused
        )
        self._silence = 2 * made.RevisedPublishingInterval / 1000 * made.RevisedMaxKeepAliveCount + plan.timeout
        results = await self._monitor(made.SubscriptionId, ua.DataChangeTrigger.StatusValueTimestamp)
        filters = ("BadMonitoredItemFilterUnsupported", "BadFilterNotAllowed", "BadMonitoredItemFilterInvalid")
        if any(result.StatusCode.name in filters for result in results):
            self._receiver.note("The server sends a sample only when its value or status has changed.")
            results = await self._monitor(made.SubscriptionId, None)
        problems = []
        for index, (channel, result) in enumerate(zip(plan.channel, results, strict=True)):
            if not result.StatusCode.is_good():
                problems.append(f"channel {channel.name!r}: node {channel.node!r} is refused ({result.StatusCode.name})")
                continue
            self._queues[index] = int(result.RevisedQueueSize)
            self._say_revised(channel.name, result)
        if problems:
            raise ServerError(f"{plan.server}: {'; '.join(problems)}. Correct the nodes, or leave them out")

    async def _monitor(self, subscription: int, trigger: Any) -> Any:
        """Ask for the nodes, and every sample of theirs rather than changes only if there is a trigger."""
        ua = self._ua
        items = []
        for index, node in enumerate(self._nodes):
            item = ua.MonitoredItemCreateRequest()
            item.ItemToMonitor.NodeId = node
            item.ItemToMonitor.AttributeId = ua.AttributeIds.Value
            item.MonitoringMode = ua.MonitoringMode.Reporting
            item.RequestedParameters.ClientHandle = index
            item.RequestedParameters.SamplingInterval = self._plan.sampling * 1000
            item.RequestedParameters.QueueSize = self._plan.queue_size
            item.RequestedParameters.DiscardOldest = True
            if trigger is not None:
                item.RequestedParameters.Filter = ua.DataChangeFilter(Trigger=trigger)
            items.append(item)
        request = ua.CreateMonitoredItemsParameters()
        request.SubscriptionId = subscription
        request.TimestampsToReturn = ua.TimestampsToReturn.Both
        request.ItemsToCreate = items
        monitor = self._client.uaclient.create_monitored_items(request)
        return await _answer(monitor, 2 * self._plan.timeout, f"{self._plan.server} does not sample")

    def _say_revised(self, name: str, result: Any) -> None:
        asked, given = self._plan.sampling, result.RevisedSamplingInterval / 1000
        if asked and given > 1.01 * asked:
            self._receiver.note(f"{name!r}: sampled every {given:g} s at the most, says the server, {asked:g} s were asked.")
        if result.RevisedQueueSize <= 1:
            self._receiver.note(f"{name!r}: the server keeps no queue; what it samples between two messages is not sent.")

    async def _published(self, result: Any) -> None:
        """Take one message of the subscription; one without data says that the server lives."""
        self._heard = asyncio.get_running_loop().time()
        message = result.NotificationMessage
        number = int(message.SequenceNumber)
        if not message.NotificationData or not number:  # asyncua makes a message 0 of its own when a connection is lost
            return
        if self._sequence is not None and number != self._sequence % 0xFFFFFFFF + 1:
            self._receiver.lose("a message of the server did not arrive")
        self._sequence = number
        for notification in message.NotificationData:
            if isinstance(notification, self._ua.DataChangeNotification):
                items = notification.MonitoredItems
                samples = [self._sample(int(item.ClientHandle), item.Value) for item in items]
                counts = Counter(sample.channel for sample in samples)
                full = frozenset(k for k, count in counts.items() if 1 < self._queues.get(k, 0) <= count)
                self._receiver.receive(samples, full)
            elif isinstance(notification, self._ua.StatusChangeNotification):
                self._fail(f"the server ended the subscription ({_status(notification.Status)})")

    def _sample(self, channel: int, value: Any) -> Sample:
        time = value.SourceTimestamp
        if time is None:
            name = self._plan.channel[channel].name
            whose = "server's" if value.ServerTimestamp is not None else "recorder's"
            self._receiver.note(f"{name!r}: has samples without a time of their source; the {whose} is kept.")
            time = value.ServerTimestamp if value.ServerTimestamp is not None else datetime.now(UTC)
        content = value.Value.Value if value.Value is not None else None
        number = float(content) if isinstance(content, bool | int | float) else math.nan
        status = value.StatusCode.value if value.StatusCode is not None else 0
        return Sample(channel, _nanoseconds(time), number, int(status) & 0xFFFFFFFF)

    async def _on_lost(self, error: Exception) -> None:
        self._fail(f"the connection was lost ({_reason(error)})")

    def _fail(self, cause: str) -> None:
        if not self.lost.done():
            self.lost.set_result(cause)

    async def _listen(self) -> None:
        """Take a server for dead that neither sends samples nor says that there are none."""
        while not self.lost.done():
            await asyncio.sleep(min(1.0, self._silence / 4))
            if asyncio.get_running_loop().time() - self._heard > self._silence:
                self._fail(f"the server was silent for {self._silence:.1f} s")


async def _answer(request: Awaitable[Any], seconds: float, otherwise: str) -> Any:
    """What a request brings; whatever goes wrong with it is a `ServerError` that begins with `otherwise`.

    asyncua cancels requests whose connection is lost, so the request is a task of its own: its cancellation is not ours.
    """
    task = asyncio.ensure_future(request)
    try:
        await asyncio.wait({task}, timeout=seconds)
    finally:
        late = not task.done()
        if late:
            task.cancel()
    if late:
        raise ServerError(f"{otherwise}: no answer within {seconds:g} s; check the address and the network")
    if task.cancelled():
        raise ServerError(f"{otherwise}: the connection was lost")
    error = task.exception()
    if error is not None:
        raise ServerError(f"{otherwise} ({_reason(error)}); check the address, the user and the network") from error
    return task.result()


def _reason(error: BaseException) -> str:
    text = str(error).strip().splitlines()
    return text[0][:200] if text and text[0] else type(error).__name__


def _status(code: Any) -> str:
    return str(getattr(code, "name", code))


def _nanoseconds(time: datetime) -> int:
    """A time of asyncua [ns since 1970]: it gives microseconds of the 100 ns that the protocol has, in UTC."""
    since = (time if time.tzinfo else time.replace(tzinfo=UTC)) - _EPOCH
    return ((since.days * 86_400 + since.seconds) * 1_000_000 + since.microseconds) * 1000


def _datetime(time: int) -> datetime:
    return _EPOCH + timedelta(microseconds=time // 1000)


def _application_uri(certificate: Path) -> str:
    """The name of the application that a certificate was made for; a server compares it with what the client says it is."""
    x509 = importlib.import_module("cryptography.x509")
    try:
        data = certificate.read_bytes()
        load = x509.load_pem_x509_certificate if data.startswith(b"-----") else x509.load_der_x509_certificate
        names = load(data).extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    except OSError as error:
        raise InputError(f"{certificate}: the certificate cannot be opened ({error.strerror}); check the path") from None
    except (ValueError, x509.ExtensionNotFound):
        return ""
    return next(iter(names.get_values_for_type(x509.UniformResourceIdentifier)), "")


def _modules() -> tuple[ModuleType, ModuleType]:
    try:
        asyncua, ua = importlib.import_module("asyncua"), importlib.import_module("asyncua.ua")
    except ImportError:
        raise InputError("recording from OPC UA needs asyncua: pip install 'elastogeo[live]'") from None
    logging.getLogger("asyncua").addHandler(logging.NullHandler())
    return asyncua, ua
