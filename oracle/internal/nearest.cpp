#include "oracle/internal/nearest.h"

#include <algorithm>

#include "oracle/internal/coverage_row.h"
#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/ulp.h"

namespace rastercheck::oracle {
namespace {

using records::Reason;
using records::Verdict;

struct Covering {
  std::uint32_t triangle = 0;
  records::SampleVerdict decision;
  /// The depths that a backend may compute; nothing where the rules leave it undefined.
  std::optional<FieldRange> depth;
};

bool is_surely_nearer(const Covering& a, const Covering& b) {
  return a.depth && b.depth && a.depth->hi < b.depth->lo;
}

/// The most that a computed depth may be off, in depth.
Field depth_slack(const Scene& scene) {
  const Field largest(std::max(scene.least_depth(), scene.greatest_depth()));
  const Rational unit = ulp(to_rational(largest));
  return exact_field(scene.contract().bounds.depth.constant) * to_field(unit);
}

NearestAnswer resolve(const std::vector<Covering>& all) {
  NearestAnswer answer;
  for (const Covering& a : all) {
    const auto is_required = [](const Covering& b) {
      return b.decision.verdict == Verdict::required;
    };
    const bool is_beaten = std::any_of(all.begin(), all.end(), [&](const Covering& b) {
      return &b != &a && is_required(b) && is_surely_nearer(b, a);
    });
    answer.is_required = answer.is_required || is_required(a);
    if (is_beaten) continue;
    const bool beats_all = std::all_of(all.begin(), all.end(), [&a](const Covering& b) {
      return &b == &a || is_surely_nearer(a, b);
    });
    answer.candidates.push_back({a.triangle, a.decision});
    if (!beats_all && is_required(a)) {
      answer.candidates.back().decision = {Verdict::permitted, Reason::depth};
    }
  }
  return answer;
}

}  // namespace

const PreparedTriangles::Prepared& PreparedTriangles::of(std::uint32_t triangle) {
  Prepared& prepared = prepared_[triangle];
  if (!prepared.truth) {
    auto truth = std::make_shared<const TriangleTruth>(*scene_, triangle);
    prepared.filter =
        std::make_unique<TriangleFilter>(truth->setup(), truth->setup().pixels(), first_level_);
    prepared.truth = std::move(truth);
  }
  return prepared;
}

NearestAnswers::NearestAnswers(const SceneTruth& scene) : scene_(&scene) {
  rows_.reserve(scene.source().triangles.size());
  for (std::size_t t = 0; t < scene.source().triangles.size(); ++t) {
    const Pixels pixels = TriangleTruth(scene, t).pixels();
    rows_.emplace_back(pixels.y0, pixels.x0 < pixels.x1 ? pixels.y1 : pixels.y0);
  }
}

NearestAnswers::Answers NearestAnswers::in_rows(int y0, int y1, PreparedTriangles& triangles,
                                                records::LevelCounts& levels) const {
  const Field slack = depth_slack(scene_->scene());
  std::map<std::tuple<int, int, int>, std::vector<Covering>> coverings;
  CoverageRow row;
  for (std::uint32_t t = 0; t < rows_.size(); ++t) {
    const int first = std::max(y0, rows_[t].first);
    const int last = std::min(y1, rows_[t].second);
    if (first >= last) continue;
    const PreparedTriangles::Prepared& triangle = triangles.of(t);
    if (triangle.filter->is_empty()) continue;
    for (int y = first; y < last; ++y) {
      row.classify(*triangle.truth, *triangle.filter, y, levels);
      row.for_each_covered([&](int x, int s, const records::SampleVerdict& decision) {
        Covering covering{t, decision, std::nullopt};
        if (const std::optional<ValueRange> depth = triangle.truth->depth(x, y, s)) {
          covering.depth = {to_field(depth->lo) - slack, to_field(depth->hi) + slack};
        }
        coverings[{y, x, s}].push_back(std::move(covering));
      });
    }
  }
  Answers answers;
  for (const auto& [place, all] : coverings) answers.emplace(place, resolve(all));
  return answers;
}

}  // namespace rastercheck::oracle
