#include "tests/bench/gl/draw_state.h"

namespace rastercheck::backends::gl::bench {
namespace {

GLenum depth_function(cases::DepthFunction function) {
  switch (function) {
    case cases::DepthFunction::always:
      return GL_ALWAYS;
    case cases::DepthFunction::never:
      return GL_NEVER;
    case cases::DepthFunction::less:
      return GL_LESS;
    case cases::DepthFunction::equal:
      return GL_EQUAL;
    case cases::DepthFunction::less_or_equal:
      return GL_LEQUAL;
    case cases::DepthFunction::greater:
      return GL_GREATER;
    case cases::DepthFunction::not_equal:
      return GL_NOTEQUAL;
    case cases::DepthFunction::greater_or_equal:
      return GL_GEQUAL;
  }
  return GL_ALWAYS;
}

GLint wrap_mode(cases::Wrap wrap) {
  switch (wrap) {
    case cases::Wrap::repeat:
      return GL_REPEAT;
    case cases::Wrap::clamp:
      return GL_CLAMP_TO_EDGE;
    case cases::Wrap::mirror:
      return GL_MIRRORED_REPEAT;
  }
  return GL_REPEAT;
}

}  // namespace

void set_depth_state(const DrawState& state) {
  const bool has_test = state.writes_depth || state.depth_function != cases::DepthFunction::always;
  (has_test ? glEnable : glDisable)(GL_DEPTH_TEST);
  glDepthFunc(depth_function(state.depth_function));
  glDepthMask(state.writes_depth ? GL_TRUE : GL_FALSE);
}

void set_blend_state(cases::Blend blend) {
  (blend == cases::Blend::off ? glDisable : glEnable)(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  if (blend == cases::Blend::over) {
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  } else {
    glBlendFunc(GL_ONE, GL_ONE);
  }
}

Object make_sampler(const Texturing& texturing) {
  const GLint within = texturing.filter == cases::Filter::nearest ? GL_NEAREST : GL_LINEAR;
  const GLint smaller =
      texturing.filter == cases::Filter::trilinear ? GL_LINEAR_MIPMAP_LINEAR : within;
  Object sampler = gl::make_sampler();
  glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, wrap_mode(texturing.wrap_s));
  glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, wrap_mode(texturing.wrap_t));
  glSamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, within);
  glSamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, smaller);
  return sampler;
}

}  // namespace rastercheck::backends::gl::bench
