"""Speech by ``espeak-ng``, which is called directly, and not believed: it ends with code 0 where nothing was heard.

Without a sound card, or with a file that cannot be written, espeak-ng 1.51 says so on stderr and ends with code 0. So every
text is first rendered to a file that must hold sound, and speaking it must take about as long as that sound lasts.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
import threading
import time
import wave
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from poise.data.event import TipEvent, TipState
from poise.errors import FormatError, ResponseError
from poise.formats.saving import making
from poise.responses import phrases
from poise.responses.alarm import Alarm, Kind, now_utc
from poise.responses.programs import kill, run
from poise.responses.responder import Responder, Trouble

_SILENT = 1e-3  # of full scale; speech is 0.05 and more
_HEARD = 0.25  # of a text's time: what a sound server buffers is the rest


@dataclass(kw_only=True)
class Voice(Responder):
    """Says what happens, or writes it to *wav*. *text* replaces single texts, by state, ``failure`` or ``test``.

    *language* is ``en`` or ``zh``, or another that espeak-ng speaks, with all texts given. *voice* is espeak-ng's name of
    the speaker, *speed* in words a minute, *volume* 10 to 200, *device* that of the sound card.
    """

    language: str = "en"
    voice: str = ""
    text: dict[str, str] = field(default_factory=dict)
    wav: Path | None = None
    device: str = ""
    speed: int = 165
    volume: int = 150
    timeout: float = 15.0

    kind: ClassVar[str] = "voice"
    answers: ClassVar[frozenset[Kind]] = frozenset(("fired", "failure", "test"))

    def __post_init__(self) -> None:
        super().__post_init__()
        if not 80 <= self.speed <= 450:
            self.refuse("speed", "80 to 450 words a minute", self.speed)
        if not 10 <= self.volume <= 200:
            self.refuse("volume", "10 to 200 (below, nobody hears it)", self.volume)
        self._texts = phrases.texts(self.language, self.text, self.name or self.kind)
        self._speaking: subprocess.Popen[Any] | None = None
        self._broken_off = threading.Event()

    def check(self) -> str:
        program = shutil.which("espeak-ng")
        if program is None:
            raise ResponseError(f"{self.name}: espeak-ng is not installed: apt install espeak-ng")
        try:
            with tempfile.TemporaryDirectory() as folder:
                for state in TipState:  # a text without a sound in this voice must not be found out by an alarm
                    event = TipEvent(0.0, state, TipState.UPRIGHT, "forward")
                    self._render(self.words(Alarm("fired", event, now_utc())), Path(folder) / "said.wav")
            self._try_output()
        except ResponseError as problem:
            raise ResponseError(f"{self.name}: {problem}") from None
        return f"{program}, voice {self._voice}, to {self.wav or self.device or 'the sound card'}"

    def open(self, trouble: Trouble) -> None:
        self.check()

    def fire(self, alarm: Alarm) -> None:
        self._broken_off.clear()
        words = self.words(alarm)
        with tempfile.TemporaryDirectory() as folder:
            seconds = self._render(words, Path(folder) / "said.wav")
        if self.wav is not None:
            try:
                with making(self.wav) as made:
                    self._render(words, made)
            except FormatError as problem:
                raise ResponseError(str(problem)) from None
            return
        began = time.monotonic()
        try:
            self._espeak(words)
        except ResponseError:
            if self._broken_off.is_set():
                return
            raise
        took = time.monotonic() - began
        if took < _HEARD * seconds and not self._broken_off.is_set():
            raise ResponseError(
                f"espeak-ng was done after {took:.2f} s with a text of {seconds:.1f} s: nobody can have heard it; look at "
                "the sound device (aplay -l)"
            )

    def interrupt(self) -> None:
        self._broken_off.set()
        if (process := self._speaking) is not None:
            kill(process)

    def words(self, alarm: Alarm) -> str:
        """What is said of *alarm*."""
        return phrases.said(self._texts, alarm, self.language)

    @property
    def _voice(self) -> str:
        return self.voice or phrases.VOICES.get(self.language, self.language)

    def _try_output(self) -> None:
        """Through the sound card, at volume 0: it must be there; or the folder of the file."""
        if self.wav is None:
            self._espeak("a", volume=0)
        elif not os.access(self.wav.parent, os.W_OK):
            raise ResponseError(f"wav: {self.wav.parent} is no folder that can be written to; make it, or name another")

    def _render(self, words: str, path: Path) -> float:
        """How long *words* last, s, once they are in *path* and can be heard."""
        self._espeak(words, "-w", str(path))
        try:
            with wave.open(str(path), "rb") as file:
                rate, samples = file.getframerate(), np.frombuffer(file.readframes(file.getnframes()), dtype="<i2")
        except (OSError, EOFError, ValueError, wave.Error) as problem:
            raise ResponseError(
                f"espeak-ng wrote no sound for {words!r} ({problem}); look at the room on the disk"
            ) from None
        loud = float(np.sqrt(np.mean(np.square(samples / 32768.0)))) if samples.size else 0.0
        if loud < _SILENT:
            raise ResponseError(
                f"espeak-ng has no sound for {words!r} in the voice {self._voice}; change text or voice"
            )
        return samples.size / rate

    def _espeak(self, words: str, *options: str, volume: int | None = None) -> None:
        loud = self.volume if volume is None else volume
        argv = ["espeak-ng", "-b", "1", "-v", self._voice, "-s", str(self.speed), "-a", str(loud), *options]
        if self.device and not options:
            argv += ["-d", self.device]
        try:
            said = run([*argv, "--", words], self.timeout, started=self._started)
        finally:
            self._speaking = None
        for line in said.splitlines():
            if line.lower().startswith(("error", "can't")):
                cannot = "" if options else "; no sound device? (aplay -l)"
                raise ResponseError(f"espeak-ng said: {line.strip()[:200]}{cannot}")

    def _started(self, process: subprocess.Popen[Any]) -> None:
        self._speaking = process
