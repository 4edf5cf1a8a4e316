#include "backends/gl/internal/picture_texture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace rastercheck::backends::gl {
namespace {

/// The texels that one texel of the next level covers along an axis.
struct Covered {
  int first = 0;
  std::vector<std::uint64_t> overlaps;  ///< in 1/m texel, where the next level has m texels
};

/// Texel i of m covers [i n/m, (i + 1) n/m), in texels of a level of n.
Covered covered(int i, int n, int m) {
  Covered all;
  all.first = i * n / m;
  for (int texel = all.first; texel * m < (i + 1) * n; ++texel) {
    const int begin = std::max(texel * m, i * n);
    const int end = std::min((texel + 1) * m, (i + 1) * n);
    all.overlaps.push_back(static_cast<std::uint64_t>(end - begin));
  }
  return all;
}

GLint wrap_of(cases::Wrap wrap) {
  switch (wrap) {
    case cases::Wrap::clamp:
      return GL_CLAMP_TO_EDGE;
    case cases::Wrap::mirror:
      return GL_MIRRORED_REPEAT;
    case cases::Wrap::repeat:
      break;
  }
  return GL_REPEAT;
}

GLint minifying(cases::Filter filter) {
  switch (filter) {
    case cases::Filter::bilinear:
      return GL_LINEAR;
    case cases::Filter::trilinear:
      return GL_LINEAR_MIPMAP_LINEAR;
    case cases::Filter::nearest:
      break;
  }
  return GL_NEAREST;
}

void upload(const cases::Texture& level, GLint number) {
  glTexImage2D(GL_TEXTURE_2D, number, GL_RGBA8, level.width, level.height, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, level.texels.data());
}

}  // namespace

cases::Texture next_level(const cases::Texture& level) {
  cases::Texture next{std::max(1, level.width / 2), std::max(1, level.height / 2), {}};
  for (int t = 0; t < next.height; ++t) {
    const Covered rows = covered(t, level.height, next.height);
    for (int s = 0; s < next.width; ++s) {
      const Covered columns = covered(s, level.width, next.width);
      std::array<std::uint64_t, 4> sums{};
      for (std::size_t row = 0; row < rows.overlaps.size(); ++row) {
        for (std::size_t column = 0; column < columns.overlaps.size(); ++column) {
          const std::size_t at =
              (static_cast<std::size_t>(rows.first) + row) * static_cast<std::size_t>(level.width) +
              static_cast<std::size_t>(columns.first) + column;
          for (std::size_t k = 0; k < sums.size(); ++k) {
            sums[k] += rows.overlaps[row] * columns.overlaps[column] * level.texels[4 * at + k];
          }
        }
      }
      // The overlaps of an axis add up to the level's number of texels.
      const auto whole =
          static_cast<std::uint64_t>(level.width) * static_cast<std::uint64_t>(level.height);
      for (const std::uint64_t sum : sums) {
        next.texels.push_back(static_cast<std::uint8_t>((2 * sum + whole) / (2 * whole)));
      }
    }
  }
  return next;
}

Object make_picture_texture(const cases::Texturing& texturing) {
  Object texture = generate_texture();
  glBindTexture(GL_TEXTURE_2D, texture.name());
  upload(texturing.texture, 0);
  GLint last = 0;
  if (texturing.filter == cases::Filter::trilinear) {
    cases::Texture level = texturing.texture;
    while (level.width > 1 || level.height > 1) {
      level = next_level(level);
      upload(level, ++last);
    }
  }
  const GLint magnifying = texturing.filter == cases::Filter::nearest ? GL_NEAREST : GL_LINEAR;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, last);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minifying(texturing.filter));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magnifying);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap_of(texturing.wrap_s));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap_of(texturing.wrap_t));
  return texture;
}

}  // namespace rastercheck::backends::gl
