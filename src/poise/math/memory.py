"""State that stays on the compiled side between calls: boxing it costs some 2 us per nested tuple."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba.core import cgutils, types
from numba.experimental import structref
from numba.extending import intrinsic

from poise.math.compiled import PLAIN_PYTHON

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
