#include "backends/internal/wire.h"

#include <gtest/gtest.h>

#include <limits>

namespace rastercheck::backends::wire_test {
namespace {

/// A case in which no member has its default value.
cases::Case full_case() {
  cases::Case c;
  c.name = "everything";
  c.framebuffer = {3, 5, 4};
  c.viewport = {1.5F, -2, 7, -8, 0.25F, 0.75F};
  c.rules = cases::Rules::d3d;
  c.coverage = cases::Snapping{4, cases::Rounding::half_up, 0.25F};
  c.basis = cases::Basis::unspecified;
  c.fill_rule = cases::TieRule::bottom_left;
  c.cull = cases::Cull::front;
  c.front_face = cases::FrontFace::cw;
  c.scissor = cases::Scissor{1, 2, 3, 4};
  c.depth_test = cases::DepthTest::less;
  c.depth_clear = 0.5F;
  c.depth_clamp = true;
  c.depth_bias = {1, -2, 0.5F};
  c.depth_format = cases::DepthFormat::unorm24;
  c.attributes = {{"u", cases::Interpolation::flat, cases::Location::centroid},
                  {"", cases::Interpolation::noperspective, cases::Location::center}};
  cases::Camera camera;
  camera.view[3] = 9;
  c.camera = camera;
  c.positions = {{1, 2, 3, 4}, {-0.0F, 6, 7, 8}};
  c.attribute_values = {1, 2, std::numeric_limits<float>::denorm_min(), 4};
  c.clip_distances = {5, 6, 7, 8};
  c.clip_distance_count = 2;
  c.triangles = {{0, 1, 0}, {1, 1, 0}};
  c.essential = {"scissor", "rules"};
  c.choices = 7;
  c.found = cases::Found{"law", "backend", "verdict", 7, 8, "depth", "tie"};
  return c;
}

cases::Contract full_contract() {
  cases::Contract contract;
  contract.coverage = cases::Snapping{4, cases::Rounding::floor, 0.5F, cases::Rounding::ceil, 3};
  contract.basis = cases::Basis::unspecified;
  contract.tie_rule = cases::TieRule::unspecified;
  contract.conservative = cases::Conservative{cases::ConservativeKind::inner, 0.5F, 0.25F,
                                              cases::ConservativeCorners::edges, true};
  contract.guard_band = 100;
  contract.guard_beyond_viewport = 7.0F;
  contract.culls_instead_of_clipping = true;
  contract.culls = cases::Winding::counter_clockwise;
  contract.least_area = 2;
  contract.sample_position = cases::PixelFraction{7, 3, 12};
  contract.is_on_grid = false;
  contract.clip_tolerance = 3;
  contract.clip_error = 0.5;
  contract.viewport_error = 0.25;
  contract.depth_format = cases::DepthFormat::unorm16;
  contract.depth_store = cases::DepthStore::either;
  contract.depth_bias = {cases::BiasSlope::between, cases::BiasUnit::open,
                         cases::BiasExponent::open};
  contract.depth_function = cases::KeptDepth::greater;
  contract.depth_error = cases::DepthError::never_farther;
  contract.claims = cases::Claim::affine;
  contract.bounds = {{1, 2, 3, 4, 13}, {5, 6, 7, 8, 14}, {9, 10, 11, 12, 15}};
  contract.keeps_equal_depth = true;
  contract.keeps_constants = true;
  contract.keeps_vertex_values = true;
  contract.keeps_sign_of_zero = false;
  contract.is_invariant = false;
  contract.derivative_bound = 1.0F;
  contract.transform_bound = 2.0F;
  contract.normal_bound = 3.0F;
  contract.quad_share = 4.0F;
  contract.texture_bounds = cases::TextureBounds{1, 2, 3, 4, 5};
  contract.picture_bounds = cases::PictureBounds{false, false, 1, 2, 3, 4, 5, 6};
  contract.numbers = {0.25F, 4};
  return contract;
}

cases::Fragments full_framebuffer() {
  return {2, {7, 8}, {1, 2}, {3, 4}, {5, 6}, {0.5F, 0.25F}, {1, 2, 3, 4}, {1, 2, 3, 4, 5, 6, 7, 8}};
}

bool are_same(const cases::Fragments& a, const cases::Fragments& b) {
  return a.attribute_count == b.attribute_count && a.triangle == b.triangle && a.x == b.x &&
         a.y == b.y && a.sample == b.sample && a.depth == b.depth && a.attributes == b.attributes &&
         a.derivatives == b.derivatives;
}

TEST(Wire, BringsEveryMemberOfACase) {
  for (const cases::Case& c : {full_case(), cases::Case()}) {
    const auto request = unpack_request(pack(Request{Question::promise, c}));
    ASSERT_TRUE(request);
    EXPECT_EQ(request->question, Question::promise);
    EXPECT_EQ(request->source, c);
  }
}

TEST(Wire, BringsOcclusionQueriesAndAnswers) {
  cases::Case c = full_case();
  const auto triangles = static_cast<std::uint64_t>(c.triangles.size());
  const Request query{Question::occlusion, c, std::nullopt, triangles - 1};
  const auto request = unpack_request(pack(query));
  ASSERT_TRUE(request);
  EXPECT_EQ(request->question, Question::occlusion);
  EXPECT_EQ(request->source, c);
  EXPECT_EQ(request->occluders, triangles - 1);
  // A query about no triangle.
  EXPECT_FALSE(unpack_request(pack(Request{Question::occlusion, c, std::nullopt, triangles})));
  EXPECT_TRUE(unpack_request(pack(Request{Question::drawing, c, std::nullopt, triangles})));

  for (const bool is_occluded : {false, true}) {
    const auto answer = unpack_occlusion(pack(OcclusionAnswer{is_occluded, std::nullopt}));
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->is_occluded, is_occluded);
    EXPECT_FALSE(answer->problem);
  }
  const auto failed = unpack_occlusion(pack(OcclusionAnswer{false, Error{"a", "b", "c"}}));
  ASSERT_TRUE(failed && failed->problem);
  EXPECT_EQ(to_string(*failed->problem), "a: b: c");
  EXPECT_FALSE(unpack_occlusion(std::string(2, '\2')));
}

TEST(Wire, BringsPipelinesAndPictures) {
  cases::Pipeline pipeline;
  pipeline.depth_function = cases::DepthFunction::greater_or_equal;
  pipeline.writes_depth = false;
  pipeline.clear_depth = 0.25F;
  pipeline.blend = cases::Blend::additive;
  pipeline.format = cases::ColorFormat::rgba8;
  pipeline.shading = cases::Shading::window_coordinates;
  pipeline.texturing = cases::Texturing{{1, 2, {1, 2, 3, 4, 5, 6, 7, 8}},
                                        cases::Wrap::mirror,
                                        cases::Wrap::clamp,
                                        cases::Filter::trilinear};
  pipeline.discard_below = 0.5F;
  pipeline.resolves = true;
  const auto request = unpack_request(
      pack(Request{.question = Question::picture, .source = full_case(), .pipeline = pipeline}));
  ASSERT_TRUE(request);
  EXPECT_EQ(request->question, Question::picture);
  EXPECT_EQ(request->pipeline, pipeline);

  const cases::Picture picture{{2, 1, 1}, 1, {0.5F, -0.0F}, {1, 0.25F}};
  const auto answer = unpack_picture(pack(PictureAnswer{picture}));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->picture.size, picture.size);
  EXPECT_EQ(answer->picture.channels, picture.channels);
  EXPECT_EQ(answer->picture.color, picture.color);
  EXPECT_EQ(answer->picture.depth, picture.depth);
  EXPECT_FALSE(answer->problem);
}

TEST(Wire, BringsEveryMemberOfAContract) {
  for (const cases::Contract& contract : {full_contract(), cases::Contract()}) {
    EXPECT_EQ(unpack_contract(pack(contract)), contract);
  }
}

TEST(Wire, BringsDrawingsAndErrors) {
  const auto drawing =
      unpack_drawing(pack(DrawingAnswer{{full_contract(), full_framebuffer()}, std::nullopt}));
  ASSERT_TRUE(drawing);
  EXPECT_EQ(drawing->drawn.contract, full_contract());
  EXPECT_TRUE(are_same(drawing->drawn.fragments, full_framebuffer()));
  EXPECT_FALSE(drawing->problem);

  const auto failed =
      unpack_drawing(pack(DrawingAnswer{{}, Error{"a", "b", "c", Failure::unsupported}}));
  ASSERT_TRUE(failed && failed->problem);
  EXPECT_EQ(to_string(*failed->problem), "a: b: c");
  EXPECT_EQ(failed->problem->failure, Failure::unsupported);

  cases::Capabilities capabilities;
  capabilities.rules = {cases::Rules::vulkan};
  capabilities.sample_counts = {1, 4};
  capabilities.lacks = {cases::Feature::centroid};
  capabilities.max_size = 64;
  capabilities.max_viewport = 65;
  capabilities.max_attributes = 5;
  capabilities.max_clip_distances = 6;
  capabilities.numbers = {0.5F, 2};
  const About about{.description = "who",
                    .driver = Driver{"what", "1.0"},
                    .api = ApiLimits{8, true, 3},
                    .has_limits = true,
                    .capabilities = capabilities,
                    .same_as = {"another", "and another"},
                    .answers_occlusion_queries = true,
                    .draws_pictures = true};
  const auto greeting = unpack_greeting(pack(Greeting{about, std::nullopt}));
  ASSERT_TRUE(greeting);
  EXPECT_EQ(greeting->about, about);
}

// Kills: a reader that trusts lengths, or takes a part for the whole.
TEST(Wire, RefusesEveryPart) {
  const std::string request = pack(Request{Question::drawing, full_case()});
  for (std::size_t size = 0; size < request.size(); ++size) {
    EXPECT_FALSE(unpack_request(request.substr(0, size))) << size;
  }
  EXPECT_FALSE(unpack_request(request + '\0'));
  const std::string drawing =
      pack(DrawingAnswer{{full_contract(), full_framebuffer()}, std::nullopt});
  for (std::size_t size = 0; size < drawing.size(); ++size) {
    EXPECT_FALSE(unpack_drawing(drawing.substr(0, size))) << size;
  }
}

// Sets each byte to 255 in turn. 36 of the refused bytes are flags and enumerators: whether there
// is a coverage, its roundings and whether there are two, basis, tie rule, grid, claim, what is
// culled and whether instead of clipping, depth format, how depths are stored, three of the bias,
// depth function, side of depths, five promises, two of pictures, whether each of six optional
// bounds, a guard band about the viewport and a sample position exist; whether coverage is
// conservative, its kind, its corners, and whether triangles without area are covered. Four are the
// bytes of subpixel_bits, three of odd_steps (255 is possible), 11 of the sample position (in 255
// parts, it is possible). 41 are the last bytes of numbers, which become negative: position error,
// error and growth of conservative coverage, two guard bands, least area, clip tolerance, clip
// error, viewport error, 15 numbers of bounds, four optional bounds, five numbers for textures, six
// for pictures, and two magnitudes. Eight are the bytes of the number of per-triangle promises.
TEST(Wire, RefusesWhatNoContractSays) {
  const std::string contract = pack(full_contract());
  int refused = 0;
  for (std::size_t i = 0; i < contract.size(); ++i) {
    std::string broken = contract;
    broken[i] = '\xff';
    if (!unpack_contract(broken)) ++refused;
  }
  EXPECT_EQ(refused, 36 + 4 + 3 + 11 + 41 + 8);
}

// Kills: a comparison that is true for NaN.
TEST(Wire, RefusesContractsOfNoNumbers) {
  constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
  cases::Contract contract = full_contract();
  contract.bounds.depth.constant = kNoNumber;
  EXPECT_FALSE(unpack_contract(pack(contract)));
  contract = full_contract();
  contract.coverage->position_error = kNoNumber;
  EXPECT_FALSE(unpack_contract(pack(contract)));
  contract = full_contract();
  contract.coverage->subpixel_bits = 1000;
  EXPECT_FALSE(unpack_contract(pack(contract)));
  contract = full_contract();
  contract.conservative->error = kNoNumber;
  EXPECT_FALSE(unpack_contract(pack(contract)));
  contract.conservative->error = 2 * cases::kMaxConservativeReach;
  EXPECT_FALSE(unpack_contract(pack(contract)));
  // The vertices that clipping makes may be anywhere.
  contract = full_contract();
  contract.clip_tolerance = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(unpack_contract(pack(contract)));
}

}  // namespace
}  // namespace rastercheck::backends::wire_test
