// Degenerate triangles cover nothing, and leave their neighbours as they are: inserted between the
// triangles of a case, they draw nothing, and the case's triangles draw the same bits as without
// them.
//
// Why. If det M = 0, Q = M^-1 does not exist and no sample is covered: on the screen, the triangle
// is a line or less (RULES §1). If all w_i <= 0, Σ e_i w_i = 1 implies that some e_i < 0. The
// inserted triangles are degenerate without any rounding:
//
//   a repeated vertex    an index twice, or three times
//   a vertex twice       p and 2^k p, which appear at the same place
//   opposite vertices    p and −2^k p: the triangle's plane contains the eye
//   collinear vertices   p, q and (i p + j q) / 4, where the numbers of p and q have few bits
//   collinear samples    corners at pixel centres, exact in float32: these test ties as well
//   behind the eye       all w <= 0, and all w = 0
//   the eye itself       x = y = z = w = 0
//
// Each triangle is drawn as if alone, so degenerate triangles do not affect the others. A depth
// test selects the nearest fragment, and the fragments are the same.
//
// Samples: all, if coverage is exact. If coverage is snapped, snapping may give a degenerate
// triangle an area, and the oracle tells which of the triangle's samples are forbidden. For a
// repeated or doubled vertex, and for collinear grid points, which stay collinear, all samples are
// still forbidden. With snapping, the depth test is removed, since degenerate triangles may hide
// others. Neighbours: all samples, to the bit.

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cases/capabilities.h"
#include "cases/contract.h"
#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/parted_triangles.h"
#include "properties/laws/internal/same_drawing.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/window_position.h"

namespace rastercheck::properties::degenerate_covers_nothing_law {
namespace {

using cases::ClipVertex;
using cases::Triangle;
using records::FragmentClass;

enum class Degeneracy {
  repeated,
  twice,
  opposite,
  collinear,
  on_samples,
  behind,
  at_infinity,
  at_eye
};
constexpr std::array kKinds{Degeneracy::repeated,    Degeneracy::twice,      Degeneracy::opposite,
                            Degeneracy::collinear,   Degeneracy::on_samples, Degeneracy::behind,
                            Degeneracy::at_infinity, Degeneracy::at_eye};

const char* word_of(Degeneracy kind) {
  switch (kind) {
    case Degeneracy::repeated:
      return "repeated vertex";
    case Degeneracy::twice:
      return "vertex twice";
    case Degeneracy::opposite:
      return "opposite vertices";
    case Degeneracy::collinear:
      return "collinear vertices";
    case Degeneracy::on_samples:
      return "collinear samples";
    case Degeneracy::behind:
      return "behind the eye";
    case Degeneracy::at_infinity:
      return "all w = 0";
    case Degeneracy::at_eye:
      break;
  }
  return "vertex in the eye";
}

/// The position times a power of two of either sign; empty if that is not float32.
std::optional<ClipVertex> scaled(const ClipVertex& p, double factor) {
  const auto times = [factor](float part) { return static_cast<float>(double{part} * factor); };
  const ClipVertex result{times(p.x), times(p.y), times(p.z), times(p.w)};
  for (float ClipVertex::*part : {&ClipVertex::x, &ClipVertex::y, &ClipVertex::z, &ClipVertex::w}) {
    if (double{result.*part} != double{p.*part} * factor) return std::nullopt;
  }
  return result;
}

/// Returns (i p + j q) / 4 for short positions (with_short_vertices) and |i|, |j| <= 8; empty if
/// that is not float32.
std::optional<ClipVertex> combined(const ClipVertex& p, const ClipVertex& q, int i, int j) {
  ClipVertex result;
  for (float ClipVertex::*part : {&ClipVertex::x, &ClipVertex::y, &ClipVertex::z, &ClipVertex::w}) {
    const double sum = (i * double{p.*part} + j * double{q.*part}) / 4;
    result.*part = to_float(sum);
    if (double{result.*part} != sum) return std::nullopt;
  }
  return result;
}

/// Makes triangles without area from a case's vertices.
class Degenerates {
 public:
  Degenerates(cases::Case& c, Choices& choices) : case_(&c), choices_(&choices) {}

  /// Makes a triangle and appends its vertices. Returns nothing if the vertices are not exact.
  std::optional<Triangle> make(Degeneracy kind) {
    const Triangle& of = case_->triangles[choices_->below(case_->triangles.size())];
    const std::size_t first = choices_->below(3);
    const std::uint32_t a = of[first];
    const std::uint32_t b = of[(first + 1) % 3];
    const std::uint32_t c = of[(first + 2) % 3];
    switch (kind) {
      case Degeneracy::repeated:
        return choices_->pick(
            std::array{Triangle{a, a, b}, Triangle{a, b, a}, Triangle{b, a, a}, Triangle{a, a, a}});
      case Degeneracy::twice:
        return with(a, b, scaled(at(a), power()));
      case Degeneracy::opposite:
        return with(a, b, scaled(at(a), -power()));
      case Degeneracy::collinear:
        return collinear(a, b, c);
      case Degeneracy::on_samples:
        return on_samples(a, b);
      case Degeneracy::behind:
        return moved_behind({a, b, c}, -1);
      case Degeneracy::at_infinity:
        return moved_behind({a, b, c}, 0);
      case Degeneracy::at_eye:
        break;
    }
    return with(a, b, ClipVertex{0, 0, 0, 0});
  }

 private:
  ClipVertex at(std::uint32_t vertex) const { return case_->positions[vertex]; }

  double power() { return std::ldexp(1.0, static_cast<int>(choices_->below(5)) - 2); }

  std::optional<Triangle> with(std::uint32_t a, std::uint32_t b,
                               const std::optional<ClipVertex>& third) {
    if (!third) return std::nullopt;
    const std::uint32_t added = add_vertex_like(*case_, a, *third);
    return choices_->pick(
        std::array{Triangle{a, b, added}, Triangle{added, a, b}, Triangle{b, added, a}});
  }

  std::optional<Triangle> collinear(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    using Factors = std::array<int, 2>;
    const auto [i, j] = choices_->pick(
        std::array{Factors{2, 2}, Factors{1, 3}, Factors{-4, 8}, Factors{-2, -2}, Factors{3, -1}});
    std::array<ClipVertex, 3> corners{at(a), at(b), at(c)};
    shorten_positions(corners);
    const auto third = combined(corners[0], corners[1], i, j);
    if (!third) return std::nullopt;
    const std::uint32_t p = add_vertex_like(*case_, a, corners[0]);
    const std::uint32_t q = add_vertex_like(*case_, b, corners[1]);
    return with(p, q, third);
  }

  /// A triangle with its corners at pixel centres on one line.
  std::optional<Triangle> on_samples(std::uint32_t a, std::uint32_t b) {
    const WindowPoint start = visible_middle(*case_);
    const auto along = static_cast<int>(choices_->below(5));
    const int across = static_cast<int>(choices_->below(7)) - 3;
    std::array<std::uint32_t, 3> vertices{};
    for (int i = 0; i < 3; ++i) {
      const WindowPoint p{std::floor(start.u) + 0.5 + (i - 1) * along,
                          std::floor(start.v) + 0.5 + (i - 1) * across};
      const ClipVertex vertex = at_window(*case_, p, 0.5F, 1);
      if (!is_exactly_at(*case_, vertex, p)) return std::nullopt;
      vertices[static_cast<std::size_t>(i)] = add_vertex_like(*case_, i == 0 ? a : b, vertex);
    }
    return Triangle{vertices[0], vertices[1], vertices[2]};
  }

  Triangle moved_behind(const Triangle& triangle, float sign) {
    Triangle result{};
    for (std::size_t i = 0; i < 3; ++i) {
      ClipVertex p = at(triangle[i]);
      p.w = sign * std::abs(p.w);
      result[i] = add_vertex_like(*case_, triangle[i], p);
    }
    return result;
  }

  cases::Case* case_;
  Choices* choices_;
};

/// A case with degenerate triangles between its own triangles.
struct Mixed {
  cases::Case source;
  /// [triangle]: its index in the original case, or empty if it is degenerate; and its kind.
  std::vector<std::optional<std::uint32_t>> original;
  std::vector<Degeneracy> kinds;
  std::set<std::string> labels;
};

/// True if a backend accepts the triangle and promises something about it. Always true for a
/// backend that draws everything and has no limits.
bool is_drawn(const cases::Case& c, const Triangle& triangle, backends::Backend& backend) {
  const backends::About about = backend.about();
  const cases::Capabilities& has = about.capabilities;
  const bool has_limits = about.has_limits;
  if (has.is_everything() && !has_limits) return true;
  cases::Case alone = c;
  alone.triangles = {triangle};
  return lacked_by(has, alone).empty() &&
         (!has_limits || cases::promises_all_of(backend.contract(alone), alone));
}

Mixed mixed(const cases::Case& c, backends::Backend& backend) {
  constexpr std::size_t kMost = 6;
  const std::uint64_t number = choices_of(c);
  Mixed result;
  result.source = c;
  std::vector<std::pair<Triangle, Degeneracy>> added;
  for (std::size_t i = 0; i < kMost; ++i) {
    Choices choices(number + i * 0x9e3779b97f4a7c15U);
    const Degeneracy kind = choices.pick(kKinds);
    const auto triangle = Degenerates(result.source, choices).make(kind);
    if (!triangle || !is_drawn(result.source, *triangle, backend)) continue;
    added.emplace_back(*triangle, kind);
    result.labels.emplace(word_of(kind));
  }
  result.source.triangles.clear();
  const auto put = [&result](const Triangle& triangle, std::optional<std::uint32_t> original,
                             Degeneracy kind) {
    result.source.triangles.push_back(triangle);
    result.original.push_back(original);
    result.kinds.push_back(kind);
  };
  for (std::uint32_t t = 0; t < c.triangles.size(); ++t) {
    const bool is_last = t + 1 == c.triangles.size();
    while (!added.empty() && (is_last || (number >> (t % 64) & 1) != 0)) {
      put(added.back().first, std::nullopt, added.back().second);
      added.pop_back();
      if (!is_last) break;
    }
    put(c.triangles[t], t, Degeneracy::repeated);
  }
  return result;
}

class DegenerateCheck {
 public:
  DegenerateCheck(const Mixed& mixed, const cases::Contract& contract)
      : mixed_(&mixed), is_exact_(!contract.coverage), verdicts_(mixed.source, contract) {}

  /// Checks the degenerate triangles' fragments and removes them from a drawing. Restores the other
  /// triangles' indices.
  cases::Fragments without_degenerate(const cases::Fragments& drawn) {
    const std::size_t count = drawn.attribute_count;
    const auto nowhere = static_cast<std::uint32_t>(mixed_->source.triangles.size());
    cases::Fragments result;
    result.attribute_count = count;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const std::uint32_t triangle = drawn.triangle[i];
      const bool is_known = triangle < mixed_->original.size();
      if (is_known && !mixed_->original[triangle]) {
        see(drawn.place_of(i));
        continue;
      }
      result.triangle.push_back(is_known ? *mixed_->original[triangle] : nowhere);
      result.x.push_back(drawn.x[i]);
      result.y.push_back(drawn.y[i]);
      result.sample.push_back(drawn.sample[i]);
      result.depth.push_back(drawn.depth[i]);
      const auto values = drawn.attributes_of(i);
      result.attributes.insert(result.attributes.end(), values.begin(), values.end());
      if (drawn.derivatives.empty()) continue;
      const auto derivatives = drawn.derivatives_of(i);
      result.derivatives.insert(result.derivatives.end(), derivatives.begin(), derivatives.end());
    }
    return result;
  }

  const Check& found() const { return found_; }

 private:
  void see(const cases::SamplePlace& place) {
    const bool is_forbidden =
        is_exact_ || !is_of_case(mixed_->source, place) ||
        verdicts_.judge(place.triangle, place).verdict == records::Verdict::forbidden;
    if (!is_forbidden) {
      ++found_.judgement.counts.permitted;
      return;
    }
    const std::string kind = word_of(mixed_->kinds[place.triangle]);
    add_violation(found_, violation_at(place, FragmentClass::extra, "forbidden: it has no area",
                                       "an added triangle: " + kind));
  }

  const Mixed* mixed_;
  bool is_exact_;
  Verdicts verdicts_;
  Check found_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  cases::ClipCase clip = c;
  if (clip.triangles.empty()) return not_applicable("the case has no triangles");
  if (backend.contract(clip).coverage) clip.depth_test = cases::DepthTest::none;
  const Mixed with = mixed(clip, backend);
  if (with.labels.empty()) return not_applicable("the backend supports no triangles without area");
  const Result<backends::Drawn> before = draw_promised(clip, backend);
  if (!before) return tl::unexpected(before.error());
  const Result<backends::Drawn> drawn = draw_promised(with.source, backend);
  if (!drawn) return tl::unexpected(drawn.error());

  const cases::Contract& contract = drawn->contract;
  DegenerateCheck degenerate(with, contract);
  Check check =
      compare_drawings(clip, before->fragments, degenerate.without_degenerate(drawn->fragments),
                       "drawn with triangles without area in between");
  merge(check, degenerate.found());
  for (const std::string& label : with.labels) add_label(check, label);
  if (contract.coverage) add_label(check, "snapped");
  if (clip.cull != cases::Cull::none) add_label(check, "culling");
  return check;
}

/// Half of the cases cull faces, since culling must handle triangles without a facing.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  const bool is_culled = draw.one_in(2);
  if (is_culled) {
    made.source.cull = draw.pick(std::array{cases::Cull::back, cases::Cull::front});
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "what-is-degenerate-covers-nothing",
     .sentence = "what is degenerate covers nothing",
     .reason = "Where det M = 0 there is no map to draw by, and where all w <= 0 some e_i < 0.",
     .exceptions = "samples that snapping may give to a triangle without area",
     .generate = &generate,
     .check = &check,
     .needs_samples = true,
     .covers = {cover(15, "all w = 0"), cover(15, "behind the eye"), cover(5, "collinear samples"),
                cover(15, "collinear vertices"), cover(20, "culling"),
                cover(15, "opposite vertices"), cover(15, "repeated vertex"),
                cover_decided(15, "snapped"), cover(15, "vertex in the eye"),
                cover(15, "vertex twice")}});

}  // namespace
}  // namespace rastercheck::properties::degenerate_covers_nothing_law
