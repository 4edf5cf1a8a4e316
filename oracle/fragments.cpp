#include "oracle/fragments.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace rastercheck::oracle {
namespace {

/// Visits every fragment, each triangle as if drawn alone.
template <typename Sink>
void for_each_alone(const SceneTruth& scene, const Sink& sink) {
  const int samples = scene.source().framebuffer.samples;
  for (std::size_t t = 0; t < scene.source().triangles.size(); ++t) {
    const TriangleTruth truth(scene, t);
    const PixelBox pixels = truth.pixels();
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      for (int x = pixels.x0; x < pixels.x1; ++x) {
        for (int s = 0; s < samples; ++s) {
          const records::SampleVerdict decision = truth.judge(x, y, s);
          if (decision.verdict == records::Verdict::forbidden) continue;
          if (!sink(fragment_at(scene, truth, t, x, y, s, decision), truth)) return;
        }
      }
    }
  }
}

/// True if `a` is nearer than `b` for all depths that the rules allow. Of two equally deep
/// fragments, the first drawn counts as nearer.
bool surely_nearer(const Fragment& a, const Fragment& b) {
  if (!a.depth || !b.depth) return false;
  const auto order = a.depth->hi <=> b.depth->lo;
  return order < 0 || (order == 0 && a.place.triangle < b.place.triangle);
}

/// Drops the fragments of one sample that cannot be the nearest, and turns `required` into
/// `permitted` for those that might not be. `clear_depth` is the depth buffer's initial value; if
/// empty, that value is unknown but at least 1.
void resolve(const std::vector<Fragment*>& fragments, std::optional<float> clear_depth,
             std::vector<const Fragment*>& dropped) {
  const Rational clear(double{clear_depth.value_or(1)});
  std::vector<Fragment*> undecided;
  for (Fragment* a : fragments) {
    if (clear_depth && a->depth && a->depth->lo >= clear) {
      dropped.push_back(a);
      continue;
    }
    const bool beaten = std::any_of(fragments.begin(), fragments.end(), [a](const Fragment* b) {
      return b != a && b->decision.verdict == records::Verdict::required && surely_nearer(*b, *a);
    });
    if (beaten) {
      dropped.push_back(a);
      continue;
    }
    const bool beats_all = std::all_of(fragments.begin(), fragments.end(), [a](const Fragment* b) {
      return b == a || surely_nearer(*a, *b);
    });
    const bool is_drawn = a->depth && a->depth->hi < clear;
    if (!is_drawn || !beats_all) undecided.push_back(a);
  }
  for (Fragment* a : undecided) {
    if (a->decision.verdict != records::Verdict::required) continue;
    a->decision = {records::Verdict::permitted, records::Reason::depth};
  }
}

}  // namespace

Fragment fragment_at(const SceneTruth& scene, const TriangleTruth& truth, std::size_t triangle,
                     int x, int y, int sample, const records::SampleVerdict& decision) {
  const cases::SamplePlace place{static_cast<std::uint32_t>(triangle),
                                 static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x),
                                 static_cast<std::uint32_t>(sample)};
  Fragment fragment{place, decision, truth.depth(x, y, sample), {}};
  const std::size_t count = scene.source().attributes.size();
  fragment.attributes.reserve(count);
  for (std::size_t a = 0; a < count; ++a) {
    fragment.attributes.push_back(truth.attribute(a, x, y, sample));
  }
  return fragment;
}

void for_each_fragment(const SceneTruth& scene,
                       const std::function<bool(const Fragment&, const TriangleTruth&)>& sink) {
  if (scene.source().depth_test == cases::DepthTest::none) return for_each_alone(scene, sink);

  std::vector<Fragment> all;
  for_each_alone(scene, [&all](const Fragment& fragment, const TriangleTruth&) {
    all.push_back(fragment);
    return true;
  });
  std::map<std::tuple<int, int, int>, std::vector<Fragment*>> by_sample;
  for (Fragment& f : all) by_sample[{f.place.y, f.place.x, f.place.sample}].push_back(&f);
  std::vector<const Fragment*> dropped;
  for (auto& [place, fragments] : by_sample)
    resolve(fragments, scene.source().depth_clear, dropped);
  std::sort(dropped.begin(), dropped.end());

  std::optional<TriangleTruth> truth;
  std::optional<std::size_t> prepared;
  for (const Fragment& fragment : all) {
    if (std::binary_search(dropped.begin(), dropped.end(), &fragment)) continue;
    if (prepared != fragment.place.triangle) {
      truth.emplace(scene, fragment.place.triangle);
      prepared = fragment.place.triangle;
    }
    if (!sink(fragment, *truth)) return;
  }
}

}  // namespace rastercheck::oracle
