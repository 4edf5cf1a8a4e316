#version 450
// Shows the four attributes. In Vulkan the fragment shader alone says how they are interpolated.
// LINEAR: how in_window is.
layout(location = 0) in vec2 uv;
layout(location = 1) LINEAR in float in_window;
layout(location = 3) flat in float of_first;
layout(location = 0) out vec4 color;

void main() { color = vec4(uv, in_window, of_first); }
