#include "oracle/internal/triangle_judge.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace rastercheck::oracle {
namespace {

using records::FragmentClass;
using records::Reason;
using records::SampleVerdict;
using records::Verdict;

constexpr SampleVerdict kInside{Verdict::required, Reason::inside};

}  // namespace

FragmentOrder::FragmentOrder(const cases::Fragments& drawn) : drawn_(&drawn) {
  const auto goes_before = [&drawn](std::size_t a, std::size_t b) {
    return drawn.place_of(a) < drawn.place_of(b);
  };
  // A key of triangle, y and x, which fill 64 bits; samples are compared separately.
  const auto key = [&drawn](std::size_t i) {
    return (std::uint64_t{drawn.triangle[i]} << 32 | std::uint64_t{drawn.y[i]} << 16) | drawn.x[i];
  };
  bool is_sorted = true;
  std::uint64_t previous = drawn.size() > 0 ? key(0) : 0;
  for (std::size_t i = 1; is_sorted && i < drawn.size(); ++i) {
    const std::uint64_t next = key(i);
    is_sorted = next > previous || (next == previous && drawn.sample[i] >= drawn.sample[i - 1]);
    previous = next;
  }
  if (is_sorted) return;
  order_.resize(drawn.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(), goes_before);
}

std::size_t FragmentOrder::lower_bound(const cases::SamplePlace& place) const {
  std::size_t first = 0;
  std::size_t count = size();
  while (count > 0) {
    const std::size_t half = count / 2;
    if (this->place(first + half) < place) {
      first += half + 1;
      count -= half + 1;
    } else {
      count = half;
    }
  }
  return first;
}

std::uint64_t samples_of_unpromised(const SceneTruth& scene) {
  const PixelBox& box = scene.scene().target_pixels();
  if (box.x1 <= box.x0 || box.y1 <= box.y0) return 0;
  return static_cast<std::uint64_t>(box.x1 - box.x0) * static_cast<std::uint64_t>(box.y1 - box.y0) *
         scene.scene().pattern().size();
}

void TriangleJudge::judge(std::uint32_t triangle, std::size_t first, std::size_t last) {
  triangle_ = triangle;
  const auto truth = std::make_shared<const TriangleTruth>(*context_->scene, triangle);
  truth_ = truth;
  const TriangleSetup& setup = truth->setup();
  filter_.emplace(setup, setup.pixels(), context_->options->first_level);
  samples_->begin(truth, triangle, *filter_);
  if (!setup.promise.is_made) return judge_unpromised(first, last);
  if (!filter_->is_empty()) {
    const PixelBox& box = filter_->box();
    for (int y = box.y0; y < box.y1; ++y) {
      const auto row = static_cast<std::uint32_t>(y);
      while (first < last && order_->place(first).y < row) take_extra(first++, {});
      std::size_t end = first;
      while (end < last && order_->place(end).y == row) ++end;
      judge_row(y, first, end);
      first = end;
    }
  }
  while (first < last) take_extra(first++, {});
  samples_->flush();
}

/// Any sample may be drawn, so only the drawn ones are examined.
void TriangleJudge::judge_unpromised(std::size_t first, std::size_t last) {
  const cases::Fragments& drawn = *context_->drawn;
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t fragment = (*order_)[i];
    const bool is_repeated = i > first && order_->place(i) == order_->place(i - 1);
    const SampleVerdict decision =
        drawn.sample[fragment] < context_->scene->source().framebuffer.samples
            ? truth_->judge(drawn.x[fragment], drawn.y[fragment], drawn.sample[fragment])
            : SampleVerdict{};
    if (is_repeated || decision.verdict == Verdict::forbidden) {
      take_extra(i, decision);
    } else {
      samples_->take_drawn(fragment, decision);
    }
  }
  samples_->flush();
  samples_->count(Verdict::permitted, samples_of_unpromised(*context_->scene));
}

void TriangleJudge::judge_row(int y, std::size_t first, std::size_t last) {
  row_.classify(*truth_, *filter_, y, samples_->levels().samples);
  samples_->count(Verdict::required, row_.required());
  samples_->count(Verdict::permitted, row_.permitted());
  if (row_.required() == 0 && row_.permitted() == 0 && first == last) return;
  const bool hides_ties =
      row_.special().empty() || !samples_->shows(*row_.special().front().decision);
  if (row_.permitted() > 0 || !hides_ties || !is_just_what_is_required(first, last)) {
    return walk_row(y, first, last);
  }
  for (std::size_t i = first; i < last; ++i) samples_->take_drawn((*order_)[i], kInside);
}

/// True if the row has exactly one fragment per required sample and no other.
bool TriangleJudge::is_just_what_is_required(std::size_t first, std::size_t last) const {
  if (last - first != row_.required()) return false;
  const PixelBox& box = filter_->box();
  const cases::Fragments& drawn = *context_->drawn;
  std::uint32_t previous = 0;
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t fragment = (*order_)[i];
    const int x = drawn.x[fragment];
    const std::uint32_t key = static_cast<std::uint32_t>(x) << 8 | drawn.sample[fragment];
    const bool is_required = (i == first || key > previous) && x >= box.x0 && x < box.x1 &&
                             drawn.sample[fragment] < row_.samples() &&
                             row_.is_required(x, drawn.sample[fragment]);
    if (!is_required) return false;
    previous = key;
  }
  return true;
}

/// Takes the row's samples and fragments one by one, in order.
void TriangleJudge::walk_row(int y, std::size_t first, std::size_t last) {
  const PixelBox& box = filter_->box();
  const int samples = row_.samples();
  std::size_t next = first;
  auto special = row_.special().begin();
  for (int x = box.x0; x < box.x1; ++x) {
    for (int s = 0; s < samples; ++s) {
      const cases::SamplePlace place{triangle_, static_cast<std::uint32_t>(y),
                                     static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(s)};
      while (next < last && order_->place(next) < place) take_extra(next++, {});
      const bool is_special =
          special != row_.special().end() && special->x == x && special->sample == s;
      SampleVerdict decision;
      if (is_special) {
        decision = *special++->decision;
      } else if (row_.is_required(x, s)) {
        decision = kInside;
      }
      const bool is_drawn = next < last && order_->place(next) == place;
      if (!is_drawn) {
        if (decision.verdict == Verdict::required) {
          samples_->take(place, decision, FragmentClass::missing, truth_);
        }
        continue;
      }
      if (decision.verdict == Verdict::forbidden) {
        take_extra(next++, truth_->judge(x, y, s));  // judged to learn the reason
      } else {
        samples_->take_drawn((*order_)[next++], decision);
      }
    }
  }
  while (next < last) take_extra(next++, {});
}

void TriangleJudge::take_extra(std::size_t position, const SampleVerdict& decision) {
  samples_->take(order_->place(position), decision, FragmentClass::extra, truth_);
}

}  // namespace rastercheck::oracle
