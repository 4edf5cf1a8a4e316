#pragma once

// `cpu`, changed on purpose in one way ("bent").

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "backends/backend.h"
#include "backends/factory.h"

namespace rastercheck::properties {

struct Bending {
  /// The case that is drawn in place of the given one; nullopt if none is drawn.
  std::function<std::optional<cases::Case>(cases::Case)> before = [](cases::Case c) { return c; };
  std::function<void(cases::Fragments&)> after = [](cases::Fragments& /*drawn*/) {};
};

class Bent : public backends::Backend {
 public:
  explicit Bent(Bending bending)
      : bending_(std::move(bending)), cpu_(*backends::make_backend("cpu")) {}
  cases::Contract promise(const cases::Case& c) const override {
    cases::Contract contract = cases::contract_of(c);
    if (declares) declares(contract);
    return contract;
  }

  /// Changes what the backend promises; empty: what each case asks for.
  std::function<void(cases::Contract&)> declares;

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    const std::optional<cases::Case> bent = bending_.before(c);
    if (!bent) return tl::unexpected(Error{"", "", "not that", Failure::unsupported});
    Result<backends::Drawn> drawn = cpu_->draw(*bent);
    if (!drawn) return tl::unexpected(drawn.error());
    bending_.after(drawn->fragments);
    return std::move(drawn->fragments);
  }

  Bending bending_;
  std::unique_ptr<backends::Backend> cpu_;
};

}  // namespace rastercheck::properties
