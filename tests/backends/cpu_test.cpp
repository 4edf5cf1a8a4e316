// The rasterizer behind the backend interface, judged by the oracle under its own contract.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case_reader.h"
#include "oracle/fragments.h"
#include "oracle/judged_transform.h"
#include "oracle/transform.h"
#include "oracle/ulp.h"
#include "tests/backends/assembled_cases.h"

namespace rastercheck::backends::cpu_test {
namespace {

using oracle::Fragment;
using oracle::TriangleTruth;
using Place = std::tuple<std::size_t, int, int, int>;  // triangle, x, y, sample

/// The cases of the corpus as they are drawn: with rounded clip positions, and each triangle alone.
std::vector<cases::Case> corpus() {
  std::vector<cases::Case> all;
  const std::filesystem::path folder = RASTERCHECK_SOURCE_DIR "/cases/corpus";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    cases::Case c =
        cases::read_case(entry.path().string())
            .and_then([](const cases::Case& read) { return oracle::to_clip_case(read, ""); })
            .value();
    c.depth_test = cases::DepthTest::none;
    all.push_back(std::move(c));
  }
  return all;
}

std::map<Place, std::size_t> by_place(const cases::Fragments& drawn) {
  std::map<Place, std::size_t> places;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    places[{drawn.triangle[i], drawn.x[i], drawn.y[i], drawn.sample[i]}] = i;
  }
  return places;
}

TEST(Cpu, ObeysItsContractInCoverage) {
  std::size_t required = 0;
  for (const cases::Case& c : corpus()) {
    const auto backend = make_backend("cpu").value();
    const cases::Fragments drawn = backend->draw(c).value().fragments;
    std::map<Place, std::size_t> left = by_place(drawn);
    EXPECT_EQ(left.size(), drawn.size()) << c.name << ": a sample drawn twice";
    const oracle::SceneTruth scene(c, backend->contract(c));
    oracle::for_each_fragment(scene, [&](const Fragment& f, const TriangleTruth&) {
      const bool is_drawn =
          left.erase({f.place.triangle, f.place.x, f.place.y, f.place.sample}) > 0;
      if (f.decision.verdict == records::Verdict::required) {
        ++required;
        EXPECT_TRUE(is_drawn) << c.name << ": missing " << f.place.x << "," << f.place.y;
      }
      return true;
    });
    EXPECT_TRUE(left.empty()) << c.name << ": " << left.size() << " samples drawn and forbidden";
  }
  EXPECT_GT(required, 500U);
}

TEST(Cpu, OrdersItsFragmentsByTriangleRowColumnSample) {
  for (const cases::Case& c : corpus()) {
    const cases::Fragments drawn = make_backend("cpu").value()->draw(c).value().fragments;
    std::vector<std::tuple<int, int, int, int>> order;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      order.emplace_back(drawn.triangle[i], drawn.y[i], drawn.x[i], drawn.sample[i]);
    }
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end())) << c.name;
  }
}

TEST(Cpu, KeepsTheNearestFragmentUnderADepthTest) {
  cases::Case c = cases::read_case(RASTERCHECK_SOURCE_DIR "/cases/corpus/nearest.json").value();
  const cases::Fragments drawn = make_backend("cpu").value()->draw(c).value().fragments;
  const oracle::SceneTruth scene(c, cases::contract_of(c));
  const std::map<Place, std::size_t> places = by_place(drawn);
  std::size_t count = 0;
  oracle::for_each_fragment(scene, [&](const Fragment& f, const TriangleTruth&) {
    EXPECT_TRUE(places.contains({f.place.triangle, f.place.x, f.place.y, f.place.sample}));
    ++count;
    return true;
  });
  EXPECT_EQ(count, drawn.size());
}

TEST(Cpu, TracesWhatItDraws) {
  const cases::Case c =
      cases::read_case(RASTERCHECK_SOURCE_DIR "/cases/corpus/nearest.json").value();
  const auto backend = make_backend("cpu").value();
  ASSERT_NE(backend->tracer(), nullptr);
  const cases::Fragments drawn = backend->draw(c).value().fragments;
  ASSERT_GT(drawn.size(), 0U);
  const cases::SamplePlace at = drawn.place_of(0);
  const auto trace = backend->tracer()->trace(c, at).value();
  ASSERT_TRUE(trace.has_value());
  EXPECT_TRUE(trace->is_drawn);
  const cases::Triangle& corners = c.triangles[at.triangle];
  for (std::size_t i = 0; i < 3; ++i) {
    const cases::ClipVertex& p = c.positions[corners[i]];
    EXPECT_EQ(trace->positions[i], (std::array<float, 4>{p.x, p.y, p.z, p.w}));
  }
  EXPECT_FALSE(trace->corners || trace->snapped);
  EXPECT_TRUE(trace->frame && trace->lines && trace->edges);
  EXPECT_EQ(trace->decision, "in_double");
  EXPECT_EQ(trace->depth.value, drawn.depth[0]);
  EXPECT_TRUE(trace->depth.numerator_at && trace->depth.evaluated);
  ASSERT_EQ(trace->attributes.size(), drawn.attribute_count);
  for (std::size_t a = 0; a < drawn.attribute_count; ++a) {
    EXPECT_EQ(trace->attributes[a].value, drawn.attributes_of(0)[a]);
  }
}

TEST(Cpu, HasNoTraceOfWhatIsNotThere) {
  const cases::Case c =
      cases::read_case(RASTERCHECK_SOURCE_DIR "/cases/corpus/nearest.json").value();
  const auto backend = make_backend("cpu").value();
  const auto triangles = static_cast<std::uint32_t>(c.triangles.size());
  EXPECT_FALSE(backend->tracer()->trace(c, {triangles, 0, 0, 0}).has_value());
  const auto width = static_cast<std::uint32_t>(c.framebuffer.width);
  for (const cases::SamplePlace& at :
       {cases::SamplePlace{0, 0, width, 0}, {0, 0xffffffff, 0, 0}, {0, 0, 0, 16}}) {
    const auto trace = backend->tracer()->trace(c, at);
    ASSERT_TRUE(trace.has_value());
    EXPECT_FALSE(trace->has_value());
  }
}

TEST(Method, TracesWhatItDraws) {
  const cases::Case c =
      cases::read_case(RASTERCHECK_SOURCE_DIR "/cases/corpus/nearest.json").value();
  for (const char* specification : {"method:rational-linear", "method:q-matrix"}) {
    const auto backend = make_backend(specification).value();
    ASSERT_NE(backend->tracer(), nullptr);
    const cases::Fragments drawn = backend->draw(c).value().fragments;
    const cases::SamplePlace at = drawn.place_of(0);
    const auto trace = backend->tracer()->trace(c, at).value();
    ASSERT_TRUE(trace.has_value());
    EXPECT_TRUE(trace->is_drawn);
    EXPECT_EQ(trace->depth.value, drawn.depth[0]);
    ASSERT_EQ(trace->attributes.size(), drawn.attribute_count);
    EXPECT_EQ(trace->attributes[0].value, drawn.attributes_of(0)[0]);
    EXPECT_TRUE(trace->attributes[0].evaluated.has_value());
    EXPECT_FALSE(backend->tracer()->trace({}, {}).has_value());
  }
}

// Kills: leaving out the tiles of other threads, or drawing them over each other.
TEST(Cpu, DrawsTheSameOnSeveralThreads) {
  const auto one = make_backend("cpu:output=framebuffer").value();
  const auto several = make_backend("cpu:output=framebuffer,threads=3").value();
  std::size_t drawn = 0;
  for (cases::Case c : corpus()) {
    // Large enough for several tiles.
    c.framebuffer.width = 320;
    c.framebuffer.height = 200;
    c.viewport.width = 320;
    c.viewport.height = 200;
    for (const cases::DepthTest test : {cases::DepthTest::none, cases::DepthTest::less}) {
      c.depth_test = test;
      const cases::Fragments expected = one->draw(c).value().fragments;
      const cases::Fragments actual = several->draw(c).value().fragments;
      EXPECT_EQ(actual.triangle, expected.triangle) << c.name;
      EXPECT_EQ(actual.x, expected.x) << c.name;
      EXPECT_EQ(actual.y, expected.y) << c.name;
      EXPECT_EQ(actual.sample, expected.sample) << c.name;
      EXPECT_EQ(actual.depth, expected.depth) << c.name;
      EXPECT_EQ(actual.attributes, expected.attributes) << c.name;
      drawn += expected.size();
    }
  }
  EXPECT_GT(drawn, 100'000U);
}

// Kills: a depth buffer that begins with another value; comparing with it by "less or equal".
TEST(Cpu, DrawsWhatIsNearerThanTheBeginningOfTheDepthBuffer) {
  cases::Case c;
  c.framebuffer = {4, 4, 1};
  c.viewport = {0, 0, 4, 4, 0, 1};
  c.depth_test = cases::DepthTest::less;
  for (const float depth : {0.25F, 0.5F, 0.75F}) {
    const auto first = static_cast<std::uint32_t>(c.positions.size());
    c.positions.insert(c.positions.end(),
                       {{-1, -1, depth, 1}, {1, -1, depth, 1}, {-1, 1, depth, 1}});
    c.triangles.insert(c.triangles.begin(), {first, first + 1, first + 2});  // farthest first
  }
  for (const char* const name : {"cpu", "cpu:output=framebuffer"}) {
    const auto backend = make_backend(name).value();
    const auto drawn = [&](float clear_depth) {
      c.depth_clear = clear_depth;
      return backend->draw(c).value().fragments;
    };
    EXPECT_EQ(drawn(0.25F).size(), 0U) << name;
    for (const float clear_depth : {0.3F, 0.5F, 0.75F, 1.0F}) {
      EXPECT_EQ(drawn(clear_depth).depth, std::vector<float>(6, 0.25F)) << name;
    }
    c.depth_clear.reset();
    EXPECT_EQ(backend->draw(c).value().fragments.size(), 6U);
  }
}

// Kills: an occludee that is hidden by its own triangles, or by occluders at other samples; a depth
// that is compared by "less or equal" or with another clear depth.
TEST(Cpu, AnswersOcclusionQueries) {
  cases::Case c;
  c.framebuffer = {4, 4, 1};
  c.viewport = {0, 0, 4, 4, 0, 1};
  c.positions = {{-1, -1, 0.5F, 1},  {1, -1, 0.5F, 1},  {-1, 1, 0.5F, 1},   // six pixels
                 {-1, -1, 0.75F, 1}, {0, -1, 0.75F, 1}, {-1, 0, 0.75F, 1},  // one of them
                 {0, 0, 0.75F, 1},   {1, 0, 0.75F, 1},  {0, 1, 0.75F, 1}};  // another one
  c.triangles = {{0, 1, 2}, {3, 4, 5}};
  for (const char* const name : {"cpu", "cpu:output=framebuffer", "cpu:precision=float32"}) {
    const auto backend = make_backend(name).value();
    EXPECT_TRUE(backend->about().answers_occlusion_queries);
    ASSERT_NE(backend->occlusion_culler(), nullptr);
    const auto is_occluded = [&](std::size_t occluders) {
      return backend->occlusion_culler()->is_occluded(c, occluders).value();
    };
    c.triangles = {{0, 1, 2}, {3, 4, 5}};
    EXPECT_TRUE(is_occluded(1)) << name;
    EXPECT_FALSE(is_occluded(0)) << name;  // no occluder at all
    c.triangles = {{3, 4, 5}, {0, 1, 2}};
    EXPECT_FALSE(is_occluded(1)) << name;
    c.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
    EXPECT_FALSE(is_occluded(1)) << name;
    c.triangles = {{0, 1, 2}, {6, 7, 8}};
    EXPECT_FALSE(is_occluded(1)) << name;
    c.triangles = {{0, 1, 2}, {0, 1, 2}};
    EXPECT_TRUE(is_occluded(1)) << name;
    c.triangles = {{3, 4, 5}};
    c.depth_clear = 0.75F;
    EXPECT_TRUE(is_occluded(0)) << name;
    c.depth_clear = 0.875F;
    EXPECT_FALSE(is_occluded(0)) << name;
    c.depth_clear.reset();
  }
  EXPECT_EQ(make_backend("method:rational-linear").value()->occlusion_culler(), nullptr);
}

TEST(Cpu, SaysWhatItsOptionsAre) {
  for (const char* bad : {"threads=0", "threads=257", "threads=-1", "threads=2x", "threads=",
                          "output=framebuffer,threads=0", "simd", "simd=", "simd=mmx"}) {
    const auto backend = make_backend(std::string("cpu:") + bad);
    ASSERT_FALSE(backend) << bad;
    EXPECT_NE(to_string(backend.error()).find("unknown option"), std::string::npos) << bad;
  }
  const auto fragments = make_backend("cpu:threads=2");
  ASSERT_FALSE(fragments);
  EXPECT_EQ(to_string(fragments.error()),
            "cpu:threads=2: threads=N needs output=framebuffer; fragments are drawn on one thread");
  EXPECT_TRUE(make_backend("cpu:threads=2,output=framebuffer"));
}

// Whatever grid a case asks for.
TEST(Cpu, PromisesExactConservativeCoverage) {
  cases::Case c;
  c.coverage = cases::Snapping{4};
  const auto outer = make_backend("cpu:conservative=outer").value()->contract(c);
  EXPECT_EQ(outer.conservative, cases::Conservative{.covers_degenerates = true});
  EXPECT_EQ(outer.coverage, cases::Coverage());
  const auto inner = make_backend("cpu:conservative=inner,output=framebuffer").value();
  EXPECT_EQ(inner->contract(c).conservative,
            cases::Conservative{.kind = cases::ConservativeKind::inner});
  EXPECT_EQ(inner->tracer(), nullptr);
  EXPECT_FALSE(make_backend("cpu:conservative=both"));
}

// Every kind of vectors that this machine supports draws what `cpu` draws. The other kinds are
// listed with a reason.
TEST(Cpu, DrawsTheSameOnAllVectors) {
  std::size_t drawn = 0;
  int kinds = 0;
  for (const Listing& listing : BackendFactory().list()) {
    if (!listing.specification.starts_with("cpu:simd=")) continue;
    const auto made = make_backend(listing.specification);
    if (!listing.unavailable_because.empty()) {
      ASSERT_FALSE(made) << listing.specification;
      EXPECT_EQ(to_string(made.error()),
                listing.specification + ": " + listing.unavailable_because);
      continue;
    }
    ++kinds;
    ASSERT_TRUE(made) << listing.specification;
    for (const cases::Case& c : corpus()) {
      const cases::Fragments expected = make_backend("cpu").value()->draw(c).value().fragments;
      const cases::Fragments actual = (*made)->draw(c).value().fragments;
      EXPECT_EQ(actual.triangle, expected.triangle) << c.name << listing.specification;
      EXPECT_EQ(actual.x, expected.x) << c.name << listing.specification;
      EXPECT_EQ(actual.depth, expected.depth) << c.name << listing.specification;
      EXPECT_EQ(actual.attributes, expected.attributes) << c.name << listing.specification;
      drawn += actual.size();
    }
  }
  EXPECT_GT(kinds, 0);
  EXPECT_GT(drawn, 500U);
}

TEST(Cpu, NamesBackendsThatDrawTheSame) {
  for (const char* specification :
       {"cpu", "cpu:precision=float32", "cpu:output=framebuffer,threads=2"}) {
    const auto all = make_backend(specification).value()->about().same_as;
    EXPECT_GT(all.size(), 1U);
    const bool is_float = std::string(specification).ends_with("float32");
    for (const std::string& same : all) {
      EXPECT_TRUE(make_backend(same)) << same;
      EXPECT_EQ(same.find("float32") != std::string::npos, is_float) << same;
    }
  }
  EXPECT_TRUE(make_backend("method:rational-linear").value()->about().same_as.empty());
}

// Kills: reading a case's arrays before anything is checked.
TEST(Cpu, RefusesIndicesAndArraysThatDoNotFit) {
  const cases::Case good =
      cases::read_case(RASTERCHECK_SOURCE_DIR "/cases/corpus/nearest.json").value();
  for (const char* specification : {"cpu", "cpu:output=framebuffer"}) {
    const auto backend = make_backend(specification).value();
    cases::Case c = good;
    c.triangles[0][1] = 0xffffffff;
    EXPECT_FALSE(backend->draw(c)) << specification;
    EXPECT_FALSE(backend->tracer()->trace(c, {0, 1, 1, 0})) << specification;
    c = good;
    c.attributes.emplace_back();
    EXPECT_FALSE(backend->draw(c)) << specification;
    c = good;
    c.clip_distance_count = 2;
    EXPECT_FALSE(backend->draw(c)) << specification;
  }
}

TEST(Cpu, DrawsOverAPictureWhatAddsToIt) {
  const cases::Case c =
      cases::read_case(RASTERCHECK_SOURCE_DIR "/cases/corpus/nearest.json").value();
  const auto backend = make_backend("cpu").value();
  ASSERT_NE(backend->picture_drawer(), nullptr);
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::always;
  pipeline.blend = cases::Blend::additive;
  const cases::Picture once = backend->picture_drawer()->draw_picture(c, pipeline).value();
  cases::Picture twice = once;
  ASSERT_TRUE(backend->picture_continuer()->draw_over(c, pipeline, twice));
  ASSERT_EQ(twice.color.size(), once.color.size());
  float most = 0;
  for (std::size_t i = 0; i < once.color.size(); ++i) {
    EXPECT_NEAR(twice.color[i], 2 * once.color[i], std::abs(once.color[i]) * 1e-6);
    most = std::max(most, std::abs(once.color[i]));
  }
  EXPECT_GT(most, 0);
  EXPECT_EQ(twice.depth, once.depth);
  // As many samples, but another size.
  cases::Picture other = once;
  other.size = {16, 4, 1};
  EXPECT_FALSE(backend->picture_continuer()->draw_over(c, pipeline, other));
  pipeline.resolves = true;
  EXPECT_FALSE(backend->picture_continuer()->draw_over(c, pipeline, twice));
  EXPECT_EQ(make_backend("method:rational-linear").value()->picture_drawer(), nullptr);
}

TEST(Cpu, PromisesConstantsAndVertexValuesAndTheMethodsDoNot) {
  for (const char* specification : {"cpu", "cpu:precision=float32"}) {
    const cases::Contract contract = make_backend(specification).value()->contract({});
    EXPECT_TRUE(contract.keeps_constants) << specification;
    EXPECT_TRUE(contract.keeps_vertex_values) << specification;
  }
  const cases::Contract method = make_backend("method:rational-linear").value()->contract({});
  EXPECT_FALSE(method.keeps_constants);
  EXPECT_FALSE(method.keeps_vertex_values);
}

TEST(Cpu, TransformsByItsVertexStage) {
  std::size_t with_camera = 0;
  const auto backend = make_backend("cpu").value();
  ASSERT_NE(backend->vertex_stage(), nullptr);
  const float bound = backend->contract({}).transform_bound.value();
  const std::filesystem::path folder = RASTERCHECK_SOURCE_DIR "/cases/corpus";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    cases::Case c = cases::read_case(entry.path().string()).value();
    const auto clip = backend->vertex_stage()->transform(c);
    ASSERT_EQ(clip.has_value(), c.camera.has_value()) << c.name;
    if (!clip) {
      EXPECT_EQ(clip.error().reason, "the case has no camera");
      c.camera.emplace();
      EXPECT_EQ(backend->vertex_stage()->transform(c).value(), c.positions) << c.name;
      continue;
    }
    ++with_camera;
    ASSERT_EQ(clip->size(), c.positions.size());
    for (const oracle::JudgedPosition& position : oracle::judge_transform(c, *clip, bound)) {
      for (const oracle::JudgedNumber& one : position) {
        EXPECT_EQ(one.fragment_class, records::FragmentClass::correct) << c.name;
      }
    }
  }
  EXPECT_GT(with_camera, 0U);
}

// A matrix that is very different from its transpose, applied to positions with and without w = 1.
TEST(Cpu, ReadsMatricesRowByRow) {
  cases::Case c;
  c.camera.emplace();
  c.camera->projection = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  const auto backend = make_backend("cpu").value();
  c.positions = {{1, 2, 3, 1}};
  const cases::ClipVertex expected{18, 46, 74, 102};
  EXPECT_EQ(backend->vertex_stage()->transform(c).value().at(0), expected);
  c.positions.push_back({0, 0, 0, 2});
  EXPECT_EQ(backend->vertex_stage()->transform(c).value().at(0), expected);
  EXPECT_EQ(backend->vertex_stage()->transform(c).value().at(1),
            (cases::ClipVertex{8, 16, 24, 32}));
}

TEST(Cpu, DrawsStripsAndFansAsTheirTriangles) {
  for (const char* specification : {"cpu", "cpu:output=framebuffer"}) {
    const auto backend = make_backend(specification).value();
    for (const cases::Rules rules :
         {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
      expect_strips_and_fans(*backend, rules);
      expect_strips_of_lines(*backend, rules);
    }
  }
}

TEST(Method, NeitherTransformsNorAssembles) {
  const auto backend = make_backend("method:rational-linear").value();
  EXPECT_EQ(backend->vertex_stage(), nullptr);
  EXPECT_FALSE(backend->contract({}).transform_bound.has_value());
  EXPECT_EQ(backend->assembler(), nullptr);
}

}  // namespace
}  // namespace rastercheck::backends::cpu_test
