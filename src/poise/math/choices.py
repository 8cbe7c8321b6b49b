"""Choices: a parameter that names one of a few texts, at the cost of comparing two integers in a kernel."""

from __future__ import annotations

import operator
import zlib
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import NativeValue, intrinsic, models, overload, register_model, typeof_impl, unbox

from poise.math.compiled import PLAIN_PYTHON


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
