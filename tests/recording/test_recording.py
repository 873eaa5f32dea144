"""The whole recorder against an OPC UA server in a process of its own, with cables cut and recorders killed.

The longer versions are marked `nightly`; the longest, with twenty cuts and kills, is `python benchmarks/record_drops.py`.
"""

import random

import pytest


@pytest.mark.parametrize(
    ("history", "rounds"),
    [("memory", 1), *(pytest.param(kept, 2, marks=pytest.mark.nightly) for kept in ("memory", "none"))],
)
def test_nothing_is_missing_but_what_is_marked_whatever_is_cut_or_killed(rig, plugged, tmp_path, history, rounds):
    rng, folder, acknowledged = random.Random(7), tmp_path / "r", {}
    machine, cable = plugged(history)
    for _ in range(rounds):
        recorder = rig.Recorder(cable.port, folder, ("--batch-s", "0.2"))
        recorder.wait_for_parts(2)
        for cut in range(1, rounds + 1):
            cable.whole = rng.random() < 0.5
            cable.cut()
            recorder.wait_for("connecting again", cut)
            cable.whole = True
            recorder.wait_for(", again.", cut)
            recorder.wait_for_parts(rng.randint(1, 3))
        recorder.kill()
        acknowledged |= recorder.acknowledged
    recorder = rig.Recorder(cable.port, folder, ("--batch-s", "0.2"))
    recorder.wait_for_parts(3)
    summary = recorder.stop()
    acknowledged |= recorder.acknowledged
    sent = machine.sent()
    rows = rig.rows_by_part(folder)
    assert {name: rows.get(name) for name in acknowledged} == acknowledged
    counted = rig.count(folder, sent)
    assert counted.sent > 100 * rounds
    assert (counted.missing_unmarked, counted.wrong) == (0, 0), counted
    assert counted.marked == len(summary["gaps"])
    if history == "memory":
        assert (counted.missing, counted.marked) == (0, 0), (counted, summary)
    else:
        assert counted.missing > 0
        assert counted.marked >= 2 * len(rig.NODES)


def test_a_server_that_falls_silent_is_noticed(rig, plugged, tmp_path):
    """Nothing is closed: the bytes only stop, as when a switch loses power."""
    machine, cable = plugged("memory")
    recorder = rig.Recorder(cable.port, tmp_path / "r", plan="timeout_s = 1\nbatch_s = 0.2\npublishing_ms = 100")
    recorder.wait_for_parts(2)
    cable.frozen = True
    recorder.wait_for("connecting again")
    cable.cut()
    cable.frozen = False
    recorder.wait_for(", again.")
    recorder.wait_for_parts(2)
    summary = recorder.stop()
    counted = rig.count(tmp_path / "r", machine.sent())
    assert summary["reconnects"] >= 1
    assert (counted.missing, counted.marked, counted.wrong) == (0, 0, 0), (counted, summary)


@pytest.mark.nightly
def test_what_a_server_lost_when_it_was_restarted_stays_marked(rig, tmp_path):
    """The server is killed, and its history with it; the ticks between its new start and the connection are fetched."""
    folder = tmp_path / "r"
    with rig.rig(tmp_path, "memory") as (machine, cable):
        recorder = rig.Recorder(cable.port, folder, ("--batch-s", "0.2"))
        recorder.wait_for_parts(2)
        cable.whole = False
        cable.cut()
        recorder.wait_for("connecting again")
        lost = len(machine.sent())
        rig.until(lambda: len(machine.sent()) > lost + 30, "30 ticks are missed")
        machine.kill()
        machine.start()
        begun = len(machine.sent())
        rig.until(lambda: len(machine.sent()) > begun + 30, "30 ticks are in the new history")
        cable.whole = True
        recorder.wait_for(", again.")
        recorder.wait_for_parts(2)
        summary = recorder.stop()
        counted = rig.count(folder, machine.sent())
    assert all(channel["filled"] >= 30 for channel in summary["channels"]), summary
    assert counted.missing >= 4 * 30
    assert (counted.missing_unmarked, counted.wrong) == (0, 0)
    assert counted.marked == len(summary["gaps"]) == 4
    doubt = "; the server was restarted meanwhile, what it holds was taken"
    causes = {gap["cause"] for gap in summary["gaps"]}
    assert all(cause.startswith("the connection was lost") and cause.endswith(doubt) for cause in causes), causes


def test_a_recording_ends_by_its_duration_and_is_gone_on_with_when_the_server_is_away(rig, plugged, tmp_path):
    folder = tmp_path / "r"
    machine, cable = plugged()
    recorder = rig.Recorder(cable.port, folder, ("--duration", "1", "--batch-s", "0.3"))
    summary = recorder.summary()
    assert summary["schema"] == "elastogeo.recording/1"
    assert [channel["name"] for channel in summary["channels"]] == list(rig.NODES)
    assert all(channel["samples"] > 0 for channel in summary["channels"])
    assert summary["gaps"] == []
    cable.whole = False
    recorder = rig.Recorder(cable.port, folder, plan="timeout_s = 2\nbatch_s = 0.2")  # it gives a connection up after 6 s
    recorder.wait_for("Trying again in")
    cable.whole = True
    recorder.wait_for_parts(1)
    summary = recorder.stop()
    counted = rig.count(folder, machine.sent())
    assert [gap["cause"] for gap in summary["gaps"]] == ["nothing was recorded in between"] * 4
    assert counted.missing > 0
    assert counted.missing_unmarked == 0


def test_what_cannot_be_recorded_is_refused_at_the_beginning(rig, plugged, tmp_path):
    _, cable = plugged()
    told = rig.Recorder(cable.port, tmp_path / "a", nodes=("Axis9.Current", "Words")).refusal()
    assert "channel 'Axis9.Current': node 'ns=2;s=Axis9.Current' cannot be read (BadNodeIdUnknown)" in told
    assert "node 'ns=2;s=Words' holds a str, not a single number" in told
    told = rig.Recorder(rig.free_port(), tmp_path / "c").refusal()
    assert told.startswith("elastogeo: opc.tcp://127.0.0.1:")
    assert "cannot be reached" in told
    assert "Traceback" not in told


@pytest.mark.parametrize("cut", [False, pytest.param(True, marks=pytest.mark.nightly)])
def test_an_encrypted_channel_and_a_user_whose_password_is_in_the_environment(rig, tmp_path, cut):
    keys, folder = tmp_path / "keys", tmp_path / "r"
    keys.mkdir()
    with rig.rig(tmp_path, keys=keys) as (_, cable):
        security = f"Basic256Sha256,SignAndEncrypt,{keys / 'recorder.der'},{keys / 'recorder.pem'}"
        options = ("--user", "metrology", "--security", security, "--batch-s", "0.2")
        told = rig.Recorder(cable.port, tmp_path / "no", options, secrets=(("ELASTOGEO_OPCUA_PASSWORD", "wrong"),)).refusal()
        assert "cannot be reached" in told
        assert "wrong" not in told
        password = "a password of tests"
        recorder = rig.Recorder(cable.port, folder, options, secrets=(("ELASTOGEO_OPCUA_PASSWORD", password),))
        recorder.wait_for_parts(1)
        if cut:
            cable.cut()
            recorder.wait_for(", again.")
            recorder.wait_for_parts(2)
        summary = recorder.stop()
    assert all(channel["samples"] for channel in summary["channels"])
    written = b"".join(path.read_bytes() for path in folder.iterdir())
    assert password.encode() not in written
