#pragma once

// `cpu`, with pictures that are made of its fragments by a calculation of its own, wrong in one way
// if asked.

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"

namespace rastercheck::properties {

/// The ways in which a backend's pictures are wrong; by default, none.
struct OwnPicture {
  /// The byte that a colour in steps of 1/255 becomes, without and with blending; empty: the
  /// nearest.
  std::function<double(double steps)> store = {};
  std::function<double(double steps)> store_blended = {};
  /// The float that a blended colour becomes; empty: the nearest.
  std::function<double(double color)> blended = {};
  /// The resolved colour of samples, in steps of 1/255 if they are bytes; empty: their mean.
  std::function<double(const std::vector<double>& samples)> resolve = {};
  /// The difference to show for those of a pixel's own row (column, along y) and of the even and
  /// the odd one; empty: its own.
  std::function<double(double own, double even, double odd)> difference = {};
  /// The share of the second texel in bilinear filtering; empty: the exact one.
  std::function<double(double share)> weight = {};
  /// The place to look up, in texels, for a coordinate times the texture's width; empty: that.
  std::function<double(double place)> texel = {};
  /// The attribute that a picture shows for one that is drawn as a fragment; empty: that.
  std::function<float(float value)> value = {};
};

class OwnPictureBackend : public backends::Backend, public backends::PictureDrawer {
 public:
  explicit OwnPictureBackend(OwnPicture wrong)
      : wrong_(std::move(wrong)), cpu_(*backends::make_backend("cpu")) {}
  cases::Contract promise(const cases::Case& c) const override {
    cases::Contract contract = cpu_->promise(c);
    if (declares) declares(contract);
    return contract;
  }
  backends::About about() const override { return description; }
  PictureDrawer* picture_drawer() override { return this; }
  /// Draws textures of one row only, which are clamped, by the first attribute.
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override;

  /// Changes what the backend promises; empty: what `cpu` does.
  std::function<void(cases::Contract&)> declares;
  backends::About description;
  /// Refuses these pictures; empty: none.
  std::function<bool(const cases::Case&, const cases::Pipeline&)> refuses;

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    return backends::fragments_of(cpu_->draw(c));
  }

  OwnPicture wrong_;
  std::unique_ptr<backends::Backend> cpu_;
};

}  // namespace rastercheck::properties
