"""The bridge to numba: compile functions, and give NamedTuples their operators and methods inside kernels.

With ``NUMBA_DISABLE_JIT=1`` nothing here compiles and every kernel runs as the plain Python that it is.
"""

from __future__ import annotations

import hashlib
import inspect
import operator
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numba
import numba.core.errors
from numba.core import caching, types
from numba.core.registry import CPUDispatcher
from numba.extending import overload

CompileError = numba.core.errors.NumbaError
F = TypeVar("F", bound=Callable[..., Any])

PLAIN_PYTHON: bool = bool(numba.config.DISABLE_JIT)  # type: ignore[attr-defined]

# ---------------------------------------------------------------------------------------------------------------------
# Compiling, and a disk cache that can be trusted


@cache
def source_stamp() -> str:
    """A hash of everything a kernel can be made of.

    Numba's own stamp covers the file of the outermost kernel only, so an edited helper would go unnoticed (numba #1833).
    """
    package = Path(__file__).parents[1]
    folders = ("math", "data", "estimators", "control", "monitor")
    files = [path for folder in folders for path in (package / folder).rglob("*.py")]
    files += package.glob("*.py")
    return hashlib.sha256(b"\0".join(path.read_bytes() for path in sorted(files))).hexdigest()


class _Stamped:
    def get_source_stamp(self) -> str:
        return source_stamp()


class _UserProvided(_Stamped, caching.UserProvidedCacheLocator):
    pass


class _InTree(_Stamped, caching.InTreeCacheLocator):
    pass


class _UserWide(_Stamped, caching.UserWideCacheLocator):
    pass


class _CompileResults(caching.CompileResultCacheImpl):
    _locator_classes = [_UserProvided, _InTree, _UserWide]  # noqa: RUF012  (as numba declares it)


class _PackageCache(caching.FunctionCache):
    """Numba's disk cache, for signatures of poise's own types only.

    A file with a type from a user's module could not be unpickled by a process without that module, not even for a
    built-in method, and would be stale after an edit of that module.  The index therefore holds text keys, never types.
    """

    _impl_class = _CompileResults

    def _index_key(self, sig: Any, codegen: Any) -> Any:
        return (*map(_describe, sig), codegen.magic_tuple())

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        return super().load_overload(sig, target_context) if _all_own(sig) else None

    def save_overload(self, sig: Any, data: Any) -> None:
        if _all_own(sig):
            super().save_overload(sig, data)


def _children(numba_type: Any) -> Iterator[Any]:
    if isinstance(numba_type, types.StructRef):
        yield from numba_type.field_dict.values()
    elif isinstance(numba_type, types.BaseTuple):
        yield from numba_type.types  # type: ignore[attr-defined]
    elif isinstance(numba_type, types.Optional):
        yield numba_type.type


def _own(numba_type: Any) -> bool:
    module: str = getattr(getattr(numba_type, "instance_class", None), "__module__", "poise")
    return (module == "poise" or module.startswith("poise.")) and _all_own(_children(numba_type))


def _all_own(numba_types: Any) -> bool:
    return all(map(_own, numba_types))


def _describe(numba_type: Any) -> str:
    cls = getattr(numba_type, "instance_class", None)
    name = f"{cls.__module__}.{cls.__qualname__}" if cls else f"{type(numba_type).__name__}:"
    children = list(_children(numba_type))
    return f"{name}({','.join(map(_describe, children))})" if cls or children else f"{name}{numba_type}"


_OPTIONS: Any = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}


class _Kernel(CPUDispatcher):
    """A function for other kernels. Python calls a twin of it, which alone has the wrapper that unpacks tuples for it: of a
    function that takes a whole state, the wrapper takes longer to compile than the function.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function, targetoptions={"nopython": True, "no_cpython_wrapper": True, **_OPTIONS})
        self._twin: Any = None

    def __call__(self, *args: Any) -> Any:
        if self._twin is None:
            self._twin = numba.njit(self.py_func, **_OPTIONS)
        return self._twin(*args)


def compiled(function: F) -> F:
    """Compile *function* for use inside other kernels."""
    return function if PLAIN_PYTHON else _Kernel(function)  # type: ignore[return-value]


def _packed(compile_for: Callable[..., Any]) -> Callable[..., Any]:
    """Lets LLVM do like operations on the numbers of a vector or a quaternion together: the same bits, up to 13 % sooner.

    Numba leaves that out, and can be told otherwise for the whole process only: here for as long as it compiles.
    """

    def compile_packed(signature: Any) -> Any:
        with numba.core.compiler_lock.global_compiler_lock:
            before = numba.config.SLP_VECTORIZE  # type: ignore[attr-defined]
            numba.config.SLP_VECTORIZE = 1  # type: ignore[attr-defined]
            try:
                return compile_for(signature)
            finally:
                numba.config.SLP_VECTORIZE = before  # type: ignore[attr-defined]

    return compile_packed


def entry(function: F) -> F:
    """Compile *function* to be called from Python, cached on disk until any source of poise changes."""
    if PLAIN_PYTHON:
        return function
    kernel = numba.njit(function, nogil=True, error_model="numpy")
    kernel.compile = _packed(kernel.compile)
    with suppress(RuntimeError):  # no folder to write to: compile in every process
        kernel._cache = _PackageCache(function)
    return kernel  # type: ignore[no-any-return]


def direct(kernel: Any, *args: Any) -> Callable[..., Any]:
    """The machine code of *kernel* for the types of *args*, which it has run with before, without the look-up by type.

    It trusts its arguments: call it with exactly these types.  Saves about 1 us, a third of a one-sample update.
    """
    if PLAIN_PYTHON:
        return kernel  # type: ignore[no-any-return]
    return kernel.overloads[tuple(map(numba.typeof, args))].entry_point  # type: ignore[no-any-return]


# ---------------------------------------------------------------------------------------------------------------------
# NamedTuples: dispatch by class


# A call that is not inlined passes every number of a nested NamedTuple through the stack: 100 ns a sample in all.
# Methods are given to numba as they are: what is around them would be compiled with them inside once more.
_INLINE: Any = _OPTIONS | {"forceinline": True, "no_cpython_wrapper": True}


def method_of(numba_type: Any, name: str) -> Any:
    """The method *name*, a Python function, of the NamedTuple class behind a numba type; None where it has none."""
    method = getattr(getattr(numba_type, "instance_class", None), name, None)
    return method if inspect.isfunction(method) else None


def dispatched(
    name: str, default: Callable[..., Any] | None = None, *, inlined: bool = True, polished: bool = False
) -> Callable[..., Any]:
    """A function ``f(thing, *args)`` that calls ``thing.name(*args)``, in Python and inside kernels.

    Dispatch on the class compiles once and caches; a method passed as an argument would recompile in every process.
    *default* takes the same arguments and stands in where the class has no such method. What seldom runs need not be
    *inlined*. *polished* is optimised once more, as a function of its own: for what runs at every sample.
    """

    def call(thing: Any, *args: Any) -> Any:
        method = getattr(thing, name, None)
        if method is None and default is not None:
            return default(thing, *args)
        return getattr(thing, name)(*args)

    if not PLAIN_PYTHON:
        options = _INLINE | {"forceinline": inlined}

        @overload(call, jit_options=options, strict=False)  # strict: its parameters would have to have these names
        def _(thing, *args):
            method = method_of(thing, name) or default
            if method is None or not polished:
                return method
            kernel = numba.njit(method, **options)
            return lambda thing, *args: kernel(thing, *args)

    return call


def built_from(classes: dict[type, type], default: type) -> Callable[..., Any]:
    """A function ``f(*parts)`` that makes the class which *classes* names for the class of its first part."""

    def build(*parts: Any) -> Any:
        return classes.get(type(parts[0]), default)(*parts)

    if not PLAIN_PYTHON:

        @overload(build, jit_options=_INLINE)
        def _(*parts):
            made = classes.get(getattr(parts[0], "instance_class", float), default)
            return lambda *parts: made(*parts)

    return build


def _share_operator(name: str) -> None:
    @overload(getattr(operator, name), jit_options=_INLINE, strict=False)
    def _(left, right):
        if method := method_of(left, f"__{name}__"):
            return method
        if method := method_of(right, f"__r{name}__"):
            kernel = numba.njit(method, **_INLINE)
            return lambda left, right: kernel(right, left)
        return None


def _share_negation() -> None:
    @overload(operator.neg, jit_options=_INLINE, strict=False)
    def _(value):
        return method_of(value, "__neg__")


if not PLAIN_PYTHON:
    for _name in ("add", "sub", "mul", "truediv", "matmul"):
        _share_operator(_name)
    _share_negation()
