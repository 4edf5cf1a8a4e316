#pragma once

// `cpu`, with depths that are biased and stored by a calculation of its own: in double, from the
// planes through the vertices, and wrong in one way if asked.

#include <array>
#include <functional>
#include <memory>
#include <utility>

#include "backends/backend.h"
#include "backends/factory.h"

namespace rastercheck::properties {

/// The ways in which a backend's bias is wrong; by default, none.
struct OwnBias {
  double unit = 1;        ///< r of unorm formats, in units of 2^-b
  double float_unit = 1;  ///< r of float32, in units of 2^(e−23)
  /// m from |z_x| and |z_y|; empty: the greater one.
  std::function<double(double x, double y)> slope = {};
  /// The offset limited by a clamp that is not 0; empty: on the clamp's side only.
  std::function<double(double offset, double clamp)> clamp = {};
  /// The depth whose exponent counts in float32, from the window depths of the three vertices and
  /// the greatest one drawn; empty: the greatest of the vertices, clamped to the range.
  std::function<double(const std::array<double, 3>& z, double drawn)> exponent_of = {};
  enum class Limit { after, before, at_vertices, never } limit = Limit::after;
  /// The number that is stored for d · (2^b − 1); empty: the nearest.
  std::function<double(double steps)> store = {};
};

class OwnBiasBackend : public backends::Backend {
 public:
  explicit OwnBiasBackend(OwnBias wrong)
      : wrong_(std::move(wrong)), cpu_(*backends::make_backend("cpu")) {}
  cases::Contract promise(const cases::Case& c) const override {
    cases::Contract contract = cases::contract_of(c);
    if (declares) declares(contract);
    return contract;
  }
  backends::About about() const override { return description; }

  /// Changes what the backend promises; empty: what each case asks for.
  std::function<void(cases::Contract&)> declares;
  backends::About description;

 private:
  /// Draws cases by Vulkan's rules only.
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override;

  OwnBias wrong_;
  std::unique_ptr<backends::Backend> cpu_;
};

}  // namespace rastercheck::properties
