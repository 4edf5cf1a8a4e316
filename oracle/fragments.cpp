#include "oracle/fragments.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "oracle/internal/rational_number.h"
#include "oracle/internal/scene.h"
#include "oracle/internal/stored_depth.h"

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

/// A fragment of a sample, and the depths that a depth test compares for it: those of its range or,
/// in a unorm format, the numbers that these are stored as.
struct Contender {
  Fragment* fragment = nullptr;
  std::optional<ValueRange> depth;
};

ValueRange compared(const SceneTruth& scene, const ValueRange& depth) {
  const int bits = scene.scene().unorm_bits();
  if (bits == 0) return depth;
  const StoredRange stored =
      stored_range(to_field(depth.lo), to_field(depth.hi), bits, scene.contract().depth_store);
  return {Rational(stored.least), Rational(stored.greatest), depth.is_open};
}

/// True if `a` is nearer than `b` for all depths that the rules allow. Of two equally deep
/// fragments, the one that stays counts as nearer.
bool surely_nearer(const Contender& a, const Contender& b, const cases::Contract& contract) {
  if (!a.depth || !b.depth) return false;
  const auto order =
      contract.is_depth_reversed() ? b.depth->hi <=> a.depth->lo : a.depth->hi <=> b.depth->lo;
  const bool is_first = a.fragment->place.triangle < b.fragment->place.triangle;
  return order < 0 || (order == 0 && is_first != contract.keeps_last_of_equals());
}

/// True if a fragment of this depth certainly passes the depth test (`is_sure`), or may pass it,
/// against the depth buffer's initial value.
bool passes(const ValueRange& depth, const ValueRange& clear, const cases::Contract& contract,
            bool is_sure) {
  const bool is_reversed = contract.is_depth_reversed();
  const bool takes_high_end = is_reversed != is_sure;
  const Rational& end = takes_high_end ? depth.hi : depth.lo;
  const Rational& limit = takes_high_end ? clear.lo : clear.hi;
  const auto order = is_reversed ? limit <=> end : end <=> limit;
  return order < 0 || (order == 0 && contract.keeps_last_of_equals());
}

/// Drops the fragments of one sample that cannot be the nearest, and turns `required` into
/// `permitted` for those that might not be. If the case does not name the depth buffer's initial
/// value, that value is no nearer than any depth.
void resolve(const std::vector<Fragment*>& fragments, const SceneTruth& scene,
             std::vector<const Fragment*>& dropped) {
  const cases::Contract& contract = scene.contract();
  const std::optional<float> named = scene.source().depth_clear;
  const Rational begins(double{contract.depth_beginning(named)});
  const ValueRange clear = compared(scene, {begins, begins});
  std::vector<Contender> all;
  all.reserve(fragments.size());
  for (Fragment* fragment : fragments) {
    all.push_back({fragment, fragment->depth ? std::optional(compared(scene, *fragment->depth))
                                             : std::nullopt});
  }
  std::vector<Fragment*> undecided;
  for (const Contender& a : all) {
    if (named && a.depth && !passes(*a.depth, clear, contract, false)) {
      dropped.push_back(a.fragment);
      continue;
    }
    const bool beaten = std::any_of(all.begin(), all.end(), [&](const Contender& b) {
      return b.fragment != a.fragment &&
             b.fragment->decision.verdict == records::Verdict::required &&
             surely_nearer(b, a, contract);
    });
    if (beaten) {
      dropped.push_back(a.fragment);
      continue;
    }
    const bool beats_all = std::all_of(all.begin(), all.end(), [&](const Contender& b) {
      return b.fragment == a.fragment || surely_nearer(a, b, contract);
    });
    const bool is_drawn = a.depth && passes(*a.depth, clear, contract, true);
    if (!is_drawn || !beats_all) undecided.push_back(a.fragment);
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
  for (auto& [place, fragments] : by_sample) resolve(fragments, scene, dropped);
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
