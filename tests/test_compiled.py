"""The bridge to numba: choices in kernels, and a disk cache that never serves anything stale, from two processes."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np
import pytest

import poise
from helpers import plain
from poise.estimators.parameters import prepared
from poise.math import compiled as bridge
from poise.math.choices import Choice
from poise.math.compiled import compiled, entry
from poise.math.vectors import Vec3

# -- choices ----------------------------------------------------------------------------------------------------------


class Switch(NamedTuple):
    mode: Annotated[Literal["fast", "slow", "slower", ""], "", "which way"] = "fast"

    def step(self, state: Any) -> Any:
        return state


@compiled
def which(switch: Switch) -> tuple[bool, bool, bool, bool, bool]:
    m = switch.mode
    return m == "fast", m == "slow", m == "slower", m == "", m == "Fast"


@pytest.mark.parametrize("mode", ["fast", "slow", "slower", ""])
def test_a_choice_in_a_kernel_equals_its_own_text_only(mode: Any) -> None:
    expected = tuple(mode == text for text in ("fast", "slow", "slower", "", "Fast"))
    assert which(prepared(Switch(mode))) == expected
    assert plain(which)(prepared(Switch(mode))) == expected


@compiled
def other_than(switch: Switch) -> tuple[bool, bool, bool, bool, bool]:
    m = switch.mode
    return m != "fast", m != "slow", m != "slower", m != "", m != "Fast"


@pytest.mark.parametrize("mode", ["fast", "slow", "slower", ""])
def test_a_choice_in_a_kernel_differs_from_every_other_text(mode: Any) -> None:
    expected = tuple(mode != text for text in ("fast", "slow", "slower", "", "Fast"))
    assert other_than(prepared(Switch(mode))) == expected
    assert plain(other_than)(prepared(Switch(mode))) == expected


def test_all_texts_of_a_choice_share_one_compilation() -> None:
    for mode in ("fast", "slow"):
        which(prepared(Switch(mode)))  # type: ignore[arg-type]
    assert bridge.PLAIN_PYTHON or len(which._twin.signatures) == 1  # type: ignore[attr-defined]


def test_a_choice_is_a_text_in_python() -> None:
    assert Choice("fast") == "fast"
    assert f"{Choice('fast')}" == "fast"
    assert json.dumps({"mode": Choice("fast")}) == '{"mode": "fast"}'


# -- operators of classes that kernels meet ---------------------------------------------------------------------------


class Pair(NamedTuple):
    """A user's own algebra."""

    a: float
    b: float

    def __add__(self, other: Pair) -> Pair:  # type: ignore[override]
        return Pair(self.a + other.a, self.b + other.b)

    def __rmul__(self, scale: float) -> Pair:  # type: ignore[override]
        return Pair(scale * self.a, scale * self.b)


def test_operators_of_any_named_tuple_work_in_kernels() -> None:
    @compiled
    def mixed(p: Pair, q: Pair) -> Pair:
        return p + 2.0 * q

    assert mixed(Pair(1.0, 2.0), Pair(10.0, 20.0)) == Pair(21.0, 42.0)


# -- a folder that cannot be written ----------------------------------------------------------------------------------


def test_without_a_folder_to_write_to_everything_still_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    class Nowhere:
        @classmethod
        def from_function(cls, function: Any, path: str) -> None:
            return None

    monkeypatch.setattr(bridge._CompileResults, "_locator_classes", [Nowhere])

    def doubled(v: Vec3) -> Vec3:
        return 2.0 * v

    kernel = entry(doubled)
    assert kernel(Vec3(1.0, 2.0, 3.0)) == Vec3(2.0, 4.0, 6.0)
    assert bridge.PLAIN_PYTHON or not kernel.stats.cache_path  # type: ignore[attr-defined]


# -- the disk cache, from several processes ---------------------------------------------------------------------------

METHOD = """
from typing import NamedTuple

from poise.math.quaternions import Quat, conjugate, exp, normalize, rotate
from poise.math.vectors import UP, Vec3, cross, unit


class State(NamedTuple):
    attitude: Quat
    bias: Vec3


class Pull(NamedTuple):
    gain: float = 1.0

    def start(self, sample, bias):
        return State(Quat(1.0, 0.0, 0.0, 0.0), bias)

    def step(self, state, sample):
        error = cross(unit(sample.acc), rotate(conjugate(state.attitude), UP))
        return State(normalize(state.attitude * exp(sample.dt * (sample.gyr + self.gain * error))), state.bias)
"""

SCRIPT = """
import importlib, json, sys

import numpy as np

import poise
from poise.estimators.loop import advance

module, wrapped = sys.argv[1], sys.argv[2] == "wrapped"
method = importlib.import_module(module).Pull(gain=0.5)
recording = poise.Recording.at_rate(100, np.full((40, 3), 0.1), np.tile([1.0, 2.0, 9.0], (40, 1)))
attitude = poise.estimate(method, recording, guard=None, rest_bias=wrapped)
hits = sum(advance.stats.cache_hits.values())
print(json.dumps({"package": poise.__file__, "quat": attitude.quat[-1].tolist(), "served": hits > 0}))
"""

BUILT_IN = "poise.estimators.pull"  # a method of the package itself, small enough to compile quickly


class Installation:
    """A copy of the package with a method added, and scripts that run in processes of their own."""

    def __init__(self, folder: Path) -> None:
        self.packages, self.users = folder / "packages", folder / "users"
        self.users.mkdir()
        source = Path(poise.__file__).parent
        shutil.copytree(source, self.packages / "poise", ignore=shutil.ignore_patterns("__pycache__"))
        self.path("estimators/pull.py").write_text(METHOD)
        self.script = folder / "run.py"
        self.script.write_text(SCRIPT)

    def path(self, name: str) -> Path:
        return self.packages / "poise" / name

    def run(self, module: str, *, wrapped: bool = False, users: bool = False) -> dict[str, Any]:
        """What the script says; *users* puts the user's folder on the path."""
        hidden = ("NUMBA_CACHE_DIR", "NUMBA_DISABLE_JIT", "PYTHONPATH")
        environment = {name: value for name, value in os.environ.items() if name not in hidden}
        folders = [self.packages, self.users] if users else [self.packages]
        environment["PYTHONPATH"] = os.pathsep.join(map(str, folders))
        command = [sys.executable, str(self.script), module, "wrapped" if wrapped else "bare"]
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        said: dict[str, Any] = json.loads(done.stdout)
        assert Path(said["package"]).is_relative_to(self.packages)
        return said


@pytest.fixture(scope="module")
def installation(tmp_path_factory: pytest.TempPathFactory) -> Installation:
    return Installation(tmp_path_factory.mktemp("installation"))


def edited(path: Path, old: str, new: str) -> str:
    """Edit a file; returns what it held."""
    text = path.read_text()
    assert text.count(old) == 1
    path.write_text(text.replace(old, new))
    return text


def test_an_edited_helper_is_noticed(installation: Installation) -> None:
    first = installation.run(BUILT_IN)
    again = installation.run(BUILT_IN)
    assert again["served"] and not first["served"]  # there is a cache that could be stale
    assert again["quat"] == first["quat"]

    helper = installation.path("math/quaternions.py")
    whole = edited(helper, "square = 0.25 * dot(v, v)", "v = 1.5 * v\n    square = 0.25 * dot(v, v)")
    changed = installation.run(BUILT_IN)
    assert not changed["served"]
    assert np.abs(np.subtract(changed["quat"], first["quat"])).max() > 1e-3

    helper.write_text(whole)
    assert installation.run(BUILT_IN)["quat"] == first["quat"]


def test_a_users_method_leaves_no_trace_in_the_cache(installation: Installation) -> None:
    users_file = installation.users / "mine.py"
    users_file.write_text(METHOD)
    first = installation.run(BUILT_IN)
    before = installation.run("mine", wrapped=True, users=True)

    # Without the user's module, built-in methods are served as ever.
    built_in = installation.run(BUILT_IN)
    assert built_in["served"]
    assert built_in["quat"] == first["quat"]

    # An edit of the user's module shows, inside a method of the package too.
    edited(users_file, "self.gain * error", "4.0 * self.gain * error")
    after = installation.run("mine", wrapped=True, users=True)
    assert not before["served"] and not after["served"]
    assert np.abs(np.subtract(after["quat"], before["quat"])).max() > 1e-3
