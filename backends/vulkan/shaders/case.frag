// Writes SLOTS interpolated vectors and the number of the triangle. The slots' qualifiers here are
// placeholders; qualified() (spirv.h) replaces them by those of a case. With CENTERS, a slot can be
// evaluated explicitly at the pixel's centre. With several samples there is no other way: an input
// without `centroid` and `sample` may be interpolated anywhere in the pixel (the Vulkan
// specification, Interpolation Decorations).
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

#if CENTERS
layout(constant_id = 0) const bool is_at_center_0 = false;
layout(constant_id = 1) const bool is_at_center_1 = false;
layout(constant_id = 2) const bool is_at_center_2 = false;
layout(constant_id = 3) const bool is_at_center_3 = false;
layout(constant_id = 4) const bool is_at_center_4 = false;
layout(constant_id = 5) const bool is_at_center_5 = false;
layout(constant_id = 6) const bool is_at_center_6 = false;
#define VALUE(slot, is_at_center) (is_at_center ? interpolateAtOffset(slot, vec2(0)) : slot)
#else
#define VALUE(slot, is_at_center) slot
#endif

void main() {
  number_out = number;
#if SLOTS > 0
  value_0 = VALUE(slot_0, is_at_center_0);
#endif
#if SLOTS > 1
  value_1 = VALUE(slot_1, is_at_center_1);
#endif
#if SLOTS > 2
  value_2 = VALUE(slot_2, is_at_center_2);
#endif
#if SLOTS > 3
  value_3 = VALUE(slot_3, is_at_center_3);
#endif
#if SLOTS > 4
  value_4 = VALUE(slot_4, is_at_center_4);
#endif
#if SLOTS > 5
  value_5 = VALUE(slot_5, is_at_center_5);
#endif
#if SLOTS > 6
  value_6 = VALUE(slot_6, is_at_center_6);
#endif
}
