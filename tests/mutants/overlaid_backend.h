#pragma once

// Several defects at once: the backends `mutants:NAME+NAME…`.

#include <memory>
#include <span>
#include <vector>

#include "backends/backend.h"

namespace rastercheck::mutants {

/// Draws as a backend without a defect does, with the changes of several damaged backends on top:
/// samples that a damaged backend omits are omitted, samples that it adds are added, and numbers in
/// which it differs are taken from it. If several damaged backends change a number, the last one
/// counts. So each defect shows as it does alone, and for each error in a case one can ask which
/// defect caused it.
class OverlaidBackend : public backends::Backend,
                        backends::PictureDrawer,
                        backends::PictureContinuer,
                        backends::Assembler,
                        backends::VertexStage,
                        backends::OcclusionCuller {
 public:
  OverlaidBackend(std::unique_ptr<backends::Backend> unharmed,
                  std::vector<std::unique_ptr<backends::Backend>> damaged);

  backends::About about() const override { return unharmed_->about(); }
  cases::Contract promise(const cases::Case& c) const override { return unharmed_->promise(c); }
  backends::PictureDrawer* picture_drawer() override { return this; }
  backends::PictureContinuer* picture_continuer() override { return this; }
  backends::Assembler* assembler() override { return this; }
  backends::VertexStage* vertex_stage() override { return this; }
  backends::OcclusionCuller* occlusion_culler() override { return this; }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override;
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override;
  Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                         cases::Picture& picture) override;
  Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                          std::span<const std::uint32_t> indices) override;
  Result<bool> is_occluded(const cases::Case& c, std::size_t occluders) override;
  Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c) override;
  Result<std::vector<cases::Normal>> transform_normals(
      const cases::Matrix4& model, std::span<const cases::Normal> normals) override;

  /// Asks all backends, and applies the damaged backends' changes to the answer of `unharmed_`.
  template <typename Ask, typename Overlay>
  auto overlaid(const Ask& ask, const Overlay& overlay) -> decltype(ask(*this));

  std::unique_ptr<backends::Backend> unharmed_;
  std::vector<std::unique_ptr<backends::Backend>> damaged_;
};

}  // namespace rastercheck::mutants
