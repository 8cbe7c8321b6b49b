"""What was recorded, over HTTP: finished files, the running session so far, and nothing else of the disk."""

from __future__ import annotations

import http.client
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import poise
from live_helpers import METHOD, heard, made, rows_of, send, serving
from poise.live.access import parsed_tokens
from poise.live.recorder import Recorder
from poise.live.session import Session


def recorded(folder: Path, name: str = "arm", seed: int = 0) -> poise.Recording:
    """A finished session below *folder*."""
    recording = made(2.0, seed=seed)
    with serving(recorder=Recorder(Session.below(folder))) as live, live.device(name) as device:
        send(device, rows_of(recording))
        while heard(device, "ack")["next"] < len(recording):
            pass
    return recording


def test_finished_files_are_listed_and_are_what_is_on_the_disk(tmp_path: Path) -> None:
    recorded(tmp_path)
    (session,) = tmp_path.iterdir()
    with serving(recorder=Recorder(Session.below(tmp_path))) as live:
        found = {each["name"]: each for each in live.http.get("/recordings").json()}
        assert set(found) == {f"{session.name}/arm.parquet", f"{session.name}/arm.{METHOD}.attitude.parquet"}
        for name, each in found.items():
            answer = live.http.get(each["url"])
            assert answer.content == (tmp_path / name).read_bytes()
            assert len(answer.content) == each["bytes"]
            assert answer.headers["content-disposition"].startswith("attachment")
            part = live.http.get(each["url"], headers={"Range": "bytes=0-3"})
            assert (part.status_code, part.content) == (206, b"PAR1")


def test_a_running_session_gives_what_is_on_the_disk_and_goes_on(tmp_path: Path) -> None:
    recording = made(6.0)
    rows = rows_of(recording)
    recorder = Recorder(Session.below(tmp_path / "all"), rotate=60_000)
    with serving(recorder=recorder) as live, live.device("arm.left") as device, live.device("arm") as other:
        send(other, rows_of(made(1.0, seed=5)))
        for stop in (200, 400, len(rows)):
            first = {200: 0, 400: 200}.get(stop, 400)
            send(device, rows[first:stop], first)
            while heard(device, "ack")["next"] < stop:
                pass
            answer = live.http.get("/recordings/current/arm.left.parquet")
            assert answer.status_code == 200
            target = tmp_path / "got.parquet"
            target.write_bytes(answer.content)
            got = poise.read(target)
            np.testing.assert_array_equal(got.time, rows[:stop, 0])
            np.testing.assert_array_equal(got.gyr, rows[:stop, 1:4])
            attitude = live.http.get(f"/recordings/current/arm.left.{METHOD}.attitude.parquet")
            target.write_bytes(attitude.content)
            expected = poise.estimate(poise.AdaptiveGain(), recording)
            np.testing.assert_array_equal(poise.read_attitude(target).quat, expected.quat[:stop])
        assert live.http.get("/recordings/current/nobody.parquet").status_code == 404
        names = [each["name"] for each in live.http.get("/recordings").json()]
        assert "current/arm.left.parquet" in names
        assert "current/arm.parquet" in names
    (session,) = (tmp_path / "all").iterdir()
    np.testing.assert_array_equal(poise.read(session / "arm.left.parquet").gyr, recording.gyr)


def test_nothing_on_the_disk_yet_is_said(tmp_path: Path) -> None:
    with serving(recorder=Recorder(Session.below(tmp_path))) as live, live.device("arm") as device:
        heard(device, "welcome")
        answer = live.http.get("/recordings/current/arm.parquet")
        assert answer.status_code == 404
        assert "nothing of it is on the disk yet" in answer.json()["error"]


@pytest.mark.parametrize(
    "path",
    [
        "../secret.parquet",
        "..%2fsecret.parquet",
        "%2e%2e/secret.parquet",
        "..%5csecret.parquet",
        "%2e%2e%2f%2e%2e%2fetc%2fpasswd",
        "session/..%2f..%2fsecret.parquet",
        "session/%2e%2e",
        "session/secret.txt",
        "session/link.parquet",
        "linked/secret.parquet",
        "half/arm.parquet",
        "current/..%2fsecret.parquet",
        "current/arm.parquet%00.txt",
        "session/arm.parquet/",
        "/etc/passwd",
        "session//etc/passwd",
        "x" * 5000 + "/y",
    ],
)
def test_hostile_paths_find_nothing(hostile: Any, path: str) -> None:
    connection = http.client.HTTPConnection(hostile.address)
    connection.putrequest("GET", f"/recordings/{path}", skip_accept_encoding=True)
    connection.endheaders()
    answer = connection.getresponse()
    body = answer.read()
    assert answer.status in (400, 404, 307)
    assert b"SECRET" not in body
    assert b"root:" not in body


@pytest.fixture(scope="module")
def hostile(tmp_path_factory: pytest.TempPathFactory) -> Any:
    outside = tmp_path_factory.mktemp("outside")
    root = outside / "records"
    for folder in ("session", "half/journal", "../elsewhere"):
        (root / folder).mkdir(parents=True)
    for name in (
        "secret.parquet",
        "elsewhere/secret.parquet",
        "records/session/secret.txt",
        "records/half/arm.parquet",
    ):
        (outside / name).write_bytes(b"SECRET")
    (root / "session" / "arm.parquet").write_bytes(b"fine")
    (root / "session" / "link.parquet").symlink_to(outside / "secret.parquet")
    (root / "linked").symlink_to(outside / "elsewhere")
    session = Session(root / "now")
    session.root = root
    with serving(recorder=Recorder(session)) as live:
        assert live.http.get("/recordings/session/arm.parquet").content == b"fine"
        assert [each["name"] for each in live.http.get("/recordings").json()] == ["session/arm.parquet"]
        yield live


def test_a_token_that_may_not_read_gets_nothing_and_without_a_recorder_there_is_none(tmp_path: Path) -> None:
    recorder = Recorder(Session.below(tmp_path))
    with serving(recorder=recorder, tokens=parsed_tokens(("device:" + "d" * 20,))) as live:
        head = {"Authorization": "Bearer " + "d" * 20}
        assert live.http.get("/recordings", headers=head).status_code == 401
        assert live.http.get("/recordings/current/arm.parquet", headers=head).status_code == 401
    with serving() as live:
        assert live.http.get("/recordings").json() == []
        answer = live.http.get("/recordings/current/arm.parquet")
        assert answer.status_code == 404
        assert "--record" in answer.json()["error"]
