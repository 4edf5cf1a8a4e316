#pragma once

// Anything that can draw a case. A kind of backend is one file that registers itself:
//
//   const BackendRegistration kRegistration({"name", &make, &list});
//
// A backend is asked for by its specification, KIND or KIND:OPTIONS, as `method:rational-linear`.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
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

class Backend {
 public:
  Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
  virtual ~Backend() = default;

  /// One line about what is drawn with: name and version of a driver or plugin, say. May be empty.
  virtual std::string description() const { return ""; }

  /// Nothing of what is no driver.
  virtual std::optional<Driver> driver() const { return std::nullopt; }

  /// Whether there are kinds of cases that it does not draw (Failure::unsupported): laws about
  /// these check nothing then, and labels are not reached, which is no fault of a run.
  virtual bool has_limits() const { return false; }

  /// Why asking it any more is of no use, where it is: whatever it drew of late came to nothing.
  virtual std::optional<Error> is_lost() const { return std::nullopt; }

  /// What it promises about coverage and attributes under these rules; decides the verdicts.
  virtual cases::Contract contract(const cases::Case& c) const = 0;

  /// Draws a case without a camera (oracle/transform.h rounds one away). The error names what of
  /// the case cannot be drawn.
  virtual Result<cases::Fragments> draw(const cases::Case& c) = 0;

  /// Whether it can tell how what it draws comes about.
  virtual bool traces() const { return false; }

  /// How a sample of a triangle came about, or that it is not drawn, the triangle drawn alone: a
  /// depth test has no say. Nothing where the sample is not of the target, or the triangle is not
  /// set up at all. Fails where the backend does not trace, cannot draw the case, or the case has
  /// no such triangle.
  virtual Result<std::optional<records::SampleTrace>> trace(const cases::Case& /*c*/,
                                                            const cases::SamplePlace& /*at*/) {
    return tl::unexpected(Error{"", "", "this backend does not trace"});
  }

  /// Whether it draws pictures.
  virtual bool draws_pictures() const { return false; }

  /// What all triangles of a case without a camera leave in a framebuffer, in submission order.
  virtual Result<cases::Picture> draw_picture(const cases::Case& /*c*/,
                                              const cases::Pipeline& /*pipeline*/) {
    return tl::unexpected(Error{"", "", "this backend does not draw pictures"});
  }

  /// Whether it draws over pictures that are there, and refuses what is no valid case (cases::Case)
  /// in every way of drawing. Triangles of vertices that are not finite, and all of a viewport
  /// without area, may draw nothing instead.
  virtual bool draws_over() const { return false; }

  /// The same as draw_picture(), but into a picture that is there, of the case's size and not
  /// resolved, which is not cleared. Where it fails the picture is what it was.
  virtual Result<void> draw_over(const cases::Case& /*c*/, const cases::Pipeline& /*pipeline*/,
                                 cases::Picture& /*picture*/) {
    return tl::unexpected(Error{"", "", "this backend does not draw over pictures"});
  }

  /// Specifications of backends that promise to draw the same bits as this one, fragments and
  /// pictures, derivatives aside where either has none. Empty: none does.
  virtual std::vector<std::string> same_as() const { return {}; }

  /// Whether it makes triangles of strips and fans.
  virtual bool assembles() const { return false; }

  /// The fragments of a list, strip or fan of a case's vertices, in place of its triangles: as
  /// draw() has them, triangles numbered in the order of the indices. cases::kRestart among these
  /// begins anew.
  virtual Result<cases::Fragments> draw_assembled(const cases::Case& /*c*/,
                                                  cases::Topology /*topology*/,
                                                  std::span<const std::uint32_t> /*indices*/) {
    return tl::unexpected(Error{"", "", "this backend does not assemble strips and fans"});
  }

  /// Whether it has a vertex stage.
  virtual bool transforms() const { return false; }

  /// The clip positions that its vertex stage makes of a case with a camera, one for each vertex.
  /// Coordinates beyond float32 are infinite.
  virtual Result<std::vector<cases::ClipVertex>> transform(const cases::Case& /*c*/) {
    return tl::unexpected(Error{"", "", "this backend has no vertex stage"});
  }

  /// The unit normals in world space that its vertex stage makes of normals in object space of any
  /// length, one for each; zero where the image is zero (cases::Contract::normal_bound).
  virtual Result<std::vector<cases::Normal>> transform_normals(
      const cases::Matrix4& /*model*/, std::span<const cases::Normal> /*normals*/) {
    return tl::unexpected(Error{"", "", "this backend does not transform normals"});
  }
};

/// A backend that could be asked for, and whether it can run here.
struct Listing {
  std::string specification;
  std::string summary;
  std::string unavailable_because;  ///< empty where it can run
};

struct BackendKind {
  std::string_view kind;
  /// Fails where the options name nothing, or where it cannot run here.
  Result<std::unique_ptr<Backend>> (*make)(const std::string& options);
  std::vector<Listing> (*list)();
  /// Whether it runs code that this project did not write, which may do anything: it gets a process
  /// of its own (isolation.h).
  bool is_foreign = false;
};

/// Makes the backend of a specification. The error's file is the specification; its failure is
/// `unavailable` where the backend is one that there is, and that cannot run here.
Result<std::unique_ptr<Backend>> make_backend(const std::string& specification);

/// How backends of foreign kinds are made from now on, by specification: instead of in this
/// process.
using MakeForeign =
    std::function<Result<std::unique_ptr<Backend>>(const std::string& specification)>;
void make_foreign_with(MakeForeign make);

/// What becomes of every backend that make_backend() makes from now on; of nothing, itself.
using Wrap = std::function<std::unique_ptr<Backend>(std::unique_ptr<Backend>)>;
void wrap_backends_with(Wrap with);

/// Everything that could be asked for, by kind.
std::vector<Listing> list_backends();

struct BackendRegistration {
  explicit BackendRegistration(const BackendKind& kind);
};

}  // namespace rastercheck::backends
