#include "backends/gl/internal/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "backends/gl/internal/layer_copy.h"
#include "backends/unorm_depth.h"
#include "cases/names.h"
#include "cases/sample_pattern.h"

namespace rastercheck::backends::gl {
namespace {

std::string to_string(const LayerShape& shape) {
  const std::string depth =
      cases::unorm_bits(shape.depth) == 0 ? "" : fmt::format(", {}", cases::name_of(shape.depth));
  return fmt::format("{} targets of {} x {}, {} samples, {} varyings{}{}", shape.layers,
                     shape.size.width, shape.size.height, shape.size.samples, shape.varyings,
                     shape.format == cases::ColorFormat::rgba8 ? " of rgba8" : "", depth);
}

void read_pixels(const LayerShape& shape, GLenum channels, void* to, GLenum type = GL_FLOAT) {
  glReadPixels(0, 0, shape.size.width, shape.size.height, channels, type, to);
}

bool has_no_number(const std::vector<float>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](float n) { return n == 0; });
}

}  // namespace

Layers::Layers(const Capabilities& has, const LayerShape& shape) : shape_(shape), has_(&has) {}
Layers::Layers(Layers&& other) noexcept = default;
Layers& Layers::operator=(Layers&& other) noexcept = default;
Layers::~Layers() = default;

Result<Layers> Layers::create(const Capabilities& has, CopyPrograms& programs,
                              const LayerShape& shape) {
  Layers layers(has, shape);
  if (const Result<void> made = layers.make_images(); !made)
    return unsupported(made.error().reason);
  if (const Result<void> made = layers.make_framebuffers(); !made) {
    return tl::unexpected(made.error());
  }
  if (layers.is_multisampled() || has.is_es) {
    const Result<CopyProgram> program = programs.get(shape.size.samples, shape.varyings);
    if (!program) return tl::unexpected(program.error());
    Result<LayerCopy> copy = LayerCopy::create(*program, shape);
    if (!copy) return tl::unexpected(copy.error());
    layers.copy_ = std::make_unique<LayerCopy>(*std::move(copy));
  }
  return layers;
}

GLenum Layers::target() const {
  return is_multisampled() ? GL_TEXTURE_2D_MULTISAMPLE_ARRAY : GL_TEXTURE_2D_ARRAY;
}

/// Makes an image and leaves it bound to its target.
Object Layers::make_image(GLenum format, GLenum channels, GLenum type) const {
  Object image = generate_texture();
  glBindTexture(target(), image.name());
  const cases::FramebufferSize& size = shape_.size;
  if (!is_multisampled()) {
    glTexImage3D(target(), 0, static_cast<GLint>(format), size.width, size.height, shape_.layers, 0,
                 channels, type, nullptr);
    glTexParameteri(target(), GL_TEXTURE_MAX_LEVEL, 0);
    glTexParameteri(target(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(target(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  } else if (has_->is_es) {
    glTexStorage3DMultisample(target(), size.samples, format, size.width, size.height,
                              shape_.layers, GL_TRUE);
  } else {
    glTexImage3DMultisample(target(), size.samples, format, size.width, size.height, shape_.layers,
                            GL_TRUE);
  }
  return image;
}

/// Makes the depth image and leaves it bound to its target.
Result<void> Layers::make_depth() {
  const int bits = cases::unorm_bits(shape_.depth);
  if (bits == 0) {
    depth_ = make_image(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT);
  } else if (bits == 16) {
    depth_ = make_image(GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT);
  } else {
    depth_ = make_image(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT);
  }
  if (Result<void> made = check(to_string(shape_)); !made || bits == 0) return made;
  // A driver may give more bits than requested.
  GLint given = 0;
  GLint type = 0;
  glGetTexLevelParameteriv(target(), 0, GL_TEXTURE_DEPTH_SIZE, &given);
  glGetTexLevelParameteriv(target(), 0, GL_TEXTURE_DEPTH_TYPE, &type);
  if (given == bits && type == GL_UNSIGNED_NORMALIZED) return {};
  return failure(fmt::format("asked for depths of {} bits, but the driver uses {}{}", bits, given,
                             type == GL_UNSIGNED_NORMALIZED ? "" : " of another kind"));
}

Result<void> Layers::make_images() {
  if (shape_.has_numbers) numbers_ = make_image(GL_R32F, GL_RED);
  for (std::size_t i = 0; i < shape_.varyings; ++i) {
    values_.push_back(shape_.format == cases::ColorFormat::rgba8
                          ? make_image(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE)
                          : make_image(GL_RGBA32F, GL_RGBA));
  }
  if (Result<void> made = make_depth(); !made) return made;
  if (!is_multisampled()) return {};
  // A driver may give more samples than requested.
  GLint samples = 0;
  glGetTexLevelParameteriv(target(), 0, GL_TEXTURE_SAMPLES, &samples);
  if (samples == shape_.size.samples) return {};
  return failure(
      fmt::format("asked for {} samples, but the driver uses {}", shape_.size.samples, samples));
}

Result<void> Layers::make_framebuffers() {
  std::vector<GLuint> images;
  if (shape_.has_numbers) images.push_back(numbers_.name());
  for (const Object& image : values_) images.push_back(image.name());
  for (GLenum i = 0; i < images.size(); ++i) buffers_.push_back(GL_COLOR_ATTACHMENT0 + i);
  for (GLint layer = 0; layer < shape_.layers; ++layer) {
    framebuffers_.push_back(generate_framebuffer());
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_.back().name());
    for (std::size_t i = 0; i < images.size(); ++i) {
      glFramebufferTextureLayer(GL_FRAMEBUFFER, buffers_[i], images[i], 0, layer);
    }
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth_.name(), 0, layer);
    glDrawBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
    // Framebuffers without colours are incomplete if a colour is to be read from them.
    if (buffers_.empty()) glReadBuffer(GL_NONE);
  }
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    return failure(fmt::format("the driver cannot draw into {} (framebuffer status {})",
                               to_string(shape_), hexadecimal(status)));
  }
  return check("making framebuffers");
}

Result<std::vector<std::size_t>> Layers::sample_order() const {
  const auto pattern = cases::standard_pattern(shape_.size.samples);
  std::vector<std::size_t> order(pattern.size(), pattern.size());
  if (!is_multisampled()) return std::vector<std::size_t>{0};
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer(0));
  std::string places;
  for (GLuint i = 0; i < pattern.size(); ++i) {
    std::array<GLfloat, 2> at{};
    glGetMultisamplefv(GL_SAMPLE_POSITION, i, at.data());
    places += fmt::format(" ({}, {})", 16 * at[0], 16 * at[1]);
    for (std::size_t s = 0; s < pattern.size(); ++s) {
      const bool is_here = at[0] * 16 == static_cast<float>(pattern[s].x) &&
                           at[1] * 16 == static_cast<float>(pattern[s].y);
      if (is_here) order[s] = i;
    }
  }
  if (const Result<void> asked = check("asking for sample positions"); !asked) {
    return tl::unexpected(asked.error());
  }
  if (std::find(order.begin(), order.end(), pattern.size()) == order.end()) return order;
  return unsupported(
      fmt::format("its {} samples are not at the standard positions but, in 1/16 pixel, at{}",
                  pattern.size(), places));
}

/// Reads the depths of the framebuffer that is bound for reading, bit for bit.
void Layers::read_depth(std::vector<float>& depth) const {
  const int bits = cases::unorm_bits(shape_.depth);
  depth.resize(shape_.samples());
  if (bits == 0) {
    read_pixels(shape_, GL_DEPTH_COMPONENT, depth.data());
    return;
  }
  if (bits == 16) {
    std::vector<std::uint16_t> steps(depth.size());
    glPixelStorei(GL_PACK_ALIGNMENT, 2);
    read_pixels(shape_, GL_DEPTH_COMPONENT, steps.data(), GL_UNSIGNED_SHORT);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = unorm_depth(steps[i], bits);
    return;
  }
  // GL hands over k (2^32 − 1)/(2^24 − 1), which lies in [256 k, 256 k + 255].
  std::vector<std::uint32_t> steps(depth.size());
  read_pixels(shape_, GL_DEPTH_COMPONENT, steps.data(), GL_UNSIGNED_INT);
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = unorm_depth(steps[i] >> 8U, bits);
}

Result<void> Layers::read(std::size_t layer, const std::vector<bool>& varyings,
                          LayerContent& content) {
  content.values.resize(values_.size());
  if (copy_) {
    // Without numbers, the copy has depths in place of them.
    std::vector<GLuint> images = {(shape_.has_numbers ? numbers_ : depth_).name(), depth_.name()};
    for (const Object& image : values_) images.push_back(image.name());
    return copy_->read(images, static_cast<GLint>(layer), varyings, content);
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer(layer));
  content.numbers.clear();
  content.is_empty = false;
  if (shape_.has_numbers) {
    content.numbers.resize(shape_.samples());
    glReadBuffer(buffers_.front());
    read_pixels(shape_, GL_RED, content.numbers.data());
    content.is_empty = has_no_number(content.numbers);
    if (content.is_empty) return check("reading a layer");
  }
  read_depth(content.depth);
  const std::size_t first = buffers_.size() - values_.size();
  for (GLenum i = 0; i < values_.size(); ++i) {
    if (!varyings[i]) continue;
    content.values[i].resize(shape_.samples());
    glReadBuffer(buffers_[first + i]);
    read_pixels(shape_, GL_RGBA, content.values[i].data());
  }
  return check("reading a layer");
}

}  // namespace rastercheck::backends::gl
