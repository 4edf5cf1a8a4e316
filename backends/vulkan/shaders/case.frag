// Writes SLOTS interpolated vectors and the number of the triangle.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "slots.glsl"
layout(location = 7) flat in float number;
layout(location = 0) out float number_out;
#if SLOTS > 0
layout(location = 1) out vec4 value_0;
#endif
#if SLOTS > 1
layout(location = 2) out vec4 value_1;
#endif
#if SLOTS > 2
layout(location = 3) out vec4 value_2;
#endif
#if SLOTS > 3
layout(location = 4) out vec4 value_3;
#endif
#if SLOTS > 4
layout(location = 5) out vec4 value_4;
#endif
#if SLOTS > 5
layout(location = 6) out vec4 value_5;
#endif
#if SLOTS > 6
layout(location = 7) out vec4 value_6;
#endif

void main() {
  number_out = number;
#if SLOTS > 0
  value_0 = VALUE(0);
#endif
#if SLOTS > 1
  value_1 = VALUE(1);
#endif
#if SLOTS > 2
  value_2 = VALUE(2);
#endif
#if SLOTS > 3
  value_3 = VALUE(3);
#endif
#if SLOTS > 4
  value_4 = VALUE(4);
#endif
#if SLOTS > 5
  value_5 = VALUE(5);
#endif
#if SLOTS > 6
  value_6 = VALUE(6);
#endif
}
