// Copies every sample of a multisampled image to a buffer, bit for bit: [layer][y][x][sample].
#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform texture2DMSArray image;
layout(set = 0, binding = 1) writeonly buffer Words { uint words[]; };
layout(push_constant) uniform Shape {
  uint width;
  uint height;
  uint samples;
  uint components;
};

void main() {
  uint x = gl_GlobalInvocationID.x / samples;
  uint sample_index = gl_GlobalInvocationID.x % samples;
  uvec2 rest = gl_WorkGroupID.yz;
  if (x >= width) return;
  vec4 texel = texelFetch(image, ivec3(x, rest.x, rest.y), int(sample_index));
  uint place = ((rest.y * height + rest.x) * width + x) * samples + sample_index;
  for (uint i = 0; i < components; ++i) words[place * components + i] = floatBitsToUint(texel[i]);
}
