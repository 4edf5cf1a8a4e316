// Identities of the projective map that hold for every triangle (RULES §1, §2).

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "oracle/internal/camera_form.h"
#include "oracle/internal/projective_map.h"
#include "oracle/internal/rational_number.h"
#include "oracle/triangle_truth.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::identities_test {
namespace {

Ring ring(float value) { return {double{value}}; }

RingVector3 random_column() {
  const float x = random_float(8);
  const float y = random_float(8);
  const float w = random_float(8);
  return {ring(x), ring(y), ring(w)};
}

std::array<RingVector3, 3> random_columns() {
  const RingVector3 first = random_column();
  const RingVector3 second = random_column();
  const RingVector3 third = random_column();
  return {first, second, third};
}

/// The value of a functional at a homogeneous point.
Ring at(const Line& line, const RingVector3& p) {
  return line.a * p[0] + line.b * p[1] + line.c * p[2];
}

RC_GTEST_PROP(ProjectiveMap, WeightsTimesWSumToOneEverywhere, ()) {
  const auto columns = random_columns();
  const ProjectiveMap map(columns);
  const Line sum = map.combine({columns[0][2], columns[1][2], columns[2][2]});
  RC_ASSERT(sum.is_constant());
  RC_ASSERT(sum.c == map.determinant());
}

RC_GTEST_PROP(ProjectiveMap, EachWeightIsOneAtItsVertexAndZeroAtTheOthers, ()) {
  const auto columns = random_columns();
  const ProjectiveMap map(columns);
  RC_PRE(map.orientation() != 0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      RC_ASSERT(at(map.edge(i), columns[j]) == (i == j ? map.determinant() : Ring(0)));
    }
  }
}

RC_GTEST_PROP(ProjectiveMap, AnAttributeTakesItsVertexValues, ()) {
  const auto columns = random_columns();
  const float r0 = random_float(4);
  const float r1 = random_float(4);
  const float r2 = random_float(4);
  const std::array<Ring, 3> r{ring(r0), ring(r1), ring(r2)};
  const ProjectiveMap map(columns);
  RC_PRE(map.orientation() != 0);
  const Line numerator = map.combine(r);
  for (std::size_t i = 0; i < 3; ++i) {
    RC_ASSERT(at(numerator, columns[i]) == r[i] * at(map.inverse_w(), columns[i]));
  }
}

RC_GTEST_PROP(ProjectiveMap, SwappingTwoVerticesTurnsTheOrientationAndKeepsTheWeights, ()) {
  const auto columns = random_columns();
  const ProjectiveMap map(columns);
  const ProjectiveMap swapped({columns[1], columns[0], columns[2]});
  RC_ASSERT(swapped.orientation() == -map.orientation());
  RC_PRE(map.orientation() != 0);
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 0), std::pair(2, 2)}) {
    const Line& e = map.edge(static_cast<std::size_t>(i));
    const Line& f = swapped.edge(static_cast<std::size_t>(j));
    RC_ASSERT((e.a == f.a && e.b == f.b && e.c == f.c));
  }
}

/// The exact values of two smooth attributes, r and w, at samples along a row of a small triangle.
struct Row {
  std::vector<Field> r;
  std::vector<Field> w;
};

Row covered_row(const cases::Case& c) {
  const SceneTruth scene(c, cases::contract_of(c));
  const TriangleTruth truth(scene, 0);
  Row row;
  for (int x = 0; x < c.framebuffer.width; ++x) {
    if (truth.judge(x, 2, 0).verdict != records::Verdict::required) continue;
    row.r.push_back(to_field(truth.attribute(0, x, 2, 0)->lo));
    row.w.push_back(to_field(truth.attribute(1, x, 2, 0)->lo));
  }
  return row;
}

RC_GTEST_PROP(Interpolation, OneOverWAndROverWAreScreenAffine, ()) {
  const float w0 = std::abs(grid_float(4)) + 0.5F;
  const float w1 = std::abs(grid_float(4)) + 0.5F;
  const float w2 = std::abs(grid_float(4)) + 0.5F;
  const float r0 = random_float(4);
  const float r1 = random_float(4);
  const float r2 = random_float(4);
  // The attribute w takes the value w(p): Σ e_i w_i = 1, so Σ e_i w_i / Σ e_i = 1/D.
  const cases::Case c = small_case(
      cases::Rules::vulkan, 8, 8, {{{-w0, -w0, 0, w0}, {3 * w1, -w1, 0, w1}, {-w2, 3 * w2, 0, w2}}},
      {{{r0, w0}, {r1, w1}, {r2, w2}}});
  const Row row = covered_row(c);
  RC_ASSERT(row.r.size() == 8U);
  for (std::size_t i = 2; i < row.r.size(); ++i) {
    const auto affine = [&](auto&& f) { return f(i) - f(i - 1) == f(i - 1) - f(i - 2); };
    RC_ASSERT(affine([&](std::size_t k) { return Field(Field(1) / row.w[k]); }));
    RC_ASSERT(affine([&](std::size_t k) { return Field(row.r[k] / row.w[k]); }));
  }
}

RC_GTEST_PROP(CameraForm, IsTheClipFormWhereTheImagePlaneInvertsTheProjection, ()) {
  // A camera: the rows of a matrix that takes V − C to (X, Y, w).
  FieldMatrix3 projection;
  for (Eigen::Index i = 0; i < 9; ++i) projection(i / 3, i % 3) = Field(double{grid_float(2)});
  const Field determinant = projection.determinant();
  RC_PRE(sign_of(determinant) != 0);
  std::array<FieldVector3, 3> vertices;
  for (FieldVector3& v : vertices) {
    for (Eigen::Index i = 0; i < 3; ++i) v[i] = Field(double{grid_float(4)});
  }
  FieldVector3 eye;
  for (Eigen::Index i = 0; i < 3; ++i) eye[i] = Field(double{grid_float(4)});

  // The columns of the inverse, by cofactors: each column is orthogonal to two rows.
  const FieldVector3 rows[3] = {projection.row(0), projection.row(1), projection.row(2)};
  const ImagePlane plane{eye, rows[1].cross(rows[2]) / determinant,
                         rows[2].cross(rows[0]) / determinant,
                         rows[0].cross(rows[1]) / determinant};
  const std::optional<FieldMatrix3> camera_form = q_matrix(vertices, plane);
  std::array<FieldVector3, 3> clip;
  for (std::size_t i = 0; i < 3; ++i) clip[i] = projection * (vertices[i] - eye);
  const ImagePlane identity{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::optional<FieldMatrix3> clip_form = q_matrix(clip, identity);
  RC_ASSERT(camera_form.has_value() == clip_form.has_value());
  RC_PRE(camera_form.has_value());
  RC_ASSERT(*camera_form == *clip_form);
}

/// Points around a hub, counter-clockwise by construction: their directions have growing angles.
std::vector<cases::ClipVertex> random_rim(float hub_x, float hub_y) {
  // Twelve directions. Consecutive angles stay below 180 degrees even if some directions are left
  // out.
  constexpr std::array<std::pair<int, int>, 12> kDirections{{{4, 0},
                                                             {4, 1},
                                                             {3, 3},
                                                             {1, 4},
                                                             {0, 4},
                                                             {-3, 4},
                                                             {-4, 0},
                                                             {-4, -1},
                                                             {-2, -4},
                                                             {0, -4},
                                                             {3, -4},
                                                             {4, -2}}};
  std::vector<cases::ClipVertex> rim;
  for (std::size_t i = 0; i < kDirections.size(); ++i) {
    const bool is_kept = i % 4 == 0 || *rc::gen::inRange(0, 2) == 0;
    if (!is_kept) continue;
    const int length = *rc::gen::inRange(1, 17);
    const float w = static_cast<float>(*rc::gen::inRange(1, 9)) / 4;
    const float x = hub_x + static_cast<float>(kDirections[i].first * length) / 64;
    const float y = hub_y + static_cast<float>(kDirections[i].second * length) / 64;
    rim.push_back({x * w, y * w, 0, w});
  }
  return rim;
}

RC_GTEST_PROP(Coverage, AFanCoversItsHubOnceAndNoSampleTwice, ()) {
  // The hub lies exactly on the sample of pixel (3, 4): window 3.5 of 8 is NDC −1/8, and 4.5 is
  // 1/8.
  const std::vector<cases::ClipVertex> rim = random_rim(-0.125F, 0.125F);
  const auto rules = one_of({cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d});
  cases::Case c = small_case(rules, 8, 8, {});
  c.fill_rule = one_of({cases::TieRule::top_left, cases::TieRule::bottom_left});
  if (rules == cases::Rules::d3d) c.framebuffer.samples = 1;
  const float hub_w = static_cast<float>(*rc::gen::inRange(1, 9)) / 4;
  const float hub_y = rules == cases::Rules::d3d ? -0.125F : 0.125F;
  c.positions = {{-0.125F * hub_w, hub_y * hub_w, 0, hub_w}};
  for (cases::ClipVertex v : rim) {
    if (rules == cases::Rules::d3d) v.y = -v.y;
    c.positions.push_back(v);
  }
  c.triangles.clear();
  const auto count = static_cast<std::uint32_t>(rim.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    c.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }

  const SceneTruth scene(c, cases::contract_of(c));
  std::array<std::array<int, 8>, 8> covered{};
  for (std::size_t t = 0; t < c.triangles.size(); ++t) {
    const TriangleTruth truth(scene, t);
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const bool drawn = truth.judge(x, y, 0).verdict == records::Verdict::required;
        covered[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] += drawn ? 1 : 0;
      }
    }
  }
  RC_ASSERT(covered[4][3] == 1);
  for (const auto& row : covered) {
    for (const int times : row) RC_ASSERT(times <= 1);
  }
}

RC_GTEST_PROP(Coverage, ASquareSplitByADiagonalIsCoveredOnce, ()) {
  // Heckbert & Moreton 1991's quadrilateral as two triangles: every edge runs through samples, and
  // w is random.
  const auto rules = one_of({cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d});
  cases::Case c = small_case(rules, 8, 8, {});
  c.fill_rule = one_of({cases::TieRule::top_left, cases::TieRule::bottom_left});
  c.positions.clear();
  const std::array<std::pair<float, float>, 4> corners{
      {{-0.625F, -0.625F}, {0.625F, -0.625F}, {0.625F, 0.625F}, {-0.625F, 0.625F}}};
  for (const auto& [x, y] : corners) {
    const float w = static_cast<float>(*rc::gen::inRange(1, 9)) / 4;
    c.positions.push_back({x * w, y * w, 0, w});
  }
  c.triangles = {{0, 1, 2}, {2, 3, 0}};
  if (*rc::gen::inRange(0, 2) == 0) c.triangles = {{3, 1, 0}, {1, 3, 2}};

  const SceneTruth scene(c, cases::contract_of(c));
  int covered = 0;
  for (std::size_t t = 0; t < 2; ++t) {
    const TriangleTruth truth(scene, t);
    for (int i = 0; i < 64; ++i) {
      covered += truth.judge(i % 8, i / 8, 0).verdict == records::Verdict::required ? 1 : 0;
    }
  }
  // The square spans window 1.5 … 6.5: its sides pass six rows and six columns of samples, and five
  // of each are inside.
  RC_ASSERT(covered == 25);
}

}  // namespace
}  // namespace rastercheck::oracle::identities_test
