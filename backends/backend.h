#pragma once

// Anything that can draw a case. What only some backends can do besides (pictures, strips and fans,
// a vertex stage, traces) are interfaces of their own, which a backend may not have.

#include <algorithm>
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

/// The driver that draws, as far as what is known of its faults depends on it.
struct Driver {
  std::string name;     ///< "llvmpipe": lower case, as its folder is called
  std::string version;  ///< "Mesa 22.3.6": as it says itself
  bool operator==(const Driver&) const = default;
};

/// Describes a driver of OpenGL or Vulkan as far as its promises depend on it.
struct ApiLimits {
  int subpixel_bits = 4;           ///< GL_SUBPIXEL_BITS, subPixelPrecisionBits
  bool is_software = false;        ///< it draws with the processor
  int viewport_subpixel_bits = 0;  ///< GL_VIEWPORT_SUBPIXEL_BITS, viewportSubPixelBits
  bool operator==(const ApiLimits&) const = default;

  /// What it is held to unless the user says otherwise.
  cases::DriverPromise usual_promise() const {
    return is_software ? cases::DriverPromise::ieee : cases::DriverPromise::conformance;
  }
};

/// What a backend says of itself.
struct About {
  /// One line about what is drawn with: name and version of a driver or plugin, say. May be empty.
  std::string description = {};
  std::optional<Driver> driver = std::nullopt;  ///< nothing of what is no driver
  /// Set for a driver that promises what its API does, and empty for what makes its own promises.
  std::optional<ApiLimits> api = std::nullopt;
  /// Whether there are kinds of cases that it does not draw (Failure::unsupported): laws about
  /// these check nothing then, and labels are not reached, which is no fault of a run.
  bool has_limits = false;
  /// Which cases it draws, as far as that is known beforehand.
  cases::Capabilities capabilities = {};
  /// Specifications of backends that promise to draw the same bits as this one, fragments and
  /// pictures, derivatives aside where either has none. Empty: none does.
  std::vector<std::string> same_as = {};
  /// What WaysOfDrawing has; empty where there is none.
  std::vector<cases::DrawBy> ways = {};
  bool operator==(const About&) const = default;
};

/// Holds the fragments of a case together with the contract that judges them.
struct Drawn {
  cases::Contract contract;
  cases::Fragments fragments;
};

/// The fragments alone.
inline Result<cases::Fragments> fragments_of(Result<Drawn> drawn) {
  return std::move(drawn).map([](Drawn&& both) { return std::move(both.fragments); });
}

/// Draws what all triangles of a case without a camera leave in a framebuffer, in submission order.
///
/// A backend that has one refuses what is no valid case (cases::Case), whatever way of drawing it
/// is asked for, Backend::draw() among them. Triangles of vertices that are not finite, and all of
/// a viewport without area, may draw nothing instead.
class PictureDrawer {
 public:
  virtual Result<cases::Picture> draw_picture(const cases::Case& c,
                                              const cases::Pipeline& pipeline) = 0;

  /// The same into a picture that is there, of the case's size and not resolved, which is not
  /// cleared. Where it fails the picture is what it was.
  virtual Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                                 cases::Picture& picture) = 0;

 protected:
  ~PictureDrawer() = default;
};

/// Makes triangles of strips and fans.
class Assembler {
 public:
  /// What a list, strip or fan of a case's vertices draws, in place of its triangles: as
  /// Backend::draw() has it, triangles numbered in the order of the indices. cases::kRestart among
  /// these begins anew.
  virtual Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                                  std::span<const std::uint32_t> indices) = 0;

 protected:
  ~Assembler() = default;
};

/// Transforms vertices and normals.
class VertexStage {
 public:
  /// The clip positions of a case with a camera, one for each vertex. Coordinates beyond float32
  /// are infinite.
  virtual Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c) = 0;

  /// The unit normals in world space of normals in object space of any length, one for each; zero
  /// where the image is zero (cases::Contract::normal_bound).
  virtual Result<std::vector<cases::Normal>> transform_normals(
      const cases::Matrix4& model, std::span<const cases::Normal> normals) = 0;

 protected:
  ~VertexStage() = default;
};

/// Tells how what is drawn comes about.
class Tracer {
 public:
  /// How a sample of a triangle came about, or that it is not drawn, the triangle drawn alone: a
  /// depth test has no say. Nothing where the sample is not of the target, or the triangle is not
  /// set up at all. Fails where the case cannot be drawn, or has no such triangle.
  virtual Result<std::optional<records::SampleTrace>> trace(const cases::Case& c,
                                                            const cases::SamplePlace& at) = 0;

 protected:
  ~Tracer() = default;
};

/// Draws fragments in several ways, which should give the same bits.
class WaysOfDrawing {
 public:
  /// Those there are, without DrawBy::frame, which is a way for cases to ask for a depth test.
  virtual std::vector<cases::DrawBy> ways() const = 0;

  /// What Backend::draw() draws, in one of these ways; Failure::unsupported where that way does not
  /// draw such cases.
  virtual Result<cases::Fragments> draw_by(const cases::Case& c, cases::DrawBy way) = 0;

 protected:
  ~WaysOfDrawing() = default;
};

class Backend {
 public:
  Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
  virtual ~Backend() = default;

  virtual About about() const { return {}; }

  /// Why asking it any more is of no use, where it is: whatever it drew of late came to nothing.
  virtual std::optional<Error> is_lost() const { return std::nullopt; }

  /// What it promises itself about coverage and attributes of a case.
  virtual cases::Contract promise(const cases::Case& c) const = 0;

  // What it can do besides; nullptr: it cannot. They live as long as the backend. What they draw is
  // judged by contract() of the case that was drawn.
  virtual PictureDrawer* picture_drawer() { return nullptr; }
  virtual Assembler* assembler() { return nullptr; }
  virtual VertexStage* vertex_stage() { return nullptr; }
  virtual Tracer* tracer() { return nullptr; }
  virtual WaysOfDrawing* ways_of_drawing() { return nullptr; }

  /// Overrides its promise by these terms from now on, as a contract file does; nullopt takes that
  /// back.
  void hold_to(std::optional<cases::ContractTerms> terms) { terms_ = std::move(terms); }
  const std::optional<cases::ContractTerms>& terms() const { return terms_; }

  /// Makes it draw in this way from now on, if it has the way and the way draws such cases. Without
  /// one it draws each case in the way that takes least.
  void prefer(std::optional<cases::DrawBy> way) { preferred_ = way; }

  /// Has it call `tell` whenever part of a drawing is done that takes long: whoever waits for it
  /// knows then that it goes on.
  void tell_progress(std::function<void()> tell) { tell_ = std::move(tell); }

  /// Changes what was drawn of a case without a camera.
  using Amendment = std::function<void(const cases::Case&, cases::Fragments&)>;
  /// Sets what changes each drawing before a law sees it (properties/drawing.h), so that it can be
  /// tried what is still wrong once part
  /// of it is put right. Empty: nothing does.
  void amend_by(Amendment amend) { amend_ = std::move(amend); }
  const Amendment& amendment() const { return amend_; }

  /// The promise of its API that it is held to; nothing of what promises something of its own.
  std::optional<cases::DriverPromise> driver_promise() const {
    const std::optional<ApiLimits> api = about().api;
    if (!api) return std::nullopt;
    return terms_ && terms_->promise ? *terms_->promise : api->usual_promise();
  }

  /// What it is held to: decides the verdicts.
  cases::Contract contract(const cases::Case& c) const {
    return terms_ ? cases::with_terms(promise(c), *terms_, c) : promise(c);
  }

  /// Draws a case without a camera (oracle/transform.h rounds one away). The error names what of
  /// the case cannot be drawn.
  Result<Drawn> draw(const cases::Case& c) {
    return draw_unjudged(c).map([&](cases::Fragments&& fragments) {
      return Drawn{contract(c), std::move(fragments)};
    });
  }

  /// The same without the contract that judges it.
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
  /// Says that part of a drawing is done.
  void go_on() const {
    if (tell_) tell_();
  }

  /// What draw() draws.
  virtual Result<cases::Fragments> draw_fragments(const cases::Case& c) = 0;

 private:
  std::optional<cases::ContractTerms> terms_;
  std::optional<cases::DrawBy> preferred_;
  std::function<void()> tell_;
  Amendment amend_;
};

}  // namespace rastercheck::backends
