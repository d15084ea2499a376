"""Lanes from WIDTH different places of an array: what children read of their parents."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from windswept.motion.lanes import _VECTOR, WIDTH, lanes


@intrinsic
def gather(typingctx: Any, flat: Any, places: Any, first: Any, shift: Any) -> Any:
    """``gather(flat, places, i, shift)``: number ``flat[places[i + lane] + shift]`` in each lane."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        flat, places = (
            context.make_array(kind)(context, builder, value).data
            for kind, value in zip(sig.args[:2], args[:2], strict=True)
        )
        gathered = ir.Constant(_VECTOR, ir.Undefined)
        for lane in range(WIDTH):
            at = builder.add(args[2], ir.Constant(args[2].type, lane))
            place = builder.zext(builder.load(builder.gep(places, [at])), args[3].type)
            value = builder.load(builder.gep(flat, [builder.add(place, args[3])]))
            gathered = builder.insert_element(gathered, value, ir.Constant(ir.IntType(32), lane))
        return gathered

    return lanes(flat, places, types.uintp, types.uintp), codegen
