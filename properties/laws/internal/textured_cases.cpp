#include "properties/laws/internal/textured_cases.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "properties/generator.h"
#include "properties/random_floats.h"
#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

using cases::Filter;
using cases::Wrap;

constexpr std::size_t kCoordinates = 2;

void add_attributes(Draw& draw, cases::Case& c) {
  const std::size_t before = c.attributes.size();
  if (before >= kCoordinates) return;
  std::vector<float> values;
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    for (std::size_t a = 0; a < kCoordinates; ++a) {
      values.push_back(a < before ? c.attribute_values[v * before + a] : 0);
    }
  }
  c.attribute_values = std::move(values);
  while (c.attributes.size() < kCoordinates) {
    cases::Attribute attribute;
    attribute.name = "a" + std::to_string(c.attributes.size());
    if (draw.one_in(8)) attribute.interpolation = cases::Interpolation::noperspective;
    if (draw.one_in(8)) attribute.location = cases::Location::center;
    c.attributes.push_back(attribute);
  }
}

/// Window x or y of a vertex; 0 if w = 0.
double window_coordinate(const cases::Case& c, std::size_t vertex, std::size_t axis) {
  const cases::ClipVertex& p = c.positions[vertex];
  if (p.w == 0) return 0;
  const double ndc = double{axis == 0 ? p.x : p.y} / double{p.w};
  const double begin{axis == 0 ? c.viewport.x : c.viewport.y};
  const double size{axis == 0 ? c.viewport.width : c.viewport.height};
  return begin + (ndc + 1) / 2 * size;
}

/// An offset for a coordinate: often 0, or a multiple of the wrap's period.
double random_offset(Draw& draw) {
  const int periods = draw.between(-4, 4);
  switch (draw.between(0, 5)) {
    case 0:
      return periods;
    case 1:
      return periods * 1e6;
    case 2:
      return periods * 0x1p20 + 0.5;
    case 3:
      return draw.one_in(4) ? periods * 1e9 : -1;
    default:
      return 0;
  }
}

/// Sets an attribute that is affine in the window. If corners are on a grid, texel borders meet
/// samples.
void set_window_coordinate(Draw& draw, cases::Case& c, std::size_t attribute) {
  const std::size_t axis = draw.one_in(4) ? 1 - attribute : attribute;
  const int exponent = draw.between(-8, 0);
  const double step = power_of_two(exponent) * draw.pick(std::array{1, 1, 1, -1, 3, 5});
  const double offset = random_offset(draw);
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    const double value = offset + step * window_coordinate(c, v, axis);
    c.attribute_values[v * c.attributes.size() + attribute] = to_float(value);
  }
}

enum class CoordinateSort { fractions, near_fractions, free, far, huge };

float random_coordinate(Draw& draw, CoordinateSort kind, int parts) {
  switch (kind) {
    case CoordinateSort::fractions:
    case CoordinateSort::near_fractions: {
      const int n = draw.between(-2 * parts, 3 * parts);
      const float fraction = static_cast<float>(n) / static_cast<float>(parts);
      return kind == CoordinateSort::fractions ? fraction : nudged(draw, fraction);
    }
    case CoordinateSort::free:
      return draw.uniform(-2, 3);
    case CoordinateSort::far:
      return draw.spread(4, 30);
    case CoordinateSort::huge:
      break;
  }
  return draw.spread(24, 127);
}

/// Sets random coordinates of one CoordinateSort. Coordinates of the sort `fractions` are multiples
/// of 1/parts, the size of a texel in many textures.
void set_free_coordinate(Draw& draw, cases::Case& c, std::size_t attribute) {
  const auto kind = draw.pick(std::array{
      CoordinateSort::fractions, CoordinateSort::fractions, CoordinateSort::near_fractions,
      CoordinateSort::near_fractions, CoordinateSort::free, CoordinateSort::free,
      CoordinateSort::far, CoordinateSort::huge});
  const int parts = draw.pick(std::array{1, 3, 8, 16, 64});
  const bool is_constant = draw.one_in(8);
  const float constant = random_coordinate(draw, kind, parts);
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    float& value = c.attribute_values[v * c.attributes.size() + attribute];
    value = is_constant ? constant : random_coordinate(draw, kind, parts);
  }
}

}  // namespace

void set_coordinates(Draw& draw, cases::Case& c) {
  add_attributes(draw, c);
  for (std::size_t attribute = 0; attribute < kCoordinates; ++attribute) {
    switch (draw.between(0, 7)) {
      case 0:
        break;
      case 1:
      case 2:
      case 3:
        set_free_coordinate(draw, c, attribute);
        break;
      default:
        set_window_coordinate(draw, c, attribute);
    }
  }
}

Generated textured_case(Draw& draw) {
  Generated made;
  if (draw.one_in(2)) {
    const Generator* on_grid = find_generator("on-grid");
    made = {on_grid->make(draw), std::string(on_grid->name)};
  } else {
    made = generate_any(draw);
  }
  made.source.depth_test = cases::DepthTest::none;
  set_coordinates(draw, made.source);
  return made;
}

cases::Texturing texturing_of(Choices& choices, TexelBytes bytes) {
  constexpr std::array kSizes{8, 16, 64, 32, 1, 2, 3, 4, 5, 7, 12, 31, 33, 48, 63, 64};
  constexpr std::array kWraps{Wrap::repeat, Wrap::mirror, Wrap::clamp, Wrap::repeat};
  cases::Texturing texturing;
  texturing.filter = Filter::nearest;
  cases::Texture& texture = texturing.texture;
  texture.width = choices.pick(kSizes);
  texture.height = choices.pick(kSizes);
  texturing.wrap_s = choices.pick(kWraps);
  texturing.wrap_t = choices.pick(kWraps);
  for (int j = 0; j < texture.height; ++j) {
    for (int i = 0; i < texture.width; ++i) {
      for (std::size_t channel = 0; channel < 4; ++channel) {
        texture.texels.push_back(bytes(i, j, channel));
      }
    }
  }
  return texturing;
}

std::string_view to_word(Wrap wrap) {
  switch (wrap) {
    case Wrap::clamp:
      return "clamp";
    case Wrap::mirror:
      return "mirror";
    case Wrap::repeat:
      break;
  }
  return "repeat";
}

std::string wrap_words(const cases::Texturing& texturing) {
  return fmt::format("{} and {}", to_word(texturing.wrap_s), to_word(texturing.wrap_t));
}

std::uint8_t noise_byte(int i, int j, std::size_t channel) {
  std::uint32_t bits = static_cast<std::uint32_t>(i) * 0x9e3779b1U +
                       static_cast<std::uint32_t>(j) * 0x85ebca77U +
                       static_cast<std::uint32_t>(channel) * 0xc2b2ae3dU + 1U;
  bits ^= bits >> 15;
  bits *= 0x2c1b3c6dU;
  bits ^= bits >> 12;
  // Half of the bytes are black or white, which makes the hardest edges.
  if ((bits & 1U) != 0) return (bits & 2U) != 0 ? 255 : 0;
  return static_cast<std::uint8_t>(bits >> 8);
}

}  // namespace rastercheck::properties
