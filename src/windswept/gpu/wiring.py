"""Shader modules, bind group layouts and pipelines: small wrappers that name what a wgpu descriptor repeats."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from typing import Any

import wgpu

SHADER_SETS = {
    "curves": ("types", "rotation", "curves"),
    "bark": ("types", "light", "pieces", "bark"),
    "bend": ("motion", "air", "bend_types", "bend_frame", "bend_air", "bend"),
    "bend_bark": ("types", "light", "bend_types", "bend_frame", "bend_pieces", "bark"),
    "leaves": ("types", "light", "leaves"),
    "ground": ("types", "light", "meadow", "ground"),
    "grass": ("types", "light", "meadow", "grass"),
    "blades_pose": ("types", "light", "meadow", "rotation", "blades_types", "blades_light", "blades_pose"),
    "blades": ("types", "blades_types", "blades"),
    "lean": ("air_grid", "lean_types", "lean"),
    "blade_choice": ("scan", "blade_choice_types", "blade_choice"),
    "balls": ("types", "light", "rotation", "balls"),
    "sky": ("types", "light", "sky"),
    "wind": ("motion", "air", "air_grid", "wind"),
    "springs": ("motion", "rotation", "groups", "springs"),
    "multibody": (
        "motion",
        "rotation",
        "groups",
        "multibody_types",
        "multibody_tensors",
        "multibody_joint",
        "multibody_descend",
        "multibody_ascend",
        "multibody_advance",
        "multibody",
    ),
    "multibody_change": ("motion", "rotation", "multibody_types", "multibody_joint", "multibody_change"),
    "choose": ("motion", "scan", "choose"),
    "members": ("motion", "scan", "members"),
    "plan": ("motion", "scan", "plan"),
    "shift_state": ("motion", "shift_state"),
    "carry_over": ("motion", "rotation", "joints", "carry_over"),
    "fit_groups": ("motion", "rotation", "joints", "fit_groups"),
    "pose_links": ("motion", "rotation", "joints", "pose_links"),
    "crown": ("motion", "crown"),
    "lawn": ("scan", "lawn"),
    "cull": ("cull_types", "scan", "cull"),
    "cull_places": ("types", "scan", "cull_types", "cull_places"),
}
"""Files of ``shaders/`` that make up each module, one after the other."""

ALL_STAGES = wgpu.ShaderStage.VERTEX | wgpu.ShaderStage.FRAGMENT | wgpu.ShaderStage.COMPUTE
COMPUTE = wgpu.ShaderStage.COMPUTE
DRAWING = wgpu.ShaderStage.VERTEX | wgpu.ShaderStage.FRAGMENT
DEPTH_FORMAT = "depth32float"

UNIFORM = {"type": "uniform"}
DYNAMIC_UNIFORM = {"type": "uniform", "has_dynamic_offset": True}
READ = {"type": "read-only-storage"}
WRITE = {"type": "storage"}
TEXTURE = {"sample_type": "unfilterable-float"}
"""Of float32 texels that are loaded, not sampled."""


def shader_text(name: str) -> str:
    """WGSL of one set of ``SHADER_SETS``."""
    folder = files("windswept.gpu") / "shaders"
    return "\n".join((folder / f"{part}.wgsl").read_text(encoding="utf-8") for part in SHADER_SETS[name])


@cache
def shader_module(device: Any, name: str) -> Any:
    """Compiled module of one set of ``SHADER_SETS``."""
    return device.create_shader_module(label=name, code=shader_text(name))


def buffers_layout(device: Any, stages: int, *buffers: dict[str, Any]) -> Any:
    """Bind group layout of buffers at bindings 0, 1, 2, ..."""
    return group_layout(device, stages, {place: {"buffer": kind} for place, kind in enumerate(buffers)})


def group_layout(device: Any, stages: int, kinds: dict[int, dict[str, Any]]) -> Any:
    """Bind group layout of resources of some kinds at the bindings given."""
    entries = [{"binding": place, "visibility": stages, **kind} for place, kind in kinds.items()]
    return device.create_bind_group_layout(entries=entries)


def bind(device: Any, layout: Any, *resources: Any) -> Any:
    """Bind group of resources at bindings 0, 1, 2, ...; buffers are bound whole."""
    return group_of(device, layout, dict(enumerate(resources)))


def group_of(device: Any, layout: Any, resources: dict[int, Any]) -> Any:
    """Bind group of resources at the bindings given; buffers are bound whole."""
    entries = []
    for place, resource in resources.items():
        if isinstance(resource, wgpu.GPUBuffer):
            resource = {"buffer": resource, "offset": 0, "size": resource.size}
        entries.append({"binding": place, "resource": resource})
    return device.create_bind_group(layout=layout, entries=entries)


def compute_pipeline(
    device: Any, layouts: list[Any], module: str, entry: str, constants: dict[str, float] | None = None
) -> Any:
    """Compute pipeline with the given bind group layouts and values of the shader's overrides."""
    return device.create_compute_pipeline(
        layout=device.create_pipeline_layout(bind_group_layouts=layouts),
        compute={
            "module": shader_module(device, module),
            "entry_point": entry,
            "constants": constants or {},
        },
    )


def shadow_pipeline(device: Any, layouts: list[Any], module: str, constants: dict[str, float]) -> Any:
    """Depth-only pipeline into the shadow map."""
    return device.create_render_pipeline(
        layout=device.create_pipeline_layout(bind_group_layouts=layouts),
        vertex={
            "module": shader_module(device, module),
            "entry_point": "shadow",
            "buffers": [],
            "constants": constants,
        },
        primitive={"topology": "triangle-list", "cull_mode": "none"},
        depth_stencil={
            "format": DEPTH_FORMAT,
            "depth_write_enabled": True,
            "depth_compare": "less",
            "depth_bias": 1,
            "depth_bias_slope_scale": 1.5,
        },
    )


def colour_pipeline(
    device: Any,
    layouts: list[Any],
    module: str,
    colour_format: str,
    samples: int,
    constants: dict[str, float] | None = None,
    cull: str = "none",
    vertex_buffers: list[dict[str, Any]] | None = None,
    lit: str = "",
) -> Any:
    """Pipeline into the picture; depth runs from 1 near to 0 at infinity.

    Args:
        device: the card.
        layouts: of the bind groups.
        module: name of the shader set.
        colour_format: of the picture.
        samples: of the picture.
        constants: values of the shader's overrides.
        cull: side of triangles that is not drawn.
        vertex_buffers: layouts, where vertices are not pulled.
        lit: ending of the entry points; "_lit" where light is worked out at the vertices.
    """
    shader = shader_module(device, module)
    return device.create_render_pipeline(
        layout=device.create_pipeline_layout(bind_group_layouts=layouts),
        vertex={
            "module": shader,
            "entry_point": "vertex" + lit,
            "buffers": vertex_buffers or [],
            "constants": constants or {},
        },
        primitive={"topology": "triangle-list", "cull_mode": cull},
        depth_stencil={
            "format": DEPTH_FORMAT,
            "depth_write_enabled": module != "sky",
            "depth_compare": "greater-equal",
        },
        multisample={"count": samples},
        fragment={
            "module": shader,
            "entry_point": "fragment" + lit,
            "targets": [{"format": colour_format}],
        },
    )
