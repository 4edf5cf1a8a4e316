#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "backends/gl/context.h"
#include "cases/error.h"

namespace rastercheck::backends::gl::bench {

/// A level of a texture, in bytes that are k/255.
struct TextureLevel {
  int width = 0;
  int height = 0;
  std::span<const std::uint32_t> texels;  ///< [t][s], red in the lowest byte, alpha in the highest
};

/// A texture in the driver's memory, its levels as they were handed over.
class Texture {
 public:
  /// Fails where there is no level, one is not half the size of that before, rounded down but not
  /// to 0, or has not that many texels, or memory runs out.
  static Result<Texture> upload(const Context& context, std::span<const TextureLevel> levels);

  Texture(Texture&& other) noexcept;
  Texture& operator=(Texture&& other) noexcept;
  ~Texture();

  /// GL's name of it.
  unsigned name() const;

 private:
  struct Impl;
  explicit Texture(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl::bench
