"""What everything coloured is lit with: the shadow map of the sun and the noise texture, in bind group 2."""

from __future__ import annotations

from typing import Any

import wgpu

from windswept.gpu.noise import SIZE, noise_levels
from windswept.gpu.wiring import ALL_STAGES, DEPTH_FORMAT, bind

SHADOW_TEXELS = 2048
"""Side of the shadow map."""


class Lighting:
    """The shadow map, the noise texture and their bind group.

    Args:
        device: the card.
    """

    def __init__(self, device: Any) -> None:
        self.shadow_view = device.create_texture(
            size=(SHADOW_TEXELS, SHADOW_TEXELS, 1),
            format=DEPTH_FORMAT,
            usage=wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.TEXTURE_BINDING,
        ).create_view()
        self.layout = device.create_bind_group_layout(
            entries=[
                {"binding": 0, "visibility": ALL_STAGES, "texture": {"sample_type": "depth"}},
                {"binding": 1, "visibility": ALL_STAGES, "sampler": {"type": "comparison"}},
                {"binding": 2, "visibility": ALL_STAGES, "texture": {"sample_type": "float"}},
                {"binding": 3, "visibility": ALL_STAGES, "sampler": {"type": "filtering"}},
            ]
        )
        shadow_sampler = device.create_sampler(mag_filter="linear", min_filter="linear", compare="less-equal")
        noise_sampler = device.create_sampler(
            address_mode_u="repeat",
            address_mode_v="repeat",
            mag_filter="linear",
            min_filter="linear",
            mipmap_filter="linear",
        )
        noise = _noise_texture(device).create_view()
        self.group = bind(device, self.layout, self.shadow_view, shadow_sampler, noise, noise_sampler)


def _noise_texture(device: Any) -> Any:
    levels = noise_levels()
    texture = device.create_texture(
        size=(SIZE, SIZE, 1),
        format="rgba8unorm",
        mip_level_count=len(levels),
        usage=wgpu.TextureUsage.TEXTURE_BINDING | wgpu.TextureUsage.COPY_DST,
    )
    for number, level in enumerate(levels):
        side = len(level)
        device.queue.write_texture(
            {"texture": texture, "mip_level": number},
            level,
            {"bytes_per_row": 4 * side, "rows_per_image": side},
            (side, side, 1),
        )
    return texture
