#include "tests/bench/gl/target.h"

#include <string>
#include <utility>

#include "backends/gl/internal/objects.h"
#include "tests/bench/gl/sample_copy.h"

namespace rastercheck::backends::gl::bench {
namespace {

std::string shape_text(const TargetShape& shape) {
  return std::to_string(shape.width) + " x " + std::to_string(shape.height) + ", " +
         std::to_string(shape.samples) + " samples";
}

Result<Object> make_target_image(const TargetShape& shape, GLenum format) {
  if (shape.samples == 1) {
    Object image = make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(image.name(), 1, format, shape.width, shape.height);
    return check("a target of " + shape_text(shape)).map([&] { return std::move(image); });
  }
  Object image = make_texture(GL_TEXTURE_2D_MULTISAMPLE);
  glTextureStorage2DMultisample(image.name(), shape.samples, format, shape.width, shape.height,
                                GL_TRUE);
  if (const Result<void> made = check("a target of " + shape_text(shape)); !made) {
    return tl::unexpected(made.error());
  }
  // A driver may give more samples than requested.
  GLint samples = 0;
  glGetTextureLevelParameteriv(image.name(), 0, GL_TEXTURE_SAMPLES, &samples);
  if (samples != shape.samples) {
    return failure("asked for " + std::to_string(shape.samples) + " samples, the driver takes " +
                   std::to_string(samples));
  }
  return image;
}

}  // namespace

struct Target::Impl {
  TargetShape shape;
  Object color;
  Object depth;
  Object framebuffer;
};

Target::Target(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Target::Target(Target&& other) noexcept = default;
Target& Target::operator=(Target&& other) noexcept = default;
Target::~Target() = default;

const TargetShape& Target::shape() const { return impl_->shape; }
unsigned Target::framebuffer() const { return impl_->framebuffer.name(); }

Result<Target> Target::create(const Context& /*context*/, const TargetShape& shape) {
  if (shape.width < 1 || shape.height < 1 || shape.samples < 1) {
    return failure("no target of " + shape_text(shape));
  }
  Result<Object> color =
      make_target_image(shape, shape.color == cases::ColorFormat::rgba8 ? GL_RGBA8 : GL_RGBA32F);
  if (!color) return tl::unexpected(color.error());
  Result<Object> depth = make_target_image(shape, GL_DEPTH_COMPONENT32F);
  if (!depth) return tl::unexpected(depth.error());
  Object framebuffer = make_framebuffer();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, color->name(), 0);
  glNamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth->name(), 0);
  if (glCheckNamedFramebufferStatus(framebuffer.name(), GL_DRAW_FRAMEBUFFER) !=
      GL_FRAMEBUFFER_COMPLETE) {
    return failure("the driver does not draw into " + shape_text(shape));
  }
  return Target(std::make_unique<Impl>(
      Impl{shape, *std::move(color), *std::move(depth), std::move(framebuffer)}));
}

Result<Picture> Target::read() const {
  if (impl_->shape.samples != 1) {
    return read_samples(impl_->shape, impl_->color.name(), impl_->depth.name());
  }
  const TargetShape& shape = impl_->shape;
  Picture picture{shape, {}, {}};
  const std::size_t pixels =
      static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(shape.height);
  picture.color.resize(pixels);
  picture.depth.resize(pixels);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer());
  glReadPixels(0, 0, shape.width, shape.height, GL_RGBA, GL_FLOAT, picture.color.data());
  glReadPixels(0, 0, shape.width, shape.height, GL_DEPTH_COMPONENT, GL_FLOAT, picture.depth.data());
  return check("reading a target").map([&] { return std::move(picture); });
}

}  // namespace rastercheck::backends::gl::bench
