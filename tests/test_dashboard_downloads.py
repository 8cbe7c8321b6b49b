"""What was recorded, downloaded from the page by a click, and read again."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import poise
from browsing import chromium
from dashboards import page_of, sending, turning
from live_helpers import METHOD, heard, made, rows_of, send, serving
from poise.live.access import parsed_tokens
from poise.live.recorder import Recorder
from poise.live.session import Session

TOKEN = "r" * 20


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


def saved(page: Any, name: str, target: Path) -> Path:
    """The file *name* of the dialog's list, as the browser saves it."""
    with page.expect_download() as download:
        page.get_by_role("button", name=name, exact=True).click()
    assert download.value.suggested_filename == name.split("/")[1]
    download.value.save_as(target)
    page.locator("dialog .answer", has_text=re.compile(r"\d (kB|MB)$")).wait_for()
    return target


def test_a_running_and_a_finished_recording_are_saved_by_a_click(browser: Any, tmp_path: Path) -> None:
    before = made(2.0)
    with serving(recorder=Recorder(Session.below(tmp_path / "all"))) as live, live.device("arm") as device:
        send(device, rows_of(before))
        while heard(device, "ack")["next"] < len(before):
            pass
    (session,) = (tmp_path / "all").iterdir()
    with (
        serving(recorder=Recorder(Session.below(tmp_path / "all"))) as live,
        page_of(browser, live, accept_downloads=True) as shown,
        sending(live, "turntable"),
    ):
        page = shown.open()
        shown.waits_for("window.poise.drawn('turntable')?.sequence > 200")
        page.get_by_text("Recording", exact=True).wait_for()
        page.get_by_role("button", name="Download").click()
        page.get_by_text("Recorded by the server, every sample").wait_for()
        files = page.locator(".file").all_inner_texts()
        assert [re.split(r"\s{2,}|\n", each)[0] for each in files] == [
            "current/turntable.parquet",
            f"current/turntable.{METHOD}.attitude.parquet",
            f"{session.name}/arm.{METHOD}.attitude.parquet",
            f"{session.name}/arm.parquet",
        ]
        assert "being recorded" in files[0]
        assert re.search(r"[1-9]\d* kB", files[2])
        found = poise.read(saved(page, "current/turntable.parquet", tmp_path / "turntable.parquet"))
        made_of = saved(page, f"current/turntable.{METHOD}.attitude.parquet", tmp_path / "attitude.parquet")
        old = poise.read(saved(page, f"{session.name}/arm.parquet", tmp_path / "arm.parquet"))
        shown.must_be_clean()
    assert len(found) > 150
    np.testing.assert_array_equal(found.time, turning(0, len(found))[:, 0])
    np.testing.assert_array_equal(found.mag, turning(0, len(found))[:, 7:10])
    attitude = poise.read_attitude(made_of)
    again = poise.estimate(poise.AdaptiveGain(), found)
    both = min(len(attitude), len(found))
    np.testing.assert_array_equal(attitude.quat[:both], again.quat[:both])
    np.testing.assert_array_equal(old.gyr, before.gyr)


def test_with_a_token_it_is_saved_too_and_why_not_is_said(browser: Any, tmp_path: Path) -> None:
    recorder = Recorder(Session.below(tmp_path / "all"))
    with serving(recorder=recorder, tokens=parsed_tokens((f"read:{TOKEN}", "device:" + "d" * 20))) as live:
        head = {"additional_headers": {"Authorization": "Bearer " + "d" * 20}}
        with page_of(browser, live, accept_downloads=True) as shown, live.device("arm", **head) as device:
            page = shown.open(f"#token={TOKEN}")
            shown.waits_for("window.poise.store.devices.size === 1")
            page.get_by_role("button", name="Download").click()
            page.get_by_role("button", name="current/arm.parquet").click()
            page.locator("dialog .answer.bad", has_text="nothing of it is on the disk yet").wait_for()
            recording = made(1.0)
            send(device, rows_of(recording))
            while heard(device, "ack")["next"] < len(recording):
                pass
            found = poise.read(saved(page, "current/arm.parquet", tmp_path / "arm.parquet"))
            np.testing.assert_array_equal(found.acc, recording.acc)
            assert TOKEN not in "".join(shown.requests)


def test_a_server_that_does_not_record_lists_nothing(browser: Any) -> None:
    with serving() as live, page_of(browser, live) as shown, sending(live, "arm"):
        page = shown.open()
        shown.waits_for("window.poise.drawn('arm')?.sequence > 20")
        page.get_by_role("button", name="Download").click()
        page.get_by_role("button", name="Save as CSV").wait_for()
        assert page.locator(".file").count() == 0
        assert not any("/recordings" in url for url in shown.requests)
        shown.must_be_clean()
