// A decal is drawn before its plane or behind it, as its bias says: over a depth buffer that holds
// the depth of a plane of equal depth, a triangle of that plane is drawn everywhere with a bias of
// −k, and nowhere with a bias of k or without one.
//
// Why. The plane has the depth z, drawn as u, and m = 0. A depth test `less` compares stored
// depths, and the stored depth of a cleared value u is u again, since u was stored. Without a bias
// the triangle has u as well, which is not less. With the constant −k its depth is z − k r, clamped
// to the least depth l, and is drawn as b. A drawn depth is off by at most s, by the contract's
// bound and by storing, so b < u if
//
//   min(k r, z − l) > s(b) + s(u),
//
// and likewise b > u with the constant k. Both drawings have the same coverage, as that does not
// depend on depths. Only such k are tried: for others, the law has only the drawing without a bias.
//
// Samples: those that the triangles cover without a depth test. The law applies if the contract
// promises equal depths; if it keeps the nearest fragment, and the first of equals; and if depth
// tests compare the format that fragments have.

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/biased_depths.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/sample_place.h"

namespace rastercheck::properties::decals_obey_their_bias_law {
namespace {

using records::FragmentClass;

/// A plane over which decals are drawn.
struct Plane {
  cases::Case base;  ///< triangles of one plane, without bias and depth test
  float depth = 0;   ///< as drawn
  cases::Fragments drawn;
};

Result<cases::Fragments> draw_over(const Plane& plane, float constant, backends::Backend& backend) {
  cases::Case decal = plane.base;
  decal.depth_test = cases::DepthTest::less;
  decal.depth_clear = plane.depth;
  decal.depth_bias.constant = constant;
  Result<backends::Drawn> drawn = draw_promised(decal, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  return std::move(drawn->fragments);
}

/// True if a constant of size k certainly changes the plane's stored depth in that direction.
bool is_certain(const Plane& plane, const cases::Contract& contract, double k, bool is_nearer) {
  const double depth{plane.depth};
  const double offset = k * least_bias_unit(plane.base, contract, depth);
  const DepthLimits limits = depth_limits(plane.base);
  const double room = is_nearer ? depth - limits.least : limits.greatest - depth;
  const double slack = depth_slack(plane.base, contract, depth);
  // A depth that is moved farther has a larger slack; 4 allows for the next power of two.
  return std::min(offset, room - slack) > (is_nearer ? 2 : 4) * slack;
}

void report_left(Tally& tally, const cases::Fragments& left, const std::string& how) {
  for (std::size_t i = 0; i < left.size(); ++i) {
    tally.report(violation_at(left.place_of(i), FragmentClass::extra,
                              "forbidden: it is not nearer than its own plane", how));
  }
}

void report_hidden(Tally& tally, const Plane& plane, const cases::Fragments& left,
                   const std::string& how) {
  const auto seen = fragments_by_sample(left);
  for (std::size_t i = 0; i < plane.drawn.size(); ++i) {
    const cases::SamplePlace place = plane.drawn.place_of(i);
    if (seen.contains(sample_of(place))) continue;
    tally.report(violation_at(place, FragmentClass::missing,
                              "required: its bias brings it before its own plane", how));
  }
}

/// The case's triangles that lie in the plane of the first triangle of equal depth.
cases::Case triangles_of_one_plane(const cases::Case& c) {
  cases::Case base = for_depths(c, {});
  std::erase_if(base.triangles, [&](const cases::Triangle& t) { return !is_level(c, t); });
  if (base.triangles.empty()) return base;
  const cases::ClipVertex first = c.positions[base.triangles.front()[0]];
  std::erase_if(base.triangles, [&](const cases::Triangle& t) {
    const cases::ClipVertex& p = c.positions[t[0]];
    return double{p.z} * double{first.w} != double{first.z} * double{p.w};
  });
  return base;
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!draws_bias(backend)) return not_applicable("the backend has no depth bias");
  Plane plane{triangles_of_one_plane(c), 0, {}};
  if (plane.base.triangles.empty()) return not_applicable("no triangle has equal depth");
  Result<backends::Drawn> drawn = draw_promised(plane.base, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  const cases::Contract contract = drawn->contract;
  const bool is_usual = contract.keeps_equal_depth && contract.is_invariant &&
                        contract.depth_function == cases::KeptDepth::less &&
                        contract.depth_error == cases::DepthError::either_side &&
                        contract.depth_format == c.depth_format;
  if (!is_usual) return not_applicable("the contract has another depth test");
  plane.drawn = std::move(drawn->fragments);
  if (plane.drawn.size() == 0) return not_applicable("nothing is drawn");
  plane.depth = plane.drawn.depth[0];
  for (const float depth : plane.drawn.depth) {
    if (depth != plane.depth) return not_applicable("the plane is drawn with several depths");
  }
  const bool is_in_range = plane.depth >= 0 && plane.depth <= 1;
  if (!is_in_range) return not_applicable("no depth of a buffer");
  // Depth clamp may have brought the plane here from farther away than the bias reaches.
  if (c.depth_clamp && !is_unclamped(plane.base, contract, double{plane.depth})) {
    return not_applicable("the plane may be outside the depth range");
  }

  Tally tally(plane.base);
  for (std::size_t i = 0; i < plane.drawn.size(); ++i) {
    tally.pass_required(plane.drawn.triangle[i]);
  }
  const Result<cases::Fragments> plain = draw_over(plane, 0, backend);
  if (!plain) return tl::unexpected(plain.error());
  report_left(tally, *plain, "drawn over its own depth, without a bias");

  constexpr std::array kSizes{2.0F, 3.0F, 4.0F, 8.0F, 16.0F, 64.0F, 1024.0F, 65536.0F};
  const float k = Choices(choices_of(c)).pick(kSizes);
  const std::string size = value_text(k);
  if (is_certain(plane, contract, double{k}, true)) {
    const Result<cases::Fragments> nearer = draw_over(plane, -k, backend);
    if (!nearer) return tl::unexpected(nearer.error());
    report_hidden(tally, plane, *nearer, "drawn over its own depth, with the bias −" + size);
    tally.label("nearer");
  }
  if (is_certain(plane, contract, double{k}, false)) {
    const Result<cases::Fragments> farther = draw_over(plane, k, backend);
    if (!farther) return tl::unexpected(farther.error());
    report_left(tally, *farther, "drawn over its own depth, with the bias " + size);
    tally.label("farther");
  }
  if (cases::unorm_bits(c.depth_format) != 0) tally.label("unorm");
  return tally.finish();
}

bool is_promised(backends::Backend& backend) {
  const cases::Contract contract = backend.contract({});
  return draws_bias(backend) && contract.keeps_equal_depth && contract.is_invariant;
}

/// Puts all triangles into one plane.
Generated generate(Draw& draw) {
  Generated made = biased_case(draw);
  cases::Case& c = made.source;
  const cases::ClipVertex like = c.positions.front();
  const float level = like.w > 0 && draw.one_in(2) ? like.z / like.w : draw.unit();
  for (cases::ClipVertex& p : c.positions) {
    p.w = draw.pick(std::array{1.0F, 1.0F, 2.0F, 0.5F, 4.0F});
    p.z = level * p.w;
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "a-decal-is-drawn-as-its-bias-says",
     .sentence = "a decal is drawn before its plane or behind it, as its bias says",
     .reason = "k r moves a depth by more than the contract lets it be off, and a depth test "
               "compares what is stored.",
     .exceptions = "biases too small to be certain; backends that do not promise to keep equal "
                   "depths, or whose depth test is another one",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised =
         "the backend does not promise equal depths for equal inputs, or has no depth bias",
     .covers = {cover(39, "nearer"), cover(34, "farther"), cover(29, "unorm")}});

}  // namespace
}  // namespace rastercheck::properties::decals_obey_their_bias_law
