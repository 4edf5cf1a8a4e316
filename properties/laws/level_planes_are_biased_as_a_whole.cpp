// A bias moves a plane of equal depth as a whole: all triangles of a case that lie in one plane of
// equal depth are drawn with one depth without a bias, and with one depth with it.
//
// Why. z/w = k at all vertices gives the depth z(k) everywhere, whatever the positions, so m = 0.
// r of a unorm format is one number for all triangles. r of float32 is the power of two below the
// greatest depth of the vertices, which all have z(k), and so have all vertices that clipping
// makes; but a vertex with w <= 0 counts as the far end (RULES §8). So o, limited by the clamp, is
// one number for the whole plane, and so are z(k) + o, clamped, and what it is stored as. The law
// applies if the contract promises equal depths.
//
// Vertices: w ≠ 0; with a constant and float32 depths, w > 0. Samples: required ones; the oracle is
// asked only about depths that differ.

#include <map>
#include <optional>
#include <vector>

#include "properties/judged_law.h"
#include "properties/laws/internal/biased_depths.h"
#include "properties/laws/internal/value_findings.h"

namespace rastercheck::properties::level_planes_law {
namespace {

/// z/w with w > 0.
struct PlaneDepth {
  double z = 0;
  double w = 1;
};
/// Exact, since doubles hold products of two floats.
bool operator<(const PlaneDepth& a, const PlaneDepth& b) { return a.z * b.w < b.z * a.w; }

PlaneDepth plane_of(const cases::Case& c, const cases::Triangle& triangle) {
  const cases::ClipVertex& p = c.positions[triangle[0]];
  return p.w < 0 ? PlaneDepth{-double{p.z}, -double{p.w}} : PlaneDepth{double{p.z}, double{p.w}};
}

/// Checks that planes have one depth each in a drawing of the case.
Check check_planes(const cases::Case& c, const backends::Drawn& drawn, const char* how) {
  ValueFindings findings(c, drawn.contract);
  std::map<PlaneDepth, std::vector<std::size_t>> planes;
  for (std::size_t i = 0; i < drawn.fragments.size(); ++i) {
    const cases::SamplePlace place = drawn.fragments.place_of(i);
    if (!is_of_case(c, place)) continue;
    const cases::Triangle& triangle = c.triangles[place.triangle];
    if (!is_level(c, triangle) || !has_unit_of_plane(c, triangle)) continue;
    findings.see(place, std::nullopt);
    planes[plane_of(c, triangle)].push_back(i);
  }
  for (const auto& [plane, fragments] : planes) {
    std::optional<float> first;  // of a required sample
    const float any = drawn.fragments.depth[fragments.front()];
    for (const std::size_t i : fragments) {
      const float depth = drawn.fragments.depth[i];
      if (depth == any && !first) continue;
      if (first && depth == *first) continue;
      const cases::SamplePlace place = drawn.fragments.place_of(i);
      if (!findings.is_required(place)) continue;
      if (!first) {
        // The first depth may be that of a sample which need not be drawn.
        for (const std::size_t j : fragments) {
          const cases::SamplePlace other = drawn.fragments.place_of(j);
          if (findings.is_required(other)) {
            first = drawn.fragments.depth[j];
            break;
          }
        }
      }
      if (depth == *first) continue;
      findings.report(place, std::nullopt, depth, value_text(*first),
                      std::string("z/w is the same at all vertices; drawn ") + how);
    }
    if (drawn.fragments.triangle[fragments.front()] != drawn.fragments.triangle[fragments.back()]) {
      findings.label("several triangles");
    }
  }
  return findings.finish();
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!draws_bias_or_unorm(backend)) return not_applicable(kLacksBiasAndUnorm);
  cases::Case biased = for_depths(c, c.depth_bias);
  const Result<backends::Drawn> with = draw_promised(biased, backend);
  if (!with) return tl::unexpected(with.error());
  if (!with->contract.keeps_equal_depth) return not_applicable();
  Check check = check_planes(biased, *with, "with the bias");
  if (!check.is_applicable) return check;
  if (!c.depth_bias.is_none()) {
    biased.depth_bias = {};
    const Result<backends::Drawn> without = draw_promised(biased, backend);
    if (!without) return tl::unexpected(without.error());
    merge(check, check_planes(biased, *without, "without the bias"));
    add_label(check, "biased");
    if (c.depth_bias.slope != 0) add_label(check, "sloped");
  }
  if (cases::unorm_bits(c.depth_format) != 0) add_label(check, "unorm");
  return check;
}

bool is_promised(backends::Backend& backend) {
  return draws_bias_or_unorm(backend) && backend.contract({}).keeps_equal_depth;
}

/// Puts most triangles into one plane, at a depth that one of them has.
Generated generate(Draw& draw) {
  Generated made = biased_case(draw);
  cases::Case& c = made.source;
  const cases::ClipVertex like = c.positions.front();
  const bool has_other = draw.one_in(4);
  const float level = like.w > 0 ? like.z / like.w : 0.5F;
  for (std::size_t i = 0; i < c.positions.size(); ++i) {
    if (has_other && i >= 3) break;
    cases::ClipVertex& p = c.positions[i];
    // A power of two times any float is exact.
    p.w = draw.pick(std::array{1.0F, 1.0F, 2.0F, 0.5F, 4.0F});
    p.z = level * p.w;
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "a-bias-moves-planes-of-equal-depth-as-a-whole",
     .sentence = "a bias moves planes of equal depth as a whole",
     .reason = "On a plane of equal depth m is 0, and r and the depth are the same everywhere.",
     .exceptions =
         "backends that do not promise to keep equal depths; vertices with w = 0, and w < "
         "0 where a constant is added to float32 depths",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend does not promise equal depths for equal inputs, or draws neither "
                   "bias nor unorm depths",
     .covers = {cover(41, "biased"), cover(24, "sloped"), cover(29, "unorm"),
                cover(27, "several triangles"), cover(17, "several samples")}});

}  // namespace
}  // namespace rastercheck::properties::level_planes_law
