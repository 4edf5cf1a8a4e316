#include "tests/bench/gl/texture.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "backends/gl/internal/objects.h"

namespace rastercheck::backends::gl::bench {
namespace {

Result<void> validate_levels(std::span<const TextureLevel> levels) {
  if (levels.empty()) return failure("a texture without a level");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const TextureLevel& level = levels[i];
    if (level.width < 1 || level.height < 1 ||
        level.texels.size() !=
            static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height)) {
      return failure("a level of a texture that has not its size's texels");
    }
    if (i > 0 && (level.width != std::max(levels[i - 1].width / 2, 1) ||
                  level.height != std::max(levels[i - 1].height / 2, 1))) {
      return failure("a level of a texture that is not half of that before");
    }
  }
  return {};
}

}  // namespace

struct Texture::Impl {
  Object texture;
};

Texture::Texture(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Texture::Texture(Texture&& other) noexcept = default;
Texture& Texture::operator=(Texture&& other) noexcept = default;
Texture::~Texture() = default;

unsigned Texture::name() const { return impl_->texture.name(); }

Result<Texture> Texture::upload(const Context& /*context*/, std::span<const TextureLevel> levels) {
  if (const Result<void> valid = validate_levels(levels); !valid)
    return tl::unexpected(valid.error());
  auto impl = std::make_unique<Impl>(Impl{make_texture(GL_TEXTURE_2D)});
  const GLuint name = impl->texture.name();
  glTextureStorage2D(name, static_cast<GLsizei>(levels.size()), GL_RGBA8, levels[0].width,
                     levels[0].height);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    glTextureSubImage2D(name, static_cast<GLint>(i), 0, 0, levels[i].width, levels[i].height,
                        GL_RGBA, GL_UNSIGNED_INT_8_8_8_8_REV, levels[i].texels.data());
  }
  return check("uploading a texture").map([&] { return Texture(std::move(impl)); });
}

}  // namespace rastercheck::backends::gl::bench
