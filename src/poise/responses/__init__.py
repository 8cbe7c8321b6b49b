"""What answers a tipping robot: a power cut, a voice, messages, programs; staged by one TOML file."""

from poise.responses.alarm import Alarm, Failure
from poise.responses.config import RESPONDERS, Config, config_of, load_config
from poise.responses.responder import Responder
from poise.responses.running import Responses
from poise.responses.staging import Stage, Staging

__all__ = [
    "RESPONDERS",
    "Alarm",
    "Config",
    "Failure",
    "Responder",
    "Responses",
    "Stage",
    "Staging",
    "config_of",
    "load_config",
]
