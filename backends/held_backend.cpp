#include "backends/held_backend.h"

#include <utility>

namespace rastercheck::backends {
namespace {

class HeldBackend : public Backend {
 public:
  HeldBackend(cases::ContractTerms terms, Backend& held, std::unique_ptr<Backend> owned)
      : terms_(std::move(terms)), held_(&held), owned_(std::move(owned)) {}

  cases::Contract contract(const cases::Case& c) const override {
    return cases::with_terms(held_->contract(c), terms_, c);
  }

  // All else is the backend's own.
  std::string description() const override { return held_->description(); }
  std::optional<Driver> driver() const override { return held_->driver(); }
  bool has_limits() const override { return held_->has_limits(); }
  std::optional<Error> is_lost() const override { return held_->is_lost(); }
  Result<cases::Fragments> draw(const cases::Case& c) override { return held_->draw(c); }
  bool traces() const override { return held_->traces(); }
  Result<std::optional<records::SampleTrace>> trace(const cases::Case& c,
                                                    const cases::SamplePlace& at) override {
    return held_->trace(c, at);
  }
  bool draws_pictures() const override { return held_->draws_pictures(); }
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override {
    return held_->draw_picture(c, pipeline);
  }
  bool draws_over() const override { return held_->draws_over(); }
  Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                         cases::Picture& picture) override {
    return held_->draw_over(c, pipeline, picture);
  }
  std::vector<std::string> same_as() const override { return held_->same_as(); }
  bool assembles() const override { return held_->assembles(); }
  Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                          std::span<const std::uint32_t> indices) override {
    return held_->draw_assembled(c, topology, indices);
  }
  bool transforms() const override { return held_->transforms(); }
  Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c) override {
    return held_->transform(c);
  }
  Result<std::vector<cases::Normal>> transform_normals(
      const cases::Matrix4& model, std::span<const cases::Normal> normals) override {
    return held_->transform_normals(model, normals);
  }

 private:
  cases::ContractTerms terms_;
  Backend* held_;
  std::unique_ptr<Backend> owned_;
};

}  // namespace

std::unique_ptr<Backend> held_to(const cases::ContractTerms& terms,
                                 std::unique_ptr<Backend> backend) {
  Backend& held = *backend;
  return std::make_unique<HeldBackend>(terms, held, std::move(backend));
}

std::unique_ptr<Backend> held_to(const cases::ContractTerms& terms, Backend& backend) {
  return std::make_unique<HeldBackend>(terms, backend, nullptr);
}

void hold_backends_to(const std::optional<cases::ContractTerms>& terms) {
  if (!terms) return wrap_backends_with({});
  wrap_backends_with([terms = *terms](std::unique_ptr<Backend> backend) {
    return held_to(terms, std::move(backend));
  });
}

}  // namespace rastercheck::backends
