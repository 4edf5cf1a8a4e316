#include "cli/gallery/internal/textures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rastercheck::gallery {
namespace {

using reports::Color;

constexpr Color kInk{38, 52, 84};
constexpr Color kCream{244, 238, 222};
constexpr Color kApricot{226, 126, 74};
constexpr Color kSage{108, 158, 140};

/// Returns ⌊coordinate · kTexels⌋ modulo kTexels, never below 0.
int texel(float coordinate) {
  const double share = double{coordinate} - std::floor(double{coordinate});
  return std::min(static_cast<int>(share * kTexels), kTexels - 1);
}

bool is_dark_check(std::span<const float> uv) {
  constexpr int kCheck = kTexels / 8;
  // At u = 1 use the last check, not the first: the board does not repeat.
  const auto check = [](float coordinate) {
    return std::clamp(static_cast<int>(std::floor(coordinate * kTexels)), 0, kTexels - 1) / kCheck;
  };
  return (check(uv[0]) + check(uv[1])) % 2 == 1;
}

Color mixed(const Color& a, const Color& b, double share) {
  Color color{};
  for (std::size_t i = 0; i < 3; ++i) {
    color[i] = static_cast<std::uint8_t>(std::lround(a[i] + (b[i] - a[i]) * share));
  }
  return color;
}

}  // namespace

Shader checkerboard(std::uint32_t group) {
  return [group](std::uint32_t triangle, std::span<const float> uv) -> std::optional<Color> {
    const Color color = is_dark_check(uv) ? kInk : kCream;
    if (group == 0) return color;
    constexpr std::array<double, 3> kTints{0, 0.16, 0.32};
    return mixed(color, kApricot, kTints[triangle / group % kTints.size()]);
  };
}

Shader tiles() {
  return [](std::uint32_t /*triangle*/, std::span<const float> uv) -> std::optional<Color> {
    const int s = texel(uv[0]);
    const int t = texel(uv[1]);
    constexpr int kBorder = 10;
    if (std::min({s, t, kTexels - 1 - s, kTexels - 1 - t}) < kBorder) return kInk;
    const int ds = s - 88;
    const int dt = t - 160;
    if (ds * ds + dt * dt < 52 * 52) return kApricot;
    if (s > 150 && s < 216 && t > 36 && t < 150) return kSage;
    return kCream;
  };
}

Shader trellis() {
  return [board = checkerboard()](std::uint32_t triangle,
                                  std::span<const float> uv) -> std::optional<Color> {
    if (triangle < 2) return mixed(*board(triangle, uv), kCream, 0.35);
    constexpr int kSpacing = kTexels / 4;
    constexpr int kBar = 20;
    const int s = (texel(uv[0]) + kBar / 2) % kSpacing;
    const int t = (texel(uv[1]) + kBar / 2) % kSpacing;
    if (s < kBar) return kApricot;
    if (t < kBar) return kSage;
    return std::nullopt;
  };
}

Shader vertex_colors() {
  return [](std::uint32_t /*triangle*/, std::span<const float> rgb) -> std::optional<Color> {
    Color color{};
    for (std::size_t i = 0; i < 3; ++i) {
      color[i] = static_cast<std::uint8_t>(std::lround(std::clamp(rgb[i], 0.0F, 1.0F) * 255));
    }
    return color;
  };
}

}  // namespace rastercheck::gallery
