// Appends a record of each fragment to a buffer (backends/appended_drawing.h). Writes nothing else,
// because lavapipe loses records if colours are written as well.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "slots.glsl"
layout(location = 7) flat in float number;
layout(set = 0, binding = 0) buffer Records {
  uint count;  // number of fragments, including those without a record
  uint words[];
};
layout(push_constant) uniform Room { uint room; };  // number of records that fit

#define PUT(index, slot)                                       \
  {                                                            \
    const uvec4 bits = floatBitsToUint(slot);                  \
    for (uint k = 0; k < 4; ++k) words[at + 3 + 4 * (index) + k] = bits[k]; \
  }

void main() {
  uint at = atomicAdd(count, 1);
  if (at >= room) return;
  at *= 3 + 4 * SLOTS;
  words[at] = floatBitsToUint(number);
  words[at + 1] = uint(gl_FragCoord.x) | uint(gl_FragCoord.y) << 16;
  words[at + 2] = floatBitsToUint(gl_FragCoord.z);
#if SLOTS > 0
  PUT(0, slot_0)
#endif
#if SLOTS > 1
  PUT(1, slot_1)
#endif
#if SLOTS > 2
  PUT(2, slot_2)
#endif
#if SLOTS > 3
  PUT(3, slot_3)
#endif
#if SLOTS > 4
  PUT(4, slot_4)
#endif
#if SLOTS > 5
  PUT(5, slot_5)
#endif
#if SLOTS > 6
  PUT(6, slot_6)
#endif
}
