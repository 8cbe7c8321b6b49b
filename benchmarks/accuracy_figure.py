"""The picture of benchmarks/accuracy.py: every method's error on every trial and group of trials."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from poise.plots import save_figure
from poise.plots.style import EDGE, GRID, INK, QUIET, figure_class
from scores import Score, Scores, groups, judged_by, means

_LEADS = {
    "self-calibrating": "#0072B2",
    "self-calibrating-offline": "#56B4E9",
    "vqf": "#D55E00",
    "vqf-offline": "#E69F00",
}
_OTHERS = ("#009E73", "#AA4499", "#666666", "#8C564B", "#117733", "#332288", "#999933", "#BBBBBB")
_MARKS = "osDv^<>ph*XP"
_PANELS = (("total", "total error, degrees RMSE"), ("inclination", "inclination error, degrees RMSE"))


def draw(scores: Scores, path: Path) -> None:
    """Write the picture: a row for each trial, then each group, a mark for each method; total beside inclination."""
    from matplotlib.ticker import NullFormatter, StrMethodFormatter

    names = list(next(iter(scores.values())))
    grouped = groups(names)
    rows = [name.replace("_", " ") for name in names] + [
        f"{group} ({len(members)})" for group, members in grouped.items()
    ]
    rows.append(f"all ({len(names)})")
    figure = figure_class()(figsize=(13.0, 0.27 * len(rows) + 2.0), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True)
    for ax, (kind, label) in zip(panels, _PANELS, strict=True):
        for k, (method, trials) in enumerate(scores.items()):
            if not judged_by(trials, kind):
                continue
            lead = method in _LEADS
            colour = _LEADS.get(method, _OTHERS[k % len(_OTHERS)])
            values = _row(trials, kind, names)
            ax.plot(
                values, range(len(values)), ls="-" if lead else "", lw=1.0, marker=_MARKS[k % len(_MARKS)], color=colour,
                ms=6.5 if lead else 5.0, alpha=1.0 if lead else 0.55, zorder=3 if lead else 2, label=method,
            )  # fmt: skip
        ax.set_xscale("log")
        ax.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.set_xticks([0.25, 0.5, 1, 2, 5, 10, 20, 50])
        ax.grid(True, color=GRID, linewidth=0.6)
        ax.set_axisbelow(True)
        for edge in (len(names) - 0.5, len(rows) - 1.5):
            ax.axhline(edge, color=EDGE, lw=1.0)
        ax.spines[["top", "right"]].set_visible(False)
        ax.tick_params(colors=QUIET, labelsize=9)
        ax.set_xlabel(label, fontsize=10, color=INK)
    panels[0].set_yticks(range(len(rows)), rows)
    panels[0].set_ylim(len(rows) - 0.5, -0.5)
    handles = {name: handle for ax in panels for handle, name in zip(*ax.get_legend_handles_labels(), strict=True)}
    order = [name for name in scores if name in handles]
    figure.legend(
        [handles[name] for name in order], order, loc="outside upper center", ncols=6, frameon=False, fontsize=9.5
    )
    save_figure(figure, path)


def _row(trials: Mapping[str, Score], kind: str, names: list[str]) -> list[float]:
    """A method's errors on the trials, then its means over the groups, then over all."""
    found: list[float | None] = [getattr(trials[name], kind) for name in names]
    found += [mean[kind] for mean in means(trials, groups(names)).values()]
    found.append(means(trials, {"all": names})["all"][kind])
    return [float("nan") if value is None else value for value in found]
