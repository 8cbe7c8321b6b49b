"""MQTT through paho; the only module that imports it.

Below the topic: ``alarm`` (retained: what holds now), ``failure``, ``test`` and ``availability`` (retained: ``online``, or
``offline``, which the broker says itself, as the last will, when the program is gone).
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, ClassVar

from poise.errors import ResponseError
from poise.responses.alarm import Alarm, Kind, no_event, now_utc
from poise.responses.responder import Responder, Trouble, filled_in


@dataclass(kw_only=True)
class Mqtt(Responder):
    """Publishes with QoS 1: fired means that the broker has confirmed it. Reconnects by itself and says again what holds.

    *username* and *password* may hold ``${NAME}``. The broker says ``offline`` 1.5 *keepalive* after the last sign of life.
    """

    broker: str = "localhost"
    port: int = 1883
    topic: str = "poise"
    username: str = ""
    password: str = ""
    tls: bool = False
    keepalive: int = 5
    timeout: float = 3.0

    kind: ClassVar[str] = "mqtt"
    answers: ClassVar[frozenset[Kind]] = frozenset(("fired", "released", "failure", "test"))

    def __post_init__(self) -> None:
        super().__post_init__()
        if not 1 <= self.port <= 65535:
            self.refuse("port", "1 to 65535", self.port)
        if not 1 <= self.keepalive <= 3600:
            self.refuse("keepalive", "1 to 3600 s", self.keepalive)
        if not self.topic or set(self.topic) & set("+#\0") or self.topic.endswith("/"):
            self.refuse("topic", "a topic without + and #, such as robots/7", self.topic)
        self._lock = threading.Lock()
        self._client: Any = None
        self._holds = ""  # the JSON below alarm
        self._up = threading.Event()
        self._opened = self._closing = False

    def check(self) -> str:
        _end(self._connected(self._new_client(), lambda client: None))
        return f"{self.broker}:{self.port} takes us, topic {self.topic}"

    def open(self, trouble: Trouble) -> None:
        self._holds = Alarm("started", no_event(), now_utc()).as_json()
        client = self._new_client()
        client.will_set(f"{self.topic}/availability", "offline", qos=1, retain=True)
        client.reconnect_delay_set(min_delay=1, max_delay=5)

        def taken(client: Any) -> None:
            with self._lock:  # a broker that was started anew has forgotten it
                client.publish(f"{self.topic}/availability", "online", qos=1, retain=True)
                client.publish(f"{self.topic}/alarm", self._holds, qos=1, retain=True)
                again, self._opened = self._opened, True
                self._up.set()
            if again:
                trouble(None)

        def disconnected(_client: Any, _data: Any, _flags: Any, reason: Any, _properties: Any) -> None:
            was_up = self._up.is_set()
            self._up.clear()
            if was_up and not self._closing:
                trouble(f"the connection to the broker {self.broker}:{self.port} broke ({reason}); it is tried again")

        client.on_disconnect = disconnected
        self._client = self._connected(client, taken)

    def fire(self, alarm: Alarm) -> None:
        below = alarm.kind if alarm.kind in ("failure", "test") else "alarm"
        body = alarm.as_json()
        with self._lock:
            if below == "alarm":
                self._holds = body  # said when the broker is back, whatever comes of it now
            if not self._up.is_set():
                raise ResponseError(
                    f"the broker {self.broker}:{self.port} is not reached; it is tried again and told then"
                )
            sent = self._client.publish(f"{self.topic}/{below}", body, qos=1, retain=below == "alarm")
        end = time.monotonic() + self.timeout
        while time.monotonic() < end and self._up.is_set():
            try:
                sent.wait_for_publish(0.1)
                if sent.is_published():
                    return
            except (RuntimeError, ValueError) as problem:
                raise ResponseError(f"the broker {self.broker}:{self.port} was not told: {problem}") from None
        raise ResponseError(f"the broker {self.broker}:{self.port} did not confirm within {self.timeout:g} s")

    def close(self) -> None:
        self._closing = True
        client, self._client = self._client, None
        if client is None:
            return
        if self._up.is_set():
            with suppress(RuntimeError, ValueError):
                client.publish(f"{self.topic}/availability", "offline", qos=1, retain=True).wait_for_publish(1.0)
        _end(client)

    def _new_client(self) -> Any:
        try:
            from paho.mqtt.client import Client
            from paho.mqtt.enums import CallbackAPIVersion
        except ImportError:
            raise ResponseError(f"{self.name}: MQTT needs paho-mqtt: pip install 'poise[respond]'") from None
        client = Client(CallbackAPIVersion.VERSION2)
        if self.username:
            secret = filled_in(self.password, f"{self.name}.password") if self.password else None
            client.username_pw_set(filled_in(self.username, f"{self.name}.username"), secret)
        if self.tls:
            client.tls_set()
        client.connect_timeout = self.timeout
        return client

    def _connected(self, client: Any, taken: Callable[[Any], None]) -> Any:
        """*client*, running, once the broker has taken it; calls *taken* then, and whenever it is taken again.

        Raises :class:`ResponseError` where it is not.
        """
        where, refused, answered = f"{self.name}: the broker {self.broker}:{self.port}", [], threading.Event()

        def on_connect(client: Any, _data: Any, _flags: Any, reason: Any, _properties: Any) -> None:
            if reason.is_failure:
                refused.append(str(reason))
            else:
                taken(client)
            answered.set()

        client.on_connect = on_connect
        try:
            client.connect(self.broker, self.port, self.keepalive)
        except (OSError, ValueError) as problem:
            raise ResponseError(
                f"{where} cannot be reached ({problem}): start it (apt install mosquitto), or change broker and port"
            ) from None
        client.loop_start()
        if not answered.wait(self.timeout) or refused:
            _end(client)
            said = f"refuses us ({refused[0]}): look at username and password" if refused else "does not answer as MQTT"
            raise ResponseError(f"{where} {said}")
        return client


def _end(client: Any) -> None:
    client.disconnect()
    client.loop_stop()
