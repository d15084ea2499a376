"""Four consecutive float32 as one SIMD register: a velocity and a share."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

WIDTH = 4
_QUAD = ir.VectorType(ir.FloatType(), WIDTH)
_FAST = ("contract", "nsz", "reassoc")


def _pointer(context: Any, builder: Any, array_type: Any, array: Any, row: Any) -> Any:
    data = context.make_array(array_type)(context, builder, array).data
    place = builder.mul(row, ir.Constant(row.type, WIDTH))
    return builder.bitcast(builder.gep(data, [place]), _QUAD.as_pointer())


def _repeated(builder: Any, value: Any) -> Any:
    first = builder.insert_element(ir.Constant(_QUAD, ir.Undefined), value, ir.Constant(ir.IntType(32), 0))
    mask = ir.Constant(ir.VectorType(ir.IntType(32), WIDTH), [0] * WIDTH)
    return builder.shuffle_vector(first, ir.Constant(_QUAD, ir.Undefined), mask)


@intrinsic
def blend_rows(typingctx: Any, rows: Any, indices: Any, weights: Any, out: Any, place: Any) -> Any:
    """``out[place] = sum of weights[n] rows[indices[n]]`` with flat arrays of rows of four.

    LLVM does not find these registers by itself: written out component by component the transport of a field takes
    half as long again.
    """

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        total = ir.Constant(_QUAD, [0.0] * WIDTH)
        for n in range(sig.args[1].count):
            row = builder.extract_value(args[1], n)
            value = builder.load(_pointer(context, builder, sig.args[0], args[0], row))
            value.align = 4
            weight = _repeated(builder, builder.extract_value(args[2], n))
            total = builder.fadd(total, builder.fmul(weight, value, flags=_FAST), flags=_FAST)
        instruction = builder.store(total, _pointer(context, builder, sig.args[3], args[3], args[4]))
        instruction.align = 4
        return context.get_dummy_value()

    corners = len(indices)
    index_type, weight_type = types.UniTuple(types.uintp, corners), types.UniTuple(types.float32, corners)
    return types.none(rows, index_type, weight_type, out, types.uintp), codegen
