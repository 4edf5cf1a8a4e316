// A probe finds what is known about a backend. The backends are `cpu` in each of its modes, which
// draws what a case asks for, and `cpu` changed on purpose in one way ("bent").

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "backends/factory.h"
#include "properties/probing/grid.h"
#include "properties/probing/probe.h"
#include "tests/properties/probing/bent.h"

namespace rastercheck::properties::probing_test {
namespace {

using cases::Basis;
using cases::Case;
using cases::Coverage;
using cases::Fragments;
using cases::Rounding;
using cases::Snapping;
using cases::TieRule;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::StartsWith;

records::Probe probed(backends::Backend& backend, const AskedDrawing& asked) {
  ProbeOptions options;
  options.cases = 4;
  options.asked = asked;
  Result<records::Probe> result = probe("bent", backend, options, {});
  EXPECT_TRUE(result.has_value()) << to_string(result.error());
  return std::move(result).value_or(records::Probe());
}

records::Probe probed(const std::string& specification, const AskedDrawing& asked) {
  const auto backend = backends::make_backend(specification);
  EXPECT_TRUE(backend.has_value());
  return backend ? probed(**backend, asked) : records::Probe();
}

AskedDrawing ask(const Coverage& coverage, TieRule fill_rule = TieRule::top_left,
                 Basis basis = Basis::ideal) {
  return {coverage, basis, fill_rule};
}

/// The measured value of this row; if several rows have the name, of the first.
std::string measured(const records::Probe& probe, const std::string& what) {
  for (const records::Measured& row : probe.rows) {
    if (row.what == what) return row.measured;
  }
  return "no row " + what;
}

/// The names of the rows that contradict what the backend declares.
std::vector<std::string> contradictions(const records::Probe& probe) {
  std::vector<std::string> names;
  for (const records::Measured& row : probe.rows) {
    if (row.contradicts) names.push_back(row.what);
  }
  return names;
}

// ---- The grid's own arithmetic. A pixel is 2^18.

constexpr std::int64_t kPixel = std::int64_t{1} << kFineBits;

TEST(FineGrid, GoesToTheNearestPoint) {
  const std::int64_t unit = kPixel / 4;  // of a 2-bit grid
  const std::int64_t midway = 5 * unit + unit / 2;
  EXPECT_EQ(rounded(midway - 1, unit, GridRounding::half_up), 5 * unit);
  EXPECT_EQ(rounded(midway, unit, GridRounding::half_up), 6 * unit);
  EXPECT_EQ(rounded(midway, unit, GridRounding::half_down), 5 * unit);
  EXPECT_EQ(rounded(midway, unit, GridRounding::nearest_even), 6 * unit);
  EXPECT_EQ(rounded(midway + unit, unit, GridRounding::nearest_even), 6 * unit);
  EXPECT_EQ(rounded(midway + 1, unit, GridRounding::down), 5 * unit);
  EXPECT_EQ(rounded(5 * unit + 1, unit, GridRounding::up), 6 * unit);
  EXPECT_EQ(rounded(5 * unit, unit, GridRounding::up), 5 * unit);
  EXPECT_EQ(rounded(-1, unit, GridRounding::down), -unit);
  EXPECT_EQ(rounded(midway + 1, 1, GridRounding::down), midway + 1);
}

TEST(FineGrid, KnowsWhereSamplesLie) {
  // The triangle (0, 0), (2, 0), (0, 2): its hypotenuse runs through the centres of pixels (1, 0)
  // and (0, 1).
  FineTriangle triangle;
  triangle.x = {0, 2 * kPixel, 0};
  triangle.y = {0, 0, 2 * kPixel};
  EXPECT_EQ(area_of(triangle), 4 * kPixel * kPixel);
  EXPECT_TRUE(place_in(triangle, 0, 0).is_inside);
  EXPECT_EQ(place_in(triangle, 0, 0).zero_edges, 0);
  const FinePlace on_edge = place_in(triangle, 1, 0);
  EXPECT_TRUE(on_edge.is_inside);
  EXPECT_EQ(on_edge.zero_edges, 1);
  EXPECT_LT(on_edge.normal_x, 0);
  EXPECT_LT(on_edge.normal_y, 0);
  EXPECT_FALSE(place_in(triangle, 1, 1).is_inside);
}

// ---- cpu, as cases ask it to draw.

TEST(Probe, FindsThatNothingIsRounded) {
  const records::Probe probe = probed("cpu", ask(Coverage()));
  EXPECT_THAT(measured(probe, "subpixel grid"), StartsWith("none"));
  EXPECT_EQ(measured(probe, "position error"), "none");
  EXPECT_EQ(measured(probe, "tie rule"), "top_left");
  EXPECT_EQ(measured(probe, "greatest coordinate drawn right"), "2^96 pixels or more");
  EXPECT_EQ(measured(probe, "one vertex with w < 0"), "drawn right");
  EXPECT_EQ(measured(probe, "three vertices with w < 0"), "nothing to draw, nothing drawn");
  EXPECT_EQ(measured(probe, "subnormal clip positions"), "kept");
  EXPECT_EQ(measured(probe, "subnormal attribute values"), "kept");
  EXPECT_EQ(measured(probe, "drawing twice"), "the same bits");
  EXPECT_EQ(measured(probe, "values at vertices to the bit"), "kept");
  EXPECT_THAT(measured(probe, "coverage as measured"), StartsWith("holds"));
  EXPECT_EQ(probe.terms.coverage, cases::CoverageTerm(Coverage()));
  EXPECT_EQ(probe.terms.smooth, cases::ValueBound{0.51F});
  EXPECT_EQ(probe.terms.depth, cases::ValueBound{0.51F});
  EXPECT_EQ(probe.terms.numbers, cases::MagnitudeRange());
  EXPECT_THAT(contradictions(probe), IsEmpty());
}

class ProbeOfGrid : public ::testing::TestWithParam<int> {};

TEST_P(ProbeOfGrid, FindsItsBits) {
  const int bits = GetParam();
  const records::Probe probe =
      probed("cpu", ask(Snapping{bits}, TieRule::bottom_left, Basis::snapped));
  EXPECT_EQ(measured(probe, "subpixel grid"), std::to_string(bits) + " bits, nearest_even");
  EXPECT_EQ(measured(probe, "position error"), "none");
  EXPECT_EQ(measured(probe, "tie rule"), "bottom_left");
  EXPECT_EQ(measured(probe, "guard band"), "32768 pixels");
  for (const char* of : {"smooth attributes", "noperspective attributes", "depth", "facing"}) {
    EXPECT_EQ(measured(probe, std::string("basis of ") + of), "snapped") << of;
  }
  EXPECT_EQ(probe.terms.coverage, cases::CoverageTerm(Coverage(Snapping{bits})));
  EXPECT_EQ(probe.terms.basis, cases::Term<Basis>(Basis::snapped));
  EXPECT_THAT(measured(probe, "coverage as measured"), StartsWith("holds"));
  EXPECT_THAT(contradictions(probe), IsEmpty());
}
INSTANTIATE_TEST_SUITE_P(Cpu, ProbeOfGrid, ::testing::Values(1, 3, 4, 8, 16));

TEST(Probe, FindsTheRoundingThatIsDrawn) {
  const records::Probe probe = probed("cpu", ask(Snapping{8, Rounding::half_up, 0}));
  EXPECT_EQ(measured(probe, "subpixel grid"), "8 bits, half_up");
  EXPECT_EQ(measured(probe, "basis of smooth attributes"), "ideal");
  EXPECT_EQ(measured(probe, "basis of facing"), "ideal");
}

TEST(Probe, FindsThatWhatIsAskedIsFollowed) {
  const records::Probe probe = probed("cpu", {});
  EXPECT_THAT(measured(probe, "grid if exact is requested"), StartsWith("none"));
  EXPECT_EQ(measured(probe, "grid if 8 bits are requested"), "8 bits, nearest_even");
  EXPECT_EQ(measured(probe, "bits requested"), "0 to 16, all honoured");
  EXPECT_EQ(probe.terms.coverage, cases::CoverageTerm(cases::AsAsked()));
  EXPECT_EQ(probe.terms.tie_rule, cases::Term<TieRule>(cases::AsAsked()));
  EXPECT_EQ(probe.terms.basis, cases::Term<Basis>(cases::AsAsked()));
}

TEST(Probe, FindsThatFloatsAreLessPrecise) {
  const records::Probe probe = probed("cpu:precision=float32", ask(Coverage()));
  ASSERT_TRUE(probe.terms.smooth.has_value());
  EXPECT_GT(probe.terms.smooth->constant, 0.51F);
  EXPECT_LT(probe.terms.smooth->constant, 2 * 6.84F + 1);  // about twice the promised bound
  EXPECT_EQ(probe.terms.depth, cases::ValueBound{0.51F});
}

/// How sure the row is; if several rows have the name, the first.
records::Sureness sureness(const records::Probe& probe, const std::string& what) {
  for (const records::Measured& row : probe.rows) {
    if (row.what == what) return row.sureness;
  }
  return {"no row " + what};
}

// Kills: a row that does not say from how much it is known.
TEST(Probe, SaysHowSureItIs) {
  const records::Probe probe = probed("cpu", ask(Snapping{8}));
  for (const records::Measured& row : probe.rows) {
    if (row.what == "infinities and NaN") continue;
    EXPECT_NE(row.sureness.unit, "") << row.what;
    EXPECT_GT(row.sureness.in_favour, 0U) << row.what;
  }
  const records::Sureness ties = sureness(probe, "tie rule");
  EXPECT_GT(ties.in_favour, 100U);
  EXPECT_EQ(ties.against, 0U);
  EXPECT_GT(ties.undecided, 0U);  // samples at corners
  EXPECT_EQ(sureness(probe, "basis of facing").unit, "triangles");
  EXPECT_EQ(sureness(probe, "basis of facing").against, 0U);
}

// ---- cpu, bent.

records::Probe probe_of(const Bending& bending, const AskedDrawing& asked) {
  Bent backend(bending);
  return probed(backend, asked);
}

TEST(ProbeOfBent, FindsAGridThatNobodyAskedFor) {
  Bending bending;
  bending.before = [](Case c) {
    c.coverage = Snapping{6};
    c.fill_rule = TieRule::bottom_left;
    c.basis = Basis::snapped;
    return c;
  };
  const records::Probe probe = probe_of(bending, {});
  EXPECT_EQ(measured(probe, "subpixel grid"), "6 bits, nearest_even");
  // Errors below 2^-18 pixels are not seen.
  const Snapping seen{6, cases::Rounding::nearest_even, 0x1p-12F};
  EXPECT_EQ(probe.terms.coverage, cases::CoverageTerm(Coverage(seen)));
  EXPECT_EQ(measured(probe, "tie rule if top_left is requested"),
            "no row tie rule if top_left is requested");
  EXPECT_EQ(probe.terms.tie_rule, cases::Term<TieRule>(TieRule::bottom_left));
  EXPECT_EQ(probe.terms.basis, cases::Term<Basis>(Basis::snapped));
  EXPECT_THAT(contradictions(probe), IsSupersetOf({"subpixel grid", "tie rule"}));
}

/// Moves every vertex by this many pixels in x, for a viewport of 64 pixels.
Case moved(Case c, float pixels) {
  for (cases::ClipVertex& p : c.positions) p.x += pixels / 32 * p.w;
  return c;
}

TEST(ProbeOfBent, FindsThePositionError) {
  Bending bending;
  bending.before = [](Case c) { return moved(std::move(c), 0.2F / 256); };
  const records::Probe probe = probe_of(bending, ask(Snapping{8}));
  EXPECT_THAT(measured(probe, "subpixel grid"), StartsWith("8 bits"));
  // The probe reports the position error as a power of two. It draws positions that are some
  // fractions of a unit apart, so it cannot report less than 1/8.
  EXPECT_THAT(measured(probe, "position error"),
              ::testing::AnyOf("0.125 grid units", "0.25 grid units"));
}

/// Replaces the values of the first attribute by those of `value`, a function of the case, its
/// triangle and the middle of a pixel.
Bending valued(
    std::function<std::optional<float>(const Case&, const cases::Triangle&, float, float)> value) {
  auto seen = std::make_shared<Case>();
  Bending bending;
  bending.before = [seen](Case c) {
    *seen = c;
    return c;
  };
  bending.after = [seen, value = std::move(value)](Fragments& drawn) {
    for (std::size_t i = 0; i < drawn.size() && drawn.attribute_count > 0; ++i) {
      const std::optional<float> own =
          value(*seen, seen->triangles[drawn.triangle[i]], static_cast<float>(drawn.x[i]) + 0.5F,
                static_cast<float>(drawn.y[i]) + 0.5F);
      if (own) drawn.attributes[i * drawn.attribute_count] = *own;
    }
  };
  return bending;
}

/// Evaluates a float32 plane relative to (px, py), for a right triangle with w = 1 and legs along
/// the axes.
std::optional<float> by_plane(const Case& c, const cases::Triangle& t, float x, float y, float px,
                              float py) {
  if (c.framebuffer.width != 1024) return std::nullopt;
  const auto window = [&c](std::uint32_t vertex) {
    const cases::ClipVertex& p = c.positions[vertex];
    return std::array{(p.x + 1) * c.viewport.width / 2, (p.y + 1) * c.viewport.height / 2};
  };
  const auto r = [&](std::size_t i) { return c.attributes_of(t[i])[0]; };
  const auto [x0, y0] = window(t[0]);
  const float a = (r(1) - r(0)) / (window(t[1])[0] - x0);
  const float b = (r(2) - r(0)) / (window(t[2])[1] - y0);
  const float at_point = r(0) - a * (x0 - px) - b * (y0 - py);
  return at_point + a * (x - px) + b * (y - py);
}

TEST(ProbeOfBent, FindsWherePlanesAreEvaluated) {
  constexpr const char* kRow = "planes of smooth attributes";
  EXPECT_EQ(measured(probed("cpu", ask(Coverage())), kRow),
            "about a point of the triangle, or better");
  const auto about_origin = [](const Case& c, const cases::Triangle& t, float x, float y) {
    return by_plane(c, t, x, y, 0, 0);
  };
  EXPECT_EQ(measured(probe_of(valued(about_origin), ask(Coverage())), kRow),
            "as about the window's origin");
  // Values are evaluated relative to the corner of a 64-pixel tile, on average 32 pixels away. The
  // probe may answer 16 or 64, each within a factor of two of that.
  const auto about_tile = [](const Case& c, const cases::Triangle& t, float x, float y) {
    return by_plane(c, t, x, y, std::floor(x / 64) * 64, std::floor(y / 64) * 64);
  };
  EXPECT_THAT(
      measured(probe_of(valued(about_tile), ask(Coverage())), kRow),
      ::testing::AnyOf("as about a point 16 pixels away", "as about a point 64 pixels away"));
}

// Kills: mistaking a multiplication by the reciprocal for a division.
TEST(ProbeOfBent, FindsHowValuesAreDivided) {
  constexpr const char* kRow = "division by 1/w";
  const auto divided_by = [](float (*divide)(float r, float w)) {
    const auto value = [divide](const Case& c, const cases::Triangle& t, float,
                                float) -> std::optional<float> {
      const float w = c.positions[t[0]].w;
      const float r = c.attributes_of(t[0])[0];
      const bool is_plain = c.positions[t[1]].w == w && c.positions[t[2]].w == w &&
                            c.attributes_of(t[1])[0] == r && c.attributes_of(t[2])[0] == r;
      if (!is_plain) return std::nullopt;
      return divide(r, w);
    };
    return measured(probe_of(valued(value), ask(Coverage())), kRow);
  };
  EXPECT_EQ(measured(probed("cpu", ask(Coverage())), kRow), "the value itself");
  EXPECT_EQ(divided_by([](float r, float w) { return r * (1 / w) / (1 / w); }),
            "r (1/w) divided by 1/w");
  EXPECT_EQ(divided_by([](float r, float w) { return r / w * (1 / (1 / w)); }),
            "r/w times a reciprocal of 1/w");
  EXPECT_EQ(divided_by([](float r, float w) { return r * (1 + 0x1p-20F) * w / w; }),
            "none of the forms tried");
}

TEST(ProbeOfBent, FindsTrianglesThatAreLeftOut) {
  Bending bending;
  bending.before = [](Case c) {
    for (cases::Triangle& t : c.triangles) {
      for (const std::uint32_t i : cases::Triangle(t)) {
        if (c.positions[i].w <= 0) t = {i, i, i};
      }
    }
    return c;
  };
  const records::Probe probe = probe_of(bending, ask(Coverage()));
  EXPECT_THAT(measured(probe, "one vertex with w < 0"), StartsWith("left out"));
  EXPECT_EQ(measured(probe, "clip tolerance, near plane"), "0 grid units");
  EXPECT_THAT(measured(probe, "clip tolerance, w = 0"), StartsWith("more than"));
}

TEST(ProbeOfBent, FindsFlushedNumbers) {
  const auto flush = [](float& number) {
    if (std::fabs(number) < std::numeric_limits<float>::min()) number = 0;
  };
  Bending bending;
  bending.before = [flush](Case c) {
    for (cases::ClipVertex& p : c.positions) {
      for (float* number : {&p.x, &p.y, &p.z, &p.w}) flush(*number);
    }
    for (float& value : c.attribute_values) flush(value);
    return c;
  };
  const records::Probe probe = probe_of(bending, ask(Coverage()));
  EXPECT_EQ(measured(probe, "subnormal clip positions"), "lost");
  EXPECT_EQ(measured(probe, "subnormal attribute values"), "lost");
  ASSERT_TRUE(probe.terms.numbers.has_value());
  EXPECT_GE(probe.terms.numbers->least, 0x1p-126F);
  EXPECT_LE(probe.terms.numbers->least, 0x1p-116F);
  EXPECT_EQ(probe.terms.numbers->greatest, std::numeric_limits<float>::max());
  EXPECT_THAT(contradictions(probe),
              IsSupersetOf({"clip positions that draw right", "attribute values that come back"}));
}

// Kills: counting a tie that goes the other way as one for the rule.
TEST(ProbeOfBent, CountsTiesThatGoTheOtherWay) {
  Bending bending;
  bending.before = [count = 0](Case c) mutable {
    if (++count % 4 == 0) c.fill_rule = TieRule::bottom_left;
    return c;
  };
  const records::Sureness ties = sureness(probe_of(bending, ask(Snapping{8})), "tie rule");
  EXPECT_GT(ties.against, 0U);
  EXPECT_GT(ties.in_favour, ties.against);
}

TEST(ProbeOfBent, FindsPicturesThatChange) {
  Bending bending;
  bending.after = [count = 0](Fragments& drawn) mutable {
    if (++count % 2 == 0 && !drawn.depth.empty()) drawn.depth[0] += 0x1p-20F;
  };
  const records::Probe probe = probe_of(bending, ask(Coverage()));
  EXPECT_EQ(measured(probe, "drawing twice"), "other bits");
  EXPECT_GT(sureness(probe, "drawing twice").in_favour, 0U);
}

TEST(ProbeOfBent, FindsHowFarValuesAreOff) {
  Bending bending;
  bending.after = [](Fragments& drawn) {
    // The error is 2^-20 of the value: 8 to 16 ulp, or less if a vertex has a greater value.
    for (float& value : drawn.attributes) value *= 1 + 0x1p-20F;
  };
  const records::Probe probe = probe_of(bending, ask(Coverage()));
  ASSERT_TRUE(probe.terms.smooth.has_value());
  EXPECT_GE(probe.terms.smooth->constant, 16);
  EXPECT_LE(probe.terms.smooth->constant, 40);
  EXPECT_EQ(probe.terms.keeps_constants, false);
  EXPECT_THAT(contradictions(probe), IsSupersetOf({"bound of smooth", "bound of noperspective"}));
}

TEST(ProbeOfBent, FindsHowFarOutItDraws) {
  Bending bending;
  bending.before = [](Case c) -> std::optional<Case> {
    for (const cases::ClipVertex& p : c.positions) {
      if (std::fabs(p.x * 32 + 32) > 1024 * p.w) return std::nullopt;
    }
    return c;
  };
  const records::Probe probe = probe_of(bending, ask(Snapping{8}));
  EXPECT_EQ(measured(probe, "guard band"), "1024 pixels");
  EXPECT_GT(probe.unsupported, 0U);
}

TEST(ProbeOfBent, AsksByRulesThatAreDrawn) {
  Bending bending;
  bending.before = [](Case c) {
    return c.rules == cases::Rules::opengl ? std::optional(c) : std::nullopt;
  };
  const records::Probe probe = probe_of(bending, ask(Coverage(), TieRule::top_left));
  EXPECT_THAT(measured(probe, "subpixel grid"), StartsWith("none"));
  EXPECT_EQ(measured(probe, "tie rule"), "top_left");
}

TEST(ProbeOfBent, FailsWhereNothingIsDrawn) {
  Bending bending;
  bending.before = [](const Case& /*c*/) { return std::nullopt; };
  Bent backend(bending);
  const Result<records::Probe> result = probe("bent", backend, {}, {});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().failure, Failure::unsupported);
}

}  // namespace
}  // namespace rastercheck::properties::probing_test
