// Finds values that come from the wrong place: attributes of other vertices or of another index,
// bytes in reverse order, a depth that is constant, reversed or of another range.
//
// A value at a sample is Σ b_i r_i, with the sample's barycentrics b in the triangle as it was
// placed. The vertices' values differ by 6/64 or more, so each explanation predicts another value
// at nearly all samples; the one that predicts (nearly) all of them is named, if the plain value
// does not.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "properties/probing/common_faults.h"

namespace rastercheck::properties {
namespace {

using records::Sureness;
using Permutation = std::array<std::size_t, 3>;

constexpr std::array<Permutation, 6> kPermutations{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}}};

float with_bytes_reversed(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return std::bit_cast<float>(bits << 24 | (bits & 0xff00U) << 8 | (bits >> 8 & 0xff00U) |
                              bits >> 24);
}

/// A fragment's place in its triangle.
struct FragmentPlace {
  std::size_t fragment = 0;
  std::uint32_t triangle = 0;
  std::array<double, 3> barycentrics{};
  /// The greatest change of a value, as a share of the range of the vertices' values, if positions
  /// are off by kFineMargin.
  double slack = 0;
};

/// Returns the places of the fragments that surely lie inside their triangles.
std::vector<FragmentPlace> places_of(const FirstDrawing& first, const Placement& placement) {
  const FineDrawing& drawing = first.drawing;
  const cases::Fragments& drawn = drawing.drawn.fragments;
  std::vector<FragmentPlace> all;
  std::uint32_t last = 0;
  FineEdges edges{};
  double area = 0;
  for (std::size_t f = 0; f < drawn.size(); ++f) {
    const std::uint32_t t = drawn.triangle[f];
    if (t >= drawing.triangles.size()) continue;
    if (area == 0 || t != last) {
      const FineTriangle at = placed(drawing.triangles[t], placement);
      edges = edges_of(at);
      area = static_cast<double>(std::abs(area_of(at)));
      last = t;
    }
    const int x = drawn.x[f];
    const int y = drawn.y[f];
    if (depth_inside(edges, x, y) < kFineMargin) continue;
    FragmentPlace place{f, t, {}, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const FineEdge& opposite = edges[(i + 1) % 3];
      place.barycentrics[i] = static_cast<double>(opposite.at(x, y)) / area;
      place.slack += static_cast<double>(std::abs(opposite.a) + std::abs(opposite.b)) *
                     static_cast<double>(kFinePixel) * kFineMargin / area;
    }
    all.push_back(place);
  }
  return all;
}

double mean_of(const std::array<float, 3>& values, const FragmentPlace& place) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += place.barycentrics[i] * double{values[i]};
  return sum;
}

/// Returns how far a value may be off. Colours of 8 bits round to 1/255 of the greatest value,
/// which is at most 1 in the first drawing.
double value_tolerance(const std::array<float, 3>& values, const FragmentPlace& place) {
  constexpr double kByteRounding = 1.0 / 255;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return place.slack * (double{*most} - double{*least}) + kByteRounding;
}

/// Where an attribute's values come from. Sentences name attributes by their index, because
/// backends see no other name.
struct AttributeSource {
  std::size_t attribute = 0;
  Permutation vertices{0, 1, 2};
  bool is_reversed = false;  ///< bytes
};

std::array<float, 3> values_at(const cases::Case& c, std::uint32_t triangle,
                               const AttributeSource& source) {
  std::array<float, 3> values{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = c.triangles[triangle][source.vertices[i]];
    values[i] = c.attributes_of(vertex)[source.attribute];
  }
  return values;
}

/// Counts the fragments whose attribute `to` is explained by a source.
Sureness votes_for_source(const FirstDrawing& first, const std::vector<FragmentPlace>& places,
                          std::size_t to, const AttributeSource& source) {
  const DrawnCase& drawn = first.drawing.drawn;
  Sureness votes{"values"};
  for (const FragmentPlace& place : places) {
    const std::array<float, 3> values = values_at(drawn.source, place.triangle, source);
    float value = drawn.fragments.attributes_of(place.fragment)[to];
    if (source.is_reversed) value = with_bytes_reversed(value);
    const bool is_explained =
        std::abs(double{value} - mean_of(values, place)) <= value_tolerance(values, place);
    ++(is_explained ? votes.in_favour : votes.against);
  }
  return votes;
}

struct FoundSource {
  AttributeSource source;
  Sureness votes;
};

/// Returns the first source that explains (nearly) all values of an attribute; the plain one comes
/// first, then those with one change.
std::optional<FoundSource> source_of(const FirstDrawing& first,
                                     const std::vector<FragmentPlace>& places, std::size_t to) {
  const std::size_t count = first.drawing.drawn.source.attributes.size();
  std::vector<std::pair<int, AttributeSource>> all;
  for (std::size_t from = 0; from < count; ++from) {
    for (const Permutation& vertices : kPermutations) {
      for (const bool is_reversed : {false, true}) {
        const int changes =
            (from != to ? 1 : 0) + (vertices != kPermutations[0] ? 1 : 0) + (is_reversed ? 1 : 0);
        all.emplace_back(changes, AttributeSource{from, vertices, is_reversed});
      }
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [changes, source] : all) {
    const Sureness votes = votes_for_source(first, places, to, source);
    if (is_sure(votes)) return FoundSource{source, votes};
  }
  return std::nullopt;
}

void add_votes(Sureness& to, const Sureness& more) {
  to.unit = more.unit;
  to.in_favour += more.in_favour;
  to.against += more.against;
}

std::string vertices_sentence(const Permutation& v) {
  return fmt::format(
      "Attributes are those of other vertices: vertices 0, 1 and 2 of a triangle get the values of "
      "vertices {}, {} and {}.",
      v[0], v[1], v[2]);
}

// --- Depth ---------------------------------------------------------------------------------------

/// A depth in place of the right one.
struct DepthForm {
  const char* id;
  const char* sentence;
  double (*depth)(double right);
  bool is_reversed_bytes = false;
};

constexpr std::array<DepthForm, 7> kDepthForms{{
    {"depth-signed", "Depth runs from -1 to 1, not from 0 to 1.",
     [](double d) { return 2 * d - 1; }},
    {"depth-halved",
     "Depth runs from 1/2 to 1, not from 0 to 1: z/w is mapped by (z/w + 1) / 2 once too "
     "often.",
     [](double d) { return (d + 1) / 2; }},
    {"depth-reversed", "Depth is reversed: 1 is nearest and 0 farthest.",
     [](double d) { return 1 - d; }},
    {"depth-reversed", "Depth is reversed and runs from -1 to 1: 1 is nearest and -1 farthest.",
     [](double d) { return 1 - 2 * d; }},
    {"depth-reversed", "Depth is reversed and runs from 0 to -1: its sign is wrong.",
     [](double d) { return -d; }},
    {"depth-reversed", "Depth is reversed and runs from 1 to 1/2.",
     [](double d) { return 1 - d / 2; }},
    {"depth-bytes", "The bytes of depths are in reverse order.", [](double d) { return d; }, true},
}};

Sureness votes_for_depth(const FirstDrawing& first, const std::vector<FragmentPlace>& places,
                         const DepthForm& form) {
  Sureness votes{"depths"};
  for (const FragmentPlace& place : places) {
    const std::array<float, 3>& right = first.depths[place.triangle];
    std::array<float, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) {
      values[i] = static_cast<float>(form.depth(double{right[i]}));
    }
    float depth = first.drawing.drawn.fragments.depth[place.fragment];
    if (form.is_reversed_bytes) depth = with_bytes_reversed(depth);
    const bool is_explained =
        std::abs(double{depth} - mean_of(values, place)) <= value_tolerance(values, place);
    ++(is_explained ? votes.in_favour : votes.against);
  }
  return votes;
}

}  // namespace

std::vector<FoundFault> attribute_faults(const FirstDrawing& first, const Placement& placement) {
  const std::size_t count = first.drawing.drawn.source.attributes.size();
  const std::vector<FragmentPlace> places = places_of(first, placement);
  std::vector<FoundFault> faults;
  Sureness of_bytes;
  Sureness of_order;
  std::string order;
  std::vector<std::pair<Permutation, Sureness>> permuted;
  for (std::size_t to = 0; to < count; ++to) {
    const std::optional<FoundSource> found = source_of(first, places, to);
    if (!found) continue;
    const AttributeSource& source = found->source;
    if (source.is_reversed) add_votes(of_bytes, found->votes);
    if (source.attribute != to) {
      add_votes(of_order, found->votes);
      order +=
          fmt::format("{}{} has the values of {}", order.empty() ? "" : ", ", to, source.attribute);
    }
    if (source.vertices == kPermutations[0]) continue;
    const auto known = std::find_if(permuted.begin(), permuted.end(),
                                    [&](const auto& one) { return one.first == source.vertices; });
    if (known == permuted.end()) {
      permuted.emplace_back(source.vertices, found->votes);
    } else {
      add_votes(known->second, found->votes);
    }
  }
  faults.reserve(faults.size() + permuted.size() + 2);
  for (const auto& [vertices, votes] : permuted) {
    faults.push_back({"attributes-of-other-vertices", "attributes of vertices",
                      vertices_sentence(vertices), votes});
  }
  if (!order.empty()) {
    faults.push_back({"attributes-in-another-order", "attributes by index",
                      fmt::format("Attributes are in another order: attribute {}.", order),
                      of_order});
  }
  if (of_bytes.in_favour > 0) {
    faults.push_back({"attribute-bytes", "bytes of attributes",
                      "The bytes of attributes are in reverse order: float32 of the other "
                      "endianness.",
                      of_bytes});
  }
  return faults;
}

std::vector<FoundFault> depth_faults(const FirstDrawing& first, const Placement& placement) {
  const std::vector<FragmentPlace> places = places_of(first, placement);
  if (places.empty()) return {};
  const DepthForm plain{"", "", [](double d) { return d; }};
  if (is_sure(votes_for_depth(first, places, plain))) return {};
  const std::vector<float>& depths = first.drawing.drawn.fragments.depth;
  const float one = depths[places[0].fragment];
  Sureness constant{"depths"};
  for (const FragmentPlace& place : places) {
    ++(depths[place.fragment] == one ? constant.in_favour : constant.against);
  }
  if (is_sure(constant)) {
    return {{"depth-constant", "depth", fmt::format("Depth is {:g} everywhere.", one), constant}};
  }
  for (const DepthForm& form : kDepthForms) {
    const Sureness votes = votes_for_depth(first, places, form);
    if (is_sure(votes)) return {{form.id, "depth", form.sentence, votes}};
  }
  return {};
}

}  // namespace rastercheck::properties
