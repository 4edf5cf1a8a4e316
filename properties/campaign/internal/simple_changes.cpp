#include "properties/campaign/internal/simple_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "properties/random_state.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using cases::ClipVertex;
using cases::FramebufferSize;
using cases::Interpolation;
using cases::Location;
using cases::Rules;
using cases::SamplePlace;

/// Mirrors an index below `count`. Fragments outside the framebuffer stay where they are.
std::uint32_t mirrored(std::uint32_t i, int count) {
  const auto end = static_cast<std::uint32_t>(count);
  return i < end ? end - 1 - i : i;
}

SamplePlace other_row(const FramebufferSize& size, SamplePlace place) {
  place.y = mirrored(place.y, size.height);
  return place;
}

SamplePlace other_column(const FramebufferSize& size, SamplePlace place) {
  place.x = mirrored(place.x, size.width);
  return place;
}

SamplePlace exchanged(const FramebufferSize& /*size*/, SamplePlace place) {
  std::swap(place.x, place.y);
  return place;
}

SamplePlace other_sample(const FramebufferSize& size, SamplePlace place) {
  place.sample = mirrored(place.sample, size.samples);
  return place;
}

/// Gives each triangle vertices of its own.
void unshare_vertices(Case& c) {
  const Case shared = c;
  c.positions.clear();
  c.attribute_values.clear();
  c.clip_distances.clear();
  for (cases::Triangle& triangle : c.triangles) {
    for (std::uint32_t& vertex : triangle) {
      const std::size_t from =
          std::exchange(vertex, static_cast<std::uint32_t>(c.positions.size()));
      c.positions.push_back(shared.positions[from]);
      const auto values = shared.attributes_of(from);
      c.attribute_values.insert(c.attribute_values.end(), values.begin(), values.end());
      const auto distances = shared.clip_distances_of(from);
      c.clip_distances.insert(c.clip_distances.end(), distances.begin(), distances.end());
    }
  }
}

/// [vertex of a triangle] the vertex from which it gets its attribute values.
using Sources = std::array<std::size_t, 3>;

/// Moves the values of some attributes between the vertices of each triangle.
template <typename IsMoved>
void move_values(Case& c, const Sources& sources, const IsMoved& is_moved) {
  if (std::none_of(c.attributes.begin(), c.attributes.end(), is_moved)) return;
  unshare_vertices(c);
  const std::size_t count = c.attributes.size();
  const std::vector<float> before = c.attribute_values;
  for (std::size_t i = 0; i < c.positions.size(); ++i) {
    const std::size_t from = i / 3 * 3 + sources[i % 3];
    for (std::size_t a = 0; a < count; ++a) {
      if (is_moved(c.attributes[a])) c.attribute_values[i * count + a] = before[from * count + a];
    }
  }
}

/// Removes triangles but keeps the numbers of the others: a triangle that is a point draws nothing.
template <typename IsGone>
void drop_triangles(Case& c, const IsGone& is_gone) {
  for (cases::Triangle& triangle : c.triangles) {
    const bool some = std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
      return is_gone(c.positions[vertex]);
    });
    if (some) triangle = {triangle[0], triangle[0], triangle[0]};
  }
}

void set_interpolation(Case& c, Interpolation from, Interpolation to) {
  for (cases::Attribute& a : c.attributes) {
    if (a.interpolation == from) a.interpolation = to;
  }
}

void set_locations(Case& c, Location location) {
  for (cases::Attribute& a : c.attributes) a.location = location;
}

void move_centroids(Case& c, Location to) {
  for (cases::Attribute& a : c.attributes) {
    if (a.location == Location::centroid) a.location = to;
  }
}

/// Turns the viewport upside down within the framebuffer.
void mirror_viewport(Case& c) {
  c.viewport.y = static_cast<float>(c.framebuffer.height) - c.viewport.y;
  c.viewport.height = -c.viewport.height;
}

/// Mirrors the scissor's rows within the framebuffer, unless case files could not hold the result.
void mirror_scissor(Case& c) {
  if (!c.scissor) return;
  const int y = c.framebuffer.height - c.scissor->y - c.scissor->height;
  if (std::abs(y) <= cases::kMaxSize) c.scissor->y = y;
}

void swap_ties(Case& c) {
  const bool is_top = c.fill_rule == cases::TieRule::top_left;
  c.fill_rule = is_top ? cases::TieRule::bottom_left : cases::TieRule::top_left;
}

/// A change that needs only the case.
struct PlainChange {
  std::string_view change;
  void (*apply)(Case& c);
  decltype(SimpleChange::place_of) place_of = nullptr;
  bool swaps_ties = false;
  bool is_of_samples = false;  ///< has no effect with one sample per pixel
};

constexpr std::array kOfPlaces{
    PlainChange{"y points in the other direction",
                [](Case& c) {
                  for (ClipVertex& p : c.positions) p.y = -p.y;
                }},
    PlainChange{"the target is upside down", [](Case& /*c*/) {}, &other_row},
    PlainChange{"the viewport is upside down in the target", &mirror_viewport},
    PlainChange{"x points in the other direction",
                [](Case& c) {
                  for (ClipVertex& p : c.positions) p.x = -p.x;
                }},
    PlainChange{"the target is mirrored left to right", [](Case& /*c*/) {}, &other_column},
    PlainChange{"x and y are exchanged", [](Case& /*c*/) {}, &exchanged},
    PlainChange{"the negative height of the viewport is positive",
                [](Case& c) {
                  if (!(c.viewport.height < 0)) return;
                  c.viewport.y += c.viewport.height;
                  c.viewport.height = -c.viewport.height;
                }},
    PlainChange{"the viewport begins at the target's corner",
                [](Case& c) {
                  c.viewport.x = 0;
                  c.viewport.y = 0;
                }},
    PlainChange{"the viewport is the whole target",
                [](Case& c) {
                  c.viewport.x = 0;
                  c.viewport.y = 0;
                  c.viewport.width = static_cast<float>(c.framebuffer.width);
                  c.viewport.height = static_cast<float>(c.framebuffer.height);
                }},
    PlainChange{"there is no scissor", [](Case& c) { c.scissor.reset(); }},
    PlainChange{"the scissor's rows count from the other end", &mirror_scissor},
    PlainChange{"the scissor includes its far ends",
                [](Case& c) {
                  if (!c.scissor) return;
                  c.scissor->width = std::min(c.scissor->width + 1, cases::kMaxSize);
                  c.scissor->height = std::min(c.scissor->height + 1, cases::kMaxSize);
                }},
    PlainChange{"nothing is culled", [](Case& c) { c.cull = cases::Cull::none; }},
    PlainChange{"the other side is culled",
                [](Case& c) {
                  if (c.cull == cases::Cull::none) return;
                  const bool is_back = c.cull == cases::Cull::back;
                  c.cull = is_back ? cases::Cull::front : cases::Cull::back;
                }},
    PlainChange{"there are no clip distances",
                [](Case& c) {
                  c.clip_distances.clear();
                  c.clip_distance_count = 0;
                }},
    PlainChange{"clip distances have the other sign",
                [](Case& c) {
                  for (float& distance : c.clip_distances) distance = -distance;
                }},
    PlainChange{"nothing is clipped at the near and far planes",
                [](Case& c) { c.depth_clamp = true; }},
    PlainChange{"everything is clipped at the near and far planes",
                [](Case& c) { c.depth_clamp = false; }},
    PlainChange{"triangles with a vertex of w <= 0 are not drawn",
                [](Case& c) { drop_triangles(c, [](const ClipVertex& p) { return !(p.w > 0); }); }},
    PlainChange{"triangles with a vertex beyond the near or far plane are not drawn",
                [](Case& c) {
                  drop_triangles(c, [&c](const ClipVertex& p) {
                    return p.z < near_depth(c) * p.w || p.z > p.w;
                  });
                }},
    PlainChange{"there is no depth test", [](Case& c) { c.depth_test = cases::DepthTest::none; }},
    PlainChange{"the depth buffer is cleared to 1", [](Case& c) { c.depth_clear.reset(); }},
    PlainChange{"depth is not biased", [](Case& c) { c.depth_bias = {}; }},
    PlainChange{"the slope biases no depth", [](Case& c) { c.depth_bias.slope = 0; }},
    PlainChange{"the constant biases no depth", [](Case& c) { c.depth_bias.constant = 0; }},
    PlainChange{"the bias is not clamped", [](Case& c) { c.depth_bias.clamp = 0; }},
    PlainChange{"depth is stored as float32",
                [](Case& c) { c.depth_format = cases::DepthFormat::float32; }},
    PlainChange{"depth runs in the other direction",
                [](Case& c) {
                  // Direct3D has no viewports with min_depth > max_depth.
                  if (c.rules != Rules::d3d) std::swap(c.viewport.min_depth, c.viewport.max_depth);
                }},
    PlainChange{"the depth range is 0 to 1",
                [](Case& c) {
                  c.viewport.min_depth = 0;
                  c.viewport.max_depth = 1;
                }},
    PlainChange{"ties go to the other edges", &swap_ties, nullptr, true},
    PlainChange{"samples of a pixel are numbered in reverse", [](Case& /*c*/) {}, &other_sample,
                false, true},
    // Draws everything upside down, then turns the framebuffer back. That turns whole pixels, so
    // their samples stay upside down.
    PlainChange{"sample positions are upside down within pixels",
                [](Case& c) {
                  mirror_viewport(c);
                  mirror_scissor(c);
                  swap_ties(c);
                  const bool is_ccw = c.front_face == cases::FrontFace::ccw;
                  c.front_face = is_ccw ? cases::FrontFace::cw : cases::FrontFace::ccw;
                },
                &other_row, true, true},
};

constexpr std::array kOfValues{
    PlainChange{
        "smooth attributes are interpolated without perspective",
        [](Case& c) { set_interpolation(c, Interpolation::smooth, Interpolation::noperspective); }},
    PlainChange{
        "noperspective attributes are smooth",
        [](Case& c) { set_interpolation(c, Interpolation::noperspective, Interpolation::smooth); }},
    PlainChange{"flat attributes are smooth",
                [](Case& c) { set_interpolation(c, Interpolation::flat, Interpolation::smooth); }},
    PlainChange{"smooth attributes are flat",
                [](Case& c) { set_interpolation(c, Interpolation::smooth, Interpolation::flat); }},
    PlainChange{"attributes at centroids are taken at the pixel's centre",
                [](Case& c) { move_centroids(c, Location::center); }},
    PlainChange{"attributes at centroids are taken at samples",
                [](Case& c) { move_centroids(c, Location::sample); }},
    PlainChange{"attributes are taken at samples",
                [](Case& c) { set_locations(c, Location::sample); }},
    PlainChange{"attributes are taken at centres",
                [](Case& c) { set_locations(c, Location::center); }},
    PlainChange{"attributes are taken at centroids",
                [](Case& c) { set_locations(c, Location::centroid); }},
    PlainChange{"attributes have the other sign",
                [](Case& c) {
                  for (float& value : c.attribute_values) value = -value;
                }},
};

/// Formats a number of pixels as people write it: "1/16", "-1/2", "1".
std::string pixels_text(double pixels) {
  const double inverse = 1 / pixels;
  if (std::abs(pixels) >= 1 || pixels == 0) return fmt::format("{}", pixels);
  return fmt::format("{}1/{}", pixels < 0 ? "-" : "", std::abs(inverse));
}

/// Visits changes of one case, one at a time.
class Changes {
 public:
  Changes(const Case& c, const std::function<void(const SimpleChange&)>& visit)
      : source_(&c), visit_(&visit) {}

  /// Visits a change unless it leaves the case as it is. `apply` changes the case. `rest` holds the
  /// other members; its clause and case are ignored.
  template <typename Apply>
  void add(std::string change, const Apply& apply, const SimpleChange& rest = {}) {
    SimpleChange added = rest;
    added.change = std::move(change);
    added.source = *source_;
    apply(added.source);
    if (added.place_of != nullptr || !(added.source == *source_)) (*visit_)(added);
  }

  void add(const PlainChange& plain) {
    if (plain.is_of_samples && source_->framebuffer.samples == 1) return;
    SimpleChange rest;
    rest.place_of = plain.place_of;
    rest.swaps_ties = plain.swaps_ties;
    add(std::string(plain.change), plain.apply, rest);
  }

  const Case& source() const { return *source_; }

 private:
  const Case* source_;
  const std::function<void(const SimpleChange&)>* visit_;
};

/// Adds moves in all eight directions.
void add_moves(Changes& changes, float pixels) {
  for (const float x : {-pixels, 0.0F, pixels}) {
    for (const float y : {-pixels, 0.0F, pixels}) {
      if (x == 0 && y == 0) continue;
      changes.add(fmt::format("everything is moved by ({}, {}) pixels", pixels_text(double{x}),
                              pixels_text(double{y})),
                  [x, y](Case& c) {
                    c.viewport.x += x;
                    c.viewport.y += y;
                  });
    }
  }
}

void add_rules(Changes& changes) {
  constexpr std::array<std::pair<Rules, std::string_view>, 3> kRules{
      {{Rules::opengl, "OpenGL's"}, {Rules::vulkan, "Vulkan's"}, {Rules::d3d, "Direct3D's"}}};
  for (const auto& [rules, whose] : kRules) {
    changes.add(fmt::format("the rules are {}", whose), [rules = rules](Case& c) {
      // Direct3D has no depth range with min_depth > max_depth.
      const bool has_range = rules != Rules::d3d || c.viewport.min_depth <= c.viewport.max_depth;
      if (has_range) c.rules = rules;
    });
  }
}

/// Adds changes that snap positions to coarser or finer grids than asked for, or to none.
void add_grids(Changes& changes) {
  SimpleChange grid;
  grid.names_grid = true;
  changes.add(
      "no positions are snapped",
      [](Case& c) {
        c.coverage.reset();
        c.basis = cases::Basis::ideal;
      },
      grid);
  for (int bits = 0; bits <= 12; ++bits) {
    const std::string step = bits == 0 ? "whole pixels" : fmt::format("1/{} pixel", 1 << bits);
    for (const cases::Basis basis : {cases::Basis::ideal, cases::Basis::snapped}) {
      const auto place_on_grid = [bits, basis](Case& c, cases::Rounding rounding) {
        c.coverage = cases::Snapping{bits, rounding, 0};
        c.basis = basis;
      };
      changes.add(
          "positions are snapped to " + step,
          [&](Case& c) { place_on_grid(c, cases::Rounding::nearest_even); }, grid);
      // Rounding down equals rounding to nearest after a move by half a step. The viewport's
      // borders and the unsnapped positions move by the same half step.
      changes.add(
          "positions are rounded down to " + step,
          [&](Case& c) {
            place_on_grid(c, cases::Rounding::half_up);
            const auto half = static_cast<float>(std::exp2(-bits - 1));
            c.viewport.x -= half;
            c.viewport.y -= half;
          },
          grid);
    }
  }
  for (const auto& [basis, which] : {std::pair(cases::Basis::ideal, "the unsnapped"),
                                     std::pair(cases::Basis::snapped, "the snapped")}) {
    changes.add(
        fmt::format("values come from {} positions", which),
        [basis = basis](Case& c) {
          if (c.coverage) c.basis = basis;
        },
        grid);
  }
}

/// Adds changes that take attribute values from the wrong vertices.
void add_moved_values(Changes& changes) {
  constexpr std::array<Sources, 5> kMoved{{{1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}}};
  for (const Sources& from : kMoved) {
    changes.add(
        fmt::format("vertices 0, 1 and 2 have the values of vertices {}, {} and {}", from[0],
                    from[1], from[2]),
        [&from](Case& c) { move_values(c, from, [](const cases::Attribute&) { return true; }); });
  }
  constexpr std::array<std::string_view, 3> kWhich{"first", "second", "third"};
  for (std::size_t vertex = 0; vertex < kWhich.size(); ++vertex) {
    changes.add(
        fmt::format("flat attributes are those of each triangle's {} vertex", kWhich[vertex]),
        [vertex](Case& c) {
          const auto is_flat = [](const cases::Attribute& a) {
            return a.interpolation == Interpolation::flat;
          };
          if (std::none_of(c.attributes.begin(), c.attributes.end(), is_flat)) return;
          move_values(c, {vertex, vertex, vertex}, is_flat);
        });
  }
}

/// For each wrong attribute, adds changes that replace it by another or exchange the two.
void add_other_attributes(Changes& changes, const std::set<std::size_t>& wrong) {
  const std::vector<cases::Attribute>& attributes = changes.source().attributes;
  const std::size_t count = attributes.size();
  const auto named = [&attributes](std::size_t a) {
    return attributes[a].name.empty() ? fmt::format("attribute {}", a)
                                      : fmt::format("“{}”", attributes[a].name);
  };
  for (const std::size_t to : wrong) {
    for (std::size_t from = 0; from < count; ++from) {
      if (from == to) continue;
      changes.add(fmt::format("{} is in the place of {}", named(from), named(to)), [&](Case& c) {
        for (std::size_t i = to; i < c.attribute_values.size(); i += count) {
          c.attribute_values[i] = c.attribute_values[i - to + from];
        }
      });
      if (from < to) continue;
      changes.add(fmt::format("{} and {} are exchanged", named(to), named(from)), [&](Case& c) {
        for (std::size_t i = to; i < c.attribute_values.size(); i += count) {
          std::swap(c.attribute_values[i], c.attribute_values[i - to + from]);
        }
      });
    }
  }
}

}  // namespace

void visit_simple_changes(const Case& c, const WrongParts& wrong,
                          const std::function<void(const SimpleChange&)>& visit) {
  Changes changes(c, visit);
  for (const PlainChange& plain : kOfPlaces) changes.add(plain);
  constexpr float kHalf = 0.5F;
  add_moves(changes, kHalf);
  add_moves(changes, 1);
  add_rules(changes);
  add_grids(changes);
  // A change that keeps all samples in place cannot explain wrong coverage.
  if (wrong.coverage) return;
  for (const PlainChange& plain : kOfValues) changes.add(plain);
  add_moved_values(changes);
  add_other_attributes(changes, wrong.attributes);
}

}  // namespace rastercheck::properties
