#!/usr/bin/env python3
"""Makes case files of RasterCheck of the draws in a RenderDoc capture.

    rdc2case.py FILE.rdc                              lists the draws of the captured frame
    rdc2case.py FILE.rdc --draw EVENT                 prints the case of one draw
    rdc2case.py FILE.rdc --draw EVENT --output CASE   writes it to a file
    rdc2case.py FILE.rdc --all --output FOLDER        writes FOLDER/event-EVENT.json for every draw

A case has the vertices as the vertex stage left them, bit for bit, and the state of the
rasterizer. Whatever a case cannot hold is said in one line on standard error; nothing is left out
silently.

Needs nothing but RenderDoc's Python module (Debian: python3-renderdoc; written for 1.24) and a
machine that can replay the capture. Exit code 2 if the input is bad, or no draw could be written.
"""

import argparse
import json
import math
import os
import re
import struct
import sys
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

MAX_SIZE, MAX_ATTRIBUTES, MAX_CLIP_DISTANCES = 16384, 32, 8
SAMPLE_COUNTS = (1, 2, 4, 8, 16)


class Unsayable(Exception):
    """A draw that a case file cannot hold; the message says why."""


class BadInput(Exception):
    """A file or an option that cannot be used; the message says why."""


# A draw as plain data, and the case made of it. Nothing from here to `Vertex stage` needs RenderDoc.


class Column(NamedTuple):
    """One scalar that the vertex stage wrote for each vertex."""
    kind: str  # "attribute" or "clip distance"
    name: str
    values: List[float]  # of each vertex
    interpolation: str = "smooth"
    location: str = "sample"


class Draw(NamedTuple):
    name: str
    rules: str  # "vulkan" or "opengl"
    size: Tuple[int, int]  # of the framebuffer, in pixels
    samples: int
    viewport: Tuple[float, float, float, float, float, float]  # x, y, width, height, depth range
    scissor: Optional[Tuple[int, int, int, int]]  # x, y, width, height
    topology: str  # "list", "strip" or "fan"
    provoking: str  # "first" or "last": which vertex flat attributes come from
    positions: List[Tuple[float, ...]]  # clip coordinates of each vertex
    columns: List[Column]
    strips: List[List[int]]  # vertices in the order drawn, parted at restarts and instances
    cull: str = "none"
    front_face: str = "ccw"
    depth_clamp: bool = False
    depth_clear: Optional[float] = None  # None: no depth test


def triangles_of(draw):
    """The triangles of a draw, each turned so that flat attributes come from the vertex that the
    rules of a case take them from: the first in Vulkan, the last in OpenGL. Turning by one vertex
    keeps the facing."""
    is_last = draw.provoking == "last"
    triangles = []
    for strip in draw.strips:
        for i in range(0, len(strip) - 2, 3 if draw.topology == "list" else 1):
            a, b, c = strip[i:i + 3]
            if draw.topology == "fan":  # Its first vertex provokes nothing.
                triangle = (strip[0], b, c) if is_last else (b, c, strip[0])
            elif draw.topology == "strip" and i % 2 == 1:
                triangle = (b, a, c) if is_last else (a, c, b)
            else:
                triangle = (a, b, c)
            if is_last != (draw.rules == "opengl"):
                triangle = triangle[2:] + triangle[:2] if is_last else triangle[1:] + triangle[:1]
            triangles.append(triangle)
    return triangles


def plural(count, noun):
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def held_columns(columns, used, kind, most, notes):
    """The columns of a kind that a case can hold."""
    all_of_kind = [column for column in columns if column.kind == kind]
    finite = [column for column in all_of_kind if all(math.isfinite(column.values[i]) for i in used)]
    names = [column.name for column in all_of_kind if column not in finite]
    if names:
        notes.append(f"left out {kind} {', '.join(names)}: has NaN or infinity")
    if len(finite) > most:
        notes.append(f"left out {plural(len(finite) - most, kind)}: a case has {most} at most")
    return finite[:most]


def check_state(draw):
    """Raises Unsayable if the state is beyond the limits of a case."""
    width, height = draw.size
    if not (1 <= width <= MAX_SIZE and 1 <= height <= MAX_SIZE):
        raise Unsayable(f"its framebuffer has {width} x {height} pixels; a case has 1 to {MAX_SIZE}")
    if draw.samples not in SAMPLE_COUNTS:
        raise Unsayable(f"it has {draw.samples} samples per pixel; a case has 1, 2, 4, 8 or 16")
    if not all(map(math.isfinite, draw.viewport)) or max(map(abs, draw.viewport[2:4])) > MAX_SIZE:
        raise Unsayable(f"a side of its viewport is longer than {MAX_SIZE} pixels")
    if not all(0 <= depth <= 1 for depth in draw.viewport[4:]):
        raise Unsayable("its depth range is not within 0 to 1")


def scissor_of(draw):
    """The part of the scissor rectangle that lies in the framebuffer; None if that is all of it."""
    if draw.scissor is None:
        return None
    (x, y, width, height), (right, top) = draw.scissor, draw.size
    left, bottom = min(max(x, 0), right), min(max(y, 0), top)
    inside = {"x": left, "y": bottom,
              "width": max(min(x + width, right) - left, 0),
              "height": max(min(y + height, top) - bottom, 0)}
    return None if inside == {"x": 0, "y": 0, "width": right, "height": top} else inside


def hex_float(value):
    """The text of a float32 in a case file."""
    digits, _, exponent = value.hex().partition("p")
    return f"{digits.rstrip('0').rstrip('.') if '.' in digits else digits}p{exponent}"


def case_of(draw):
    """The case of a draw, as what json.dumps() takes, and a note for all that is left out."""
    check_state(draw)
    notes = []
    whole = triangles_of(draw)
    triangles = [triangle for triangle in whole
                 if all(math.isfinite(number) for i in triangle for number in draw.positions[i])]
    if len(triangles) < len(whole):
        lost = plural(len(whole) - len(triangles), "triangle")
        notes.append(f"left out {lost}: a position is NaN or infinite")
    if not triangles:
        raise Unsayable("it has no triangle")
    used = list(dict.fromkeys(i for triangle in triangles for i in triangle))
    place = {vertex: at for at, vertex in enumerate(used)}
    attributes = held_columns(draw.columns, used, "attribute", MAX_ATTRIBUTES, notes)
    distances = held_columns(draw.columns, used, "clip distance", MAX_CLIP_DISTANCES, notes)

    def vertex(i):
        entry = {"position": [hex_float(number) for number in draw.positions[i]]}
        if attributes:
            entry["attributes"] = [hex_float(column.values[i]) for column in attributes]
        if distances:
            entry["clip_distances"] = [hex_float(column.values[i]) for column in distances]
        return entry

    names = ("x", "y", "width", "height", "min_depth", "max_depth")
    case = {"format": "rastercheck-case", "version": 1, "name": draw.name,
            "framebuffer": {"width": draw.size[0], "height": draw.size[1], "samples": draw.samples},
            "viewport": {name: hex_float(value) for name, value in zip(names, draw.viewport)},
            "rules": draw.rules, "cull": draw.cull, "front_face": draw.front_face}
    if scissor_of(draw) is not None:
        case["scissor"] = scissor_of(draw)
    if draw.depth_clamp:
        case["depth_clamp"] = True
    if draw.depth_clear is not None:
        case.update(depth_test="less", depth_clear=hex_float(draw.depth_clear))
    case["attributes"] = [{"name": column.name, "interpolation": column.interpolation,
                           "location": column.location} for column in attributes]
    case["vertices"] = [vertex(i) for i in used]
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


# Interpolation. Both APIs take it from the inputs of the fragment shader, which RenderDoc's
# reflection has without their qualifiers, so the shader itself is read.


class Inputs:
    """The qualifiers of a fragment shader's inputs, by location (SPIR-V) or name (GLSL)."""

    def __init__(self):
        self.qualifiers: Dict[Any, set] = {}
        self.is_per_sample = False  # it runs once for each sample, whatever its qualifiers

    def interpolation_of(self, key):
        """The interpolation and the location of an attribute; None if no input has the key."""
        if key not in self.qualifiers:
            return None
        words = self.qualifiers[key]
        interpolation = next((word for word in ("flat", "noperspective") if word in words), "smooth")
        location = "centroid" if "centroid" in words else "center"
        return interpolation, "sample" if self.is_per_sample else location


class SpirvModule:
    """The few instructions of a SPIR-V module that say how its inputs are interpolated. Numbers are
    those of the SPIR-V specification, sections 3.32 (instructions) and 3.20 (decorations)."""

    ENTRY_POINT, CONSTANT, VARIABLE, DECORATE, MEMBER_DECORATE = 15, 43, 59, 71, 72
    VECTOR, MATRIX, ARRAY, STRUCT, POINTER = 23, 24, 28, 30, 32
    FRAGMENT, INPUT = 4, 1
    BUILT_IN, LOCATION, SAMPLE = 11, 30, 17
    WORDS = {13: "noperspective", 14: "flat", 16: "centroid", SAMPLE: "sample"}
    SAMPLE_ID, SAMPLE_POSITION = 18, 19

    def __init__(self, code):
        self.types, self.constants, self.variables, self.decorations = {}, {}, {}, {}
        self.entries = []
        words = struct.unpack(f"<{len(code) // 4}I", code[:len(code) // 4 * 4])
        if not words or words[0] != 0x07230203:
            raise ValueError("no SPIR-V")
        at = 5
        while at < len(words) and words[at] >> 16:
            self.read(words[at] & 0xffff, words[at + 1:at + (words[at] >> 16)], code)
            at += words[at] >> 16

    def read(self, instruction, operands, _):
        if instruction == self.ENTRY_POINT:
            name = struct.pack(f"<{len(operands) - 2}I", *operands[2:]).partition(b"\0")[0]
            ids = operands[2 + len(name) // 4 + 1:]
            self.entries.append((operands[0], name.decode(errors="replace"), ids))
        elif instruction in (self.VECTOR, self.MATRIX, self.ARRAY, self.STRUCT, self.POINTER):
            self.types[operands[0]] = (instruction, operands[1:])
        elif instruction == self.CONSTANT:
            self.constants[operands[1]] = operands[2]
        elif instruction == self.VARIABLE:
            self.variables[operands[1]] = (operands[0], operands[2])
        elif instruction == self.DECORATE:
            self.decorations.setdefault(operands[0], {})[operands[1]] = operands[2:]
        elif instruction == self.MEMBER_DECORATE:
            of_member = self.decorations.setdefault(tuple(operands[:2]), {})
            of_member[operands[2]] = operands[3:]

    def locations_of(self, type_id):
        """How many locations a type takes."""
        kind, operands = self.types.get(type_id, (None, ()))
        if kind == self.MATRIX:
            return operands[1]
        if kind == self.ARRAY:
            return self.locations_of(operands[0]) * self.constants.get(operands[1], 1)
        if kind == self.STRUCT:
            return sum(map(self.locations_of, operands))
        return 1

    def inputs(self, entry_point):
        """The inputs of the fragment shader with that name."""
        found = Inputs()
        for model, name, ids in self.entries:
            if model == self.FRAGMENT and name == entry_point:
                for variable in ids:
                    self.add_variable(found, variable)
        return found

    def add_variable(self, found, variable):
        pointer, storage = self.variables.get(variable, (None, None))
        if storage != self.INPUT:
            return
        decorations = self.decorations.get(variable, {})
        pointee = self.types[pointer][1][1]
        kind, members = self.types.get(pointee, (None, ()))
        location = decorations.get(self.LOCATION, (0,))[0]
        if kind != self.STRUCT:
            self.add(found, location, pointee, decorations)
            return
        for at, member in enumerate(members):
            own = self.decorations.get((pointee, at), {})
            location = own.get(self.LOCATION, (location,))[0]
            self.add(found, location, member, {**decorations, **own})
            location += self.locations_of(member)

    def add(self, found, location, type_id, decorations):
        built_in = decorations.get(self.BUILT_IN, (None,))[0]
        found.is_per_sample |= (self.SAMPLE in decorations or
                                built_in in (self.SAMPLE_ID, self.SAMPLE_POSITION))
        if built_in is None:
            words = {word for number, word in self.WORDS.items() if number in decorations}
            for i in range(self.locations_of(type_id)):
                found.qualifiers[location + i] = words


def glsl_inputs(source):
    """The inputs of a fragment shader in GLSL. Macros are not expanded."""
    found = Inputs()
    source = re.sub(r"//[^\n]*|/\*.*?\*/", " ", source, flags=re.DOTALL)
    found.is_per_sample = bool(re.search(r"\bgl_Sample(ID|Position)\b", source))
    plain = r"((?:\w+\s+|layout\s*\([^)]*\)\s*)*)"
    declared = []
    for before, block, members in re.findall(plain + r"\bin\s+(\w+)\s*\{([^}]*)\}", source):
        declared += [(before + " " + own, name, block + ".")
                     for own, name in re.findall(plain + r"\w+\s+(\w+)[^;]*;", members)]
    declared += [(before, name, "") for before, name in re.findall(
        plain + r"\b(?:in|varying)\s+(?:(?:high|medium|low)p\s+)?\w+\s+(\w+)[^;{(]*;", source)]
    for qualifiers, name, block in declared:
        found.qualifiers[block + name] = set(re.findall(r"\w+", qualifiers))
        found.is_per_sample |= "sample" in found.qualifiers[block + name]
    return found


# Vertex stage and state, as RenderDoc tells them.


class Output(NamedTuple):
    """A variable that the vertex shader writes, and where it is in the record of a vertex."""
    name: str
    kind: str  # "position", "attribute", "clip distance", or "" for what a case has no room for
    key: Any  # location or name, as Inputs has it
    components: int
    offset: int  # in bytes


def outputs_of(rd, reflection, is_spirv, is_aligned):
    """The outputs in the order of RenderDoc's records: the position first, the others as in the
    reflection; Vulkan's are aligned as in std430."""
    kinds = {rd.ShaderBuiltin.Position: "position", rd.ShaderBuiltin.ClipDistance: "clip distance"}
    found, offset = [], 0
    for s in sorted(reflection.outputSignature,
                    key=lambda s: s.systemValue != rd.ShaderBuiltin.Position):
        size = 8 if rd.VarTypeByteSize(s.varType) > 4 else 4
        if is_aligned:
            alignment = size * {1: 1, 2: 2}.get(s.compCount, 4)
            offset += -offset % alignment
        kind = kinds.get(s.systemValue, "")
        if s.systemValue == rd.ShaderBuiltin.Undefined and s.varType == rd.VarType.Float:
            kind = "attribute"
        name = s.varName or s.semanticIdxName
        found.append(Output(name, kind, s.regIndex if is_spirv else name, s.compCount, offset))
        offset += s.compCount * size
    return found


class Capture:
    """An opened capture, replayed on this machine."""

    def __init__(self, rd, file):
        self.rd, self.file = rd, file
        if not os.path.isfile(file):
            raise BadInput("no such file")
        rd.InitialiseReplay(rd.GlobalEnvironment(), [])
        opened = rd.OpenCaptureFile()
        result = opened.OpenFile(file, "", None)
        if not result.OK():
            raise BadInput(f"RenderDoc cannot read it: {result.Message()}")
        self.api = opened.DriverName()
        if self.api not in ("Vulkan", "OpenGL"):
            raise BadInput(f"is a capture of {self.api}; only Vulkan's and OpenGL's become cases")
        result, self.controller = opened.OpenCapture(rd.ReplayOptions(), None)
        if not result.OK():
            raise BadInput(f"RenderDoc cannot replay it on this machine: {result.Message()}")
        self.actions = list(self.draws_below(self.controller.GetRootActions()))

    def draws_below(self, actions):
        for action in actions:
            if action.children:
                yield from self.draws_below(action.children)
            elif action.flags & self.rd.ActionFlags.Drawcall:
                yield action

    def name_of(self, action):
        return action.GetName(self.controller.GetStructuredFile())

    def topology_of(self, action):
        self.controller.SetFrameEvent(action.eventId, True)
        return self.rd.Topology(self.controller.GetPipelineState().GetPrimitiveTopology()).name

    def draw_of(self, action, notes):
        """The draw of an event. Raises Unsayable if a case cannot hold it."""
        return Reader(self, action, notes).draw()


class Reader:
    """Reads the state at one event."""

    TOPOLOGIES = {"TriangleList": "list", "TriangleStrip": "strip", "TriangleFan": "fan"}

    def __init__(self, capture, action, notes):
        self.capture, self.action, self.notes = capture, action, notes
        self.rd, self.controller = capture.rd, capture.controller
        self.topology = capture.topology_of(action)  # goes to the event
        self.state = self.controller.GetPipelineState()
        self.is_vulkan = capture.api == "Vulkan"
        self.is_per_sample = False  # the fragment shader runs for each sample
        self.api_state = (self.controller.GetVulkanPipelineState() if self.is_vulkan
                          else self.controller.GetGLPipelineState())

    def draw(self):
        self.check_stages()
        rasterizer = (self.vulkan_rasterizer if self.is_vulkan else self.gl_rasterizer)()
        positions, columns, strips = self.vertices(rasterizer["samples"])
        name = f"{os.path.basename(self.capture.file)}, event {self.action.eventId}: "
        return Draw(name=name + self.capture.name_of(self.action),
                    rules="vulkan" if self.is_vulkan else "opengl",
                    topology=self.TOPOLOGIES[self.topology], positions=positions, columns=columns,
                    strips=strips, depth_clear=self.depth_clear(), **rasterizer)

    def check_stages(self):
        if self.topology not in self.TOPOLOGIES:
            what = re.sub("(List|Strip|Loop)(_Adj)?.*$", "", self.topology)
            has_neighbours = " with adjacency" if self.topology.endswith("_Adj") else ""
            raise Unsayable(f"it draws {what.lower()}s{has_neighbours}; a case has only triangles")
        stage = self.rd.ShaderStage
        for name, of in (("tessellation", stage.Hull), ("geometry", stage.Geometry)):
            if self.state.GetShaderReflection(of) is not None:
                raise Unsayable(f"it has a {name} shader; cases are made of the vertex stage")
        if self.state.GetShaderReflection(stage.Vertex) is None:
            raise Unsayable("it has no vertex shader")

    # State

    def vulkan_rasterizer(self):
        state, rasterizer = self.api_state, self.api_state.rasterizer
        views, multisample = state.viewportScissor, state.multisample
        if multisample.sampleLocations.customLocations:
            raise Unsayable("it sets sample locations; a case has the standard ones")
        if views.depthNegativeOneToOne:
            raise Unsayable("its clip depth goes from -w to w, and in a Vulkan case from 0 to w")
        if rasterizer.conservativeRasterization != self.rd.ConservativeRaster.Disabled:
            raise Unsayable("its rasterization is conservative")
        if tuple(rasterizer.pipelineShadingRate) != (1, 1):
            raise Unsayable("its shading rate is not one fragment per pixel")
        if state.currentPass.renderpass.multiviews:
            self.notes.append("only the first of its views: a case has one")
        mask = (1 << multisample.rasterSamples) - 1
        if multisample.sampleMask & mask != mask:
            self.notes.append("its sample mask is left out: the case draws all samples")
        if multisample.sampleShadingEnable and multisample.minSampleShading > 0:
            self.is_per_sample = True
        common = self.common(rasterizer, rasterizer.rasterizerDiscardEnable,
                             [(both.vp, both.scissor) for both in views.viewportScissors])
        framebuffer = state.currentPass.framebuffer
        return dict(common, size=(framebuffer.width, framebuffer.height), provoking="first",
                    samples=multisample.rasterSamples, depth_clamp=self.vulkan_depth_clamp())

    def vulkan_depth_clamp(self):
        """True if depths are clamped and not clipped. RenderDoc 1.24 calls clipping enabled unless
        VK_EXT_depth_clip_enable disables it; in Vulkan, clamping disables it if that extension does
        not enable it."""
        rasterizer = self.api_state.rasterizer
        is_clipped = rasterizer.depthClipEnable
        if is_clipped and rasterizer.depthClampEnable:
            is_clipped = self.says_depth_clip_enable()
        if not is_clipped and not rasterizer.depthClampEnable:
            raise Unsayable("its depth is neither clipped nor clamped")
        return not is_clipped

    def says_depth_clip_enable(self):
        """True if the pipeline was made with a structure of VK_EXT_depth_clip_enable."""
        pipeline = self.api_state.graphics.pipelineResourceId
        chunks = self.controller.GetStructuredFile().chunks
        return any(chunks[at].FindChildRecursively("depthClipEnable") is not None
                   for resource in self.controller.GetResources()
                   if resource.resourceId == pipeline
                   for at in resource.initialisationChunks)

    def gl_rasterizer(self):
        state, rasterizer = self.api_state, self.api_state.rasterizer
        processing = state.vertexProcessing
        if not processing.clipNegativeOneToOne:
            raise Unsayable("its clip depth goes from 0 to w, and in an OpenGL case from -w to w")
        if not processing.clipOriginLowerLeft:
            raise Unsayable("its window has its origin at the upper left")
        target = self.texture((list(self.state.GetOutputTargets()) + [self.state.GetDepthTarget()]))
        if target is None:
            raise Unsayable("it has no framebuffer of a known size")
        if target.msSamp > 1 and not rasterizer.state.multisampleEnable:
            raise Unsayable("it draws into several samples with multisampling disabled")
        if rasterizer.state.sampleMask or rasterizer.state.sampleCoverage:
            self.notes.append("its sample mask is left out: the case draws all samples")
        if rasterizer.state.sampleShading and rasterizer.state.minSampleShadingRate > 0:
            self.is_per_sample = True
        common = self.common(rasterizer.state, processing.discard,
                             list(zip(rasterizer.viewports, rasterizer.scissors)))
        is_last = state.vertexInput.provokingVertexLast
        return dict(common, size=(target.width, target.height), samples=max(target.msSamp, 1),
                    depth_clamp=rasterizer.state.depthClamp, provoking="last" if is_last else "first")

    def common(self, rasterizer, is_discarded, views):
        """What both APIs say alike."""
        rd = self.rd
        if is_discarded or rasterizer.cullMode == rd.CullMode.FrontAndBack:
            raise Unsayable("it draws nothing: all of its triangles are discarded or culled")
        if rasterizer.fillMode != rd.FillMode.Solid:
            raise Unsayable("it draws the outlines of triangles; a case has only filled ones")
        if not views:
            raise Unsayable("it has no viewport")
        view, scissor = views[0]
        culls = {rd.CullMode.NoCull: "none", rd.CullMode.Back: "back", rd.CullMode.Front: "front"}
        return {"viewport": (view.x, view.y, view.width, view.height, view.minDepth, view.maxDepth),
                "scissor": (scissor.x, scissor.y, scissor.width, scissor.height)
                           if scissor.enabled else None,
                "cull": culls[rasterizer.cullMode],
                "front_face": "ccw" if rasterizer.frontCCW else "cw"}

    def texture(self, targets):
        """The first texture among these targets; None if there is none."""
        wanted = [target.resourceId for target in targets]
        return next((texture for texture in self.controller.GetTextures()
                     if texture.resourceId in wanted), None)

    # Depth

    def depth_clear(self):
        """What the depth buffer holds before the draw, if a case can have its depth test; else
        None, with a note."""
        rd = self.rd
        state = self.api_state.depthStencil if self.is_vulkan else self.api_state.depthState
        is_tested = state.depthTestEnable if self.is_vulkan else state.depthEnable
        target = self.texture([self.state.GetDepthTarget()])
        if self.has_stencil_test():
            self.notes.append("its stencil test is left out")
        if not is_tested or state.depthFunction == rd.CompareFunction.AlwaysTrue or target is None:
            return None
        rasterizer = self.api_state.rasterizer
        bias = rasterizer if self.is_vulkan else rasterizer.state
        why = None
        if state.depthFunction != rd.CompareFunction.Less:
            why = f"its depth test is {rd.CompareFunction(state.depthFunction).name}, not Less"
        elif not (state.depthWriteEnable if self.is_vulkan else state.depthWrites):
            why = "its depths are not written"
        elif bias.depthBias != 0 or bias.slopeScaledDepthBias != 0:
            why = "its depths are biased"
        else:
            depths = self.depths_before(target)
            if depths is None:
                why = "its depths are not stored as float32"
            elif len(depths) != 1 or not 0 <= min(depths) <= 1:
                why = "the depth buffer is not cleared before it"
            else:
                return depths.pop()
        self.notes.append(f"each triangle as if drawn alone: {why}")
        return None

    def has_stencil_test(self):
        return (self.api_state.depthStencil.stencilTestEnable if self.is_vulkan
                else self.api_state.stencilState.stencilEnable)

    def depths_before(self, texture):
        """The set of depths in the buffer before the draw; None if they are not float32."""
        rd, form = self.rd, texture.format
        if form.type == rd.ResourceFormatType.D32S8:
            step = 8  # a float, a byte of stencil and three unused ones
        elif form.type == rd.ResourceFormatType.Regular and form.compByteWidth == 4:
            step = 4
        else:
            return None
        bound = self.state.GetDepthTarget()
        depths = set()
        self.controller.SetFrameEvent(self.action.eventId - 1, True)
        for sample in range(max(texture.msSamp, 1)):
            where = rd.Subresource(bound.firstMip, bound.firstSlice, sample)
            data = self.controller.GetTextureData(texture.resourceId, where)
            depths.update(number[0] for number in struct.iter_unpack(f"<f{step - 4}x", data))
        self.controller.SetFrameEvent(self.action.eventId, True)
        return depths

    # Vertices

    def vertices(self, samples):
        """The positions, columns and strips of all instances."""
        rd = self.rd
        reflection = self.state.GetShaderReflection(rd.ShaderStage.Vertex)
        is_spirv = reflection.encoding == rd.ShaderEncoding.SPIRV
        outputs = outputs_of(rd, reflection, is_spirv,
                             self.state.HasAlignedPostVSData(rd.MeshDataStage.VSOut))
        self.check_outputs(reflection, outputs)
        records, strips = [], []
        for instance in range(max(self.action.numInstances, 1)):
            mesh = self.controller.GetPostVSData(instance, 0, rd.MeshDataStage.VSOut)
            if mesh.vertexResourceId == rd.ResourceId.Null():
                raise Unsayable("RenderDoc has no vertices of it"
                                + (f": {mesh.status}" if mesh.status else ""))
            first = len(records)
            own = self.strips_of(mesh)
            strips += [[first + i for i in strip] for strip in own]
            data = self.controller.GetBufferData(mesh.vertexResourceId, mesh.vertexByteOffset, 0)
            count = 1 + max((i for strip in own for i in strip), default=-1)
            if len(data) < (count - 1) * mesh.vertexByteStride + 16:
                raise Unsayable("RenderDoc has fewer vertices than its indices name")
            stride = mesh.vertexByteStride
            records += [data[i * stride:(i + 1) * stride] for i in range(count)]

        def numbers(output):
            form = struct.Struct(f"<{output.components}f")
            return [form.unpack_from(record, output.offset) for record in records]

        positions = numbers(next(output for output in outputs if output.kind == "position"))
        columns, distance = [], 0
        for output in outputs:
            if output.kind == "position" or not output.kind:
                continue
            interpolation = self.interpolation_of(output, samples)
            for i, values in enumerate(zip(*numbers(output))):
                name = output.name if output.components == 1 else f"{output.name}.{'xyzw'[i]}"
                if output.kind == "attribute" or self.is_enabled(distance):
                    columns.append(Column(output.kind, name, list(values), *interpolation))
                distance += output.kind == "clip distance"
        return positions, columns, strips

    def is_enabled(self, distance):
        """True if a clip distance clips: in OpenGL each is enabled by itself."""
        return self.is_vulkan or self.api_state.vertexProcessing.clipPlanes[distance]

    def interpolation_of(self, output, samples):
        if output.kind != "attribute":
            return ()
        inputs = self.fragment_inputs()
        found = inputs.interpolation_of(output.key)
        if found is None:
            self.notes.append(f"smooth for {output.name}: its fragment shader does not read that")
            found = ("smooth", "center")
        interpolation, location = found
        is_anywhere = samples == 1 or interpolation == "flat"
        return interpolation, "sample" if is_anywhere or self.is_per_sample else location

    def fragment_inputs(self):
        """The inputs of the fragment shader; of none, no inputs."""
        shader = self.state.GetShaderReflection(self.rd.ShaderStage.Pixel)
        if shader is None:
            return Inputs()
        if shader.encoding == self.rd.ShaderEncoding.SPIRV:
            return SpirvModule(shader.rawBytes).inputs(shader.entryPoint)
        return glsl_inputs(shader.rawBytes.decode(errors="replace"))

    def strips_of(self, mesh):
        """The vertices of an instance in the order drawn, parted at restarts."""
        if mesh.indexResourceId == self.rd.ResourceId.Null():
            return [list(range(mesh.numIndices))]
        width = mesh.indexByteStride
        data = self.controller.GetBufferData(mesh.indexResourceId, mesh.indexByteOffset,
                                             mesh.numIndices * width)
        indices = struct.unpack(f"<{mesh.numIndices}{ {1: 'B', 2: 'H', 4: 'I'}[width]}", data)
        restart = self.state.GetRestartIndex() & (1 << 8 * width) - 1
        strips = [[]]
        for index in indices:
            if self.state.IsRestartEnabled() and index == restart:
                strips.append([])
            else:
                strips[-1].append(max(index + mesh.baseVertex, 0))
        return strips

    def check_outputs(self, reflection, outputs):
        rd = self.rd
        builtins = {s.systemValue for s in reflection.outputSignature}
        if rd.ShaderBuiltin.Position not in builtins:
            raise Unsayable("its vertex shader writes no position")
        if rd.ShaderBuiltin.CullDistance in builtins:
            raise Unsayable("it has cull distances, which a case has not")
        if rd.ShaderBuiltin.ViewportIndex in builtins:
            raise Unsayable("its vertex shader chooses the viewport; a case has one")
        if rd.ShaderBuiltin.RTIndex in builtins:
            self.notes.append("all layers drawn into one: its vertex shader chooses the layer")
        left_out = [s.varName for s in reflection.outputSignature
                    if s.systemValue == rd.ShaderBuiltin.Undefined and s.varType != rd.VarType.Float]
        if left_out:
            self.notes.append(f"left out attribute {', '.join(left_out)}: not of 32-bit floats")


# Command line


def say(text):
    print(f"rdc2case: {text}", file=sys.stderr)


def list_draws(capture):
    print("event  topology       vertices  instances  name")
    for action in capture.actions:
        print(f"{action.eventId:<6} {capture.topology_of(action):<14} {action.numIndices:<9} "
              f"{action.numInstances:<10} {capture.name_of(action)}")


def converted(capture, action):
    """The text of a draw's case; None if there is none. Says what is left out."""
    notes, text = [], None
    try:
        case, more = case_of(capture.draw_of(action, notes))
        notes += more
        text = text_of(case)
    except Unsayable as reason:
        notes = [f"left out: {reason}"]
    for note in notes:
        say(f"{capture.file}: event {action.eventId}: {note}")
    return text


def write(file, text):
    try:
        with open(file, "w", encoding="utf-8") as out:
            out.write(text)
    except OSError as error:
        raise BadInput(f"cannot write {file}: {error.strerror}") from error


def convert(capture, options):
    """Writes the case of one draw or of all. True if there is at least one."""
    if options.draw is not None:
        action = next((action for action in capture.actions if action.eventId == options.draw), None)
        if action is None:
            raise BadInput(f"event {options.draw} is no draw; without --draw, all draws are listed")
        text = converted(capture, action)
        if text is not None:
            write(options.output, text) if options.output else print(text, end="")
        return text is not None
    written = 0
    try:
        os.makedirs(options.output, exist_ok=True)
    except OSError as error:
        raise BadInput(f"cannot write {options.output}: {error.strerror}") from error
    for action in capture.actions:
        text = converted(capture, action)
        if text is not None:
            write(os.path.join(options.output, f"event-{action.eventId}.json"), text)
            written += 1
    print(f"{written} of {plural(len(capture.actions), 'draw')} written to {options.output}")
    return written > 0


def main():
    parser = argparse.ArgumentParser(prog="rdc2case", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", metavar="FILE.rdc")
    parser.add_argument("--draw", type=int, metavar="EVENT")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--output", metavar="PATH")
    options = parser.parse_args()
    if options.all and (options.draw is not None or options.output is None):
        parser.error("--all needs --output FOLDER, and no --draw")
    try:
        import renderdoc
    except ImportError as error:
        say(f"{error}; it is in the package python3-renderdoc, for /usr/bin/python3")
        return 2
    try:
        capture = Capture(renderdoc, options.file)
        if options.draw is None and not options.all:
            list_draws(capture)
            return 0
        return 0 if convert(capture, options) else 2
    except BadInput as reason:
        say(f"{options.file}: {reason}")
        return 2


if __name__ == "__main__":
    sys.exit(main())
