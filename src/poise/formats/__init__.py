"""Files in and out: read and sniff recordings, write recordings and attitudes, read attitudes back."""

from poise.formats.assemble import SensorFacts, Sniffed
from poise.formats.attitudes import read_attitude, wrote_attitude
from poise.formats.chunks import Chunks
from poise.formats.learned_files import read_learned
from poise.formats.limits import Limits
from poise.formats.reading import examine, read, read_chunks, sniff
from poise.formats.writing import write

__all__ = [
    "Chunks",
    "Limits",
    "SensorFacts",
    "Sniffed",
    "examine",
    "read",
    "read_attitude",
    "read_chunks",
    "read_learned",
    "sniff",
    "write",
    "wrote_attitude",
]
