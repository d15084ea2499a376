"""What the blades' kernel does with a SIMD register beyond arithmetic: lanes in and out, selection, a power."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from windswept.motion.lanes import _FAST, _VECTOR, WIDTH, _broadcast, _call, lanes

_INTEGERS = ir.VectorType(ir.IntType(32), WIDTH)


def _numbers(value: float) -> Any:
    return ir.Constant(_VECTOR, [value] * WIDTH)


def _integers(value: int) -> Any:
    return ir.Constant(_INTEGERS, [value] * WIDTH)


@intrinsic
def extract(typingctx: Any, value: Any, lane: Any) -> Any:
    """``extract(lanes, i)``: the number in lane i."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.extract_element(args[0], builder.trunc(args[1], ir.IntType(32)))

    return types.float32(lanes, types.uintp), codegen


@intrinsic
def whole(typingctx: Any, value: Any) -> Any:
    """Largest whole number not above each lane."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return _call(builder, "llvm.floor", args[0])

    return lanes(lanes), codegen


@intrinsic
def at_most(typingctx: Any, value: Any, most: Any) -> Any:
    """The value, or the most where it is larger."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        high = _broadcast(builder, args[1])
        return builder.select(builder.fcmp_ordered(">", args[0], high), high, args[0])

    return lanes(lanes, types.float32), codegen


@intrinsic
def within(typingctx: Any, value: Any, most: Any) -> Any:
    """1 where the value is at most ``most``, 0 where it is larger or no number."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        fits = builder.fcmp_ordered("<=", args[0], _broadcast(builder, args[1]))
        return builder.select(fits, _numbers(1.0), _numbers(0.0))

    return lanes(lanes, types.float32), codegen


@intrinsic
def choose(typingctx: Any, flag: Any, yes: Any, no: Any) -> Any:
    """``yes`` where the flag is above one half, else ``no``; the other one may be no number."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.select(builder.fcmp_ordered(">", args[0], _numbers(0.5)), args[1], args[2])

    return lanes(lanes, lanes, lanes), codegen


@intrinsic
def all_set(typingctx: Any, flag: Any) -> Any:
    """Whether every lane is above one half."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        low = builder.fcmp_unordered("<=", args[0], _numbers(0.5))
        return builder.icmp_unsigned(
            "==", builder.bitcast(low, ir.IntType(WIDTH)), ir.Constant(ir.IntType(WIDTH), 0)
        )

    return types.boolean(lanes), codegen


@intrinsic
def transpose(typingctx: Any, a: Any, b: Any, c: Any, d: Any, e: Any, f: Any, g: Any, h: Any) -> Any:
    """Eight registers as rows of a square to its eight columns."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        rows = list(args)
        for span in (1, 2, 4):
            # Blocks of `span` lanes change places across the diagonal of every square of twice that size.
            keep = [i if not i & span else i - span + WIDTH for i in range(WIDTH)]
            swap = [i + span if not i & span else i + WIDTH for i in range(WIDTH)]
            swapped = list(rows)
            for i in (i for i in range(WIDTH) if not i & span):
                for row, mask in ((i, keep), (i + span, swap)):
                    swapped[row] = builder.shuffle_vector(
                        rows[i], rows[i + span], ir.Constant(_INTEGERS, mask)
                    )
            rows = swapped
        return context.make_tuple(builder, sig.return_type, rows)

    return types.UniTuple(lanes, WIDTH)(*[lanes] * WIDTH), codegen


_LOG2 = (1.4426640, -0.72051551, 0.47311335, -0.32461638, 0.19238506, -0.078158208, 0.015127916)
"""log2(1 + m) = m (c0 + c1 m + ...) on 0 to 1, to 4e-7; exactly 0 at 0."""
_EXP2 = (1.0, 0.69314721, 0.24022228, 0.055503272, 0.0096721717, 0.0013400432)
"""2^x on -1/2 to 1/2, to 1e-7; exactly 1 at 0. Both by least squares on Chebyshev's points."""


def _horner(builder: Any, coefficients: tuple[float, ...], x: Any) -> Any:
    value = _numbers(coefficients[-1])
    for coefficient in coefficients[-2::-1]:
        value = builder.fadd(builder.fmul(value, x, flags=_FAST), _numbers(coefficient), flags=_FAST)
    return value


@intrinsic
def power(typingctx: Any, base: Any, exponent: Any) -> Any:
    """``base ** exponent`` for a base from 1 up and one exponent for all lanes, to about 1e-6 of itself."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        bits = builder.bitcast(args[0], _INTEGERS)
        octave = builder.sub(builder.lshr(bits, _integers(23)), _integers(127))
        mantissa = builder.or_(builder.and_(bits, _integers(0x7FFFFF)), _integers(0x3F800000))
        m = builder.fsub(builder.bitcast(mantissa, _VECTOR), _numbers(1.0), flags=_FAST)
        log2 = builder.fadd(
            builder.sitofp(octave, _VECTOR),
            builder.fmul(m, _horner(builder, _LOG2, m), flags=_FAST),
            flags=_FAST,
        )
        x = builder.fmul(log2, _broadcast(builder, args[1]), flags=_FAST)
        rounded = _call(builder, "llvm.floor", builder.fadd(x, _numbers(0.5), flags=_FAST))
        part = _horner(builder, _EXP2, builder.fsub(x, rounded, flags=_FAST))
        shift = builder.shl(builder.fptosi(rounded, _INTEGERS), _integers(23))
        return builder.bitcast(builder.add(builder.bitcast(part, _INTEGERS), shift), _VECTOR)

    return lanes(lanes, types.float32), codegen
