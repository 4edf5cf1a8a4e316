#pragma once

// The interface of everything that can draw a case. Abilities that only some backends have
// (pictures, strips and fans, a vertex stage, traces, occlusion queries) are separate interfaces.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cases/capabilities.h"
#include "cases/case.h"
#include "cases/contract.h"
#include "cases/contract_terms.h"
#include "cases/draw_by.h"
#include "cases/driver_promise.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "cases/picture.h"
#include "records/stage_trace.h"

namespace rastercheck::backends {

/// Identifies a driver, so that its known faults can be looked up.
struct Driver {
  std::string name;     ///< "llvmpipe": lower case, as in the name of the driver's folder
  std::string version;  ///< "Mesa 22.3.6": as reported by the driver
  bool operator==(const Driver&) const = default;
};

/// The properties of an OpenGL or Vulkan driver that its promises depend on.
struct ApiLimits {
  int subpixel_bits = 4;           ///< GL_SUBPIXEL_BITS, subPixelPrecisionBits
  bool is_software = false;        ///< draws on the processor
  int viewport_subpixel_bits = 0;  ///< GL_VIEWPORT_SUBPIXEL_BITS, viewportSubPixelBits
  int subtexel_bits = 4;           ///< subTexelPrecisionBits
  bool operator==(const ApiLimits&) const = default;

  /// The promise that the driver is held to unless the user chooses another.
  cases::DriverPromise usual_promise() const {
    return is_software ? cases::DriverPromise::ieee : cases::DriverPromise::conformance;
  }
};

/// A backend's description of itself.
struct About {
  /// One line on what draws, such as the name and version of a driver or plugin. May be empty.
  std::string description = {};
  std::optional<Driver> driver = std::nullopt;  ///< empty unless the backend is a driver
  /// Set for a driver, which promises what its API promises. Empty for backends that make their own
  /// promises.
  std::optional<ApiLimits> api = std::nullopt;
  /// True if the backend refuses some kinds of cases (Failure::unsupported). Laws about those kinds
  /// then check nothing and some labels are never reached, which is not a fault of the run.
  bool has_limits = false;
  /// The cases that the backend draws, insofar as this is known in advance.
  cases::Capabilities capabilities = {};
  /// Specifications of backends that promise to draw the same bits as this one: the same fragments
  /// and pictures, and the same derivatives if both backends have derivatives.
  std::vector<std::string> same_as = {};
  /// The ways that WaysOfDrawing offers; empty if the backend does not implement it.
  std::vector<cases::DrawBy> ways = {};
  /// True if the backend implements OcclusionCuller.
  bool answers_occlusion_queries = false;
  /// True if the backend implements PictureDrawer.
  bool draws_pictures = false;
  /// True if the backend implements Assembler.
  bool assembles = false;
  bool operator==(const About&) const = default;
};

/// The fragments of a case together with the contract that judges them.
struct Drawn {
  cases::Contract contract;
  cases::Fragments fragments;
};

/// Returns only the fragments.
inline Result<cases::Fragments> fragments_of(Result<Drawn> drawn) {
  return std::move(drawn).map([](Drawn&& both) { return std::move(both.fragments); });
}

/// Draws all triangles of a case into a framebuffer, in submission order, and returns the picture.
class PictureDrawer {
 public:
  /// The case must have no camera. Fails with Failure::unsupported if the backend cannot draw the
  /// case or the pipeline.
  virtual Result<cases::Picture> draw_picture(const cases::Case& c,
                                              const cases::Pipeline& pipeline) = 0;

 protected:
  ~PictureDrawer() = default;
};

/// Draws over existing pictures.
///
/// A backend with this interface refuses every invalid case (cases::Case) in all its drawing
/// functions, including Backend::draw(). A triangle with a vertex that is not finite, and any
/// triangle in a viewport without area, may be silently skipped instead.
class PictureContinuer {
 public:
  /// Like PictureDrawer::draw_picture(), but draws over an existing picture without clearing it.
  /// The picture must have the case's size and must not be resolved; it stays unchanged on failure.
  virtual Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                                 cases::Picture& picture) = 0;

 protected:
  ~PictureContinuer() = default;
};

/// Assembles primitives from strips and fans.
class Assembler {
 public:
  /// Draws a list, strip or fan of a case's vertices, in place of the case's triangles, as
  /// Backend::draw() does. Triangles are numbered in the order of the indices. The index
  /// cases::kRestart starts a new list, strip or fan. A case of lines has lists and strips of
  /// lines, one of points neither (cases::has_topology()). Fails with Failure::unsupported if the
  /// backend cannot draw the case this way.
  virtual Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                                  std::span<const std::uint32_t> indices) = 0;

 protected:
  ~Assembler() = default;
};

/// Transforms vertices and normals.
class VertexStage {
 public:
  /// Returns the clip positions of a case with a camera, one per vertex. Coordinates too large for
  /// float32 become infinite.
  virtual Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c) = 0;

  /// Returns the unit normals in world space, one for each normal in object space, whatever its
  /// length; zero if the transformed normal is zero (cases::Contract::normal_bound).
  virtual Result<std::vector<cases::Normal>> transform_normals(
      const cases::Matrix4& model, std::span<const cases::Normal> normals) = 0;

 protected:
  ~VertexStage() = default;
};

/// Traces how a sample's values were computed.
class Tracer {
 public:
  /// Traces how a sample of a triangle was computed, or why it is not drawn. The triangle is drawn
  /// alone, so the depth test does not apply. Empty if the sample is outside the target or the
  /// triangle is never set up. Fails if the case cannot be drawn or has no such triangle.
  virtual Result<std::optional<records::SampleTrace>> trace(const cases::Case& c,
                                                            const cases::SamplePlace& at) = 0;

 protected:
  ~Tracer() = default;
};

/// Draws fragments in several ways, which should all give the same bits.
class WaysOfDrawing {
 public:
  /// The available ways. Never contains DrawBy::frame, which a case selects by asking for a depth
  /// test.
  virtual std::vector<cases::DrawBy> ways() const = 0;

  /// Draws like Backend::draw(), but in this way. Fails with Failure::unsupported if the way cannot
  /// draw the case.
  virtual Result<cases::Fragments> draw_by(const cases::Case& c, cases::DrawBy way) = 0;

 protected:
  ~WaysOfDrawing() = default;
};

/// Answers occlusion queries: whether anything of some triangles is visible behind others.
class OcclusionCuller {
 public:
  /// True if the culler calls the occludee occluded. The occluders are the case's triangles before
  /// index `occluders`, and the occludee is all others, at least one. Depths are compared whether
  /// or not the case has a depth test; attributes are ignored. The case must have no camera.
  virtual Result<bool> is_occluded(const cases::Case& c, std::size_t occluders) = 0;

 protected:
  ~OcclusionCuller() = default;
};

class Backend {
 public:
  Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
  virtual ~Backend() = default;

  virtual About about() const { return {}; }

  /// The reason why the backend was given up; empty while it is usable.
  virtual std::optional<Error> is_lost() const { return std::nullopt; }

  /// The backend's own promise about the coverage and attributes of a case.
  virtual cases::Contract promise(const cases::Case& c) const = 0;

  // Optional abilities; nullptr if the backend lacks one. The pointers live as long as the backend.
  // Drawings of these interfaces are judged by contract() of the case that was drawn.
  virtual PictureDrawer* picture_drawer() { return nullptr; }
  virtual PictureContinuer* picture_continuer() { return nullptr; }
  virtual Assembler* assembler() { return nullptr; }
  virtual VertexStage* vertex_stage() { return nullptr; }
  virtual Tracer* tracer() { return nullptr; }
  virtual WaysOfDrawing* ways_of_drawing() { return nullptr; }
  virtual OcclusionCuller* occlusion_culler() { return nullptr; }

  /// From now on, these terms override the backend's promise, as a contract file does; nullopt
  /// removes the override.
  void hold_to(std::optional<cases::ContractTerms> terms) { terms_ = std::move(terms); }
  const std::optional<cases::ContractTerms>& terms() const { return terms_; }

  /// From now on, draws in this way where possible: a way that the backend lacks, or that cannot
  /// draw a case, is ignored. Without a preference, each case is drawn in the fastest way.
  void prefer(std::optional<cases::DrawBy> way) { preferred_ = way; }

  /// Sets a function to call whenever part of a long drawing is done, so that the caller knows that
  /// work goes on.
  void tell_progress(std::function<void()> tell) { tell_ = std::move(tell); }

  /// Changes the fragments drawn for a case without a camera.
  using Amendment = std::function<void(const cases::Case&, cases::Fragments&)>;
  /// Sets an amendment that is applied to each drawing before a law sees it (properties/drawing.h).
  /// This shows what is still wrong after part of the drawing is corrected. An empty function
  /// removes it.
  void amend_by(Amendment amend) { amend_ = std::move(amend); }
  const Amendment& amendment() const { return amend_; }

  /// The API promise that the backend is held to; empty for backends that make their own promises.
  std::optional<cases::DriverPromise> driver_promise() const {
    const std::optional<ApiLimits> api = about().api;
    if (!api) return std::nullopt;
    return terms_ && terms_->promise ? *terms_->promise : api->usual_promise();
  }

  /// The contract that decides the verdicts: the backend's promise, overridden by terms() if they
  /// are set.
  cases::Contract contract(const cases::Case& c) const {
    return terms_ ? cases::with_terms(promise(c), *terms_, c) : promise(c);
  }

  /// Draws a case without a camera (oracle/transform.h turns a camera into rounded clip positions).
  /// The error names the part of the case that cannot be drawn.
  Result<Drawn> draw(const cases::Case& c) {
    return draw_unjudged(c).map([&](cases::Fragments&& fragments) {
      return Drawn{contract(c), std::move(fragments)};
    });
  }

  /// Like draw(), but returns no contract.
  Result<cases::Fragments> draw_unjudged(const cases::Case& c) {
    WaysOfDrawing* const ways = preferred_ ? ways_of_drawing() : nullptr;
    if (ways == nullptr) return draw_fragments(c);
    const std::vector<cases::DrawBy> all = ways->ways();
    if (std::find(all.begin(), all.end(), *preferred_) == all.end()) return draw_fragments(c);
    Result<cases::Fragments> drawn = ways->draw_by(c, *preferred_);
    if (drawn || drawn.error().failure != Failure::unsupported) return drawn;
    return draw_fragments(c);
  }

 protected:
  /// Tells the caller that part of a drawing is done.
  void go_on() const {
    if (tell_) tell_();
  }

  /// Does the drawing for draw().
  virtual Result<cases::Fragments> draw_fragments(const cases::Case& c) = 0;

 private:
  std::optional<cases::ContractTerms> terms_;
  std::optional<cases::DrawBy> preferred_;
  std::function<void()> tell_;
  Amendment amend_;
};

}  // namespace rastercheck::backends
