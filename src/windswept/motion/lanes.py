"""One SIMD register as a value that Numba kernels compute with.

A `Lanes` holds WIDTH float32 numbers, one for each of WIDTH placements of the same plant. Kernels that use it read
like the formula for one placement, and vectorise by construction: nothing is left to the compiler's alias analysis.

The same formulas run on plain floats, which is how tests check the kernels: ``a * b + c`` does not care.
"""

from __future__ import annotations

import operator
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core.cgutils import get_or_insert_function
from numba.core.imputils import lower_builtin
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, models, overload, register_model

WIDTH = 8
"""Placements in one register: 8 float32 fill 256 bits, which every x86-64 since 2013 and any wider one does well."""

_VECTOR = ir.VectorType(ir.FloatType(), WIDTH)
FAST_MATH = {"nsz", "contract", "arcp", "afn", "reassoc"}
"""What kernels may do to arithmetic; not "nnan": a broken number must stay one, or it would look like rest."""
_FAST = tuple(sorted(FAST_MATH))


class LanesType(types.Type):
    """Numba's type for one register of WIDTH float32."""

    def __init__(self) -> None:
        super().__init__(name=f"Lanes{WIDTH}")


lanes = LanesType()


@register_model(LanesType)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, dmm: Any, fe_type: Any) -> None:
        super().__init__(dmm, fe_type, _VECTOR)


def _is_operand(kind: Any) -> bool:
    return isinstance(kind, (LanesType, types.Float, types.Integer))


class _LanesArithmetic(AbstractTemplate):
    """``lanes op lanes`` and ``lanes op number`` give lanes."""

    def generic(self, args: Any, kws: Any) -> Any:
        if len(args) == 2 and lanes in args and all(_is_operand(a) for a in args):
            return signature(lanes, *(lanes if isinstance(a, LanesType) else types.float32 for a in args))
        return None


class _LanesNegation(AbstractTemplate):
    def generic(self, args: Any, kws: Any) -> Any:
        return signature(lanes, lanes) if args == (lanes,) else None


def _broadcast(builder: Any, value: Any) -> Any:
    one = builder.insert_element(ir.Constant(_VECTOR, ir.Undefined), value, ir.Constant(ir.IntType(32), 0))
    mask = ir.Constant(ir.VectorType(ir.IntType(32), WIDTH), [0] * WIDTH)
    return builder.shuffle_vector(one, ir.Constant(_VECTOR, ir.Undefined), mask)


def _lower_binary(op: Any, instruction: str) -> None:
    def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        a, b = (
            v if isinstance(t, LanesType) else _broadcast(builder, v)
            for t, v in zip(sig.args, args, strict=True)
        )
        return getattr(builder, instruction)(a, b, flags=_FAST)

    for pair in ((lanes, lanes), (lanes, types.float32), (types.float32, lanes)):
        lower_builtin(op, *pair)(lower)


for _op, _instruction in (
    (operator.add, "fadd"),
    (operator.sub, "fsub"),
    (operator.mul, "fmul"),
    (operator.truediv, "fdiv"),
):
    infer_global(_op)(_LanesArithmetic)
    _lower_binary(_op, _instruction)

infer_global(operator.neg)(_LanesNegation)


@lower_builtin(operator.neg, lanes)
def _lower_negation(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return builder.fsub(ir.Constant(_VECTOR, [0.0] * WIDTH), args[0], flags=_FAST)


def _element_pointer(context: Any, builder: Any, array_type: Any, array: Any, index: Any) -> Any:
    data = context.make_array(array_type)(context, builder, array).data
    pointer = builder.gep(data, [index])
    return builder.bitcast(pointer, _VECTOR.as_pointer())


@intrinsic
def load(typingctx: Any, array: Any, index: Any) -> Any:
    """``load(flat, i)``: the WIDTH numbers from ``flat[i]`` on, as Lanes."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        value = builder.load(_element_pointer(context, builder, sig.args[0], args[0], args[1]))
        value.align = 4
        return value

    return lanes(array, types.uintp), codegen


@intrinsic
def store(typingctx: Any, array: Any, index: Any, value: Any) -> Any:
    """``store(flat, i, lanes)``: writes WIDTH numbers from ``flat[i]`` on."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        instruction = builder.store(
            args[2], _element_pointer(context, builder, sig.args[0], args[0], args[1])
        )
        instruction.align = 4
        return context.get_dummy_value()

    return types.none(array, types.uintp, lanes), codegen


def _call(builder: Any, name: str, *args: Any) -> Any:
    function_type = ir.FunctionType(_VECTOR, [_VECTOR] * len(args))
    function = get_or_insert_function(builder.module, function_type, f"{name}.v{WIDTH}f32")
    return builder.call(function, args, fastmath=_FAST)


@intrinsic
def _lanes_sqrt(typingctx: Any, value: Any) -> Any:
    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return _call(builder, "llvm.sqrt", args[0])

    return lanes(lanes), codegen


@intrinsic
def _lanes_settled(typingctx: Any, value: Any, threshold: Any) -> Any:
    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        size = _call(builder, "llvm.fabs", args[0])
        small = builder.fcmp_ordered("<", size, _broadcast(builder, args[1]))
        return builder.select(small, ir.Constant(_VECTOR, [0.0] * WIDTH), args[0])

    return lanes(lanes, types.float32), codegen


@intrinsic
def _lanes_at_least(typingctx: Any, value: Any, least: Any) -> Any:
    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        low = _broadcast(builder, args[1])
        return builder.select(builder.fcmp_ordered("<", args[0], low), low, args[0])

    return lanes(lanes, types.float32), codegen


@intrinsic
def _lanes_clamped(typingctx: Any, value: Any, limit: Any) -> Any:
    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        high = _broadcast(builder, args[1])
        low = builder.fsub(ir.Constant(_VECTOR, [0.0] * WIDTH), high, flags=_FAST)
        capped = builder.select(builder.fcmp_ordered(">", args[0], high), high, args[0])
        return builder.select(builder.fcmp_ordered("<", capped, low), low, capped)

    return lanes(lanes, types.float32), codegen


def sqrt(value: Any) -> Any:
    """Square root of Lanes or of a number."""
    return np.float32(np.sqrt(value))


def at_least(value: Any, least: float) -> Any:
    """The value, or the least where it is smaller."""
    return max(value, least)


def clamped(value: Any, limit: float) -> Any:
    """The value, held between -limit and limit."""
    return min(max(value, -limit), limit)


def settled(value: Any, threshold: float) -> Any:
    """The value, or exactly 0 where it is smaller than the threshold (denormal numbers are very slow)."""
    return value if abs(value) >= threshold else np.float32(0.0)


@overload(sqrt, inline="always")
def _sqrt(value):  # type: ignore[no-untyped-def]
    if isinstance(value, LanesType):
        return lambda value: _lanes_sqrt(value)
    return lambda value: np.sqrt(value)


@overload(settled, inline="always")
def _settled(value, threshold):  # type: ignore[no-untyped-def]
    if isinstance(value, LanesType):
        return lambda value, threshold: _lanes_settled(value, threshold)
    return lambda value, threshold: value if abs(value) >= threshold else np.float32(0.0)


@overload(clamped, inline="always")
def _clamped(value, limit):  # type: ignore[no-untyped-def]
    if isinstance(value, LanesType):
        return lambda value, limit: _lanes_clamped(value, limit)
    return lambda value, limit: min(max(value, -limit), limit)


@overload(at_least, inline="always")
def _at_least(value, least):  # type: ignore[no-untyped-def]
    if isinstance(value, LanesType):
        return lambda value, least: _lanes_at_least(value, least)
    return lambda value, least: max(value, least)
