#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "backends/gl/context.h"
#include "cases/error.h"

namespace rastercheck::backends::gl::bench {

/// A level of a texture, in bytes, where byte k means k/255.
struct TextureLevel {
  int width = 0;
  int height = 0;
  std::span<const std::uint32_t> texels;  ///< [t][s], red in the lowest byte, alpha in the highest
};

/// A texture in the driver's memory, with the levels that were handed over.
class Texture {
 public:
  /// Fails if there is no level, if a level does not have half the size of the one before (rounded
  /// down, at least 1) or that many texels, or if memory runs out.
  static Result<Texture> upload(const Context& context, std::span<const TextureLevel> levels);

  Texture(Texture&& other) noexcept;
  Texture& operator=(Texture&& other) noexcept;
  ~Texture();

  /// The GL name of the texture.
  unsigned name() const;

 private:
  struct Impl;
  explicit Texture(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl::bench
