#include "properties/inspect/focus.h"

#include <algorithm>
#include <utility>

#include "oracle/judge.h"
#include "records/histogram.h"

namespace rastercheck::properties {
namespace {

using oracle::JudgedSample;
using oracle::JudgedValue;
using records::FragmentClass;

/// Chooses the sample to look at from the samples that see() gets.
class Search {
 public:
  explicit Search(const FocusRequest& request) : request_(&request) {}

  void see(const JudgedSample& sample) {
    if (has_violation_ || !fits(sample)) return;
    if (sample.fragment_class != FragmentClass::correct) {
      // A missing or extra sample has no wrong value.
      take(sample, request_->attribute, 0);
      has_violation_ = true;
      return;
    }
    for (const JudgedValue& value : sample.values) see_value(sample, value);
  }

  Focus found() const {
    if (focus_) return *focus_;
    return {{request_->triangle.value_or(0), request_->y.value_or(0), request_->x.value_or(0),
             request_->sample.value_or(0)},
            request_->attribute};
  }

 private:
  bool fits(const JudgedSample& sample) const {
    const auto is_it = [](const std::optional<std::uint32_t>& asked, std::uint32_t here) {
      return !asked || *asked == here;
    };
    return is_it(request_->triangle, sample.place.triangle) && is_it(request_->x, sample.place.x) &&
           is_it(request_->y, sample.place.y) && is_it(request_->sample, sample.place.sample);
  }

  void see_value(const JudgedSample& sample, const JudgedValue& value) {
    const bool is_asked_for =
        request_->is_depth || request_->attribute ? value.attribute == request_->attribute : true;
    if (has_violation_ || !is_asked_for) return;
    if (value.fragment_class != FragmentClass::correct) {
      take(sample, value.attribute, 0);
      has_violation_ = true;
      return;
    }
    const double error = value.ideal ? records::magnitude_bound(*value.ideal) : 0;
    if (!focus_ || error > largest_) take(sample, value.attribute, error);
  }

  void take(const JudgedSample& sample, std::optional<std::uint32_t> attribute, double error) {
    focus_ = {sample.place, attribute};
    largest_ = error;
  }

  const FocusRequest* request_;
  std::optional<Focus> focus_;
  double largest_ = 0;
  bool has_violation_ = false;
};

}  // namespace

Focus find_focus(const cases::ClipCase& c, const backends::Drawn& drawn,
                 const FocusRequest& request) {
  const oracle::SceneTruth scene(c, drawn.contract);
  Search search(request);
  oracle::judge(scene, drawn.fragments, {},
                [&search](const JudgedSample& sample, const oracle::TriangleTruth* truth) {
                  if (truth != nullptr) search.see(sample);
                });
  return search.found();
}

}  // namespace rastercheck::properties
