"""An HTTP POST of the alarm as JSON."""

from __future__ import annotations

import urllib.error
import urllib.request
from dataclasses import dataclass, field
from typing import Any, ClassVar
from urllib.parse import urlsplit

from poise.errors import ResponseError
from poise.responses.alarm import Alarm, Kind
from poise.responses.responder import Responder, Trouble, filled_in


class _NoRedirect(urllib.request.HTTPRedirectHandler):
    """urllib would follow a redirected POST by a GET, and the alarm would be lost without a word."""

    def redirect_request(self, *_: Any) -> None:
        return None


_OPENER = urllib.request.build_opener(_NoRedirect)


@dataclass(kw_only=True)
class Webhook(Responder):
    """Posts to *url*; anything but a 2xx answer within *timeout* is a failure. Headers may hold ``${NAME}``."""

    url: str
    headers: dict[str, str] = field(default_factory=dict)
    timeout: float = 3.0

    kind: ClassVar[str] = "webhook"
    answers: ClassVar[frozenset[Kind]] = frozenset(("fired", "released", "failure", "test"))

    def __post_init__(self) -> None:
        super().__post_init__()
        parts = urlsplit(self.url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            self.refuse("url", "an address such as https://example.org/alarms", self.url)

    def check(self) -> str:
        request = urllib.request.Request(self.url, headers=self._headers(), method="HEAD")
        try:
            with _OPENER.open(request, timeout=self.timeout) as answer:
                status = answer.status
        except urllib.error.HTTPError as answer:  # it may have no answer to HEAD: that it answers is enough
            status = answer.code
            answer.close()
        except (OSError, ValueError) as problem:
            raise ResponseError(
                f"{self.name}.url: {self.url} does not answer: {_why(problem)}; start the server, or change the address"
            ) from None
        return f"{self.url} answers ({status})"

    def open(self, trouble: Trouble) -> None:
        self.check()

    def fire(self, alarm: Alarm) -> None:
        body = alarm.as_json().encode("utf-8")
        headers = {"Content-Type": "application/json"} | self._headers()
        request = urllib.request.Request(self.url, data=body, headers=headers, method="POST")
        try:
            with _OPENER.open(request, timeout=self.timeout) as answer:
                answer.read(1)
        except urllib.error.HTTPError as answer:
            code = answer.code
            answer.close()
            said = "is redirected: give the address it leads to" if 300 <= code < 400 else f"answered {code}"
            raise ResponseError(f"{self.url} {said}") from None
        except (OSError, ValueError) as problem:
            raise ResponseError(f"{self.url} cannot be reached: {_why(problem)}") from None

    def _headers(self) -> dict[str, str]:
        return {key: filled_in(text, f"{self.name}.headers.{key}") for key, text in self.headers.items()}


def _why(problem: Exception) -> str:
    if isinstance(problem, TimeoutError) or isinstance(getattr(problem, "reason", None), TimeoutError):
        return "no answer in time"
    return str(getattr(problem, "reason", "") or problem or type(problem).__name__)
