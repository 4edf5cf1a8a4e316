// Writes a colour of four channels. Each channel comes from a component of one of SLOTS
// interpolated vectors or, with TEXTURED, all channels come from a texture looked up at the first
// two components. Or the channels are the facing or the window coordinates.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "slots.glsl"
layout(location = 0) out vec4 color;

// As PictureConstants (internal/pipelines.h).
layout(push_constant) uniform Constants {
  ivec4 sources;        // 4 · slot + component; −1: the channel is 1
  int shows;  // 0: values; 1, 2: their differences along x, y; 3: a texture's levels; 4: facing;
              // 5: window coordinates
  float discard_below;    // fragments with less alpha, or a lesser value, are not drawn
  int discarding_source;  // without a texture: of that value; −1: nothing is discarded
};

#if TEXTURED
layout(set = 0, binding = 0) uniform sampler2D image;
#endif

// Sources are not compile-time constants, so that cases whose attributes have other qualifiers
// share shaders.
float value_of(int source) {
#if SLOTS == 0
  return 1.0;
#else
  const vec4 slots[] = {VALUE(0)
#if SLOTS > 1
                        , VALUE(1)
#endif
#if SLOTS > 2
                        , VALUE(2)
#endif
#if SLOTS > 3
                        , VALUE(3)
#endif
#if SLOTS > 4
                        , VALUE(4)
#endif
#if SLOTS > 5
                        , VALUE(5)
#endif
#if SLOTS > 6
                        , VALUE(6)
#endif
  };
  return source < 0 ? 1.0 : slots[source >> 2][source & 3];
#endif
}

void main() {
  vec4 values;
  for (int i = 0; i < 4; ++i) values[i] = value_of(sources[i]);
#if TEXTURED
  color = shows == 3 ? texture(image, values.xy) : textureLod(image, values.xy, 0);
  if (color.a < discard_below) discard;
#else
  color = values;
  if (shows == 1) color = dFdxFine(values);
  if (shows == 2) color = dFdyFine(values);
  if (shows == 4) color = vec4(vec3(gl_FrontFacing ? 1.0 : 0.0), 1.0);
  if (shows == 5) color = gl_FragCoord;
  // After the differences, which are undefined in a quad without some of its fragments.
  if (discarding_source >= 0 && value_of(discarding_source) < discard_below) discard;
#endif
}
