"""The one bridge to numba: compile functions, and give NamedTuples their operators and methods inside kernels.

With ``NUMBA_DISABLE_JIT=1`` nothing here compiles and every kernel runs as the plain Python that it is.
"""

from __future__ import annotations

import hashlib
import inspect
import operator
import zlib
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numba
import numba.core.errors
from llvmlite import ir
from numba.core import caching, cgutils, types
from numba.experimental import structref
from numba.extending import (
    NativeValue,
    intrinsic,
    models,
    overload,
    register_model,
    typeof_impl,
    unbox,
)

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


def compiled(function: F) -> F:
    """Compile *function* for use inside other kernels."""
    return function if PLAIN_PYTHON else numba.njit(function, **_OPTIONS)


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
_INLINE: Any = {"forceinline": True, "error_model": "numpy"}


@cache
def kernel_of(numba_type: Any, name: str) -> Any:
    """The compiled method *name* of the NamedTuple class behind a numba type, or None."""
    method = getattr(getattr(numba_type, "instance_class", None), name, None)
    if not inspect.isfunction(method):
        return None
    options = _OPTIONS | {"forceinline": name not in ("start", "restart"), "no_cpython_wrapper": True}
    return numba.njit(method, **options)


def dispatched(name: str, default: Callable[..., Any] | None = None) -> Callable[..., Any]:
    """A function ``f(thing, *args)`` that calls ``thing.name(*args)``, in Python and inside kernels.

    Dispatch on the class compiles once and caches; a method passed as an argument would recompile in every process.
    *default* takes the same arguments and stands in where the class has no such method.
    """

    def call(thing: Any, *args: Any) -> Any:
        method = getattr(thing, name, None)
        if method is None and default is not None:
            return default(thing, *args)
        return getattr(thing, name)(*args)

    if not PLAIN_PYTHON:
        fallback = compiled(default) if default is not None else None

        @overload(call, jit_options=_INLINE)
        def _(thing, *args):
            kernel = kernel_of(thing, name) or fallback
            if kernel is not None:
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
    @overload(getattr(operator, name), jit_options=_INLINE)
    def _(left, right):
        if kernel := kernel_of(left, f"__{name}__"):
            return lambda left, right: kernel(left, right)
        if kernel := kernel_of(right, f"__r{name}__"):
            return lambda left, right: kernel(right, left)
        return None


def _share_negation() -> None:
    @overload(operator.neg, jit_options=_INLINE)
    def _(value):
        if kernel := kernel_of(value, "__neg__"):
            return lambda value: kernel(value)
        return None


if not PLAIN_PYTHON:
    for _name in ("add", "sub", "mul", "truediv", "matmul"):
        _share_operator(_name)
    _share_negation()


# ---------------------------------------------------------------------------------------------------------------------
# Choices: a parameter that names one of a few texts, at the cost of comparing two integers


class Choice(str):
    """A text option on its way into a kernel, where ``option == "text"`` compares hashes made at compile time."""

    __slots__ = ()

    @property
    def code(self) -> int:
        return _code(self)


def _code(text: str) -> int:
    return zlib.crc32(text.encode())


if not PLAIN_PYTHON:

    class _ChoiceType(types.Type):
        def __init__(self) -> None:
            super().__init__(name="Choice")

    _CHOICE = _ChoiceType()

    @register_model(_ChoiceType)
    class _ChoiceModel(models.PrimitiveModel):
        def __init__(self, manager: Any, fe_type: Any) -> None:
            super().__init__(manager, fe_type, ir.IntType(64))

    @typeof_impl.register(Choice)
    def _(value: Any, context: Any) -> Any:
        return _CHOICE

    @unbox(_ChoiceType)  # type: ignore[untyped-decorator]
    def _(typ: Any, value: Any, context: Any) -> Any:
        code = context.pyapi.object_getattr_string(value, "code")
        number = context.pyapi.long_as_longlong(code)
        context.pyapi.decref(code)
        return NativeValue(number, is_error=cgutils.is_not_null(context.builder, context.pyapi.err_occurred()))

    @intrinsic
    def _code_of(typing_context: Any, choice: Any) -> Any:
        return types.int64(choice), lambda context, builder, signature, args: args[0]

    @overload(operator.eq, prefer_literal=True)
    def _(left, right):
        if isinstance(left, _ChoiceType) and isinstance(right, types.StringLiteral):
            code = _code(right.literal_value)
            return lambda left, right: _code_of(left) == code  # type: ignore[call-arg]
        return None

    @overload(operator.ne, prefer_literal=True)
    def _(left, right):
        if isinstance(left, _ChoiceType) and isinstance(right, types.StringLiteral):
            return lambda left, right: not left == right  # noqa: SIM201
        return None


# ---------------------------------------------------------------------------------------------------------------------
# Memory: state that stays on the compiled side between calls (boxing a State costs ~2 us per nested tuple)


if PLAIN_PYTHON:

    class Memory:
        """A running method: its parameters, its state, and what the loop remembers beside it."""

        def __init__(self, method: Any, state: Any, aside: Any) -> None:
            self.method, self.state, self.aside = method, state, aside

else:

    @structref.register
    class MemoryType(types.StructRef):  # by name in the module: disk caches refer to it
        pass

    class Memory(structref.StructRefProxy):  # type: ignore[no-redef]
        """A running method: its parameters, its state, and what the loop remembers beside it."""

        def __new__(cls, method: Any, state: Any, aside: Any) -> Any:
            return structref.StructRefProxy.__new__(cls, method, state, aside)

    structref.define_proxy(Memory, MemoryType, ["method", "state", "aside"])


# ---------------------------------------------------------------------------------------------------------------------
# Arrays in a state: numba counts the owners of each at every branch and copy of the state, which cost 100 ns a sample.
# A loop works on views that nobody owns while the memory holds the arrays themselves. A method may make an array anew, but
# not move one to another field.


def _arrays_mapped(context: Any, builder: Any, typ: Any, change: Callable[..., Any], *values: Any) -> Any:
    """*values* of one type, with *change*(array type, *arrays) in the place of every array."""
    if isinstance(typ, types.Array):
        return change(typ, *values)
    if not isinstance(typ, types.BaseTuple):
        return values[-1]
    parts = []
    for i, part in enumerate(typ.types):  # type: ignore[attr-defined]
        inner = (builder.extract_value(value, i) for value in values)
        parts.append(_arrays_mapped(context, builder, part, change, *inner))
    return context.make_tuple(builder, typ, parts)


if PLAIN_PYTHON:

    def borrowed(state: Any) -> Any:
        """*state* with its arrays as views without an owner: valid while *state* itself is kept."""
        return state

    def returned(kept: Any, state: Any) -> Any:
        """*state*, each array that still is a borrowed view replaced by that of *kept* in the same place, whose view it is."""
        return state

else:

    @intrinsic
    def borrowed(typing_context: Any, state: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            def view(typ: Any, array: Any) -> Any:
                struct = context.make_array(typ)(context, builder, array)
                struct.meminfo = cgutils.get_null_value(struct.meminfo.type)
                struct.parent = cgutils.get_null_value(struct.parent.type)
                return struct._getvalue()

            return _arrays_mapped(context, builder, state, view, args[0])

        return state(state), generate

    @intrinsic
    def returned(typing_context: Any, kept: Any, state: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            def owner(typ: Any, own: Any, array: Any) -> Any:
                meminfo = context.make_array(typ)(context, builder, array).meminfo
                return builder.select(cgutils.is_null(builder, meminfo), own, array)

            value = _arrays_mapped(context, builder, state, owner, args[0], args[1])
            context.nrt.incref(builder, state, value)
            return value

        return state(kept, state), generate
