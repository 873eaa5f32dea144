from pathlib import Path

import pytest

from elastogeo.errors import FormatError, InputError
from elastogeo.recording import RecordedNode, RecordingPlan, named_nodes, planned, read_plan

ONE = (RecordedNode("i", "ns=2;s=I", "A"),)


@pytest.mark.parametrize(
    ("text", "node"),
    [
        ("ns=2;s=Axis.X", RecordedNode("ns=2;s=Axis.X", "ns=2;s=Axis.X")),
        ("i=2258", RecordedNode("i=2258", "i=2258")),
        ("x position=ns=2;s=Axis[1].X=1", RecordedNode("x position", "ns=2;s=Axis[1].X=1")),
        ("current_x [A]=ns=3;i=77", RecordedNode("current_x", "ns=3;i=77", "A")),
    ],
)
def test_nodes_of_the_command_line(text, node):
    assert named_nodes([text]) == (node,)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("X", "'X' is no node; write it as ns=2;s="),
        ("x=Axis.X", "channel 'x': 'Axis.X' is no node"),
        ("x[volts]=ns=2;s=X", "the unit 'volts' is not known; use .*V"),
        (" =ns=2;s=X", "has no name"),
    ],
)
def test_nodes_that_will_not_do(text, message):
    with pytest.raises(InputError, match=message):
        named_nodes([text])


@pytest.mark.parametrize(
    ("server", "message"),
    [
        ("http://m:4840", "'http://m:4840' is no address of an OPC UA server"),
        ("opc.tcp://", "is no address"),
        ("opc.tcp://m:99999", "is no address"),
        ("opc.tcp://me:secret@m:4840", "holds a user or a password"),
        ("http://me:secret@m", "'m' is no address"),
    ],
)
def test_addresses_that_will_not_do_are_refused_without_their_password(server, message):
    with pytest.raises(InputError, match=message) as refused:
        RecordingPlan(server, ONE)
    assert "secret" not in str(refused.value)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"channel": ()}, "no node is named"),
        ({"channel": ONE + ONE}, "channel 'i' is named twice"),
        ({"channel": (*ONE, RecordedNode("j", "ns=2;s=I"))}, "node 'ns=2;s=I' is named twice"),
        ({"sampling": -1.0}, "the sampling interval is -1 s"),
        ({"batch": float("nan")}, "batch is nan s"),
        ({"publishing": 0.0}, "publishing is 0 s"),
        ({"backlog": 1}, "a backlog of 1 samples does not work"),
        ({"security": "Basic256Sha256,SignAndEncrypt,c.der,k.pem::secret"}, "put it in ELASTOGEO_OPCUA_KEY_PASSWORD"),
        ({"security": "Basic256Sha256"}, "is not Policy,Mode,certificate,key"),
    ],
)
def test_plans_that_will_not_do(changes, message):
    with pytest.raises(InputError, match=message):
        RecordingPlan(**{"server": "opc.tcp://m", "channel": ONE, **changes})


def test_the_queue_holds_ten_seconds_unless_it_is_given():
    assert RecordingPlan("opc.tcp://m", ONE, sampling=0.02).queue_size == 500
    assert RecordingPlan("opc.tcp://m", ONE, sampling=1.0).queue_size == 100
    assert RecordingPlan("opc.tcp://m", ONE, sampling=0.0).queue_size == 10_000
    assert RecordingPlan("opc.tcp://m", ONE, queue=7).queue_size == 7


def test_a_recording_file(tmp_path: Path):
    path = tmp_path / "recording.toml"
    path.write_text(
        'server = "opc.tcp://m:4840"\nsampling_ms = 20\nbatch_s = 2\nuser = "me"\n'
        '[[channel]]\nname = "current_x"\nnode = "ns=2;s=I"\nunit = "A"\n[[channel]]\nname = "b"\nnode = "i=7"\n'
    )
    channels = (RecordedNode("current_x", "ns=2;s=I", "A"), RecordedNode("b", "i=7"))
    plan = RecordingPlan("opc.tcp://m:4840", channels, sampling=0.02, batch=2.0, user="me")
    assert read_plan(path) == plan
    assert planned(str(path), batch=1.0, user=None).batch == 1.0
    assert planned(str(path), ["i=9"]).channel == (RecordedNode("i=9", "i=9"),)
    path.write_text(path.read_text() + 'password = "x"\nunits = "A"\n')
    with pytest.raises(FormatError, match="password is not known"):
        read_plan(path)
