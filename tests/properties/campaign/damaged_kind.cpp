// The backends `damaged:…`, in test programs only: they draw like `cpu` and then go wrong in one
// way, so that a campaign has something to find.
//
//   damaged           loses the last fragment of every draw
//   damaged:slow      the same, but slowly, so that a run can be interrupted
//   damaged:stuck     draws correctly, but only after an hour
//   damaged:refuses   fails to draw
//   damaged:flipped   draws upside down
//   damaged:absent    cannot run here
//   damaged:speaks    has a description with characters that are commands to a terminal
//   damaged:driver    claims to be the driver "damaged", version 1; loses the last fragment of
//                     every draw with a scissor
//   damaged:worse     the same driver, which loses the last fragment of every draw
//   damaged:mended    the same driver, which draws correctly
//   damaged:newer     version 2 of the driver, which draws correctly
//   damaged:unseen    draws correctly; a law that is for this backend alone has a label, "never
//                     seen", that none of its cases reaches

#include <chrono>
#include <thread>

#include "backends/factory.h"
#include "properties/judged_law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties {
namespace {

class RefusingBackend : public DamagedBackend {
  Result<cases::Fragments> draw_fragments(const cases::Case& /*c*/) override {
    return tl::unexpected(Error{"", "", "out of memory"});
  }
};

/// Draws upside down.
class FlippedBackend : public DamagedBackend {
 public:
  FlippedBackend() : DamagedBackend({}, "cpu") {}

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    cases::Case flipped = c;
    for (cases::ClipVertex& p : flipped.positions) p.y = -p.y;
    return DamagedBackend::draw_fragments(flipped);
  }
};

class SlowBackend : public DamagedBackend {
 public:
  explicit SlowBackend(const Damage& damage) : DamagedBackend(damage, "cpu") {}

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(4));
    return DamagedBackend::draw_fragments(c);
  }
};

class StuckBackend : public DamagedBackend {
 public:
  StuckBackend() : DamagedBackend({}, "cpu") {}

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    std::this_thread::sleep_for(std::chrono::hours(1));
    return DamagedBackend::draw_fragments(c);
  }
};

class SpeakingBackend : public DamagedBackend {
 public:
  backends::About about() const override {
    return {.description = "red \x1b[31m and \n two lines"};
  }
};

class UnseenBackend : public DamagedBackend {
 public:
  UnseenBackend() : DamagedBackend({}, "cpu") {}
};

void lose_last(const cases::Case& /*c*/, cases::Fragments& drawn) {
  if (drawn.size() == 0) return;
  drawn.triangle.pop_back();
  drawn.x.pop_back();
  drawn.y.pop_back();
  drawn.sample.pop_back();
  drawn.depth.pop_back();
  drawn.attributes.resize(drawn.attributes.size() - drawn.attribute_count);
  if (drawn.derivatives.empty()) return;
  drawn.derivatives.resize(drawn.derivatives.size() - 2 * drawn.attribute_count);
}

class DriverBackend : public DamagedBackend {
 public:
  DriverBackend(const Damage& damage, std::string version)
      : DamagedBackend(damage, "cpu"), version_(std::move(version)) {}
  backends::About about() const override {
    return {.driver = backends::Driver{"damaged", version_}};
  }

 private:
  std::string version_;
};

void lose_last_of_scissored(const cases::Case& c, cases::Fragments& drawn) {
  if (c.scissor) lose_last(c, drawn);
}

constexpr const char* kAbsent = "needs what no machine has";

Result<std::unique_ptr<backends::Backend>> make(const std::string& options) {
  if (options.empty()) return std::make_unique<DamagedBackend>(&lose_last);
  if (options == "slow") return std::make_unique<SlowBackend>(&lose_last);
  if (options == "stuck") return std::make_unique<StuckBackend>();
  if (options == "refuses") return std::make_unique<RefusingBackend>();
  if (options == "flipped") return std::make_unique<FlippedBackend>();
  if (options == "speaks") return std::make_unique<SpeakingBackend>();
  if (options == "unseen") return std::make_unique<UnseenBackend>();
  if (options == "driver") return std::make_unique<DriverBackend>(&lose_last_of_scissored, "1");
  if (options == "worse") return std::make_unique<DriverBackend>(&lose_last, "1");
  if (options == "mended") return std::make_unique<DriverBackend>(Damage(), "1");
  if (options == "newer") return std::make_unique<DriverBackend>(Damage(), "2");
  if (options == "absent") {
    return tl::unexpected(Error{"damaged:absent", "", kAbsent, Failure::unavailable});
  }
  return tl::unexpected(Error{"damaged:" + options, "", "no damage of that name"});
}

std::vector<backends::Listing> list() {
  return {{"damaged", "loses the last fragment", ""},
          {"damaged:absent", "cannot run", kAbsent},
          {"damaged:driver", "a driver that loses the last fragment with a scissor", ""},
          {"damaged:flipped", "draws upside down", ""},
          {"damaged:mended", "the same driver, mended", ""},
          {"damaged:newer", "the same, mended in another version", ""},
          {"damaged:refuses", "fails to draw", ""},
          {"damaged:slow", "loses the last fragment, slowly", ""},
          {"damaged:speaks", "says what a terminal obeys", ""},
          {"damaged:stuck", "draws rightly, after an hour", ""},
          {"damaged:unseen", "draws rightly what is never seen", ""},
          {"damaged:worse", "the same driver, which always loses it", ""}};
}

const backends::BackendRegistration kRegistration({"damaged", &make, &list});

bool is_unseen(backends::Backend& backend) {
  return dynamic_cast<const UnseenBackend*>(&backend) != nullptr;
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  if (!is_unseen(backend)) return not_applicable();
  return check_judged(c, backend, {}, index);
}

const LawRegistration kLaw({.id = "cases-reach-a-label-that-none-has",
                            .sentence = "cases reach a label that none has",
                            .reason = "A law has not held of cases that it is not about.",
                            .exceptions = "all backends but damaged:unseen",
                            .generate = &generate_any,
                            .check = &check,
                            .is_promised = &is_unseen,
                            .covers = {cover(20, "drawn"), cover(30, "never seen")}});

}  // namespace
}  // namespace rastercheck::properties
