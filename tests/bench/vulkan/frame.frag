// The attributes as red and green.
#version 450
layout(location = 0) in vec2 attributes;
layout(location = 0) out vec4 color;

void main() { color = vec4(attributes, 0, 1); }
