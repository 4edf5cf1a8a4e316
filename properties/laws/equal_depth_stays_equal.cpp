// Equal depth stays equal: all triangles of a case that lie in one plane of equal depth are drawn
// with the same depth.
//
// z/w(p) = Σ z_i e_i(p), and Σ w_i e_i(p) = 1: if z_i = k w_i at all vertices, z/w is k everywhere,
// whatever the w_i and their signs. z_i w_j = z_j w_i is decided exactly, since doubles hold
// products of two floats. The bound alone allows two depths if the exact depth is close to the
// midpoint of two floats. If two neighbouring fragments, or two triangles of one plane, took
// different depths, a surface would fight with itself (RULES §6). The law applies if the contract
// promises equal depths.
//
// Vertices: w ≠ 0, since z/w must be the same at all three, and w > 0 if a bias adds a constant to
// float32 depths, since its unit is the plane's only then (has_unit_of_plane). Samples: required
// ones. The oracle is asked which samples these are only if depths differ.
//
// Generated cases. The depth must multiply every w exactly, so w keeps only 12 bits. That changes
// little of what a triangle shows or how its w differ. One depth in three, mapped to the depth
// range, lies exactly midway between two floats: n + (f − n) z/w = 1/2 + k/2 with k an odd multiple
// of 2^-24.

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <vector>

#include "properties/float_numbers.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/biased_depths.h"
#include "properties/laws/internal/value_findings.h"
#include "properties/random_state.h"

namespace rastercheck::properties::equal_depth_stays_equal_law {
namespace {

// --- The law -------------------------------------------------------------------------------------

/// z/w as a fraction with w > 0.
struct PlaneDepth {
  double z = 0;
  double w = 1;
};

/// Exact, since doubles hold products of two floats.
bool operator<(const PlaneDepth& a, const PlaneDepth& b) { return a.z * b.w < b.z * a.w; }
bool operator==(const PlaneDepth& a, const PlaneDepth& b) { return a.z * b.w == b.z * a.w; }

PlaneDepth depth_of(const cases::ClipVertex& p) {
  return p.w < 0 ? PlaneDepth{-double{p.z}, -double{p.w}} : PlaneDepth{double{p.z}, double{p.w}};
}

/// The depth that all vertices share; empty if depths differ, some w = 0, or a bias moves the
/// triangle otherwise than its plane.
std::optional<PlaneDepth> equal_depth(const cases::Case& c, const cases::Triangle& triangle) {
  const PlaneDepth first = depth_of(c.positions[triangle[0]]);
  const bool is_equal = std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t index) {
    const cases::ClipVertex& p = c.positions[index];
    return p.w != 0 && depth_of(p) == first;
  });
  return is_equal && has_unit_of_plane(c, triangle) ? std::optional(first) : std::nullopt;
}

bool has_several_w(const cases::Case& c, const cases::Triangle& triangle) {
  return c.positions[triangle[0]].w != c.positions[triangle[1]].w ||
         c.positions[triangle[0]].w != c.positions[triangle[2]].w;
}

class EqualDepthCheck {
 public:
  EqualDepthCheck(const cases::Case& c, const cases::Contract& contract,
                  const cases::Fragments& drawn)
      : case_(&c), drawn_(&drawn), findings_(c, contract) {}

  Check run() {
    collect();
    for (const auto& [depth, fragments] : planes_) check_plane(fragments);
    return findings_.finish();
  }

 private:
  void collect() {
    std::optional<PlaneDepth> depth;
    std::optional<std::uint32_t> triangle;
    std::vector<std::size_t>* fragments = nullptr;
    for (std::size_t i = 0; i < drawn_->size(); ++i) {
      const cases::SamplePlace place = drawn_->place_of(i);
      if (!is_of_case(*case_, place)) continue;
      if (triangle != place.triangle) {
        triangle = place.triangle;
        depth = equal_depth(*case_, case_->triangles[*triangle]);
        fragments = depth ? &planes_[*depth] : nullptr;
      }
      if (fragments == nullptr) continue;
      fragments->push_back(i);
      findings_.see(place, std::nullopt);
      if (has_several_w(*case_, case_->triangles[*triangle])) findings_.label("different w");
      add_middle_label(*depth);
    }
  }

  /// Adds the label "middle between floats" if the plane's depth lies midway between two floats.
  /// Exact for depths of few bits, because their sums are exact in double.
  void add_middle_label(const PlaneDepth& depth) {
    const double share = depth.z / depth.w;
    const double n{case_->viewport.min_depth};
    const double f{case_->viewport.max_depth};
    const bool is_opengl = case_->rules == cases::Rules::opengl;
    const double mapped = n + (f - n) * (is_opengl ? (share + 1) / 2 : share);
    const auto nearest = static_cast<float>(mapped);
    const double off = std::abs(double{nearest} - mapped);
    if (off == ulp_of(mapped) / 2) findings_.label("middle between floats");
  }

  /// −0 and 0 are the same depth.
  static bool is_same_depth(float a, float b) { return a == b && std::isfinite(a); }

  void check_plane(const std::vector<std::size_t>& fragments) {
    const float first = drawn_->depth[fragments.front()];
    const bool is_one = std::all_of(fragments.begin(), fragments.end(), [&](std::size_t i) {
      return is_same_depth(drawn_->depth[i], first);
    });
    if (drawn_->triangle[fragments.front()] != drawn_->triangle[fragments.back()]) {
      findings_.label("several triangles");
    }
    if (!is_one) name_others(fragments);
  }

  /// Takes the first required fragment's depth as the plane's depth, and reports required fragments
  /// with other depths.
  void name_others(const std::vector<std::size_t>& fragments) {
    std::optional<float> expected;
    for (const std::size_t i : fragments) {
      const cases::SamplePlace place = drawn_->place_of(i);
      if (!findings_.is_required(place)) continue;
      const float actual = drawn_->depth[i];
      if (!expected) expected = actual;
      if (is_same_depth(actual, *expected)) continue;
      findings_.report(place, std::nullopt, actual, value_text(*expected),
                       "z/w is the same at all vertices, and the plane's first depth was " +
                           value_text(*expected));
    }
  }

  const cases::Case* case_;
  const cases::Fragments* drawn_;
  ValueFindings findings_;
  std::map<PlaneDepth, std::vector<std::size_t>> planes_;
};

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  return check_drawn(c, backend, [](const cases::Case& clip, const backends::Drawn& drawn) {
    return drawn.contract.keeps_equal_depth
               ? EqualDepthCheck(clip, drawn.contract, drawn.fragments).run()
               : not_applicable();
  });
}

bool is_promised(backends::Backend& backend) { return backend.contract({}).keeps_equal_depth; }

// --- Its cases -----------------------------------------------------------------------------------

/// Clears the lowest 12 of 24 bits.
float shortened(float value) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) & 0xfffff000U);
}

/// z/w of up to 12 bits.
float random_plane(Draw& draw, cases::Case& c, bool is_middle) {
  const bool is_opengl = c.rules == cases::Rules::opengl;
  const int n = draw.between(is_opengl && !is_middle ? -2047 : 0, 2047);
  if (!is_middle) return static_cast<float>(n) / 2048;
  c.viewport.min_depth = is_opengl ? 0.0F : 0.5F;
  c.viewport.max_depth = 1;
  return static_cast<float>(2 * n + 1) * 0x1p-24F;
}

/// Gives all vertices of a case the same z/w, or one of two.
Generated generate(Draw& draw) {
  Generated made = generate_any(draw);
  cases::Case& c = made.source;
  const bool is_middle = draw.one_in(3);
  const float first = random_plane(draw, c, is_middle);
  const float second = random_plane(draw, c, is_middle);
  const bool has_two = draw.one_in(4);
  for (std::size_t i = 0; i < c.positions.size(); ++i) {
    cases::ClipVertex& p = c.positions[i];
    p.w = shortened(p.w);
    if (p.w == 0) p.w = 0x1p-60F;
    p.z = p.w * (has_two && i >= c.positions.size() / 2 ? second : first);
  }
  if (c.clip_distance_count == 0 && draw.one_in(4)) {
    c.clip_distance_count = 1;
    add_clip_distances(draw, c);
  }
  if (draw.one_in(3)) set_snapped_coverage(draw, c);
  return made;
}

const LawRegistration kRegistration(
    {.id = "equal-depth-stays-equal",
     .sentence = "equal depth stays equal",
     .reason = "Σ k w_i e_i is k, as Σ w_i e_i = 1.",
     .exceptions = "backends that do not promise to keep it; vertices with w = 0, where z/w is "
                   "nothing",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend does not promise equal depths for equal inputs",
     .covers = {cover(37, "different w"), cover(15, "middle between floats"),
                cover(27, "several triangles"), cover(20, "several samples"), cover(27, "snapped"),
                cover(18, "clipped"), cover(8, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::equal_depth_stays_equal_law
