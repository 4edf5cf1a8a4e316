#!/usr/bin/env python3
"""Makes RasterCheck's case files of the draws in a RenderDoc capture of Vulkan or OpenGL.

    rdc2case.py FILE.rdc                              lists the draws of the captured frame
    rdc2case.py FILE.rdc --draw EVENT                 prints the case of one draw
    rdc2case.py FILE.rdc --draw EVENT --output CASE   writes it to a file
    rdc2case.py FILE.rdc --all --output FOLDER        writes FOLDER/event-EVENT.json for every draw

A case has the vertices as the vertex stage leaves them on this machine, bit for bit, and the state
of the rasterizer. Standard error says what is left out because a case cannot hold it.

Needs nothing but RenderDoc's Python module (Debian: python3-renderdoc; tried with 1.24) and a
machine that can replay the capture. Exit code 2 if the input is bad or no case could be written.
"""

import argparse
import json
import math
import os
import re
import struct
import sys
from typing import Any, List, NamedTuple, Optional, Tuple

MAX_SIZE, MAX_ATTRIBUTES, MAX_CLIP_DISTANCES = 16384, 32, 8


class Unsayable(Exception):
    """A draw that a case cannot hold; the message says why."""


class BadInput(Exception):
    """A file or an option that cannot be used; the message says why."""


# A draw as plain data, and its case. This part does not need RenderDoc.


class Column(NamedTuple):
    """One number that the vertex stage wrote for each vertex."""
    kind: str  # "attribute" or "clip distance"
    name: str
    values: List[float]
    interpolation: str = "smooth"
    location: str = "sample"


class Draw(NamedTuple):
    name: str
    rules: str  # "vulkan" or "opengl"
    size: Tuple[int, int]  # of the framebuffer, in pixels
    samples: int
    viewport: Tuple[float, ...]  # x, y, width, height, near and far end of the depth range
    scissor: Optional[Tuple[int, ...]]  # x, y, width, height; None: not enabled
    topology: str  # "list", "strip" or "fan"
    provoking: str  # "first" or "last": the vertex that flat attributes come from
    positions: List[Tuple[float, ...]]  # clip coordinates
    columns: List[Column]
    strips: List[List[int]]  # vertices in the order drawn, parted at restarts and instances
    cull: str = "none"
    front_face: str = "ccw"
    depth_clamp: bool = False
    depth_clear: Optional[float] = None  # None: no depth test
    depth_bias: Optional[Tuple[float, ...]] = None  # constant, slope, clamp; None: nothing is added
    depth_format: str = "float32"


def is_turned(draw):
    """True if flat attributes come from another vertex than in a case, which has them from the
    first in Vulkan and from the last in OpenGL."""
    of_case = "last" if draw.rules == "opengl" else "first"
    return draw.provoking != of_case and any(c.interpolation == "flat" for c in draw.columns)


def triangles_of(draw):
    """The triangles of a draw, each turned if the draw is, which keeps their facing."""
    is_last, triangles = draw.provoking == "last", []
    for strip in draw.strips:
        for i in range(0, len(strip) - 2, 3 if draw.topology == "list" else 1):
            a, b, c = strip[i:i + 3]
            if draw.topology == "fan":
                a, b, c = (strip[0], b, c) if is_last else (b, c, strip[0])
            elif draw.topology == "strip" and i % 2 == 1:
                a, b, c = (b, a, c) if is_last else (a, c, b)
            if is_turned(draw):
                a, b, c = (c, a, b) if is_last else (b, c, a)
            triangles.append((a, b, c))
    return triangles


def plural(count, noun):
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def held_columns(draw, used, kind, most, notes):
    """The columns of a kind that a case can hold."""
    every = [column for column in draw.columns if column.kind == kind]
    finite = [column for column in every if all(math.isfinite(column.values[i]) for i in used)]
    lost = [column.name for column in every if column not in finite]
    if lost:
        notes.append(f"left out {kind} {', '.join(lost)}: has NaN or infinity")
    if len(finite) > most:
        names = ", ".join(column.name for column in finite[most:])
        notes.append(f"left out {kind} {names}: a case has {most} at most")
    return finite[:most]


def refuse(*reasons):
    """Raises Unsayable with the first reason whose condition holds."""
    for is_so, why in reasons:
        if is_so:
            raise Unsayable(why)


def scissor_of(draw):
    """The part of the scissor rectangle that lies in the framebuffer; None if that is all of it."""
    if draw.scissor is None:
        return None
    x, y, width, height = draw.scissor
    left, right = (min(max(at, 0), draw.size[0]) for at in (x, x + width))
    low, high = (min(max(at, 0), draw.size[1]) for at in (y, y + height))
    if (left, low, right, high) == (0, 0, *draw.size):
        return None
    return {"x": left, "y": low, "width": right - left, "height": high - low}


def hex_float(value):
    """A float32 as case files have it."""
    digits, _, exponent = value.hex().partition("p")
    return f"{digits.rstrip('0').rstrip('.') if '.' in digits else digits}p{exponent}"


def case_of(draw):
    """The case of a draw, and a note for everything left out."""
    refuse((not all(1 <= side <= MAX_SIZE for side in draw.size),
            f"its framebuffer is not of 1 to {MAX_SIZE} pixels a side"),
           (draw.samples not in (1, 2, 4, 8, 16), f"it has {draw.samples} samples per pixel"),
           (not all(map(math.isfinite, draw.viewport)) or
            max(map(abs, draw.viewport[2:4])) > MAX_SIZE,
            f"its viewport has a side of more than {MAX_SIZE} pixels"),
           (not all(0 <= depth <= 1 for depth in draw.viewport[4:]),
            "its depth range is not within 0 to 1"))
    whole = triangles_of(draw)
    triangles = [triangle for triangle in whole
                 if all(math.isfinite(number) for i in triangle for number in draw.positions[i])]
    refuse((not triangles, "it has no triangle"))
    notes = []
    if is_turned(draw):
        notes.append(f"turned its triangles, whose {draw.provoking} vertex provokes; the last bits "
                     "of values may differ")
    if len(triangles) < len(whole):
        lost = plural(len(whole) - len(triangles), "triangle")
        notes.append(f"left out {lost}: a position is NaN or infinite")
    place = {}  # of each vertex that is used, in the case
    for triangle in triangles:
        for i in triangle:
            place.setdefault(i, len(place))
    attributes = held_columns(draw, place, "attribute", MAX_ATTRIBUTES, notes)
    distances = held_columns(draw, place, "clip distance", MAX_CLIP_DISTANCES, notes)

    def vertex(i):
        entry = {"position": [hex_float(number) for number in draw.positions[i]]}
        for key, columns in (("attributes", attributes), ("clip_distances", distances)):
            if columns:
                entry[key] = [hex_float(column.values[i]) for column in columns]
        return entry

    sides = zip(("x", "y", "width", "height", "min_depth", "max_depth"), draw.viewport)
    case = {"format": "rastercheck-case", "version": 1, "name": draw.name,
            "framebuffer": {"width": draw.size[0], "height": draw.size[1], "samples": draw.samples},
            "viewport": {side: hex_float(value) for side, value in sides},
            "rules": draw.rules, "cull": draw.cull, "front_face": draw.front_face}
    if scissor_of(draw) is not None:
        case["scissor"] = scissor_of(draw)
    if draw.depth_clamp:
        case["depth_clamp"] = True
    if draw.depth_clear is not None:
        case.update(depth_test="less", depth_clear=hex_float(draw.depth_clear))
    if draw.depth_bias is not None:
        case["depth_bias"] = {part: hex_float(value) for part, value
                              in zip(("constant", "slope", "clamp"), draw.depth_bias)}
    if draw.depth_format != "float32":
        case["depth_format"] = draw.depth_format
    case["attributes"] = [{"name": column.name, "interpolation": column.interpolation,
                           "location": column.location} for column in attributes]
    case["vertices"] = [vertex(i) for i in place]
    case["triangles"] = [[place[i] for i in triangle] for triangle in triangles]
    return case, notes


def text_of(case):
    """The case as JSON, with one line for each attribute, vertex and triangle."""
    members = []
    for key, value in case.items():
        text = json.dumps(value)
        if key in ("attributes", "vertices", "triangles") and value:
            text = "[\n    " + ",\n    ".join(map(json.dumps, value)) + "\n  ]"
        members.append(f"  {json.dumps(key)}: {text}")
    return "{\n" + ",\n".join(members) + "\n}\n"


# Depth buffers, as RenderDoc hands over their bytes.


def held_bias(bias, notes):
    """A depth bias as a case has it; None if nothing is added to depths. A clamp that is NaN limits
    nothing, as 0 does."""
    constant, slope, clamp = bias
    clamp = 0.0 if math.isnan(clamp) else clamp
    if not all(map(math.isfinite, (constant, slope, clamp))):
        notes.append("left out the depth bias: has NaN or infinity")
        return None
    return (constant, slope, clamp) if constant != 0 or slope != 0 else None


def depths_in(data, form, is_high):
    """The set of depths in a buffer of `form`: "float32", "float32 stencil", "unorm16" or
    "unorm24", whose depths are the upper (is_high) or lower three of four bytes."""
    if form == "unorm16":
        steps, most = {k for k, in struct.iter_unpack("<H", data)}, 2 ** 16 - 1
    elif form == "unorm24":
        words = {word for word, in struct.iter_unpack("<I", data)}
        steps, most = {word >> 8 if is_high else word & 0xffffff for word in words}, 2 ** 24 - 1
    else:
        return {depth for depth, in struct.iter_unpack("<f" if form == "float32" else "<f4x", data)}
    return {struct.unpack("<f", struct.pack("<f", k / most))[0] for k in steps}


# Interpolation. Both APIs take it from the inputs of the fragment shader. RenderDoc's reflection
# does not have their qualifiers, so these are read from the shader itself: for each input, by
# location (SPIR-V) or name (GLSL), a set of the words below.

WORDS = {13: "noperspective", 14: "flat", 16: "centroid", 17: "sample"}  # decorations of SPIR-V
BUILT_INS_OF_SAMPLES = ((18,), (19,))  # SampleId and SamplePosition of SPIR-V


def set_per_sample(inputs):
    """A shader that runs once for each sample takes all its inputs there."""
    for words in inputs.values():
        words.add("sample")


def instructions_of(code):
    """Yields the instructions of a SPIR-V module, each as its number and operands."""
    words, at = struct.unpack(f"<{len(code) // 4}I", code), 5
    while at < len(words) and words[at] >> 16:
        yield words[at] & 0xffff, words[at + 1:at + (words[at] >> 16)]
        at += words[at] >> 16


def spirv_inputs(code, entry_point):
    """The inputs of the fragment shader of this name in a SPIR-V module. All numbers are those of
    the specification of SPIR-V."""
    built_in, location = 11, 30
    vector, matrix, array, structure, pointer = 23, 24, 28, 30, 32
    types, constants, variables, decorations, interface = {}, {}, {}, {}, ()
    for number, operands in instructions_of(code):
        if number == 15 and operands[0] == 4:  # OpEntryPoint of a fragment shader
            name = struct.pack(f"<{len(operands) - 2}I", *operands[2:]).partition(b"\0")[0]
            if name == entry_point.encode():
                interface = operands[2 + len(name) // 4 + 1:]
        elif number in (vector, matrix, array, structure, pointer):
            types[operands[0]] = (number, operands[1:])
        elif number == 43:  # OpConstant
            constants[operands[1]] = operands[2]
        elif number == 59:  # OpVariable
            variables[operands[1]] = (operands[0], operands[2])
        elif number == 71:  # OpDecorate
            decorations.setdefault(operands[0], {})[operands[1]] = operands[2:]
        elif number == 72:  # OpMemberDecorate
            decorations.setdefault(operands[:2], {})[operands[2]] = operands[3:]

    def size_of(type_id):
        """How many locations a type takes."""
        kind, of = types.get(type_id, (None, ()))
        if kind == array:
            return size_of(of[0]) * constants.get(of[1], 1)
        return of[1] if kind == matrix else sum(map(size_of, of)) if kind == structure else 1

    found, is_per_sample = {}, False
    for variable in interface:
        type_id, storage = variables[variable]
        if storage != 1:  # Input
            continue
        type_id, common, at = types[type_id][1][1], decorations.get(variable, {}), 0
        kind, members = types.get(type_id, (None, ()))
        for i, member in enumerate(members if kind == structure else (type_id,)):
            # A member of a block without a location has the one after the member before it.
            own = decorations.get((type_id, i), {}) if kind == structure else {}
            words = {**common, **own}
            at = own.get(location, (at,) if i > 0 else common.get(location, (0,)))[0]
            is_per_sample |= 17 in words or words.get(built_in) in BUILT_INS_OF_SAMPLES
            for _ in range(0 if built_in in words else size_of(member)):
                found[at] = {word for key, word in WORDS.items() if key in words}
                at += 1
    if is_per_sample:
        set_per_sample(found)
    return found


def glsl_inputs(source):
    """The inputs of a fragment shader in GLSL. Macros are not expanded, blocks not entered."""
    source = re.sub(r"//[^\n]*|/\*.*?\*/", " ", source, flags=re.DOTALL)
    declared = re.findall(r"((?:\w+\s+|layout\s*\([^)]*\)\s*)*)\b(?:in|varying)\s+"
                          r"(?:\w+p\s+)?\w+\s+(\w+)[^;{(]*;", source)
    found = {name: set(WORDS.values()).intersection(re.findall(r"\w+", before))
             for before, name in declared}
    if re.search(r"\bgl_Sample(ID|Position)\b|\bsample\s+in\b", source):
        set_per_sample(found)
    return found


# RenderDoc.


class Output(NamedTuple):
    """A variable that the vertex shader writes, and its place in RenderDoc's record of a vertex."""
    name: str
    kind: str  # "position", "attribute" or "clip distance"; else a case does not have it
    key: Any  # location or name, as that of a fragment shader's input
    components: int
    offset: int  # in bytes


def outputs_of(rd, reflection, is_aligned):
    """The outputs in the order of RenderDoc's records: the position first, all others as in the
    reflection. Vulkan's are aligned as in std430, OpenGL's are not."""
    kinds = {rd.ShaderBuiltin.Position: "position", rd.ShaderBuiltin.ClipDistance: "clip distance"}
    found, offset = [], 0
    for s in sorted(reflection.outputSignature,
                    key=lambda s: s.systemValue != rd.ShaderBuiltin.Position):
        size = 8 if rd.VarTypeByteSize(s.varType) > 4 else 4
        if is_aligned:
            offset += -offset % (size * {1: 1, 2: 2}.get(s.compCount, 4))
        kind = kinds.get(s.systemValue, "")
        if s.systemValue == rd.ShaderBuiltin.Undefined and s.varType == rd.VarType.Float:
            kind = "attribute"
        name = s.varName or s.semanticIdxName
        key = s.regIndex if reflection.encoding == rd.ShaderEncoding.SPIRV else name
        found.append(Output(name, kind, key, s.compCount, offset))
        offset += s.compCount * size
    return found


class Capture:
    """A capture, replayed on this machine."""

    def __init__(self, rd, file, chosen):
        self.rd, self.file = rd, file
        self.chosen = chosen  # interpolations by name, whatever the fragment shader says
        if not os.path.isfile(file):
            raise BadInput("no such file")
        if not os.environ.get("DISPLAY"):
            os.environ.setdefault("EGL_PLATFORM", "surfaceless")  # or Mesa does not replay OpenGL
        rd.InitialiseReplay(rd.GlobalEnvironment(), [])
        opened = rd.OpenCaptureFile()
        result = opened.OpenFile(file, "", None)
        if not result.OK():
            raise BadInput(f"RenderDoc cannot read it: {result.Message()}")
        self.api = opened.DriverName()
        if self.api not in ("Vulkan", "OpenGL"):
            raise BadInput(f"is a capture of {self.api}, not of Vulkan or OpenGL")
        result, self.controller = opened.OpenCapture(rd.ReplayOptions(), None)
        if not result.OK():
            raise BadInput(f"RenderDoc cannot replay it on this machine: {result.Message()}")
        self.actions = list(self.draws_among(self.controller.GetRootActions()))

    def draws_among(self, actions):
        for action in actions:
            if action.children:
                yield from self.draws_among(action.children)
            elif action.flags & self.rd.ActionFlags.Drawcall:
                yield action

    def name_of(self, action):
        return action.GetName(self.controller.GetStructuredFile())

    def topology_of(self, action):
        """Replays the frame up to a draw, and returns what that draws."""
        self.controller.SetFrameEvent(action.eventId, True)
        return self.rd.Topology(self.controller.GetPipelineState().GetPrimitiveTopology()).name


class Reader:
    """Reads one draw of a capture. Raises Unsayable if a case cannot hold it."""

    TOPOLOGIES = {"TriangleList": "list", "TriangleStrip": "strip", "TriangleFan": "fan"}

    def __init__(self, capture, action, notes):
        self.capture, self.action, self.notes = capture, action, notes
        self.rd, self.controller = capture.rd, capture.controller
        self.topology = capture.topology_of(action)
        self.state = self.controller.GetPipelineState()
        self.is_vulkan = capture.api == "Vulkan"
        self.api_state = (self.controller.GetVulkanPipelineState() if self.is_vulkan
                          else self.controller.GetGLPipelineState())
        self.inputs = self.fragment_inputs()

    def draw(self):
        reflection, stage = self.state.GetShaderReflection, self.rd.ShaderStage
        refuse((self.topology not in self.TOPOLOGIES,
                f"it draws a {self.topology}; a case has only triangles"),
               (reflection(stage.Hull) or reflection(stage.Domain), "it has tessellation shaders"),
               (reflection(stage.Geometry), "it has a geometry shader"),
               (not reflection(stage.Vertex), "it has no vertex shader"))
        state = self.vulkan_state() if self.is_vulkan else self.gl_state()
        positions, columns, strips = self.vertices(state["samples"])
        name = f"{os.path.basename(self.capture.file)}, event {self.action.eventId}: "
        return Draw(name=name + self.capture.name_of(self.action),
                    rules="vulkan" if self.is_vulkan else "opengl",
                    topology=self.TOPOLOGIES[self.topology], positions=positions, columns=columns,
                    strips=strips, **self.depth_state(), **state)

    def fragment_inputs(self):
        shader = self.state.GetShaderReflection(self.rd.ShaderStage.Pixel)
        if shader is None:
            return {}
        if shader.encoding == self.rd.ShaderEncoding.SPIRV:
            return spirv_inputs(shader.rawBytes, shader.entryPoint)
        return glsl_inputs(shader.rawBytes.decode(errors="replace"))

    # State

    def vulkan_state(self):
        state, rasterizer, views = (self.api_state, self.api_state.rasterizer,
                                    self.api_state.viewportScissor)
        multisample, framebuffer = state.multisample, state.currentPass.framebuffer
        # Dynamic rendering has no framebuffer.
        size = (framebuffer.width, framebuffer.height) if framebuffer.width else self.target()[0]
        refuse((multisample.sampleLocations.customLocations, "it sets sample locations"),
               (views.discardRectangles, "it has discard rectangles"),
               (views.depthNegativeOneToOne, "its clip depth begins at -w, not at 0"),
               (rasterizer.conservativeRasterization != self.rd.ConservativeRaster.Disabled,
                "its rasterization is conservative"),
               (tuple(rasterizer.pipelineShadingRate) != (1, 1),
                "its shading rate is not one fragment per pixel"))
        if state.currentPass.renderpass.multiviews:
            self.notes.append("only the first of its views is taken")
        mask = (1 << multisample.rasterSamples) - 1
        if multisample.sampleMask & mask != mask:
            self.notes.append("left out the sample mask")
        if multisample.sampleShadingEnable and multisample.minSampleShading > 0:
            set_per_sample(self.inputs)
        return dict(self.state_of(rasterizer, rasterizer.rasterizerDiscardEnable,
                                  [(both.vp, both.scissor) for both in views.viewportScissors]),
                    size=size, provoking="first",
                    samples=multisample.rasterSamples, depth_clamp=self.vulkan_depth_clamp())

    def vulkan_depth_clamp(self):
        """True if depths are clamped instead of clipped. RenderDoc 1.24 calls clipping enabled
        unless VK_EXT_depth_clip_enable disables it; in Vulkan, clamping disables it unless that
        extension enables it."""
        rasterizer = self.api_state.rasterizer
        is_clipped = rasterizer.depthClipEnable
        if is_clipped and rasterizer.depthClampEnable:
            pipeline = self.api_state.graphics.pipelineResourceId
            chunks = self.controller.GetStructuredFile().chunks
            is_clipped = any(chunks[at].FindChildRecursively("depthClipEnable") is not None
                             for resource in self.controller.GetResources()
                             if resource.resourceId == pipeline
                             for at in resource.initialisationChunks)
        refuse((not is_clipped and not rasterizer.depthClampEnable,
                "its depths are neither clipped nor clamped"))
        return not is_clipped

    def gl_state(self):
        state, rasterizer = self.api_state, self.api_state.rasterizer.state
        size, samples = self.target()
        vertices = state.vertexProcessing
        refuse((not vertices.clipNegativeOneToOne, "its clip depth begins at 0, not at -w"),
               (not vertices.clipOriginLowerLeft, "its window begins at the upper left"),
               (samples > 1 and not rasterizer.multisampleEnable,
                "its framebuffer has several samples, and multisampling is disabled"))
        if rasterizer.sampleMask or rasterizer.sampleCoverage:
            self.notes.append("left out the sample mask")
        if rasterizer.sampleShading and rasterizer.minSampleShadingRate > 0:
            set_per_sample(self.inputs)
        views = list(zip(state.rasterizer.viewports, state.rasterizer.scissors))
        return dict(self.state_of(rasterizer, vertices.discard, views),
                    size=size, samples=samples,
                    depth_clamp=rasterizer.depthClamp,
                    provoking="last" if state.vertexInput.provokingVertexLast else "first")

    def state_of(self, rasterizer, is_discarded, views):
        """The state that RenderDoc has by the same names for both APIs."""
        culls = self.rd.CullMode
        refuse((is_discarded or rasterizer.cullMode == culls.FrontAndBack, "it draws no triangle"),
               (rasterizer.fillMode != self.rd.FillMode.Solid, "it draws outlines"),
               (not views, "it has no viewport"))
        v, s = views[0]
        return {"viewport": (v.x, v.y, v.width, v.height, v.minDepth, v.maxDepth),
                "scissor": (s.x, s.y, s.width, s.height) if s.enabled else None,
                "cull": {culls.Back: "back", culls.Front: "front"}.get(rasterizer.cullMode, "none"),
                "front_face": "ccw" if rasterizer.frontCCW else "cw"}

    def texture(self, target):
        """The texture that is bound as a target; None if there is none."""
        return next((texture for texture in self.controller.GetTextures()
                     if texture.resourceId == target.resourceId), None)

    @staticmethod
    def size_of(texture, target):
        """Width and height of what of a texture is drawn into."""
        return tuple(max(side >> target.firstMip, 1) for side in (texture.width, texture.height))

    def target(self):
        """Size and number of samples of what is drawn into."""
        for target in (*self.state.GetOutputTargets(), self.state.GetDepthTarget()):
            texture = self.texture(target)
            if texture is not None:
                return self.size_of(texture, target), max(texture.msSamp, 1)
        raise Unsayable("it draws into no texture")

    # Depth

    def depth_state(self):
        """What the draw does with depths, as members of Draw: all by default if it tests none."""
        state = self.api_state
        if self.is_vulkan:
            depth, rasterizer, blend = state.depthStencil, state.rasterizer, state.colorBlend
            is_tested, is_written = depth.depthTestEnable, depth.depthWriteEnable
            others = depth.stencilTestEnable, depth.depthBoundsEnable, blend.alphaToCoverageEnable
            is_biased, clamp = rasterizer.depthBiasEnable, rasterizer.depthBiasClamp
        else:
            depth, rasterizer = state.depthState, state.rasterizer.state
            is_tested, is_written = depth.depthEnable, depth.depthWrites
            others = state.stencilState.stencilEnable, depth.depthBounds, rasterizer.alphaToCoverage
            is_biased, clamp = True, rasterizer.offsetClamp  # RenderDoc has 0 if it is disabled
        for is_on, what in zip(others, ("stencil test", "depth bounds test", "alpha to coverage")):
            if is_on:
                self.notes.append(f"left out the {what}")
        target = self.texture(self.state.GetDepthTarget())
        if not is_tested or target is None:
            return {}
        form = self.form_of(target.format)
        bias = rasterizer.depthBias, rasterizer.slopeScaledDepthBias, clamp
        return {"depth_clear": self.depth_clear(depth, is_written, target, form),
                "depth_bias": held_bias(bias, self.notes) if is_biased else None,
                "depth_format": form if form in ("unorm16", "unorm24") else "float32"}

    def form_of(self, form):
        """The words of depths_in() for a format; "" if it has none."""
        formats = self.rd.ResourceFormatType
        if form.type in (formats.D24S8, formats.D32S8):
            return "unorm24" if form.type == formats.D24S8 else "float32 stencil"
        regular = {2: "unorm16", 3: "unorm24", 4: "float32"}
        return regular.get(form.compByteWidth, "") if form.type == formats.Regular else ""

    def depth_clear(self, depth, is_written, target, form):
        """The depth that the whole buffer has before the draw; None, with a note, if a case cannot
        have the draw's depth test."""
        function = self.rd.CompareFunction(depth.depthFunction).name
        if function == "AlwaysTrue":
            return None
        depths = self.depths_before(target, form)
        for is_so, why in ((function != "Less", f"is {function}, not Less"),
                           (not is_written, "does not write depths"),
                           (depths is None, "has no buffer of float32 or unorm with one sample"),
                           (len(depths or ()) != 1, "is against depths of earlier draws")):
            if is_so:
                self.notes.append(f"left out the depth test: it {why}")
                return None
        return depths.pop()

    def depths_before(self, texture, form):
        """The set of depths in the buffer before the draw; None if a case has no such format, or of
        several samples: Mesa's lavapipe 22.3 crashes when these are read."""
        if texture.msSamp > 1 or not form:
            return None
        bound = self.state.GetDepthTarget()
        self.controller.SetFrameEvent(self.action.eventId - 1, True)
        data = self.controller.GetTextureData(
            texture.resourceId, self.rd.Subresource(bound.firstMip, bound.firstSlice, 0))
        self.controller.SetFrameEvent(self.action.eventId, True)
        if form == "unorm24":  # RenderDoc 1.24 has more bytes of Vulkan's D24_UNORM_S8 than pixels
            data = data[:4 * math.prod(self.size_of(texture, bound))]
        return depths_in(data, form, not self.is_vulkan)

    # Vertices

    def vertices(self, samples):
        """The positions, columns and strips of all instances."""
        rd = self.rd
        reflection = self.state.GetShaderReflection(rd.ShaderStage.Vertex)
        is_aligned = self.state.HasAlignedPostVSData(rd.MeshDataStage.VSOut)
        outputs = outputs_of(rd, reflection, is_aligned)
        self.check_outputs(reflection, outputs)
        records, strips = [], []
        for instance in range(max(self.action.numInstances, 1)):
            mesh = self.controller.GetPostVSData(instance, 0, rd.MeshDataStage.VSOut)
            refuse((mesh.vertexResourceId == rd.ResourceId.Null(),
                    f"RenderDoc has no vertices of it {mesh.status}".strip()))
            of_instance, stride = self.strips_of(mesh), mesh.vertexByteStride
            strips += [[len(records) + i for i in strip] for strip in of_instance]
            data = self.controller.GetBufferData(mesh.vertexResourceId, mesh.vertexByteOffset, 0)
            count = 1 + max((i for strip in of_instance for i in strip), default=-1)
            refuse((len(data) < count * stride, "RenderDoc has not all of its vertices"))
            records += [data[i * stride:(i + 1) * stride] for i in range(count)]

        columns, distance = [], 0
        for output in outputs:
            numbers = struct.Struct(f"<{output.components}f")
            rows = [numbers.unpack_from(record, output.offset) for record in records]
            if output.kind == "position":
                positions = rows
            if output.kind not in ("attribute", "clip distance"):
                continue
            qualifiers = self.qualifiers_of(output, samples)
            for i in range(output.components):
                name = output.name if output.components == 1 else f"{output.name}.{'xyzw'[i]}"
                if output.kind == "attribute" or self.is_enabled(distance):
                    columns.append(Column(output.kind, name, [row[i] for row in rows], *qualifiers))
                distance += output.kind == "clip distance"
        return positions, columns, strips

    def check_outputs(self, reflection, outputs):
        rd = self.rd
        builtins = {s.systemValue for s in reflection.outputSignature}
        refuse((rd.ShaderBuiltin.Position not in builtins, "its vertex shader writes no position"),
               (rd.ShaderBuiltin.CullDistance in builtins, "it has cull distances"),
               (rd.ShaderBuiltin.ViewportIndex in builtins, "its vertex shader sets the viewport"))
        if rd.ShaderBuiltin.RTIndex in builtins:
            self.notes.append("all layers are drawn into one")
        others = [s.varName for s in reflection.outputSignature
                  if s.systemValue == rd.ShaderBuiltin.Undefined and s.varType != rd.VarType.Float]
        if others:
            self.notes.append(f"left out attribute {', '.join(others)}: not float32")
        unread = [output.name for output in outputs
                  if output.kind == "attribute" and output.key not in self.inputs
                  and output.name not in self.capture.chosen]
        if unread:
            self.notes.append(f"smooth for {', '.join(unread)}: no fragment shader reads that "
                              "(--flat, --noperspective)")

    def strips_of(self, mesh):
        """The vertices of an instance in the order drawn, parted at restarts."""
        if mesh.indexResourceId == self.rd.ResourceId.Null():
            return [list(range(mesh.numIndices))]
        width, strips = mesh.indexByteStride, [[]]
        data = self.controller.GetBufferData(mesh.indexResourceId, mesh.indexByteOffset,
                                             mesh.numIndices * width)
        indices = struct.unpack(f"<{mesh.numIndices}{ {1: 'B', 2: 'H', 4: 'I'}[width]}", data)
        restart = self.state.GetRestartIndex() & (1 << 8 * width) - 1
        for index in indices:
            if self.state.IsRestartEnabled() and index == restart:
                strips.append([])
            else:
                strips[-1].append(max(index + mesh.baseVertex, 0))
        return strips

    def is_enabled(self, distance):
        """True if a clip distance clips. In OpenGL each has a switch of its own."""
        return self.is_vulkan or self.api_state.vertexProcessing.clipPlanes[distance]

    def qualifiers_of(self, output, samples):
        words = self.inputs.get(output.key, set())
        if output.name in self.capture.chosen:
            words = {self.capture.chosen[output.name]}
        interpolation = next((w for w in ("flat", "noperspective") if w in words), "smooth")
        if samples == 1 or interpolation == "flat" or "sample" in words:
            return interpolation, "sample"
        return interpolation, "centroid" if "centroid" in words else "center"


# Command line.


def say(text):
    print(f"rdc2case: {text}", file=sys.stderr)


def write(file, text):
    try:
        os.makedirs(os.path.dirname(file) or ".", exist_ok=True)
        with open(file, "w", encoding="utf-8") as out:
            out.write(text)
    except OSError as error:
        raise BadInput(f"cannot write {file}: {error.strerror}") from error


def list_draws(capture):
    print("event  topology       vertices  instances  name")
    for action in capture.actions:
        print(f"{action.eventId:<6} {capture.topology_of(action):<14} {action.numIndices:<9} "
              f"{action.numInstances:<10} {capture.name_of(action)}")


def convert(capture, action, output):
    """Writes the case of a draw. Returns False if there is none; says what is left out."""
    notes, text = [], None
    try:
        case, of_case = case_of(Reader(capture, action, notes).draw())
        text = text_of(case)
        notes += of_case
    except Unsayable as reason:
        notes = [f"left out: {reason}"]
    for note in notes:
        say(f"{capture.file}: event {action.eventId}: {note}")
    if text is not None and output:
        write(output, text)
    elif text is not None:
        print(text, end="")
    return text is not None


def run(rd, options):
    """Does what the options ask for. Returns the exit code."""
    chosen = {**dict.fromkeys(options.flat, "flat"),
              **dict.fromkeys(options.noperspective, "noperspective")}
    capture = Capture(rd, options.file, chosen)
    if options.all:
        written = sum(convert(capture, action, f"{options.output}/event-{action.eventId}.json")
                      for action in capture.actions)
        print(f"{written} of {plural(len(capture.actions), 'draw')} written to {options.output}")
        return 0 if written else 2
    if options.draw is None:
        list_draws(capture)
        return 0
    for action in capture.actions:
        if action.eventId == options.draw:
            return 0 if convert(capture, action, options.output) else 2
    raise BadInput(f"event {options.draw} is no draw; without --draw, all draws are listed")


def main():
    parser = argparse.ArgumentParser(prog="rdc2case", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", metavar="FILE.rdc")
    parser.add_argument("--draw", type=int, metavar="EVENT", help="the draw with this event id")
    parser.add_argument("--all", action="store_true", help="every draw of the frame")
    parser.add_argument("--output", metavar="PATH", help="file, or with --all folder, to write")
    for option in ("--flat", "--noperspective"):
        parser.add_argument(option, action="append", default=[], metavar="NAME",
                            help="a variable of the vertex shader that is interpolated so")
    options = parser.parse_args()
    if options.output and options.draw is None and not options.all:
        parser.error("--output needs --draw EVENT or --all")
    if options.all and (options.draw is not None or not options.output):
        parser.error("--all needs --output FOLDER, and no --draw")
    try:
        import renderdoc
        return run(renderdoc, options)
    except ImportError as error:
        say(f"{error}; Debian's package python3-renderdoc has it, for /usr/bin/python3")
    except BadInput as reason:
        say(f"{options.file}: {reason}")
    return 2


def leave(code):
    """Ends the process without destructors: a thread of RenderDoc may still be loading drivers, and
    at a regular end the two may wait for each other for ever. RenderDoc then keeps its log, which
    a regular end removes."""
    sys.stdout.flush()
    if "renderdoc" in sys.modules:
        try:
            os.remove(sys.modules["renderdoc"].GetLogFile())
        except OSError:
            pass
    os._exit(code)


if __name__ == "__main__":
    leave(main())
