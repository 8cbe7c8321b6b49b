"""What is said aloud, by language."""

from __future__ import annotations

import difflib

from poise.data.event import TipState
from poise.errors import ResponseError
from poise.responses.alarm import Alarm, named

VOICES = {"en": "en", "zh": "cmn"}
"""espeak-ng's speaker by language; its "zh" may be one that needs another program."""

TEXTS = {
    "en": {
        "unknown": "Warning! Attitude unknown.",
        "upright": "Upright.",
        "leaning": "Careful, leaning {direction}.",
        "tipping": "Warning! Tipping {direction}!",
        "fallen": "Attention! The robot has fallen.",
        "free fall": "Warning! Free fall!",
        "picked up": "Picked up.",
        "righted": "Standing again.",
        "failure": "Attention! The response {responder} has failed.",
        "test": "This is a test of the tipping alarm.",
    },
    "zh": {
        "unknown": "警告!姿态未知。",
        "upright": "已直立。",
        "leaning": "注意,正在{direction}倾斜。",
        "tipping": "警告!机器人{direction}倾倒!",
        "fallen": "注意!机器人已经倒下。",
        "free fall": "警告!正在坠落!",
        "picked up": "已被拿起。",
        "righted": "已经扶正。",
        "failure": "注意!响应 {responder} 失效。",
        "test": "这是倾倒警报测试。",
    },
}
_DIRECTIONS = {"zh": {"forward": "向前", "back": "向后", "left": "向左", "right": "向右"}}


def texts(language: str, own: dict[str, str], where: str) -> dict[str, str]:
    """The texts of *language* with a user's *own* in their place; raises :class:`ResponseError` where some are missing."""
    known = [*(named(state) for state in TipState), "failure", "test"]
    given = {key.replace("_", " ").replace("-", " "): text for key, text in own.items()}
    for key, text in given.items():
        if key not in known:
            near = difflib.get_close_matches(key, known, 1)
            hint = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(known)}"
            raise ResponseError(f"{where}.text: nothing is called {key!r}; {hint}")
        try:
            spoken = text.format(direction="", responder="")
        except (KeyError, IndexError, ValueError):
            raise ResponseError(
                f"{where}.text.{key}: expected words with {{direction}} or {{responder}} at most in braces, found {text!r}"
            ) from None
        if not spoken.strip():
            raise ResponseError(
                f"{where}.text.{key}: a silent alarm is none; write words, or take the state out of fire"
            )
    found = TEXTS.get(language, {}) | given
    if missing := [key for key in known if key not in found]:
        raise ResponseError(
            f"{where}.language: texts of our own are in {' and '.join(TEXTS)}, not in {language!r}; give "
            f"text.{missing[0].replace(' ', '_')} and all the others: {', '.join(known)}"
        )
    return found


def said(found: dict[str, str], alarm: Alarm, language: str) -> str:
    """The text for *alarm* with its direction."""
    key = alarm.kind if alarm.kind in ("failure", "test") else named(alarm.event.state)
    direction = _DIRECTIONS.get(language, {}).get(alarm.event.direction, alarm.event.direction)
    return " ".join(found[key].format(direction=direction, responder=alarm.responder).split()).replace(" ,", ",")
