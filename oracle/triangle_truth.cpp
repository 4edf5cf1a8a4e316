#include "oracle/triangle_truth.h"

#include "oracle/internal/coverage.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/internal/value_bound.h"
#include "oracle/internal/value_errors.h"
#include "oracle/internal/values.h"

namespace rastercheck::oracle {
namespace {

std::optional<ValueRange> to_public(const std::optional<OpenValue>& value) {
  if (!value) return std::nullopt;
  return ValueRange{to_rational(value->range.lo.value()), to_rational(value->range.hi.value()),
                    value->is_open};
}

}  // namespace

SceneTruth::SceneTruth(cases::Case source, const cases::Contract& contract)
    : source_(std::move(source)),
      contract_(contract),
      scene_(std::make_unique<Scene>(source_, contract_)) {
  if (contract_.triangles.size() != source_.triangles.size()) contract_.triangles.clear();
}

SceneTruth::~SceneTruth() = default;

TriangleTruth::TriangleTruth(const SceneTruth& scene, std::size_t triangle)
    : setup_(std::make_unique<TriangleSetup>(scene.scene(), triangle)) {}

TriangleTruth::~TriangleTruth() = default;

PixelBox TriangleTruth::pixels() const { return setup_->pixels(); }

int TriangleTruth::orientation() const { return setup_->ideal.orientation(); }

std::optional<QMatrix> TriangleTruth::q_matrix() const {
  const ProjectiveMap& map = setup_->ideal;
  if (map.orientation() == 0) return std::nullopt;
  QMatrix q;
  for (std::size_t i = 0; i < 3; ++i) {
    const Line& e = map.edge(i);
    const auto divided = [&map](const Ring& n) {
      return to_rational(quotient(n, map.determinant()));
    };
    const Ring& per_pixel = setup_->scene->units_per_pixel();
    q[i] = {divided(e.a * per_pixel), divided(e.b * per_pixel), divided(e.c)};
  }
  return q;
}

std::optional<std::array<Rational, 3>> TriangleTruth::edges(int x, int y, int sample) const {
  const ProjectiveMap& map = setup_->ideal;
  if (map.orientation() == 0) return std::nullopt;
  const Point p = setup_->scene->sample_point(x, y, sample);
  std::array<Rational, 3> e;
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = to_rational(quotient(map.edge(i).at(p), map.determinant()));
  }
  return e;
}

bool TriangleTruth::has_certain_orientation() const { return setup_->has_certain_orientation(); }

records::SampleVerdict TriangleTruth::judge(int x, int y, int sample) const {
  return decide(*setup_, x, y, sample);
}

std::optional<records::Enclosure> TriangleTruth::distance(int x, int y, int sample) const {
  return boundary_distance(*setup_, setup_->scene->sample_point(x, y, sample));
}

std::optional<ValueRange> TriangleTruth::depth(int x, int y, int sample) const {
  return to_public(values().depth(x, y, sample));
}

std::optional<ValueRange> TriangleTruth::attribute(std::size_t attribute, int x, int y,
                                                   int sample) const {
  return to_public(values().attribute(attribute, x, y, sample));
}

bool TriangleTruth::is_value_free(std::optional<std::size_t> attribute) const {
  return why_free(*setup_, attribute).has_value();
}

const TriangleValues& TriangleTruth::values() const {
  if (!values_) values_ = std::make_unique<TriangleValues>(*setup_);
  return *values_;
}

const ValueErrors& TriangleTruth::errors() const {
  if (!errors_) errors_ = std::make_unique<ValueErrors>(*setup_, values());
  return *errors_;
}

Rational TriangleTruth::attribute_magnitude(std::size_t attribute) const {
  return to_rational(Field(values().vertex_magnitude(attribute)));
}

}  // namespace rastercheck::oracle
