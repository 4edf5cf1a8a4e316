// The inputs of fragment shaders: SLOTS interpolated vectors. Their qualifiers here are
// placeholders; qualified() (spirv.h) replaces them by those of a case.
//
// VALUE(i) is slot i. With CENTERS, a slot can be evaluated explicitly at the pixel's centre. With
// several samples there is no other way: an input without `centroid` and `sample` may be
// interpolated anywhere in the pixel (the Vulkan specification, Interpolation Decorations).
#if SLOTS > 0
layout(location = 0) noperspective sample in vec4 slot_0;
#endif
#if SLOTS > 1
layout(location = 1) noperspective sample in vec4 slot_1;
#endif
#if SLOTS > 2
layout(location = 2) noperspective sample in vec4 slot_2;
#endif
#if SLOTS > 3
layout(location = 3) noperspective sample in vec4 slot_3;
#endif
#if SLOTS > 4
layout(location = 4) noperspective sample in vec4 slot_4;
#endif
#if SLOTS > 5
layout(location = 5) noperspective sample in vec4 slot_5;
#endif
#if SLOTS > 6
layout(location = 6) noperspective sample in vec4 slot_6;
#endif

#if CENTERS
layout(constant_id = 0) const bool is_at_center_0 = false;
layout(constant_id = 1) const bool is_at_center_1 = false;
layout(constant_id = 2) const bool is_at_center_2 = false;
layout(constant_id = 3) const bool is_at_center_3 = false;
layout(constant_id = 4) const bool is_at_center_4 = false;
layout(constant_id = 5) const bool is_at_center_5 = false;
layout(constant_id = 6) const bool is_at_center_6 = false;
#define VALUE(i) (is_at_center_##i ? interpolateAtOffset(slot_##i, vec2(0)) : slot_##i)
#else
#define VALUE(i) slot_##i
#endif
