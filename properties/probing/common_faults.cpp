#include "properties/probing/common_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cases/names.h"

namespace rastercheck::properties {
namespace {

using records::Sureness;

/// Triangles of the first drawing; half of them run in each direction.
constexpr int kFirstTriangles = 48;
/// Attributes of the first drawing, if the backend has that many.
constexpr std::size_t kFirstAttributes = 3;

// --- Drawings ------------------------------------------------------------------------------------

/// Returns a triangle with sides of 12 to 40 pixels, turned in the given direction.
FineTriangle large_triangle(const Subject& subject, Draw& draw, bool is_positive) {
  constexpr std::int64_t kLeastArea = 240;  // twice the area, in pixels²: no slivers
  for (;;) {
    FineTriangle t;
    t.scale = scale_of(subject.sample());
    for (std::size_t i = 0; i < 3; ++i) {
      t.x[i] = draw.between(4, 60) * kFinePixel;
      t.y[i] = draw.between(4, 60) * kFinePixel;
    }
    const std::int64_t area = area_of(t) / kFinePixel / kFinePixel;
    if (std::abs(area) < kLeastArea || std::abs(area) > 8 * kLeastArea) continue;
    if ((area > 0) != is_positive) {
      std::swap(t.x[1], t.x[2]);
      std::swap(t.y[1], t.y[2]);
    }
    return t;
  }
}

/// Returns the numbers 0 to 8 in random order.
std::array<int, 9> shuffled(Draw& draw) {
  std::array<int, 9> all{0, 1, 2, 3, 4, 5, 6, 7, 8};
  for (int i = 8; i > 0; --i) {
    const int other = draw.between(0, i);
    std::swap(all[static_cast<std::size_t>(i)], all[static_cast<std::size_t>(other)]);
  }
  return all;
}

/// Gives a case as many attributes as the backend draws, at most kFirstAttributes.
void add_attributes(const Subject& subject, cases::Case& c) {
  const cases::Capabilities can = subject.capabilities();
  using cases::Feature;
  using cases::Interpolation;
  Interpolation interpolation = Interpolation::smooth;
  if (!can.has(Feature::smooth)) {
    if (!can.has(Feature::noperspective)) return;
    interpolation = Interpolation::noperspective;  // the same where w = 1
  }
  const std::size_t count = std::min(kFirstAttributes, can.max_attributes);
  for (std::size_t i = 0; i < count; ++i)
    c.attributes.push_back({fmt::format("a{}", i), interpolation});
}

/// Empty if the backend does not draw it.
std::optional<FirstDrawing> draw_first(Subject& subject) {
  MeasureDraw draw(subject, "first drawing");
  cases::Case c = subject.base();
  add_attributes(subject, c);
  std::vector<FineTriangle> triangles;
  std::vector<std::array<float, 3>> depths;
  for (int i = 0; i < kFirstTriangles; ++i) {
    const FineTriangle t = large_triangle(subject, draw, i % 2 == 0);
    const std::array<int, 9> values = shuffled(draw);
    const std::array<int, 9> depth_steps = shuffled(draw);
    std::array<float, 3> depth{};
    for (std::size_t k = 0; k < 3; ++k) {
      // Depths and values lie within 0 and 1, and differ by at least 6/64 within a triangle.
      depth[k] = static_cast<float>(8 + 6 * depth_steps[k]) / 64;
      const float z = c.rules == cases::Rules::opengl ? 2 * depth[k] - 1 : depth[k];
      add_vertex(c, fine_vertex(c, t.x[k], t.y[k], z));
      for (std::size_t a = 0; a < c.attributes.size(); ++a) {
        c.attribute_values.push_back(static_cast<float>(4 + 7 * values[3 * a + k]) / 64);
      }
    }
    const auto end = static_cast<std::uint32_t>(c.positions.size());
    c.triangles.push_back({end - 3, end - 2, end - 1});
    triangles.push_back(t);
    depths.push_back(depth);
  }
  cases::Case plain = c;
  plain.attributes.clear();
  plain.attribute_values.clear();
  auto drawing = draw_fine(subject, triangles, std::move(c));
  if (!drawing) drawing = draw_fine(subject, triangles, std::move(plain));
  if (!drawing) return std::nullopt;
  return FirstDrawing{*std::move(drawing), std::move(depths)};
}

// --- Places --------------------------------------------------------------------------------------

const char* pixels_of(int halves) { return std::abs(halves) == 1 ? "half a pixel" : "a pixel"; }

/// The direction of a move along the window's y axis, as displayed.
const char* vertical(int move, bool is_y_up) { return (move > 0) == is_y_up ? "up" : "down"; }

std::string move_sentence(const Placement& placement, bool is_y_up) {
  std::string moves;
  if (placement.move_x != 0) {
    moves = fmt::format("{} too far {}", pixels_of(placement.move_x),
                        placement.move_x > 0 ? "right" : "left");
  }
  if (placement.move_y != 0) {
    moves += fmt::format("{}{} too far {}", moves.empty() ? "" : " and ",
                         pixels_of(placement.move_y), vertical(placement.move_y, is_y_up));
  }
  return fmt::format("Everything is drawn {}; samples lie at the centres of pixels.", moves);
}

std::string shrink_sentence(const Placement& placement) {
  const bool has_both = placement.shrink_x != 0 && placement.shrink_y != 0;
  const char* const axes = has_both ? "x and y" : placement.shrink_x != 0 ? "x" : "y";
  return fmt::format(
      "The viewport is a pixel too small in {}: NDC from -1 to 1 must span all {} pixels, not {}.",
      axes, kFineSide, kFineSide - 1);
}

void add_place_faults(const FoundPlacement& found, cases::Rules rules,
                      std::vector<FoundFault>& faults) {
  const bool is_y_up = rules == cases::Rules::opengl;
  const Placement& at = found.placement;
  const auto add = [&](const char* id, std::string sentence, const Sureness& sureness) {
    faults.push_back({id, id, std::move(sentence), sureness});
  };
  if (at.is_transposed) {
    add("transposed", "The picture is transposed: x and y are exchanged.", found.turn);
  }
  if (at.is_upside_down) {
    const char* const ndc = rules == cases::Rules::vulkan ? "-1" : "1";
    add("upside-down",
        is_y_up ? "The picture is upside down: NDC y = -1 belongs to row 0."
                : fmt::format("The picture is upside down: NDC y = {} belongs to row 0.", ndc),
        found.turn);
  }
  if (at.is_mirrored) {
    add("mirrored", "The picture is mirrored left to right: NDC x = -1 belongs to column 0.",
        found.turn);
  }
  if (at.is_moved()) add("moved", move_sentence(at, is_y_up), found.move);
  if (at.is_shrunk()) add("small-viewport", shrink_sentence(at), found.shrink);
}

// --- Triangles left out --------------------------------------------------------------------------

/// Finds a side that is culled although no culling was asked for.
void add_culled_side(const FineDrawing& drawing, bool is_y_up, std::vector<FoundFault>& faults) {
  std::array<Sureness, 2> left_out{Sureness{"triangles"}, Sureness{"triangles"}};
  for (std::size_t i = 0; i < drawing.triangles.size(); ++i) {
    const bool is_clockwise = (area_of(drawing.triangles[i]) > 0) != is_y_up;
    Sureness& votes = left_out[is_clockwise ? 1 : 0];
    ++(is_empty(drawing.rows[i]) ? votes.in_favour : votes.against);
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const Sureness& other = left_out[1 - side];
    if (!is_sure(left_out[side]) || other.in_favour > 0) continue;
    faults.push_back({"culls-a-side", "culling that was not asked for",
                      fmt::format("Triangles that run {} are left out, though no culling is asked "
                                  "for.",
                                  side == 1 ? "clockwise" : "counter-clockwise"),
                      left_out[side]});
  }
}

/// Returns a triangle of a few pixels with vertices at multiples of 2^-bits pixels that contains a
/// pixel's centre at least kFineMargin inside; its area is at most `most`, in pixels².
FineTriangle small_triangle(Draw& draw, int bits, double most) {
  const std::int64_t unit = kFinePixel >> bits;
  const auto size = static_cast<int>(std::ceil(2 * std::sqrt(most))) << bits;
  for (;;) {
    FineTriangle t;
    const int x = draw.between(8, 50);
    const int y = draw.between(8, 50);
    for (std::size_t i = 0; i < 3; ++i) {
      t.x[i] = x * kFinePixel + draw.between(0, size) * unit;
      t.y[i] = y * kFinePixel + draw.between(0, size) * unit;
    }
    const auto pixels = static_cast<double>(kFinePixel);
    const double area = static_cast<double>(std::abs(area_of(t))) / pixels / pixels / 2;
    if (area == 0 || area > most) continue;
    const FineEdges edges = edges_of(t);
    for (int v = y; v < y + 4; ++v) {
      for (int u = x; u < x + 4; ++u) {
        if (depth_inside(edges, u, v) >= kFineMargin) return t;
      }
    }
  }
}

/// Finds triangles that are left out because they are small. `drawing` has triangles of many sizes
/// that contain a sample; sides that are culled must be left out of it.
void add_small_triangles(const FineDrawing& drawing, const FineDrawing& large, bool skips_sides,
                         std::vector<FoundFault>& faults) {
  const auto area = [](const FineTriangle& t) {
    const auto pixels = static_cast<double>(kFinePixel);
    return static_cast<double>(std::abs(area_of(t))) / pixels / pixels / 2;
  };
  // The sides that are drawn, by the sign of the area.
  std::array<bool, 2> is_side_drawn{};
  for (std::size_t i = 0; i < large.triangles.size(); ++i) {
    if (!is_empty(large.rows[i])) is_side_drawn[area_of(large.triangles[i]) > 0 ? 1 : 0] = true;
  }
  std::vector<std::pair<double, bool>> by_area;
  for (std::size_t i = 0; i < drawing.triangles.size(); ++i) {
    const FineTriangle& t = drawing.triangles[i];
    if (skips_sides && !is_side_drawn[area_of(t) > 0 ? 1 : 0]) continue;
    by_area.emplace_back(area(t), !is_empty(drawing.rows[i]));
  }
  // Triangles of equal area belong to one side of any limit.
  std::sort(by_area.begin(), by_area.end());
  std::optional<std::pair<double, Sureness>> best;
  for (std::size_t end = 1; end <= by_area.size(); ++end) {
    if (end < by_area.size() && by_area[end].first == by_area[end - 1].first) continue;
    Sureness votes{"triangles"};
    for (std::size_t i = 0; i < by_area.size(); ++i) {
      const bool is_predicted = by_area[i].second == (i >= end);
      ++(is_predicted ? votes.in_favour : votes.against);
    }
    const bool has_few_below =
        std::count_if(by_area.begin(), by_area.begin() + static_cast<std::ptrdiff_t>(end),
                      [](const auto& one) { return !one.second; }) < 8;
    if (has_few_below || !is_sure(votes)) continue;
    if (!best || votes.against < best->second.against) best = {by_area[end - 1].first, votes};
  }
  if (!best) return;
  faults.push_back({"drops-small-triangles", "small triangles",
                    fmt::format("Triangles with an area up to about {:.2g} pixels² are left out, "
                                "though they contain samples.",
                                best->first),
                    best->second});
}

/// Draws triangles of up to 6 pixels² that contain a sample. Areas below 1, and samples that are
/// not at centres, need vertices between whole pixels, which only `is_fine` backends keep.
std::optional<FineDrawing> draw_small(Subject& subject, bool is_fine) {
  if (!is_fine && subject.sample() != kPixelCentre) return std::nullopt;
  MeasureDraw draw(subject, "small triangles");
  std::vector<FineTriangle> triangles;
  for (const double most : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0}) {
    for (int i = 0; i < 16; ++i)
      triangles.push_back(about_samples(subject, small_triangle(draw, 0, most)));
  }
  for (const double most : {0.375, 0.5, 0.75}) {
    for (int i = 0; i < 16 && is_fine; ++i) {
      triangles.push_back(about_samples(subject, small_triangle(draw, 2, most)));
    }
  }
  return draw_fine(subject, triangles);
}

/// True if vertices at quarters of pixels are not moved: such triangles are drawn as placed.
bool keeps_quarters(Subject& subject, const Placement& placement) {
  MeasureDraw draw(subject, "quarters of pixels");
  std::vector<FineTriangle> triangles;
  for (int i = 0; i < kFirstTriangles; ++i) {
    FineTriangle t = large_triangle(subject, draw, i % 2 == 0);
    for (std::size_t k = 0; k < 3; ++k) {
      t.x[k] += draw.between(-2, 2) * kFinePixel / 4;
      t.y[k] += draw.between(-2, 2) * kFinePixel / 4;
    }
    triangles.push_back(t);
  }
  const auto drawing = draw_fine(subject, triangles);
  return drawing && is_sure(votes_of({*drawing}, placement, kFineMargin));
}

// --- Edges ---------------------------------------------------------------------------------------

/// Two triangles on both sides of an edge that runs from whole pixels to whole pixels through
/// samples.
std::array<FineTriangle, 2> neighbours(Draw& draw) {
  // Edges of these slopes run through the centres of pixels.
  constexpr std::array<std::array<int, 2>, 6> kSlopes{
      {{1, 1}, {1, -1}, {1, 3}, {3, 1}, {1, -3}, {3, -1}}};
  const std::array<int, 2> slope = draw.pick(kSlopes);
  const int steps = draw.between(2, 4);
  const int x = draw.between(24, 40);
  const int y = draw.between(24, 40);
  const std::array<std::array<int, 2>, 4> corners{
      {{x, y},
       {x + steps * slope[0], y + steps * slope[1]},
       {x + steps * slope[0] - 2 * slope[1], y + steps * slope[1] + 2 * slope[0]},
       {x + 2 * slope[1], y - 2 * slope[0]}}};
  const auto triangle = [&](std::size_t i, std::size_t j, std::size_t k) {
    FineTriangle t;
    const std::array<std::size_t, 3> of{i, j, k};
    for (std::size_t v = 0; v < 3; ++v) {
      t.x[v] = corners[of[v]][0] * kFinePixel;
      t.y[v] = corners[of[v]][1] * kFinePixel;
    }
    return t;
  };
  const bool is_reversed = draw.one_in(2);
  if (is_reversed) return {triangle(1, 0, 2), triangle(0, 1, 3)};
  return {triangle(0, 1, 2), triangle(1, 0, 3)};
}

/// Moves the shared edge of two neighbours apart by a sixteenth of a pixel along both axes, so that
/// no sample is on it.
std::array<FineTriangle, 2> parted(std::array<FineTriangle, 2> both) {
  constexpr std::int64_t kApart = kFinePixel / 16;
  for (FineTriangle& t : both) {
    const FineEdge edge = edges_of(t)[0];
    for (std::size_t i = 0; i < 2; ++i) {
      t.x[i] += edge.a > 0 ? kApart : -kApart;
      t.y[i] += edge.b > 0 ? kApart : -kApart;
    }
  }
  return both;
}

/// Counts the samples on the shared edges of pairs that both triangles draw.
Sureness drawn_by_both(const FineDrawing& drawing, const std::vector<FineTriangle>& on_edges,
                       const Placement& placement) {
  Sureness votes{"samples"};
  for (std::size_t i = 0; i + 1 < on_edges.size(); i += 2) {
    if (is_empty(drawing.rows[i]) && is_empty(drawing.rows[i + 1])) continue;
    const FineEdges edges = edges_of(placed(on_edges[i], placement));
    const FineTriangle at = placed(on_edges[i], placement);
    for (int y = 0; y < kFineSide; ++y) {
      for (int x = 0; x < kFineSide; ++x) {
        if (edges[0].at(x, y) != 0 || place_in(at, x, y).zero_edges != 1) continue;
        if (!place_in(at, x, y).is_inside) continue;
        const bool is_both = has(drawing.rows[i], x, y) && has(drawing.rows[i + 1], x, y);
        ++(is_both ? votes.in_favour : votes.against);
      }
    }
  }
  return votes;
}

/// Finds samples on edges that both neighbours draw.
void add_inclusive_edges(Subject& subject, const Placement& placement,
                         std::vector<FoundFault>& faults) {
  constexpr int kPairs = 24;
  MeasureDraw draw(subject, "shared edges");
  std::vector<FineTriangle> joined;
  std::vector<FineTriangle> apart;
  for (int i = 0; i < kPairs; ++i) {
    std::array<FineTriangle, 2> both = neighbours(draw);
    for (FineTriangle& t : both) t = about_samples(subject, t);
    const std::array<FineTriangle, 2> without = parted(both);
    joined.insert(joined.end(), both.begin(), both.end());
    apart.insert(apart.end(), without.begin(), without.end());
  }
  const auto on = draw_fine(subject, joined);
  const auto beside = draw_fine(subject, apart);
  if (!on || !beside) return;
  const Sureness votes = drawn_by_both(*on, joined, placement);
  // A backend whose triangles are somewhat too large draws such samples of edges nearby as well:
  // then its positions are off, not its edges.
  const Sureness near = drawn_by_both(*beside, joined, placement);
  if (!is_sure(votes) || kFewAgainst * near.in_favour > near.against) return;
  faults.push_back({"inclusive-edges", "samples on edges",
                    "Samples exactly on a shared edge are drawn by both triangles, not by one.",
                    votes});
}

// --- Flat attributes -----------------------------------------------------------------------------

/// Finds flat attributes that come from another vertex than these rules' provoking one.
void add_provoking_vertex(Subject& subject, cases::Rules rules, std::vector<FoundFault>& faults) {
  constexpr std::array kNames{"first", "second", "last"};
  if (!subject.capabilities().has(cases::Feature::flat)) return;
  MeasureDraw draw(subject, "provoking vertex");
  cases::Case c = subject.base();
  c.rules = rules;
  c.attributes.push_back({"flat", cases::Interpolation::flat});
  for (int i = 0; i < kFirstTriangles; ++i) {
    const FineTriangle t = large_triangle(subject, draw, i % 2 == 0);
    for (std::size_t k = 0; k < 3; ++k) {
      add_vertex(c, fine_vertex(c, t.x[k], t.y[k], 0.5F));
      c.attribute_values.push_back(static_cast<float>(k));
    }
    const auto end = static_cast<std::uint32_t>(c.positions.size());
    c.triangles.push_back({end - 3, end - 2, end - 1});
  }
  const std::size_t provoking = c.rules == cases::Rules::opengl ? 2 : 0;
  const std::optional<cases::Fragments> drawn = subject.draw(c);
  if (!drawn) return;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == provoking) continue;
    Sureness votes{"values"};
    for (std::size_t i = 0; i < drawn->size(); ++i) {
      const bool is_of_vertex = drawn->attributes_of(i)[0] == static_cast<float>(k);
      ++(is_of_vertex ? votes.in_favour : votes.against);
    }
    if (!is_sure(votes)) continue;
    faults.push_back(
        {"provoking-vertex", "flat attributes",
         fmt::format("Flat attributes have the value of the triangle's {} vertex, not of its {} "
                     "(rules: {}).",
                     kNames[k], kNames[provoking], cases::name_of(rules)),
         votes});
  }
}

// --- All -----------------------------------------------------------------------------------------

/// True if the backend's contract permits what was found.
bool is_permitted(const FoundFault& fault, const Placement& placement,
                  const cases::Contract& declared) {
  constexpr float kNoPromise = 0x1p24F;  // of values: see cases::ValueBound
  if (fault.id == "inclusive-edges") return declared.tie_rule == cases::TieRule::all;
  if (fault.id == "culls-a-side") return declared.culls != cases::Winding::none;
  if (fault.id == "drops-small-triangles") return declared.least_area > 0;
  if (fault.id == "moved" && declared.coverage) {
    const auto halves = std::max(std::abs(placement.move_x), std::abs(placement.move_y));
    return 2 * double{declared.coverage->position_error} / declared.coverage->steps() >= halves;
  }
  if (fault.id.starts_with("attribute")) return declared.bounds.smooth.constant >= kNoPromise;
  if (fault.id.starts_with("depth")) return declared.bounds.depth.constant >= kNoPromise;
  return false;
}

/// Returns the faults of a backend that draws something.
std::vector<FoundFault> faults_of(Subject& subject, const FirstDrawing& first,
                                  const FoundPlacement& found) {
  std::vector<FoundFault> faults;
  const cases::Rules rules = subject.base().rules;
  const bool is_y_up = rules == cases::Rules::opengl;
  add_place_faults(found, rules, faults);
  const std::size_t before = faults.size();
  add_culled_side(first.drawing, is_y_up, faults);
  const bool skips_sides = faults.size() > before;
  if (found.is_fine) {
    const bool is_fine = keeps_quarters(subject, found.placement);
    // A triangle that is moved or shrunk may contain no sample, or another one.
    if (!found.placement.is_moved() && !found.placement.is_shrunk()) {
      if (const auto small = draw_small(subject, is_fine)) {
        add_small_triangles(*small, first.drawing, skips_sides, faults);
      }
      add_inclusive_edges(subject, found.placement, faults);
    }
    for (auto* const of_values : {&attribute_faults, &depth_faults}) {
      for (FoundFault& fault : of_values(first, found.placement)) {
        faults.push_back(std::move(fault));
      }
    }
    // If attributes of all kinds come from other vertices, one sentence is enough.
    const bool has_other_vertices = std::any_of(faults.begin(), faults.end(), [](const auto& one) {
      return one.id == "attributes-of-other-vertices";
    });
    for (const cases::Rules each : subject.capabilities().rules) {
      if (!has_other_vertices) add_provoking_vertex(subject, each, faults);
    }
  }
  return faults;
}

}  // namespace

void find_common_faults(Subject& subject) {
  const std::optional<FirstDrawing> first = draw_first(subject);
  if (!first) return;
  if (first->drawing.drawn.fragments.size() == 0) {
    const std::uint64_t count = first->drawing.triangles.size();
    subject.result.faults.push_back(
        {"draws-nothing",
         fmt::format("It draws nothing: not one sample of {} triangles of 120 pixels² or more.",
                     count),
         {"triangles", count, 0, 0}});
    return;
  }
  const std::optional<FoundPlacement> found = find_placement({first->drawing});
  if (!found) return;
  const cases::Contract declared = subject.declared();
  for (FoundFault& fault : faults_of(subject, *first, *found)) {
    if (is_permitted(fault, found->placement, declared)) {
      subject.add(fault.what, "permitted", fault.sentence).sureness = fault.sureness;
    } else {
      subject.result.faults.push_back(
          {std::move(fault.id), std::move(fault.sentence), fault.sureness});
    }
  }
}

}  // namespace rastercheck::properties
