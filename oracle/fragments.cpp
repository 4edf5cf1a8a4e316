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
/// fragments, the one that stays counts as nearer.
bool surely_nearer(const Fragment& a, const Fragment& b, const cases::Contract& contract) {
  if (!a.depth || !b.depth) return false;
  const auto order =
      contract.is_depth_reversed() ? b.depth->hi <=> a.depth->lo : a.depth->hi <=> b.depth->lo;
  const bool is_first = a.place.triangle < b.place.triangle;
  return order < 0 || (order == 0 && is_first != contract.keeps_last_of_equals());
}

/// True if a fragment of this depth certainly passes the depth test (`is_sure`), or may pass it,
/// against the depth buffer's initial value.
bool passes(const ValueRange& depth, const Rational& clear, const cases::Contract& contract,
            bool is_sure) {
  const bool is_reversed = contract.is_depth_reversed();
  const Rational& far_end = is_reversed ? depth.lo : depth.hi;
  const Rational& near_end = is_reversed ? depth.hi : depth.lo;
  const auto order = is_reversed ? clear <=> (is_sure ? far_end : near_end)
                                 : (is_sure ? far_end : near_end) <=> clear;
  return order < 0 || (order == 0 && contract.keeps_last_of_equals());
}

/// Drops the fragments of one sample that cannot be the nearest, and turns `required` into
/// `permitted` for those that might not be. `clear_depth` is the depth buffer's initial value; if
/// empty, that value is unknown, and no nearer than any depth.
void resolve(const std::vector<Fragment*>& fragments, std::optional<float> clear_depth,
             const cases::Contract& contract, std::vector<const Fragment*>& dropped) {
  const Rational clear(double{contract.depth_beginning(clear_depth)});
  std::vector<Fragment*> undecided;
  for (Fragment* a : fragments) {
    if (clear_depth && a->depth && !passes(*a->depth, clear, contract, false)) {
      dropped.push_back(a);
      continue;
    }
    const bool beaten = std::any_of(fragments.begin(), fragments.end(), [&](const Fragment* b) {
      return b != a && b->decision.verdict == records::Verdict::required &&
             surely_nearer(*b, *a, contract);
    });
    if (beaten) {
      dropped.push_back(a);
      continue;
    }
    const bool beats_all = std::all_of(fragments.begin(), fragments.end(), [&](const Fragment* b) {
      return b == a || surely_nearer(*a, *b, contract);
    });
    const bool is_drawn = a->depth && passes(*a->depth, clear, contract, true);
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
    resolve(fragments, scene.source().depth_clear, scene.contract(), dropped);
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
