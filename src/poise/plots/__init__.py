"""Pictures of recordings, attitudes and comparisons; matplotlib is imported when the first one is drawn, and no state of
it is touched."""

from poise.plots.attitude import attitude_figure
from poise.plots.balancing import balance_figure
from poise.plots.comparison import comparison_figure
from poise.plots.diagnosis import diagnosis_figure
from poise.plots.inline import inline_svg
from poise.plots.learning import learning_figure
from poise.plots.lines import POINTS
from poise.plots.pictures import save_picture
from poise.plots.recording import recording_figure
from poise.plots.slewing import slewing_figure
from poise.plots.style import FORMATS, save_figure
from poise.plots.tipping import tip_over_figure

__all__ = [
    "FORMATS",
    "POINTS",
    "attitude_figure",
    "balance_figure",
    "comparison_figure",
    "diagnosis_figure",
    "inline_svg",
    "learning_figure",
    "recording_figure",
    "save_figure",
    "save_picture",
    "slewing_figure",
    "tip_over_figure",
]
