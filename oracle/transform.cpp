#include "oracle/transform.h"

#include <fmt/format.h>

#include <cmath>

#include "oracle/internal/number.h"
#include "oracle/internal/scene.h"

namespace rastercheck::oracle {

Result<cases::ClipCase> to_clip_case(const cases::Case& c, const std::string& file) {
  if (!c.camera) return cases::ClipCase(c);
  cases::Case clip = c;
  clip.camera.reset();
  const std::vector<RingVector4> positions = clip_positions(c);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    std::array<float, 4> rounded{};
    for (std::size_t axis = 0; axis < 4; ++axis) {
      rounded[axis] = nearest_float(Field(positions[i][static_cast<Eigen::Index>(axis)]));
      if (!std::isfinite(rounded[axis])) {
        return tl::unexpected(Error{file, fmt::format("/vertices/{}/position", i),
                                    fmt::format("its clip {} overflows float32", "xyzw"[axis])});
      }
    }
    clip.positions[i] = {rounded[0], rounded[1], rounded[2], rounded[3]};
  }
  return cases::ClipCase(std::move(clip), c);
}

}  // namespace rastercheck::oracle
