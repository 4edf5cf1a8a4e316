#version 450
// Passes vertices on. The product keeps the bits of a position if `scale` is a power of two.
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 values;
layout(location = 2) in float distance_to_plane;
layout(push_constant) uniform Push { float scale; };
layout(location = 0) out vec2 uv;
layout(location = 1) out float in_window;
layout(location = 3) out float of_first;
out float gl_ClipDistance[1];

void main() {
  gl_Position = position * scale;
  gl_ClipDistance[0] = distance_to_plane;
  uv = values.xy;
  in_window = values.z;
  of_first = values.w;
}
