// The backends `damaged:…`, in test programs only: they draw as `cpu` does and then go wrong in one
// way, so that a campaign has something to find.
//
//   damaged           loses the last fragment of every draw
//   damaged:refuses   fails to draw
//   damaged:absent    cannot run here

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties {
namespace {

class RefusingBackend : public DamagedBackend {
 public:
  Result<cases::Framebuffer> draw(const cases::Case& /*c*/) override {
    return tl::unexpected(Error{"", "", "out of memory"});
  }
};

void lose_last(const cases::Case& /*c*/, cases::Framebuffer& drawn) {
  if (drawn.size() == 0) return;
  drawn.triangle.pop_back();
  drawn.x.pop_back();
  drawn.y.pop_back();
  drawn.sample.pop_back();
  drawn.depth.pop_back();
  drawn.attributes.resize(drawn.attributes.size() - drawn.attribute_count);
}

constexpr const char* kAbsent = "needs what no machine has";

Result<std::unique_ptr<backends::Backend>> make(const std::string& options) {
  if (options.empty()) return std::make_unique<DamagedBackend>(&lose_last);
  if (options == "refuses") return std::make_unique<RefusingBackend>();
  const bool is_absent = options == "absent";
  return tl::unexpected(
      Error{"damaged:" + options, "", is_absent ? kAbsent : "no damage of that name"});
}

std::vector<backends::Listing> list() {
  return {{"damaged", "loses the last fragment", ""},
          {"damaged:absent", "cannot run", kAbsent},
          {"damaged:refuses", "fails to draw", ""}};
}

const backends::BackendRegistration kRegistration({"damaged", &make, &list});

}  // namespace
}  // namespace rastercheck::properties
