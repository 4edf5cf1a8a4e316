// Facing agrees with culling: a picture that shows each fragment's facing (cases::Shading::facing)
// shows front faces where front-face culling removes the triangle, and back faces where back-face
// culling removes it.
//
// Why. A triangle has one facing: the sign of its determinant, computed from the positions that the
// basis names and compared with the orientation of front faces (RULES §1). APIs define both culling
// and gl_FrontFacing by it. So
//
//   - with back faces culled, every fragment that is drawn is of a front face, and with front faces
//     culled of a back face. This holds even where the contract leaves the facing open: whichever
//     facing a triangle has, culling has to respect it;
//   - without culling, a sample shows the facing of the triangle drawn last. The oracle knows it if
//     the orientation is the same for all positions that the contract allows;
//   - if the contract promises that culling changes no bits, a sample that is drawn in only one of
//     the culled pictures shows that facing without culling, too.
//
// The depth test is off, so that the triangle drawn last is visible. Samples: for the first and the
// last statement all, for the second some. Triangles without area, which only conservative coverage
// draws, have no facing: the law does not apply to backends with such coverage. Only backends that
// draw pictures are judged.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/seen_triangles.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties::facing_agrees_with_culling_law {
namespace {

using cases::Cull;
using records::AttributeKind;
using records::FragmentClass;

/// The greatest number of samples of a case about which the oracle is asked.
constexpr std::size_t kMostSamples = 64;
constexpr std::size_t kChannels = 4;

/// The case's pictures without culling, with front faces culled, and with back faces culled.
struct Pictures {
  cases::Picture all;
  cases::Picture backs;
  cases::Picture fronts;
};

/// The picture's alpha is 1 where something is drawn, else 0.
bool is_drawn(const cases::Picture& picture, std::size_t at) {
  return picture.color[kChannels * at + 3] != 0;
}

/// True if the case's front faces have this orientation (oracle::TriangleTruth::orientation).
bool is_front(const cases::Case& c, int orientation) {
  const bool is_ccw = (orientation > 0) == (c.rules == cases::Rules::opengl);
  return is_ccw == (c.front_face == cases::FrontFace::ccw);
}

class FacingCheck {
 public:
  FacingCheck(const cases::Case& c, const cases::Contract& contract, const Pictures& pictures)
      : case_(&c), contract_(&contract), seen_(c, contract), pictures_(&pictures), tally_(c) {}

  Check run() {
    expect_everywhere(pictures_->backs, false, "with front faces culled");
    expect_everywhere(pictures_->fronts, true, "with back faces culled");
    if (contract_->is_invariant) compare_with_culled();
    std::vector<std::size_t> drawn;
    for (std::size_t at = 0; at < pictures_->all.depth.size(); ++at) {
      if (is_drawn(pictures_->all, at)) drawn.push_back(at);
    }
    for (const std::size_t at : some_of(drawn, kMostSamples)) ask_oracle(at);
    return tally_.finish();
  }

 private:
  void expect_everywhere(const cases::Picture& picture, bool is_front, const char* note) {
    for (std::size_t at = 0; at < picture.depth.size(); ++at) {
      if (!is_drawn(picture, at)) continue;
      tally_.label(is_front ? "front faces" : "back faces");
      expect(picture, at, is_front, note);
    }
  }

  /// A sample that only one of the culled pictures has is of triangles of that facing alone.
  void compare_with_culled() {
    for (std::size_t at = 0; at < pictures_->all.depth.size(); ++at) {
      const bool has_back = is_drawn(pictures_->backs, at);
      const bool has_front = is_drawn(pictures_->fronts, at);
      if (has_back && has_front) {
        tally_.label("both");
      } else if (has_back || has_front) {
        expect(pictures_->all, at, has_front, "drawn with only one kind of faces culled");
      }
    }
  }

  void ask_oracle(std::size_t at) {
    const auto place = seen_.find(pictures_->all, at);
    if (!place) return;
    const oracle::TriangleTruth& truth = seen_.truth(place->triangle);
    // Without snapping, the facing is that of the exact positions, clipped or not.
    const bool is_certain = !contract_->coverage || truth.has_certain_orientation();
    if (!is_certain) return tally_.label("facing left open");
    tally_.pass_required(place->triangle);
    expect(pictures_->all, at, is_front(*case_, truth.orientation()),
           "the facing of the triangle drawn last", place->triangle);
  }

  /// Expects 1 in the first three channels of a sample of a front face, else 0, and an alpha of 1.
  void expect(const cases::Picture& picture, std::size_t at, bool is_front, const char* note,
              std::uint32_t triangle = 0) {
    for (std::size_t channel = 0; channel < kChannels; ++channel) {
      const float shown = picture.color[kChannels * at + channel];
      const bool is_one = is_front || channel == 3;
      if (shown == (is_one ? 1.0F : 0.0F)) continue;
      cases::SamplePlace place = place_at(picture, at);
      place.triangle = triangle;
      return tally_.report(violation_at(
          place, class_of_wrong(shown, FragmentClass::beyond_bound), is_one ? "1" : "0",
          std::string(note) + (is_front ? "; a front face" : "; a back face"),
          {AttributeKind::flat, std::nullopt, shown}));
    }
    tally_.pass(AttributeKind::flat);
  }

  const cases::Case* case_;
  const cases::Contract* contract_;
  SeenTriangles seen_;
  const Pictures* pictures_;
  Tally tally_;
};

Result<cases::Picture> draw_facing(const cases::ClipCase& c, Cull cull,
                                   backends::Backend& backend) {
  cases::ClipCase culled = c;
  culled.cull = cull;
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::always;
  pipeline.shading = cases::Shading::facing;
  return draw_picture(culled, backend, pipeline);
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!draws_pictures(backend)) return not_applicable("the backend draws no pictures");
  cases::ClipCase clip = c;
  clip.depth_test = cases::DepthTest::none;
  clip.cull = Cull::none;
  Pictures pictures;
  for (const auto& [cull, picture] : {std::pair{Cull::none, &pictures.all},
                                      {Cull::front, &pictures.backs},
                                      {Cull::back, &pictures.fronts}}) {
    Result<cases::Picture> drawn = draw_facing(clip, cull, backend);
    if (!drawn) return tl::unexpected(drawn.error());
    *picture = *std::move(drawn);
  }
  return FacingCheck(clip, backend.contract(clip), pictures).run();
}

/// Makes cases with triangles of both orientations.
Generated generate(Draw& draw) {
  Generated made = draw.one_in(2) ? overlapping_case(draw) : generate_any(draw);
  cases::Case& c = made.source;
  for (cases::Triangle& triangle : c.triangles) {
    if (draw.one_in(3)) std::swap(triangle[0], triangle[1]);
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "facing-agrees-with-culling",
     .sentence = "facing agrees with culling",
     .reason = "A triangle has one facing, the sign of its determinant, which culling and shaders "
               "are both told.",
     .exceptions = "backends that draw no pictures; conservative coverage",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_pictures,
     .unpromised = "the backend draws no pictures",
     .needs_samples = true,
     .covers = {cover(38, "back faces"), cover(22, "both"), cover(9, "clipped"),
                cover(39, "front faces"), cover(16, "several samples"), cover(6, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::facing_agrees_with_culling_law
