#include <algorithm>
#include <cassert>

#include "rasterizer/internal/color_kernels.h"
#include "rasterizer/shading.h"
#include "rasterizer/texture.h"

namespace rastercheck::rasterizer {

void round_values(const FragmentBatch& in, std::size_t attribute, float* out) {
  round_lanes(in.values[attribute], in.lanes, out);
}

void AttributesShader::operator()(const FragmentBatch& in, ShadedBatch& out) const {
  for (std::size_t i = 0; i < count; ++i) round_values(in, i, out.color[i]);
}

void GouraudShader::operator()(const FragmentBatch& in, ShadedBatch& out) const {
  assert(in.values.size() >= 3);
  const std::size_t count = std::min<std::size_t>(in.values.size(), 4);
  for (std::size_t i = 0; i < count; ++i) round_values(in, i, out.color[i]);
  if (count == 3) std::fill_n(out.color[3], in.lanes, 1.0F);
}

void TexturedShader::operator()(const FragmentBatch& in, ShadedBatch& out) const {
  sample(*texture, sampler, in, s, t, out.color.first<4>());
  if (!discard_below) return;
  const LaneMask below = find_below(out.color[3], *discard_below, in.lanes);
  for (std::size_t cell = 0; cell < in.cells.size(); ++cell) {
    const std::size_t lane = cell * FragmentBatch::kCellLanes;
    out.discarded[cell] |= static_cast<std::uint16_t>(below[lane / 64] >> lane % 64);
  }
}

}  // namespace rastercheck::rasterizer
