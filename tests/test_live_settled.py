"""What stays is not looked at by the garbage collector again and again, and what leaves is freed."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Iterator

import pytest

from poise.live.settled import Settled


class Knot:
    """An object that only the collector can free."""

    def __init__(self) -> None:
        self.own = self


@pytest.fixture(autouse=True)
def thawed() -> Iterator[None]:
    yield
    gc.unfreeze()


def test_devices_that_stay_are_frozen_once_they_are_all_there() -> None:
    settled, before = Settled(), gc.get_freeze_count()
    settled.look(200)  # they may still be coming
    assert gc.get_freeze_count() == before
    settled.look(200)
    frozen = gc.get_freeze_count()
    assert frozen > before
    for count in (201, 201, 199, 199):  # a few that come and go are no reason
        settled.look(count)
    assert gc.get_freeze_count() == frozen


def test_what_has_left_is_freed() -> None:
    settled, knots = Settled(), [Knot() for _ in range(100)]
    seen = weakref.ref(knots[0])
    settled.look(100)
    settled.look(100)
    knots.clear()
    gc.collect()
    assert seen() is not None
    settled.look(3)
    gc.collect()
    assert seen() is None
