// draw(): a case handed to a backend, and whether the backend left the floating-point environment
// as it found it. The oracle runs in the same process: a backend that leaves another rounding mode
// behind would falsify every answer after its own.

#include <cfenv>

#include "oracle/transform.h"
#include "properties/law.h"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace rastercheck::properties {
namespace {

/// The modes that change results; put back when it goes out of scope.
class FloatingPointModes {
 public:
  FloatingPointModes() = default;
  FloatingPointModes(const FloatingPointModes&) = delete;
  FloatingPointModes& operator=(const FloatingPointModes&) = delete;
  ~FloatingPointModes() {
    std::fesetround(rounding_);
#if defined(__SSE__)
    _mm_setcsr(control_);
#endif
  }

  bool have_changed() const {
    bool is_changed = std::fegetround() != rounding_;
#if defined(__SSE__)
    // Rounding (bits 13 and 14), flush to zero (15), denormals are zero (6). The rest are masks
    // and sticky flags, which change no result.
    constexpr unsigned kModes = 0xe040;
    is_changed = is_changed || ((_mm_getcsr() ^ control_) & kModes) != 0;
#endif
    return is_changed;
  }

 private:
  int rounding_ = std::fegetround();
#if defined(__SSE__)
  unsigned control_ = _mm_getcsr();
#endif
};

/// Whether the arrays are as long as each other and have the case's attributes.
bool is_well_formed(const cases::Framebuffer& drawn, const cases::Case& c) {
  const std::size_t size = drawn.size();
  return drawn.attribute_count == c.attributes.size() && drawn.x.size() == size &&
         drawn.y.size() == size && drawn.sample.size() == size && drawn.depth.size() == size &&
         drawn.attributes.size() == size * drawn.attribute_count &&
         (drawn.derivatives.empty() ||
          drawn.derivatives.size() == size * drawn.attribute_count * 2);
}

}  // namespace

Result<cases::Framebuffer> draw(const cases::Case& c, backends::Backend& backend) {
  const Result<cases::Case> clip = oracle::to_clip_case(c, "");
  if (!clip) return tl::unexpected(clip.error());
  const FloatingPointModes modes;
  Result<cases::Framebuffer> drawn = backend.draw(*clip);
  if (modes.have_changed()) {
    return tl::unexpected(Error{"", "",
                                "the backend returned with another rounding mode, or with another "
                                "treatment of subnormal numbers, than it was called with"});
  }
  if (drawn && !is_well_formed(*drawn, *clip)) {
    return tl::unexpected(Error{"", "",
                                "the backend's fragments do not have the case's attributes, or its "
                                "arrays differ in length"});
  }
  return drawn;
}

}  // namespace rastercheck::properties
