// Passes everything through, including CLIP_DISTANCES clip distances and, if POINTS, their size. Slots that a case does not
// have get arbitrary values, which are never used.
#version 450
layout(location = 0) in vec4 position;
layout(location = 1) in float number_in;
layout(location = 4) in vec4 slot_in_0;
layout(location = 5) in vec4 slot_in_1;
layout(location = 6) in vec4 slot_in_2;
layout(location = 7) in vec4 slot_in_3;
layout(location = 8) in vec4 slot_in_4;
layout(location = 9) in vec4 slot_in_5;
layout(location = 10) in vec4 slot_in_6;
layout(location = 0) out vec4 slot_0;
layout(location = 1) out vec4 slot_1;
layout(location = 2) out vec4 slot_2;
layout(location = 3) out vec4 slot_3;
layout(location = 4) out vec4 slot_4;
layout(location = 5) out vec4 slot_5;
layout(location = 6) out vec4 slot_6;
layout(location = 7) flat out float number;

#if POINTS
layout(location = 11) in float point_size;
#endif
#if CLIP_DISTANCES > 0
layout(location = 2) in vec4 clip_distances_0;
out float gl_ClipDistance[CLIP_DISTANCES];
#endif
#if CLIP_DISTANCES > 4
layout(location = 3) in vec4 clip_distances_1;
#endif

void main() {
  gl_Position = position;
#if POINTS
  gl_PointSize = point_size;
#endif
  number = number_in;
  slot_0 = slot_in_0;
  slot_1 = slot_in_1;
  slot_2 = slot_in_2;
  slot_3 = slot_in_3;
  slot_4 = slot_in_4;
  slot_5 = slot_in_5;
  slot_6 = slot_in_6;
#if CLIP_DISTANCES > 0
  for (int i = 0; i < min(CLIP_DISTANCES, 4); ++i) gl_ClipDistance[i] = clip_distances_0[i];
#endif
#if CLIP_DISTANCES > 4
  for (int i = 4; i < CLIP_DISTANCES; ++i) gl_ClipDistance[i] = clip_distances_1[i - 4];
#endif
}
