"""Frame -> picture: poses plants on the card, then draws shadows, plants, grass, ground and sky."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import wgpu
from numpy.typing import NDArray

from windswept.geometry.detail import SOFTWARE_RULES, DetailRules
from windswept.geometry.geometry import Geometry
from windswept.gpu import layouts
from windswept.gpu.backdrop import Backdrop
from windswept.gpu.balls import Balls
from windswept.gpu.buffers import UNIFORM
from windswept.gpu.culling import Culling, Tally, Told, told_of
from windswept.gpu.daylight import EXTINCTION, daylight
from windswept.gpu.device import is_software, shared_device
from windswept.gpu.draw_list import DrawList, View, draw_list
from windswept.gpu.draw_plan import DrawPlan
from windswept.gpu.failures import card_errors
from windswept.gpu.fitting import followed_detail, most_detail
from windswept.gpu.frame import FLAT_GROUND, CardMotion, Frame, Ground
from windswept.gpu.lighting import SHADOW_TEXELS, Lighting
from windswept.gpu.matrices import camera_matrix, frustum_planes, shadow_ball, sun_matrix
from windswept.gpu.meadow import MeadowDrawing
from windswept.gpu.meadow.blade_list import SOFTWARE_BLADES, BladeRules, Sharpness
from windswept.gpu.plant_buffers import plant_arrays
from windswept.gpu.plant_drawing import PlantDrawing
from windswept.gpu.posing import Posing
from windswept.gpu.stage_times import StageTimes
from windswept.gpu.wiring import ALL_STAGES, DEPTH_FORMAT, bind, buffers_layout
from windswept.gpu.wiring import UNIFORM as UNIFORM_BINDING
from windswept.plants.plant import Look, Plant
from windswept.scene.meadow_bed import Bed

SAMPLES = 4
"""Of a pixel (MSAA)."""
SHADOW_REACH = (20.0, 120.0)
"""Least and greatest distance from the camera to which shadows are drawn, m; twice that of its target if between."""
PICTURE_FORMAT = "rgba8unorm-srgb"
STAGES = ("lawn", "choose", "cull", "curves", "shadows", "blades", "picture")
"""Of a frame, as they are timed."""


@dataclass(frozen=True, slots=True)
class Canvas:
    """What pipelines have to fit that draw into a renderer's pictures."""

    device: Any
    frame_layout: Any
    """Of bind group 0."""
    light_layout: Any
    """Of bind group 2."""
    picture: tuple[str, int]
    """Colour format and samples of a pixel."""


class Drawing(Protocol):
    """Something else that a renderer draws beside its plants."""

    def draw_shadows(self, render_pass: Any) -> None:
        """Record the draws into the shadow map; bind group 0 is set."""

    def draw(self, render_pass: Any) -> None:
        """Record the draws into the picture; bind groups 0 and 2 are set."""


class Renderer:
    """Everything that stays the same from frame to frame.

    Args:
        plants: one of each kind.
        geometries: the drawn form of each.
        ground: terrain heights.
        size: width and height of the picture, pixels.
        rules: what may be spent; by default what suits the device.
        colour_format: of the views that ``draw_into`` gets.
        extra_looks: that placements may wear instead of their plant's own.
        beds: blades of underbrush; where there are some, no lawn is made up round the camera.
        blade_rules: what may be spent on them; by default what suits the device.

    Raises:
        GraphicsError: there is no graphics adapter, or it has too little room. So do all methods where it is lost.
    """

    @card_errors("drawing pictures")
    def __init__(
        self,
        plants: list[Plant],
        geometries: list[Geometry],
        ground: Ground = FLAT_GROUND,
        size: tuple[int, int] = (1280, 720),
        rules: DetailRules | None = None,
        colour_format: str = PICTURE_FORMAT,
        extra_looks: tuple[Look, ...] = (),
        beds: tuple[Bed, ...] = (),
        blade_rules: BladeRules | None = None,
    ) -> None:
        self._device = shared_device()
        self._rules = rules or (SOFTWARE_RULES if is_software(self._device) else DetailRules())
        self._ground = ground
        looks = [*(plant.look for plant in plants), *extra_looks]
        arrays = plant_arrays(plants, geometries, looks, self._rules)
        self.kinds = arrays.kinds
        self._frame_layout = buffers_layout(self._device, ALL_STAGES, UNIFORM_BINDING)
        self._uniforms = self._device.create_buffer(size=layouts.FRAME.itemsize, usage=UNIFORM)
        self._frame_group = bind(self._device, self._frame_layout, self._uniforms)
        self._lighting = Lighting(self._device)
        self.posing = Posing(self._device, self._frame_layout, arrays)
        shared = (self._frame_layout, self._lighting.layout, colour_format, SAMPLES)
        self._plant_drawing = PlantDrawing(self._device, self.posing, *shared)
        self._plan = DrawPlan(self._device, self._plant_drawing.meshes)
        self.culling = Culling(self._device, self.kinds, self._rules, self._plan)
        self._tally = Tally(self._device, self._plan)
        self._told = Told((0, 0, 0, 0), 0, 0, 0, 0)
        self._detail = 1.0
        self._backdrop = Backdrop(self._device, ground, *shared)
        self.meadow: MeadowDrawing | None = None
        if beds:
            spent = blade_rules or (SOFTWARE_BLADES if is_software(self._device) else BladeRules())
            picture = colour_format, SAMPLES
            self.meadow = MeadowDrawing(
                self._device, beds, spent, self._frame_layout, self._lighting.layout, picture
            )
        self._colour_format = colour_format
        self._times = StageTimes(self._device, STAGES)
        self.canvas = Canvas(
            self._device, self._frame_layout, self._lighting.layout, (colour_format, SAMPLES)
        )
        self._balls = Balls(self._device, self._frame_layout, self._lighting.layout, (colour_format, SAMPLES))
        self.beside: list[Drawing] = [self._balls]
        self.resize(size)

    @card_errors("drawing pictures")
    def resize(self, size: tuple[int, int]) -> None:
        """Draw pictures of another width and height, pixels, from now on."""
        self.size = size
        width, height = size

        def attachment(texture_format: str, samples: int, usage: int = 0) -> Any:
            return self._device.create_texture(
                size=(width, height, 1),
                format=texture_format,
                sample_count=samples,
                usage=wgpu.TextureUsage.RENDER_ATTACHMENT | usage,
            )

        self._colour = attachment(self._colour_format, SAMPLES).create_view()
        self._depth = attachment(DEPTH_FORMAT, SAMPLES).create_view()
        self._picture = attachment(self._colour_format, 1, wgpu.TextureUsage.COPY_SRC)
        self._picture_view = self._picture.create_view()

    @card_errors("drawing pictures")
    def draw(self, frame: Frame) -> NDArray[np.uint8]:
        """(height, width, 4) sRGB picture with alpha 255."""
        if frame.motion is not None:
            self._fit_plants(frame, frame.motion, self._look(frame)[0])
        self.draw_aside(frame)
        width, height = self.size
        data = self._device.queue.read_texture(
            {"texture": self._picture},
            {"bytes_per_row": 4 * width, "rows_per_image": height},
            (width, height, 1),
        )
        return np.frombuffer(data, np.uint8).reshape(height, width, 4)

    @card_errors("drawing pictures")
    def draw_aside(self, frame: Frame) -> Told:
        """Draw a frame and leave the picture on the card.

        Returns:
            What was drawn: the counts that a window shows; of a frame whose motion is on the card, a few frames late.
        """
        scene_view, uniforms = self._look(frame)
        self._device.queue.write_buffer(self._uniforms, 0, uniforms)
        eye = np.asarray(frame.camera.eye, np.float64)
        if self.meadow is not None and frame.meadow is not None:
            pixels = 0.5 * self.size[1] / np.tan(0.5 * frame.camera.fov_y)
            self.meadow.upload(frame.meadow, Sharpness(eye, scene_view.planes, float(pixels)))
        self._balls.upload(frame.balls)
        encoder = self._device.create_command_encoder()
        if self.meadow is None:
            self._backdrop.encode(encoder, eye, scene_view.planes, self._times.around("lawn"))
        elif frame.meadow is not None:
            self.meadow.choose(encoder, self._times.around("choose"))
        if frame.motion is None:
            self._list_plants(frame, scene_view)
        else:
            self._encode_plants(encoder, frame, frame.motion, scene_view)
        self.posing.encode(encoder, self._frame_group, self._plan, self._times.around("curves"))
        self._encode_shadows(encoder)
        if self.meadow is not None:
            self._encode_blades(encoder, self.meadow)
        self._encode_picture(encoder)
        self._device.queue.submit([encoder.finish()])
        if frame.motion is not None:
            self._tally.submitted()
        return self._told

    @card_errors("drawing pictures")
    def copy_into(self, texture: Any) -> None:
        """Copy the picture that was drawn last into a texture of this renderer's format, as far as both reach."""
        size = *map(min, self.size, texture.size[:2]), 1
        encoder = self._device.create_command_encoder()
        encoder.copy_texture_to_texture({"texture": self._picture}, {"texture": texture}, size)
        self._device.queue.submit([encoder.finish()])

    def _list_plants(self, frame: Frame, view: View) -> None:
        """Chooses what is drawn here, and sends it with its poses."""
        wanted = self._list_that_fits(frame, view)
        self.posing.upload(frame.plants, wanted)
        self._plan.write(wanted)
        self._told = told_of(wanted)

    def _fit_plants(self, frame: Frame, motion: CardMotion, view: View) -> None:
        """Makes room for what a picture draws, and finds the detail for which there is some; waits for the card."""
        self.culling.place(frame.plants)

        def fits(share: float) -> bool:
            encoder = self._device.create_command_encoder()
            self.culling.record(encoder, view.coarser(share), self.posing.room, motion.speeds, {})
            self._device.queue.submit([encoder.finish()])
            told = self.told_now
            return not told.refused or (self._has_grown(told) and fits(share))

        self._detail = most_detail(fits)

    def _encode_plants(self, encoder: Any, frame: Frame, motion: CardMotion, view: View) -> None:
        """Has the card choose what is drawn, and pose it; nothing of a placement is uploaded but when it is new."""
        if self.culling.place(frame.plants):
            self._fit_plants(frame, motion, view)
        told = self._tally.late(self.culling.shortened)
        if told is not None:
            self._told = told
            if not self._has_grown(told):
                self._detail = followed_detail(self._detail, told, self.posing.room)
        room, timestamps = self.posing.room, self._times.around("cull")
        self.culling.record(encoder, view.coarser(self._detail), room, motion.speeds, timestamps)
        motion.pose(encoder, self.culling.seating(self.posing.links.buffer))
        self._tally.copy(encoder)

    def _has_grown(self, told: Told) -> bool:
        """Makes room for what lacked some, as far as this card takes it; says whether that helps."""
        wanted = self.posing.affordable(told.wanted)
        lacks = any(rows > had for rows, had in zip(wanted, self.posing.room, strict=True))
        if lacks:
            self.posing.reserve(wanted)
        return lacks

    def _list_that_fits(self, frame: Frame, view: View) -> DrawList:
        """What is drawn, in the detail of a smaller picture where this card has no room for that of this one."""
        lists: dict[float, DrawList] = {}

        def fits(share: float) -> bool:
            lists[share] = draw_list(self.kinds, frame.plants, view.coarser(share), self._rules)
            return self.posing.affordable(lists[share].counts) == lists[share].counts

        share = most_detail(fits)
        if share not in lists:
            fits(share)
        return lists[share]

    @property
    def stage_milliseconds(self) -> dict[str, float]:
        """How long each stage of the last frame took on the card; waits for it, and is empty where it has no clock."""
        return self._times.read()

    @property
    def told_now(self) -> Told:
        """What became of the last frame whose motion was on the card; waits for it."""
        return self._tally.now(self.culling.shortened)

    @property
    def plant_bytes(self) -> int:
        """Memory of plants at rest, of what is chosen and of what is posed."""
        return self.posing.bytes + self.culling.bytes

    def drawn_counts(self, frame: Frame) -> tuple[int, int]:
        """Stem pieces and leaves that a frame's detail comes to, shadows' own included."""
        wanted = draw_list(self.kinds, frame.plants, self._look(frame)[0], self._rules)
        return wanted.piece_count, wanted.leaf_count

    def _encode_shadows(self, encoder: Any) -> None:
        render_pass = encoder.begin_render_pass(
            color_attachments=[],
            depth_stencil_attachment={
                "view": self._lighting.shadow_view,
                "depth_clear_value": 1.0,
                "depth_load_op": "clear",
                "depth_store_op": "store",
            },
            **self._times.around("shadows"),
        )
        render_pass.set_bind_group(0, self._frame_group)
        self._plant_drawing.draw_shadows(render_pass, self._plan)
        for drawing in self.beside:
            drawing.draw_shadows(render_pass)
        render_pass.end()

    def _encode_blades(self, encoder: Any, meadow: MeadowDrawing) -> None:
        """Poses and lights the blades; the shadows of the trees are there already."""
        compute_pass = encoder.begin_compute_pass(**self._times.around("blades"))
        compute_pass.set_bind_group(0, self._frame_group)
        compute_pass.set_bind_group(2, self._lighting.group)
        meadow.encode(compute_pass)
        compute_pass.end()

    def _encode_picture(self, encoder: Any) -> None:
        render_pass = encoder.begin_render_pass(
            color_attachments=[
                {
                    "view": self._colour,
                    "resolve_target": self._picture_view,
                    "clear_value": (0.0, 0.0, 0.0, 1.0),
                    "load_op": "clear",
                    "store_op": "discard",
                }
            ],
            depth_stencil_attachment={
                "view": self._depth,
                "depth_clear_value": 0.0,
                "depth_load_op": "clear",
                "depth_store_op": "discard",
            },
            **self._times.around("picture"),
        )
        render_pass.set_bind_group(0, self._frame_group)
        render_pass.set_bind_group(2, self._lighting.group)
        self._plant_drawing.draw(render_pass, self._plan)
        for drawing in self.beside:
            drawing.draw(render_pass)
        if self.meadow is None:
            self._backdrop.draw_near(render_pass)
        else:
            self.meadow.draw(render_pass)
        self._backdrop.draw_far(render_pass)
        render_pass.end()

    def _look(self, frame: Frame) -> tuple[View, NDArray[np.void]]:
        """What can be seen, and the uniforms that say so to the shaders."""
        width, height = self.size
        sun = np.asarray(frame.sun, np.float64)
        sun = sun / np.linalg.norm(sun)
        camera = camera_matrix(frame.camera, width / height)
        to_target = float(np.linalg.norm(np.subtract(frame.camera.target, frame.camera.eye)))
        reach = float(np.clip(2.0 * to_target, *SHADOW_REACH))
        centre, radius = shadow_ball(frame.camera, width / height, reach)
        light = daylight(sun)
        rows = np.zeros(1, layouts.FRAME)
        rows["view_projection"] = camera.T
        rows["clip_to_world"] = np.linalg.inv(camera).T
        rows["sun_projection"] = sun_matrix(sun, centre, radius, 6.0 * radius, SHADOW_TEXELS).T
        rows["eye"] = *frame.camera.eye, frame.time
        rows["sun"] = *sun, 2.0 * radius / SHADOW_TEXELS
        rows["sun_light"] = *light.sun, light.exposure
        rows["sky_light"] = *light.sky, 0.0
        rows["haze"] = *light.haze, EXTINCTION
        rows["wind"] = *frame.wind, frame.wind[0] * frame.time, frame.wind[1] * frame.time
        rows["terrain"] = *self._ground.origin, self._ground.spacing, self.meadow is not None
        texel = 2.0 * radius / SHADOW_TEXELS
        return View(
            frame.camera,
            height,
            frustum_planes(camera),
            sun,
            centre,
            radius,
            texel,
        ), rows
