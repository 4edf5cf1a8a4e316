#pragma once

// Records what a law asks a backend during one check. Another backend can then be asked the same
// questions without running the law, whose oracle takes far longer than any drawing.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "backends/backend.h"

namespace rastercheck::mutants {

/// Passes questions on to another backend, and records the questions and answers.
class RecordingBackend : public backends::Backend,
                         backends::PictureDrawer,
                         backends::PictureContinuer,
                         backends::Assembler,
                         backends::VertexStage,
                         backends::Tracer,
                         backends::WaysOfDrawing,
                         backends::OcclusionCuller {
 public:
  /// `answering` must outlive this object.
  explicit RecordingBackend(backends::Backend& answering) : answering_(&answering) {}

  /// True if `other` gives the same answers to the recorded questions, to the bit. The law's
  /// verdict on `other` is then the same as on this backend: a law knows nothing but the case and
  /// the answers, and asks the same questions until an answer differs.
  bool is_answered_alike_by(backends::Backend& other) const;

  backends::About about() const override;
  cases::Contract promise(const cases::Case& c) const override;
  backends::PictureDrawer* picture_drawer() override;
  backends::PictureContinuer* picture_continuer() override;
  backends::Assembler* assembler() override;
  backends::VertexStage* vertex_stage() override;
  backends::Tracer* tracer() override;
  backends::WaysOfDrawing* ways_of_drawing() override;
  backends::OcclusionCuller* occlusion_culler() override;

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override;
  std::vector<cases::DrawBy> ways() const override;
  Result<cases::Fragments> draw_by(const cases::Case& c, cases::DrawBy way) override;
  Result<std::optional<records::SampleTrace>> trace(const cases::Case& c,
                                                    const cases::SamplePlace& at) override;
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

  template <typename Question>
  auto asked(const Question& question) const;

  backends::Backend* answering_;
  /// Each function asks a backend one question; true if the answer equals the recorded answer.
  mutable std::vector<std::function<bool(backends::Backend&)>> questions_;
};

}  // namespace rastercheck::mutants
