// Two attributes, perspective, for frame.frag.
#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in vec2 attributes_in;
layout(location = 0) out vec2 attributes;

void main() {
  gl_Position = position;
  attributes = attributes_in;
}
