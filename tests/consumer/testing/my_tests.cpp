#include <memory>

#include "backends/backend.h"
#include "backends/factory.h"
#include "properties/campaign/testing.h"

namespace backends = rastercheck::backends;
namespace cases = rastercheck::cases;
using rastercheck::Result;

class MyRasterizer : public backends::Backend {
 public:
  // Promises no subpixel grid, ties decided by the case's rule, and values within 0.51 units in the
  // last place.
  cases::Contract promise(const cases::Case& c) const override {
    cases::Contract promised;
    promised.tie_rule = c.fill_rule;
    promised.bounds = {{0.51F}, {0.51F}, {0.51F}};
    return promised;
  }

 protected:
  // Draws the case's triangles. Yours would call your rasterizer here; this example calls `cpu`.
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    cases::Case without_grid = c;
    without_grid.coverage.reset();
    return backends::fragments_of(drawn_by_->draw(without_grid));
  }

 private:
  std::unique_ptr<backends::Backend> drawn_by_ = backends::make_backend("cpu").value();
};

RASTERCHECK_GTEST_SUITE(MyRasterizer)

// Promises the same, but gives a sample on an edge to the other triangle in one API.
class Careless : public MyRasterizer {
 public:
  explicit Careless(cases::Rules rules) : rules_(rules) {}

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    cases::Case other = c;
    const bool is_top_left = c.fill_rule == cases::TieRule::top_left;
    if (c.rules == rules_) {
      other.fill_rule = is_top_left ? cases::TieRule::bottom_left : cases::TieRule::top_left;
    }
    return MyRasterizer::draw_fragments(other);
  }

  cases::Rules rules_;
};

RASTERCHECK_GTEST_SUITE_OF(CarelessInVulkan,
                           [] { return std::make_unique<Careless>(cases::Rules::vulkan); })
