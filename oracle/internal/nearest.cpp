#include "oracle/internal/nearest.h"

#include <algorithm>

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

std::map<std::tuple<int, int, int>, NearestAnswer> nearest_answers(const SceneTruth& scene) {
  const Field slack = depth_slack(scene.scene());
  std::map<std::tuple<int, int, int>, std::vector<Covering>> coverings;
  for (std::uint32_t t = 0; t < scene.source().triangles.size(); ++t) {
    const TriangleTruth truth(scene, t);
    const Pixels pixels = truth.pixels();
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      for (int x = pixels.x0; x < pixels.x1; ++x) {
        for (int s = 0; s < scene.source().framebuffer.samples; ++s) {
          const records::SampleVerdict decision = truth.judge(x, y, s);
          if (decision.verdict == Verdict::forbidden) continue;
          Covering covering{t, decision, std::nullopt};
          if (const std::optional<ValueRange> depth = truth.depth(x, y, s)) {
            covering.depth = {to_field(depth->lo) - slack, to_field(depth->hi) + slack};
          }
          coverings[{y, x, s}].push_back(std::move(covering));
        }
      }
    }
  }
  std::map<std::tuple<int, int, int>, NearestAnswer> answers;
  for (const auto& [place, all] : coverings) answers.emplace(place, resolve(all));
  return answers;
}

}  // namespace rastercheck::oracle
