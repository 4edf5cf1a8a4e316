#pragma once

// The properties that two pictures of a shaded scene must share before their times are compared.
// Single pixels are compared, because means (summary.h) of a texture are much the same wherever it
// is sampled.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rastercheck::bench {

/// Red, green, blue, alpha and depth of a pixel, where byte k means k/255.
using Probe = std::array<std::uint8_t, 5>;
using Probes = std::vector<Probe>;

/// Takes probes of a picture of that size with one sample per pixel. `color_at(pixel)` is four
/// floats.
template <typename ColorAt>
Probes take_probes(const glm::ivec2& size, std::span<const float> depth, const ColorAt& color_at) {
  // Odd, so that probes fall on every lane of the SIMD vectors: a fault may affect only some lanes.
  constexpr int kStep = 7;
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0F, 1.0F)));
  };
  Probes probes;
  for (int y = 0; y < size.y; y += kStep) {
    for (int x = 0; x < size.x; x += kStep) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                         static_cast<std::size_t>(x);
      const std::array<float, 4> color = color_at(pixel);
      probes.push_back(
          {byte(color[0]), byte(color[1]), byte(color[2]), byte(color[3]), byte(depth[pixel])});
    }
  }
  return probes;
}

/// Writes the probes as one word: two letters a…p for each byte.
inline std::string to_word(const Probes& probes) {
  std::string word;
  for (const Probe& probe : probes) {
    for (const std::uint8_t byte : probe) {
      word += static_cast<char>('a' + byte / 16);
      word += static_cast<char>('a' + byte % 16);
    }
  }
  return word;
}

/// Reads a word that to_word() made.
inline Probes from_word(std::string_view word) {
  Probes probes(word.size() / (2 * Probe{}.size()));
  std::size_t at = 0;
  for (Probe& probe : probes) {
    for (std::uint8_t& byte : probe) {
      byte = static_cast<std::uint8_t>(16 * (word[at] - 'a') + (word[at + 1] - 'a'));
      at += 2;
    }
  }
  return probes;
}

/// The share of probes that differ by more than `tolerance` in some byte; 1 if the two sides differ
/// in number.
inline double share_apart(const Probes& a, const Probes& b, int tolerance) {
  if (a.size() != b.size() || a.empty()) return 1;
  std::size_t apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    bool is_apart = false;
    for (std::size_t c = 0; c < a[i].size(); ++c) {
      is_apart = is_apart || std::abs(a[i][c] - b[i][c]) > tolerance;
    }
    apart += is_apart ? 1 : 0;
  }
  return static_cast<double>(apart) / static_cast<double>(a.size());
}

}  // namespace rastercheck::bench
