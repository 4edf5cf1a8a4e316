// Writes SLOTS interpolated vectors and the number of the triangle. The slots are qualified in the
// way that leaves a word for every qualifier; qualified() (spirv.h) puts in those of a case.
#version 450
layout(location = 7) flat in float number;
layout(location = 0) out float number_out;
#if SLOTS > 0
layout(location = 0) noperspective sample in vec4 slot_0;
layout(location = 1) out vec4 value_0;
#endif
#if SLOTS > 1
layout(location = 1) noperspective sample in vec4 slot_1;
layout(location = 2) out vec4 value_1;
#endif
#if SLOTS > 2
layout(location = 2) noperspective sample in vec4 slot_2;
layout(location = 3) out vec4 value_2;
#endif
#if SLOTS > 3
layout(location = 3) noperspective sample in vec4 slot_3;
layout(location = 4) out vec4 value_3;
#endif
#if SLOTS > 4
layout(location = 4) noperspective sample in vec4 slot_4;
layout(location = 5) out vec4 value_4;
#endif
#if SLOTS > 5
layout(location = 5) noperspective sample in vec4 slot_5;
layout(location = 6) out vec4 value_5;
#endif
#if SLOTS > 6
layout(location = 6) noperspective sample in vec4 slot_6;
layout(location = 7) out vec4 value_6;
#endif

void main() {
  number_out = number;
#if SLOTS > 0
  value_0 = slot_0;
#endif
#if SLOTS > 1
  value_1 = slot_1;
#endif
#if SLOTS > 2
  value_2 = slot_2;
#endif
#if SLOTS > 3
  value_3 = slot_3;
#endif
#if SLOTS > 4
  value_4 = slot_4;
#endif
#if SLOTS > 5
  value_5 = slot_5;
#endif
#if SLOTS > 6
  value_6 = slot_6;
#endif
}
