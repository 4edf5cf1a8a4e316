// The corpus (cases/corpus): the names of its files, and what its cases with ties and boundaries
// draw, derived by hand from the fill rules (RULES §2). Pictures show window rows from v = 0 on,
// one character per sample: the triangle that must draw the sample, "o" if drawing it is left open,
// "." if no triangle may draw it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "cases/case_reader.h"
#include "oracle/fragments.h"

namespace rastercheck::oracle::corpus_test {
namespace {

const std::filesystem::path kCorpus = RASTERCHECK_SOURCE_DIR "/cases/corpus";

struct Drawn {
  const char* file;
  const char* picture;
};

cases::Case corpus_case(const std::string& stem) {
  const auto c = cases::read_case((kCorpus / (stem + ".json")).string());
  EXPECT_TRUE(c) << stem << ": " << (c ? "" : to_string(c.error()));
  return c ? *c : cases::Case{};
}

/// The picture of sample 0 of each pixel; "*" if more than one triangle draws it.
std::string picture(const cases::Case& c) {
  const auto width = static_cast<std::size_t>(c.framebuffer.width);
  std::vector<std::string> rows(static_cast<std::size_t>(c.framebuffer.height),
                                std::string(width, '.'));
  const SceneTruth scene(c, cases::contract_of(c));
  for_each_fragment(scene, [&rows](const Fragment& f, const TriangleTruth&) {
    if (f.place.sample != 0) return true;
    char& at = rows[static_cast<std::size_t>(f.place.y)][static_cast<std::size_t>(f.place.x)];
    const bool is_required = f.decision.verdict == records::Verdict::required;
    const char drawn = is_required ? static_cast<char>('0' + f.place.triangle) : 'o';
    at = at == '.' ? drawn : '*';
    return true;
  });
  std::string text;
  for (const std::string& row : rows) text += (text.empty() ? "" : "/") + row;
  return text;
}

void expect_drawn(const std::vector<Drawn>& expected) {
  for (const Drawn& drawn : expected) {
    EXPECT_EQ(picture(corpus_case(drawn.file)), drawn.picture) << drawn.file;
  }
}

std::vector<std::filesystem::path> corpus_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(kCorpus)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Corpus, HasManyCasesInFilesOfPlainNames) {
  const std::regex plain("[a-z0-9]+(-[a-z0-9]+)*\\.json");
  for (const auto& file : corpus_files()) {
    EXPECT_TRUE(std::regex_match(file.filename().string(), plain)) << file;
  }
  EXPECT_GE(corpus_files().size(), 150U);
}

TEST(Corpus, SaysInASentenceOfItsOwnWhatEachCaseIsFor) {
  std::set<std::string> names;
  for (const auto& file : corpus_files()) {
    const std::string name = corpus_case(file.stem().string()).name;
    EXPECT_GE(name.size(), 30U) << file;
    EXPECT_EQ(name.find('\n'), std::string::npos) << file;
    EXPECT_TRUE(names.insert(name).second) << file << " has another's name: " << name;
  }
}

// Every case draws something, except the cases whose names say that they draw nothing.
TEST(Corpus, SaysWhereNothingIsDrawn) {
  for (const auto& file : corpus_files()) {
    const cases::Case c = corpus_case(file.stem().string());
    bool is_drawn = false;
    const SceneTruth scene(c, cases::contract_of(c));
    for_each_fragment(scene, [&is_drawn](const Fragment&, const TriangleTruth&) {
      is_drawn = true;
      return false;
    });
    EXPECT_EQ(is_drawn, c.name.find("nothing is drawn") == std::string::npos) << file;
  }
}

// One edge at u or v = 1.5 or 2.5; all other edges are far off. Under every rule a left edge owns
// its samples and a right edge does not. The rule chooses between the upper and the lower edge, as
// displayed: if window y points up, the upper edge has the greater v.
TEST(Corpus, TiesOnOneEdgeGoByTheRule) {
  const char* const left = ".000/.000/.000/.000";
  const char* const right = "00../00../00../00..";
  expect_drawn({{"tie-left-edge-top-left-y-down", left},
                {"tie-left-edge-bottom-left-y-down", left},
                {"tie-left-edge-top-left-y-up", left},
                {"tie-left-edge-bottom-left-y-up", left},
                {"tie-right-edge-top-left-y-down", right},
                {"tie-right-edge-bottom-left-y-down", right},
                {"tie-right-edge-top-left-y-up", right},
                {"tie-right-edge-bottom-left-y-up", right},
                {"tie-top-edge-top-left-y-down", "..../0000/0000/0000"},
                {"tie-top-edge-bottom-left-y-down", "..../..../0000/0000"},
                {"tie-top-edge-top-left-y-up", "0000/0000/0000/...."},
                {"tie-top-edge-bottom-left-y-up", "0000/0000/..../...."},
                {"tie-bottom-edge-top-left-y-down", "0000/0000/..../...."},
                {"tie-bottom-edge-bottom-left-y-down", "0000/0000/0000/...."},
                {"tie-bottom-edge-top-left-y-up", "..../..../0000/0000"},
                {"tie-bottom-edge-bottom-left-y-up", "..../0000/0000/0000"}});
}

// A slanting edge has A != 0: its samples belong to the triangle on its right, the one with A > 0.
TEST(Corpus, TiesOnDiagonalsGoToTheRight) {
  const char* const four = "0001/3011/3211/2221";
  expect_drawn({{"tie-diagonals-top-left-y-down", four},
                {"tie-diagonals-bottom-left-y-down", four},
                {"tie-diagonals-top-left-y-up", four},
                {"tie-diagonals-bottom-left-y-up", four},
                {"diagonal-falling", "0000/1000/1100/1110"},
                {"diagonal-falling-right-one-first", "1111/0111/0011/0001"},
                {"diagonal-rising", "0001/0011/0111/1111"},
                {"diagonal-rising-perspective-d3d", "0001/0011/0111/1111"},
                {"edge-through-one-sample", ".000/.00./..0./...."},
                {"degenerate-but-one-ulp", "..../.0../..0./...."}});
}

// Two edges meet on a sample: the triangle covers the sample only if both edges own it.
TEST(Corpus, TiesAtVerticesNeedBothEdges) {
  expect_drawn({{"vertices-on-samples", "000./00../0.../...."},
                {"vertices-on-samples-perspective", "000./00../0.../...."},
                {"vertices-on-samples-opengl-top-left", "..../00../0.../...."},
                {"tie-square-d3d", "00../10../..../...."},
                {"tie-square-d3d-bottom-left", "..../10../11../...."},
                {"tie-square-negative-height", "00../10../..../...."},
                {"tie-square-negative-width", "00../10../..../...."},
                {"tie-edges-behind-the-eye", "..../.00./.000/.000"},
                {"tie-parallel-edges-at-infinity", "..../00../00../00.."},
                {"w-zero-twice", "..../.000/.000/.000"},
                {"octants-vulkan", "..../..../..0./...."},
                {"octants-opengl", "..../..../..0./...."},
                {"octants-opengl-top-left", "..../..../..7./...."}});
}

// The middle column of three has x = 0.
TEST(Corpus, ALeastFloatBesideASampleIsNoTie) {
  expect_drawn({{"edge-least-float-left-of-samples", ".00/.00/.00"},
                {"edge-at-minus-zero", ".00/.00/.00"},
                {"edge-least-float-right-of-samples", "..0/..0/..0"}});
}

// The far borders exclude their samples under D3D; the other rules leave these samples open.
TEST(Corpus, ViewportBordersThroughSamples) {
  expect_drawn({{"viewport-left-on-samples", ".000/.000/.000/.000"},
                {"viewport-right-on-samples", "00o./00o./00o./00o."},
                {"viewport-top-on-samples", "..../0000/0000/0000"},
                {"viewport-bottom-on-samples", "0000/0000/oooo/...."},
                {"viewport-borders-d3d", "000./000./000./...."},
                {"viewport-borders-opengl", "000o/000o/000o/oooo"},
                {"viewport-borders-negative-height", "0000/0000/0000/oooo"},
                {"viewport-one-column", ".0../.0../.0../.0.."},
                {"scissor-one-pixel", "..../..0./..../...."},
                {"scissor-beyond-the-framebuffer", "00../00../00../00.."}});
}

// A depth plane through u = 1.5, or v = 1.5 or 2.5: its boundary counts as inside, whichever way
// the plane faces.
TEST(Corpus, DepthPlanesThroughSamplesKeepThem) {
  const char* const kept = ".000/.000/.000/.000";
  const char* const lost = "..00/..00/..00/..00";
  expect_drawn({{"near-plane-through-samples", kept},
                {"near-plane-through-samples-perspective", kept},
                {"near-plane-through-samples-d3d", "000./000./000./000."},
                {"near-plane-through-samples-opengl", "..../0000/0000/0000"},
                {"far-plane-through-samples", kept},
                {"far-plane-through-samples-opengl", "0000/0000/0000/...."},
                {"near-plane-one-ulp-before-samples", lost},
                {"near-plane-one-ulp-behind-samples", kept},
                {"far-plane-one-ulp-before-samples", kept},
                {"far-plane-one-ulp-behind-samples", lost},
                {"near-plane-on-an-edge", ".0../.0../.0../.0.."},
                {"far-plane-on-an-edge", "..../..../..../...."},
                {"near-plane-on-a-vertex", "..../.0../..../...."}});
}

// A clip distance of zero is decided by the distance's own normal, like an edge's tie; under D3D it
// is inside.
TEST(Corpus, ClipDistancesThroughSamples) {
  expect_drawn({{"clip-distance-tie-row", "..../0000/0000/0000"},
                {"clip-distance-tie-row-opengl", "..../..../0000/0000"},
                {"clip-distance-tie-d3d", "000./000./000./000."},
                {"clip-distance-and-its-negative", "..../..../..../...."},
                {"clip-distance-and-its-negative-d3d", ".0../.0../.0../.0.."},
                {"clip-distance-zero-everywhere", "0000/0000/0000/0000"},
                {"clip-distance-along-an-edge", ".000/.000/.000/.000"},
                {"clip-distance-along-an-edge-negated", "..../..../..../...."},
                {"clip-distance-along-an-edge-negated-d3d", ".0../.0../.0../.0.."},
                {"clip-distances-meet-on-a-sample", "..../..../.000/.000"}});
}

// Triangle 0 runs counter-clockwise as displayed, triangle 1 clockwise.
TEST(Corpus, FacingIsThatOfTheDisplay) {
  const char* const ccw = "000...../00....../0......./........";
  const char* const cw = "....111./....11../....1.../........";
  for (const std::string rules : {"vulkan", "opengl", "d3d"}) {
    expect_drawn({{("cull-back-" + rules).c_str(), ccw},
                  {("cull-front-" + rules).c_str(), cw},
                  {("cull-back-front-face-cw-" + rules).c_str(), cw},
                  {("cull-front-front-face-cw-" + rules).c_str(), ccw}});
  }
  expect_drawn(
      {{"cull-negative-height", ccw}, {"cull-back-behind-the-eye", "..../..../0000/0000"}});
}

// At equal depths the first triangle drawn stays. In depth-test-equal-on-a-diagonal, the planes of
// the two triangles meet on u = v, and each plane is nearer on one side of this line.
TEST(Corpus, EqualDepthsKeepTheFirstDrawn) {
  expect_drawn({{"depth-test-equal", "0000/0000/0000/0000"},
                {"depth-test-equal-different-w", "0000/0000/0000/0000"},
                {"depth-test-clamped-equal", "0000/0000/0000/0000"},
                {"depth-test-one-ulp-nearer", "1111/1111/1111/1111"},
                {"depth-test-equal-on-a-diagonal", "0111/0011/0001/0000"}});
}

// A left edge half a grid unit from u = 2.5, where the samples of column 2 lie; they are grid
// points.
TEST(Corpus, SnappingTiesGoToTheEvenPointOrUp) {
  const char* const onto = "..00/..00/..00/..00";
  const char* const beyond = "...0/...0/...0/...0";
  expect_drawn({{"snap-tie-4-even", onto},
                {"snap-tie-4-half-up", beyond},
                {"snap-tie-8-even-d3d", onto},
                {"snap-tie-8-odd", beyond},
                {"snap-tie-8-one-ulp-above", beyond},
                {"snap-tie-8-one-ulp-below", onto},
                {"snap-tie-16-even", onto},
                {"snap-tie-16-half-up-opengl", onto},
                {"snap-position-error-d3d", "..o0/..o0/..o0/..o0"}});
}

// Vertices at (1.5, 1.5), (4.5, 1.5), (1.5, 4.5) snap to (2, 2), (4, 2), (2, 4), or if halves round
// up to (2, 2), (5, 2), (2, 5). Samples on the hypotenuse belong to the triangle on its right. A
// vertex at (-1.5, 0) snaps to u = -2 or -1; the edge from there to (4, 4) passes v = 1.5 at u =
// 0.25 or 0.875.
TEST(Corpus, SnappingToWholePixels) {
  const std::string none(8, '.');
  const auto rows = [&none](std::vector<std::string> drawn) {
    drawn.resize(8, none);
    std::string text;
    for (const std::string& row : drawn) text += (text.empty() ? "" : "/") + row;
    return text;
  };
  EXPECT_EQ(picture(corpus_case("snap-tie-0-even")), rows({none, none, "..0....."}));
  EXPECT_EQ(picture(corpus_case("snap-tie-0-half-up")), rows({none, none, "..00....", "..0....."}));
  EXPECT_EQ(picture(corpus_case("snap-tie-negative-even")),
            rows({"0000000.", "000000..", "..000...", "...0...."}));
  EXPECT_EQ(picture(corpus_case("snap-tie-negative-half-up")),
            rows({"0000000.", ".00000..", "..000...", "...0...."}));
  EXPECT_EQ(picture(corpus_case("winding-flipped-by-snapping")),
            rows({none, ".0......", "..0....."}));
}

// Samples are at 0.5, 1.5, 2.5 and 3.5.
TEST(Corpus, DefectsOfOtherRasterizersAreDrawnRight) {
  expect_drawn({{"box-ends-on-samples", "0000/1000/1100/1110"},
                {"bottom-edges-of-two-quads", "1000/1100/2222/3332"},
                {"half-pixel-boundary", "0032/1032/1132/1133"},
                {"horizontal-edges-both-ways", "..../0011/0011/0011"},
                {"centre-not-corner", "..../.0../..../...."},
                {"diagonals-through-tie-break-points", "0000/1000/1100/1110/3322/3442/3442/4444"}});
}

}  // namespace
}  // namespace rastercheck::oracle::corpus_test
