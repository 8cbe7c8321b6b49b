"""The one module that knows MuJoCo: a compiled model, stepped, with its sensors, contacts and pictures.

A step is taken in its two halves, so that what is read after it belongs to one instant: MuJoCo's ``mj_step`` leaves the
sensors of the state before it.
"""

from __future__ import annotations

import atexit
import ctypes
import os
import sys
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import NDArray

from poise.errors import PoiseError

Floats = NDArray[np.float64]

_LIBRARIES = ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so")


class WorldError(PoiseError, ValueError):
    """A world, or an option of one, that cannot be."""


class MissingExtra(WorldError):
    """MuJoCo is not installed."""


class Physics:
    """The model in *xml*, at rest in its first position, stepped by *step* seconds."""

    def __init__(self, xml: str, step: float) -> None:
        self._mujoco = _mujoco()
        self.model: Any = self._mujoco.MjModel.from_xml_string(xml)
        self.model.opt.timestep = step
        self.data: Any = self._mujoco.MjData(self.model)
        self._renderers: dict[tuple[int, int], Any] = {}
        self._mujoco.mj_step1(self.model, self.data)
        atexit.register(self.close)  # a context that outlives the interpreter's modules complains

    def step(self) -> None:
        """One step: afterwards positions, rates and fields are of its end, specific forces of its beginning."""
        self._mujoco.mj_step2(self.model, self.data)
        self._mujoco.mj_step1(self.model, self.data)

    def refresh(self) -> None:
        """Make everything follow from a position or velocity that was set by hand."""
        self._mujoco.mj_step1(self.model, self.data)

    def sensor(self, name: str) -> Floats:
        """The readings of the model's sensor *name*: a view that every step renews."""
        sensor = self.model.sensor(name)
        start = int(sensor.adr[0])
        return np.asarray(self.data.sensordata[start : start + int(sensor.dim[0])])

    def joint(self, name: str) -> tuple[Floats, Floats]:
        """Views of the position and the velocity of a joint."""
        joint = self.model.joint(name)
        at, speed = int(joint.qposadr[0]), int(joint.dofadr[0])
        width = {0: (7, 6), 1: (4, 3)}.get(int(joint.type[0]), (1, 1))
        return self.data.qpos[at : at + width[0]], self.data.qvel[speed : speed + width[1]]

    def push(self, body: int, force: Floats, at: Floats | None) -> None:
        """Let *force* (N, Earth) act at the point *at* (m, body; None: its centre of mass), beside what acts already."""
        applied = self.data.xfrc_applied[body]
        applied[:3] += force
        if at is not None:
            arm = self.data.xpos[body] + self.data.xmat[body].reshape(3, 3) @ at - self.data.xipos[body]
            (x, y, z), (a, b, c) = arm, force  # numpy's cross takes longer than a step of the physics
            applied[3:] += y * c - z * b, z * a - x * c, x * b - y * a

    def let_go(self, body: int) -> None:
        """End all that pushes *body*."""
        self.data.xfrc_applied[body] = 0.0

    def body(self, name: str) -> int:
        return int(self.model.body(name).id)

    def hold(self, name: str, held: bool) -> None:
        """Switch the constraint *name* of the model on or off."""
        self.data.eq_active[self.model.equality(name).id] = held

    def render(self, width: int, height: int, camera: str) -> NDArray[np.uint8]:
        """(height, width, 3) what *camera* sees."""
        if _screenless() and getattr(self._mujoco, "GLContext", object).__module__.endswith(".glfw"):
            raise WorldError(
                "no picture: mujoco draws with a screen's OpenGL, and there is no screen; it chose when it was imported, "
                "before poise could choose: set MUJOCO_GL=osmesa (or egl) for the program"
            )
        try:
            if (width, height) not in self._renderers:
                self.model.vis.global_.offwidth = max(width, self.model.vis.global_.offwidth)
                self.model.vis.global_.offheight = max(height, self.model.vis.global_.offheight)
                self._renderers[width, height] = self._mujoco.Renderer(self.model, height, width)
            renderer = self._renderers[width, height]
            renderer.update_scene(self.data, camera)
            return np.array(renderer.render(), np.uint8)
        except (ImportError, RuntimeError, OSError, AttributeError, self._mujoco.FatalError) as problem:
            said = str(problem).partition("\n")[0] or type(problem).__name__
            raise WorldError(
                f"no picture without a screen's OpenGL ({said}): "
                "install libosmesa6 or an EGL driver (Debian: apt-get install libosmesa6), or set MUJOCO_GL"
            ) from None

    def close(self) -> None:
        """Give up what pictures needed."""
        for renderer in self._renderers.values():
            renderer.close()
        self._renderers.clear()


def model_text(name: str) -> str:
    """The MJCF of the package's model *name*."""
    return resources.files("poise.simulation.worlds").joinpath("models", f"{name}.xml").read_text("utf-8")


def _mujoco() -> Any:
    if _screenless() and not os.environ.get("MUJOCO_GL"):
        os.environ["MUJOCO_GL"] = "osmesa" if _has_osmesa() else "egl"  # read once, when mujoco is imported
    try:
        import mujoco
    except ImportError as problem:
        raise MissingExtra(f'worlds need MuJoCo ({problem}): pip install "poise[sim]"') from None
    except RuntimeError as problem:
        raise WorldError(f"MuJoCo does not start ({problem}); MUJOCO_GL can be osmesa, egl or glfw") from None
    return mujoco


def _screenless() -> bool:
    return sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def _has_osmesa() -> bool:
    for library in _LIBRARIES:
        try:
            ctypes.CDLL(library)
        except OSError:
            continue
        return True
    return False
