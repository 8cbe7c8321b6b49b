"""Power cut by a relay on a GPIO pin, through gpiozero; the only module that imports it."""

from __future__ import annotations

import math
import threading
import time
import warnings
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from poise.errors import ResponseError
from poise.responses.alarm import Alarm, Kind
from poise.responses.responder import Responder, Trouble

_TEST = 0.2  # s


@dataclass(kw_only=True)
class Relay(Responder):
    """Cuts the power when fired; gives it back when released, and not before.

    *active_high* is the level that cuts: True for high. *fail_safe* is what the pin is told when the program ends, and so
    what it begins with: a program that starts anew moves nothing. From the end on the pin is an input, so that wiring and
    pull resistor decide: wire it so that a pin that is not driven cuts.
    """

    pin: int | str
    active_high: bool
    fail_safe: Literal["cut", "release"] = "cut"
    timeout: float = 0.1

    kind: ClassVar[str] = "relay"
    answers: ClassVar[frozenset[Kind]] = frozenset(("fired", "released", "test"))
    acts: ClassVar[bool] = True
    immediate: ClassVar[bool] = True

    @property
    def edge(self) -> float:
        """s, ``time.monotonic()`` when the pin was last seen to follow; NaN before."""
        return getattr(self, "_edge", math.nan)

    @property
    def cut(self) -> bool:
        """Is the power cut? Known from the pin, once it is open."""
        return bool(self._device.value)

    @property
    def fired_at_start(self) -> bool:
        return self.fail_safe == "cut"

    def check(self) -> str:
        factory = self._factory()
        for _header, info in factory.board_info.find_pin(self.pin):
            if "gpio" not in info.interfaces:
                break
            mock = "; a mock: nothing moves" if type(factory).__name__ == "MockFactory" else ""
            level = "high" if self.active_high else "low"
            return f"{info.name} by {type(factory).__name__}, cuts by {level}{mock}"
        raise ResponseError(
            f"{self.name}.pin: the board has no GPIO pin {self.pin!r}; expected the number after GPIO, such as 17, or a "
            'name such as "BOARD11" (the command pinout shows all)'
        )

    def open(self, trouble: Trouble) -> None:
        self.check()
        from gpiozero import DigitalOutputDevice
        from gpiozero.exc import GPIOZeroError

        try:
            self._device: Any = DigitalOutputDevice(
                self.pin, active_high=self.active_high, initial_value=self.fired_at_start
            )
        except (GPIOZeroError, OSError) as problem:
            raise ResponseError(
                f"{self.name}.pin: {self.pin} cannot be used: {problem}; end what uses it, or take another pin"
            ) from None

    def fire(self, alarm: Alarm) -> None:
        if alarm.kind != "test":
            self._drive(alarm.kind == "fired")
            return
        before = bool(self._device.value)
        self._drive(not before)
        time.sleep(_TEST)
        self._drive(before)

    def close(self) -> None:
        device = getattr(self, "_device", None)
        if device is None or device.closed:
            return
        for last in (lambda: self._drive(self.fail_safe == "cut"), device.close):
            with suppress(Exception):
                last()

    def _drive(self, cut: bool) -> None:
        try:
            self._device.value = cut
            found = bool(self._device.value)
            self._edge = time.monotonic()
        except Exception as problem:  # whatever a pin's driver raises
            raise ResponseError(f"pin {self.pin} cannot be driven: {problem}") from None
        if found != cut:
            level = "high" if cut == self.active_high else "low"
            raise ResponseError(
                f"pin {self.pin} was driven {level} and did not follow; look for a short or another user"
            )

    def _factory(self) -> Any:
        try:
            from gpiozero import Device
            from gpiozero.exc import PinFactoryFallback
        except ImportError:
            raise ResponseError(f"{self.name}: a relay needs gpiozero: pip install 'poise[respond]'") from None
        with _ONE, warnings.catch_warnings():
            warnings.simplefilter("ignore", PinFactoryFallback)
            try:
                Device.ensure_pin_factory()
            except Exception as problem:  # import errors of every driver that it tries, and its own
                raise ResponseError(
                    f"{self.name}: no way to this machine's pins ({problem}): install a driver, pip install lgpio on a "
                    "Raspberry Pi; or set GPIOZERO_PIN_FACTORY=mock to try things where there are no pins"
                ) from None
        return Device.pin_factory


_ONE = threading.Lock()
